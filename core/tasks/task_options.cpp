// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/task_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/rationed_answers.h"
#include "core/base/sha256.h"
#include "core/session/fingerprint.h"
#include "core/workflows/campaign_series.h"
#include "core/workflows/log_campaign.h"

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

std::filesystem::path whole(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).lexically_normal();
}

}  // namespace

template <>
nlohmann::json optionsJson(const ScanModelChoice& options) {
  return options.model;
}

template <>
ScanModelChoice optionsFrom<ScanModelChoice>(const nlohmann::json& json) {
  return {json.is_string() ? json.get<std::string>() : std::string()};
}

namespace {

/// Effects put down for work that reads them. The file is there for as long as somebody holds it; what a crash left of
/// the same campaign goes with the next one.
class EffectsFile {
 public:
  /// The one of this name, put down if nobody holds it. Its name says its content. Throws InputError.
  static std::shared_ptr<const EffectsFile> put(const std::filesystem::path& path, const std::string& text) {
    const std::lock_guard<std::mutex> lock(mutex());
    if (auto known = held()[path].lock()) return known;
    std::filesystem::create_directories(path.parent_path());
    writeFileAtomically(path, text);
    removeAbandoned(path);
    std::shared_ptr<const EffectsFile> put(new EffectsFile(path));
    held()[path] = put;
    return put;
  }
  EffectsFile(const EffectsFile&) = delete;
  EffectsFile& operator=(const EffectsFile&) = delete;
  ~EffectsFile() {
    const std::lock_guard<std::mutex> lock(mutex());
    const auto known = held().find(path_);
    if (known == held().end() || !known->second.expired()) return;  // put down again meanwhile
    held().erase(known);
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  explicit EffectsFile(std::filesystem::path path) : path_(std::move(path)) {}
  static std::mutex& mutex() {
    static std::mutex all;
    return all;
  }
  static std::map<std::filesystem::path, std::weak_ptr<const EffectsFile>>& held() {
    static std::map<std::filesystem::path, std::weak_ptr<const EffectsFile>> files;
    return files;
  }
  /// Files named after the same campaign ("3-<digits>.json") that nobody holds.
  static void removeAbandoned(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    const std::string campaign = name.substr(0, name.find('-') + 1);
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(path.parent_path(), ignored)) {
      const std::string other = entry.path().filename().string();
      if (other.size() != name.size() || !other.starts_with(campaign) || !other.ends_with(".json")) continue;
      if (entry.path() != path && !held().contains(entry.path())) std::filesystem::remove(entry.path(), ignored);
    }
  }

  std::filesystem::path path_;
};

}  // namespace

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
  const std::string text = effects.dump(2) + "\n";
  constexpr std::size_t digits = 16;
  const std::filesystem::path version =
      file.parent_path() / fmt::format("{}-{}.json", file.stem().string(), sha256(text).substr(0, digits));
  // Lives as long as anybody works with it.
  struct Applied {
    Campaign campaign;
    std::shared_ptr<const EffectsFile> file;
  };
  auto applied =
      std::make_shared<Applied>(Applied{*campaign, EffectsFile::put(std::filesystem::absolute(version), text)});
  applied->campaign.effects = applied->file->path();
  return {applied, &applied->campaign};
}

SimulationOptions SimulationOptions::of(const Session& session, std::int64_t campaign, const Campaign& data) {
  const auto effects = chosen<EffectOptions>(session, campaign);
  SimulationOptions options;
  options.choice = {effects.rejected, effects.effects};
  const auto kept = session.setting(campaignKey(option_keys::simulator, campaign));
  if (kept && kept->is_string()) {
    options.simulator = kept->get<std::string>();
  } else if (!data.simulator.empty()) {
    options.simulator = placeName(session, data.path(data.simulator.string()));
  }
  return options;
}

std::string placeName(const Session& session, const std::filesystem::path& file) {
  const std::filesystem::path relative = whole(file).lexically_relative(whole(session.folder()));
  const bool within = !relative.empty() && *relative.begin() != "..";
  return within ? relative.generic_string() : whole(file).generic_string();
}

std::filesystem::path placeNamed(const Session& session, const std::string& name) {
  return whole(session.folder()) / name;
}

namespace {

/// Files within `folder` that strings of the document name.
void addNamedFiles(const nlohmann::json& node, const std::filesystem::path& folder,
                   std::set<std::filesystem::path>& files) {
  if (node.is_structured()) {
    for (const nlohmann::json& part : node) addNamedFiles(part, folder, files);
    return;
  }
  if (!node.is_string()) return;
  const std::filesystem::path name = std::filesystem::path(node.get<std::string>()).lexically_normal();
  std::error_code error;
  if (name.empty() || name.is_absolute() || *name.begin() == "..") return;
  if (std::filesystem::is_regular_file(folder / name, error)) files.insert(name);
}

std::string fingerprintOfSimulator(const std::filesystem::path& file) try {
  Fingerprint fingerprint;
  fingerprint.addFile(file);
  // The scenario, the templates and the tables that it names belong to it.
  std::set<std::filesystem::path> files;
  const nlohmann::json document = nlohmann::json::parse(readFile(file), nullptr, false);
  if (!document.is_discarded()) addNamedFiles(document, file.parent_path(), files);
  for (const std::filesystem::path& name : files) fingerprint.addFile(file.parent_path() / name);
  return fingerprint.text();
} catch (const InputError&) {
  return {};
}

}  // namespace

