// SPDX-License-Identifier: Apache-2.0
// Blocked evidence for the candidates of a choice between methods (private to thermal; core/thermal/method_choice.h
// says what it is for).
//
// A run fits a candidate on a part of the training range and lets it run free over the rest: rolling origins and blocks
// left out. Every candidate carries ln(mean squared error) of each run. What an average of candidates is worth is
// judged run by run, and nothing that a run judges may have been chosen by it: the candidates that take part in run r,
// their weights and their time constants are chosen by those runs alone whose rows are disjoint from the rows of r
// (nested cross-validation; Varma and Simon 2006), and by what the candidate leaves of the rows fitted in run r.
// The latter, corrected for the number of coefficients (Akaike 1970, with the number of independent rows from batch
// means), counts as `runs_of_training` runs: few runs tell models of few coefficients apart by chance, all of training
// does not, while with few independent rows each coefficient costs much there.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/thermal/method_choice.h"
#include "core/thermal/response_dictionary.h"

namespace spindrift::choice {

enum class Method { Line, FewLags, SharedLags, Ridge, Response };

/// One fit on a part of the training range and free run over the rest. Normal matrices of (1, features, y).
struct Run {
  Eigen::MatrixXd fit;
  Eigen::MatrixXd fit_whitened;
  Eigen::MatrixXd held;
  std::vector<Eigen::Index> held_rows;
  std::vector<char> judges;  ///< which runs may choose what this one judges
};

struct Candidate {
  Method method = Method::Line;
  std::vector<Eigen::Index> columns;  ///< of the dictionary
  Eigen::VectorXd precision;
  std::vector<std::size_t> inputs;  ///< numbers of the usable inputs
  std::size_t time_constants = 0;   ///< that were chosen for the record too
  /// Inputs that a search picked among others, which makes the candidate less probable; all of them are no pick.
  std::size_t picked = 0;
  std::vector<double> log_error;  ///< ln of the mean squared error of every run
  /// ln of the mean squared error expected of new rows from what is left of those fitted: place 0 all of training,
  /// place r + 1 those of run r. Empty for `response`.
  std::vector<double> log_expected;
  /// Whether the search found it: place 0 with all runs as judges, place r + 1 with the judges of run r.
  std::vector<char> found;
};

struct Solution {
  Eigen::VectorXd w;        ///< offset, gains of its columns
  Eigen::MatrixXd inverse;  ///< of the regularised normal matrix
};

/// Mean of ln(mean squared error) over the runs that judge run `of` and over what the rows fitted there let expect;
/// negative: over all runs and all of training.
[[nodiscard]] double scoreOf(const Candidate& c, const std::vector<Run>& runs, std::ptrdiff_t of = -1);

/// Columns of the response dictionary with this exponent of speed.
[[nodiscard]] std::vector<Eigen::Index> responseColumns(const response::Dictionary& d, double power,
                                                        const std::vector<double>& taus);

class Evidence {
 public:
  Evidence(const response::Dictionary& d, const MethodChoiceOptions& options);

  [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }
  /// So many of the runs, the first ones, predict all that comes after them.
  [[nodiscard]] std::size_t origins() const { return origins_; }
  [[nodiscard]] double sumOfSquares(Eigen::Index column) const { return all_(column + 1, column + 1); }
  [[nodiscard]] const Eigen::MatrixXd& rows() const { return rows_; }
  /// Mean square below which no run tells candidates apart: nothing is known better than to a hundredth of the course.
  [[nodiscard]] double floor() const { return floor_; }

  /// `run` null: all of training.
  [[nodiscard]] Solution solve(const Candidate& c, const Run* run, bool with_inverse) const;
  /// Coefficients over all columns of the dictionary, offset first.
  [[nodiscard]] Eigen::VectorXd spread(const Candidate& c, const Eigen::VectorXd& w) const;
  /// Of the candidate with the best score, from the whitened rows.
  [[nodiscard]] double innovationVariance(const std::vector<Candidate>& candidates) const;
  /// Fills `log_error` and `log_expected`.
  void judge(Candidate& c) const;

 private:
  /// ln of the mean squared error to be expected of new rows, by the final prediction error with as many rows as are
  /// independent: of what is left, means over a twentieth of the time scatter more than independent rows would let
  /// them, and a model that misses something slow counts for as few rows as its residual has swings.
  [[nodiscard]] double logExpected(const Candidate& c, const Solution& s, const Run* run) const;
  template <typename Held>
  void add(const response::Dictionary& d, const Held& held);
  void nameJudges();

  Eigen::MatrixXd rows_;
  Eigen::MatrixXd whitened_;
  Eigen::MatrixXd all_;
  Eigen::MatrixXd all_whitened_;
  double floor_ = 0.0;
  std::vector<Run> runs_;
  std::size_t origins_ = 0;
};

struct Weighted {
  const Candidate* candidate = nullptr;
  double weight = 0.0;
};

/// Which candidates take part.
using Keep = std::function<bool(const Candidate&)>;

[[nodiscard]] inline bool anything(const Candidate& /*candidate*/) {
  return true;
}

/// The average of candidates as the judges of run `of` see it; negative: as all runs see it.
[[nodiscard]] std::vector<Weighted> weightsOf(const Evidence& evidence, const std::vector<Candidate>& candidates,
                                              std::ptrdiff_t of, const MethodChoiceOptions& options, const Keep& keep);

/// ln(mean squared error) of the average in every run, nothing chosen by the run that judges.
[[nodiscard]] std::vector<double> averagedErrors(const Evidence& evidence, const std::vector<Candidate>& candidates,
                                                 const MethodChoiceOptions& options, const Keep& keep);
/// Mean of averagedErrors().
[[nodiscard]] double averagedEvidence(const Evidence& evidence, const std::vector<Candidate>& candidates,
                                      const MethodChoiceOptions& options, const Keep& keep);

/// ln of the odds that a goes on with smaller errors than b, from ln(mean squared error) of both in the same runs. Half
/// of the mean difference per independent run (rolling origins overlap with each other and with the blocks, so that
/// about every second run is independent), shrunk by mean^2 / (mean^2 + its squared standard error): runs that disagree
/// about the better one are no evidence for either.
[[nodiscard]] double logOdds(const std::vector<double>& of_a, const std::vector<double>& of_b);

/// The factor of the covariance with which errors and intervals agree over the runs that judge. `of_gains`: variance
/// per unit of the inverse normal matrix; `of_noise`: variance of what the model leaves, known from training and not
/// scaled.
[[nodiscard]] double calibration(const Evidence& evidence, const std::vector<Candidate>& candidates,
                                 const MethodChoiceOptions& options, const Keep& keep, double of_gains,
                                 double of_noise);

}  // namespace spindrift::choice
