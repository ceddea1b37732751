// SPDX-License-Identifier: Apache-2.0
// Every task of a campaign is declared here and nowhere else: what it is called, when there is one, what it is made
// from, the types of its options and of its result, and its work.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/scanning/evaluate_scans.h"
#include "core/session/fingerprint.h"
#include "core/tasks/report_task.h"
#include "core/tasks/scan_check_payload.h"
#include "core/tasks/second_campaign.h"
#include "core/tasks/task_graph.h"
#include "core/tasks/task_options.h"
#include "core/tasks/task_work.h"
#include "core/workflows/campaign_series.h"
#include "core/workflows/compensation_workflow.h"
#include "core/workflows/evaluate_campaign.h"
#include "core/workflows/fit_campaign.h"
#include "core/workflows/simulation_story.h"
#include "core/workflows/thermal_tests.h"
#include "core/workflows/verify_compensation.h"

namespace spindrift {
namespace {

using TaskIds = std::vector<std::string>;
template <class Result>
using Work = std::function<Result(JobContext&, TaskOutput)>;

/// Puts the types of a task behind what the graph sees of all tasks alike. T has
///   Options options(graph)                  what it would be run with now
///   Work<Result> work(options, graph, in)   that work, holding copies of what it needs
///   json payload(result)                    what is stored of its result
template <class T>
constexpr TaskKind declared(TaskKind kind) {
  kind.options = [](const TaskGraph& graph) { return optionsJson(T::options(graph)); };
  kind.options_of = [](const nlohmann::json& stored) {
    return optionsJson(optionsFrom<decltype(T::options(std::declval<const TaskGraph&>()))>(stored));
  };
  kind.prepare = [](const TaskGraph& graph, const TaskInputs& in) -> TaskWork {
    return [work = T::work(T::options(graph), graph, in)](JobContext& job, TaskOutput output) -> TaskResult {
      auto result = std::make_shared<decltype(work(job, output))>(work(job, output));
      nlohmann::json payload;
      if (output != TaskOutput::Detail) payload = T::payload(*result);
      return {std::move(payload), std::shared_ptr<const decltype(work(job, output))>(std::move(result))};
    };
  };
  return kind;
}

/// Of tasks that are run in one way only.
struct WithoutOptions {
  static NoOptions options(const TaskGraph& /*graph*/) { return {}; }
};

std::shared_ptr<const Campaign> included(const TaskInputs& in) {
  return withoutExcluded(*in.campaign, in.excluded);
}

template <class Choice>
Choice chosenFor(const TaskGraph& graph) {
  return chosen<Choice>(graph.session(), graph.campaign());
}

/// Two parts of the work, each wanted or not.
std::pair<JobContext, JobContext> parts(const JobContext& job, TaskOutput output) {
  const double middle = output == TaskOutput::Both ? 0.5 : output == TaskOutput::Payload ? 1.0 : 0.0;
  return {job.part(0.0, middle), job.part(middle, 1.0)};
}

TouchList touchesOf(const Campaign& campaign, const std::shared_ptr<const TouchList>& read) {
  if (read != nullptr) return *read;
  const auto list = campaign.captureList("touches.csv");
  if (!list) throw InputError({campaign.folder.string(), ""}, "lists no touches.");
  return TouchList::read(*list);
}

/// As the session keeps them and steps.cpp counts them.
std::string_view keptName(TouchState state) {
  constexpr std::array names{"plausible", "rejected", "excluded", "missing"};
  return names[static_cast<std::size_t>(state)];
}

bool ofImages(const CampaignFacts& facts) {
  return facts.images;
}
bool ofTouches(const CampaignFacts& facts) {
  return facts.touches;
}
bool ofScans(const CampaignFacts& facts) {
  return facts.scans;
}
bool always(const TaskGraph& /*graph*/) {
  return true;
}
bool ofCaptures(const TaskGraph& graph) {
  return graph.facts().captures();
}
bool withLog(const TaskGraph& graph) {
  return graph.facts().log;
}
bool logOnly(const TaskGraph& graph) {
  return graph.facts().log_only;
}
bool moreThanALog(const TaskGraph& graph) {
  return !graph.facts().log_only;
}
bool withSimulation(const TaskGraph& graph) {
  return !graph.facts().log_only && graph.facts().simulation;
}
std::string simulatorOf(const TaskGraph& graph) {
  return SimulationOptions::of(graph.session(), graph.campaign(), graph.data()).simulator;
}
bool withSimulator(const TaskGraph& graph) {
  return !graph.facts().log_only && !simulatorOf(graph).empty();
}

std::string withoutCaptures(const TaskGraph& graph) {
  return graph.facts().captures() ? std::string() : "There are no captures to evaluate yet.";
}

/// Captures are evaluated on the way: what comes from a campaign's own observations has no other input.
TaskIds fromCaptures(const TaskGraph& graph) {
  return graph.facts().own_observations || !graph.facts().captures() ? TaskIds() : TaskIds{"evaluate"};
}

struct CheckImages : WithoutOptions {
  static Work<CheckedCaptures> work(NoOptions /*options*/, const TaskGraph& /*graph*/, const TaskInputs& in) {
    return [campaign = included(in)](JobContext& job, TaskOutput) {
      return CheckedCaptures{checkFiducialCaptures(*campaign, job)};
    };
  }
  static nlohmann::json payload(const CheckedCaptures& checked) {
    nlohmann::json captures = nlohmann::json::array();
    for (const CheckedCapture& c : checked.captures) captures.push_back(c.json());
    return {{"captures", captures}};
  }
};

struct CheckTouches : WithoutOptions {
  static Work<TouchEvaluation> work(NoOptions /*options*/, const TaskGraph& /*graph*/, const TaskInputs& in) {
    return [campaign = included(in), list = in.touches](JobContext& job, TaskOutput) {
      return evaluateTouchList(*campaign, touchesOf(*campaign, list), {}, {}, job);
    };
  }
  static nlohmann::json payload(const TouchEvaluation& evaluation) {
    nlohmann::json counts = nlohmann::json::object();
    for (const TouchVerdict& v : allVerdicts(evaluation)) {
      const std::string name(keptName(v.state));
      counts[name] = counts.value(name, 0) + 1;
    }
    return {{"touches", counts}};
  }
};

struct CheckScans : WithoutOptions {
  static Work<ScanChecks> work(NoOptions /*options*/, const TaskGraph& /*graph*/, const TaskInputs& in) {
    return [campaign = included(in)](JobContext& job, TaskOutput) { return ScanChecks{checkScans(*campaign, job)}; };
  }
  static nlohmann::json payload(const ScanChecks& checked) { return payloadOfScanChecks(checked.scans); }
};

struct Evaluate : WithoutOptions {
  static Work<EvaluationDetail> work(NoOptions /*options*/, const TaskGraph& graph, const TaskInputs& in) {
    return [campaign = included(in), facts = graph.facts(), list = in.touches](JobContext& job, TaskOutput output) {
      auto [first, second] = parts(job, output);
      EvaluationDetail detail;
      if (output != TaskOutput::Detail)
        detail.evaluated = std::make_shared<const CampaignEvaluation>(evaluateCampaign(*campaign, {}, first));
      if (output != TaskOutput::Payload) show(detail, *campaign, facts, list, second);
      return detail;
    };
  }
  static nlohmann::json payload(const EvaluationDetail& detail) { return payloadOf(*detail.evaluated); }

