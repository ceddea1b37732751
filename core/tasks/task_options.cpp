// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/task_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/session/fingerprint.h"
#include "core/workflows/campaign_series.h"

namespace spindrift {

std::string campaignKey(const std::string& key, std::int64_t campaign) {
  return fmt::format("{}/{}", key, campaign);
}

nlohmann::json campaignSetting(const Session& session, std::int64_t campaign, const std::string& key,
                               const nlohmann::json& otherwise) {
  // Undo leaves null where there was nothing.
  for (const std::string& name : {campaignKey(key, campaign), key}) {
    const auto kept = session.setting(name);
    if (kept && !kept->is_null()) return *kept;
  }
  return otherwise;
}

namespace {

nlohmann::json objectOf(const Session& session, std::int64_t campaign, const std::string& key) {
  nlohmann::json value = session.setting(campaignKey(key, campaign)).value_or(nlohmann::json::object());
  return value.is_object() ? value : nlohmann::json::object();
}

std::filesystem::path whole(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).lexically_normal();
}

}  // namespace

EffectOptions EffectOptions::of(const Session& session, std::int64_t campaign) {
  const nlohmann::json json = objectOf(session, campaign, option_keys::discrepancy);
  return {json.value("added", std::vector<std::string>()), json.value("rejected", std::vector<std::string>()),
          json.value("effects", nlohmann::json())};
}

nlohmann::json EffectOptions::json() const {
  nlohmann::json out{{"added", added}, {"rejected", rejected}};
  if (effects.is_object()) out["effects"] = effects;
  return out;
}

std::filesystem::path EffectOptions::file(const Session& session, std::int64_t campaign) {
  return session.folder() / "effects" / fmt::format("{}.json", campaign);
}

bool EffectOptions::considers(const std::string& id) const {
  return std::find(rejected.begin(), rejected.end(), id) == rejected.end();
}

void EffectOptions::consider(const std::string& id, bool considered) {
  std::erase(rejected, id);
  if (considered) return;
  std::erase(added, id);
  rejected.push_back(id);
}

std::shared_ptr<const Campaign> EffectOptions::applied(std::shared_ptr<const Campaign> campaign,
                                                       const std::filesystem::path& file) const {
  if (!effects.is_object()) return campaign;
  std::filesystem::create_directories(file.parent_path());
  writeFileAtomically(file, effects.dump(2) + "\n");
  auto copy = std::make_shared<Campaign>(*campaign);
  copy->effects = std::filesystem::absolute(file);
  return copy;
}

SimulationOptions SimulationOptions::of(const Session& session, std::int64_t campaign, const Campaign& data) {
  SimulationOptions options;
  options.effects = EffectOptions::of(session, campaign);
  const auto chosen = session.setting(campaignKey(option_keys::simulator, campaign));
  if (chosen && chosen->is_string()) {
    options.simulator = chosen->get<std::string>();
  } else if (!data.simulator.empty()) {
    options.simulator = simulatorName(session, data.path(data.simulator.string()));
  }
  return options;
}

nlohmann::json SimulationOptions::json() const {
  nlohmann::json choice = effects.json();
  choice.erase("added");
  return {{"simulator", simulator}, {"version", ""}, {"choice", std::move(choice)}};
}

std::string simulatorName(const Session& session, const std::filesystem::path& file) {
  const std::filesystem::path relative = whole(file).lexically_relative(whole(session.folder()));
  const bool within = !relative.empty() && *relative.begin() != "..";
  return within ? relative.generic_string() : whole(file).generic_string();
}

std::filesystem::path simulatorFile(const Session& session, const std::string& name) {
  return whole(session.folder()) / name;
}

std::string simulatorFingerprint(const std::filesystem::path& file) try {
  return Fingerprint().addFile(file).text();
} catch (const InputError&) {
  return {};
}

double allowedPart(const std::string& check) {
  return check == "check-repeatability" ? 0.5 : 1.0;
}

NineParameterOptions nineParameterOptions(const nlohmann::json& json) {
  NineParameterOptions options;
  if (!json.is_object()) return options;
  options.state = json.value("state", std::string());
  options.points = json.value("points", std::vector<std::string>());
  options.robust = static_cast<RobustLoss>(json.value("robust", 0));
  return options;
}

HoleCycleOptions cycleOptions(const nlohmann::json& json) {
  HoleCycleOptions options;
  if (!json.is_object()) return options;
  options.second_axis = json.value("second_axis", false);
  if (options.second_axis) {
    StableLength length;
    length.growth_um_per_m = json.value("growth_um_per_m", 0.0);
    length.uncertainty_um_per_m = json.value("trust_um_per_m", 0.1);
    options.stable_length = length;
  }
  return options;
}

