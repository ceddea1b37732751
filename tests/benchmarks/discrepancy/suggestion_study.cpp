// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/discrepancy/suggestion_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/simulation/programme.h"
#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"
#include "tests/benchmarks/discrepancy/study_report.h"

namespace spindrift::study {
namespace {

constexpr double day_s = 86400.0;
constexpr double named_alone_at_least = 0.85;

struct Case {
  const char* name;
  double strength;
  bool noisy;
  bool tied;  ///< everything on the machine starts and stops together, as in a series of the same part
};
constexpr Case cases[] = {{"clean, 0.8", 0.8, false, false}, {"clean, 1.5", 1.5, false, false},
                          {"noise, 1.5", 1.5, true, false},  {"noise, 3", 3.0, true, false},
                          {"tied, 1.5", 1.5, false, true},   {"tied, noise, 3", 3.0, true, true}};

/// Noise of a workshop. Gaps are left out: they would differ from the first day to both days together.
StudyConditions noise() {
  StudyConditions c = StudyConditions::together();
  c.gaps = false;
  return c;
}

/// What is measured on the second day.
struct Plan {
  std::vector<MachinePoint> places;
  std::vector<double> times_s;  ///< since the morning of the second day
  std::vector<double> c_deg;    ///< at every time; empty: as on the first day
  Programme programme;
  double duration_s = 0.0;
  bool restart_instrument = false;
};

/// The work of the first day, a rest, and the work of the second.
Programme twoDays(const Programme& first, double first_duration_s, const Programme* second, bool restart_instrument) {
  std::vector<ProgrammeSegment> segments;
  for (const ProgrammeSegment& segment : first.segments()) {
    if (segment.from_s < first_duration_s) segments.push_back(segment);
  }
  ProgrammeSegment rest = segments.back();
  rest.from_s = first_duration_s;
  rest.spindle_rpm = 0.0;
  rest.feed_mm_min = {};
  rest.c_rpm = 0.0;
  rest.coolant = false;
  rest.instrument_on = !restart_instrument;
  segments.push_back(rest);
  if (second != nullptr) {
    for (ProgrammeSegment segment : second->segments()) {
      segment.from_s += day_s;
      segment.instrument_on = true;
      segments.push_back(segment);
    }
  }
  return Programme(std::move(segments));
}

OperatingLog firstDay(const OperatingLog& whole, double until_s) {
  std::vector<double> times;
  for (const double t : whole.time_s()) {
    if (t < until_s) times.push_back(t);
  }
  OperatingLog log(times);
  for (const std::string& name : whole.names()) {
    const std::vector<double>& values = *whole.signal(name);
    log.setSignal(name, {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(times.size())});
  }
  return log;
}

/// A campaign of the study whose plant runs for two days, the second at rest.
struct Setup {
  StudyCase made;
  Programme work;
  double work_s = 0.0;
};

/// Cycles of one part: spindle, axes and coolant run and rest together, at one of three paces.
Programme tiedProgramme(const Scenario& s, std::uint64_t seed) {
  const Programme drawn = randomProgramme(s.machine, s.random_programme, seed);
  Random random(seed ^ 0x71edULL);
  std::vector<ProgrammeSegment> segments{drawn.segments().front()};
  double t = s.random_programme.idle_s;
  double pace = 0.0;
  while (t < s.duration_s) {
    ProgrammeSegment next = segments.front();
    next.from_s = std::round(t);
    pace = pace > 0.0 && random.uniform() < 0.6 ? 0.0 : random.uniform() < 0.5 ? 0.5 : 1.0;
    next.spindle_rpm = 6000.0 * pace;
    next.feed_mm_min = {12000.0 * pace, 9000.0 * pace, 6000.0 * pace};
    next.c_rpm = s.machine.rotary.empty() ? 0.0 : 30.0 * pace;
    next.coolant = pace > 0.0;
    segments.push_back(next);
    t += random.uniform(0.4, 1.6) * s.random_programme.mean_hold_s;
  }
  return Programme(std::move(segments));
}

Setup setUp(const Case& which, std::size_t turn, std::uint64_t seed) {
  StudyOptions options;
  options.strength = which.strength;
  options.turn = turn;
  if (which.noisy) options.conditions = noise();
  Setup setup;
  setup.made = studyCase(options, seed);
  Scenario& s = setup.made.scenario;
  setup.work_s = s.duration_s;
  const std::uint64_t work_seed = Random(seed ^ 0xda11ULL).bits();
  setup.work = which.tied ? tiedProgramme(s, work_seed) : randomProgramme(s.machine, s.random_programme, work_seed);
  s.duration_s = day_s + 2.0 * setup.work_s;
  s.programme = twoDays(setup.work, setup.work_s, nullptr, false);
  return setup;
}

/// Measures the second day on the machine of the first, whose causes have the sizes that they had.
DiscrepancyInput withSecondDay(const Setup& setup, const StudyCampaign& first, const DiscrepancyInput& known,
                               const Plan& plan, std::uint64_t noise_seed) {
  Scenario s = setup.made.scenario;
  s.programme = twoDays(setup.work, setup.work_s, &plan.programme, plan.restart_instrument);
  for (const auto& [id, setting] : first.campaign.truth.settings) {
    s.effects[id].setting = setting;
    s.effects[id].strength.reset();
  }
  MeasurementOptions& measurement = *s.measurement;
  measurement.holdout.clear();
  measurement.times_s.clear();
  for (const double t : plan.times_s) measurement.times_s.push_back(day_s + t);
  if (!plan.c_deg.empty()) measurement.c_deg = plan.c_deg;
  measurement.points.clear();
  for (const MachinePoint& place : plan.places) {
    if (s.machine.findPoint(place.id) == nullptr) s.machine.points.push_back(place);
    measurement.points.push_back(place.id);
  }
  StudyCampaign second;
  second.campaign = simulateCampaign(s, {}, {});
  StudyConditions conditions = setup.made.conditions;
  conditions.sigma = false;
  (void)applyConditions(second.campaign, conditions, 0.0, 0.0, noise_seed);
  DiscrepancyInput added = inputOf(second.campaign);
  DiscrepancyInput both = known;
  both.log = added.log;
  for (std::size_t i = 0; i < added.observations.rows.size(); ++i) {
    Observation row = added.observations.rows[i];
    row.sigma *= first.applied.stated_over_real_sigma.at(row.component);
    row.state = "N" + row.state;
    both.observations.rows.push_back(row);
    both.predicted.push_back(added.predicted[i]);
  }
  return both;
}

/// A point of the machine by its name, or a place by its coordinates: "(0, 400, 120) mm".
std::optional<MachinePoint> placeNamed(const MachineDescription& machine, const std::string& name) {
  if (const MachinePoint* point = machine.findPoint(name)) return *point;
  MachinePoint place;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  if (std::sscanf(name.c_str(), "(%lf, %lf, %lf)", &x, &y, &z) != 3) return std::nullopt;
  place.id = name;
  place.kind = "fiducial";
  place.position_mm = {x, y, z};
  return place;
}

/// The programme of a suggestion, as the machine is told.
Programme programmeOf(const Setup& setup, const MeasurementSuggestion& suggestion) {
  std::vector<ProgrammeSegment> segments;
  for (const ProgrammeStep& step : suggestion.programme) {
    if (step.as_logged) {
      for (ProgrammeSegment segment : setup.work.segments()) {
        segment.from_s += step.from_s;
        if (segment.from_s < step.to_s) segments.push_back(segment);
      }
      continue;
    }
    ProgrammeSegment segment = setup.work.segments().front();
    segment.from_s = step.from_s;
    segment.spindle_rpm = step.spindle_rpm;
    segment.feed_mm_min = step.feed_mm_min;
    segment.position_mm = step.position_mm;
    segment.c_rpm = step.c_rpm;
    segment.coolant = step.coolant;
    segments.push_back(segment);
  }
  return Programme(std::move(segments));
}

Plan suggested(const Setup& setup, const MeasurementSuggestion& suggestion) {
  Plan plan;
  for (const std::string& name : suggestion.points) {
    if (auto place = placeNamed(setup.made.scenario.machine, name)) plan.places.push_back(*place);
  }
  plan.times_s = suggestion.times_s;
  plan.c_deg = suggestion.c_deg;
  plan.programme = programmeOf(setup, suggestion);
  plan.duration_s = suggestion.programme.back().to_s;
  plan.restart_instrument = suggestion.restart_instrument;
  return plan;
}

/// As many readings as `like` in the same span, at random times of a random day's work, at points that were measured
/// before.
Plan atRandom(const Setup& setup, const Plan& like, Random& random) {
  Plan plan = like;
  plan.c_deg.clear();
  plan.restart_instrument = random.uniform() < 0.5;
  RandomProgrammeOptions options = setup.made.scenario.random_programme;
  options.duration_s = like.duration_s;
  plan.programme = randomProgramme(setup.made.scenario.machine, options, random.bits());
  std::vector<MachinePoint> points = setup.made.scenario.machine.points;
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.index(i)]);
  points.resize(std::min(points.size(), like.places.size()));
  plan.places = points;
  for (double& time : plan.times_s) time = random.uniform(0.0, like.duration_s);
  std::sort(plan.times_s.begin(), plan.times_s.end());
  return plan;
}

