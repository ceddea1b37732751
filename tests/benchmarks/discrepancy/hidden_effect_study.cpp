// SPDX-License-Identifier: GPL-3.0-or-later
// Study of the search for hidden effects on virtual campaigns, blind to what they hide.
//
//   hidden_effect_study [--campaigns N] [--seed S] [--seeds K] [--short] [--plain] [--kind K] [--cell PART]
//                       [--dump DIR] [--oracle] [--list] [--require] [--suggestion]
//
// N campaigns (default 400), for each of K seeds from S on (default 1; all rates pooled), are shared among the cases of
// study_cells.cpp: clean data, each condition of a workshop alone, all together, with one, two, three effects hidden,
// nothing, a cause outside the catalogue, confounded logs. Each has its own machine, programme, room, sensors and seed,
// none of which depends on what is hidden. Rates are measured with seeds from 9001 on by --require, with others
// otherwise, so that nothing is tuned on what judges. --kind and --cell run the cases of one kind or with PART in their
// name.
// --plain also runs forward stepwise BIC and LASSO; --require ends with 1 where the rates are not what the search is
// known to reach; --oracle also fits, at strength 4 and more, the effects that are hidden by their names, to the
// observations and to the same without noise: what search, noise and the form of the model cost on held-out states.
// --list prints every campaign that was not named rightly. --dump writes every campaign as a folder, with its truth
// beside it, and runs no search. --suggestion studies what to measure next instead (suggestion_study.h).
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "core/base/atomic_file.h"
#include "core/base/text.h"
#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"
#include "tests/benchmarks/discrepancy/plain_methods.h"
#include "tests/benchmarks/discrepancy/study_cells.h"
#include "tests/benchmarks/discrepancy/study_report.h"
#include "tests/benchmarks/discrepancy/suggestion_study.h"

