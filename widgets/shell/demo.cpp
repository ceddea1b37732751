// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/demo.h"

#include <QCoreApplication>
#include <QFile>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/machine/nine_parameter_model.h"
#include "core/simulation/scenario.h"
#include "core/simulation/virtual_campaign.h"
#include "core/simulation/virtual_fiducials.h"

static void loadScenarios() {
  Q_INIT_RESOURCE(scenarios);
}

namespace spindrift::gui {
namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("Demo", text);
}

/// What a moderately warm machine does to its table, in the order of nine_parameter_names.
NineVector warmState() {
  NineVector p;
  p << 18.0, -11.0, 24.0, 60.0, -45.0, 35.0, 25.0, 55.0, 40.0;
  return p;
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

void makeFiducials(const std::filesystem::path& folder, bool small, JobContext& job) {
  VirtualFiducialOptions options;
  std::vector<Eigen::Vector2d> places{{20, 15}, {280, 15}, {280, 115}, {20, 115}};
  if (small) {
    options.width_px = 1200;
    options.height_px = 800;
    options.pixel_length_um = 1.9;
    options.cor_px = {596, 402};
    options.defocus_px_per_um = 0.010;
    options.steps_mm = {-0.1016, 0.0, 0.1016};
    options.dust = 2;
  } else {
    places.push_back({150, 65});
    places.push_back({150, 15});
  }
  const NineVector p = warmState();
  VirtualState cold{"M0", 0.0, {}};
  VirtualState warm{"M1", 7200.0, {}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    VirtualFiducial fiducial;
    fiducial.id = "F" + std::to_string(i + 1);
    fiducial.position_mm = places[i];
    fiducial.turn_rad = 0.03 * (static_cast<double>(i % 3) - 1.0) + 0.01;
    options.fiducials.push_back(fiducial);
    const Eigen::Vector3d at(places[i].x(), places[i].y(), 0.0);
    cold.deviation_um.push_back(Eigen::Vector3d::Zero());
    warm.deviation_um.push_back({nineParameterRow(at, Component::EX).dot(p), nineParameterRow(at, Component::EY).dot(p),
                                 nineParameterRow(at, Component::EZ).dot(p)});
  }
  options.states = {cold, warm};
  writeVirtualFiducialCampaign(folder, standardPattern(), options, 11, job);
  spoil(folder);
}

void makeScenario(const char* resource, const std::filesystem::path& folder, JobContext& job) {
  loadScenarios();
  QFile file(QString::fromLatin1(resource));
  if (!file.open(QIODevice::ReadOnly)) throw InternalError("a demo scenario is missing from the program");
  const Scenario scenario =
      Scenario::parse(JsonNode::parse(file.readAll().toStdString(), resource), std::filesystem::path(resource));
  writeCampaign(simulateCampaign(scenario, std::nullopt, job), folder);
}

}  // namespace

const std::vector<Demo>& demos() {
  static const std::vector<Demo> list{
      {"fiducials", translated("Fiducials under the microscope"),
       translated("Images of two thermal states become a heat map of the table."), "microscope"},
      {"holes", translated("Hole artefact and touch probe"),
       translated("A hole bar on a turning table separates the errors of axis, table and artefact."), "probe"},
      {"balls", translated("Ball artefact and star stylus"),
       translated("Rotations and growth of a horizontal machine from four balls."), "target"},
      {"discrepancy", translated("What the simulation lacks"),
       translated("Find where simulation and measurement disagree, name the missing effect, see the gap shrink."),
       "discrepancy"},
  };
  return list;
}

void makeDemoCampaign(const std::string& name, const std::filesystem::path& folder, bool small, JobContext& job) {
  if (name == "fiducials") {
    makeFiducials(folder, small, job);
  } else if (name == "holes") {
    makeScenario(":/scenarios/hole_bar.json", folder, job);
  } else if (name == "balls") {
    makeScenario(":/scenarios/ball_artefact.json", folder, job);
  } else if (name == "discrepancy") {
    makeScenario(":/scenarios/discrepancy_vertical.json", folder, job);
  } else {
    std::string known;
    for (const Demo& demo : demos()) known += (known.empty() ? "" : ", ") + demo.name;
    throw InputError("demo \"" + name + "\" is not known; allowed: " + known + ".");
  }
}

}  // namespace spindrift::gui
