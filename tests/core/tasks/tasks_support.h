// SPDX-License-Identifier: GPL-3.0-or-later
// A session with one campaign of images, and results put into it without working anything out.
#pragma once

#include <memory>
#include <string>

#include "core/session/session.h"
#include "core/tasks/campaign_state.h"
#include "core/tasks/steps.h"
#include "core/tasks/task_graph.h"
#include "core/tasks/task_options.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {

class TaskSession {
 public:
  TaskSession() : session_(Session::create(folder_ / "s")) {
    id_ = session_.newCampaign("c", "2026-01-31T08:00:00Z",
                               R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-t]",
                                   "axes":[{"name":"X","travel_mm":[0,300]}]})");
    capture(0);
  }
  void capture(int number) {
    const std::string name = "captures/images/" + std::to_string(number) + ".jpg";
    folder_.write("s/campaigns/c/" + name, name);
    session_.addCaptureRows(id_, "fiducials.csv", "time_s,image", {std::to_string(number) + "," + name});
  }
  [[nodiscard]] TaskGraph graph() {
    results_ = {};
    return {session_, id_, std::make_shared<Campaign>(Campaign::read(session_.campaign(id_).folder)),
            [this](const TaskGraph& graph, const std::string& kind) { return results_.latest(graph, kind); }, ledger_};
  }
  [[nodiscard]] TaskStatus status(const std::string& task) { return graph().status(task); }
  [[nodiscard]] StepReport step(StepId which) {
    const TaskGraph now = graph();
    return stepReport(now, which, CaptureCounts::of(now));
  }
  void run(const std::string& task, const nlohmann::json& payload = nlohmann::json::object()) {
    session_.keepResult(graph().origin(task), payload);
  }
  void option(const std::string& key, const nlohmann::json& value) {
    session_.setSetting(campaignKey(key, id_), value);
  }

  TempFolder folder_;
  Session session_;
  std::int64_t id_ = 0;
  TaskLedger ledger_;

 private:
  CampaignResults results_;
};

}  // namespace spindrift::testing
