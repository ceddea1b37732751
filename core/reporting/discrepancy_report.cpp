// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/discrepancy_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"

namespace spindrift {
namespace {

/// Residual of one component over time, all points: before in orange, after in blue (readable for the colour-blind).
std::string courses(const DiscrepancyInput& input, const DiscrepancyResult& result, Component component) {
  const auto& rows = input.observations.rows;
  std::map<std::string, std::pair<double, double>> means;  // residual before: sum and count per point
  double last = 0.0;
  double limit = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].component != component || !std::isfinite(result.simulated[i])) continue;
    auto& m = means[rows[i].point];
    m.first += rows[i].value - result.simulated[i];
    m.second += 1.0;
    last = std::max(last, rows[i].time_s);
  }
  if (means.empty() || !(last > 0.0)) return "";
  std::string before;
  std::string after;
  std::vector<std::array<double, 3>> marks;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].component != component || !std::isfinite(result.simulated[i])) continue;
    const auto& m = means[rows[i].point];
    const double r0 = rows[i].value - result.simulated[i] - m.first / m.second;
    const double r1 = std::isfinite(result.constant[i]) ? rows[i].value - result.completed[i] - result.constant[i] : r0;
    limit = std::max({limit, std::abs(r0), std::abs(r1)});
    marks.push_back({rows[i].time_s, r0, r1});
  }
  limit = std::max(limit, 1e-6);
  const double width = 760.0;
  const double height = 190.0;
  const std::size_t step = std::max<std::size_t>(1, marks.size() / 3000);
  for (std::size_t i = 0; i < marks.size(); i += step) {
    const double x = 60.0 + marks[i][0] / last * (width - 80.0);
    const auto y = [&](double v) { return 20.0 + (height - 55.0) * 0.5 * (1.0 - v / limit); };
    before += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\"/>", x, y(marks[i][1]));
    after += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\"/>", x, y(marks[i][2]));
  }
  const double middle = 20.0 + (height - 55.0) * 0.5;
  return fmt::format(
      "<figure><svg viewBox=\"0 0 {0} {1}\" role=\"img\"><line x1=\"60\" x2=\"{2}\" y1=\"{3}\" y2=\"{3}\" "
      "stroke=\"#999\"/><text x=\"54\" y=\"26\" text-anchor=\"end\">{4:.2f}</text><text x=\"54\" y=\"{5}\" "
      "text-anchor=\"end\">-{4:.2f}</text><text x=\"54\" y=\"{6}\" text-anchor=\"end\">0</text><text x=\"{2}\" "
      "y=\"{7}\" "
      "text-anchor=\"end\">{8:.1f} h</text><g fill=\"#d98b2b\" fill-opacity=\"0.6\">{9}</g><g fill=\"#2f6fa8\" "
      "fill-opacity=\"0.7\">{10}</g></svg><figcaption>{11}, {12}: measured minus simulation (orange) and minus the "
      "completed model (blue), all points</figcaption></figure>",
      width, height, width - 20.0, middle, limit, height - 35.0, middle + 4.0, height - 12.0, last / 3600.0, before,
      after, toString(component), unitOf(component));
}

/// rms before and after per point and component; the shade tells the size, the number says it.
std::string pointTable(const DiscrepancyInput& input, const DiscrepancyResult& result) {
  const auto& rows = input.observations.rows;
  struct Cell {
    double n = 0.0, sum = 0.0, before = 0.0, after = 0.0;
  };
  std::map<std::pair<std::string, Component>, Cell> cells;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(result.simulated[i]) || !std::isfinite(result.constant[i])) continue;
    Cell& c = cells[{rows[i].point, rows[i].component}];
    const double r0 = rows[i].value - result.simulated[i];
    const double r1 = rows[i].value - result.completed[i] - result.constant[i];
    c.n += 1.0;
    c.sum += r0;
    c.before += r0 * r0;
    c.after += r1 * r1;
  }
  double largest = 1e-9;
  for (auto& [key, c] : cells) {
    c.before = std::sqrt(std::max(0.0, c.before / c.n - c.sum * c.sum / (c.n * c.n)));
    c.after = std::sqrt(c.after / c.n);
    largest = std::max(largest, c.before);
  }
  std::string text = "<table><tr><th>point</th><th>component</th><th>rms before</th><th>rms after</th></tr>";
  for (const auto& [key, c] : cells) {
    const auto shade = [&](double v) { return std::clamp(v / largest, 0.0, 1.0) * 0.55; };
    text += fmt::format(
        "<tr><td>{}</td><td>{}</td><td style=\"background:rgba(217,139,43,{:.2f})\">{:.2f} {}</td><td "
        "style=\"background:rgba(47,111,168,{:.2f})\">{:.2f} {}</td></tr>",
        escapedXml(key.first), toString(key.second), shade(c.before), c.before, unitOf(key.second), shade(c.after),
        c.after, unitOf(key.second));
  }
  return text + "</table>";
}

}  // namespace

