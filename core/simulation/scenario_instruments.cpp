// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/scenario_instruments.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/imaging/artwork.h"

namespace spindrift {
namespace {

void readPositive(const JsonNode& node, std::string_view key, double& value) {
  if (const auto found = node.find(key)) value = found->positiveNumber();
}

void readNonNegative(const JsonNode& node, std::string_view key, double& value) {
  if (const auto found = node.find(key)) value = found->nonNegativeNumber();
}

void readCount(const JsonNode& node, std::string_view key, int& value, int least, int most) {
  const auto found = node.find(key);
  if (!found) return;
  value = found->integer();
  if (value < least || value > most) {
    found->reject("a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  }
}

void readNumbers(const JsonNode& node, std::string_view key, std::vector<double>& values, std::size_t least) {
  const auto found = node.find(key);
  if (!found) return;
  values = found->numbers();
  if (values.size() < least) found->reject("at least " + std::to_string(least) + " numbers");
}

/// A small angle of its own for every fiducial, as nobody glues them straight: +-2 degrees, decided by the number.
double gluedTurn_rad(std::size_t number) {
  constexpr double golden = 0.6180339887498949;
  const double unit = static_cast<double>(number + 1) * golden;
  return 4.0 * rad_per_deg * (unit - std::floor(unit) - 0.5);
}

std::shared_ptr<const FiducialPattern> patternOf(const JsonNode& node, const std::filesystem::path& folder) {
  if (node.value().is_string()) return std::make_shared<FiducialPattern>(readPattern(folder / node.string()));
  ArtworkOptions artwork;
  constexpr int most = 90;  // numbers 10 ... 99
  readCount(node, "rows", artwork.rows, 1, most);
  readCount(node, "columns", artwork.columns, 1, most);
  readCount(node, "first_row", artwork.first_row, 10, 99);
  readCount(node, "first_column", artwork.first_column, 10, 99);
  readPositive(node, "pitch_um", artwork.pitch_um);
  try {
    return std::make_shared<FiducialPattern>(makePattern(artwork));
  } catch (const InputError& e) {
    throw InputError(node.place(), e.what());
  }
}

}  // namespace

MicroscopeOptions parseMicroscope(const JsonNode& node, const MachineDescription& machine, std::vector<double> times_s,
                                  const std::filesystem::path& folder) {
  MicroscopeOptions options;
  options.times_s = std::move(times_s);
  VirtualFiducialOptions& o = options.images;
  readCount(node, "width_px", o.width_px, 320, 8192);
  readCount(node, "height_px", o.height_px, 240, 8192);
  readPositive(node, "pixel_length_um", o.pixel_length_um);
  o.cor_px = {0.5 * o.width_px - 0.2, 0.5 * o.height_px + 0.4};
  if (const auto centre = node.find("centre_px")) {
    const std::vector<double> xy = centre->numbers();
    if (xy.size() != 2) centre->reject("two numbers");
    o.cor_px = {xy[0], xy[1]};
  }
  o.camera_turn_rad = node.numberOr("camera_turn_deg", o.camera_turn_rad / rad_per_deg) * rad_per_deg;
  readPositive(node, "blur_sigma_px", o.blur_sigma_px);
  readPositive(node, "defocus_px_per_um", o.defocus_px_per_um);
  readNonNegative(node, "noise_level", o.noise_level);
  o.gradient_x = node.numberOr("gradient_x", o.gradient_x);
  o.gradient_y = node.numberOr("gradient_y", o.gradient_y);
  readNonNegative(node, "flicker", o.flicker);
  readNonNegative(node, "spindle_repeatability_um", o.spindle_repeatability_um);
  readNonNegative(node, "axis_repeatability_um", o.axis_repeatability_um);
  readCount(node, "dust", o.dust, 0, 1000);
  readCount(node, "jpeg_quality", o.jpeg_quality, 1, 100);
  readNumbers(node, "rotations_deg", o.rotations_deg, 3);
  readNumbers(node, "steps_mm", o.steps_mm, 3);
  readNumbers(node, "heights_mm", o.heights_mm, 5);
  readNonNegative(node, "image_interval_s", o.image_interval_s);
  std::vector<std::string> wanted;
  if (const auto list = node.find("fiducials")) {
    for (const JsonNode& item : list->items()) {
      wanted.push_back(item.name());
      const MachinePoint* point = machine.findPoint(wanted.back());
      if (point == nullptr || point->kind != "fiducial") item.reject("the id of a fiducial of the machine");
    }
  }
  for (const MachinePoint& point : machine.points) {
    if (point.kind != "fiducial") continue;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), point.id) == wanted.end()) continue;
    VirtualFiducial fiducial;
    fiducial.id = point.id;
    fiducial.position_mm = point.position_mm.head<2>();
    fiducial.turn_rad = gluedTurn_rad(o.fiducials.size());
    o.fiducials.push_back(fiducial);
  }
  if (o.fiducials.empty()) node.reject("a machine with fiducials");
  if (const auto pattern = node.find("pattern")) {
    options.pattern = patternOf(*pattern, folder);
    const FiducialPattern& p = *options.pattern;
    const Eigen::Vector2d last = p.ellipseCentre(p.last_row, p.last_column);
    for (VirtualFiducial& fiducial : o.fiducials) fiducial.centre_um = 0.5 * last;
  }
  return options;
}

