// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "app/cli/command.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/base/units.h"
#include "core/machine/component.h"
#include "core/scanning/artefact_design.h"
#include "core/scanning/axis_errors.h"
#include "core/scanning/calibration_report.h"
#include "core/scanning/cloud_file.h"
#include "core/scanning/profiler_calibration.h"
#include "core/scanning/registration.h"
#include "core/scanning/registration_report.h"
#include "core/scanning/scan_evaluation.h"

namespace spindrift::cli {
namespace {

struct RegisterArguments {
  std::string source;
  std::string target;
  std::string scan_model = "rigid";
  std::string method = "ours";
};

CommandResult registerCommand(const RegisterArguments& arguments) {
  RegistrationOptions options;
  options.scan_model = scanModelFromString(arguments.scan_model);
  if (arguments.method == "ndt-icp") options.method = RegistrationMethod::NdtIcp;
  if (arguments.method == "gicp") options.method = RegistrationMethod::Gicp;
  options.fall_back = options.scan_model == ScanModel::Rigid;
  const PointCloud source = readCloud(arguments.source);
  const PointCloud target = readCloud(arguments.target);
  const RegistrationResult result = registerClouds(source, target, options);
  return {registrationJson(result), registrationSummary(result), result.usable() ? Done : NotGoodEnough};
}

void addRegister(CLI::App& app, CommandLine& line) {
  auto arguments = std::make_shared<RegisterArguments>();
  CLI::App* command = addCommand(app, line, "register",
                                 "Register a scan (SOURCE, warm) onto a reference scan (TARGET, cold) of the same "
                                 "artefact: motion at the centroid of the target in µm and µrad, with covariance",
                                 [arguments](JobContext&) { return registerCommand(*arguments); });
  command->add_option("SOURCE", arguments->source, "Cloud to move (.pcd, .ply or .csv, mm)")->required();
  command->add_option("TARGET", arguments->target, "Reference cloud (.pcd, .ply or .csv, mm)")->required();
  command
      ->add_option("--scan-model", arguments->scan_model,
                   "rigid: the cloud moves as one body; push_broom: every profile at its own machine position")
      ->check(oneOf({"rigid", "push_broom"}))
      ->capture_default_str();
  command
      ->add_option("--method", arguments->method,
                   "ours: cells of the source onto a bicubic spline of the target; ndt-icp: normal distributions "
                   "transform, then iterative "
                   "closest point, as in the reference publication; gicp: generalised ICP (the last two with PCL)")
      ->check(oneOf({"ours", "ndt-icp", "gicp"}))
      ->capture_default_str();
}

std::array<double, 4> circleFromText(const std::string& text) {
  const std::vector<std::string> parts = splitList(text);
  std::array<double, 4> circle{};
  bool good = parts.size() == 4;
  for (std::size_t i = 0; good && i < 4; ++i) good = parseNumber(parts[i], circle[i]);
  if (!good) throw InputError(fmt::format("--circle: found '{}'; allowed: four numbers x,y,z,r in mm.", text));
  return circle;
}

/// "value,uncertainty" in rad; empty: not known.
std::optional<std::array<double, 2>> angleFromText(const char* option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::vector<std::string> parts = splitList(text);
  std::array<double, 2> angle{};
  if (parts.size() != 2 || !parseNumber(parts[0], angle[0]) || !parseNumber(parts[1], angle[1]))
    throw InputError(fmt::format("{}: found '{}'; allowed: angle,standard uncertainty in rad.", option, text));
  return angle;
}

struct CalibrateArguments {
  std::string scan;
  std::string circle;
  std::string alpha;
  std::string gamma;
  std::string scan_model = "rigid";
};

void addCalibrate(CLI::App& app, CommandLine& line) {
  auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* command =
      addCommand(app, line, "calibrate-profiler",
                 "Determine position and orientation of the laser profiler in the tool frame from a scan of a circular "
                 "pocket: angles in rad, "
                 "lengths in mm (dz "
                 "without the lift), with standard uncertainties and what the scan cannot determine",
                 [arguments](JobContext&) {
                   CalibrationOptions options;
                   options.scan_model = scanModelFromString(arguments->scan_model);
                   options.known_angles_rad[0] = angleFromText("--alpha", arguments->alpha);
                   options.known_angles_rad[2] = angleFromText("--gamma", arguments->gamma);
                   options.validate();
                   const ProfilerCalibration c =
                       calibrateProfiler(readCloud(arguments->scan), circleFromText(arguments->circle), options);
                   return CommandResult{calibrationJson(c), calibrationSummary(c), c.usable() ? Done : NotGoodEnough};
                 });
  command->add_option("SCAN", arguments->scan, "Cloud of the pocket (.pcd, .ply or .csv, mm)")->required();
  command->add_option("--circle", arguments->circle, "x,y,z,r of the pocket's rim in the tool frame (mm)")
      ->type_name("X,Y,Z,R")
      ->required();
  command
      ->add_option("--alpha", arguments->alpha, "alpha from another calibration, with its standard uncertainty (rad)")
      ->type_name("V,S");
  command
      ->add_option("--gamma", arguments->gamma, "gamma from another calibration, with its standard uncertainty (rad)")
      ->type_name("V,S");
  command->add_option("--scan-model", arguments->scan_model, "rigid or push_broom, see register")
      ->check(oneOf({"rigid", "push_broom"}))
      ->capture_default_str();
}

struct DesignArguments {
  ArtefactSurface surface;
  ArtefactDesignOptions options;
  std::string scan_model = "rigid";
  std::vector<std::string> bumps;
  std::string stl;
  double base_mm = 10.0;
  double step_mm = 0.1;
};

nlohmann::json numberOrNull(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

ArtefactSurface::Bump bumpFromText(const std::string& text) {
  const std::vector<std::string> parts = splitList(text);
  std::array<double, 4> v{};
  bool good = parts.size() == 4;
  for (std::size_t i = 0; good && i < 4; ++i) good = parseNumber(parts[i], v[i]);
  if (!good) throw InputError(fmt::format("--bump: found '{}'; allowed: four numbers x,y,radius,height in mm.", text));
  return {{v[0], v[1]}, v[2], v[3]};
}

CommandResult designCommand(DesignArguments arguments) {
  for (const std::string& bump : arguments.bumps) arguments.surface.bumps.push_back(bumpFromText(bump));
  arguments.options.scan_model = scanModelFromString(arguments.scan_model);
  const ArtefactDesign d = designArtefact(arguments.surface, arguments.options);
  CommandResult out;
  out.json = {{"status", toString(d.status)},         {"message", d.message},
              {"scan_model", arguments.scan_model},   {"largest_slope_x", d.largest_slope_x},
              {"largest_slope_y", d.largest_slope_y}, {"visible_part", d.visible_part}};
  out.summary = d.message + "\n";
  for (const Component k : all_components) {
    const double sigma = d.sigma[static_cast<std::size_t>(k)];
    out.json["sigma"][std::string(toString(k))] = numberOrNull(sigma);
    out.summary += std::isfinite(sigma)
                       ? fmt::format("  {}  {:>8.2g} {}\n", toString(k), printed(sigma), printedUnit(unitOf(k)))
                       : fmt::format("  {}  not determined\n", toString(k));
  }
  out.json["weak_directions"] = nlohmann::json::array();
  for (const WeakDirection& w : d.weak) {
    out.json["weak_directions"].push_back({{"direction", w.name}, {"sigma_um", numberOrNull(w.sigma_um)}});
    out.summary +=
        fmt::format("  weak: {} (rotations times {:.3g} mm): {}\n", w.name, printed(d.length_mm),
                    std::isfinite(w.sigma_um) ? fmt::format("{:.2g} µm", printed(w.sigma_um)) : "not determined");
  }
  out.summary += fmt::format("  slope up to {:.2f} (x), {:.2f} (y); the profiler sees {:.1f} % of the surface\n",
                             d.largest_slope_x, d.largest_slope_y, 100.0 * d.visible_part);
  if (!arguments.stl.empty()) writeArtefactStl(arguments.stl, arguments.surface, arguments.base_mm, arguments.step_mm);
  out.exit_status = d.status == FitStatus::Converged ? Done : NotGoodEnough;
  return out;
}

void addDesign(CLI::App& app, CommandLine& line) {
  auto arguments = std::make_shared<DesignArguments>();
  CLI::App* command =
      addCommand(app, line, "design-artefact",
                 "Assess a free-form surface z = ax sin(kx x) + ay sin(ky y) + axy sin(kx x + ky y): "
                 "standard uncertainties of the six errors at its centroid (µm, µrad), weakly determined directions, "
                 "slopes; STL for milling or printing. Defaults: the surface of the reference publication",
                 [arguments](JobContext&) { return designCommand(*arguments); });
  ArtefactSurface& s = arguments->surface;
  command->add_option("--size-x", s.size_mm.x(), "Size across the scan, mm")->capture_default_str();
  command->add_option("--size-y", s.size_mm.y(), "Size along the scan, mm")->capture_default_str();
  command->add_option("--ax", s.amplitude_x_mm, "Amplitude of the wave along X, mm")->capture_default_str();
  command->add_option("--kx", s.wave_number_x_per_mm, "Wave number along X, rad/mm")->capture_default_str();
  command->add_option("--ay", s.amplitude_y_mm, "Amplitude of the wave along Y, mm")->capture_default_str();
  command->add_option("--ky", s.wave_number_y_per_mm, "Wave number along Y, rad/mm")->capture_default_str();
  command->add_option("--axy", s.amplitude_xy_mm, "Amplitude of the product term, mm")->capture_default_str();
  command->add_option("--bump", arguments->bumps, "Round bump x,y,radius,height (mm); may be given several times")
      ->type_name("X,Y,R,H");
  command->add_option("--noise", arguments->options.noise_um, "Standard deviation of the height of a point, µm")
      ->capture_default_str();
  command->add_option("--points", arguments->options.point_count, "Number of points of one scan")
      ->capture_default_str();
  command
      ->add_option("--steepest-slope", arguments->options.steepest_slope,
                   "Steepest slope that the profiler can measure (dz/dx)")
      ->capture_default_str();
  command->add_option("--scan-model", arguments->scan_model, "rigid or push_broom, see register")
      ->check(oneOf({"rigid", "push_broom"}))
      ->capture_default_str();
  command->add_option("--stl", arguments->stl, "Write the body as binary STL (mm)");
  command->add_option("--base", arguments->base_mm, "Bottom below the lowest point, mm")->capture_default_str();
  command->add_option("--step", arguments->step_mm, "Size of the STL's facets, mm")->capture_default_str();
}

struct CalibrationStudyArguments {
  std::string campaign;
  std::string scan_model;
  CalibrationStudyOptions options;
};

CommandResult studyCommand(const CalibrationStudyArguments& a, JobContext& job) {
  const ScanEvaluation scans = evaluateScanCampaign(Campaign::read(a.campaign), a.scan_model, job);
  CommandResult out;
  out.json = {{"angle_sigma_rad", a.options.angle_sigma_rad},
              {"length_sigma_mm", a.options.length_sigma_mm},
              {"trials", a.options.trials},
              {"scan_model", std::string(toString(scans.scan_model))},
              {"scans", nlohmann::json::array()}};
  out.summary = fmt::format(
      "change of the six errors by calibration errors of {:g} µrad and {:g} mm (standard deviation), {} trials per "
      "scan\n "
      " {:<12} {:<8}  {:>9} {:>9} {:>9} µm  {:>9} {:>9} {:>9} µrad\n",
      printed(a.options.angle_sigma_rad * urad_per_rad), printed(a.options.length_sigma_mm), a.options.trials, "scan",
      "", "EX", "EY", "EZ", "EA", "EB", "EC");
  const auto row = [&out](const std::string& name, const char* what, const std::array<double, 6>& v) {
    out.summary +=
        fmt::format("  {:<12} {:<8}  {:>9.3g} {:>9.3g} {:>9.3g}     {:>9.3g} {:>9.3g} {:>9.3g}\n", name, what,
                    printed(v[0]), printed(v[1]), printed(v[2]), printed(v[3]), printed(v[4]), printed(v[5]));
  };
  const auto named = [](const std::array<double, 6>& v) {
    nlohmann::json j = nlohmann::json::object();
    for (const Component k : all_components) j[std::string(toString(k))] = v[static_cast<std::size_t>(k)];
    return j;
  };
  std::array<double, 6> squares{};
  std::array<double, 6> largest{};
  std::size_t count = 0;
  for (const ScanResult& s : scans.scans) {
    if (s.reference || !s.registration.usable()) continue;
    job.throwIfCancelled();
    const CalibrationStudy study = studyCalibrationErrors(s.registration.target_from_source, s.registration.centroid_mm,
                                                          scans.mounting, a.options);
    const std::string name = s.capture.artefact + " " + s.capture.cycle;
    row(name, "rms", study.rms);
    row("", "largest", study.largest);
    row("", "at part", study.rms_at_artefact);
    out.json["scans"].push_back({{"artefact", s.capture.artefact},
                                 {"cycle", s.capture.cycle},
                                 {"rms", named(study.rms)},
                                 {"largest", named(study.largest)},
                                 {"rms_at_artefact", named(study.rms_at_artefact)}});
    for (std::size_t i = 0; i < 6; ++i) {
      squares[i] += study.rms[i] * study.rms[i];
      largest[i] = std::max(largest[i], study.largest[i]);
    }
    ++count;
  }
  if (count == 0)
    throw InputError({a.campaign, ""},
                     "has no scan that could be registered onto a reference, so nothing can change; see evaluate for "
                     "the reasons.");
  for (double& v : squares) v = std::sqrt(v / static_cast<double>(count));
  row("all scans", "rms", squares);
  row("", "largest", largest);
  out.json["rms"] = named(squares);
  out.json["largest"] = named(largest);
  for (const EvaluationWarning& w : scans.warnings) out.summary += "warning: " + w.sentence + "\n";
  return out;
}

void addStudy(CLI::App& app, CommandLine& line) {
  auto a = std::make_shared<CalibrationStudyArguments>();
  CLI::App* command = addCommand(app, line, "study-calibration",
                                 "Propagate errors of the profiler's calibration to the six errors of the axis: "
                                 "Monte Carlo over every scan of a campaign, at the slide's origin and at the artefact",
                                 [a](JobContext& job) {
                                   a->options.validate();
                                   return studyCommand(*a, job);
                                 });
  command->add_option("CAMPAIGN", a->campaign, "Folder of the campaign")->required();
  command->add_option("--angle", a->options.angle_sigma_rad, "Standard deviation of alpha, beta and gamma, rad")
      ->check(nonNegativeNumber())
      ->capture_default_str();
  command->add_option("--length", a->options.length_sigma_mm, "Standard deviation of dx, dy and dz, mm")
      ->check(nonNegativeNumber())
      ->capture_default_str();
  command->add_option("--trials", a->options.trials, "Number of trials per scan")
      ->check(numberBetween(10, 10000000))
      ->capture_default_str();
  command->add_option("--seed", a->options.seed, "Random seed of the trials")->capture_default_str();
  command->add_option("--scan-model", a->scan_model, "rigid or push_broom, in place of the machine file")
      ->check(oneOf({"rigid", "push_broom"}));
}

}  // namespace

void addScanningCommands(CLI::App& app, CommandLine& line) {
  addStudy(app, line);
  addDesign(app, line);
  addRegister(app, line);
  addCalibrate(app, line);
}

}  // namespace spindrift::cli
