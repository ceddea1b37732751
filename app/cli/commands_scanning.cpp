// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "app/cli/command.h"
#include "core/scanning/cloud_file.h"
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

}  // namespace

void addScanningCommands(CLI::App& app, CommandLine& line) {
  addRegister(app, line);
}

}  // namespace spindrift::cli
