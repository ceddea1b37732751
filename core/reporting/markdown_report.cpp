// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/markdown_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

/// Without marks: *emphasis*, `code`, [link](address), and \* for a star.
std::string withoutMarks(std::string_view text) {
  std::string out;
  bool code = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '`') {
      code = !code;
    } else if (code) {
      out += c;
    } else if (c == '\\' && i + 1 < text.size() && std::ispunct(static_cast<unsigned char>(text[i + 1])) != 0) {
      out += text[++i];
    } else if (c == '[' && text.find("](", i) != std::string_view::npos) {
      const std::size_t middle = text.find("](", i);
      const std::size_t end = text.find(')', middle);
      out += withoutMarks(text.substr(i + 1, middle - i - 1));
      i = end == std::string_view::npos ? text.size() : end;
    } else if (c == '*') {
      // A mark stands at a word; a star between blanks is one.
      const bool blank_before = i == 0 || text[i - 1] == ' ';
      const bool blank_after = i + 1 == text.size() || text[i + 1] == ' ';
      if (blank_before && blank_after) out += c;
    } else {
      out += c;
    }
  }
  return out;
}

std::vector<std::string> cellsOf(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with('|')) line.remove_prefix(1);
  if (line.ends_with('|') && !line.ends_with("\\|")) line.remove_suffix(1);
  std::vector<std::string> cells(1);
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '|' && (i == 0 || line[i - 1] != '\\')) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  for (std::string& cell : cells) cell = withoutMarks(trimmed(cell));
  return cells;
}

class Reader {
 public:
  Reader(Report& report, const FigureOfName& figures) : report_(report), figures_(figures) {}

  void read(std::string_view markdown) {
    while (!markdown.empty()) {
      const std::size_t end = std::min(markdown.find('\n'), markdown.size());
      line(markdown.substr(0, end));
      markdown.remove_prefix(std::min(end + 1, markdown.size()));
    }
    if (fenced_) throw InputError("Markdown: a block of code that begins with ``` does not end.");
    flush();
  }

 private:
  void line(std::string_view text) {
    ++number_;
    if (text.starts_with("```")) {
      flush();
      if (fenced_) code_.empty() ? void() : flushCode();
      fenced_ = !fenced_;
      return;
    }
    if (fenced_) {
      code_ += std::string(text) + '\n';
      return;
    }
    if (text.starts_with("    ") && words_.empty()) {
      code_ += std::string(text.substr(4)) + '\n';
      return;
    }
    if (!code_.empty() && trimmed(text).empty()) {
      code_ += '\n';  // perhaps more of it follows
      return;
    }
    if (!code_.empty()) flushCode();
    if (text.starts_with('|')) {
      flushWords();
      addRow(text);
      return;
    }
    flushTable();
    if (trimmed(text).empty()) {
      flushWords();
    } else if (text.starts_with('#')) {
      flush();
      const std::size_t level = text.find_first_not_of('#');
      const std::string heading = withoutMarks(trimmed(text.substr(std::min(level, text.size()))));
      level == 1 ? report_.section(heading) : report_.subsection(heading);
    } else if (text.starts_with("![")) {
      flush();
      figure(text);
    } else if (text.starts_with("> ")) {
      if (!callout_) flushWords();
      callout_ = true;
      append(text.substr(2));
    } else if (text.starts_with("- ")) {
      flushWords();
      append("• ");
      words_ += text.substr(2);
    } else if (std::isdigit(static_cast<unsigned char>(text[0])) != 0 && text.find(". ") < 3) {
      flushWords();
      append(text);
    } else {
      append(trimmed(text));
    }
  }

  void append(std::string_view text) {
    if (!words_.empty()) words_ += ' ';
    words_ += text;
  }

  void addRow(std::string_view text) {
    std::vector<std::string> cells = cellsOf(text);
    const bool rule = std::all_of(cells.begin(), cells.end(), [](const std::string& cell) {
      return !cell.empty() && cell.find_first_not_of("-:") == std::string::npos;
    });
    if (rule) return;
    if (!table_.empty() && cells.size() != table_.front().size()) {
      throw InputError(fmt::format("Markdown, line {}: the row of a table has {} cells; allowed: {}, as in its header.",
                                   number_, cells.size(), table_.front().size()));
    }
    table_.emplace_back(cells.begin(), cells.end());
  }

  void figure(std::string_view text) {
    const std::size_t middle = text.find("](");
    if (middle == std::string_view::npos || !figures_) return;
    const std::size_t end = text.find(')', middle);
    if (auto drawing = figures_(std::string(text.substr(middle + 2, end - middle - 2))))
      report_.figure(std::move(*drawing), withoutMarks(text.substr(2, middle - 2)));
  }

  void flush() {
    flushWords();
    flushTable();
    if (!fenced_) flushCode();
  }
  void flushWords() {
    if (words_.empty()) return;
    const std::string text = withoutMarks(std::exchange(words_, {}));
    std::exchange(callout_, false) ? report_.callout(CalloutKind::Note, text) : report_.paragraph(text);
  }
  void flushTable() {
    if (table_.empty()) return;
    ReportRow header = table_.front();
    report_.table(std::move(header), {table_.begin() + 1, table_.end()});
    table_.clear();
  }
  void flushCode() {
    while (code_.ends_with('\n')) code_.pop_back();
    if (!code_.empty()) report_.code(std::exchange(code_, {}));
  }

  Report& report_;
  const FigureOfName& figures_;
  int number_ = 0;
  std::string words_;
  bool callout_ = false;
  std::string code_;
  bool fenced_ = false;
  std::vector<ReportRow> table_;
};

}  // namespace

void addMarkdown(Report& report, std::string_view markdown, const FigureOfName& figures) {
  Reader(report, figures).read(markdown);
}

}  // namespace spindrift
