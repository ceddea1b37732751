// SPDX-License-Identifier: Apache-2.0
// The proof after compensating: the same plan measured again with the control compensating, beside the measurement from
// before, judged against the goal the user set.
//
// Deviations hold up to a constant per point and component, so both campaigns are compared as changes from their own
// first state: d(state) = value(state) - value(first state), with the uncertainty of both. Only points, components and
// states that both have are compared; what is missing on one side is told. States are the same by their names, and by
// their order where the campaigns share no name; the first one before is the zero of both, taken with compensation or
// without. Per component: rms with the measuring
// noise taken out (rms^2 = mean d^2 - mean u^2, its uncertainty from the scatter that noise gives a mean square; of one
// value alone the value itself, so that the rms is never above the largest and equals it there), the
// largest |d| with its own uncertainty. Decision rule of ISO 14253-1: met if value + U <= goal, not met if value - U >
// goal, else it cannot be decided (U = 2 standard uncertainties). Units um and urad.
// Failure: InputError if nothing can be compared or the zero is missing, if before and after are the same data, or if a
// goal is not positive.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/machine/campaign.h"

namespace spindrift {

enum class VerifyVerdict { Met, NotMet, Undecided, NotJudged };
[[nodiscard]] std::string_view toString(VerifyVerdict verdict) noexcept;
enum class VerifyCriterion { Largest, Rms };

struct VerifyRequest {
  double goal_um = 5.0;
  double goal_urad = 0.0;  ///< 0: rotations are shown and not judged
  VerifyCriterion criterion = VerifyCriterion::Largest;
  /// Throws InputError.
  void validate() const;
};

/// rms, and the largest value with where it is.
struct VerifyFigures {
  double rms = 0.0;
  double rms_sigma = 0.0;
  double largest = 0.0;
  double largest_sigma = 0.0;
  std::string largest_at;  ///< "F1, M2"
};

struct VerifyComponent {
  Component component = Component::EX;
  std::size_t values = 0;  ///< compared
  VerifyFigures before;
  VerifyFigures after;
  VerifyVerdict verdict = VerifyVerdict::NotJudged;
};

/// Causes of the noise of a change, which are independent of each other: the number of each, and what one standard
/// deviation of it does to the change (um or urad). Changes that share a cause are correlated by it: the first state of
/// a series, what all rows of an evaluation are compared with. The squares sum up to the variance of the change.
using NoiseCauses = std::vector<std::pair<std::size_t, double>>;

/// One compared value: change from the first state, before and after.
struct VerifyPoint {
  std::string point;
  std::string state;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Component component = Component::EX;
  double before = 0.0;
  double before_sigma = 0.0;
  double after = 0.0;
  double after_sigma = 0.0;
  double c_deg = 0.0;  ///< angle of the table
  NoiseCauses before_causes, after_causes;
};

/// rms with the measuring noise taken out, and the largest |value|, of some compared values (um or urad). With C the
/// covariance of the n changes, m of them without noise, this adds tr(C) / n to the mean square, whose variance is
/// (2 tr(C^2) + 4 m'C m) / n^2 (of normal noise; Mathai and Provost 1992, Quadratic forms in random variables).
[[nodiscard]] VerifyFigures verifyFigures(const std::vector<const VerifyPoint*>& points, bool after);

struct VerifyResult {
  VerifyRequest request;
  /// In the unit of the component; 0: none.
  [[nodiscard]] double goal(Component component) const {
    return isRotation(component) ? request.goal_urad : request.goal_um;
  }
  std::vector<VerifyComponent> components;
  std::vector<VerifyPoint> points;
  VerifyVerdict verdict = VerifyVerdict::Undecided;
  std::string reason;  ///< one sentence
  std::vector<std::string> notes;

  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
};

/// Of one component at a point, over the states, with the table at one angle.
struct VerifyPointFigures {
  std::string point;
  VerifyFigures before, after;
};
/// Of every point measured with the table at `c_deg` (deg), in the order of the result: at another angle the point is
/// elsewhere on the table and its values are others.
[[nodiscard]] std::vector<VerifyPointFigures> verifyFiguresOfPoints(const VerifyResult& result, Component component,
                                                                    double c_deg);

/// Observations marked `exclude` take no part. Rows may stand in any order.
[[nodiscard]] VerifyResult verifyCompensation(const ObservationSet& before, const ObservationSet& after,
                                              const VerifyRequest& request);

/// The same for campaigns: of `before` what was taken while compensating is left out; of `after` only what was taken
/// while compensating counts if its log says when that was, else a note says that nothing proves it. One campaign may
/// be both.
[[nodiscard]] VerifyResult verifyCampaigns(const Campaign& before, const ObservationSet& before_observations,
                                           const Campaign& after, const ObservationSet& after_observations,
                                           const VerifyRequest& request);

}  // namespace spindrift
