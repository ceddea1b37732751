// SPDX-License-Identifier: Apache-2.0
// Everything that one more effect can put into a fit: for every effect of the catalogue all its drivers, lags and
// onsets on a grid, whitened once and shared by all questions. A question ("which effect explains what this fit
// leaves?") then costs one product with the columns of the fit.
//
// One way in which an effect may act (driver, lag, start) is a "way": a few columns shape x response. Its gain in
// chi-squared comes from the Gram matrix of these columns, free of all nuisances and of the fit that is given. Among
// the ways of an effect the prior is uniform, over effects as well, so that an effect with many drivers has no
// advantage:
//
//   evidence = delta chi-squared - gains ln n - ln(number of ways)           (twice the logarithm of a probability)
//
// Sources: Schwarz 1978 (BIC); Golub and Pereyra 1973 (variable projection).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/discrepancy/effect_search.h"

namespace spindrift {

/// A machine that was warm when the log began: odds 1 to 4.
constexpr double warm_price = 2.8;
[[nodiscard]] inline bool warmStart(const EffectVariant& variant) {
  return !variant.inputs.empty() && variant.inputs.back().dynamics == Dynamics::Start;
}

/// One driver, through two lags.
[[nodiscard]] bool throughTwoLags(const EffectVariant& variant);

/// The best way of one effect on the grid.
struct CandidateFit {
  ModelTerm term;
  double delta_chi2 = 0.0;
  int rank = 0;           ///< gains that the data see
  double evidence = 0.0;  ///< as above
  /// The best ways with other drivers or dynamics, of one lag at most, best first. What is best on the grid may turn
  /// out to be impossible when its lags are refined, and one lag between two of the grid looks like two.
  std::vector<ModelTerm> other_ways;
};

class CandidateLibrary {
 public:
  /// Under the noise and nuisances that the problem has now; later changes of them need another library.
  CandidateLibrary(const EffectSearch& search, const ResidualProblem& problem, const JobContext& job);

  /// Columns that are in the fit already: orthonormal, projected, rows as problem.projected() (and more rows, of
  /// priors, below); `residual` is what they leave, as long.
  struct Given {
    Eigen::MatrixXd basis;
    Eigen::VectorXd residual;
  };
  /// The best way of every effect that has one beside what is given, best first. `skip`: ids that are not tried.
  [[nodiscard]] std::vector<CandidateFit> sweep(const Given& given, const std::vector<std::string>& skip,
                                                const JobContext& job) const;
  /// What the choice among the ways of an effect costs.
  [[nodiscard]] double choicePrice(const Effect& effect) const;

 private:
  struct Way {
    EffectVariant variant;
    std::size_t kind = 0;  ///< ways of one kind have the same drivers, a speed in any power, and dynamics
    std::vector<double> parameters;
    std::vector<Eigen::Index> columns;
    Eigen::MatrixXd gram;  ///< free of the problem's nuisances
    int minus = -1;        ///< pulses: index of the column that is subtracted (they are differences of two steps)
  };
  struct Entry {
    const Effect* effect = nullptr;
    std::vector<std::size_t> domains;
    Eigen::MatrixXd columns;  ///< rows of the active domains
    Eigen::VectorXd whole;    ///< squared norms before nuisances were removed
    std::vector<Way> ways;
    Eigen::MatrixXd steps_gram;  ///< of all columns, for pulses
  };
  [[nodiscard]] Entry entryOf(const Effect& effect) const;
  /// `parts`: of the basis of what is given.
  [[nodiscard]] std::optional<CandidateFit> bestOf(const Entry& entry, const Given& given,
                                                   const std::vector<ResidualProblem::BasisPart>& parts) const;

  const EffectSearch* search_;
  const ResidualProblem* problem_;
  std::vector<Entry> entries_;
};

}  // namespace spindrift
