// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/loop_state.h"

#include <gmock/gmock.h>

#include "core/workflows/loop_models.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::spindrift::testing::TempFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class LoopLog : public ::testing::Test {
 protected:
  LoopLog() {
    folder_.write("machine.json", R"({"format":"spindrift-machine","version":1,"name":"mill",
"chain":"V [w-X'-Y'-b-Z-t]","axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,200]},
{"name":"Z","travel_mm":[0,150]}]})");
    const char* plan = R"({"format":"spindrift-loop-plan","version":1,"machine":"machine.json",
"control":{"kind":"linuxcnc","folder":"control"},"temperatures":["T_column_degC"],"touches":[{"point":"F1",
"component":"EZ","before_mm":[1,2,5],"target_mm":[1,2,2]}],"programme":[{"from_s":0,"spindle_rpm":1000}],
"reference_mm":[1,2,3],"safe_z_mm":50,"duration_s":3600})";
    plan_ = LoopPlan::parse(JsonNode::parse(plan, "plan.json"), folder_.write("plan.json", plan));
  }
  /// The times that a loop goes on with after this log.
  std::vector<double> timesAfter(const std::string& log) {
    const auto say = [](const std::string&) {};
    const nlohmann::json state = LoopModels(plan_, say).state();
    LoopModels models(plan_, say);
    models.restore(JsonNode::parse(state.dump(), "loop-state.json"), folder_.write("log.csv", log), folder_.path(),
                   0.0);
    return models.times();
  }
  std::string refusal(const std::string& log) {
    try {
      (void)timesAfter(log);
    } catch (const InputError& e) {
      return e.what();
    }
    return "taken";
  }

  TempFolder folder_;
  LoopPlan plan_;
};

TEST_F(LoopLog, IsReadAsEveryLogIs) {
  EXPECT_THAT(timesAfter("time_s,spindle_rpm,T_column_degC\n"), ElementsAre());
  EXPECT_THAT(timesAfter("time_s,spindle_rpm,T_column_degC\n0,0,20\n60,,21\n120,1000,\n"), ElementsAre(0, 60, 120))
      << "a value that is not known is no fault";
  EXPECT_THAT(refusal("time_s,spindle_rpm,T_column_degC\n60,0,20\n0,0,20\n"), HasSubstr("jumps back from 60 to 0"));
  EXPECT_THAT(refusal("time_s,spindle_rpm\n0,0\n"), HasSubstr("column \"T_column_degC\" is missing"));
  EXPECT_THAT(refusal("time_s,spindle_rpm,T_column_degC\n0,0,warm\n"), HasSubstr("\"warm\" is not a number"));
}

}  // namespace
}  // namespace spindrift