namespace spindrift::study {
namespace {

struct Assignment {
  std::size_t cell = 0;
  std::size_t turn = 0;
  std::uint64_t seed = 0;
};

Answer searched(const DiscrepancyInput& input, JobContext& job, DiscrepancyResult& result) {
  DiscrepancyOptions options;
  options.suggest = false;
  result = findDiscrepancy(input, options, job);
  Answer answer;
  answer.verdict = std::string(toString(result.verdict));
  for (const FoundEffect& effect : result.effects) {
    answer.effects.push_back({effect.id, effect.rivals, effect.confidence});
  }
  return answer;
}

/// Time that this thread has used: what a search takes on one core, whatever else runs.
double threadTime_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// What no measurement of the fitted states can tell about the held-out ones: a pulse that ends after them.
bool endsInHeldOut(const StudyCase& made) {
  double last_fit_s = 0.0;
  const MeasurementOptions& plan = *made.scenario.measurement;
  for (std::size_t i = 0; i < plan.times_s.size(); ++i) {
    if (!plan.holdout.contains(fmt::format("M{}", i))) last_fit_s = std::max(last_fit_s, plan.times_s[i]);
  }
  return std::any_of(made.hidden.begin(), made.hidden.end(), [&](const std::string& id) {
    if (!id.starts_with("external_heat.")) return false;
    const auto& setting = made.scenario.effects.at(id).setting;
    return setting.parameter("onset_s", 0.0) + setting.parameter("length_s", 0.0) > last_fit_s;
  });
}

std::string described(const Answer& answer) {
  std::string text = answer.verdict;
  for (const Answer::Listed& listed : answer.effects) {
    text += " " + listed.id;
    if (!listed.rivals.empty()) text += " (" + joinedList(listed.rivals, "or") + ")";
  }
  return text;
}

struct Wanted {
  bool plain = false;
  bool oracle = false;
  std::filesystem::path dump;  ///< folder for the campaigns; empty: none is written
};

/// Letters and digits of a name, the rest as underscores.
std::string fileName(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.') {
      out += c;
    } else if (!out.empty() && out.back() != '_') {
      out += '_';
    }
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

/// The campaign as a folder that the command line can be run on, and its truth beside it.
void dump(const std::filesystem::path& folder, const Cell& cell, std::uint64_t seed, const StudyCase& made,
          const StudyCampaign& study) {
  const std::string name = fmt::format("{}_{}", fileName(cell.name), seed);
  writeCampaign(study.campaign, folder / name);
  nlohmann::json truth = truthJson(study.campaign);
  truth["hidden"] = made.hidden;
  truth["case"] = cell.name;
  truth["kind"] = toString(cell.kind);
  truth["seed"] = seed;
  truth["strength"] = cell.strength;
  truth["conditions"] = made.conditions.json();
  truth["applied"] = study.applied.json();
  if (made.scenario.simulation) truth["simulation_size_errors"] = made.scenario.simulation->size_errors;
  writeFileAtomically(folder / (name + ".truth.json"), truth.dump(1) + "\n");
}

void runOne(const Assignment& which, const Wanted& wanted, Outcomes& all, std::mutex& mutex) {
  const Cell& cell = cells()[which.cell];
  StudyOptions options;
  options.kind = cell.kind;
  options.strength = cell.strength;
  options.ar1 = cell.ar1;
  options.conditions = cell.conditions;
  options.turn = which.turn;
  const StudyCase made = studyCase(options, which.seed);
  JobContext job;
  const StudyCampaign study = simulateStudy(made, job);
  const VirtualCampaign& campaign = study.campaign;
  if (!wanted.dump.empty()) {
    dump(wanted.dump, cell, which.seed, made, study);
    return;
  }
  const DiscrepancyInput input = inputOf(campaign);
  // A cause outside the catalogue can be in no list, so that naming anything is wrong.
  const std::vector<std::string> nameable = cell.kind == StudyKind::Outside ? std::vector<std::string>{} : made.hidden;
  const auto judged = [&](const Answer& answer) {
    // Where the log lacks what drives the effect, "unknown" is right as well as a set with the truth in it.
    const bool unknown = answer.effects.empty() && answer.verdict == "unknown";
    if (cell.kind == StudyKind::Confounded && unknown) return Verdict{Outcome::Named, 0};
    if (!nameable.empty()) return judge(answer, nameable);
    if (!answer.effects.empty()) return Verdict{Outcome::Wrong, 0};
    const bool right = answer.verdict == (cell.kind == StudyKind::Outside ? "unknown" : "none");
    return Verdict{right ? Outcome::Named : Outcome::Abstained, 0};
  };
  DiscrepancyResult result;
  const double started = threadTime_ms();
  const Answer answer = searched(input, job, result);
  const double ms = threadTime_ms() - started;
  const Verdict verdict = judged(answer);
  const Outcome outcome = verdict.outcome;
  const bool signal = !made.hidden.empty() && cell.kind != StudyKind::Outside && cell.kind != StudyKind::Confounded;
  std::optional<OracleFit> oracle;
  if (wanted.oracle && signal && cell.strength >= 4.0) oracle = fitKnowingNames(campaign, made.hidden);
  Answer stepwise;
  Answer lasso;
  if (wanted.plain) {
    stepwise = forwardStepwiseBic(input);
    lasso = lassoBic(input);
  }
  const std::scoped_lock lock(mutex);
  all.search[which.cell].add(answer, verdict);
  all.search_ms.push_back(ms);
  if (ms > all.longest_search.first) {
    all.longest_search = {ms, fmt::format("seed {}, {}, {} observations, hidden {}", which.seed, cell.name,
                                          input.observations.rows.size(), joinedList(made.hidden))};
  }
  if (!made.hidden.empty() && cell.kind != StudyKind::Outside) {
    const HeldOutSignal held_out = heldOutSignal(campaign, result.effect_part);
    const double explained = held_out.explained();
    if (endsInHeldOut(made)) {
      ++all.unknowable;
    } else if (std::isfinite(explained)) {
      all.explained[which.cell].push_back({explained, heldOutStrength(campaign)});
      all.held_out[which.cell].hidden += held_out.hidden;
      all.held_out[which.cell].missed += held_out.missed;
      if (oracle) all.oracle[which.cell].push_back(*oracle);
    }
    if (outcome == Outcome::Named && !result.effects.empty() && cell.strength >= 4.0 && explained < 0.95) {
      std::string beside;
      if (oracle) {
        beside = fmt::format(
            " (names known {:.1f} %, without noise {:.1f} %, noise costs {:.1f} %, stated "
            "{:.1f} %, {:.1f} sigma)",
            100.0 * oracle->explained, 100.0 * oracle->noise_free, 100.0 * oracle->noise_cost,
            100.0 * oracle->stated_cost, oracle->strength);
      }
      all.poorly_explained.push_back(fmt::format("seed {:5} {:20} hidden {:42} explained {:5.1f} %{} by {}", which.seed,
                                                 cell.name, joinedList(made.hidden), 100.0 * explained, beside,
                                                 result.effects.front().drivers));
    }
  }
  if (cell.kind == StudyKind::One) {
    auto& [right, count] = all.by_effect[made.hidden.front()];
    right += outcome == Outcome::Named || outcome == Outcome::Rival ? 1 : 0;
    ++count;
  }
  for (const Answer::Listed& listed : answer.effects) {
    const bool right = std::any_of(nameable.begin(), nameable.end(),
                                   [&](const std::string& hidden) { return sameEffect(hidden, listed.id); });
    all.confidences.emplace_back(listed.confidence, right);
  }
  if (outcome != Outcome::Named) {
    all.misses.push_back(fmt::format("seed {:5} {:20} hidden {:42} -> {} [explained {:.3f}, {}]", which.seed, cell.name,
                                     joinedList(made.hidden), described(answer), result.explained_fraction,
                                     result.leftover.empty() ? "nothing left" : result.leftover));
  }
  if (wanted.plain) {
    all.stepwise[which.cell].add(stepwise, judged(stepwise));
    all.lasso[which.cell].add(lasso, judged(lasso));
  }
}

/// Seeds from here on judge: no threshold is to be chosen on them.
constexpr std::uint64_t first_judging_seed = 9001;

int run(int argc, char** argv) {
  int campaigns = 400;
  std::optional<std::uint64_t> seed;
  std::uint64_t seeds = 1;
  Wanted wanted;
  bool list = false;
  bool required = false;
  std::string only;
  std::string part;
  bool brief = false;
  bool suggestion = false;
  for (int i = 1; i < argc; ++i) {
    const auto value = [&]() -> std::string { return i + 1 < argc ? argv[++i] : ""; };
    if (std::strcmp(argv[i], "--campaigns") == 0) {
      campaigns = std::max(1, std::atoi(value().c_str()));
    } else if (std::strcmp(argv[i], "--seed") == 0) {
      seed = static_cast<std::uint64_t>(std::atoll(value().c_str()));
    } else if (std::strcmp(argv[i], "--seeds") == 0) {
      seeds = static_cast<std::uint64_t>(std::max(1, std::atoi(value().c_str())));
    } else if (std::strcmp(argv[i], "--short") == 0) {
      brief = true;
    } else if (std::strcmp(argv[i], "--plain") == 0) {
      wanted.plain = true;
    } else if (std::strcmp(argv[i], "--oracle") == 0) {
      wanted.oracle = true;
    } else if (std::strcmp(argv[i], "--list") == 0) {
      list = true;
    } else if (std::strcmp(argv[i], "--require") == 0) {
      required = true;
    } else if (std::strcmp(argv[i], "--kind") == 0) {
      only = value();
    } else if (std::strcmp(argv[i], "--cell") == 0) {
      part = value();
    } else if (std::strcmp(argv[i], "--suggestion") == 0) {
      suggestion = true;
    } else if (std::strcmp(argv[i], "--dump") == 0) {
      wanted.dump = value();
    } else {
      fmt::print(
          "usage: {} [--campaigns N] [--seed S] [--seeds K] [--short] [--plain] [--oracle] [--list] [--require] "
          "[--kind one|two|three|nothing|outside|confounded] [--cell PART] [--dump DIR] [--suggestion]\n",
          argv[0]);
      return 2;
    }
  }
  const std::uint64_t first_seed = seed.value_or(required ? first_judging_seed : 1);
  if (suggestion) {
    SuggestionStudyOptions options;
    options.seed = first_seed;
    options.campaigns = campaigns;
    options.list = list;
    options.required = required;
    return runSuggestionStudy(options);
  }
  const auto chosen = [&](const Cell& cell) {
    return (only.empty() || only == toString(cell.kind)) && cell.name.find(part) != std::string::npos;
  };
  int shares = 0;
  for (const Cell& cell : cells()) shares += chosen(cell) ? cell.share : 0;
  if (shares == 0) {
    fmt::print("no case of kind \"{}\" with \"{}\" in its name; there are:\n", only, part);
    for (const Cell& cell : cells()) fmt::print("  {} ({})\n", cell.name, toString(cell.kind));
    return 2;
  }
  std::vector<Assignment> work;
  for (std::uint64_t k = first_seed; k < first_seed + seeds; ++k) {
    for (std::size_t c = 0; c < cells().size(); ++c) {
      const Cell& cell = cells()[c];
      if (!chosen(cell)) continue;
      const int count = brief ? cell.short_count : std::max(1, campaigns * cell.share / shares);
      // A campaign is the same whichever other cases run beside it.
      for (int i = 0; i < count; ++i) {
        const auto number = static_cast<std::uint64_t>(i);
        work.push_back({c, static_cast<std::size_t>(k * 7 + c * 11 + number), k * 1000000 + c * 10000 + number});
      }
    }
  }
  Outcomes all;
  std::mutex mutex;
  const JobContext job;
  parallelFor(work.size(), job, [&](std::size_t i) { runOne(work[i], wanted, all, mutex); });
  if (!wanted.dump.empty()) {
    fmt::print("{} campaigns in {}\n", work.size(), wanted.dump.string());
    return 0;
  }

  fmt::print("{} campaigns, {} {}; rates with 95 % intervals (Wilson)\n", work.size(),
             seeds == 1 ? "seed" : fmt::format("{} seeds from", seeds), first_seed);
  printReport(all, {wanted.plain, list});
  return required && !reached(all) ? 1 : 0;
}

}  // namespace
}  // namespace spindrift::study

int main(int argc, char** argv) {
  try {
    return spindrift::study::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "hidden_effect_study: {}\n", error.what());
    return 3;
  }
}
