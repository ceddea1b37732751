// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/base/error.h"
#include "core/base/untrusted_text.h"

namespace spindrift {
namespace {

/// Letters that a number with its uncertainty, its unit and what it belongs to takes at most.
constexpr std::size_t longest_number = 40;

/// A column of sentences or names: some cell does not begin as a number does, or says more than a number.
bool isOfWords(const std::vector<ReportRow>& rows, std::size_t column) {
  return std::any_of(rows.begin(), rows.end(), [&](const ReportRow& row) {
    if (column >= row.size() || row[column].empty()) return false;
    const std::string& cell = row[column].runs.front().text;
    if (cell.size() > longest_number) return true;
    const bool number = std::isdigit(static_cast<unsigned char>(cell[0])) != 0 || cell[0] == '+' || cell[0] == '<' ||
                        cell.starts_with("\u2212") || cell.starts_with("\u2013") || cell.starts_with("not determined");
    return !number;
  });
}

/// What names and notes hold may be anything: what cannot be set is taken out here, for all writers. Lines stay.
std::string settable(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out += printable(text.substr(at, end - at));
    if (end < text.size()) out += '\n';
    at = end + 1;
  }
  return out;
}

}  // namespace

ReportText::ReportText(std::string text) {
  if (!text.empty()) runs.push_back({settable(text), false});
}

ReportText ReportText::smallPrint(std::string_view text) {
  ReportText out{text};
  for (Run& run : out.runs) run.small = true;
  return out;
}

std::string ReportText::plain() const {
  std::string text;
  for (const Run& run : runs) text += run.text;
  return text;
}

Report::Report(std::string_view title, std::string_view subtitle)
    : title_(printable(title)), subtitle_(printable(subtitle)) {}

Report& Report::section(const ReportText& heading) {
  blocks_.emplace_back(HeadingBlock{1, heading});
  return *this;
}

Report& Report::subsection(const ReportText& heading) {
  blocks_.emplace_back(HeadingBlock{2, heading});
  return *this;
}

Report& Report::paragraph(const ReportText& text) {
  blocks_.emplace_back(TextBlock{text});
  return *this;
}

Report& Report::callout(CalloutKind kind, const ReportText& text) {
  blocks_.emplace_back(CalloutBlock{kind, text});
  return *this;
}

Report& Report::table(ReportRow header, std::vector<ReportRow> rows, std::string_view caption) {
  SPINDRIFT_ASSERT(!header.empty(), "a table has a header");
  ++tables_;
  if (rows.empty()) rows.push_back({"none"});
  TableBlock table{std::move(header), std::move(rows), {}, {}};
  if (!caption.empty()) table.caption = fmt::format("Table {}: {}", tables_, printable(caption));
  for (ReportRow& row : table.rows) row.resize(table.header.size());
  for (std::size_t i = 0; i < table.header.size(); ++i) table.of_words.push_back(i > 0 && isOfWords(table.rows, i));
  blocks_.emplace_back(std::move(table));
  return *this;
}

Report& Report::facts(const ReportFacts& rows) {
  TableBlock table{{}, {}, {}, {true, true}};
  for (const auto& [name, value] : rows) table.rows.push_back({name, value});
  blocks_.emplace_back(std::move(table));
  return *this;
}

Report& Report::figure(Drawing drawing, std::string_view caption) {
  blocks_.emplace_back(FigureBlock{std::move(drawing), fmt::format("Figure {}: {}", ++figures_, printable(caption))});
  return *this;
}

Report& Report::code(std::string_view text) {
  blocks_.emplace_back(CodeBlock{settable(text)});
  return *this;
}

Report& Report::append(const Report& other) {
  blocks_.insert(blocks_.end(), other.blocks_.begin(), other.blocks_.end());
  figures_ += other.figures_;
  tables_ += other.tables_;
  return *this;
}

Report& Report::withoutSignatures() {
  signed_ = false;
  return *this;
}

Report Report::translated(std::string_view language, std::function<std::string(const std::string&)> words,
                          const std::function<ReportBlock(const ReportBlock&)>& block) const {
  Report out(words(title_), words(subtitle_));
  for (const ReportBlock& one : blocks_) out.blocks_.push_back(block(one));
  out.figures_ = figures_;
  out.tables_ = tables_;
  out.signed_ = signed_;
  out.language_ = language;
  out.words_ = std::move(words);
  return out;
}

}  // namespace spindrift
