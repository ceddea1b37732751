// SPDX-License-Identifier: GPL-3.0-or-later
// The distance between two places of the 3D view.
#pragma once

#include <Eigen/Core>
#include <QString>
#include <optional>

namespace spindrift::gui {

/// Where a point really is: its deviation from the nominal place and the standard uncertainties of the three
/// components, um. NaN: not measured.
struct PointDeviation {
  Eigen::Vector3d deviation_um = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_um = Eigen::Vector3d::Zero();
};

struct MeasuredPlace {
  QString name;  ///< "F1"; empty: a place on a surface
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  std::optional<PointDeviation> deviation;
};

struct Distance {
  double nominal_mm = 0.0;
  /// Along the nominal line; empty unless both places were measured in every direction the line runs in.
  std::optional<double> change_um;
  double sigma_um = 0.0;  ///< of the change; readings at the two places count as independent
};

/// d = |b - a|; with n = (b - a) / d: change = n . (e_b - e_a), u^2 = sum n_i^2 (u_a,i^2 + u_b,i^2), the first order of
/// the distance in the deviations (GUM 5.1.2). No uncertainty can be stated for d = 0.
[[nodiscard]] Distance distanceBetween(const MeasuredPlace& a, const MeasuredPlace& b);

/// "F1 to F3: 260.0042 ± 0.0008 mm, 4.2 ± 0.8 µm more than nominal" or "F1 to a surface: 87.3 mm".
[[nodiscard]] QString distanceText(const MeasuredPlace& a, const MeasuredPlace& b);

}  // namespace spindrift::gui
