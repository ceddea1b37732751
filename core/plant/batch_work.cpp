// SPDX-License-Identifier: Apache-2.0
#include "core/plant/batch_work.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/machine/campaign.h"
#include "core/machine/nine_parameter_model.h"
#include "core/machine/table_polynomial.h"
#include "core/simulation/scenario.h"
#include "core/simulation/study_campaigns.h"
#include "core/simulation/virtual_campaign.h"
#include "core/workflows/campaign_series.h"
#include "core/workflows/discrepancy_workflow.h"
#include "core/workflows/evaluate_campaign.h"
#include "core/workflows/fit_campaign.h"
#include "core/workflows/thermal_workflow.h"

namespace spindrift {
namespace {

StudyKind studyKind(const JsonNode& options) {
  const std::string kind = options.has("kind")
                               ? options.at("kind").oneOf({"one", "two", "three", "nothing", "outside", "confounded"})
                               : "one";
  if (kind == "two") return StudyKind::Two;
  if (kind == "three") return StudyKind::Three;
  if (kind == "nothing") return StudyKind::Nothing;
  if (kind == "outside") return StudyKind::Outside;
  if (kind == "confounded") return StudyKind::Confounded;
  return StudyKind::One;
}

std::vector<std::string> texts(const JsonNode& options, const char* key) {
  std::vector<std::string> out;
  if (const auto list = options.find(key)) {
    for (const JsonNode& item : list->items()) out.push_back(item.string());
  }
  return out;
}

/// Verdict and names without the parts that are as large as the campaign.
nlohmann::json shortAnswer(const DiscrepancyRun& run) {
  nlohmann::json all = run.json();
  nlohmann::json out;
  for (const char* key : {"verdict", "effects", "gap", "candidates", "leftover", "clock_offset_s"}) {
    if (all.contains(key)) out[key] = all[key];
  }
  return out;
}

nlohmann::json simulateOne(const BatchPlan& plan, std::uint64_t seed, JobContext& job) {
  const std::filesystem::path out =
      std::filesystem::path(plan.options.at("out").get<std::string>()) / fmt::format("seed-{}", seed);
  // Another attempt may have come this far: what is there is whole, for it gets its name last.
  if (!std::filesystem::exists(out)) {
    const std::filesystem::path working = out.string() + fmt::format(".writing-{}", ::getpid());
    std::error_code none;
    std::filesystem::remove_all(working, none);
    std::filesystem::create_directories(out.parent_path());
    const Scenario scenario = Scenario::read(plan.options.at("scenario").get<std::string>());
    writeCampaign(simulateCampaign(scenario, seed, job.part(0.0, 0.5)), working, job);
    std::filesystem::rename(working, out, none);
    if (none) std::filesystem::remove_all(working, none);
  }
  return {{"campaign", out.string()}};
}

nlohmann::json hiddenEffect(const JsonNode& options, std::uint64_t seed, JobContext& job) {
  StudyOptions study;
  study.kind = studyKind(options);
  study.strength = options.numberOr("strength", study.strength);
  study.turn = static_cast<std::size_t>(seed);
  const StudyCase made = studyCase(study, seed);
  const StudyCampaign campaign = simulateStudy(made, job.part(0.0, 0.2));
  DiscrepancyOptions search;
  search.suggest = false;
  // The search reads the given simulation as it would from a campaign folder.
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("spindrift-batch-{}-{}", ::getpid(), seed);
  std::error_code none;
  std::filesystem::remove_all(folder, none);
  struct Away {
    std::filesystem::path folder;
    ~Away() {
      std::error_code ignored;
      std::filesystem::remove_all(folder, ignored);
    }
  } const away{folder};
  writeCampaign(campaign.campaign, folder);
  const Campaign read = Campaign::read(folder);
  JobContext searching = job.part(0.3, 1.0);
  SPINDRIFT_ASSERT(read.observations.has_value(), "a study measures something");
  const DiscrepancyRun run = searchDiscrepancy(read, *read.observations, search, searching);
  nlohmann::json out = shortAnswer(run);
  out["hidden"] = made.hidden;
  std::vector<std::string> named;
  for (const nlohmann::json& effect : out["effects"]) named.push_back(effect.at("id").get<std::string>());
  std::vector<std::string> hidden = made.hidden;
  std::sort(named.begin(), named.end());
  std::sort(hidden.begin(), hidden.end());
  out["right"] = named == hidden;
  return out;
}

nlohmann::json runCommand(const BatchPlan& plan, std::int64_t item, const JobContext& job) {
  std::vector<std::string> command;
  for (std::string argument : plan.options.at("run").get<std::vector<std::string>>()) {
    const auto put = [&](const std::string& key, const std::string& value) {
      for (std::size_t at; (at = argument.find(key)) != std::string::npos;) argument.replace(at, key.size(), value);
    };
    if (plan.seeds > 0) put("{seed}", std::to_string(plan.first_seed + static_cast<std::uint64_t>(item)));
    if (plan.seeds == 0) put("{campaign}", plan.campaigns[static_cast<std::size_t>(item)].string());
    command.push_back(argument);
  }
  const std::string printed = outputOf(command, job);
  nlohmann::json answer = nlohmann::json::parse(printed, nullptr, false);
  if (answer.is_discarded()) answer = {{"printed", std::string(trimmed(printed))}};
  return answer;
}

}  // namespace

std::string outputOf(const std::vector<std::string>& command, const JobContext& job) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw InputError(fmt::format("no pipe: {}.", std::strerror(errno)));
  std::vector<char*> arguments;
  for (const std::string& a : command) arguments.push_back(const_cast<char*>(a.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::setpgid(0, 0);
    ::dup2(ends[1], STDOUT_FILENO);
    ::signal(SIGTERM, SIG_DFL);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  std::string printed;
  bool ended_by_us = child < 0;
  const auto endAll = [&] {
    ::kill(-child, SIGKILL);
    ::kill(child, SIGKILL);
    ended_by_us = true;
  };
  std::array<char, 65536> buffer{};
  for (;;) {
    if (job.cancelled() && !ended_by_us) endAll();
    pollfd waiting{ends[0], POLLIN, 0};
    if (::poll(&waiting, 1, 50) <= 0) continue;  // below zero: a signal, of which the job may know more
    const ssize_t count = ::read(ends[0], buffer.data(), buffer.size());
    if (count <= 0) break;
    printed.append(buffer.data(), static_cast<std::size_t>(count));
    if (printed.size() > 64U << 20U) endAll();
  }
  ::close(ends[0]);
  int status = 0;
  while (child > 0 && ::waitpid(child, &status, WNOHANG) == 0) {
    if (job.cancelled() && !ended_by_us) endAll();
    ::usleep(20'000);
  }
  job.throwIfCancelled();
  if (child < 0) throw InputError(fmt::format("{} cannot be started: {}.", command[0], std::strerror(errno)));
  if (WIFSIGNALED(status))
    throw std::runtime_error(fmt::format("{} was ended by signal {}", command[0], WTERMSIG(status)));
  if (WEXITSTATUS(status) == 127) throw InputError(fmt::format("{} cannot be started.", command[0]));
  if (WEXITSTATUS(status) > 1)
    throw InputError(fmt::format("{} ended with exit status {}; allowed: 0 or 1.", command[0], WEXITSTATUS(status)));
  return printed;
}

nlohmann::json workOut(const BatchPlan& plan, std::int64_t item, JobContext& job) {
  const std::uint64_t seed = plan.first_seed + static_cast<std::uint64_t>(item);
  if (plan.work == "command") return runCommand(plan, item, job);
  if (plan.work == "simulate") return simulateOne(plan, seed, job);
  const JsonNode options = JsonNode::parse(plan.options.dump(), plan.name + ", options");
  if (plan.work == "hidden_effect") return hiddenEffect(options, seed, job);
  const std::filesystem::path& folder = plan.campaigns.at(static_cast<std::size_t>(item));
  if (plan.work == "discrepancy") {
    DiscrepancyRequest request;
    request.campaign = folder;
    request.options.suggest = false;
    request.options.max_effects = static_cast<int>(options.numberOr("max_effects", request.options.max_effects));
    request.options.accept = texts(options, "accept");
    request.options.reject = texts(options, "reject");
    return shortAnswer(runDiscrepancy(request, job));
  }
  const Campaign campaign = Campaign::read(folder);
  EvaluateOptions evaluate;
  evaluate.scan_model = options.stringOr("scan_model", "");
  if (plan.work == "evaluate") return evaluateCampaign(campaign, evaluate, job).json();
  if (plan.work == "identify") {
    IdentifyRequest request;
    request.output = options.at("output").name();
    request.inputs = texts(options, "inputs");
    request.train = TimeRange::parse(options.at("train").string(), "train");
    request.test = TimeRange::parse(options.at("test").string(), "test");
    JobContext reading = job.part(0.0, 0.2);
    return identifyThermalModel(campaignSeries(campaign, nullptr, reading).series, request, job.part(0.2, 1.0)).json();
  }
  SPINDRIFT_ASSERT(plan.work == "fit", "the plan was checked");
  NineParameterOptions fit;
  fit.state = options.stringOr("state", "");
  fit.points = texts(options, "points");
  std::vector<std::string> notes;
  const NineParameterFit found = fitNineParameters(observationsOf(campaign, {}, evaluate, job, &notes), fit);
  nlohmann::json answer = toJson(found, chooseTableOrder(found));
  answer.erase("residuals");
  if (!notes.empty()) answer["notes"] = notes;
  return answer;
}

}  // namespace spindrift
