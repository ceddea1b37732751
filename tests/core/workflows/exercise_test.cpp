// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/exercise.h"

#include <gmock/gmock.h>

#include <set>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/machine/campaign.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

NamedSize sizeOf(const HiddenEffect& hidden, double more_u = 0.0) {
  const EffectSize& size = hidden.sizes.front();
  return {size.value + more_u * size.uncertainty, std::string(unitOf(size.component))};
}

ExerciseAnswer perfect(const ExerciseKey& key) {
  ExerciseAnswer answer;
  for (const HiddenEffect& hidden : key.hidden)
    answer.named.push_back({hidden.id, hidden.drivers.empty() ? "" : hidden.drivers.front(), sizeOf(hidden)});
  return answer;
}

TEST(Exercise, WritesACampaignThatDoesNotGiveItselfAway) {
  const testing::TempFolder folder;
  const std::filesystem::path campaign = folder.path() / "campaign";
  JobContext job;
  const Exercise exercise{5, ExerciseLevel::Easy};
  writeExercise(exercise, campaign, job);
  const Campaign read = Campaign::read(campaign);
  EXPECT_TRUE(read.observations.has_value());
  EXPECT_FALSE(read.simulation.empty());
  const auto again = Exercise::of(campaign);
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->seed, 5U);
  EXPECT_EQ(again->level, ExerciseLevel::Easy);
  const std::string hidden = exerciseCase(exercise).hidden.front();
  for (const auto& entry : std::filesystem::directory_iterator(campaign)) {
    if (entry.is_regular_file()) {
      EXPECT_THAT(readFile(entry.path()), Not(HasSubstr(hidden))) << entry.path();
    }
  }
  // It can be named from what there is to choose from.
  std::set<std::string> ids;
  for (const ExerciseChoice& choice : exerciseChoices(campaign)) ids.insert(choice.id);
  EXPECT_THAT(ids, Contains(hidden));
  EXPECT_THROW(writeExercise(exercise, campaign, job), InputError);
}

TEST(Exercise, LevelsDifferInHowMuchIsHidden) {
  std::set<std::string> drawn;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    EXPECT_EQ(exerciseCase({seed, ExerciseLevel::Easy}).hidden.size(), 1U);
    EXPECT_EQ(exerciseCase({seed, ExerciseLevel::Medium}).hidden.size(), 2U);
    EXPECT_EQ(exerciseCase({seed, ExerciseLevel::Hard}).hidden.size(), 3U);
    EXPECT_EQ(exerciseCase({seed, ExerciseLevel::Hard}).hidden, exerciseCase({seed, ExerciseLevel::Hard}).hidden);
    drawn.insert(exerciseCase({seed, ExerciseLevel::Easy}).hidden.front());
  }
  EXPECT_GE(drawn.size(), 6U);
}

TEST(Exercise, ARightAnswerHasAllMarksAndEveryFaultCosts) {
  JobContext job;
  for (const auto level : {ExerciseLevel::Easy, ExerciseLevel::Medium}) {
    const ExerciseKey key = exerciseKey({3, level}, job);
    for (const HiddenEffect& hidden : key.hidden) {
      const EffectSize& size = hidden.sizes.front();
      EXPECT_GT(size.value, 5.0 * size.uncertainty / (1.0 + 0.1 * size.value)) << hidden.id;
      EXPECT_GT(size.uncertainty, 0.0);
    }
    const ExerciseAnswer right = perfect(key);
    EXPECT_EQ(scoreExercise(key, right).total, 100);
    EXPECT_TRUE(scoreExercise(key, right).allNamed());
    ExerciseAnswer answer = right;
    answer.hints = 2;
    EXPECT_EQ(scoreExercise(key, answer).total, 80);
    answer.searched_before = true;
    EXPECT_EQ(scoreExercise(key, answer).total, 40);
    answer = right;
    answer.named.front().size = sizeOf(key.hidden.front(), 3.0);
    EXPECT_EQ(scoreExercise(key, answer).total, level == ExerciseLevel::Easy ? 80 : 90);
    answer.named.front().size = sizeOf(key.hidden.front(), 1.9);
    EXPECT_EQ(scoreExercise(key, answer).total, 100);
    EXPECT_EQ(scoreExercise(key, {}).total, 0);
    EXPECT_FALSE(scoreExercise(key, {}).allNamed());
    answer = right;
    answer.named.push_back({"backlash.z", "", {}});
    if (!scoreExercise(key, answer).wrong.empty()) {
      EXPECT_LT(scoreExercise(key, answer).total, 100);
    }
  }
}