Answer answerOf(const DiscrepancyResult& result) {
  Answer answer;
  answer.verdict = std::string(toString(result.verdict));
  for (const FoundEffect& effect : result.effects) {
    answer.effects.push_back({effect.id, effect.rivals, effect.confidence});
  }
  return answer;
}

/// How a second search ends.
enum class End { Alone, Ambiguous, Abstained, Wrong };

End endOf(const Answer& answer, const std::vector<std::string>& hidden) {
  switch (judge(answer, hidden).outcome) {
    case Outcome::Wrong:
      return End::Wrong;
    case Outcome::Abstained:
      return End::Abstained;
    case Outcome::Rival:
      return End::Ambiguous;
    case Outcome::Named:
      break;
  }
  for (const Answer::Listed& listed : answer.effects) {
    for (const std::string& rival : listed.rivals) {
      if (!containsEffect(rival, listed.id) && !sameEffect(rival, listed.id)) return End::Ambiguous;
    }
  }
  return End::Alone;
}

struct Ends {
  std::map<End, int> count;
  int n = 0;
  void add(End end) {
    ++count[end];
    ++n;
  }
};

struct Counts {
  int campaigns = 0;
  int ambiguous = 0;      ///< with the truth in the set
  int without = 0;        ///< of these, nothing is suggested
  double expected = 0.0;  ///< sum of the probabilities that the suggestions stated
  Ends suggestion;
  Ends chance;
};

