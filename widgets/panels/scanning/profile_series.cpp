// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/scanning/profile_series.h"

#include <QCoreApplication>
#include <cmath>

namespace spindrift::gui {
namespace {

QString profileText(const char* text) {
  return QCoreApplication::translate("profileSeries", text);
}

/// Profile `index` of a cloud as x and z (mm, um about its mean).
Series seriesOf(const PointCloud& cloud, std::size_t index, const QString& name, int colour) {
  Series s;
  s.name = name;
  s.colour = colour;
  s.style = SeriesStyle::Points;
  if (index >= cloud.profileCount()) return s;
  for (std::size_t i = cloud.profile_start[index]; i < cloud.profile_start[index + 1]; ++i) {
    s.x.push_back(cloud.points_mm[i].x());
    s.y.push_back(cloud.points_mm[i].z());
  }
  return s;
}

/// The profile of `cloud` whose carriage position is nearest to `y_mm`.
std::size_t nearestProfile(const PointCloud& cloud, double y_mm) {
  std::size_t best = 0;
  for (std::size_t k = 0; k < cloud.profileCount(); ++k) {
    if (std::abs(carriageOf(cloud, k) - y_mm) < std::abs(carriageOf(cloud, best) - y_mm)) best = k;
  }
  return best;
}

}  // namespace

double carriageOf(const PointCloud& cloud, std::size_t profile) {
  return cloud.points_mm[cloud.profile_start[profile]].y();
}

std::vector<Series> profileSeries(const ScanPicture& picture, int index) {
  std::vector<Series> series;
  if (picture.scan == nullptr || index < 0 || static_cast<std::size_t>(index) >= picture.scan->profileCount())
    return series;
  const auto k = static_cast<std::size_t>(index);
  const bool compared = picture.reference != nullptr;
  if (compared && picture.reference->profileCount() > 0)
    series.push_back(seriesOf(*picture.reference, nearestProfile(*picture.reference, carriageOf(*picture.scan, k)),
                              profileText("Cold"), 0));
  series.push_back(seriesOf(*picture.scan, k, compared ? profileText("This scan") : profileText("Cold"), 1));
  if (picture.fate == nullptr) return series;
  Series left_out;
  left_out.name = profileText("Left out");
  left_out.colour = 3;
  left_out.style = SeriesStyle::Points;
  for (std::size_t i = picture.scan->profile_start[k]; i < picture.scan->profile_start[k + 1]; ++i) {
    if ((*picture.fate)[i] == PointFate::Used) continue;
    left_out.x.push_back(picture.scan->points_mm[i].x());
    left_out.y.push_back(picture.scan->points_mm[i].z());
  }
  if (!left_out.x.empty()) series.push_back(std::move(left_out));
  return series;
}

}  // namespace spindrift::gui
