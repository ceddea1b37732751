// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/virtual_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/base/units.h"

namespace spindrift {
namespace {

/// Streams of random numbers of one campaign, one for each purpose, so that a change of one leaves the others alone.
enum class Stream : std::uint64_t {
  Programme = 1,
  Environment,
  Plant,
  Base,
  Plan,
  Noise,
  Sensors,
  Touches,
  Images,
  Scans
};

std::uint64_t streamSeed(std::uint64_t seed, Stream stream) {
  Random random(seed * 0x9e3779b97f4a7c15ULL + static_cast<std::uint64_t>(stream));
  return random.bits();
}

/// A value that is wrong by at most `error`, relative.
double wrong(Random& random, double value, double error) {
  return value * (1.0 + random.uniform(-error, error));
}

PlantParameters perturbed(const PlantParameters& p, Random& random, double error) {
  PlantParameters q = p;
  for (double* value : {&q.friction, &q.screw_friction, &q.convection, &q.convection_speed, &q.spindle_mass,
                        &q.structure_mass, &q.screw_mass, &q.conduction, &q.expansion}) {
    *value = wrong(random, *value, error);
  }
  return q;
}

double rounded(double value, double step) {
  return step > 0.0 ? std::round(value / step) * step : value;
}

/// The rows that the plan asks for, without values.
std::vector<Observation> plannedRows(const Scenario& s, const MeasurementOptions& plan, Random& random) {
  std::vector<const MachinePoint*> points;
  for (const MachinePoint& point : s.machine.points) {
    if (plan.points.empty() || std::find(plan.points.begin(), plan.points.end(), point.id) != plan.points.end()) {
      points.push_back(&point);
    }
  }
  std::vector<Observation> rows;
  rows.reserve(plan.times_s.size() * points.size() * plan.components.size());
  for (std::size_t state = 0; state < plan.times_s.size(); ++state) {
    Observation row;
    row.state = fmt::format("M{}", state);
    row.use = plan.holdout.contains(row.state) ? ObservationUse::Holdout : ObservationUse::Fit;
    row.c_deg = plan.c_deg[state % plan.c_deg.size()];
    row.instrument = s.instrument.name;
    row.tool_offset_mm = plan.tool_offset_mm;
    for (std::size_t k = 0; k < points.size(); ++k) {
      row.time_s = plan.times_s[state] + plan.per_point_s * static_cast<double>(k);
      row.point = points[k]->id;
      row.position_mm = points[k]->position_mm;
      for (int axis = 0; axis < 3; ++axis) {
        row.approach[axis] = plan.random_approach && random.uniform() < 0.5 ? -1.0 : 1.0;
      }
      for (const Component component : plan.components) {
        row.component = component;
        row.sigma = isRotation(component) ? s.instrument.sigma_urad : s.instrument.sigma_um;
        rows.push_back(row);
      }
    }
  }
  return rows;
}

std::vector<PlantQuery> queriesOf(const std::vector<Observation>& rows) {
  std::vector<PlantQuery> queries;
  queries.reserve(rows.size());
  for (const Observation& row : rows) {
    queries.push_back(
        {row.time_s, row.position_mm, row.c_deg * rad_per_deg, row.approach, row.tool_offset_mm, row.point});
  }
  return queries;
}

std::vector<double> signalOf(const std::vector<SmallError>& errors, const std::vector<Observation>& rows) {
  std::vector<double> values(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) values[i] = valueOf(errors[i], rows[i].component);
  return values;
}

CampaignTruth::Size sizeOf(const std::vector<double>& signal, const std::vector<Observation>& rows, bool relative) {
  std::map<Component, std::pair<double, int>> sums;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].use != ObservationUse::Fit) continue;
    const double value = relative ? signal[i] / rows[i].sigma : signal[i];
    auto& [sum, count] = sums[rows[i].component];
    sum += value * value;
    ++count;
  }
  CampaignTruth::Size size;
  for (const auto& [component, sum] : sums) {
    const double rms = std::sqrt(sum.first / sum.second);
    if (rms > size.rms) size = {rms, component};
  }
  return size;
}

/// Turns the truth into readings.
void measure(std::vector<Observation>& rows, const std::vector<double>& truth, const InstrumentOptions& o,
             Random& random) {
  std::map<std::pair<std::string, Component>, double> memory;
  std::map<Component, double> drift_per_s;
  for (const Component component : all_components) {
    drift_per_s[component] = o.drift_um_per_h / 3600.0 * random.uniform(-1.0, 1.0);
  }
  std::vector<Observation> kept;
  kept.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Observation& row = rows[i];
    const auto key = std::pair(row.point, row.component);
    const double fresh = random.normal();
    const auto [entry, first] = memory.try_emplace(key, fresh);
    if (!first) entry->second = o.ar1 * entry->second + std::sqrt(1.0 - o.ar1 * o.ar1) * fresh;
    double noise = entry->second;
    if (random.uniform() < o.outliers) noise += (random.uniform() < 0.5 ? -1.0 : 1.0) * o.outlier_size;
    const double value = truth[i] + row.sigma * noise + drift_per_s[row.component] * row.time_s;
    row.value = std::round(rounded(value, o.resolution_um) * 1e4) / 1e4;
    // A row that is dropped keeps its place in the noise, so that dropping changes nothing else.
    if (random.uniform() < o.dropped) row.use = ObservationUse::Exclude;
  }
}