IdentifyRequest identifyRequest(const nlohmann::json& json, const TimeSeries& series) {
  IdentifyRequest r;
  const std::vector<std::string> outputs = outputSignals(series);
  r.log = series.file;
  r.output = json.value("output", std::string());
  if (std::find(outputs.begin(), outputs.end(), r.output) == outputs.end() && !outputs.empty())
    r.output = outputs.front();
  const double first = series.time_s.front();
  const double last = series.time_s.back();
  const double middle = std::round(0.5 * (first + last));
  const auto range = [&](const char* key, double from, double to) {
    const nlohmann::json value = json.value(key, nlohmann::json());
    if (value.is_array() && value.size() == 2) return TimeRange{value[0].get<double>(), value[1].get<double>()};
    return TimeRange{from, to};
  };
  r.train = range("train", first, middle);
  r.test = range("test", middle, last);
  r.method = json.value("method", std::string("response"));
  // Cycles are too rare for the methods that need a value at every row.
  if (const Signal* signal = series.find(r.output); signal != nullptr && isSparse(*signal)) r.method = "response";
  for (const auto& name : json.value("inputs", nlohmann::json::array())) {
    const auto text = name.get<std::string>();
    if (series.find(text) != nullptr && text != r.output) r.inputs.push_back(text);
  }
  return r;
}

CompensationRequest compensationRequest(const Session& session, std::int64_t campaign, bool fitted) {
  const nlohmann::json json = objectOf(session, campaign, option_keys::compensation);
  const EffectOptions effects = EffectOptions::of(session, campaign);
  const auto possible = [&](CompensationSource source) {
    return source == CompensationSource::CompletedModel ? !effects.added.empty() : fitted;
  };
  CompensationRequest request;
  const CompensationSource first = possible(CompensationSource::CompletedModel) ? CompensationSource::CompletedModel
                                                                                : CompensationSource::NineParameters;
  request.source = static_cast<CompensationSource>(json.value("source", static_cast<int>(first)));
  if (!possible(request.source)) request.source = first;
  const NineParameterOptions fit =
      nineParameterOptions(campaignSetting(session, campaign, option_keys::nine_parameters, nlohmann::json::object()));
  request.state = json.value("state", std::string());
  // What the user chose for the fit; else the warmest.
  if (request.state.empty() && request.source != CompensationSource::CompletedModel) request.state = fit.state;
  request.positions = json.value("positions", 11);
  if (json.contains("reference_mm")) {
    const auto at = json["reference_mm"].get<std::vector<double>>();
    if (at.size() == 3) request.reference_mm = Eigen::Vector3d(at[0], at[1], at[2]);
  }
  request.fit.points = fit.points;
  request.fit.robust = fit.robust;
  request.added = effects.added;
  request.reject = effects.rejected;
  return request;
}

VerifyOptions VerifyOptions::of(const Session& session, std::int64_t campaign) {
  const nlohmann::json json = objectOf(session, campaign, option_keys::verify);
  VerifyOptions options;
  options.request.goal_um = json.value("goal_um", options.request.goal_um);
  options.request.goal_urad = json.value("goal_urad", options.request.goal_urad);
  options.request.criterion = json.value("criterion", "") == "rms" ? VerifyCriterion::Rms : VerifyCriterion::Largest;
  options.after = json.value("after", std::string());
  return options;
}

nlohmann::json VerifyOptions::json() const {
  return {{"goal_um", request.goal_um},
          {"goal_urad", request.goal_urad},
          {"criterion", request.criterion == VerifyCriterion::Rms ? "rms" : "largest"},
          {"after", after}};
}

ReportTaskOptions ReportTaskOptions::of(const Session& session, std::int64_t campaign) {
  ReportTaskOptions options;
  const nlohmann::json name = campaignSetting(session, campaign, option_keys::operator_name, nullptr);
  if (name.is_string()) options.operator_name = name.get<std::string>();
  options.tells_discrepancy = objectOf(session, campaign, option_keys::report).value("tells_discrepancy", true);
  for (const Note& note : session.notes(campaign)) {
    options.notes.push_back(note.created_utc + "  " + note.step + (note.item.empty() ? "" : ", " + note.item) + ": " +
                            note.text);
  }
  return options;
}

}  // namespace spindrift