const char* nameOf(End end) {
  constexpr const char* names[] = {"alone", "ambiguous", "nothing", "wrong"};
  return names[static_cast<int>(end)];
}

/// How a second search ended, and with what.
struct Second {
  End end = End::Abstained;
  Answer answer;
};

/// "a (b or c) + d".
std::string setText(const Answer& answer) {
  std::string set;
  for (const Answer::Listed& listed : answer.effects) {
    set += (set.empty() ? "" : " + ") + listed.id;
    if (!listed.rivals.empty()) set += " (" + joinedList(listed.rivals, "or") + ")";
  }
  return set.empty() ? answer.verdict : set;
}

void runOne(const Case& which, std::size_t turn, std::uint64_t seed, const SuggestionStudyOptions& options,
            Counts& counts, std::vector<std::string>& lines, std::mutex& mutex) {
  const Setup setup = setUp(which, turn, seed);
  StudyCampaign first = simulateStudy(setup.made, {});
  first.campaign.campaign.log = firstDay(*first.campaign.campaign.log, setup.work_s);
  const DiscrepancyInput input = inputOf(first.campaign);
  JobContext job;
  const DiscrepancyResult result = findDiscrepancy(input, {}, job);
  const Answer answer = answerOf(result);
  const Outcome outcome = judge(answer, setup.made.hidden).outcome;
  const bool right = outcome == Outcome::Named || outcome == Outcome::Rival;
  if (!right || endOf(answer, setup.made.hidden) != End::Ambiguous) {
    const std::scoped_lock lock(mutex);
    ++counts.campaigns;
    return;
  }
  const auto search = [&](const Plan& plan, std::uint64_t noise_seed) {
    DiscrepancyOptions again;
    again.suggest = false;
    const DiscrepancyInput both = withSecondDay(setup, first, input, plan, noise_seed);
    Answer found = answerOf(findDiscrepancy(both, again, job));
    const End end = endOf(found, setup.made.hidden);
    return Second{end, std::move(found)};
  };
  std::optional<Second> after;
  std::vector<Second> chance;
  Plan plan;
  if (result.suggestion) {
    plan = suggested(setup, *result.suggestion);
    after = search(plan, seed * 16 + 1);
  } else {  // chance measures nevertheless
    const DiscrepancyOptions usual;
    plan.places.resize(static_cast<std::size_t>(usual.suggest_points));
    plan.times_s.resize(static_cast<std::size_t>(usual.suggest_times));
    plan.duration_s = 3600.0 * usual.suggest_hours;
  }
  Random random(seed ^ 0x0badULL);
  for (int k = 0; k < options.random_draws; ++k) {
    chance.push_back(search(atRandom(setup, plan, random), seed * 16 + 2 + static_cast<std::uint64_t>(k)));
  }
  const std::scoped_lock lock(mutex);
  ++counts.campaigns;
  ++counts.ambiguous;
  if (after) {
    counts.suggestion.add(after->end);
  } else {
    ++counts.without;
  }
  for (const Second& second : chance) counts.chance.add(second.end);
  const std::string set = setText(answer);
  if (after) counts.expected += result.suggestion->probability_alone_expected;
  std::string line =
      fmt::format("seed {:7} {:12} hidden {:24} {} -> ", seed, which.name, joinedList(setup.made.hidden), set);
  line += after ? fmt::format("{} [expected {:.2f}, now {:.2f}: {}]; by chance", nameOf(after->end),
                              result.suggestion->probability_alone_expected, result.suggestion->probability_alone_now,
                              result.suggestion->conditions)
                : std::string("nothing suggested");
  for (const Second& second : chance) line += fmt::format(" {}", nameOf(second.end));
  if (after && after->end != End::Alone) line += "; after it " + setText(after->answer);
  lines.push_back(line);
}

}  // namespace

