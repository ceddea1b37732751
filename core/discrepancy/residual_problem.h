// SPDX-License-Identifier: Apache-2.0
// The residual observation - simulation as a whitened least-squares problem with its nuisances.
//
//   r = constant(series) + nuisances + X beta + shift(component, state) + e
//   cov(e) = s_i s_j sigma_i sigma_j [(1 - a) (rho_ij + delta_ij (1 / w_i - 1)) + a exp(-|dt| / T) within a series]
//   shift(component, state), the same for all points of a state: re-referencing, refocus, re-zeroing, an instrument
//   that drifts; cov(shift_k, shift_l) = common^2 [(1 - b) delta_kl + b exp(-|dt| / T_b) / v]
//
// v: what exp(-|dt| / T_b) varies about its mean over the states, so that b is the part of the variance of shifts about
// their mean that drifts, however slowly: what they have in common besides shows nowhere where constants are free.
// s, a, T, common, b and T_b are one set for each component ((1 - a) between two: the root of both); w_i <= 1 is the
// weight of a reading in a noise with heavy tails: what it adds is own noise. rho: correlations of what observations
// share (SharedNoise), carried over to the units, 1 for i = j; so cov(e) is positive semidefinite whatever the
// parameters. Factors that many series share stand beside the blocks of series as a part of low rank, like the shifts.
//
// A unit is one observation, or, where there are very many, the mean of neighbours: of points close to each other in
// one state where places do not change, else of readings of one series in states that follow each other. Drivers are
// averaged over the same times and shapes over the same points, so this loses only what differs inside a bin. Units are
// ordered by component, series and time. Vectors "projected" are whitened, have one extra row for each prior, and are
// orthogonal to all nuisances. Sources: Sherman and Morrison 1950, Woodbury 1950 (covariance plus a part of low rank).
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/machine/effect.h"

namespace spindrift {

/// Standard deviation of the shifts of states over that of the own noise of a reading that an instrument makes at most:
/// of shifts that follow each other in time, as it drifts, and of those that do not, as it is re-referenced, refocused
/// or zeroed again, which nothing that heats a machine looks like. What shifts states by clearly more is no noise.
/// Where all three axes drift it is the instrument's more surely, for no effect does that, and the limit is wider.
inline constexpr double largest_drift_shift = 0.8;
inline constexpr double largest_drift_of_all = 1.4;
inline constexpr double largest_reference_shift = 2.0;
/// Standard deviation of what states and neighbours in time have in common over that of the own noise of a reading from
/// which on an effect is looked for in its place: estimates of both are far off while an effect is not known.
inline constexpr double doubtful_common = 0.4;

/// Noise of one component.
struct ComponentNoise {
  double scale = 1.0;               ///< own noise of a reading: actual / stated sigma
  double scale_uncertainty = 0.0;   ///< standard uncertainty of the scale
  double common = 0.0;              ///< standard deviation of the shifts of states about their mean, um or urad
  double correlated_part = 0.0;     ///< a, 0 ... 1
  double correlation_time_s = 0.0;  ///< T
  double tail_dof = 0.0;            ///< degrees of freedom of the Student distribution of the own noise; 0: normal
  double gross_part = 0.0;          ///< of the readings: gross errors, which may be anywhere; 0: none
  double gross_density = 0.0;       ///< of these, at any deviation over the stated sigma
  double drift_part = 0.0;          ///< b, 0 ... 1: of the variance of shifts, what follows itself in time
  double drift_time_s = 0.0;        ///< T_b
  double largest_drift = largest_drift_shift;  ///< what an instrument drifts by at most, over the own noise

  /// Variance of the shifts of states beyond what an instrument makes whose readings scatter by `own` (standard
  /// deviation, um or urad).
  [[nodiscard]] double shiftsBeyond(double own) const noexcept;
  /// Variance of the own noise over the square of its scale, 1 if it is normal.
  [[nodiscard]] double varianceOfStudent() const noexcept;
  /// The same as far as it is noise: what outliers make of it, of very heavy tails not all.
  [[nodiscard]] double varianceOfTails() const noexcept;
};

struct NoiseModel {
  std::array<ComponentNoise, 6> component;
  Eigen::VectorXd weight;  ///< of every unit, 0 < w <= 1; empty: 1

