// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/html_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/base/text.h"
#include "core/reporting/report_wording.h"

namespace spindrift {
namespace {

constexpr std::string_view style = R"(
:root{--ink:#1f2933;--soft:#52606d;--line:#d9dee4;--accent:#0b7285;--good:#2b7a3d;--attention:#9a6700;--bad:#b42318}
*{box-sizing:border-box}
body{margin:0;background:#f4f6f8;color:var(--ink);font:14px/1.5 Inter,"DejaVu Sans",sans-serif;font-variant-numeric:tabular-nums}
main{max-width:960px;margin:24px auto;padding:40px 48px;background:#fff;border:1px solid var(--line)}
header{border-bottom:2px solid var(--accent);padding-bottom:16px;margin-bottom:24px}
h1{font-size:24px;line-height:1.2;margin:0 0 4px}h2{font-size:18px;margin:32px 0 8px}h3{font-size:14px;margin:20px 0 8px}
header p,figcaption,caption{color:var(--soft);margin:0}p{margin:8px 0}
table{border-collapse:collapse;width:100%;margin:12px 0}caption{text-align:left;padding-bottom:6px}
th,td{padding:5px 10px;border-bottom:1px solid var(--line);text-align:right;vertical-align:top}
th{font-weight:600;border-bottom:1px solid var(--soft)}th:first-child,td:first-child{text-align:left}
th.text,td.text{text-align:left}td{white-space:nowrap}td.text,table.facts td{white-space:normal}p{orphans:3;widows:3}
table.facts td{text-align:left}small{font-size:11px;font-weight:400;color:var(--soft)}th small{display:block}
table.facts td:first-child{width:32%;color:var(--soft)}
figure{margin:16px 0}figure svg,figure img{max-width:100%;height:auto;display:block}
.verdict{padding:10px 16px;border-left:4px solid var(--soft);background:#f8f9fa;margin:12px 0;font-weight:600}
.good{border-color:var(--good)}.attention{border-color:var(--attention)}.bad{border-color:var(--bad)}
@page{size:A4;margin:18mm}
@media print{body{background:#fff}main{border:0;margin:0;padding:0;max-width:none}h2,h3,caption,thead{break-after:avoid}
figure,table,tr,.verdict{break-inside:avoid}table.long{break-inside:auto}}
)";

/// A column of sentences or names: some cell has more than a word and does not begin as a number does.
bool isText(const std::vector<std::vector<std::string>>& rows, std::size_t column) {
  return std::any_of(rows.begin(), rows.end(), [&](const std::vector<std::string>& row) {
    if (column >= row.size() || row[column].empty()) return false;
    const std::string& cell = row[column];
    const bool number = std::isdigit(static_cast<unsigned char>(cell[0])) != 0 || cell[0] == '+' || cell[0] == '<' ||
                        cell.starts_with("\u2212") || cell.starts_with("\u2013") || cell.starts_with("not determined");
    return !number;
  });
}

/// Tables with more rows may be broken between two of them.
constexpr std::size_t longest_unbroken_table = 24;
/// Letters of a cell in the first column that is never broken.
constexpr std::size_t longest_name = 24;

/// Escaped, with units as printed and small print as an element.
std::string printed(std::string_view text) {
  std::string out;
  bool small = false;
  const std::string escaped = escapedXml(printedUnits(text));
  for (std::size_t i = 0; i < escaped.size();) {
    const std::size_t end = std::min(escaped.find('\x1f', i), escaped.size());
    out += escaped.substr(i, end - i);
    if (end < escaped.size()) {
      out += small ? "</small>" : "<small>";
      small = !small;
    }
    i = end + 1;
  }
  return small ? out + "</small>" : out;
}

/// "EX / um" on one line.
std::string unbroken(std::string text) {
  const std::size_t at = text.find(" / ");
  if (at != std::string::npos) text.replace(at, 3, "\u00a0/\u00a0");
  return text;
}

}  // namespace

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63U];
  }
  return out;
}

HtmlDocument::HtmlDocument(std::string title, std::string subtitle)
    : title_(std::move(title)), subtitle_(std::move(subtitle)) {}

HtmlDocument& HtmlDocument::section(std::string_view heading) {
  body_ += fmt::format("<h2>{}</h2>\n", printed(heading));
  return *this;
}

HtmlDocument& HtmlDocument::subsection(std::string_view heading) {
  body_ += fmt::format("<h3>{}</h3>\n", printed(heading));
  return *this;
}

HtmlDocument& HtmlDocument::paragraph(std::string_view text) {
  body_ += fmt::format("<p>{}</p>\n", printed(text));
  return *this;
}

HtmlDocument& HtmlDocument::verdict(std::string_view kind, std::string_view text) {
  body_ += fmt::format("<p class=\"verdict {}\">{}</p>\n", kind, printed(text));
  return *this;
}

HtmlDocument& HtmlDocument::table(const std::vector<std::string>& header,
                                  const std::vector<std::vector<std::string>>& rows, std::string_view caption) {
  body_ += rows.size() > longest_unbroken_table ? "<table class=\"long\">" : "<table>";
  if (!caption.empty()) body_ += fmt::format("<caption>Table {}: {}</caption>", ++tables_, printed(caption));
  body_ += "<thead><tr>";
  const auto cells = [&](const char* tag, const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      // A short name stays on one line, and so does a quantity with its unit.
      const bool text = i > 0 ? isText(rows, i) : row[i].size() > longest_name;
      body_ += fmt::format("<{}{}>{}</{}>", tag, text ? " class=\"text\"" : "", unbroken(printed(row[i])), tag);
    }
  };
  cells("th", header);
  body_ += "</tr></thead><tbody>";
  for (const auto& row : rows) {
    body_ += "<tr>";
    cells("td", row);
    body_ += "</tr>";
  }
  body_ += "</tbody></table>\n";
  return *this;
}

HtmlDocument& HtmlDocument::facts(const std::vector<std::pair<std::string, std::string>>& rows) {
  body_ += "<table class=\"facts\"><tbody>";
  for (const auto& [name, value] : rows) {
    body_ += fmt::format("<tr><td>{}</td><td>{}</td></tr>", printed(name), printed(value));
  }
  body_ += "</tbody></table>\n";
  return *this;
}

HtmlDocument& HtmlDocument::figure(std::string_view svg, std::string_view caption) {
  body_ += fmt::format("<figure>{}<figcaption>Figure {}: {}</figcaption></figure>\n", printedUnitsOfDrawing(svg),
                       ++figures_, printed(caption));
  return *this;
}

HtmlDocument& HtmlDocument::picture(std::string_view bytes, std::string_view mime, std::string_view caption) {
  return figure(fmt::format("<img alt=\"{}\" src=\"data:{};base64,{}\">", escapedXml(caption), mime, base64(bytes)),
                caption);
}

std::string HtmlDocument::html() const {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{0}</title><style>{1}</style></head>\n<body><main>\n<header><h1>{0}</h1>"
      "<p>{2}</p></header>\n{3}</main></body></html>\n",
      escapedXml(title_), style, printed(subtitle_), body_);
}

}  // namespace spindrift
