// SPDX-License-Identifier: Apache-2.0
// What a free-form surface can tell about the motion between two scans of it, before it is made.
//
// Height residual of a point under the motion (u, w) of registration.h, with g = (-h_x, -h_y, 1):
//   r = g . (u + w x q),   q = p - c (rigid) or (x - c_x, 0, z - c_z) (push_broom).
// Information J^T J / (2 sigma^2): both scans carry independent noise of standard deviation sigma along z in every
// point. push_broom has 3 more parameters per order for a drift of u along the scan, which are marginalised. Points
// where the surface is steeper than the profiler can see are left out. The inverse is the Cramer-Rao bound of (u, w)
// at the centroid; the profiler is taken parallel to the machine axes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scanning/artefact_surface.h"
#include "core/scanning/registration.h"

namespace spindrift {

struct ArtefactDesignOptions {
  ScanModel scan_model = ScanModel::Rigid;
  double noise_um = 0.5;        ///< standard deviation of a point's height
  double point_count = 640000;  ///< of one scan, spread evenly over the area
  int drift_order = 1;          ///< push_broom: 0 to 2, free (a registration holds the second order)
  double steepest_slope = 1.2;  ///< |dz/dx| or |dz/dy| beyond which nothing returns
  double weak_ratio = 30.0;     ///< a direction is weak if known this much less well than the best one
  int lattice = 200;            ///< places per side at which the surface is evaluated

  /// Throws InputError for values that make no sense.
  void validate() const;
};

/// A direction of (u, w) that the surface determines badly.
struct WeakDirection {
  std::string name;                       ///< "+0.98 EX -0.20 EB", rotations times length
  Eigen::Matrix<double, 6, 1> direction;  ///< unit, rotations times `length_mm`
  double sigma_um = 0.0;                  ///< infinite if free
};

struct ArtefactDesign {
  FitStatus status = FitStatus::NotRun;  ///< Converged: all six are determined; Degenerate: some are free
  std::string message;
  Eigen::Vector3d centroid_mm = Eigen::Vector3d::Zero();
  double length_mm = 1.0;  ///< rms distance from the centroid: makes rotations comparable with shifts
  /// Of (u, w), mm and rad; infinite where a direction is free.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  std::array<double, 6> sigma{};  ///< EX, EY, EZ in um, EA, EB, EC in urad
  std::vector<WeakDirection> weak;
  double largest_slope_x = 0.0;
  double largest_slope_y = 0.0;
  double visible_part = 0.0;  ///< of the area
};

/// Throws InputError for a surface or options that make no sense.
[[nodiscard]] ArtefactDesign designArtefact(const ArtefactSurface& surface, const ArtefactDesignOptions& options = {});

/// Closed body for milling or printing as binary STL (mm): the surface, four walls and a flat bottom `base_mm` below
/// the lowest point. Facets of about `step_mm`. Throws InputError for a step or base that makes no sense.
void writeArtefactStl(const std::filesystem::path& file, const ArtefactSurface& surface, double base_mm,
                      double step_mm);

}  // namespace spindrift
