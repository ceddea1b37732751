// SPDX-License-Identifier: Apache-2.0
// Fits effects to a ResidualProblem by variable projection: gains linear, lags and onsets on a grid, then by line
// search.
#pragma once

#include <Eigen/Core>
#include <map>
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

/// The best fit of one effect on top of the problem's nuisances.
struct CandidateFit {
  ModelTerm term;
  double delta_chi2 = 0.0;
  int parameter_count = 0;  ///< gains that the data see + non-linear parameters
  double score = 0.0;       ///< delta_chi2 - parameter_count * ln(n)
  double tried = 1.0;       ///< variants, lags and onsets looked at
};

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
  EffectSearch(ResidualProblem& problem, const DriverTable& drivers, const std::vector<Effect>& catalogue);

  [[nodiscard]] const std::vector<Effect>& catalogue() const noexcept { return *catalogue_; }
  [[nodiscard]] const Effect* find(std::string_view id) const;
  [[nodiscard]] const DriverTable& drivers() const noexcept { return *drivers_; }
  [[nodiscard]] double logN() const noexcept { return log_n_; }
  /// The grid of onsets, s.
  [[nodiscard]] const std::vector<double>& onsets() const noexcept { return onsets_; }

  /// The best variant of one effect on the grid of lags and onsets, under the problem's present nuisances.
  [[nodiscard]] CandidateFit best(const Effect& effect) const;
  /// All effects but those named.
  [[nodiscard]] std::vector<CandidateFit> sweep(const std::vector<std::string>& without, const JobContext& job) const;

  /// Columns of a term over the units (not whitened).
  [[nodiscard]] Eigen::MatrixXd columns(const ModelTerm& term) const;
  /// Gains at fixed non-linear parameters.
  [[nodiscard]] JointFit solve(const std::vector<ModelTerm>& terms) const;
  /// Line searches over all non-linear parameters; `rounds` passes.
  [[nodiscard]] JointFit refine(const std::vector<ModelTerm>& terms, int rounds) const;
  /// Another driver or lag, a second and a third one for term `t`, as long as the evidence grows and states that were
  /// left out are predicted better. What is heated also follows the room a little: the room may come in as far as it
  /// stays small beside the effect's own driver.
  [[nodiscard]] JointFit refineDynamics(JointFit fit, std::size_t t, const std::vector<NuisanceColumn>& base) const;
  /// Columns by which a fitted term may be wrong: other gains and lags (free), and a model error in time and space of
  /// the given part of its size (prior).
  [[nodiscard]] std::vector<NuisanceColumn> termNuisances(const ModelTerm& term, const Eigen::VectorXd& gains,
                                                          double model_error) const;
  /// rms of prediction of epochs left out (constants from the rest of the series): without and with terms. Blocks of
  /// neighbours, or every fifth epoch (`interleaved`) for what happens within one block only.
  struct CrossValidation {
    double before_um = 0.0;
    double after_um = 0.0;
    double before_chi2 = 0.0;
    double after_chi2 = 0.0;
  };
  [[nodiscard]] CrossValidation crossValidate(const std::vector<ModelTerm>& before, const std::vector<ModelTerm>& after,
                                              const std::vector<NuisanceColumn>& base, bool interleaved = false) const;

  /// Shape columns over the units.
  [[nodiscard]] const Eigen::MatrixXd& shape(const Effect& effect) const;
  /// The series on which an effect has any.
  [[nodiscard]] const std::vector<int>& activeSeries(const Effect& effect) const;
  [[nodiscard]] bool parameterIsLag(const ModelTerm& term, std::size_t index) const;
  [[nodiscard]] std::pair<double, double> parameterBounds(const ModelTerm& term, std::size_t index) const;

 private:
  [[nodiscard]] const Eigen::VectorXd& unitResponse(const std::string& driver, double tau_on, double tau_off) const;
  /// True if a refinement of the same effects has the better score and predicts states left out better, too.
  [[nodiscard]] bool predictsBetter(const JointFit& before, const JointFit& after,
                                    const std::vector<NuisanceColumn>& base) const;
  /// Another time constant while the driver is off, where that predicts better.
  [[nodiscard]] JointFit withAsymmetricLag(JointFit fit, std::size_t t, const std::vector<NuisanceColumn>& base) const;
  [[nodiscard]] CandidateFit bestOfVariant(const Effect& effect, const EffectVariant& variant) const;

  ResidualProblem* problem_;
  const DriverTable* drivers_;
  const std::vector<Effect>* catalogue_;
  double log_n_ = 1.0;
  std::vector<double> lags_;
  std::vector<double> onsets_;
  mutable std::map<std::tuple<std::string, double, double>, Eigen::VectorXd> responses_;
  mutable std::map<std::string, Eigen::MatrixXd> shapes_;
  mutable std::map<std::string, std::vector<int>> active_;
};

}  // namespace spindrift