OperatingLog logOf(const Scenario& s, const VirtualMachine& plant, Random& random,
                   std::map<std::string, std::vector<std::size_t>>& dropouts) {
  std::vector<double> times;
  for (double t = 0.0; t < s.duration_s; t += s.log_period_s) times.push_back(t);
  OperatingLog log(times);
  const auto add = [&](const std::string& name, auto&& value) {
    if (s.omitted_signals.contains(name)) return;
    std::vector<double> values;
    values.reserve(times.size());
    for (const double t : times) values.push_back(value(plant.programme().at(t)));
    log.setSignal(name, std::move(values));
  };
  add("spindle_rpm", [](const ProgrammeSegment& p) { return p.spindle_rpm; });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (s.machine.findAxis(std::string(1, "XYZ"[axis])) == nullptr) continue;
    add(fmt::format("feed_{}_mm_min", "xyz"[axis]), [axis](const ProgrammeSegment& p) { return p.feed_mm_min[axis]; });
    add(fmt::format("pos_{}_mm", "xyz"[axis]), [axis](const ProgrammeSegment& p) { return p.position_mm[axis]; });
  }
  if (!s.machine.rotary.empty()) add("speed_c_rpm", [](const ProgrammeSegment& p) { return p.c_rpm; });
  add("coolant", [](const ProgrammeSegment& p) { return p.coolant ? 1.0 : 0.0; });
  add("instrument_on", [](const ProgrammeSegment& p) { return p.instrument_on ? 1.0 : 0.0; });
  for (const SensorOptions& sensor : s.sensors) {
    Random own = random.split();
    if (s.omitted_signals.contains(sensor.name)) continue;
    const std::vector<int> volumes = volumesAt(plant.thermal().bodies, sensor.place, {});
    std::vector<double> values;
    values.reserve(times.size());
    double noise = 0.0;
    double follows = plant.temperature_degC(volumes, 0.0);
    const double take = sensor.time_constant_s > 0.0 ? 1.0 - std::exp(-s.log_period_s / sensor.time_constant_s) : 1.0;
    for (const double t : times) {
      follows += take * (plant.temperature_degC(volumes, t) - follows);
      const double fresh = own.normal();
      noise = values.empty() ? fresh : sensor.ar1 * noise + std::sqrt(1.0 - sensor.ar1 * sensor.ar1) * fresh;
      const double off_K = sensor.bias_K + sensor.drift_K_per_h * t / 3600.0;
      double value = (take < 1.0 ? follows : plant.temperature_degC(volumes, t)) + off_K + sensor.noise_K * noise;
      value = std::round(rounded(value, sensor.resolution_K) * 1e4) / 1e4;
      if (sensor.dead && !values.empty()) value = values.front();
      if (own.uniform() < sensor.dropout && !values.empty()) {
        value = std::numeric_limits<double>::quiet_NaN();
        dropouts[sensor.name].push_back(values.size());
      }
      values.push_back(value);
    }
    log.setSignal(sensor.name, std::move(values));
  }
  return log;
}

/// The role of a sensor: as the scenario's machine states it, else of the body it sits on.
std::optional<SensorRole> roleOf(const MachineDescription& machine, const SensorOptions& sensor) {
  for (const TemperatureSensor& one : machine.temperature_sensors) {
    if (one.name == sensor.name && one.role) return one.role;
  }
  return readSensorRole(sensor.place);
}

/// machine.json as it will be written: with the sensors that are in the log.
nlohmann::json machineJson(const Scenario& s) {
  nlohmann::json json = s.machine.source;
  nlohmann::json sensors = nlohmann::json::array();
  for (const SensorOptions& sensor : s.sensors) {
    if (s.omitted_signals.contains(sensor.name)) continue;
    sensors.push_back({{"name", sensor.name}, {"place", sensor.place}});
    if (const auto role = roleOf(s.machine, sensor)) sensors.back()["role"] = std::string(toString(*role));
  }
  json["temperature_sensors"] = sensors;
  return json;
}

}  // namespace

