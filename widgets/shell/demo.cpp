// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/demo.h"

#include <QCoreApplication>
#include <QFile>
#include <algorithm>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/discrepancy/effect_titles.h"
#include "core/imaging/image.h"
#include "core/simulation/scenario.h"
#include "core/simulation/virtual_campaign.h"

static void loadDemoScenarios() {
  Q_INIT_RESOURCE(scenarios);
}

namespace spindrift::gui {
namespace {

QString demoText(const char* text) {
  return QCoreApplication::translate("Demo", text);
}

/// Spoils two images as it happens at a machine: the light was off, and the file was cut short while it was copied.
void spoil(const std::filesystem::path& folder) {
  const std::filesystem::path dark = folder / "captures/images/M1_F2_rotation_1.jpg";
  GrayImage image = readImage(dark);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) image.at(x, y) = static_cast<std::uint8_t>(image.at(x, y) / 12);
  }
  writeFileAtomically(dark, encodeJpeg(image, 90));
  const std::filesystem::path cut = folder / "captures/images/M1_F4_focus_3.jpg";
  const std::string bytes = readFile(cut);
  writeFileAtomically(cut, std::string_view(bytes).substr(0, bytes.size() / 2));
}

/// What is measured before the campaign begins: one fiducial every five minutes while the camera, which was switched on
/// a moment ago, warms up and the machine stands still.
void writeWarmUp(Scenario scenario, const std::filesystem::path& file, JobContext& job) {
  constexpr double duration_s = 14400.0;
  constexpr double every_s = 300.0;
  scenario.microscope.reset();
  scenario.simulation.reset();
  scenario.duration_s = duration_s + every_s;
  scenario.programme = Programme({ProgrammeSegment{.instrument_on = true}});
  scenario.effects["instrument.warm_up.x"].setting.on = true;
  scenario.effects["instrument.warm_up.z"].setting.on = true;
  MeasurementOptions measurement;
  for (double t = 0.0; t <= duration_s; t += every_s) measurement.times_s.push_back(t);
  measurement.points = {scenario.machine.points.front().id};
  scenario.measurement = measurement;
  const VirtualCampaign warm_up = simulateCampaign(scenario, std::nullopt, job);
  writeFileAtomically(file, warm_up.campaign.observations->csv());
}

std::string resourceOf(const std::string& name) {
  return ":/scenarios/" + name + ".json";
}

std::string demoText(const std::string& name) {
  loadDemoScenarios();
  QFile file(QString::fromStdString(resourceOf(name)));
  if (!file.open(QIODevice::ReadOnly)) throw InternalError("the scenario of the demo " + name + " is missing");
  return file.readAll().toStdString();
}

Scenario demoScenario(const std::string& name) {
  const std::string resource = resourceOf(name);
  return Scenario::parse(JsonNode::parse(demoText(name), resource), std::filesystem::path(resource));
}

/// The simulation of the campaign as one that can be run: the virtual machine without what is hidden in it. What it has
/// may be off by a tenth; what it lacks, and three things that the machine does not do either, are switched off.
void writeSimulator(const std::string& scenario_name, const std::filesystem::path& folder) {
  constexpr double part_uncertain = 0.1;
  constexpr double largest_factor = 5.0;
  nlohmann::json scenario = nlohmann::json::parse(demoText(scenario_name));
  const std::vector<std::string> known = scenario.at("simulation").at("effects");
  scenario.erase("simulation");
  nlohmann::json parameters = nlohmann::json::array();
  nlohmann::json& effects = scenario.at("effects");
  for (const char* more : {"spindle.growth.z", "external_heat.a", "table.expansion.xy"}) {
    if (!effects.contains(more)) effects[more] = nlohmann::json::object();
  }
  for (auto& [id, setting] : effects.items()) {
    const bool has = std::find(known.begin(), known.end(), id) != known.end();
    if (!has) setting = {{"on", true}, {"size", 0.0}};
    const double size = setting.at("size").get<double>();
    parameters.push_back({{"name", "effects." + id + ".size"},
                          {"value", size},
                          {"unit", "1"},
                          {"standard_uncertainty", has ? part_uncertain * size : 0.5},
                          {"min", 0.0},
                          {"max", has ? largest_factor * size : 50.0},
                          {"what", spindrift::effectTitle(id)},
                          {"effects", has ? nlohmann::json::array() : nlohmann::json::array({id})}});
  }
  const nlohmann::json simulator{{"format", "spindrift-simulator"},
                                 {"version", 1},
                                 {"kind", "scenario"},
                                 {"scenario", "scenario.json"},
                                 {"parameters", parameters}};
  std::filesystem::create_directories(folder / "simulator");
  writeFileAtomically(folder / "simulator/scenario.json", scenario.dump(1) + "\n");
  writeFileAtomically(folder / "simulator/simulator.json", simulator.dump(1) + "\n");
  nlohmann::json campaign = nlohmann::json::parse(readFile(folder / "campaign.json"));
  campaign["simulator"] = "simulator/simulator.json";
  writeFileAtomically(folder / "campaign.json", campaign.dump(1) + "\n");
}

