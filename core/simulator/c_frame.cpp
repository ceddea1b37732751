// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/c_frame.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <tuple>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "core/machine/observation.h"
#include "core/machine/simulation_row.h"
#include "core/simulator/program_simulator.h"
#include "core/simulator/run_folder.h"

namespace spindrift {
namespace {

constexpr double day_s = 28'800.0;
/// Share of the states that may be fitted.
constexpr double fitted_share = 0.7;

/// A part of the shop's day. A day of another length is stretched.
struct Work {
  double from_min;
  double rpm;
  bool coolant;
};

constexpr std::array<Work, 13> day{{{0.0, 0.0, false},
                                    {20.0, 2500.0, false},  // warm-up
                                    {48.0, 5500.0, true},
                                    {112.0, 0.0, false},  // change of the workpiece
                                    {126.0, 7000.0, true},
                                    {195.0, 0.0, false},  // break
                                    {236.0, 4000.0, false},
                                    {290.0, 7500.0, true},
                                    {352.0, 0.0, false},
                                    {368.0, 6000.0, true},
                                    {420.0, 3000.0, false},
                                    {446.0, 8000.0, true},
                                    {468.0, 0.0, false}}};

std::string logCsv(const OperatingLog& log) {
  std::string text = "time_s";
  for (const std::string& name : log.names()) text += "," + name;
  text += '\n';
  for (std::size_t row = 0; row < log.time_s().size(); ++row) {
    text += exactNumber(log.time_s()[row]);
    for (const std::string& name : log.names()) text += "," + exactNumber((*log.signal(name))[row]);
    text += '\n';
  }
  return text;
}

/// To whole parts, `parts` to one.
double rounded(double value, double parts) {
  return std::round(value * parts) / parts;
}

/// The machine that stands in the shop: nothing of it is quite as in the simulation.
CFrameDeckOptions measuredMachine(const CFrameDeckOptions& simulated, const CFrameCampaignOptions& options,
                                  const CFrameValues& hidden, Random& random) {
  CFrameDeckOptions out = simulated;
  out.largest_cell_mm = options.fine_cell_mm;
  out.increment_s = 0.5 * options.increment_s;
  CFrameDimensions& d = out.dimensions;
  for (double* size :
       {&d.bed_half_width_mm, &d.bed_height_mm, &d.bed_wall_mm, &d.saddle_height_mm, &d.table_thickness_mm,
        &d.column_half_width_mm, &d.column_front_mm, &d.column_depth_mm, &d.column_top_mm, &d.column_wall_mm,
        &d.head_half_width_mm, &d.head_front_mm, &d.head_top_mm, &d.front_bearing_mm, &d.rear_bearing_mm}) {
    *size = rounded(*size * random.uniform(0.99, 1.01), 10.0);
  }
  CFrameValues values = cFrameValues();
  for (const auto& [name, value] : simulated.values) values[name] = value;
  const auto scaled = [&](const char* name, double part, double parts) {
    values[name] = rounded(values[name] * random.uniform(1.0 - part, 1.0 + part), parts);
  };
  scaled("h_air", 0.05, 100.0);
  scaled("h_inside", 0.05, 100.0);
  scaled("k_iron", 0.03, 10.0);
  scaled("cp_iron", 0.01, 1.0);
  for (const auto& [name, value] : hidden) values[name] = value;
  out.values = values;
  return out;
}

using Key = std::tuple<double, std::string, Component>;

std::map<Key, double> byKey(const std::vector<SimulationRow>& rows) {
  std::map<Key, double> out;
  for (const SimulationRow& row : rows) out[{row.time_s, row.point, row.component}] = row.predicted;
  return out;
}

/// Rms of measured (without noise) minus simulated, of fitted and held-out states after the first.
nlohmann::json gapJson(const std::vector<SimulationRow>& measured, const std::vector<SimulationRow>& simulated,
                       double last_fitted_s) {
  const std::map<Key, double> prediction = byKey(simulated);
  // [um, urad][fit, holdout]
  std::array<std::array<double, 2>, 2> sum{};
  std::array<std::array<double, 2>, 2> count{};
  double largest_um = 0.0;
  for (const SimulationRow& row : measured) {
    if (row.time_s <= 0.0) continue;
    const double gap = row.predicted - prediction.at({row.time_s, row.point, row.component});
    const std::size_t kind = isRotation(row.component) ? 1 : 0;
    const std::size_t part = row.time_s > last_fitted_s ? 1 : 0;
    sum[kind][part] += gap * gap;
    count[kind][part] += 1.0;
    if (kind == 0) largest_um = std::max(largest_um, std::abs(gap));
  }
  const auto rms = [&](std::size_t kind, std::size_t part) {
    return count[kind][part] > 0.0 ? nlohmann::json(rounded(std::sqrt(sum[kind][part] / count[kind][part]), 1e4))
                                   : nlohmann::json();
  };
  return {{"fit_rms_um", rms(0, 0)},
          {"heldout_rms_um", rms(0, 1)},
          {"fit_rms_urad", rms(1, 0)},
          {"heldout_rms_urad", rms(1, 1)},
          {"largest_um", rounded(largest_um, 1e4)}};
}

nlohmann::json dimensionsJson(const CFrameDimensions& d) {
  return {{"bed_half_width_mm", d.bed_half_width_mm},
          {"bed_height_mm", d.bed_height_mm},
          {"bed_wall_mm", d.bed_wall_mm},
          {"saddle_height_mm", d.saddle_height_mm},
          {"table_thickness_mm", d.table_thickness_mm},
          {"column_half_width_mm", d.column_half_width_mm},
          {"column_front_mm", d.column_front_mm},
          {"column_depth_mm", d.column_depth_mm},
          {"column_top_mm", d.column_top_mm},
          {"column_wall_mm", d.column_wall_mm},
          {"head_half_width_mm", d.head_half_width_mm},
          {"head_front_mm", d.head_front_mm},
          {"head_top_mm", d.head_top_mm},
          {"front_bearing_mm", d.front_bearing_mm},
          {"rear_bearing_mm", d.rear_bearing_mm}};
}

ObservationSet observe(const std::vector<SimulationRow>& measured, const CFrameCampaignOptions& options,
                       double last_fitted_s, Random& random) {
  const std::map<Key, double> values = byKey(measured);
  ObservationSet out;
  for (int state = 0; state <= options.states; ++state) {
    const double time_s = state * options.state_interval_s;
    for (const CFramePoint& point : cFramePoints()) {
      for (const Component c : all_components) {
        const auto found = values.find({time_s, point.id, c});
        if (found == values.end()) continue;
        Observation row;
        row.time_s = time_s;
        row.state = fmt::format("M{}", state);
        row.point = point.id;
        row.position_mm = point.position_mm;
        row.component = c;
        row.sigma = isRotation(c) ? options.noise_urad : options.noise_um;
        row.value = rounded(found->second + random.normal(0.0, row.sigma), 1e4);
        row.instrument = isRotation(c) ? "autocollimator" : "microscope";
        row.use = time_s > last_fitted_s ? ObservationUse::Holdout : ObservationUse::Fit;
        out.rows.push_back(row);
      }
    }
  }
  return out;
}

std::filesystem::path truthFile(const std::filesystem::path& folder) {
  // A path that ends in a slash has no file name.
  std::filesystem::path whole = folder.has_filename() ? folder : folder.parent_path();
  whole += ".truth.json";
  return whole;
}

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::string_view toString(CFrameStory story) noexcept {
  switch (story) {
    case CFrameStory::Sun:
      return "sun";
    case CFrameStory::Friction:
      return "friction";
    case CFrameStory::Coolant:
      return "coolant";
    case CFrameStory::Room:
      return "room";
  }
  return "";
}

const std::vector<std::string>& cFrameStoryNames() {
  static const std::vector<std::string> names{"sun", "friction", "coolant", "room"};
  return names;
}

std::optional<CFrameStory> cFrameStoryFromString(std::string_view name) noexcept {
  for (const CFrameStory story : {CFrameStory::Sun, CFrameStory::Friction, CFrameStory::Coolant, CFrameStory::Room}) {
    if (toString(story) == name) return story;
  }
  return std::nullopt;
}

OperatingLog cFrameLog(double duration_s, std::uint64_t seed) {
  Random random(seed);
  std::array<Work, day.size()> work = day;
  for (std::size_t i = 1; i < work.size(); ++i) work[i].from_min += std::round(random.uniform(-4.0, 4.0));
  const double morning_degC = 20.6 + random.uniform(-0.4, 0.4);
  const double rise_K = 3.5 + random.uniform(-0.3, 0.3);
  const double gate_min = random.uniform(255.0, 275.0);  // a gate stands open for a while
  const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
  std::vector<double> time_s;
  std::vector<double> rpm;
  std::vector<double> coolant;
  std::vector<double> room;
  for (double t = 0.0; t <= duration_s + 1e-9; t += 60.0) {
    const double minute = t / duration_s * day_s / 60.0;
    const Work* now = &work.front();
    for (const Work& w : work) {
      if (w.from_min <= minute + 1e-9) now = &w;
    }
    time_s.push_back(t);
    rpm.push_back(now->rpm);
    coolant.push_back(now->coolant ? 1.0 : 0.0);
    // Rises until the afternoon, with the beat of the ventilation and the dip that the gate makes.
    double degC = morning_degC +
                  rise_K * std::pow(std::sin(0.5 * std::numbers::pi * std::min(minute / 320.0, 1.0)), 2) +
                  0.18 * (std::sin(2.0 * std::numbers::pi * minute / 34.0 + phase) - std::sin(phase));
    if (minute > gate_min) degC -= 1.1 * std::exp(-(minute - gate_min) / 18.0);
    room.push_back(rounded(degC + random.normal(0.0, 0.02), 100.0));
  }
  OperatingLog log(std::move(time_s));
  log.setSignal("spindle_rpm", std::move(rpm));
  log.setSignal("coolant", std::move(coolant));
  log.setSignal("T_ambient_degC", std::move(room));
  return log;
}

CFrameValues simulatedValues(CFrameStory story) {
  CFrameValues values;
  if (story == CFrameStory::Friction) values["friction"] = 0.0;
  if (story == CFrameStory::Room) values["room_gain"] = 0.0;
  return values;
}

CFrameValues hiddenValues(CFrameStory story, double duration_s) {
  switch (story) {
    case CFrameStory::Sun:
      return {{"sun_front", 90.0}, {"sun_on_s", 0.19 * duration_s}, {"sun_off_s", 0.5 * duration_s}};
    case CFrameStory::Friction:
      return {{"friction", 1.6}};
    case CFrameStory::Coolant:
      return {{"h_coolant", 150.0}};
    case CFrameStory::Room:
      return {{"room_gain", 1.0}};
  }
  return {};
}

bool calculixIsInstalled() {
  const char* folders = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  const std::vector<std::string> list = splitList(folders == nullptr ? "" : folders, ':');
  return std::any_of(list.begin(), list.end(), [](const std::string& folder) {
    return access((std::filesystem::path(folder) / "ccx").c_str(), X_OK) == 0;
  });
}

std::vector<SimulationRow> runDeck(const CFrameDeck& deck, const OperatingLog& log, const CFrameValues& changes,
                                   const JobContext& job) {
  CFrameDeck changed = deck;
  for (nlohmann::json& parameter : changed.simulator.at("parameters")) {
    const auto change = changes.find(parameter.at("name").get<std::string>());
    if (change == changes.end()) continue;
    // What a machine is takes no notice of the bounds that its simulation has.
    parameter["value"] = change->second;
    parameter["min"] = std::min(parameter.at("min").get<double>(), change->second);
    parameter["max"] = std::max(parameter.at("max").get<double>(), change->second);
  }
  const RunFolder folder;
  changed.write(folder.path());
  const ProgramSimulator simulator(openSimulatorFile(folder.path() / "simulator.json"), log);
  return simulator.run({}, {}, job).rows;
}

CFrameCampaign writeCFrameCampaign(CFrameStory story, const std::filesystem::path& folder, std::uint64_t seed,
                                   const JobContext& job, const CFrameCampaignOptions& options) {
  const auto started = std::chrono::steady_clock::now();
  if (std::filesystem::exists(folder) &&
      (!std::filesystem::is_directory(folder) || !std::filesystem::is_empty(folder))) {
    throw InputError({folder, ""}, "is there already and not empty; allowed: a new or an empty folder.");
  }
  if (!calculixIsInstalled()) {
    throw InputError("The finite-element program CalculiX (ccx) is not installed: install calculix-ccx.");
  }
  CFrameDeckOptions simulated;
  simulated.largest_cell_mm = options.coarse_cell_mm;
  simulated.values = simulatedValues(story);
  simulated.states = options.states;
  simulated.state_interval_s = options.state_interval_s;
  simulated.increment_s = options.increment_s;
  const double last_fitted_s = fitted_share * simulated.duration_s();
  const CFrameValues hidden = hiddenValues(story, simulated.duration_s());
  Random random(seed);
  const OperatingLog log = cFrameLog(simulated.duration_s(), random.bits());
  const CFrameDeckOptions measured = measuredMachine(simulated, options, hidden, random);
  const CFrameDeck coarse = CFrameDeck::make(simulated);
  const CFrameDeck fine = CFrameDeck::make(measured);

  CFrameCampaign out;
  out.coarse_nodes = coarse.nodes;
  out.fine_nodes = fine.nodes;
  const auto coarse_start = std::chrono::steady_clock::now();
  const std::vector<SimulationRow> simulation = runDeck(coarse, log, {}, job.part(0.0, 0.15));
  out.coarse_s = secondsSince(coarse_start);
  const std::vector<SimulationRow> completed = runDeck(coarse, log, hidden, job.part(0.15, 0.3));
  const auto fine_start = std::chrono::steady_clock::now();
  const std::vector<SimulationRow> measurement = runDeck(fine, log, {}, job.part(0.3, 1.0));
  out.fine_s = secondsSince(fine_start);
  const ObservationSet observations = observe(measurement, options, last_fitted_s, random);
  out.observations = observations.rows.size();
  out.simulation_rows = simulation.size();

  out.truth = {{"format", "spindrift-c-frame-truth"},
               {"version", 1},
               {"story", toString(story)},
               {"seed", seed},
               {"hidden", hidden},
               {"measured_machine",
                {{"parameters", fine.values()},
                 {"dimensions", dimensionsJson(measured.dimensions)},
                 {"nodes", fine.nodes},
                 {"increment_s", measured.increment_s}}},
               {"simulated_machine",
                {{"parameters", coarse.values()},
                 {"dimensions", dimensionsJson(simulated.dimensions)},
                 {"nodes", coarse.nodes},
                 {"increment_s", simulated.increment_s}}},
               {"gap", gapJson(measurement, simulation, last_fitted_s)},
               {"gap_with_hidden", gapJson(measurement, completed, last_fitted_s)},
               {"effect", gapJson(completed, simulation, last_fitted_s)}};
  const bool new_folder = !std::filesystem::exists(folder);
  const nlohmann::json campaign{{"format", "spindrift-campaign"},
                                {"version", 1},
                                {"name", fmt::format("C-frame machining centre, finite elements: {}", toString(story))},
                                {"start_utc", "2026-03-09T05:30:00Z"},
                                {"simulation", "simulation.csv"},
                                {"simulation_gain_uncertainty", 0.03},
                                {"simulator", "fe/simulator.json"}};
  try {
    coarse.write(folder / "fe");
    writeFileAtomically(folder / "machine.json", cFrameMachineJson(simulated.dimensions).dump(1) + "\n");
    writeFileAtomically(folder / "log.csv", logCsv(log));
    observations.write(folder / "observations.csv");
    writeFileAtomically(folder / "simulation.csv", simulationCsv(simulation, false));
    writeFileAtomically(truthFile(folder), out.truth.dump(1) + "\n");
    // Last, so that a folder without it is known to be unfinished.
    writeFileAtomically(folder / "campaign.json", campaign.dump(1) + "\n");
  } catch (...) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
      std::filesystem::remove_all(entry.path(), ignored);
    }
    if (new_folder) std::filesystem::remove(folder, ignored);
    std::filesystem::remove(truthFile(folder), ignored);
    throw;
  }
  job.report(1.0, "done");
  out.elapsed_s = secondsSince(started);
  return out;
}

}  // namespace spindrift