nlohmann::json CampaignTruth::json(const std::vector<Observation>& rows) const {
  nlohmann::json json{{"hidden", hidden}, {"base", base}};
  nlohmann::json size_json = nlohmann::json::object();
  for (const auto& [id, size] : sizes) {
    size_json[id] = {{"rms", size.rms}, {"component", toString(size.component)}};
  }
  json["size"] = size_json;
  nlohmann::json setting_json = nlohmann::json::object();
  for (const auto& [id, setting] : settings) {
    setting_json[id] = {{"size", setting.size}, {"driver", setting.driver}, {"parameters", setting.parameters}};
  }
  json["effects"] = setting_json;
  nlohmann::json signal = nlohmann::json::array();
  for (std::size_t i = 0; i < rows.size() && i < total.size(); ++i) {
    signal.push_back({{"time_s", rows[i].time_s},
                      {"point", rows[i].point},
                      {"component", toString(rows[i].component)},
                      {"total", total[i]},
                      {"hidden", hidden_signal[i]}});
  }
  json["observations"] = signal;
  return json;
}

namespace {

/// Mean deviation of the tip over the touches of a feature, from that of the first cycle.
nlohmann::json touchTruth(const VirtualCampaign& campaign) {
  struct Mean {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
  };
  const Artefact* artefact = campaign.campaign.machine.findArtefact(campaign.touched_artefact);
  const bool balls = artefact != nullptr && artefact->kind == "balls";
  std::map<std::string, std::map<std::string, Mean>> means;
  std::vector<std::string> cycles;
  for (const TouchRow& touch : campaign.touches) {
    std::string point = touch.feature;
    if (balls) point += "/" + touch.stylus;
    if (!balls && touch.c_deg != 0.0) point += "@" + exactNumber(touch.c_deg);
    if (cycles.empty() || cycles.back() != touch.cycle) cycles.push_back(touch.cycle);
    Mean& mean = means[touch.cycle][point];
    mean.sum += touch.deviation_mm;
    ++mean.count;
  }
  nlohmann::json list = nlohmann::json::array();
  for (const std::string& cycle : cycles) {
    for (const auto& [point, mean] : means[cycle]) {
      const Mean& first = means[cycles.front()][point];
      if (first.count == 0) continue;
      const Eigen::Vector3d change_um = (mean.sum / mean.count - first.sum / first.count) * um_per_mm;
      for (std::size_t k = 0; k < 3; ++k) {
        list.push_back({{"state", cycle},
                        {"point", point},
                        {"component", toString(all_components[k])},
                        {"value", change_um[static_cast<Eigen::Index>(k)]}});
      }
    }
  }
  return list;
}

}  // namespace

nlohmann::json truthJson(const VirtualCampaign& campaign) {
  const std::vector<Observation> none;
  nlohmann::json json =
      campaign.truth.json(campaign.campaign.observations ? campaign.campaign.observations->rows : none);
  if (campaign.captures) json["captures"] = campaign.captures->truth();
  if (!campaign.touches.empty()) json["captures"] = touchTruth(campaign);
  return json;
}

std::shared_ptr<const VirtualMachine> makeVirtualMachine(const Scenario& s, std::optional<std::uint64_t> seed_option,
                                                         const JobContext& job) {
  const std::uint64_t seed = seed_option.value_or(s.seed);
  const Programme programme =
      s.programme ? *s.programme : randomProgramme(s.machine, s.random_programme, streamSeed(seed, Stream::Programme));
  const Environment environment(s.environment, s.duration_s, streamSeed(seed, Stream::Environment));
  return std::make_shared<const VirtualMachine>(s.machine, programme, environment, s.physics, s.duration_s,
                                                streamSeed(seed, Stream::Plant), job);
}

