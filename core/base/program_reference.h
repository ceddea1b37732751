// SPDX-License-Identifier: Apache-2.0
// What a program of ours can be asked for, as a tree of commands and options, and the three texts that are written from
// it: its man page, the completion of bash and a chapter of the manual. The tree is filled from what the program itself
// parses with, so none of the three can fall behind it.
#pragma once

#include <string>
#include <vector>

namespace spindrift {

/// An option, or an argument that is known by its place.
struct ProgramOption {
  std::vector<std::string> names;    ///< "-h", "--help"; of an argument its one name: "CAMPAIGN"
  std::string value;                 ///< what follows it: "FILE"; empty: nothing does
  std::vector<std::string> allowed;  ///< all values it takes; empty: any
  std::string description;
  bool required = false;
};

/// A program, or a command of it with commands of its own.
struct ProgramCommand {
  std::string name;
  std::string description;  ///< lines may be broken
  std::vector<ProgramOption> arguments;
  std::vector<ProgramOption> options;
  std::vector<ProgramCommand> commands;
};

struct ProgramReference {
  ProgramCommand program;
  std::string version;
  std::string summary;  ///< what the program is for, in less than a line, without its name and a full stop
  std::vector<std::string> see_also;  ///< other programs with a page in section 1
};

/// The page of section 1 in the macros of man(7), UTF-8: commands one after another, each with its own options.
[[nodiscard]] std::string manPage(const ProgramReference& reference);

/// A script to be sourced by bash, which needs no other: completes commands, options and values that are known;
/// everything else is completed as a file.
[[nodiscard]] std::string bashCompletion(const ProgramReference& reference);

/// The same as Markdown: one heading of the second level for each command that can be run.
[[nodiscard]] std::string markdownReference(const ProgramReference& reference);

/// The text that is asked for by "man", "bash" or "markdown". Throws InputError for anything else.
[[nodiscard]] std::string referenceText(const ProgramReference& reference, const std::string& format);

}  // namespace spindrift