  [[nodiscard]] const ComponentNoise& of(Component c) const { return component[static_cast<std::size_t>(c)]; }
  [[nodiscard]] ComponentNoise& of(Component c) { return component[static_cast<std::size_t>(c)]; }
  /// Degrees of freedom of the heaviest tails of a component; 0: all are normal.
  [[nodiscard]] double heaviestTails() const noexcept;
};

/// Lower Cholesky factor of the covariances of shifts at the times `time_s` over common^2 (see above): shifts are
/// `common` times the factor times independent ones.
[[nodiscard]] Eigen::MatrixXd shiftFactor(const std::vector<double>& time_s, double drift_part, double drift_time_s);

/// A nuisance column over the units; prior_sigma = 0: free, else standard deviation of its coefficient.
struct NuisanceColumn {
  Eigen::VectorXd values;
  double prior_sigma = 0.0;
  bool relative = false;  ///< its coefficient is a relative error of the simulation
};

/// Units of a problem: what the search can hold at once, however many readings there are; of few points up to three
/// times as many.
inline constexpr std::size_t most_units = 3000;

class ResidualProblem {
 public:
  /// `rows` are the observations that may be used (matched, fit). At most about `unit_limit` units. `input` has to
  /// outlive the problem.
  ResidualProblem(const DiscrepancyInput& input, const std::vector<std::size_t>& rows, std::size_t unit_limit);

  [[nodiscard]] Eigen::Index size() const noexcept { return static_cast<Eigen::Index>(y.size()); }
  [[nodiscard]] int seriesCount() const noexcept { return static_cast<int>(series_begin.size()) - 1; }

  std::vector<DeviationQuery> place;
  std::vector<Component> component;
  std::vector<int> series;                 ///< of each unit
  std::vector<Eigen::Index> series_begin;  ///< first unit of each series, and the end
  /// Points that can be told from their neighbours: all, or, where neighbours were merged, those that moved alone.
  std::vector<std::string> own_points;
  std::vector<std::string> series_point;  ///< the point of a series; of several points that are one unit: the first
  std::vector<double> time_s;             ///< mean time
  /// Neighbourhood of each unit in which an effect may have another size: its series; where places were measured once
  /// each, the units of its component nearby; where points were merged, a few series nearby, for an effect is off in
  /// space as smoothly as bodies deform, however many points show it.
  std::vector<int> neighbourhood;
  int neighbourhood_count = 0;
  std::vector<int> epoch;  ///< index of the thermal state (or time bin)
  int epoch_count = 0;
  bool epochs_are_states = false;
  std::vector<double> epoch_time_s;
  Eigen::VectorXd y;                                ///< residual, um or urad
  Eigen::VectorXd simulated;                        ///< um or urad
  Eigen::VectorXd sigma;                            ///< stated, with what is shared
  Eigen::VectorXd reading_sigma;                    ///< the same of one reading, where a unit is the mean of many
  std::vector<double> node_time_s;                  ///< distinct times at which drivers are needed, increasing
  std::vector<std::vector<std::size_t>> unit_rows;  ///< the observations that each unit is the mean of
  /// Mean of values at the nodes over the times of every unit.
  [[nodiscard]] Eigen::VectorXd toUnits(const Eigen::VectorXd& at_nodes) const;
  /// Shape columns over the units, averaged over the points of each.
  [[nodiscard]] Eigen::MatrixXd shapeAtUnits(const Effect& effect) const;

  /// As estimated. Residuals are whitened with shifts that drift no further than instruments do: what is beyond stays
  /// to be explained.
  NoiseModel noise;
  void setNoise(const NoiseModel& model);
  /// Sets all nuisances besides the constants; recomputes the projected residual.
  void setNuisances(const std::vector<NuisanceColumn>& columns);
  [[nodiscard]] const std::vector<NuisanceColumn>& nuisances() const noexcept { return nuisances_; }
  /// ln det(I + S N' P N S) of the whitened nuisances N free of the constants, with their prior standard deviations S:
  /// what their freedom costs in evidence, to compare one set of priors with another under the same noise.
  [[nodiscard]] double nuisanceLogDeterminant() const noexcept { return nuisance_log_det_; }

  /// Whitened, augmented and orthogonal to the constants.
  [[nodiscard]] Eigen::MatrixXd freeOfConstants(const Eigen::MatrixXd& columns) const;
  /// Whitened, augmented and orthogonal to all nuisances.
  [[nodiscard]] Eigen::MatrixXd projected(const Eigen::MatrixXd& columns) const;
  [[nodiscard]] const Eigen::VectorXd& projectedResidual() const noexcept { return projected_y_; }
  [[nodiscard]] Eigen::MatrixXd whitened(const Eigen::MatrixXd& columns) const;
  [[nodiscard]] int degreesOfFreedom() const noexcept;
  /// What the nuisances besides the constants take of `values` (um or urad, over the units), and what their priors
  /// charge for it (chi-squared).
  struct NuisancePart {
    Eigen::VectorXd values;
    double price = 0.0;
    std::vector<double> coefficients;
    std::vector<double> variances;  ///< of the coefficients, under their priors
  };
  [[nodiscard]] NuisancePart nuisancePart(const Eigen::VectorXd& values) const;
  /// The residual without these parts.
  [[nodiscard]] Eigen::VectorXd without(const std::vector<Eigen::VectorXd>& parts) const {
    Eigen::VectorXd left = y;
    for (const Eigen::VectorXd& part : parts) left -= part;
    return left;
  }
  /// Rows of priors in a projected vector.
  [[nodiscard]] Eigen::Index priorRows() const noexcept { return prior_rows_; }
  /// Own noise of every unit as one standard deviation, without the common shift and before weights.
  [[nodiscard]] double ownSigma(Eigen::Index unit) const {
    return sigma[unit] * noise.of(component[static_cast<std::size_t>(unit)]).scale;
  }

