// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <memory>

#include "app/cli/command.h"
#include "core/base/text.h"
#include "core/scanning/calibration_report.h"
#include "core/scanning/cloud_file.h"
#include "core/scanning/profiler_calibration.h"
#include "core/scanning/registration.h"
#include "core/scanning/registration_report.h"

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
                                 "artefact: motion at the centroid of the target in um and urad, with covariance",
                                 [arguments](JobContext&) { return registerCommand(*arguments); });
  command->add_option("SOURCE", arguments->source, "Cloud to move (.pcd, .ply or .csv, mm)")->required();
  command->add_option("TARGET", arguments->target, "Reference cloud (.pcd, .ply or .csv, mm)")->required();
  command
      ->add_option("--scan-model", arguments->scan_model,
                   "rigid: the cloud moves as one body; push_broom: every profile at its own machine position")
      ->check(CLI::IsMember({"rigid", "push_broom"}))
      ->capture_default_str();
  command
      ->add_option("--method", arguments->method,
                   "ours: smooth surface; ndt-icp: as in the paper; gicp: generalised ICP (the last two with PCL)")
      ->check(CLI::IsMember({"ours", "ndt-icp", "gicp"}))
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

struct CalibrateArguments {
  std::string scan;
  std::string circle;
  std::string scan_model = "rigid";
};

void addCalibrate(CLI::App& app, CommandLine& line) {
  auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* command =
      addCommand(app, line, "calibrate-profiler",
                 "Place of the laser profiler in the tool frame from a scan of a circular pocket: angles in rad, "
                 "lengths in mm (dz "
                 "without the lift), with standard uncertainties and what the scan cannot determine",
                 [arguments](JobContext&) {
                   CalibrationOptions options;
                   options.scan_model = scanModelFromString(arguments->scan_model);
                   const ProfilerCalibration c =
                       calibrateProfiler(readCloud(arguments->scan), circleFromText(arguments->circle), options);
                   return CommandResult{calibrationJson(c), calibrationSummary(c), c.usable() ? Done : NotGoodEnough};
                 });
  command->add_option("SCAN", arguments->scan, "Cloud of the pocket (.pcd, .ply or .csv, mm)")->required();
  command->add_option("--circle", arguments->circle, "x,y,z,r of the pocket's rim in the tool frame (mm)")
      ->type_name("X,Y,Z,R")
      ->required();
  command->add_option("--scan-model", arguments->scan_model, "rigid or push_broom, see register")
      ->check(CLI::IsMember({"rigid", "push_broom"}))
      ->capture_default_str();
}

}  // namespace

void addScanningCommands(CLI::App& app, CommandLine& line) {
  addRegister(app, line);
  addCalibrate(app, line);
}

}  // namespace spindrift::cli