std::string discrepancyReport(const std::string& campaign, const DiscrepancyInput& input,
                              const DiscrepancyResult& result) {
  std::string html = fmt::format(
      "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Discrepancy: {0}</title><style>"
      "body{{font:15px/1.5 system-ui,sans-serif;color:#222;background:#fafafa;max-width:860px;margin:2em "
      "auto;padding:0 1em}}"
      "h1{{font-weight:600}}h2{{font-weight:600;margin-top:1.8em}}table{{border-collapse:collapse;width:100%}}"
      "td,th{{text-align:left;padding:.25em .6em;border-bottom:1px solid #ddd;font-variant-numeric:tabular-nums}}"
      "svg{{width:100%;background:#fff;border:1px solid #ddd}}figure{{margin:1em 0}}figcaption,svg text{{color:#555;"
      "font-size:13px}}.verdict{{font-size:1.2em}}</style></head><body><h1>{0}</h1><p class=\"verdict\"><b>{1}</b>: "
      "{2}</p>",
      escapedXml(campaign), toString(result.verdict), escapedXml(result.message));
  html += fmt::format(
      "<p>Gap {:.2f} um before, {:.2f} um after; noise {:.2f} um. Held out: {:.2f} um before, {:.2f} um "
      "after.</p>",
      result.gap.rms_before_um, result.gap.rms_after_um, result.gap.noise_um, result.gap.heldout_rms_before_um,
      result.gap.heldout_rms_after_um);
  if (!result.effects.empty()) {
    html += "<h2>Effects</h2>";
    for (const FoundEffect& e : result.effects) {
      html += fmt::format("<h3>{}</h3><p>{} Driven by {}. Confidence {:.2f}, gain in BIC {:.0f}.</p>", escapedXml(e.id),
                          escapedXml(e.physics), escapedXml(e.drivers), e.confidence, e.delta_bic);
      if (!e.rivals.empty())
        html += fmt::format("<p>Cannot be told from {}.</p>", escapedXml(joinedList(e.rivals, "or")));
      html += "<table><tr><th>parameter</th><th>value</th></tr>";
      for (const FittedParameter& p : e.parameters) {
        html += fmt::format("<tr><td>{}</td><td>{}</td></tr>", escapedXml(p.name),
                            escapedXml(withUncertainty(p.value, p.standard_uncertainty, "")));
      }
      html += "</table>";
    }
  }
  if (!result.leftover.empty()) html += fmt::format("<p>Left over: {}.</p>", escapedXml(result.leftover));
  if (result.suggestion) {
    html += fmt::format("<h2>Measure next</h2><p>To tell {}: {} at {} times; {}. Expected gain in BIC {:.0f}.</p>",
                        escapedXml(result.suggestion->separates), escapedXml(joinedList(result.suggestion->points)),
                        result.suggestion->times_s.size(), escapedXml(result.suggestion->conditions),
                        result.suggestion->expected_delta_bic);
  }
  html += "<h2>Time courses</h2>";
  for (const Component c : all_components) html += courses(input, result, c);
  html += "<h2>Points</h2>" + pointTable(input, result);
  if (!result.where.empty()) {
    html +=
        "<h2>Where</h2><table><tr><th>component</th><th>points</th><th>from</th><th>to</th><th>condition</th><th>excess"
        "</th><th>p</th></tr>";
    for (const DisagreementPlace& p : result.where) {
      html += fmt::format(
          "<tr><td>{}</td><td>{}</td><td>{:.0f} s</td><td>{:.0f} s</td><td>{}</td><td>{:.2f} {}</td><td>"
          "{:.1e}</td></tr>",
          toString(p.component), escapedXml(joinedList(p.points)), p.from_s, p.to_s, escapedXml(p.condition),
          p.excess_um, unitOf(p.component), p.p_value);
    }
    html += "</table>";
  }
  html += "<h2>Steps</h2><table><tr><th>effect</th><th>gain in BIC</th><th></th></tr>";
  for (const DiscrepancyStep& s : result.steps) {
    html += fmt::format("<tr><td>{}</td><td>{:.0f}</td><td>{}</td></tr>", escapedXml(s.id), s.delta_bic,
                        s.accepted ? "added" : escapedXml("not added: " + s.reason));
  }
  html += "</table>";
  for (const std::string& w : result.warnings) html += fmt::format("<p>Note: {}</p>", escapedXml(w));
  return html + "</body></html>\n";
}

}  // namespace spindrift