VirtualCampaign simulateCampaign(const Scenario& s, std::optional<std::uint64_t> seed_option, const JobContext& job) {
  const auto started = std::chrono::steady_clock::now();
  const std::uint64_t seed = seed_option.value_or(s.seed);
  const auto plant_pointer = makeVirtualMachine(s, seed, job.part(0.0, s.simulation ? 0.45 : 0.9));
  const VirtualMachine& plant = *plant_pointer;

  VirtualCampaign result;
  CampaignTruth& truth = result.truth;
  Campaign& campaign = result.campaign;
  campaign.name = s.name;
  campaign.start_utc = s.start_utc;
  campaign.machine = s.machine;
  campaign.machine.source = machineJson(s);
  campaign.machine.temperature_sensors.clear();
  for (const SensorOptions& sensor : s.sensors) {
    if (!s.omitted_signals.contains(sensor.name)) {
      campaign.machine.temperature_sensors.push_back({sensor.name, sensor.place, roleOf(s.machine, sensor)});
    }
  }
  if (s.simulation) truth.base = s.simulation->effects;
  const auto in_base = [&](const std::string& id) {
    return std::find(truth.base.begin(), truth.base.end(), id) != truth.base.end();
  };

  std::vector<Observation> rows;
  std::vector<PlantQuery> queries;
  if (s.measurement) {
    Random plan_random(streamSeed(seed, Stream::Plan));
    rows = plannedRows(s, *s.measurement, plan_random);
    queries = queriesOf(rows);
  }
  truth.total.assign(rows.size(), 0.0);
  truth.hidden_signal.assign(rows.size(), 0.0);
  truth.base_error.assign(rows.size(), 0.0);
  for (const auto& [id, effect] : s.effects) {
    if (!effect.setting.on) continue;
    PlantEffectSetting setting = effect.setting;
    if (effect.strength) setting.size = 1.0;
    std::vector<double> signal = signalOf(plant.deviations({{id, setting}}, queries), rows);
    if (effect.strength) {
      const double per_size = sizeOf(signal, rows, true).rms;
      if (!(per_size > 0.0)) {
        throw InputError(
            fmt::format("effect \"{}\" does nothing in this scenario, so its strength cannot be {}; give a size, or a "
                        "program and points that excite it.",
                        id, *effect.strength));
      }
      setting.size = *effect.strength / per_size;
      for (double& value : signal) value *= setting.size;
    }
    if (setting.size == 0.0) continue;
    truth.settings[id] = setting;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      truth.total[i] += signal[i];
      (in_base(id) ? truth.base_error[i] : truth.hidden_signal[i]) += signal[i];
    }
    truth.signals[id] = signal;
    if (!in_base(id)) {
      truth.hidden.push_back(id);
      if (!rows.empty()) truth.sizes[id] = sizeOf(signal, rows, false);
    }
  }

  if (s.simulation) {
    Random base_random(streamSeed(seed, Stream::Base));
    const double error = s.simulation->parameter_error;
    const VirtualMachine simplified(s.machine, plant.programme(), plant.environment(),
                                    perturbed(s.physics, base_random, error), s.duration_s, plant.seed(),
                                    job.part(0.45, 0.9));
    PlantEffectSettings settings;
    for (const std::string& id : truth.base) {
      const auto found = truth.settings.find(id);
      if (found == truth.settings.end()) continue;
      settings[id] = found->second;
      settings[id].size = wrong(base_random, found->second.size, error);
      const auto further = s.simulation->size_errors.find(id);
      if (further != s.simulation->size_errors.end()) settings[id].size *= 1.0 + further->second;
    }
    // The simulation runs on the log, and is asked at the times that the observations state.
    std::vector<PlantQuery> stated = queries;
    for (PlantQuery& query : stated) query.time_s += s.measurement->clock_offset_s;
    const std::vector<double> predicted = signalOf(simplified.deviations(settings, stated), rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      truth.base_error[i] -= predicted[i];
      if (base_random.uniform() < s.simulation->missing_rows) continue;
      result.simulation.push_back({rows[i].time_s + s.measurement->clock_offset_s, rows[i].point, rows[i].component,
                                   std::round(predicted[i] * 1e4) / 1e4});
    }
    campaign.simulation = "simulation.csv";
    campaign.simulation_gain_uncertainty = s.simulation->gain_uncertainty;
  }

  Random sensor_random(streamSeed(seed, Stream::Sensors));
  campaign.log = logOf(s, plant, sensor_random, result.dropouts);
  if (!rows.empty()) {
    Random noise_random(streamSeed(seed, Stream::Noise));
    measure(rows, truth.total, s.instrument, noise_random);
    // Rows that the instrument dropped are in no file.
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].use == ObservationUse::Exclude) continue;
      truth.total[kept] = truth.total[i];
      truth.hidden_signal[kept] = truth.hidden_signal[i];
      truth.base_error[kept] = truth.base_error[i];
      for (auto& [id, signal] : truth.signals) signal[kept] = signal[i];
      rows[kept++] = rows[i];
    }
    rows.resize(kept);
    truth.total.resize(kept);
    truth.hidden_signal.resize(kept);
    truth.base_error.resize(kept);
    for (auto& [id, signal] : truth.signals) signal.resize(kept);
    if (s.measurement->clock_offset_s != 0.0) {
      for (Observation& row : rows) row.time_s += s.measurement->clock_offset_s;
    }
    campaign.observations = ObservationSet{};
    campaign.observations.edit().rows = std::move(rows);
  }
  if (s.touches) {
    result.touched_artefact = s.touches->artefact;
    result.touches = simulateTouches(plant, *s.touches, truth.settings, streamSeed(seed, Stream::Touches));
  }
  if (s.microscope || s.profiler) {
    result.captures =
        std::make_shared<const VirtualCaptures>(plant_pointer, truth.settings, s.microscope, s.profiler,
                                                streamSeed(seed, Stream::Images), streamSeed(seed, Stream::Scans));
  }
  result.elapsed_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started).count();
  job.report(1.0, "done");
  return result;
}

}  // namespace spindrift