TEST(Exercise, NestedEffectsCountHalfAndOthersCost) {
  ExerciseKey key;
  HiddenEffect hidden;
  hidden.id = "spindle.growth.z";
  hidden.drivers = {"spindle_rpm^1.5", "T_spindle_degC"};
  hidden.alike = {"head.tilt.a"};
  hidden.sizes = {{Component::EZ, 20.0, 2.0}};
  key.hidden = {hidden};
  const NamedSize right{20.0, "um"};
  EXPECT_EQ(scoreExercise(key, {{{"head.tilt.a", "T_spindle_degC", right}}}).total, 30);
  EXPECT_EQ(scoreExercise(key, {{{"spindle.growth.z", "T_room_degC", right}}}).total, 80);
  EXPECT_EQ(scoreExercise(key, {{{"spindle.growth.z", "T_spindle_degC", {}}}}).total, 80);
  const NamedSize nearly{23.0, "um"};
  EXPECT_EQ(scoreExercise(key, {{{"spindle.growth.z", "T_spindle_degC", nearly}, {"ambient.drift.x", "", {}}}}).total,
            75);
  EXPECT_EQ(scoreExercise(key, {{{"ambient.drift.x", "", {}}}}).total, 0);
  EXPECT_THROW((void)scoreExercise(key, {{{"a.b", "", {}}, {"a.b", "", {}}}}), InputError);
  EXPECT_THROW((void)scoreExercise(key, {{}, 4}), InputError);
  EXPECT_THAT(scoreExercise(key, {{{"head.tilt.a", "", {}}}}).text(), HasSubstr("nested"));
}

TEST(Exercise, ASizeHasTheUnitOfWhatTheEffectChanges) {
  JobContext job;
  const Exercise exercise{5, ExerciseLevel::Easy};
  const ExerciseKey key = exerciseKey(exercise, job);
  ExerciseAnswer answer = perfect(key);  // a shift along Y: displacements alone
  ASSERT_EQ(key.hidden.front().sizes.size(), 1U);
  ASSERT_EQ(answer.named.front().size->unit, "um");
  EXPECT_EQ(scoreExercise(key, answer).total, 100);
  answer.named.front().size->unit = "urad";
  EXPECT_THROW((void)scoreExercise(key, answer), InputError);
  // What is not hidden is refused in the same way: a refusal gives nothing away.
  answer.named.front() = {"ambient.drift.z", "", NamedSize{12.0, "urad"}};
  ASSERT_NE(key.hidden.front().id, "ambient.drift.z");
  EXPECT_THROW((void)scoreExercise(key, answer), InputError);
  // An effect that changes both may be answered in either, each held against its own size.
  ExerciseKey both;
  both.hidden = {{"head.tilt.a", {}, {}, {{Component::EA, 30.0, 2.0}, {Component::EY, 12.0, 2.0}}}};
  both.units["head.tilt.a"] = {"um", "urad"};
  EXPECT_EQ(scoreExercise(both, {{{"head.tilt.a", "", NamedSize{12.0, "um"}}}}).total, 100);
  EXPECT_EQ(scoreExercise(both, {{{"head.tilt.a", "", NamedSize{30.0, "urad"}}}}).total, 100);
  EXPECT_EQ(scoreExercise(both, {{{"head.tilt.a", "", NamedSize{12.0, "urad"}}}}).total, 80);
  EXPECT_EQ(scoreExercise(both, {{{"head.tilt.a", "", NamedSize{30.0, "um"}}}}).total, 80);
  both.hidden.front().sizes.pop_back();  // it turns, and shifts no point by more than noise
  EXPECT_EQ(scoreExercise(both, {{{"head.tilt.a", "", NamedSize{30.0, "um"}}}}).total, 80);
  // What can be named says which units it has, and never none.
  const testing::TempFolder folder;
  writeExercise(exercise, folder.path() / "campaign", job);
  bool rotates = false;
  for (const ExerciseChoice& choice : exerciseChoices(folder.path() / "campaign")) {
    EXPECT_FALSE(choice.units.empty()) << choice.id;
    EXPECT_EQ(choice.units, key.units.at(choice.id));
    rotates = rotates || choice.units.back() == "urad";
  }
  EXPECT_TRUE(rotates);
}

