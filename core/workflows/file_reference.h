// SPDX-License-Identifier: Apache-2.0
// Every file that Spindrift reads or writes, as one table: what it is, and each key or column with its unit, its
// default and what is allowed. The chapter "Files" of the manual and the command `files` are written from it; a test
// holds it against the readers in both directions (tests/core/readers/files_chapter_test.cpp), so that none of the
// three can say what another does not.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/machine/driver_words.h"

namespace spindrift {

/// A key of a JSON document or a column of a table.
struct FileKey {
  std::string path;     ///< "axes[].travel_mm"; of a table the name of the column
  std::string unit;     ///< as the name says it: "mm"; empty: none
  std::string without;  ///< what holds where it is absent: "required", "20", "-" for nothing
  std::string allowed;  ///< values or form; empty: what the unit or the meaning says
  std::string meaning;

  /// The key itself: "travel_mm".
  [[nodiscard]] std::string name() const;
  [[nodiscard]] bool required() const { return without == "required"; }
};

struct FileFormat {
  std::string id;       ///< by which it is asked for: "machine", "log"
  std::string file;     ///< how it is called: "machine.json"
  std::string format;   ///< the value of its key `format` ("spindrift-machine"); empty: it has none
  std::string what;     ///< sentences, Markdown
  std::string example;  ///< a whole document that is read as it stands; may be empty
  std::vector<FileKey> keys;
};

/// In the order of the chapter.
[[nodiscard]] std::span<const FileFormat> fileFormats();

/// The chapter of the manual; `id` names a single format; keys and their values stay as they are in every language.
/// Throws InputError for a format that is not known.
[[nodiscard]] std::string filesMarkdown(std::string_view id = {}, const TextTranslation& translation = {});

}  // namespace spindrift
