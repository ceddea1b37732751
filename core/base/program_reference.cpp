// SPDX-License-Identifier: Apache-2.0
#include "core/base/program_reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <sstream>
#include <string_view>

#include "core/base/error.h"

namespace spindrift {
namespace {

using Visit = std::function<void(const std::vector<std::string>& path, const ProgramCommand& command)>;

/// Every command with the words that lead to it, the program itself first with none.
void forEachCommand(const ProgramCommand& command, std::vector<std::string>& path, const Visit& visit) {
  visit(path, command);
  for (const ProgramCommand& one : command.commands) {
    path.push_back(one.name);
    forEachCommand(one, path, visit);
    path.pop_back();
  }
}
void forEachCommand(const ProgramReference& reference, const Visit& visit) {
  std::vector<std::string> path;
  forEachCommand(reference.program, path, visit);
}

std::string inOneLine(std::string_view text) {
  std::string line(text);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

/// "FILE", or the values it takes: "local|slurm".
std::string valueOf(const ProgramOption& option) {
  return option.allowed.empty() ? option.value : fmt::format("{}", fmt::join(option.allowed, "|"));
}

/// "spindrift-cli fit [OPTION ...] CAMPAIGN".
std::string synopsis(const ProgramReference& reference, const std::vector<std::string>& path,
                     const ProgramCommand& command) {
  std::string text = reference.program.name;
  for (const std::string& word : path) text += ' ' + word;
  for (const ProgramOption& option : command.options)
    if (option.required) text += fmt::format(" {} {}", option.names.back(), valueOf(option));
  if (!command.options.empty()) text += " [OPTION ...]";
  for (const ProgramOption& argument : command.arguments)
    text += argument.required ? ' ' + argument.names.front() : fmt::format(" [{}]", argument.names.front());
  if (!command.commands.empty()) text += command.arguments.empty() ? " COMMAND" : " [COMMAND]";
  return text;
}

/// Every command has --help: told once, of the program.
std::vector<ProgramOption> optionsToTell(const std::vector<std::string>& path, const ProgramCommand& command) {
  std::vector<ProgramOption> told;
  for (const ProgramOption& option : command.options)
    if (path.empty() || option.names.back() != "--help") told.push_back(option);
  return told;
}

// --- man ---

std::string troff(std::string_view text) {
  std::string out;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\(rs";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
    line_start = c == '\n';
  }
  return out;
}

std::string manOption(const ProgramOption& option) {
  std::string names;
  for (const std::string& name : option.names) {
    if (!names.empty()) names += ", ";
    names += "\\fB" + troff(name) + "\\fR";
  }
  if (const std::string value = valueOf(option); !value.empty()) {
    names += " \\fI";
    for (const char c : troff(value)) {
      names += c;
      if (c == '|') names += "\\:";  // many allowed words have no room in one line: it may end after each
    }
    names += "\\fR";
  }
  if (option.required) names += " (required)";
  return ".TP\n" + names + "\n" + troff(inOneLine(option.description)) + "\n";
}

// --- bash ---

/// Within single quotes.
std::string shellWord(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out + "'";
}

/// What compgen splits again: a blank within a word stays in it.
std::string wordList(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, "\n"));
}

std::string functionName(const std::string& program) {
  std::string name = "_";
  for (const char c : program) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

// --- Markdown ---

std::string markdownText(std::string_view text) {
  std::string out;
  for (const char c : inOneLine(text)) {
    if (std::string_view("\\`*_[]<>|").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string markdownOption(const ProgramOption& option) {
  std::string names = fmt::format("{}", fmt::join(option.names, ", "));
  if (const std::string value = valueOf(option); !value.empty() && !option.names.front().starts_with(value))
    names += " " + value;
  return fmt::format("- `{}`{}: {}\n", names, option.required ? " (required)" : "", markdownText(option.description));
}

}  // namespace

std::string manPage(const ProgramReference& reference) {
  std::string title = reference.program.name;
  std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return std::toupper(c); });
  std::string page = fmt::format(
      ".\\\" Written by the program itself: {} --reference man\n"
      ".TH {} 1 \"\" \"Spindrift {}\" \"User Commands\"\n.nh\n.ad l\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n",
      reference.program.name, troff(title), reference.version, troff(reference.program.name), troff(reference.summary));
  page += ".B " + troff(synopsis(reference, {}, reference.program)) + "\n.SH DESCRIPTION\n";
  std::istringstream lines(reference.program.description);
  std::string line;
  for (bool first = true; std::getline(lines, line); first = false) page += (first ? "" : ".PP\n") + troff(line) + "\n";
  bool commands = false;
  forEachCommand(reference, [&](const std::vector<std::string>& path, const ProgramCommand& command) {
    if (path.empty()) {
      page += ".SH OPTIONS\n";
    } else {
      if (!commands) page += ".SH COMMANDS\n";
      commands = true;
      page += fmt::format(".SS {}\n.B {}\n.PP\n{}\n", troff(fmt::format("{}", fmt::join(path, " "))),
                          troff(synopsis(reference, path, command)), troff(inOneLine(command.description)));
    }
    for (const ProgramOption& argument : command.arguments) page += manOption(argument);
    for (const ProgramOption& option : optionsToTell(path, command)) page += manOption(option);
  });
  if (!reference.see_also.empty()) {
    page += ".SH SEE ALSO\n";
    std::vector<std::string> pages;
    for (const std::string& other : reference.see_also) pages.push_back("\\fB" + troff(other) + "\\fR(1)");
    page += fmt::format("{}\n", fmt::join(pages, ", "));
  }
  return page;
}

std::string bashCompletion(const ProgramReference& reference) {
  // Three tables: commands of a path, options of a path, values of an option of a path.
  std::string paths, words, options, values;
  forEachCommand(reference, [&](const std::vector<std::string>& path, const ProgramCommand& command) {
    const std::string key = fmt::format("{}", fmt::join(path, " "));
    if (!path.empty()) paths += (paths.empty() ? "" : "|") + shellWord(key);
    std::vector<std::string> names;
    for (const ProgramCommand& one : command.commands) names.push_back(one.name);
    if (!names.empty()) words += fmt::format("    {}) words={} ;;\n", shellWord(key), shellWord(wordList(names)));
    std::vector<std::string> all;
    for (const ProgramOption& option : command.options) {
      all.insert(all.end(), option.names.begin(), option.names.end());
      if (option.value.empty() && option.allowed.empty()) continue;
      std::vector<std::string> patterns;
      for (const std::string& name : option.names) patterns.push_back(shellWord(key + ":" + name));
      values +=
          fmt::format("    {}) takes=1 values={} ;;\n", fmt::join(patterns, "|"), shellWord(wordList(option.allowed)));
    }
    options += fmt::format("    {}) options={} ;;\n", shellWord(key), shellWord(wordList(all)));
  });
  const std::string name = functionName(reference.program.name);
  std::string script =
      fmt::format("# Completion of bash, written by the program itself: {} --reference bash\n", reference.program.name);
  script += fmt::format("{}_option() {{\n  takes= values=\n  case \"$1:$2\" in\n{}  esac\n}}\n", name, values);
  script += name + R"(() {
  local IFS=$'\n' current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} path= word i takes values words= options=
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    if [ "$word" = = ]; then continue; fi
    )" + name +
            R"(_option "$path" "$word"
    if [ -n "$takes" ]; then
      if [ "${COMP_WORDS[i+1]}" = = ]; then i=$((i + 1)); fi
      i=$((i + 1))
      continue
    fi
    case "${path:+$path }$word" in
    )" + (paths.empty() ? "''" : paths) +
            R"() path="${path:+$path }$word" ;;
    esac
  done
  if [ "$current" = = ]; then current=; elif [ "$previous" = = ]; then previous=${COMP_WORDS[COMP_CWORD-2]}; fi
  )" + name +
            R"(_option "$path" "$previous"
  if [ -n "$takes" ]; then
    COMPREPLY=($(compgen -W "$values" -- "$current"))
    return
  fi
  case "$path" in
)" + options +
            R"(  esac
  case "$path" in
)" + words + R"(    ?*) ;;
  esac
  case "$current" in
    -*) COMPREPLY=($(compgen -W "$options" -- "$current")) ;;
    *) COMPREPLY=($(compgen -W "$words" -- "$current")) ;;
  esac
}
)";
  script += fmt::format("complete -o bashdefault -o default -F {} {}\n", name, reference.program.name);
  return script;
}

std::string markdownReference(const ProgramReference& reference) {
  std::string text = fmt::format("# {}\n\n", reference.program.name);
  std::istringstream lines(reference.program.description);
  for (std::string line; std::getline(lines, line);) text += markdownText(line) + "\n\n";
  forEachCommand(reference, [&](const std::vector<std::string>& path, const ProgramCommand& command) {
    if (!path.empty() && !command.commands.empty() && command.arguments.empty()) return;  // runs only through those
    if (!path.empty()) text += fmt::format("## {}\n\n{}\n\n", fmt::join(path, " "), markdownText(command.description));
    text += fmt::format("    {}\n\n", synopsis(reference, path, command));
    for (const ProgramOption& argument : command.arguments) text += markdownOption(argument);
    for (const ProgramOption& option : optionsToTell(path, command)) text += markdownOption(option);
    text += '\n';
  });
  return text;
}

std::string referenceText(const ProgramReference& reference, const std::string& format) {
  if (format == "man") return manPage(reference);
  if (format == "bash") return bashCompletion(reference);
  if (format == "markdown") return markdownReference(reference);
  throw InputError(fmt::format("--reference {} is not known; allowed: man, bash or markdown.", format));
}

}  // namespace spindrift