TEST(Exercise, TheRightDriverIsTheOneThatMovedTheMachine) {
  // A spindle that grows is not driven by the room, an ambient drift is not driven by the spindle.
  JobContext job;
  int judged = 0;
  for (std::uint64_t seed = 1; seed <= 40 && judged < 3; ++seed) {
    const Exercise exercise{seed, ExerciseLevel::Easy};
    const std::string id = exerciseCase(exercise).hidden.front();
    const bool spindle = id.starts_with("spindle.growth") || id.starts_with("spindle.drift");
    const bool ambient = id.starts_with("ambient.");
    if (!spindle && !ambient) continue;
    const ExerciseKey key = exerciseKey(exercise, job);
    ++judged;
    const std::vector<std::string>& drivers = key.hidden.front().drivers;
    ASSERT_FALSE(drivers.empty()) << id;
    for (const std::string& driver : drivers) {
      EXPECT_EQ(driver.find("ambient") != std::string::npos || driver.find("room") != std::string::npos, ambient)
          << id << " by " << driver;
    }
  }
  EXPECT_GE(judged, 2);
}

TEST(Exercise, HintsAndWhatIsNotAllowed) {
  JobContext job;
  const ExerciseKey key = exerciseKey({3, ExerciseLevel::Medium}, job);
  for (int hint = 1; hint <= exercise_hints; ++hint) {
    EXPECT_FALSE(exerciseHint(key, hint).empty());
    for (const HiddenEffect& hidden : key.hidden) EXPECT_THAT(exerciseHintText(key, hint), Not(HasSubstr(hidden.id)));
  }
  EXPECT_THROW((void)exerciseHint(key, 0), InputError);
  EXPECT_THROW((void)exerciseLevelFromString("insane"), InputError);
  EXPECT_THROW((void)AnsweredEffect::parse(""), InputError);
  EXPECT_THROW((void)AnsweredEffect::parse("a:b:c"), InputError);
  EXPECT_THROW((void)AnsweredEffect::parse("a:b:1:2"), InputError);
  EXPECT_THROW((void)AnsweredEffect::parse("a:b:1"), InputError) << "1 of what";
  EXPECT_THROW((void)AnsweredEffect::parse("a:b:um"), InputError);
  EXPECT_THROW((void)AnsweredEffect::parse("a:b:-1um"), InputError);
  EXPECT_THROW((void)AnsweredEffect::parse("a:b:1mm"), InputError);
  const NamedSize size = AnsweredEffect::parse("a.b:spindle_rpm^1.5:3.5um").size.value();
  EXPECT_EQ(size.value, 3.5);
  EXPECT_EQ(size.unit, "um");
  // What nothing in the log drives has no driver to name.
  for (const auto& [text, unit] : {std::pair{"a.b::12 µrad", "urad"}, std::pair{"a.b::12µm", "um"}}) {
    const AnsweredEffect named = AnsweredEffect::parse(text);
    EXPECT_EQ(named.driver, "");
    ASSERT_TRUE(named.size.has_value());
    EXPECT_EQ(named.size->value, 12.0);
    EXPECT_EQ(named.size->unit, unit);
  }
  const testing::TempFolder folder;
  EXPECT_FALSE(Exercise::of(folder.path()).has_value());
  for (const char* text : {"{}", R"({"format":"spindrift-exercise","version":2,"seed":1,"level":"easy"})",
                           R"({"format":"spindrift-exercise","version":1,"seed":-1,"level":"easy"})",
                           R"({"format":"spindrift-exercise","version":1,"seed":1,"level":"odd"})"}) {
    writeFileAtomically(folder.path() / "exercise.json", text);
    EXPECT_THROW((void)Exercise::of(folder.path()), InputError) << text;
  }
}

}  // namespace
}  // namespace spindrift