namespace {

ArtefactBending parseBending(const JsonNode& node) {
  ArtefactBending b;
  b.along_mm = node.numberOr("along_mm", 0.0);
  b.across_mm = node.numberOr("across_mm", 0.0);
  b.twist_mm = node.numberOr("twist_mm", 0.0);
  b.held_at = node.numberOr("held_at", 0.0);
  if (!(std::abs(b.held_at) <= 1.0)) node.at("held_at").reject("a number from -1 to 1");
  b.skew = node.numberOr("skew", 0.0);
  readPositive(node, "time_constant_s", b.time_constant_s);
  return b;
}

}  // namespace

ProfilerOptions parseProfiler(const JsonNode& node, const MachineDescription& machine, std::vector<double> times_s) {
  if (!machine.profiler) node.reject("a machine with a profiler");
  const ProfilerDescription& described = *machine.profiler;
  ProfilerOptions o;
  o.times_s = std::move(times_s);
  readNonNegative(node, "seconds_per_artefact", o.seconds_per_artefact);
  o.mounting.scan_model = described.scan_model;
  o.mounting.lift_mm = described.lift_mm;
  o.mounting.lever_mm = described.lever_mm;
  o.mounting.alpha_rad = node.numberOr("alpha_rad", 0.0);
  o.mounting.beta_rad = node.numberOr("beta_rad", 0.0);
  o.mounting.gamma_rad = node.numberOr("gamma_rad", 0.0);
  if (const auto offset = node.find("offset_mm")) o.mounting.offset_mm = offset->vector3();
  if (described.profile_points) o.optics.profile_points = *described.profile_points;
  if (described.profile_interval_mm) o.optics.profile_interval_mm = *described.profile_interval_mm;
  readPositive(node, "profile_spacing_mm", o.optics.profile_spacing_mm);
  readNonNegative(node, "white_noise_um", o.optics.white_noise_um);
  readNonNegative(node, "speckle_noise_um", o.optics.speckle_noise_um);
  if (described.calibration_circle_mm) o.pocket.circle_mm = *described.calibration_circle_mm;
  const double reach = o.pocket.circle_mm[3] + 3.5;
  o.pocket.scan_from_mm = o.pocket.circle_mm[1] - reach;
  o.pocket.scan_to_mm = o.pocket.circle_mm[1] + reach;
  for (const JsonNode& item : node.at("artefacts").items()) {
    VirtualArtefact artefact;
    artefact.id = item.at("point").name();
    const MachinePoint* point = machine.findPoint(artefact.id);
    if (point == nullptr || point->kind != "surface") item.at("point").reject("the id of a surface of the machine");
    if (!o.artefact_at_mm.empty() && (std::abs(point->position_mm.x() - o.artefact_at_mm.front().x()) > 1e-9 ||
                                      std::abs(point->position_mm.z() - o.artefact_at_mm.front().z()) > 1e-9)) {
      item.at("point").reject("a surface with the x_mm and z_mm of the first one: the artefacts stand along Y");
    }
    artefact.y_mm = item.at("y_mm").number();
    artefact.yaw_rad = item.numberOr("turn_rad", 0.0);
    if (const auto bumps = item.find("bumps")) {
      for (const JsonNode& bump : bumps->items()) {
        artefact.surface.bumps.push_back({{bump.at("x_mm").number(), bump.at("y_mm").number()},
                                          bump.at("radius_mm").positiveNumber(),
                                          bump.at("height_mm").number()});
      }
    }
    artefact.surface.validate();
    if (const auto bending = item.find("bending")) o.bending[artefact.id] = parseBending(*bending);
    o.artefacts.push_back(artefact);
    o.artefact_at_mm.push_back(point->position_mm);
  }
  if (o.artefacts.empty()) node.at("artefacts").reject("at least one artefact");
  o.optics.validate();
  return o;
}

}  // namespace spindrift
