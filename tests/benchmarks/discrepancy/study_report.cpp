// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/discrepancy/study_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/math/statistics.h"

namespace spindrift::study {
namespace {

/// What is demanded of the hidden signal on held-out states, clean data at 4-8 times the noise.
constexpr double median_explained = 0.997;
constexpr double worst_tenth_explained = 0.985;
/// Where the hidden cause rests in the held-out states there is nothing to explain: campaigns count whose held-out
/// signal is at least this part of the strength over the fitted rows.
constexpr double acting_part = 0.5;
/// Stated probability against how often it is right, in every fifth of the range.
constexpr double calibration_tolerance = 0.05;

RateInterval interval(int k, int n) {
  return wilsonInterval(static_cast<std::size_t>(k), static_cast<std::size_t>(n));
}

/// Campaigns from which on one case of a row is judged by itself: one miss among them must not be a target missed.
bool enoughForOneCase(int n, double target) {
  constexpr int fewest = 12;
  return n >= fewest && interval(n - 1, n).high >= target;
}

void printTable(const char* method, const std::vector<Tally>& tallies) {
  fmt::print("\n{}\n{:22} {:>4}  {:>22} {:>22} {:>22} {:>22}  verdicts\n", method, "case", "n", "right name",
             "right among rivals", "abstained", "wrong or superfluous");
  for (std::size_t c = 0; c < cells().size(); ++c) {
    const Tally& t = tallies[c];
    if (t.count == 0) continue;
    std::string verdicts;
    for (const auto& [verdict, count] : t.verdicts) verdicts += fmt::format("{} {} ", verdict, count);
    if (cells()[c].kind == StudyKind::Three) {
      verdicts += fmt::format("| two or three {}", rate(t.at_least_two, t.count));
    }
    fmt::print("{:22} {:4}  {:>22} {:>22} {:>22} {:>22}  {}\n", cells()[c].name, t.count,
               rate(t.of(Outcome::Named), t.count), rate(t.of(Outcome::Rival), t.count),
               rate(t.of(Outcome::Abstained), t.count), rate(t.of(Outcome::Wrong), t.count), verdicts);
  }
}

void printOracle(const std::vector<OracleFit>& fits) {
  const auto line = [&](const char* what, double OracleFit::*value) {
    std::vector<double> values;
    for (const OracleFit& fit : fits) values.push_back(fit.*value);
    fmt::print("{:22} median {:5.1f} %, worst tenth below {:5.1f} %\n", what, 100.0 * median(values),
               100.0 * quantile(values, 0.1));
  };
  line("  names known", &OracleFit::explained);
  line("  and without noise", &OracleFit::noise_free);
  std::vector<double> cost;
  for (const OracleFit& fit : fits) cost.push_back(fit.noise_cost);
  fmt::print("{:22} median {:5.2f} %, 90 % below {:.2f} %\n", "  cost of the noise", 100.0 * median(cost),
             100.0 * quantile(cost, 0.9));
}

void printLimit(const Outcomes& all) {
  for (std::size_t c = 0; c < cells().size(); ++c) {
    const std::vector<double>& gains = all.gains_of_missed[c];
    if (gains.empty()) continue;
    constexpr double very_strong = 10.0;  // Kass and Raftery 1995
    const auto below = std::count_if(gains.begin(), gains.end(), [](double g) { return g < very_strong; });
    fmt::print(
        "{:22} {} effects missed without a wrong name; put in by hand beside the others that are hidden, {} of "
        "them gain less than {:.0f} in BIC: these data do not show them\n",
        cells()[c].name, gains.size(), below, very_strong);
  }
}

void printExplained(const Outcomes& all) {
  fmt::print("\nnoise-free hidden signal explained on held-out states\n");
  for (std::size_t c = 0; c < cells().size(); ++c) {
    if (all.explained[c].empty()) continue;
    std::vector<double> e;
    for (const HeldOutCampaign& campaign : all.explained[c]) e.push_back(campaign.explained);
    const auto worse = std::count_if(e.begin(), e.end(), [](double v) { return v < 0.0; });
    fmt::print("{:22} median {:5.1f} %, worst tenth below {:5.1f} %, of all together {:5.1f} %, gap made larger {}\n",
               cells()[c].name, 100.0 * median(e), 100.0 * quantile(e, 0.1), 100.0 * all.held_out[c].explained(),
               worse);
    if (!all.oracle[c].empty()) printOracle(all.oracle[c]);
  }
  if (all.unknowable > 0) {
    fmt::print("left out: {} campaigns in which heat from outside ends after the last state that is fitted\n",
               all.unknowable);
  }
}

/// Names whose stated probability lies in [from, to): mean of the stated, how many are right.
struct CalibrationBin {
  double stated = 0.0;
  int right = 0;
  int count = 0;
};
CalibrationBin calibrationBin(const std::vector<std::pair<double, bool>>& names, double from, double to) {
  CalibrationBin bin;
  for (const auto& [stated, right] : names) {
    if (stated < from || stated >= to) continue;
    bin.stated += stated;
    bin.right += right ? 1 : 0;
    ++bin.count;
  }
  if (bin.count > 0) bin.stated /= bin.count;
  return bin;
}

void printCalibration(const std::vector<std::pair<double, bool>>& names) {
  if (names.empty()) return;
  double right = 0.0;
  double brier = 0.0;
  for (const auto& [stated, ok] : names) {
    right += ok ? 1.0 : 0.0;
    brier += std::pow(stated - (ok ? 1.0 : 0.0), 2);
  }
  right /= static_cast<double>(names.size());
  fmt::print("\nconfidence of {} names: Brier score {:.4f}, always saying the base rate ({:.3f}) {:.4f}\n",
             names.size(), brier / static_cast<double>(names.size()), right, right * (1.0 - right));
  constexpr double edges[] = {0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 0.98, 1.001};
  for (std::size_t b = 0; b + 1 < std::size(edges); ++b) {
    const CalibrationBin bin = calibrationBin(names, edges[b], edges[b + 1]);
    if (bin.count == 0) continue;
    fmt::print("  stated {:.2f} to {:.2f}: mean {:.3f}, right {:3} of {:3} {}\n", edges[b], std::min(1.0, edges[b + 1]),
               bin.stated, bin.right, bin.count, rate(bin.right, bin.count));
  }
}

/// One line of what is required.
class Requirements {
 public:
  void rateAtLeast(const std::string& name, const char* what, int k, int n, double limit, bool quiet = false) {
    if (n > 0) line(name, what, k, n, ">=", limit, interval(k, n).high >= limit - 1e-9, quiet);
  }
  void rateAtMost(const std::string& name, const char* what, int k, int n, double limit, bool quiet = false) {
    if (n > 0) line(name, what, k, n, "<=", limit, interval(k, n).low <= limit + 1e-9, quiet);
  }
  void verdict(const std::string& text, bool good) {
    fmt::print("{} {}\n", text, good ? "reached" : "MISSED");
    all_good_ = all_good_ && good;
  }
  [[nodiscard]] bool allGood() const { return all_good_; }

