// SPDX-License-Identifier: GPL-3.0-or-later
// What a run of the study counts, the tables it prints and what is required of it.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"
#include "tests/benchmarks/discrepancy/study_cells.h"

namespace spindrift::study {

/// Answers of one method to the campaigns of one case.
struct Tally {
  std::map<Outcome, int> outcomes;
  std::map<std::string, int> verdicts;
  int count = 0;
  int at_least_two = 0;  ///< campaigns in which two of the hidden effects are found and nothing wrong is listed
  void add(const Answer& answer, const Verdict& verdict);
  void add(const Tally& other);
  [[nodiscard]] int of(Outcome outcome) const;
};

/// The hidden signal on the held-out states of one campaign, and what of it is explained.
struct HeldOutCampaign {
  double explained = 0.0;  ///< part of its power; below zero: the addition makes the gap larger
  double strength = 0.0;   ///< rms over the held-out rows in the component where it is largest, in sigma
};

struct Outcomes {
  std::vector<Tally> search = std::vector<Tally>(cells().size());
  std::vector<Tally> stepwise = std::vector<Tally>(cells().size());
  std::vector<Tally> lasso = std::vector<Tally>(cells().size());
  std::vector<std::vector<HeldOutCampaign>> explained = std::vector<std::vector<HeldOutCampaign>>(cells().size());
  std::vector<HeldOutSignal> held_out = std::vector<HeldOutSignal>(cells().size());  ///< of all campaigns together
  std::vector<std::vector<OracleFit>> oracle = std::vector<std::vector<OracleFit>>(cells().size());
  std::vector<std::vector<double>> gains_of_missed = std::vector<std::vector<double>>(cells().size());
  std::vector<std::pair<double, bool>> confidences;  ///< of every name: stated, and whether it is hidden
  int unknowable = 0;                                ///< campaigns whose held-out states cannot be known
  std::vector<double> search_ms;
  std::pair<double, std::string> longest_search;         ///< ms, which campaign
  std::map<std::string, std::pair<int, int>> by_effect;  ///< right, campaigns with this one effect
  std::vector<std::string> misses;
  std::vector<std::string> poorly_explained;
};

/// "97.5 % [ 87.1,  99.6]": Wilson's interval, 95 %.
[[nodiscard]] std::string rate(int k, int n);

struct ReportOptions {
  bool plain = false;  ///< with the tables of the plain methods
  bool list = false;   ///< with every campaign that was not named rightly
};
void printReport(const Outcomes& all, const ReportOptions& options);

/// Prints every target and whether it is reached; false if one is not. Rates of a table row count together, and each of
/// its cases by itself where it has campaigns enough; a target is missed where the 95 % interval of the rate lies
/// beyond it.
[[nodiscard]] bool reached(const Outcomes& all);

}  // namespace spindrift::study
