// SPDX-License-Identifier: Apache-2.0
#include "core/plant/plant_types.h"

#include <algorithm>

#include "core/base/json_reader.h"
#include "core/base/sha256.h"

namespace spindrift {

std::string_view toString(PlantRole role) noexcept {
  switch (role) {
    case PlantRole::Reader:
      return "reader";
    case PlantRole::Writer:
      return "writer";
    case PlantRole::Owner:
      return "owner";
  }
  return "";
}

const std::vector<std::string>& eventKinds() {
  static const std::vector<std::string> kinds{"spindle_changed", "re_levelled", "crash", "repair", "moved", "note"};
  return kinds;
}

std::string eventWords(const std::string& event_kind) {
  if (event_kind == "re_levelled") return "re-levelled";
  std::string words = event_kind;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

bool changesMachine(const std::string& event_kind) {
  return event_kind != "note";
}

PublishCount& PublishCount::operator+=(const PublishCount& other) {
  campaigns_new += other.campaigns_new;
  campaigns_there += other.campaigns_there;
  results_new += other.results_new;
  results_there += other.results_there;
  results_again += other.results_again;
  return *this;
}

namespace {

nlohmann::json parametersJson(const std::vector<PlantParameter>& parameters) {
  nlohmann::json out = nlohmann::json::array();
  for (const PlantParameter& p : parameters) {
    out.push_back(
        {{"state", p.state}, {"name", p.name}, {"value", p.value}, {"standard_uncertainty", p.standard_uncertainty}});
  }
  return out;
}

nlohmann::json toJson(const PlantResult& r) {
  return {{"kind", r.kind},
          {"program_version", r.program_version},
          {"created_utc", r.created_utc},
          {"inputs_fingerprint", r.inputs_fingerprint},
          {"options", r.options},
          {"verdict", r.verdict},
          {"parameters", parametersJson(r.parameters)},
          {"covariance", r.covariance},
          {"model", r.model}};
}

nlohmann::json valueOr(const JsonNode& node, const char* key, nlohmann::json otherwise) {
  const auto found = node.find(key);
  return found ? found->value() : std::move(otherwise);
}

}  // namespace

std::string PlantResult::key() const {
  // Who worked it out and when says nothing about what it is.
  nlohmann::json content = toJson(*this);
  content.erase("created_utc");
  return sha256(content.dump());
}

nlohmann::json PlantCampaign::json() const {
  nlohmann::json out = {
      {"machine", machine},     {"description", description},          {"name", name},
      {"start_s", start_s},     {"fingerprint", fingerprint},          {"program_version", program_version},
      {"publisher", publisher}, {"captures", nlohmann::json::array()}, {"results", nlohmann::json::array()}};
  for (const PlantCapture& c : captures) out["captures"].push_back({{"address", c.address}, {"sha256", c.sha256}});
  for (const PlantResult& r : results) out["results"].push_back(toJson(r));
  return out;
}

PlantCampaign PlantCampaign::parse(const nlohmann::json& json, const std::string& what) {
  const JsonNode root = JsonNode::parse(json.dump(), what);
  PlantCampaign c;
  c.machine = root.at("machine").name();
  c.description = valueOr(root, "description", nlohmann::json::object());
  c.name = root.at("name").name();
  c.start_s = root.at("start_s").number();
  c.fingerprint = root.at("fingerprint").name();
  c.program_version = root.at("program_version").string();
  c.publisher = root.stringOr("publisher", "");
  for (const JsonNode& capture : root.at("captures").items())
    c.captures.push_back({capture.at("address").string(), capture.at("sha256").string()});
  for (const JsonNode& result : root.at("results").items()) {
    PlantResult r;
    r.kind = result.at("kind").name();
    r.program_version = result.at("program_version").string();
    r.created_utc = result.at("created_utc").string();
    r.inputs_fingerprint = result.at("inputs_fingerprint").string();
    r.options = valueOr(result, "options", nlohmann::json::object());
    r.verdict = result.stringOr("verdict", "");
    for (const JsonNode& p : result.at("parameters").items())
      r.parameters.push_back({p.at("state").string(), p.at("name").name(), p.at("value").number(),
                              p.at("standard_uncertainty").nonNegativeNumber()});
    r.covariance = valueOr(result, "covariance", nullptr);
    r.model = valueOr(result, "model", nullptr);
    c.results.push_back(std::move(r));
  }
  return c;
}

}  // namespace spindrift