  /// Rows that are coupled by noise: contiguous, one component each unless shared noise joins several.
  struct Domain {
    Eigen::Index from = 0;
    Eigen::Index count = 0;
  };
  [[nodiscard]] const std::vector<Domain>& domains() const noexcept { return domains_; }
  /// Whitened columns of one domain without the free constants; `columns` has the domain's rows only.
  [[nodiscard]] Eigen::MatrixXd withoutConstants(std::size_t domain, const Eigen::MatrixXd& columns) const;
  /// Deviations from the mean of each series, where constants are free; um or urad, not whitened.
  [[nodiscard]] Eigen::VectorXd centred(Eigen::VectorXd values) const;
  /// Orthonormal basis of the nuisances besides the constants (all rows, then the priors).
  [[nodiscard]] const Eigen::MatrixXd& nuisanceBasis() const noexcept { return q_; }
  /// The columns of a basis that are not zero in a domain, and their rows there.
  struct BasisPart {
    std::vector<Eigen::Index> columns;
    Eigen::MatrixXd rows;
  };
  [[nodiscard]] const std::vector<BasisPart>& nuisanceParts() const noexcept { return q_parts_; }  ///< one a domain
  /// The same of any basis over the units (and whatever rows follow them).
  [[nodiscard]] std::vector<BasisPart> partsOf(const Eigen::MatrixXd& basis) const;
  /// What is not one of the free constants: observations stand for deviations from themselves (false: absolute).
  bool free_constants = true;

  /// The nuisances that belong to the simulation: its gain per component within `gain_uncertainty`, and as much for
  /// the parts it is made of in space and time and for its lags.
  [[nodiscard]] std::vector<NuisanceColumn> simulationNuisances(double gain_uncertainty) const;
  /// Rate of values over the units, from state to state of every series, per s.
  [[nodiscard]] Eigen::VectorXd ratePerSecond(const Eigen::VectorXd& values) const;

