// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/measurement.h"

#include <QCoreApplication>
#include <cmath>

#include "core/base/text.h"
#include "core/base/units.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

QString measurementText(const char* text) {
  return QCoreApplication::translate("measurement", text);
}

}  // namespace

Distance distanceBetween(const MeasuredPlace& a, const MeasuredPlace& b) {
  const Eigen::Vector3d between = b.position_mm - a.position_mm;
  Distance d;
  d.nominal_mm = between.norm();
  if (!a.deviation || !b.deviation || d.nominal_mm <= 0.0) return d;
  double change = 0.0;
  double variance = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double n = between[i] / d.nominal_mm;
    if (std::abs(n) < 1e-9) continue;  // not even a direction that was not measured matters
    change += n * (b.deviation->deviation_um[i] - a.deviation->deviation_um[i]);
    const double sigma = std::hypot(a.deviation->sigma_um[i], b.deviation->sigma_um[i]);
    variance += n * n * sigma * sigma;
  }
  if (!std::isfinite(change) || !std::isfinite(variance)) return d;
  d.change_um = change;
  d.sigma_um = std::sqrt(variance);
  return d;
}

QString distanceText(const MeasuredPlace& a, const MeasuredPlace& b) {
  const Distance d = distanceBetween(a, b);
  const auto name = [](const MeasuredPlace& place) {
    return place.name.isEmpty() ? measurementText("surface") : place.name;
  };
  const QString ends = measurementText("%1 to %2").arg(name(a), name(b));
  if (!d.change_um) return measurementText("%1: %2 mm").arg(ends, decimalText(d.nominal_mm, 'f', 3));
  const double actual_mm = d.nominal_mm + *d.change_um / um_per_mm;
  return measurementText("%1: %2, %3 %4 than nominal")
      .arg(ends, shownNumbers(QString::fromStdString(withUncertainty(actual_mm, d.sigma_um / um_per_mm, "mm"))),
           shownNumbers(QString::fromStdString(withUncertainty(std::abs(*d.change_um), d.sigma_um, "um"))),
           *d.change_um < 0 ? measurementText("less") : measurementText("more"));
}

}  // namespace spindrift::gui