/// The same machine and physics with less to render: smaller images of four fiducials, coarser scans.
void makeSmall(Scenario& scenario) {
  if (scenario.microscope) {
    VirtualFiducialOptions& images = scenario.microscope->images;
    if (images.width_px > 760) {  // else they are small already
      images.width_px = 760;
      images.height_px = 540;
      images.pixel_length_um = 2.4;
      images.cor_px = {377, 272};
      images.defocus_px_per_um = 0.010;
    }
    images.steps_mm = {-0.1016, 0.0, 0.1016};
    images.dust = 2;
    images.fiducials.resize(std::min<std::size_t>(images.fiducials.size(), 4));
  }
  if (scenario.profiler) {
    scenario.profiler->optics.profile_points = 480;
    scenario.profiler->optics.profile_interval_mm = 0.0625;
    scenario.profiler->times_s.resize(std::min<std::size_t>(scenario.profiler->times_s.size(), 4));
  }
}

std::string scenarioNameOf(const std::string& name) {
  const std::vector<Demo> all = demos();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Demo& demo) { return demo.name == name; });
  if (found == all.end()) {
    std::string known;
    for (const Demo& demo : all) known += (known.empty() ? "" : ", ") + demo.name;
    throw InputError("demo \"" + name + "\" is not known; allowed: " + known + ".");
  }
  return found->scenario;
}

Scenario scenarioOf(const std::string& name, bool small) {
  Scenario scenario = demoScenario(scenarioNameOf(name));
  if (small) makeSmall(scenario);
  return scenario;
}

}  // namespace

std::vector<Demo> demos() {
  return {
      {"fiducials", "fiducials", demoText("Fiducials under the microscope"),
       demoText("Images of two thermal states become a heat map of the table."), "microscope"},
      {"holes", "hole_bar", demoText("Hole artefact and touch probe"),
       demoText("A hole bar on a turning table separates the errors of axis, table and artefact."), "probe"},
      {"balls", "ball_artefact", demoText("Ball artefact and star stylus"),
       demoText("Rotations and growth of a horizontal machine from four balls."), "target"},
      {"scans", "scans", demoText("Laser profiler on a gantry"),
       demoText("Cold and warm scans of free-form artefacts give six errors of an axis."), "scan"},
      {"discrepancy", "discrepancy_vertical", demoText("What the simulation lacks"),
       demoText("Find where simulation and measurement disagree, name the missing effect, see the gap shrink."),
       "discrepancy"},
      {"own_pattern", "own_pattern", demoText("Fiducials of your own artwork"),
       demoText("A campaign with its own pattern.json: 7 × 7 ellipses on a pitch of 455 µm."), "microscope", false},
  };
}

void makeDemoCampaign(const std::string& name, const std::filesystem::path& folder, bool small, JobContext& job) {
  const Scenario scenario = scenarioOf(name, small);
  JobContext simulating = job.part(0.0, 0.2);
  const VirtualCampaign campaign = simulateCampaign(scenario, std::nullopt, simulating);
  JobContext writing = job.part(0.2, 1.0);
  writeCampaign(campaign, folder, writing);
  if (scenario.simulation) writeSimulator(scenarioNameOf(name), folder);
  if (scenario.microscope) {
    spoil(folder);
    writeWarmUp(scenario, folder / "warm_up.csv", writing);
  }
}

nlohmann::json demoTruth(const std::string& name, bool small, JobContext& job) {
  return truthJson(simulateCampaign(scenarioOf(name, small), std::nullopt, job));
}

}  // namespace spindrift::gui
