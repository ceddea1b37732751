// SPDX-License-Identifier: Apache-2.0
// The candidates of a choice between methods (private to thermal; core/thermal/method_choice.h says what they are).
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/thermal/method_evidence.h"

namespace spindrift::choice {

/// All candidates but `response`, on sets of inputs: every set of up to four inputs, of more a forward selection. The
/// search is made anew for every run with the judges of that run, so that it is judged by rows it has not seen.
class PlainCandidates {
 public:
  PlainCandidates(const response::Dictionary& d, const Evidence& evidence, const std::vector<std::string>& names,
                  const MethodChoiceOptions& options);

  void search(const JobContext& job);

  std::vector<Candidate> all;

 private:
  using Columns = std::vector<Eigen::Index>;
  using Set = std::vector<std::size_t>;

  /// With the judges of run `of`; negative: with all runs.
  void searchFor(std::ptrdiff_t of, const JobContext& job);
  /// Tries every method on this set; the best score of them as run `of` may see it.
  double visit(const Set& set, std::ptrdiff_t of);
  /// Line and ridge on all temperatures and on all inputs: nothing was picked, so every run may take them.
  void takeWhole(std::ptrdiff_t of);
  void addWhole(const Set& set, double power);
  [[nodiscard]] Columns columnsOf(std::size_t input, double power, const std::vector<double>& taus_s) const;
  [[nodiscard]] Candidate make(Method method, Columns columns, const Set& set, double shrinkage,
                               std::size_t time_constants = 0) const;
  void keep(Candidate c);
  const Candidate& lagsOf(Method method, const Columns& columns, const Set& set, std::size_t time_constants);
  /// One time constant per input, one input after the other until none changes.
  const Candidate& fewLags(const std::vector<Columns>& per_input, const Set& set, std::ptrdiff_t of);
  /// One or two time constants that all inputs share, from the best single one on until none changes.
  const Candidate& sharedLags(const Set& set, double power, std::ptrdiff_t of);

  const response::Dictionary& d_;
  const Evidence& evidence_;
  const std::vector<std::string>& names_;
  const MethodChoiceOptions& options_;
  std::vector<double> powers_;
  std::map<Set, std::vector<std::size_t>> visited_;        ///< places in `all`
  std::vector<std::size_t> whole_;                         ///< the sets of all, places in `all`
  std::map<std::pair<Method, Columns>, Candidate> tried_;  ///< combinations of time constants
};

/// The members of core/thermal/response_fit.h on all inputs; their projection onto few is as good.
[[nodiscard]] std::vector<Candidate> responseMembers(const response::Dictionary& d, const Evidence& evidence,
                                                     const MethodChoiceOptions& options);

}  // namespace spindrift::choice
