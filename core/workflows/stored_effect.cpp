// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/stored_effect.h"

#include <string>

#include "core/base/json_reader.h"
#include "core/base/no_number.h"

namespace spindrift {
namespace {

double numberIn(const nlohmann::json& value) {
  return value.is_number() ? value.get<double>() : no_number;
}

/// A number that stories of earlier versions did not keep.
double laterNumber(const nlohmann::json& json, const char* key) {
  return json.contains(key) ? storedNumber(json, key) : no_number;
}

/// Two numbers, before and after.
void laterPair(const nlohmann::json& json, const char* key, double& before, double& after) {
  if (!json.contains(key)) return;
  before = numberIn(json.at(key).at(0));
  after = numberIn(json.at(key).at(1));
}

}  // namespace

double storedNumber(const nlohmann::json& json, const char* key) {
  return numberIn(json.at(key));
}

std::vector<double> storedNumbers(const nlohmann::json& list) {
  std::vector<double> out;
  for (const auto& value : list) out.push_back(numberIn(value));
  return out;
}

nlohmann::json storedEffect(const FoundEffect& e) {
  nlohmann::json parameters = nlohmann::json::array();
  for (const FittedParameter& p : e.parameters)
    parameters.push_back({p.name, jsonNumber(p.value), jsonNumber(p.standard_uncertainty)});
  return {{"id", e.id},
          {"title", e.title},
          {"physics", e.physics},
          {"drivers", e.drivers},
          {"rivals", e.rivals},
          {"containers", e.containers},
          {"confidence", jsonNumber(e.confidence)},
          {"parameters", parameters},
          {"delta_bic", jsonNumber(e.delta_bic)},
          {"delta_chi2", jsonNumber(e.delta_chi2)},
          {"rms_um", jsonNumber(e.rms_um)},
          {"crossvalidated", {jsonNumber(e.crossvalidated_rms_before_um), jsonNumber(e.crossvalidated_rms_after_um)}},
          {"heldout", {jsonNumber(e.heldout_rms_before_um), jsonNumber(e.heldout_rms_after_um)}},
          {"forced", e.forced}};
}

FoundEffect effectOfStored(const nlohmann::json& json) {
  FoundEffect e;
  e.id = json.at("id").get<std::string>();
  e.title = json.value("title", "");
  e.physics = json.at("physics").get<std::string>();
  e.drivers = json.at("drivers").get<std::string>();
  e.rivals = json.at("rivals").get<std::vector<std::string>>();
  e.containers = json.value("containers", std::vector<std::string>());
  e.confidence = storedNumber(json, "confidence");
  for (const auto& p : json.at("parameters"))
    e.parameters.push_back({p.at(0).get<std::string>(), numberIn(p.at(1)), numberIn(p.at(2))});
  e.delta_bic = laterNumber(json, "delta_bic");
  e.delta_chi2 = laterNumber(json, "delta_chi2");
  e.rms_um = laterNumber(json, "rms_um");
  laterPair(json, "crossvalidated", e.crossvalidated_rms_before_um, e.crossvalidated_rms_after_um);
  laterPair(json, "heldout", e.heldout_rms_before_um, e.heldout_rms_after_um);
  e.forced = json.value("forced", false);
  return e;
}

nlohmann::json storedGap(const DiscrepancyGap& gap) {
  return {{"rms_before_um", jsonNumber(gap.rms_before_um)},
          {"rms_after_um", jsonNumber(gap.rms_after_um)},
          {"noise_um", jsonNumber(gap.noise_um)},
          {"heldout_rms_before_um", jsonNumber(gap.heldout_rms_before_um)},
          {"heldout_rms_after_um", jsonNumber(gap.heldout_rms_after_um)},
          {"rotations", gap.rotations}};
}

DiscrepancyGap gapOfStored(const nlohmann::json& json) {
  return {storedNumber(json, "rms_before_um"),
          storedNumber(json, "rms_after_um"),
          storedNumber(json, "noise_um"),
          storedNumber(json, "heldout_rms_before_um"),
          storedNumber(json, "heldout_rms_after_um"),
          json.value("rotations", false)};
}

}  // namespace spindrift
