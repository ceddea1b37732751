// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/verify/verify_series.h"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cmath>

#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"

namespace spindrift::gui {
namespace {

QString verifyText(const char* source) {
  return QCoreApplication::translate("VerifyPage", source);
}

constexpr std::array<int, 2> colours{1, 0};  // before, after

std::vector<const VerifyPoint*> valuesOf(const VerifyResult& result, Component component, double c_deg) {
  std::vector<const VerifyPoint*> values;
  for (const VerifyPoint& p : result.points) {
    if (p.component == component && p.c_deg == c_deg) values.push_back(&p);
  }
  return values;
}

double valueOf(const VerifyPoint& p, int side) {
  return side == 0 ? p.before : p.after;
}
double sigmaOf(const VerifyPoint& p, int side) {
  return side == 0 ? p.before_sigma : p.after_sigma;
}

std::vector<Series> singleValues(const std::vector<const VerifyPoint*>& values) {
  std::vector<Series> all;
  for (const int side : {0, 1}) {
    Series s;
    s.name = side == 0 ? verifyText("Before, ± 2 uncertainties") : verifyText("After, ± 2 uncertainties");
    s.style = SeriesStyle::Points;
    s.colour = colours[static_cast<std::size_t>(side)];
    for (std::size_t i = 0; i < values.size(); ++i) {
      s.x.push_back(static_cast<double>(i) + (side == 0 ? 0.88 : 1.12));
      s.y.push_back(valueOf(*values[i], side));
      s.sigma.push_back(sigmaOf(*values[i], side));
    }
    all.push_back(std::move(s));
  }
  return all;
}

std::vector<Series> ranges(const std::vector<const VerifyPoint*>& values) {
  std::vector<std::string> states;
  for (const VerifyPoint* p : values) {
    if (std::find(states.begin(), states.end(), p->state) == states.end()) states.push_back(p->state);
  }
  std::vector<Series> all;
  for (const int side : {0, 1}) {
    Series s;
    s.name = side == 0 ? verifyText("Before, range over the points with ± 2 u")
                       : verifyText("After, range over the points with ± 2 u");
    s.style = SeriesStyle::Line;
    s.colour = colours[static_cast<std::size_t>(side)];
    s.sigma_factor = 1.0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      double low = 1e300;
      double high = -1e300;
      for (const VerifyPoint* p : values) {
        if (p->state != states[i]) continue;
        low = std::min(low, valueOf(*p, side) - 2.0 * sigmaOf(*p, side));
        high = std::max(high, valueOf(*p, side) + 2.0 * sigmaOf(*p, side));
      }
      s.x.push_back(static_cast<double>(i + 1));
      s.y.push_back(0.5 * (low + high));
      s.sigma.push_back(0.5 * (high - low));
    }
    all.push_back(std::move(s));
  }
  return all;
}

}  // namespace

VerifyCurves verifyCurves(const VerifyResult& result, Component component, double c_deg) {
  VerifyCurves curves;
  const auto values = valuesOf(result, component, c_deg);
  if (values.empty()) return curves;
  const bool rotation = isRotation(component);
  const bool single = values.size() <= most_single_values;
  curves.series = single ? singleValues(values) : ranges(values);
  const double last = curves.series.front().x.back();
  const double goal = result.goal(component);
  for (const double sign : {1.0, -1.0}) {
    if (!(goal > 0.0)) continue;
    Series limit;
    limit.name = verifyText("Goal");
    limit.style = SeriesStyle::Dashed;
    limit.colour = 2;
    limit.legend = sign > 0;
    limit.x = {0.5, last + 0.5};
    limit.y = {sign * goal, sign * goal};
    curves.series.push_back(std::move(limit));
  }
  curves.x_title = single ? verifyText("Measured value, points in order of the plan")
                          : verifyText("Thermal state, in order of the plan");
  curves.y_title =
      verifyText("Change of %1 / %2")
          .arg(fromCore(std::string(toString(component))), rotation ? verifyText("µrad") : verifyText("µm"));
  return curves;
}

std::vector<Row> verifyPointRows(const std::vector<VerifyPointFigures>& points, Component component, double goal) {
  const QString unit = unitText(unitOf(component));
  std::vector<Row> rows;
  for (const auto& [point, before, after] : points) {
    const auto cell = [&](double value, double sigma, const std::string& at = {}) {
      Cell out{quantityText(value, sigma, unit)};
      out.right = true;
      out.tip = fromCore(at);
      return out;
    };
    Row row;
    row.id = fromCore(point);
    row.cells = {nameCell(row.id), cell(before.rms, before.rms_sigma), cell(after.rms, after.rms_sigma),
                 cell(before.largest, before.largest_sigma, before.largest_at),
                 cell(after.largest, after.largest_sigma, after.largest_at)};
    if (goal > 0.0 && after.largest + 2.0 * after.largest_sigma > goal) {
      Cell& cell_after = row.cells.back();
      cell_after.tone = after.largest - 2.0 * after.largest_sigma > goal ? Tone::Bad : Tone::Attention;
      cell_after.icon = toneIcon(cell_after.tone);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace spindrift::gui
