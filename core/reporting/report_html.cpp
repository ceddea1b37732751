// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/base/text.h"
#include "core/reporting/report.h"

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
pre{font:12px/1.45 "DejaVu Sans Mono",monospace;background:#f4f6f8;padding:10px 14px;white-space:pre-wrap;overflow-wrap:anywhere}
figure{margin:16px 0}figure svg,figure img{max-width:100%;height:auto;display:block}
.verdict{padding:10px 16px;border-left:4px solid var(--soft);background:#f8f9fa;margin:12px 0;font-weight:600}
.good{border-color:var(--good)}.attention{border-color:var(--attention)}.bad{border-color:var(--bad)}
@page{size:A4;margin:18mm}
@media print{body{background:#fff}main{border:0;margin:0;padding:0;max-width:none}h2,h3,caption,thead{break-after:avoid}
figure,table,tr,.verdict{break-inside:avoid}table.long{break-inside:auto}}
)";

/// Tables with more rows may be broken between two of them.
constexpr std::size_t longest_unbroken_table = 24;
/// Letters of a cell in the first column that is never broken.
constexpr std::size_t longest_html_name = 24;

std::string printed(const ReportText& text) {
  std::string out;
  for (const ReportText::Run& run : text.runs)
    out += run.small ? "<small>" + escapedXml(run.text) + "</small>" : escapedXml(run.text);
  return out;
}

/// "EX / µm" on one line.
std::string unbroken(std::string text) {
  const std::size_t at = text.find(" / ");
  if (at != std::string::npos) text.replace(at, 3, "\u00a0/\u00a0");
  return text;
}

std::string_view nameOf(CalloutKind kind) {
  switch (kind) {
    case CalloutKind::Good:
      return "good";
    case CalloutKind::Attention:
      return "attention";
    case CalloutKind::Bad:
      return "bad";
    case CalloutKind::Note:
      break;
  }
  return "note";
}

struct HtmlWriter {
  std::string out;

  void operator()(const HeadingBlock& b) { out += fmt::format("<h{0}>{1}</h{0}>\n", b.level + 1, printed(b.text)); }
  void operator()(const TextBlock& b) { out += fmt::format("<p>{}</p>\n", printed(b.text)); }
  void operator()(const CalloutBlock& b) {
    out += fmt::format("<p class=\"verdict {}\">{}</p>\n", nameOf(b.kind), printed(b.text));
  }
  void operator()(const CodeBlock& b) { out += fmt::format("<pre>{}</pre>\n", escapedXml(b.text)); }
  void operator()(const FigureBlock& b) {
    out += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", svgOf(b.drawing), escapedXml(b.caption));
  }
  void operator()(const TableBlock& b) {
    out += b.isFacts()                              ? "<table class=\"facts\">"
           : b.rows.size() > longest_unbroken_table ? "<table class=\"long\">"
                                                    : "<table>";
    if (!b.caption.empty()) out += fmt::format("<caption>{}</caption>", escapedXml(b.caption));
    if (!b.isFacts()) {
      out += "<thead>";
      row("th", b, b.header);
      out += "</thead>";
    }
    out += "<tbody>";
    for (const ReportRow& cells : b.rows) row("td", b, cells);
    out += "</tbody></table>\n";
  }

 private:
  void row(const char* tag, const TableBlock& table, const ReportRow& cells) {
    out += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i) {
      // A short name stays on one line, and so does a quantity with its unit.
      const bool words = !table.isFacts() && (i > 0 ? table.of_words[i] : cells[i].plain().size() > longest_html_name);
      out += fmt::format("<{0}{1}>{2}</{0}>", tag, words ? " class=\"text\"" : "", unbroken(printed(cells[i])));
    }
    out += "</tr>";
  }
};

}  // namespace

std::string htmlOf(const Report& report) {
  HtmlWriter body;
  for (const ReportBlock& block : report.blocks()) std::visit(body, block);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"{4}\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{0}</title><style>{1}</style></head>\n<body><main>\n<header><h1>{0}</h1>"
      "<p>{2}</p></header>\n{3}</main></body></html>\n",
      escapedXml(report.title()), style, escapedXml(report.subtitle()), body.out, escapedXml(report.language()));
}

}  // namespace spindrift
