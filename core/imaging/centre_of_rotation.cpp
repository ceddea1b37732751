// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/centre_of_rotation.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/math/distributions.h"
#include "core/math/least_squares.h"

namespace spindrift {
namespace {

/// Columns: s of every set, then the centres, numbered by `centre_of`.
LinearFitResult solveWith(const std::vector<RotationSet>& sets, const std::vector<int>& centre_of, int centres) {
  Eigen::Index rows = 0;
  for (const RotationSet& set : sets) rows += 2 * static_cast<Eigen::Index>(set.images.size());
  const auto n = static_cast<Eigen::Index>(sets.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, 2 * n + 2 * centres);
  Eigen::VectorXd y(rows);
  Eigen::Index row = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    for (const RotationImage& image : sets[static_cast<std::size_t>(k)].images) {
      A.block<2, 2>(row, 2 * k).setIdentity();
      A.block<2, 2>(row, 2 * n + 2 * centre_of[static_cast<std::size_t>(k)]) = -image.pose.patternPerPixel();
      y.segment<2>(row) = image.pose.patternAt(Eigen::Vector2d::Zero()) - image.offset_um;
      row += 2;
    }
  }
  return solveLinear(A, y, Eigen::VectorXd::Ones(rows), {.rank_tolerance = 1e-9});
}

std::vector<int> numbering(const std::vector<RotationSet>& sets, CentrePooling pooling, int& centres) {
  std::vector<int> number(sets.size(), 0);
  std::vector<std::string> states;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    if (pooling == CentrePooling::PerSet) {
      number[k] = static_cast<int>(k);
    } else if (pooling == CentrePooling::PerState) {
      auto found = std::find(states.begin(), states.end(), sets[k].state);
      if (found == states.end()) found = states.insert(states.end(), sets[k].state);
      number[k] = static_cast<int>(found - states.begin());
    }
  }
  centres = number.empty() ? 0 : *std::max_element(number.begin(), number.end()) + 1;
  return number;
}

/// p-value of the pooled fit against the freer one. The variance carries what is known of the spindle beforehand.
double poolingTest(const LinearFitResult& pooled, const LinearFitResult& freer, const CentreOptions& options) {
  const int restrictions = pooled.degrees_of_freedom - freer.degrees_of_freedom;
  if (restrictions <= 0) return 1.0;
  const double dof = options.expected_weight + freer.degrees_of_freedom;
  if (!(dof > 0.0)) return 1.0;
  const double variance =
      (options.expected_weight * options.expected_repeatability_um * options.expected_repeatability_um + freer.chi2) /
      dof;
  return fisherTail(std::max(0.0, pooled.chi2 - freer.chi2) / restrictions / variance, restrictions, dof);
}

