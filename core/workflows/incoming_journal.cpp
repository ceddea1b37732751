// SPDX-License-Identifier: Apache-2.0
// What arrived, as the session keeps it.
#include <fmt/format.h>

#include <algorithm>

#include "core/session/session.h"
#include "core/workflows/incoming.h"

namespace spindrift {
namespace {

/// px/um and px: what the comparison of images needs of a pose.
nlohmann::json poseJson(const ImagePose& pose) {
  return {{"a", pose.a},
          {"b", pose.b},
          {"x_px", pose.origin_px.x()},
          {"y_px", pose.origin_px.y()},
          {"mirrored", pose.mirrored}};
}

std::optional<ImagePose> parsePose(const nlohmann::json& json) {
  ImagePose pose;
  pose.status = FitStatus::Converged;
  pose.a = json.value("a", 0.0);
  pose.b = json.value("b", 0.0);
  pose.origin_px = {json.value("x_px", 0.0), json.value("y_px", 0.0)};
  pose.mirrored = json.value("mirrored", false);
  if (!(pose.a * pose.a + pose.b * pose.b > 0.0)) return std::nullopt;
  return pose;
}

}  // namespace

nlohmann::json IncomingItem::json() const {
  nlohmann::json out = {{"name", name},
                        {"kind", static_cast<int>(kind)},
                        {"state", static_cast<int>(state)},
                        {"sentence", sentence},
                        {"hash", hash},
                        {"stored", stored},
                        {"plan_item", plan_item},
                        {"time_s", time_s}};
  if (sharpness > 0.0) out["sharpness"] = sharpness;
  if (pose) out["pose"] = poseJson(*pose);
  return out;
}

IncomingItem IncomingItem::parse(const nlohmann::json& json) {
  IncomingItem item;
  item.name = json.value("name", "");
  item.kind = static_cast<IncomingKind>(std::clamp(json.value("kind", 3), 0, 3));
  item.state = static_cast<IncomingState>(std::clamp(json.value("state", 4), 0, 4));
  item.sentence = json.value("sentence", "");
  item.hash = json.value("hash", "");
  item.stored = json.value("stored", "");
  item.plan_item = json.value("plan_item", "");
  item.time_s = json.value("time_s", 0.0);
  item.sharpness = json.value("sharpness", 0.0);
  if (json.contains("pose") && json["pose"].is_object()) item.pose = parsePose(json["pose"]);
  return item;
}

std::vector<IncomingItem> incomingJournal(const Session& session, std::int64_t campaign) {
  std::vector<IncomingItem> items;
  for (const nlohmann::json& entry : session.arrivals(campaign)) {
    try {
      items.push_back(IncomingItem::parse(entry));
    } catch (const nlohmann::json::exception&) {
      // Not written by this program. The capture itself stands in the lists of the campaign.
    }
  }
  return items;
}

MeasurementPlan storedPlan(const Session& session, std::int64_t campaign) {
  const auto stored = session.setting(fmt::format("plan/{}", campaign));
  if (!stored || !stored->is_object() || stored->empty()) return {};
  return MeasurementPlan::parse(JsonNode::parse(stored->dump(), "measurement plan"));
}

void storePlan(Session& session, std::int64_t campaign, const MeasurementPlan& plan) {
  session.setSetting(fmt::format("plan/{}", campaign), plan.json());
}

void recordArrival(Session& session, std::int64_t campaign, const ExaminedFile& examined) {
  if (!examined.row.empty()) session.addCaptureRows(campaign, examined.list, examined.header, {examined.row});
  const std::string& name = examined.item.name;
  nlohmann::json entry = examined.item.json();
  if (const auto known = session.arrival(campaign, name); known && known->is_object()) {
    // The same file once more has no news: what was measured in it stays.
    const bool same = known->value("hash", nlohmann::json()) == examined.item.hash && !entry.contains("sharpness");
    for (const char* measured : {"pose", "sharpness"}) {
      if (same && known->contains(measured)) entry[measured] = (*known)[measured];
    }
  }
  session.setArrival(campaign, name, entry);
}

}  // namespace spindrift