 private:
  /// A quiet line is only printed when the target is missed.
  void line(const std::string& name, const char* what, int k, int n, const char* sign, double limit, bool good,
            bool quiet) {
    all_good_ = all_good_ && good;
    if (quiet && good) return;
    fmt::print("{:42} {:13} {:3} of {:3} {:24} {} {:5.1f} % {}\n", name, what, k, n, rate(k, n), sign, 100.0 * limit,
               good ? "reached" : "MISSED");
  }
  bool all_good_ = true;
};

void requireRates(const Outcomes& all, Requirements& required) {
  for (const Target& target : targets()) {
    const auto demand = [&](const std::string& name, const Tally& t, bool quiet) {
      const bool outside = target.row == Row::Outside;
      const int right = outside ? t.count - t.of(Outcome::Wrong) : t.of(Outcome::Named) + t.of(Outcome::Rival);
      const char* what = target.row == Row::Three ? "all three" : outside ? "nothing named" : "right";
      required.rateAtLeast(name, what, right, t.count, target.right, quiet);
      if (target.at_least_two > 0.0) {
        required.rateAtLeast(name, "at least two", t.at_least_two, t.count, target.at_least_two, quiet);
      }
      if (target.wrong < 1.0) {
        required.rateAtMost(name, "wrong", t.of(Outcome::Wrong), t.count, target.wrong, quiet);
      }
    };
    Tally whole;
    int with_campaigns = 0;
    for (std::size_t c = 0; c < cells().size(); ++c) {
      if (cells()[c].row != target.row || all.search[c].count == 0) continue;
      whole.add(all.search[c]);
      ++with_campaigns;
    }
    demand(target.name, whole, false);
    for (std::size_t c = 0; c < cells().size() && with_campaigns > 1; ++c) {
      if (cells()[c].row == target.row && enoughForOneCase(all.search[c].count, target.right)) {
        demand("  " + cells()[c].name, all.search[c], true);
      }
    }
  }
}

void requireExplained(const Outcomes& all, Requirements& required) {
  int count = 0;
  int well = 0;
  int passably = 0;
  std::vector<double> explained;
  std::vector<double> known;
  std::vector<double> noise_free;
  for (std::size_t c = 0; c < cells().size(); ++c) {
    if (cells()[c].row != Row::CleanStrong) continue;
    const bool with_oracle = all.oracle[c].size() == all.explained[c].size();
    for (std::size_t i = 0; i < all.explained[c].size(); ++i) {
      const HeldOutCampaign& campaign = all.explained[c][i];
      if (campaign.strength < acting_part * cells()[c].strength) continue;
      if (with_oracle) {
        known.push_back(all.oracle[c][i].explained);
        noise_free.push_back(all.oracle[c][i].noise_free);
      }
      ++count;
      well += campaign.explained >= median_explained ? 1 : 0;
      passably += campaign.explained >= worst_tenth_explained ? 1 : 0;
      explained.push_back(campaign.explained);
    }
  }
  if (count == 0) return;
  fmt::print("held-out states, clean, 4-8, acting there: median {:.4f}, worst tenth below {:.4f}\n", median(explained),
             quantile(explained, 0.1));
  if (!known.empty()) {
    fmt::print("  names known: {:.4f}, {:.4f}; and without noise: {:.4f}, {:.4f}\n", median(known),
               quantile(known, 0.1), median(noise_free), quantile(noise_free, 0.1));
  }
  required.rateAtLeast(fmt::format("  explained {:.1f} % and more", 100.0 * median_explained), "campaigns", well, count,
                       0.5);
  required.rateAtLeast(fmt::format("  explained {:.1f} % and more", 100.0 * worst_tenth_explained), "campaigns",
                       passably, count, 0.9);
}

void requireCalibration(const Outcomes& all, Requirements& required) {
  for (int fifth = 0; fifth < 5; ++fifth) {
    const double from = 0.2 * fifth;
    const double to = fifth == 4 ? 1.001 : 0.2 * (fifth + 1);
    const CalibrationBin bin = calibrationBin(all.confidences, from, to);
    if (bin.count == 0) continue;
    const RateInterval right = interval(bin.right, bin.count);
    required.verdict(
        fmt::format("stated {:.1f} to {:.1f}: mean {:.3f}, right {:3} of {:3} {}, within {:.0f} points", from,
                    std::min(1.0, to), bin.stated, bin.right, bin.count, rate(bin.right, bin.count),
                    100.0 * calibration_tolerance),
        bin.stated >= right.low - calibration_tolerance && bin.stated <= right.high + calibration_tolerance);
  }
}

}  // namespace

void Tally::add(const Answer& answer, const Verdict& verdict) {
  ++count;
  ++outcomes[verdict.outcome];
  ++verdicts[answer.verdict];
  if (verdict.found >= 2 && verdict.outcome != Outcome::Wrong) ++at_least_two;
}

void Tally::add(const Tally& other) {
  count += other.count;
  at_least_two += other.at_least_two;
  for (const auto& [outcome, n] : other.outcomes) outcomes[outcome] += n;
  for (const auto& [verdict, n] : other.verdicts) verdicts[verdict] += n;
}

int Tally::of(Outcome outcome) const {
  const auto found = outcomes.find(outcome);
  return found == outcomes.end() ? 0 : found->second;
}

std::string rate(int k, int n) {
  if (n == 0) return "-";
  const RateInterval i = interval(k, n);
  return fmt::format("{:5.1f} % [{:4.1f}, {:5.1f}]", 100.0 * k / n, 100.0 * i.low, 100.0 * i.high);
}

void printReport(const Outcomes& all, const ReportOptions& options) {
  printTable(
      "search (\"right name\" is \"unknown\" outside the catalogue, also with a confounded log, and \"none\" where "
      "nothing is "
      "hidden)",
      all.search);
  if (options.plain) {
    printTable("forward stepwise BIC over the same candidates", all.stepwise);
    printTable("LASSO (BIC along the path) over the same candidates", all.lasso);
  }
  printLimit(all);
  printExplained(all);
  printCalibration(all.confidences);
  fmt::print("search time on one core: median {:.0f} ms, 95 % below {:.0f} ms, longest {:.0f} ms ({})\n",
             median(all.search_ms), quantile(all.search_ms, 0.95), all.longest_search.first, all.longest_search.second);
  if (!options.list) return;
  const auto printSorted = [](const char* title, std::vector<std::string> lines) {
    fmt::print("\n{}\n", title);
    std::sort(lines.begin(), lines.end());
    for (const std::string& line : lines) fmt::print("{}\n", line);
  };
  printSorted("not named rightly", all.misses);
  printSorted("named rightly at strength 4 and more, but less than 95 % explained on held-out states",
              all.poorly_explained);
  fmt::print("\nby hidden effect (one effect): right / campaigns\n");
  for (const auto& [id, count] : all.by_effect) fmt::print("{:30} {} / {}\n", id, count.first, count.second);
}

bool reached(const Outcomes& all) {
  fmt::print("\nrequired (missed where the 95 % interval lies beyond it)\n");
  Requirements required;
  requireRates(all, required);
  requireExplained(all, required);
  requireCalibration(all, required);
  return required.allGood();
}

}  // namespace spindrift::study
