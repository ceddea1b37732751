// SPDX-License-Identifier: Apache-2.0
// How much a set of readings would tell between candidates, before it is made. Internal to core/discrepancy.
//
// Every candidate i predicts the readings y of a plan by a normal distribution,
//
//   y | i ~ N(m_i, J_i J_i' + R),
//
// J_i: how they move with its gains and lags, one column for each direction of what is not known of them, of unit
// variance; R: noise as it was found, the shift common to all points of a state, and what a machine differs from any
// formula, in part of the amplitude. Every series has a free constant, so that new points and a new reference are
// allowed. Candidates belong to groups (effects; drivers and dynamics of one effect are candidates of one group).
// All that decides is in the Gram matrix of the columns (J_1, m_1, J_2, m_2, ...) whitened by R, which is small.
//
// What remains unknown of the group after the readings is bounded with Bhattacharyya distances B,
//
//   H <= sum_i p_i ln [ sum_j p_j exp(-B_ij) / sum_{j in the group of i} p_j exp(-B_ij) ].
//
// Sources: Lindley 1956 (information of an experiment); Kailath 1967 (Bhattacharyya distance); Kolchinsky and Tracey
// 2017 (entropy of mixtures from pairwise distances); Harville 1974 (free constants).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace spindrift {

/// One candidate among the columns.
struct DesignCandidate {
  int group = 0;
  double probability = 0.0;  ///< of all candidates together 1
  Eigen::Index first = 0;    ///< its first column
  Eigen::Index free = 0;     ///< so many columns J; m follows them
};

/// Noise of the readings of one component.
struct DesignNoise {
  double own = 1.0;     ///< standard deviation of one reading, um or urad
  double common = 0.0;  ///< of the shift of a state
  double correlated_part = 0.0;
  double correlation_time_s = 0.0;
  Eigen::MatrixXd misfit;  ///< over the times: standard deviations of what formulas miss, one column each
};

class MeasurementDesign {
 public:
  /// `predicted[component][place]`: times x columns, um or urad; an empty matrix: nothing moves there.
  MeasurementDesign(std::vector<DesignCandidate> candidates, std::vector<double> times_s,
                    std::vector<DesignNoise> noise, std::vector<std::vector<Eigen::MatrixXd>> predicted);

  [[nodiscard]] std::size_t placeCount() const noexcept { return predicted_.empty() ? 0 : predicted_[0].size(); }
  [[nodiscard]] const std::vector<double>& times() const noexcept { return times_s_; }

  /// Gram matrix when all `places` are measured at all `times` (indices).
  [[nodiscard]] Eigen::MatrixXd gram(const std::vector<std::size_t>& places,
                                     const std::vector<std::size_t>& times) const;
  /// Of the group, as it stands, nats.
  [[nodiscard]] double entropy() const;
  /// The bound above, nats.
  [[nodiscard]] double remainingEntropy(const Eigen::MatrixXd& gram) const;
  /// Twice the expected logarithm of the odds of candidate `right` to `wrong`, if `right` is right.
  [[nodiscard]] double expectedEvidence(const Eigen::MatrixXd& gram, std::size_t right, std::size_t wrong) const;
  /// How often the right group ends with all others below `least_rival` of its probability, by drawing readings.
  [[nodiscard]] double probabilityAlone(const Eigen::MatrixXd& gram, double least_rival, int draws,
                                        std::uint64_t seed) const;

 private:
  std::vector<DesignCandidate> candidates_;
  std::vector<double> times_s_;
  std::vector<DesignNoise> noise_;
  std::vector<std::vector<Eigen::MatrixXd>> predicted_;
  Eigen::Index columns_ = 0;
};

}  // namespace spindrift
