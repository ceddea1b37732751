// SPDX-License-Identifier: GPL-3.0-or-later
// Study of the search for hidden effects on virtual campaigns, blind to what they hide.
//
//   hidden_effect_study [--campaigns N] [--seed S] [--seeds K] [--short] [--plain] [--kind K] [--cell PART]
//                       [--dump DIR] [--oracle] [--limit] [--list] [--require] [--suggestion] [--item I] [--gather
//                       FILE]
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
// --limit puts into the fit by hand what was missed, and counts how much of it these data show at all. --list prints
// every campaign that was not named rightly. --dump writes every campaign as a folder, with its truth beside it, and
// runs no search. --suggestion studies what to measure next instead (suggestion_study.h).
//
// As a batch ("work":"command", "seeds":[0,N-1], "run":["hidden_effect_study","--campaigns","400","--item","{seed}"]):
// --item runs the I-th campaign of all, from 0 on, and prints what came out of it as JSON; --gather reads what `batch
// status BATCH --results FILE` wrote and prints the table of the study with the same options, the same as it prints
// alone. Items that are missing or failed are told, and end it with 1.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/job_context.h"
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
  bool limit = false;
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

/// Another process writes null for what is no number.
double numberOf(const nlohmann::json& j) {
  return j.is_null() ? std::nan("") : j.get<double>();
}

std::vector<double> numbersOf(const nlohmann::json& list) {
  std::vector<double> out;
  for (const nlohmann::json& j : list) out.push_back(numberOf(j));
  return out;
}

nlohmann::json toJson(const Answer& answer, const Verdict& verdict) {
  nlohmann::json out = {{"verdict", answer.verdict},
                        {"effects", nlohmann::json::array()},
                        {"outcome", static_cast<int>(verdict.outcome)},
                        {"found", verdict.found}};
  for (const Answer::Listed& e : answer.effects)
    out["effects"].push_back({{"id", e.id}, {"rivals", e.rivals}, {"confidence", e.confidence}});
  return out;
}

std::pair<Answer, Verdict> answerOf(const nlohmann::json& j) {
  Answer answer;
  answer.verdict = j.at("verdict");
  for (const nlohmann::json& e : j.at("effects"))
    answer.effects.push_back(
        {e.at("id"), e.at("rivals").get<std::vector<std::string>>(), numberOf(e.at("confidence"))});
  return {answer, {static_cast<Outcome>(j.at("outcome").get<int>()), j.at("found")}};
}

