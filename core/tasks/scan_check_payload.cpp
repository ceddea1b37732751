// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/scan_check_payload.h"

#include <nlohmann/json.hpp>

namespace spindrift {
namespace {

ScanCheck checkFrom(const nlohmann::json& json) {
  ScanCheck c;
  c.capture.cloud = json.at("cloud").get<std::string>();
  c.usable = json.at("usable").get<bool>();
  c.reason = json.at("reason").get<std::string>();
  c.points = json.at("points").get<std::size_t>();
  c.profiles = json.at("profiles").get<std::size_t>();
  c.completeness = json.at("completeness").get<double>();
  c.edge_points = json.at("edge_points").get<std::size_t>();
  c.outlier_points = json.at("outlier_points").get<std::size_t>();
  c.painted_points = json.value("painted_points", std::size_t{0});
  return c;
}

}  // namespace

nlohmann::json payloadOfScanChecks(const std::vector<ScanCheck>& checks) {
  nlohmann::json scans = nlohmann::json::array();
  for (const ScanCheck& c : checks) {
    scans.push_back({{"cloud", c.capture.cloud},
                     {"usable", c.usable},
                     {"reason", c.reason},
                     {"points", c.points},
                     {"profiles", c.profiles},
                     {"completeness", c.completeness},
                     {"edge_points", c.edge_points},
                     {"outlier_points", c.outlier_points},
                     {"painted_points", c.painted_points}});
  }
  return {{"scans", scans}};
}

std::vector<ScanCheck> scanChecksFrom(const nlohmann::json& payload) {
  std::vector<ScanCheck> checks;
  for (const auto& entry : payload.at("scans")) checks.push_back(checkFrom(entry));
  return checks;
}

}  // namespace spindrift
