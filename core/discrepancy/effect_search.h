// SPDX-License-Identifier: Apache-2.0
// Fits effects to a ResidualProblem by variable projection: gains linear, lags and onsets on a grid, then by line
// searches and all together.
#pragma once

#include <Eigen/Core>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "core/discrepancy/catalogue.h"
#include "core/discrepancy/residual_problem.h"

namespace spindrift {

/// One effect in one variant with its non-linear parameters.
struct ModelTerm {
  const Effect* effect = nullptr;
  EffectVariant variant;
  std::vector<double> parameters;
};

/// Some signal of the log moves it, not one that is assumed.
[[nodiscard]] bool drivenByLog(const ModelTerm& term);
/// The log lacks what drives it, and another signal of the log takes its place.
[[nodiscard]] bool drivenByStandIn(const ModelTerm& term);

/// A joint fit of several effects.
struct JointFit {
  std::vector<ModelTerm> terms;
  std::vector<Eigen::VectorXd> gains;  ///< per term: input-major, inputs x shape columns
  double chi2 = 0.0;
  double delta_chi2 = 0.0;
  int parameter_count = 0;
  double score = 0.0;
  std::vector<Eigen::VectorXd> contribution;  ///< per term over the units, um or urad
};

class EffectSearch {
 public:
  /// Part of a column that the others do not follow, below which these readings do not tell it from them: its gain is 0
  /// and not determined.
  static constexpr double dependent = 3e-4;

  EffectSearch(const ResidualProblem& problem, const DriverTable& drivers, const std::vector<Effect>& catalogue);

  [[nodiscard]] const std::vector<Effect>& catalogue() const noexcept { return *catalogue_; }
  [[nodiscard]] const Effect* find(std::string_view id) const;
  [[nodiscard]] const DriverTable& drivers() const noexcept { return *drivers_; }
  [[nodiscard]] double logN() const noexcept { return log_n_; }
  /// The grid of onsets, s.
  [[nodiscard]] const std::vector<double>& onsets() const noexcept { return onsets_; }

  /// The grid of lags, s: the same for all, or what of it lies within the bounds of the effect, and these.
  [[nodiscard]] std::vector<double> lagsOf(const Effect& effect) const { return within(effect, lags_); }
  [[nodiscard]] std::vector<double> pulseLagsOf(const Effect& effect) const { return within(effect, pulse_lags_); }
  /// Length of a pulse that does not end, s.
  [[nodiscard]] double endlessLength() const noexcept;
  /// Fills what is kept of an effect; afterwards shape() may be asked by several threads.
  void prepare(const Effect& effect) const;
  /// Response of one input over the units: lag `a` (s), `a` on and `b` off where they differ; for steps and pulses
  /// onset `a` and lag `b`. Any thread.
  [[nodiscard]] Eigen::VectorXd gridResponse(const EffectInput& input, double a, double b) const;

  /// Columns of a term over the units (not whitened).
  [[nodiscard]] Eigen::MatrixXd columns(const ModelTerm& term) const;
  /// The course of a term over the units, also of those where it does not act: response of its inputs times their gains
  /// of the shape column that is largest, scaled to mean square 1 without its mean; empty if it has no course.
  [[nodiscard]] Eigen::VectorXd course(const ModelTerm& term, const Eigen::VectorXd& gains) const;
  /// Gains at fixed non-linear parameters.
  [[nodiscard]] JointFit solve(const std::vector<ModelTerm>& terms) const;
  /// Searches over all non-linear parameters, each for itself and then together; `rounds` passes. Where all terms are
  /// admissible at the start they stay so.
  [[nodiscard]] JointFit refine(const std::vector<ModelTerm>& terms, int rounds) const;
  /// Part of the power of a load without a driver that one state alone may show: more is no load but a state that went
  /// wrong. While parameters move, up to the first; a load that has come to rest there would have shrunk to that state,
  /// so of one that is believed up to the second.
  static constexpr double most_in_one_state = 0.8;
  static constexpr double believed_in_one_state = 0.75;
  /// An asymmetric lag (s): coolant takes heat better while it flows than the air does afterwards, so what it cools
  /// comes back up to this many times slower; hardly ever quicker. Outside, a switch imitates any slow course.
  static constexpr double slowest_after = 16.0;
  static constexpr double quickest_after = 0.5;
  [[nodiscard]] static bool possibleLags(double on_s, double off_s) noexcept {
    return off_s <= slowest_after * on_s && off_s >= quickest_after * on_s;
  }
  /// Signs, origins, ratios and what was warm at the start are within what EFFECTS.md and physics allow.
  [[nodiscard]] bool admissible(const ModelTerm& term, const Eigen::VectorXd& gains,
                                double in_one_state = most_in_one_state) const;
  /// d fitted / d (non-linear parameter p) over the units, um (or urad) per s.
  [[nodiscard]] Eigen::VectorXd derivative(const ModelTerm& term, const Eigen::VectorXd& gains, std::size_t p) const;
  /// rms of prediction of epochs left out (constants from the rest of the series): without and with terms. Five
  /// blocks of neighbours.
  struct CrossValidation {
    double before_um = 0.0;
    double after_um = 0.0;
    double before_chi2 = 0.0;
    double after_chi2 = 0.0;
  };
  [[nodiscard]] CrossValidation crossValidate(const std::vector<ModelTerm>& before, const std::vector<ModelTerm>& after,
                                              const std::vector<NuisanceColumn>& base) const;

  /// Shape columns over the units.
  [[nodiscard]] const Eigen::MatrixXd& shape(const Effect& effect) const;
  [[nodiscard]] bool parameterIsLag(const ModelTerm& term, std::size_t index) const;
  [[nodiscard]] std::pair<double, double> parameterBounds(const ModelTerm& term, std::size_t index) const;

 private:
  [[nodiscard]] static std::vector<double> within(const Effect& effect, const std::vector<double>& lags);
  const ResidualProblem* problem_;
  const DriverTable* drivers_;
  const std::vector<Effect>* catalogue_;
  double log_n_ = 1.0;
  std::vector<double> lags_;
  std::vector<double> pulse_lags_;
  std::vector<double> onsets_;
  mutable std::mutex mutex_;
  mutable std::map<std::tuple<std::string, int, double, double>, Eigen::VectorXd> responses_;
  mutable std::map<std::pair<std::string, std::size_t>, Eigen::MatrixXd> shapes_;  ///< by id and form
};

}  // namespace spindrift