/// What came out of one campaign: all that the study counts, as JSON, so that it may come from another process.
nlohmann::json runOne(const Assignment& which, const Wanted& wanted, JobContext& job) {
  const Cell& cell = cells()[which.cell];
  StudyOptions options;
  options.kind = cell.kind;
  options.strength = cell.strength;
  options.ar1 = cell.ar1;
  options.conditions = cell.conditions;
  options.turn = which.turn;
  const StudyCase made = studyCase(options, which.seed);
  const StudyCampaign study = simulateStudy(made, job);
  const VirtualCampaign& campaign = study.campaign;
  if (!wanted.dump.empty()) {
    dump(wanted.dump, cell, which.seed, made, study);
    return nullptr;
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
  const bool signal = !made.hidden.empty() && cell.kind != StudyKind::Outside && cell.kind != StudyKind::Confounded;
  nlohmann::json record = {{"cell", which.cell},
                           {"seed", which.seed},
                           {"search", toJson(answer, judged(answer))},
                           {"ms", ms},
                           {"observations", input.observations.rows.size()},
                           {"hidden", made.hidden},
                           {"nameable", nameable},
                           {"explained_fraction", result.explained_fraction},
                           {"leftover", result.leftover}};
  if (!result.effects.empty()) record["drivers"] = result.effects.front().drivers;
  if (wanted.oracle && signal && cell.strength >= 4.0) {
    try {
      const OracleFit oracle = fitKnowingNames(campaign, made.hidden);
      record["oracle"] = {oracle.explained, oracle.noise_free, oracle.noise_cost, oracle.stated_cost, oracle.strength};
    } catch (const InputError& unfit) {
      record["no_oracle"] = unfit.what();  // nothing in the log drives it, say: no fit to compare with
    }
  }
  if (wanted.limit && signal && judged(answer).outcome == Outcome::Abstained) {
    try {
      record["missed"] = gainsOfMissed(input, made.hidden, answer);
    } catch (const InputError& unfit) {
      record["no_limit"] = unfit.what();
    }
  }
  if (wanted.plain) {
    const Answer stepwise = forwardStepwiseBic(input);
    const Answer lasso = lassoBic(input);
    record["stepwise"] = toJson(stepwise, judged(stepwise));
    record["lasso"] = toJson(lasso, judged(lasso));
  }
  if (!made.hidden.empty() && cell.kind != StudyKind::Outside) {
    const HeldOutSignal held_out = heldOutSignal(campaign, result.effect_part);
    if (endsInHeldOut(made))
      record["unknowable"] = true;
    else if (std::isfinite(held_out.explained()))
      record["held_out"] = {held_out.hidden, held_out.missed, heldOutStrength(campaign)};
  }
  return record;
}

void count(const nlohmann::json& record, Outcomes& all) {
  const std::size_t place = record.at("cell");
  const Cell& cell = cells().at(place);
  const std::uint64_t seed = record.at("seed");
  const auto hidden = record.at("hidden").get<std::vector<std::string>>();
  const auto nameable = record.at("nameable").get<std::vector<std::string>>();
  const auto [answer, verdict] = answerOf(record.at("search"));
  const Outcome outcome = verdict.outcome;
  const double ms = record.at("ms");
  std::optional<OracleFit> oracle;
  if (record.contains("oracle")) {
    const auto o = numbersOf(record.at("oracle"));
    oracle = OracleFit{o.at(0), o.at(1), o.at(2), o.at(3), o.at(4)};
  }
  all.search[place].add(answer, verdict);
  all.search_ms.push_back(ms);
  if (ms > all.longest_search.first) {
    all.longest_search = {ms, fmt::format("seed {}, {}, {} observations, hidden {}", seed, cell.name,
                                          record.at("observations").get<std::size_t>(), joinedList(hidden))};
  }
  if (record.contains("unknowable")) ++all.unknowable;
  if (record.contains("held_out")) {
    const auto h = numbersOf(record.at("held_out"));
    const HeldOutSignal held_out{h.at(0), h.at(1)};
    all.explained[place].push_back({held_out.explained(), h.at(2)});
    all.held_out[place].hidden += held_out.hidden;
    all.held_out[place].missed += held_out.missed;
    if (oracle) all.oracle[place].push_back(*oracle);
    if (outcome == Outcome::Named && record.contains("drivers") && cell.strength >= 4.0 &&
        held_out.explained() < 0.95) {
      std::string beside;
      if (oracle) {
        beside = fmt::format(
            " (names known {:.1f} %, without noise {:.1f} %, noise costs {:.1f} %, stated "
            "{:.1f} %, {:.1f} sigma)",
            100.0 * oracle->explained, 100.0 * oracle->noise_free, 100.0 * oracle->noise_cost,
            100.0 * oracle->stated_cost, oracle->strength);
      }
      all.poorly_explained.push_back(fmt::format("seed {:5} {:20} hidden {:42} explained {:5.1f} %{} by {}", seed,
                                                 cell.name, joinedList(hidden), 100.0 * held_out.explained(), beside,
                                                 record.at("drivers").get<std::string>()));
    }
  }
  if (cell.kind == StudyKind::One) {
    auto& [right, campaigns] = all.by_effect[hidden.front()];
    right += outcome == Outcome::Named || outcome == Outcome::Rival ? 1 : 0;
    ++campaigns;
  }
  for (const Answer::Listed& listed : answer.effects) {
    const bool right = std::any_of(nameable.begin(), nameable.end(),
                                   [&](const std::string& one) { return sameEffect(one, listed.id); });
    all.confidences.emplace_back(listed.confidence, right);
  }
  std::string limit;
  if (record.contains("missed")) {
    for (const auto& [id, gain] : record.at("missed").get<std::vector<std::pair<std::string, double>>>()) {
      limit += fmt::format("; put in by hand {} gains {:.0f} in BIC", id, gain);
      all.gains_of_missed[place].push_back(gain);
    }
  }
  if (outcome != Outcome::Named) {
    all.misses.push_back(fmt::format(
        "seed {:5} {:20} hidden {:42} -> {} [explained {:.3f}, {}{}]", seed, cell.name, joinedList(hidden),
        described(answer), numberOf(record.at("explained_fraction")),
        record.at("leftover").get<std::string>().empty() ? "nothing left" : record.at("leftover").get<std::string>(),
        limit));
  }
  for (const auto& [key, tallies] : {std::pair{"stepwise", &all.stepwise}, std::pair{"lasso", &all.lasso}}) {
    if (!record.contains(key)) continue;
    const auto [other, judged] = answerOf(record.at(key));
    (*tallies)[place].add(other, judged);
  }
}

/// Answers of a batch by item; says which are missing or failed.
std::vector<nlohmann::json> gathered(const std::filesystem::path& file, std::size_t items) {
  std::vector<nlohmann::json> records(items);
  std::istringstream lines(readFile(file));
  for (std::string line; std::getline(lines, line);) {
    const nlohmann::json j = nlohmann::json::parse(line);
    const std::string name = j.at("name");
    if (!name.starts_with("seed ")) throw InputError({file, ""}, "holds an item that is no seed: \"" + name + "\".");
    const std::size_t item = std::stoull(name.substr(5));
    if (item >= items)
      throw InputError(
          {file, ""},
          fmt::format("holds item {}; allowed: 0 to {}, those of the study with these options.", item, items - 1));
    if (!j.at("failed").get<bool>()) records[item] = j.at("answer");
  }
  return records;
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
  std::optional<std::size_t> item;
  std::vector<std::uint64_t> campaign_seeds;
  std::string gather;
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
    } else if (std::strcmp(argv[i], "--limit") == 0) {
      wanted.limit = true;
    } else if (std::strcmp(argv[i], "--list") == 0) {
      list = true;
    } else if (std::strcmp(argv[i], "--require") == 0) {
      required = true;
    } else if (std::strcmp(argv[i], "--kind") == 0) {
      only = value();
    } else if (std::strcmp(argv[i], "--cell") == 0) {
      part = value();
    } else if (std::strcmp(argv[i], "--only") == 0) {
      for (const std::string& one : splitList(value())) campaign_seeds.push_back(std::stoull(one));
    } else if (std::strcmp(argv[i], "--suggestion") == 0) {
      suggestion = true;
    } else if (std::strcmp(argv[i], "--item") == 0) {
      item = static_cast<std::size_t>(std::atoll(value().c_str()));
    } else if (std::strcmp(argv[i], "--gather") == 0) {
      gather = value();
    } else if (std::strcmp(argv[i], "--dump") == 0) {
      wanted.dump = value();
    } else {
      fmt::print(
          "usage: {} [--campaigns N] [--seed S] [--seeds K] [--short] [--plain] [--oracle] [--limit] [--list] "
          "[--require] "
          "[--kind one|two|three|nothing|outside|confounded] [--cell PART] [--only CAMPAIGN,...] [--dump DIR] "
          "[--suggestion] [--item I] [--gather FILE]\n",
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
  for (const std::uint64_t s : campaign_seeds) {
    const std::uint64_t k = s / 1000000, c = s % 1000000 / 10000, number = s % 10000;
    if (c >= cells().size()) {
      fmt::print(stderr, "there is no campaign {}; allowed: numbers that --list prints\n", s);
      return 2;
    }
    work.push_back({static_cast<std::size_t>(c), static_cast<std::size_t>(k * 7 + c * 11 + number), s});
  }
  for (std::uint64_t k = first_seed; campaign_seeds.empty() && k < first_seed + seeds; ++k) {
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
  JobContext job;
  if (item) {
    if (*item >= work.size()) {
      fmt::print(stderr, "item {} is not there; allowed: 0 to {}\n", *item, work.size() - 1);
      return 2;
    }
    fmt::print("{}\n", runOne(work[*item], wanted, job).dump());
    return 0;
  }
  std::vector<nlohmann::json> records(work.size());
  if (gather.empty()) {
    parallelFor(work.size(), job, [&](std::size_t i) {
      JobContext own;
      records[i] = runOne(work[i], wanted, own);
    });
  } else {
    records = gathered(gather, work.size());
  }
  if (!wanted.dump.empty()) {
    fmt::print("{} campaigns in {}\n", work.size(), wanted.dump.string());
    return 0;
  }

  Outcomes all;
  std::size_t missing = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const nlohmann::json& record = records[i];
    if (!record.is_object() || record.at("cell") != work[i].cell || record.at("seed") != work[i].seed)
      ++missing;
    else
      count(record, all);
  }
  if (missing > 0) {
    fmt::print("{} of {} campaigns are missing, failed, or of a study with other options\n", missing, work.size());
    return 1;
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