 private:
  static void show(EvaluationDetail& detail, const Campaign& campaign, const CampaignFacts& facts,
                   const std::shared_ptr<const TouchList>& list, const JobContext& job) {
    JobContext first = job.part(0.0, facts.scans ? 0.5 : 1.0);
    JobContext second = job.part(facts.touches ? 0.5 : 0.0, 1.0);
    if (facts.touches) {
      auto touches =
          std::make_shared<TouchEvaluation>(evaluateTouchList(campaign, touchesOf(campaign, list), {}, {}, first));
      // Only spheres qualify a probe; a hole bar says nothing about it.
      if (!touches->ball_cycles.empty()) detail.health = checkProbeHealth(touches->touches, campaign.machine);
      if (const CycleEvaluation* cycles = cyclesOf(touches.get())) detail.repeatability = studyRepeatability(*cycles);
      detail.touches = std::move(touches);
    }
    if (facts.scans) detail.scans = std::make_shared<const ScanEvaluation>(evaluateScanCampaign(campaign, "", second));
  }
};

template <CheckResult (*check)(const ObservationSet&, const MachineDescription&), int thousandths>
struct InstrumentCheck {
  static InstrumentCheckOptions options(const TaskGraph& /*graph*/) { return {1e-3 * thousandths}; }
  static Work<CheckResult> work(InstrumentCheckOptions /*options*/, const TaskGraph& /*graph*/, const TaskInputs& in) {
    return [campaign = in.campaign, observations = in.observations](JobContext&, TaskOutput) {
      return check(*observations, campaign->machine);
    };
  }
  static nlohmann::json payload(const CheckResult& result) { return result.json; }
};

struct CheckWarmUp {
  static WarmUpCheckOptions options(const TaskGraph& /*graph*/) { return {}; }
  static Work<CheckResult> work(WarmUpCheckOptions options, const TaskGraph& graph, const TaskInputs& in) {
    return [campaign = in.campaign, observations = in.observations, options,
            offsets = clockOffsetsOf(graph.session(), graph.campaign())](JobContext&, TaskOutput) {
      const std::optional<ObservationSet> own = warmUpMeasurement(*campaign, offsets);
      if (!own && observations == nullptr) throw InputError(std::string(nothing_evaluated));
      WarmUpOptions limits;
      limits.drift_limit_um_per_h = options.drift_limit_um_per_h;
      return checkResultOf(
          judgeWarmUp(own ? *own : *observations, {}, limits, campaign->log ? &*campaign->log : nullptr));
    };
  }
  static nlohmann::json payload(const CheckResult& result) { return result.json; }
  static std::string blocked(const TaskGraph& graph) {
    return std::string(graph.facts().warm_up || graph.hasObservations() ? "" : nothing_evaluated);
  }
  static TaskIds madeFrom(const TaskGraph& graph) { return graph.facts().warm_up ? TaskIds() : fromCaptures(graph); }
};

struct FitCycles {
  static ModelOptions<CycleChoice> options(const TaskGraph& graph) { return {"cycles", chosenFor<CycleChoice>(graph)}; }
  static Work<TouchEvaluation> work(const ModelOptions<CycleChoice>& options, const TaskGraph& /*graph*/,
                                    const TaskInputs& in) {
    return
        [campaign = included(in), list = in.touches, options = options.choice.options()](JobContext& job, TaskOutput) {
          TouchEvaluation evaluation = evaluateTouchList(*campaign, touchesOf(*campaign, list), options, {}, job);
          if (cyclesOf(&evaluation) == nullptr) throw InputError("The touches make up no whole cycle.");
          return evaluation;
        };
  }
  static nlohmann::json payload(const TouchEvaluation& evaluation) {
    nlohmann::json payload = cyclesJson(*cyclesOf(&evaluation));
    payload["warnings"] = cyclesOf(&evaluation)->warnings;
    return payload;
  }
};

struct FitAxisErrors {
  static AxisErrorOptions options(const TaskGraph& graph) {
    return {"axis-errors", chosenFor<ScanModelChoice>(graph).model};
  }
  static Work<AxisErrorResult> work(const AxisErrorOptions& options, const TaskGraph& /*graph*/, const TaskInputs& in) {
    return [campaign = included(in), model = options.scan_model](JobContext& job, TaskOutput) {
      auto scans = std::make_shared<const ScanEvaluation>(evaluateScanCampaign(*campaign, model, job));
      InstrumentEvaluation found = observationsOfScans(*campaign, *scans);
      AxisErrorResult result{scans, std::move(found.details), found.good_enough, {}};
      if (!found.good_enough) result.why_not = found.warnings.back().sentence;
      return result;
    };
  }
  static nlohmann::json payload(const AxisErrorResult& result) {
    nlohmann::json payload = result.details;
    payload["status"] = toString(result.good_enough ? FitStatus::Converged : FitStatus::Degenerate);
    payload["message"] = result.why_not;
    return payload;
  }
};

struct FitNineParameters {
  static ModelOptions<NineParameterChoice> options(const TaskGraph& graph) {
    return {"nine-parameter", chosenFor<NineParameterChoice>(graph)};
  }
  static Work<NineParameterResult> work(const ModelOptions<NineParameterChoice>& options, const TaskGraph& /*graph*/,
                                        const TaskInputs& in) {
    return [campaign = in.campaign, observations = in.observations, options = options.choice.options()](
               JobContext&, TaskOutput output) {
      NineParameterResult result;
      result.fit = fitNineParameters(*observations, options);
      result.order = chooseTableOrder(result.fit);
      try {
        if (output != TaskOutput::Payload) result.compared = compareWithOthers(*observations, result.fit, options);
      } catch (const InputError& e) {
        result.not_compared = e.what();
      }
      if (output != TaskOutput::Payload)
        result.maps = nineParameterMaps(campaign->machine, result.fit, result.order, result.compared);
      return result;
    };
  }
  static nlohmann::json payload(const NineParameterResult& result) {
    const NineParameterFit& fit = result.fit;
    nlohmann::json parameters = nlohmann::json::object();
    for (int i = 0; i < nine_parameter_count; ++i) {
      parameters[std::string(nine_parameter_names[static_cast<std::size_t>(i)])] = {
          {"value", jsonNumber(fit.determined(i) ? fit.parameters[i] : std::nan(""))},
          {"standard_uncertainty", jsonNumber(fit.standardUncertainty(i))}};
    }
    const nlohmann::json full = toJson(fit);
    return {{"parameters", parameters},
            {"state", fit.state},
            {"status", std::string(toString(fit.status))},
            {"message", fit.message},
            {"rejected", fit.rejected()},
            {"parameter_order", full.at("parameter_order")},
            {"covariance", full.at("covariance")},
            {"higher_order", result.order.json()}};
  }
};

struct Thermal {
  static ModelOptions<ThermalChoice> options(const TaskGraph& graph) {
    return {"thermal", chosenFor<ThermalChoice>(graph)};
  }
  static Work<IdentifyResult> work(const ModelOptions<ThermalChoice>& options, const TaskGraph& /*graph*/,
                                   const TaskInputs& in) {
    return [campaign = included(in), observations = in.observations, read = in.series, choice = options.choice](
               JobContext& job, TaskOutput) {
      JobContext reading = job.part(0.0, read != nullptr ? 0.0 : 0.2);
      JobContext identifying = job.part(read != nullptr ? 0.0 : 0.2, 1.0);
      const TimeSeries series = read != nullptr ? *read : campaignSeries(*campaign, observations.get(), reading).series;
      if (series.time_s.size() < 2) throw InputError("the log has a single row.");
      return identifyThermalModel(series, choice.request(series), identifying);
    };
  }
  static nlohmann::json payload(const IdentifyResult& result) { return result.json(); }
  static std::string blocked(const TaskGraph& graph) {
    return graph.facts().log ? std::string() : "The campaign has no log.";
  }
};

struct ThermalTest {
  static Iso230Choice options(const TaskGraph& graph) { return chosenFor<Iso230Choice>(graph); }
  static Work<StandardTest> work(const Iso230Choice& choice, const TaskGraph& /*graph*/, const TaskInputs& in) {
    return [campaign = included(in), observations = in.observations, read = in.series, choice](JobContext& job,
                                                                                               TaskOutput) {
      const auto series =
          read != nullptr
              ? read
              : std::make_shared<const TimeSeries>(campaignSeries(*campaign, observations.get(), job).series);
      return standardTestOf(*series, [&](const TimeSeries& of) { return choice.request(of); });
    };
  }
  static nlohmann::json payload(const StandardTest& test) { return test.json(); }
};

struct CompensateLog : WithoutOptions {
  static constexpr auto model = "thermal";
  static Work<LogCompensation> work(NoOptions /*options*/, const TaskGraph& graph, const TaskInputs& in) {
    const StoredResult* stored = graph.latest(model);
    if (stored == nullptr) throw InputError(blocked(graph));
    return [campaign = included(in), observations = in.observations, stored = stored->payload.at("model"),
            test = optionsFrom<ModelOptions<ThermalChoice>>(stored->provenance.options).choice.test](JobContext& job,
                                                                                                     TaskOutput) {
      const TimeSeries series = campaignSeries(*campaign, observations.get(), job).series;
      LogCompensation result;
      result.model = ThermalModel::parse(JsonNode::parse(stored.dump(), "model"));
      result.run = runCompensator(series, result.model, judgedRange(test, series), job);
      return result;
    };
  }
  static nlohmann::json payload(const LogCompensation& result) { return result.run.result.json(); }
  static std::string blocked(const TaskGraph& graph) {
    return graph.latest(model) != nullptr ? std::string() : "Identify a model over time first (Model).";
  }
  static TaskIds madeFrom(const TaskGraph& /*graph*/) { return {model}; }
};

struct Discrepancy {
  static DiscrepancyTaskOptions options(const TaskGraph& graph) { return {chosenFor<EffectOptions>(graph)}; }
  static Work<DiscrepancyStory> work(const DiscrepancyTaskOptions& options, const TaskGraph& graph,
                                     const TaskInputs& in) {
    return [campaign = included(in), observations = in.observations, effects = options.effects,
            file = EffectOptions::file(graph.session(), graph.campaign())](JobContext& job, TaskOutput) {
      DiscrepancyOptions search;
      search.accept = effects.added;
      search.reject = effects.rejected;
      return tellDiscrepancy(*effects.applied(campaign, file), *observations, search, job);
    };
  }
  static nlohmann::json payload(const DiscrepancyStory& story) { return story.json(); }
  static std::string blocked(const TaskGraph& graph) {
    return graph.facts().simulation ? std::string() : "This campaign comes without a simulation to compare with.";
  }
};

struct Simulation {
  static SimulationOptions options(const TaskGraph& graph) {
    return SimulationOptions::of(graph.session(), graph.campaign(), graph.data());
  }
  static Work<DiscrepancyRun> work(const SimulationOptions& /*options*/, const TaskGraph& graph, const TaskInputs& in) {
    return [task = SimulationTask::of(graph, in)](JobContext& job, TaskOutput) { return task.search(job); };
  }
  static nlohmann::json payload(const DiscrepancyRun& run) { return SimulationStory::of(run).json(); }
  static std::string blocked(const TaskGraph& graph) {
    return simulatorOf(graph).empty() ? "There is no simulator to search with: campaign.json names none and none was "
                                        "chosen (Discrepancy)."
                                      : std::string();
  }
  static void addInputs(const TaskGraph& graph, nlohmann::json& inputs) {
    const std::string name = simulatorOf(graph);
    inputs["simulator"] = name.empty() ? std::string() : simulatorFingerprint(placeNamed(graph.session(), name));
  }
  /// A search that wrote a new version of its simulator counts as one with the version while that is at hand.
  static void asNow(Provenance& then, const ResultOrigin& now) {
    auto options = optionsFrom<SimulationOptions>(then.options);
    if (!options.version.empty() && options.version == optionsFrom<SimulationOptions>(now.options).simulator) {
      options.simulator = options.version;
      then.inputs["simulator"] = options.written;
    }
    options.version.clear();
    options.written.clear();
    then.options = optionsJson(options);
  }
};

struct Compensation {
  static constexpr auto fit = "fit";
  static CompensationTaskOptions options(const TaskGraph& graph) {
    return CompensationTaskOptions::of(graph.session(), graph.campaign(), graph.latest(fit) != nullptr);
  }
  static Work<CompensationPlan> work(const CompensationTaskOptions& options, const TaskGraph& graph,
                                     const TaskInputs& in) {
    return [campaign = included(in), observations = in.observations, options,
            file = EffectOptions::file(graph.session(), graph.campaign())](JobContext& job, TaskOutput) {
      return planCompensation(*options.effects.applied(campaign, file), *observations, options.request(), job);
    };
  }
  static nlohmann::json payload(const CompensationPlan& plan) { return plan.json(); }
  /// The fit that it is for, unless it is for effects that were added to the simulation.
  static TaskIds after(const TaskGraph& graph) {
    return graph.latest(fit) == nullptr && chosenFor<EffectOptions>(graph).added.empty() ? TaskIds{fit} : TaskIds();
  }
  static std::string blocked(const TaskGraph& graph) {
    if (after(graph).empty()) return {};
    return graph.facts().simulation ? "Fit a model or add a missing effect to the simulation first."
                                    : "Fit a model first.";
  }
};

struct Verify {
  static VerifyTaskOptions options(const TaskGraph& graph) { return {chosenFor<VerifyOptions>(graph)}; }
  static std::filesystem::path secondFolder(const TaskGraph& graph, const VerifyOptions& options) {
    return options.after.empty() ? std::filesystem::path() : placeNamed(graph.session(), options.after);
  }
  static Work<VerifyResult> work(const VerifyTaskOptions& options, const TaskGraph& graph, const TaskInputs& in) {
    if (options.options.after.empty())
      throw InputError("Choose the campaign that was measured with the compensation on first.");
    // One campaign may hold both: what was taken while compensating is in the second set.
    return [campaign = included(in), before = in.observations, request = options.options.request,
            second = SecondCampaign::of(graph, in, secondFolder(graph, options.options))](JobContext& job, TaskOutput) {
      const SecondCampaign::Measured after = second.measured(job);
      return verifyCampaigns(*campaign, *before, *after.campaign, after.observations, request);
    };
  }
  static nlohmann::json payload(const VerifyResult& result) { return result.json(); }
  static std::string blocked(const TaskGraph& graph) {
    return graph.facts().log_only ? "A log alone has no plan that could be measured again. Log the machine with the "
                                    "compensation on and open that log as a campaign of its own."
                                  : std::string();
  }
  static void addInputs(const TaskGraph& graph, nlohmann::json& inputs) {
    inputs["after"] =
        fingerprintOfSecond(graph.session(), graph.campaign(), secondFolder(graph, chosenFor<VerifyOptions>(graph)));
  }
};

struct WriteReport {
  static ReportTaskOptions options(const TaskGraph& graph) {
    return ReportTaskOptions::of(graph.session(), graph.campaign());
  }
  static Work<WrittenReport> work(const ReportTaskOptions& /*options*/, const TaskGraph& graph, const TaskInputs& in) {
    return [task = ReportTask::of(graph, in.excluded)](JobContext& job, TaskOutput) { return task.run(job); };
  }
  static nlohmann::json payload(const WrittenReport& written) { return written.json(); }
  /// What it tells in full and would otherwise work out for itself: run first and stored, so that what is reported is
  /// what is shown. What cannot be run, or has just failed, is told as far as it goes; other results are told as
  /// outdated where they are.
  static TaskIds after(const TaskGraph& graph) {
    const auto wanted = [&](const char* id, bool told) {
      const std::vector<std::string> all = graph.tasks();
      if (!told || std::find(all.begin(), all.end(), id) == all.end()) return false;
      const TaskState state = graph.status(id).state;
      return state != TaskState::Current && state != TaskState::Failed && state != TaskState::Blocked &&
             graph.whyNot(id).empty();
    };
    TaskIds first;
    if (wanted("fit", taskKind("fit", graph.facts()).told && graph.latest("fit") != nullptr)) first.emplace_back("fit");
    if (wanted("discrepancy", options(graph).tells_discrepancy)) first.emplace_back("discrepancy");
    if (wanted("iso-230-3", options(graph).iso230.told(graph.data()))) first.emplace_back("iso-230-3");
    return first;
  }
  static std::string blocked(const TaskGraph& graph) {
    return canReport(graph.data(), graph.hasObservations()) ? std::string() : "There is nothing to report yet.";
  }
  /// A result, and what is said of one that does not hold any more.
  static std::string toldOf(const TaskGraph& graph, const std::string& id) {
    std::string result = graph.fingerprintOf(id);
    const StoredResult* latest = graph.latest(id);
    if (latest == nullptr) return result;
    const std::vector<std::string> changes = graph.changes(*latest);
    if (changes.empty()) return result;
    Fingerprint told;
    told.add(result);
    for (const std::string& change : changes) told.add(change);
    return told.text();
  }
  static void addInputs(const TaskGraph& graph, nlohmann::json& inputs) {
    // It has to be written again when what it tells is another.
    for (const TaskKind& kind : taskKinds())
      if (kind.told && &taskKind(kind.id, graph.facts()) == &kind)
        inputs[std::string(kind.id)] = toldOf(graph, std::string(kind.id));
    // What is printed word by word, beside the notes (an option).
    Fingerprint reasons;
    for (const Exclusion& exclusion : graph.session().exclusions(graph.campaign()))
      reasons.add(exclusion.item).add(exclusion.reason);
    const auto plan =
        graph.session().setting(campaignKey(option_keys::plan, graph.campaign())).value_or(nlohmann::json());
    inputs["reasons"] = reasons.text();
    inputs["plan"] = Fingerprint().add(plan.dump()).text();
  }
};

constexpr std::array kinds{
    declared<CheckImages>({.id = "check",
                           .title = "Checking the captures",
                           .is_for = ofImages,
                           .belongs = ofCaptures,
                           .blocked = withoutCaptures}),
    declared<CheckTouches>({.id = "check",
                            .title = "Checking the touches",
                            .revision = 2,
                            .is_for = ofTouches,
                            .belongs = ofCaptures,
                            .blocked = withoutCaptures}),
    declared<CheckScans>(
        {.id = "check", .title = "Checking the scans", .belongs = ofCaptures, .blocked = withoutCaptures}),
    declared<Evaluate>({.id = "evaluate",
                        .title = "Evaluating the captures",
                        .result = "the evaluation",
                        .revision = 2,
                        .is_for = ofImages,
                        .belongs = ofCaptures,
                        .blocked = withoutCaptures}),
    declared<Evaluate>({.id = "evaluate",
                        .title = "Evaluating the touches",
                        .revision = 4,
                        .is_for = ofTouches,
                        .belongs = ofCaptures,
                        .blocked = withoutCaptures}),
    declared<Evaluate>({.id = "evaluate",
                        .title = "Evaluating the scans",
                        .revision = 4,
                        .belongs = ofCaptures,
                        .blocked = withoutCaptures}),
    declared<CheckWarmUp>({.id = "check-warm-up",
                           .title = "Checking whether the instrument had settled",
                           .result = "the check of the warm-up",
                           .told = true,
                           .belongs = moreThanALog,
                           .blocked = CheckWarmUp::blocked,
                           .made_from = CheckWarmUp::madeFrom}),
    declared<InstrumentCheck<checkJogs, 1000>>({.id = "check-jogs",
                                                .title = "Checking the jogs",
                                                .result = "the check of the jogs",
                                                .of_observations = true,
                                                .told = true,
                                                .belongs = moreThanALog,
                                                .made_from = fromCaptures}),
    declared<InstrumentCheck<checkRepeatability, 500>>({.id = "check-repeatability",
                                                        .title = "Checking the repeatability",
                                                        .result = "the check of the repeatability",
                                                        .of_observations = true,
                                                        .told = true,
                                                        .belongs = moreThanALog,
                                                        .made_from = fromCaptures}),
    declared<FitCycles>({.id = "fit",
                         .title = "Fitting all cycles",
                         .result = "the fitted model",
                         .revision = 5,
                         .of_observations = true,
                         .told = true,
                         .is_for = ofTouches,
                         .belongs = moreThanALog,
                         .made_from = fromCaptures}),
    declared<FitAxisErrors>({.id = "fit",
                             .title = "Finding the six errors",
                             .of_observations = true,
                             .told = true,
                             .is_for = ofScans,
                             .belongs = moreThanALog,
                             .made_from = fromCaptures}),
    declared<FitNineParameters>({.id = "fit",
                                 .title = "Fitting the nine-parameter model",
                                 .revision = 2,
                                 .of_observations = true,
                                 .belongs = moreThanALog,
                                 .made_from = fromCaptures}),
    declared<Thermal>({.id = "thermal",
                       .title = "Identifying the model",
                       .result = "the model over time",
                       .revision = 4,
                       .told = true,
                       .belongs = withLog,
                       .blocked = Thermal::blocked,
                       .made_from = fromCaptures}),
    declared<ThermalTest>({.id = "iso-230-3",
                           .title = "Evaluating the test of ISO 230-3",
                           .result = "the test of ISO 230-3",
                           .told = true,
                           .belongs = withLog,
                           .blocked = Thermal::blocked,
                           .made_from = fromCaptures}),
    declared<CompensateLog>({.id = "log-compensation",
                             .title = "Running the compensator",
                             .result = "the compensation over the log",
                             .told = true,
                             .belongs = logOnly,
                             .blocked = CompensateLog::blocked,
                             .made_from = CompensateLog::madeFrom}),
    declared<Discrepancy>({.id = "discrepancy",
                           .title = "Searching for what the simulation lacks",
                           .revision = 8,
                           .of_observations = true,
                           .belongs = withSimulation,
                           .blocked = Discrepancy::blocked,
                           .made_from = fromCaptures}),
    declared<Simulation>({.id = "simulation",
                          .title = "Searching with the simulator",
                          .result = "the search with the simulator",
                          .revision = 4,
                          .of_observations = true,
                          .told = true,
                          .starts_programs = true,
                          .belongs = withSimulator,
                          .blocked = Simulation::blocked,
                          .made_from = fromCaptures,
                          .add_inputs = Simulation::addInputs,
                          .as_now = Simulation::asNow}),
    declared<Compensation>({.id = "compensation",
                            .title = "Calculating the compensation",
                            .result = "the compensation",
                            .revision = 3,
                            .of_observations = true,
                            .told = true,
                            .belongs = moreThanALog,
                            .blocked = Compensation::blocked,
                            .made_from = fromCaptures,
                            .after = Compensation::after}),
    declared<Verify>({.id = "verify",
                      .title = "Comparing before and after",
                      .result = "the comparison of before and after",
                      .revision = 3,
                      .of_observations = true,
                      .told = true,
                      .belongs = moreThanALog,
                      .blocked = Verify::blocked,
                      .made_from = fromCaptures,
                      .add_inputs = Verify::addInputs}),
    declared<WriteReport>({.id = "report",
                           .title = "Writing the report",
                           .writes_files = true,
                           .belongs = always,
                           .blocked = WriteReport::blocked,
                           .made_from = fromCaptures,
                           .after = WriteReport::after,
                           .add_inputs = WriteReport::addInputs}),
};

}  // namespace

std::span<const TaskKind> taskKinds() noexcept {
  return kinds;
}

}  // namespace spindrift