int runSuggestionStudy(const SuggestionStudyOptions& options) {
  struct Work {
    std::size_t which = 0;
    std::size_t turn = 0;
    std::uint64_t seed = 0;
  };
  std::vector<Work> work;
  for (std::size_t c = 0; c < std::size(cases); ++c) {
    const int count = options.campaigns / static_cast<int>(std::size(cases));
    for (int i = 0; i < count; ++i) {
      const auto number = static_cast<std::uint64_t>(i);
      work.push_back(
          {c, static_cast<std::size_t>(number + 13 * c), options.seed * 1000000 + 900000 + c * 10000 + number});
    }
  }
  std::vector<Counts> counts(std::size(cases));
  std::vector<std::string> lines;
  std::mutex mutex;
  const JobContext job;
  parallelFor(work.size(), job, [&](std::size_t i) {
    runOne(cases[work[i].which], work[i].turn, work[i].seed, options, counts[work[i].which], lines, mutex);
  });

  fmt::print("what to measure next: {} campaigns, seed {}; rates with 95 % intervals (Wilson)\n", work.size(),
             options.seed);
  fmt::print("{:14} {:>9} {:>9}  {:>24} {:>24} {:>8}   other ends of the suggestion\n", "case", "campaigns",
             "ambiguous", "alone after suggestion", "alone by chance", "expected");
  Counts all;
  const auto print = [](const char* name, Counts& c) {
    // Where nothing is suggested, the truth is not named alone.
    const int n = c.suggestion.n + c.without;
    fmt::print("{:14} {:9} {:9}  {:>24} {:>24} {:7.1f}%   none {}, ambiguous {}, nothing {}, wrong {}\n", name,
               c.campaigns, c.ambiguous, rate(c.suggestion.count[End::Alone], n),
               rate(c.chance.count[End::Alone], c.chance.n), n > 0 ? 100.0 * c.expected / n : 0.0, c.without,
               c.suggestion.count[End::Ambiguous], c.suggestion.count[End::Abstained], c.suggestion.count[End::Wrong]);
  };
  for (std::size_t c = 0; c < std::size(cases); ++c) {
    print(cases[c].name, counts[c]);
    all.campaigns += counts[c].campaigns;
    all.ambiguous += counts[c].ambiguous;
    all.without += counts[c].without;
    all.expected += counts[c].expected;
    for (const auto& [end, n] : counts[c].suggestion.count) all.suggestion.count[end] += n;
    for (const auto& [end, n] : counts[c].chance.count) all.chance.count[end] += n;
    all.suggestion.n += counts[c].suggestion.n;
    all.chance.n += counts[c].chance.n;
  }
  print("all", all);
  if (options.list) {
    std::sort(lines.begin(), lines.end());
    for (const std::string& line : lines) fmt::print("{}\n", line);
  }
  if (!options.required) return 0;
  const int n = all.suggestion.n + all.without;
  if (n == 0) return 0;
  const int alone = all.suggestion.count[End::Alone];
  const bool often = alone >= named_alone_at_least * n;
  const bool beats = all.chance.n == 0 ||
                     static_cast<double>(alone) / n > static_cast<double>(all.chance.count[End::Alone]) / all.chance.n;
  fmt::print("the truth alone after the suggestion in >= {:.0f} %: {}; more often than by chance: {}\n",
             100.0 * named_alone_at_least, often ? "reached" : "MISSED", beats ? "reached" : "MISSED");
  return often && beats ? 0 : 1;
}

}  // namespace spindrift::study