std::string simulatorFingerprint(const std::filesystem::path& file) {
  static RationedAnswers simulators;  // the list of steps asks at every change, and a mesh may be large
  return simulators.about(file, fingerprintOfSimulator);
}

NineParameterOptions NineParameterChoice::options() const {
  NineParameterOptions options;
  options.state = state;
  options.points = points;
  options.robust = robust;
  return options;
}

HoleCycleOptions CycleChoice::options() const {
  HoleCycleOptions options;
  options.second_axis = second_axis;
  if (second_axis) {
    StableLength length;
    length.growth_um_per_m = growth_um_per_m;
    length.uncertainty_um_per_m = trust_um_per_m;
    options.stable_length = length;
  }
  return options;
}

IdentifyRequest ThermalChoice::request(const TimeSeries& series) const {
  const std::vector<std::string> outputs = outputSignals(series);
  IdentifyRequest r;
  r.log = series.file;
  r.output = output;
  if (std::find(outputs.begin(), outputs.end(), r.output) == outputs.end() && !outputs.empty())
    r.output = outputs.front();
  const double first = series.time_s.front();
  const double last = series.time_s.back();
  const double middle = std::round(0.5 * (first + last));
  r.train = train.value_or(TimeRange{first, middle});
  r.test = test.value_or(TimeRange{middle, last});
  r.method = method;
  // Cycles are too rare for the methods that need a value at every row.
  if (const Signal* signal = series.find(r.output); signal != nullptr && isSparse(*signal)) r.method = "response";
  for (const std::string& name : inputs)
    if (series.find(name) != nullptr && name != r.output) r.inputs.push_back(name);
  return r;
}

Iso230Request Iso230Choice::request(const TimeSeries& series) const {
  Iso230Request r;
  r.test = test.empty() ? standardTestIn(series) : test;
  if (ambient && (ambient->empty() || series.find(*ambient) != nullptr)) {
    r.ambient = *ambient;
    r.without_ambient = ambient->empty();
  }
  if (series.find(speed) != nullptr) r.speed = speed;
  // As it is offered: that of the spindle by its name, else the first.
  for (const Signal& s : series.signals)
    if (r.speed.empty() && s.kind == SignalKind::Speed && series.find("spindle_rpm") == nullptr) r.speed = s.name;
  if (!range.empty()) r.range = TimeRange::parse(range, "The range of the test");
  return r;
}

bool Iso230Choice::told(const Campaign& campaign) const {
  return campaign.log && (hasOutputSignals(*campaign.log) || *this != Iso230Choice());
}

CompensationTaskOptions CompensationTaskOptions::of(const Session& session, std::int64_t campaign, bool fitted) {
  CompensationTaskOptions options{chosen<CompensationChoice>(session, campaign),
                                  {},
                                  chosen<NineParameterChoice>(session, campaign),
                                  chosen<EffectOptions>(session, campaign)};
  const auto possible = [&](CompensationSource source) {
    return source == CompensationSource::CompletedModel ? !options.effects.added.empty() : fitted;
  };
  const CompensationSource first = possible(CompensationSource::CompletedModel) ? CompensationSource::CompletedModel
                                                                                : CompensationSource::NineParameters;
  options.source = options.choice.source.value_or(first);
  if (!possible(options.source)) options.source = first;
  return options;
}

CompensationRequest CompensationTaskOptions::request() const {
  CompensationRequest request;
  request.source = source;
  request.state = choice.state;
  // What the user chose for the fit; else the warmest.
  if (request.state.empty() && source != CompensationSource::CompletedModel) request.state = fit.state;
  request.positions = choice.positions;
  request.reference_mm = choice.reference_mm;
  request.fanuc_step = choice.fanuc;
  request.fit.points = fit.points;
  request.fit.robust = fit.robust;
  request.added = effects.added;
  request.reject = effects.rejected;
  return request;
}

ReportTaskOptions ReportTaskOptions::of(const Session& session, std::int64_t campaign) {
  ReportTaskOptions options;
  const nlohmann::json name = campaignSetting(session, campaign, option_keys::operator_name, nullptr);
  if (name.is_string()) options.operator_name = name.get<std::string>();
  options.tells_discrepancy = chosen<ReportChoice>(session, campaign).tells_discrepancy;
  for (const Note& note : session.notes(campaign)) {
    options.notes.push_back(note.created_utc + "  " + note.step + (note.item.empty() ? "" : ", " + note.item) + ": " +
                            note.text);
  }
  options.effects = chosen<EffectOptions>(session, campaign);
  options.fit = chosen<NineParameterChoice>(session, campaign);
  options.iso230 = chosen<Iso230Choice>(session, campaign);
  const auto kept = [&](const char* key) {
    return session.setting(campaignKey(key, campaign)).value_or(nlohmann::json());
  };
  if (nlohmann::json warm = kept(option_keys::warm_statement); warm.is_object() && warm.contains("by"))
    options.warm = std::move(warm);
  if (const nlohmann::json simulator = kept(option_keys::simulator); simulator.is_string())
    options.simulator = simulator.get<std::string>();
  return options;
}

}  // namespace spindrift