 private:
  struct Block {
    std::vector<Eigen::Index> units;
    Eigen::MatrixXd whitener;  ///< inverse of the lower Cholesky factor; empty: diagonal
  };
  /// x - columns weight columns' x: a part of low rank is taken out of x. Every row of the columns has few entries, for
  /// a reading belongs to one state and one series.
  struct LowRank {
    Eigen::SparseMatrix<double> columns;
    Eigen::MatrixXd weight;
    void takeOutOf(Eigen::Ref<Eigen::MatrixXd> x) const;
  };
  struct DomainNoise {
    LowRank shifts;                ///< what shifts of states and factors of many series add to the own noise
    LowRank shifts_and_constants;  ///< the same, and then the whitened constants
    Eigen::Index constant_count = 0;
  };
  /// Loads of one cause in order of units, um or urad.
  struct UnitLoad {
    Eigen::Index unit = 0;
    double load = 0.0;
  };
  using UnitFactor = std::vector<UnitLoad>;
  /// Series that factors couple: their units, and what these share (the diagonal is not used), um^2.
  struct Coupled {
    std::vector<Eigen::Index> units;
    Eigen::MatrixXd covariance;
  };
  /// Column of the shift of a component in a state.
  using ShiftColumns = std::map<std::pair<int, int>, Eigen::Index>;
  void makeNeighbourhoods();
  void takeShared(const SharedNoise& shared, const std::vector<Eigen::Index>& unit_of_row);
  void makeDomains();
  void makeCoupled();
  void makeBlocks();
  /// Part of the stated noise that follows itself in time (a), 0 ... 1.
  [[nodiscard]] double slowPart(Eigen::Index unit) const;
  /// How the shifts of states follow each other in time: they are the factor times independent ones (its first rows and
  /// columns; identity where they do not).
  void takeDrift(const NoiseModel& drifts, const ShiftColumns& shifts, Eigen::MatrixXd& factor) const;
  /// Shifts of the states and factors of many series in one domain.
  [[nodiscard]] LowRank shiftsOf(std::size_t domain, const NoiseModel& drifts) const;
  /// By the own noise alone, without the shifts.
  void whitenOwn(std::size_t domain, Eigen::Ref<Eigen::MatrixXd> rows) const;
  void whitenDomain(std::size_t domain, Eigen::Ref<Eigen::MatrixXd> rows) const;
  const std::vector<Observation>* observations_ = nullptr;  ///< of the input, which outlives the problem
  /// What a unit takes of the value at a node: neighbours that were merged have one time, or a few.
  struct NodeWeight {
    int node = 0;
    double weight = 1.0;
  };
  std::vector<std::size_t> node_begin_;
  std::vector<NodeWeight> node_weights_;
  std::vector<std::vector<DeviationQuery>> members_;  ///< of each series, where points were merged; else empty
  std::vector<UnitFactor> shared_;
  std::vector<Coupled> coupled_;
  Eigen::MatrixXd wide_;           ///< units x factors that many series share, um or urad
  Eigen::VectorXd wide_variance_;  ///< of each unit
  std::vector<Domain> domains_;
  std::vector<DomainNoise> domain_noise_;
  std::vector<std::vector<Block>> blocks_;  ///< per domain
  Eigen::VectorXd diagonal_whitener_;
  std::vector<NuisanceColumn> nuisances_;
  Eigen::Index prior_rows_ = 0;
  double nuisance_log_det_ = 0.0;
  Eigen::MatrixXd q_;  ///< orthonormal basis of the nuisances, augmented
  std::vector<BasisPart> q_parts_;
  Eigen::VectorXd projected_y_;
};

/// Standard deviations of the own noise from which on a reading is an outlier.
inline constexpr double far_off = 5.0;

/// The part of deviations that lies more than `far_off` standard deviations of the others out, where half may lie out:
/// the scatter of the others is taken from the smallest quarter of all, half of the better half. Normal readings alone
/// bring 0.02, heavy tails less than 0.1.
[[nodiscard]] double partFarOff(std::vector<double> deviations);

/// Maximum restricted likelihood of scale, common shift, correlation and tails of every component, while whatever
/// `residual` (um or urad, over the units) still holds of smooth courses in time with simple patterns in space is free
/// with a prior whose size is estimated as well. Deterministic.
/// Where more readings lie far off than tails bring, a part of them is gross errors that may be anywhere.
/// Sources: Patterson and Thompson 1971 (REML); Lange, Little and Taylor 1989 (Student-t weights); Box and Tiao 1968
/// (gross errors as a mixture).
[[nodiscard]] NoiseModel estimateNoise(const ResidualProblem& problem, const Eigen::VectorXd& residual, bool fitted);

/// Components in which `noise` shifts states by more than an instrument does.
[[nodiscard]] std::vector<Component> movedTogether(const ResidualProblem& problem, const NoiseModel& noise);
/// Those in which what states and neighbours in time have in common is more than `doubtful_common` readings' scatter.
[[nodiscard]] std::vector<Component> doubtfulNoise(const ResidualProblem& problem, const NoiseModel& noise);

/// True if all axes drift, so that larger drifts are the instrument's (largest_drift_of_all).
[[nodiscard]] bool driftsOfAll(const NoiseModel& noise);
/// `noise` with drifts no larger than an instrument makes them.
[[nodiscard]] NoiseModel asInstrumentsDrift(const ResidualProblem& problem, NoiseModel noise);

/// How probable a residual of one component is under noise that is made as large as it needs: -2 ln of the restricted
/// likelihood for every size of the shifts of states, the last without any; one value where states cannot be shifted.
struct NoiseProfile {
  std::vector<double> with_unknown;  ///< a smooth remainder and courses of single series beside the noise, as needed
  std::vector<double> noise_alone;   ///< nothing beside the noise, and no larger shifts than re-referencing makes
  bool told_apart = true;            ///< false: too few readings for anything smooth, both are the same
};
using NoiseProfiles = std::array<NoiseProfile, 6>;

/// Of the components in `which`, at the weights of the problem's noise; the others stay empty.
[[nodiscard]] NoiseProfiles noiseProfiles(const ResidualProblem& problem, const Eigen::VectorXd& residual,
                                          const std::array<bool, 6>& which);

/// -2 ln of the likelihood of all components together, the sizes of their shifts averaged over: what shifts a state
/// belongs to the instrument (re-referencing, refocus), so the components of one unit have shifts of about one size, or
/// none. `profile`: which of the two; components without one are left out.
[[nodiscard]] double jointDeviance(const NoiseProfiles& profiles, std::vector<double> NoiseProfile::*profile);

}  // namespace spindrift