/// Where every mark that all images show was measured in each of them: undistorted, about c, without the commanded
/// offset. Empty with fewer than three images.
std::vector<std::vector<Eigen::Vector2d>> measuredTracks(const RotationSet& set) {
  if (set.images.size() < 3) return {};
  const auto key = [](const MarkPosition& mark) {
    return std::pair(std::lround(mark.pattern_um.x()), std::lround(mark.pattern_um.y()));
  };
  std::map<std::pair<long, long>, std::vector<Eigen::Vector2d>> of_mark;
  for (const RotationImage& image : set.images) {
    const Eigen::Matrix2d pixel_per_um = image.pose.patternPerPixel().inverse();
    for (const MarkPosition& mark : image.marks) {
      of_mark[key(mark)].push_back(image.pose.undistorted(mark.pixel) + pixel_per_um * image.offset_um);
    }
  }
  std::vector<std::vector<Eigen::Vector2d>> tracks;
  for (auto& [mark, track] : of_mark) {
    if (track.size() == set.images.size()) tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace

std::string_view toString(CentrePooling pooling) noexcept {
  switch (pooling) {
    case CentrePooling::All:
      return "one centre for all";
    case CentrePooling::PerState:
      return "one centre per state";
    case CentrePooling::PerSet:
      return "one centre per fiducial and state";
  }
  return "";
}

void CentreOptions::validate() const {
  if (!(expected_repeatability_um > 0.0) || !(expected_weight >= 0.0)) {
    throw InputError(
        "the expected repeatability of the spindle must be greater than 0 µm and its weight not negative.");
  }
  if (!(test_level > 0.0 && test_level < 1.0)) {
    throw InputError(fmt::format("test level {} is not allowed; allowed: between 0 and 1.", test_level));
  }
}

CentreResult fitCentreOfRotation(const std::vector<RotationSet>& sets, const CentreOptions& options) {
  options.validate();
  CentreResult result;
  if (sets.empty()) {
    result.status = FitStatus::Degenerate;
    result.message = "there is no set of images with the spindle turned";
    return result;
  }
  for (const RotationSet& set : sets)
    SPINDRIFT_ASSERT(set.images.size() >= 2, "a rotation set has at least two images");
  int centres_all = 0;
  int centres_state = 0;
  int centres_set = 0;
  const std::vector<int> all = numbering(sets, CentrePooling::All, centres_all);
  const std::vector<int> per_state = numbering(sets, CentrePooling::PerState, centres_state);
  const std::vector<int> per_set = numbering(sets, CentrePooling::PerSet, centres_set);
  const LinearFitResult fit_all = solveWith(sets, all, centres_all);
  const LinearFitResult fit_state = solveWith(sets, per_state, centres_state);
  const LinearFitResult fit_set = solveWith(sets, per_set, centres_set);
  if (!fit_all.usable()) {
    result.status = FitStatus::Degenerate;
    result.message = "the images do not show different spindle orientations";
    return result;
  }
  result.p_value_per_state = poolingTest(fit_state, fit_set, options);
  result.p_value_all = poolingTest(fit_all, fit_state, options);
  const bool state_holds = result.p_value_per_state >= options.test_level && fit_state.usable();
  const bool all_holds = result.p_value_all >= options.test_level;
  const LinearFitResult* fit = &fit_all;
  const std::vector<int>* number = &all;
  result.pooling = CentrePooling::All;
  if (!state_holds && fit_set.usable()) {
    fit = &fit_set;
    number = &per_set;
    result.pooling = CentrePooling::PerSet;
  } else if (!all_holds && fit_state.usable()) {
    fit = &fit_state;
    number = &per_state;
    result.pooling = CentrePooling::PerState;
  }
  const double weight = options.expected_weight;
  const double prior = options.expected_repeatability_um * options.expected_repeatability_um;
  result.degrees_of_freedom = weight + fit->degrees_of_freedom;
  const double variance = (weight * prior + fit->chi2) / std::max(result.degrees_of_freedom, 1.0);
  result.repeatability_um = std::sqrt(variance);
  const auto n = static_cast<Eigen::Index>(sets.size());
  result.covariance = variance * fit->covariance.topLeftCorner(2 * n, 2 * n);
  Eigen::Index row = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const RotationSet& set = sets[static_cast<std::size_t>(k)];
    const ImagePose& first = set.images.front().pose;
    SetCentre centre;
    centre.fiducial = set.fiducial;
    centre.state = set.state;
    const Eigen::Index q = 2 * n + 2 * (*number)[static_cast<std::size_t>(k)];
    centre.centre_px = first.distorted(fit->x.segment<2>(q));
    centre.centre_sigma_px = (variance * fit->covariance.block<2, 2>(q, q).diagonal()).cwiseSqrt();
    centre.place_um = fit->x.segment<2>(2 * k);
    centre.place_sigma_um = std::sqrt(0.5 * result.covariance.block<2, 2>(2 * k, 2 * k).trace());
    centre.own_place_sigma_um = std::sqrt(variance / static_cast<double>(set.images.size()));
    if (fit_set.usable()) {
      const Eigen::Index own = 2 * n + 2 * k;
      centre.own_centre_px = first.distorted(fit_set.x.segment<2>(own));
      centre.own_centre_sigma_px = std::sqrt(variance * 0.5 * fit_set.covariance.block<2, 2>(own, own).trace());
    } else {
      centre.own_centre_px = centre.centre_px;
      centre.own_centre_sigma_px = centre.centre_sigma_px.mean();
    }
    const auto rows = 2 * static_cast<Eigen::Index>(set.images.size());
    centre.rms_um = std::sqrt(fit->residuals.segment(row, rows).squaredNorm() / static_cast<double>(rows));
    row += rows;
    const auto tracks = measuredTracks(set);
    centre.algebraic_tracks = static_cast<int>(tracks.size());
    if (!tracks.empty()) centre.algebraic_centre_px = first.distorted(algebraicCentre(tracks));
    result.sets.push_back(centre);
  }
  result.status = FitStatus::Converged;
  result.message = std::string(toString(result.pooling));
  return result;
}

Eigen::Vector2d algebraicCentre(const std::vector<std::vector<Eigen::Vector2d>>& tracks) {
  Eigen::Index rows = 0;
  for (const auto& track : tracks) rows += static_cast<Eigen::Index>(track.size());
  const auto n = static_cast<Eigen::Index>(tracks.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, 2 + n);
  Eigen::VectorXd b(rows);
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (const Eigen::Vector2d& p : tracks[static_cast<std::size_t>(i)]) {
      A.block<1, 2>(row, 0) = -2.0 * p.transpose();
      A(row, 2 + i) = 1.0;
      b(row) = -p.squaredNorm();
      ++row;
    }
  }
  return solveLinear(A, b, Eigen::VectorXd::Ones(rows)).x.head<2>();
}

}  // namespace spindrift
