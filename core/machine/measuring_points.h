// SPDX-License-Identifier: Apache-2.0
// Where to put N fiducials: optimal choice among candidate positions for the nine-parameter model.
//
// Each position gives EX, EY, EZ with the uncertainties sigma_xy and sigma_z. D-optimal: the largest determinant of the
// information matrix M = sum S^T S / sigma^2 (smallest volume of the confidence region of the parameters). I-optimal:
// the smallest mean variance of the prediction over the table. All choices are tried where that is feasible, else
// one position after the other is exchanged for the best other one from several starts (Fedorov 1972; Cook and
// Nachtsheim 1980; Atkinson, Donev, Tobias 2007, ch. 12). The criterion alone puts
// positions side by side where one would do: they keep a distance, so that a disturbed place does not count twice.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/base/job_context.h"

namespace spindrift {

enum class PlacementCriterion { D, I };

struct PlacementOptions {
  int count = 4;                   ///< positions to choose, fixed ones included; >= 3
  std::vector<std::size_t> fixed;  ///< indices of candidates that must be in
  PlacementCriterion criterion = PlacementCriterion::I;
  double sigma_xy_um = 0.5;
  double sigma_z_um = 1.0;
  Eigen::Vector2d region_from_mm = Eigen::Vector2d::Zero();  ///< table over which the prediction is wanted
  Eigen::Vector2d region_to_mm = Eigen::Vector2d::Zero();
  /// Two chosen positions are at least so far apart, mm; fixed ones stay where they are. Empty: a tenth of the diagonal
  /// of the region, or less (half of it up to four times, then none) where no choice keeps it.
  std::optional<double> least_distance_mm;
  std::size_t exhaustive_limit = 200000;  ///< try all choices if there are not more than this
  int starts = 24;                        ///< of the exchange
  std::uint64_t seed = 1;

  /// Throws InputError.
  void validate(std::size_t candidates) const;
};

struct PlacementResult {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  std::vector<std::size_t> chosen;  ///< indices of candidates, ascending
  bool exhaustive = false;          ///< all choices were tried: the optimum is certain
  double least_distance_mm = 0.0;   ///< of any two of the chosen, fixed ones too
  double log_det = 0.0;             ///< ln det of the information matrix (um, urad, um/m)
  double mean_sigma_um = 0.0;       ///< root of the mean variance of ex, ey, ez over the region
  double largest_sigma_um = 0.0;    ///< largest standard uncertainty of a component over the region
  Eigen::VectorXd parameter_sigma;  ///< of the nine parameters
};

/// `candidates_mm`: positions on the table. Degenerate if no choice determines all nine parameters or keeps the
/// distance that was asked for.
[[nodiscard]] PlacementResult chooseMeasuringPoints(const std::vector<Eigen::Vector3d>& candidates_mm,
                                                    const PlacementOptions& options, const JobContext& job);

}  // namespace spindrift
