// SPDX-License-Identifier: Apache-2.0
// The exercise "find the missing effect": a campaign of the virtual machine whose simulation lacks something, drawn at
// random, and marks for who names it.
//
// What is hidden follows from seed and level alone (core/simulation/study_campaigns.h); exercise.json in the campaign
// folder holds these two and nothing of the truth, which is worked out again when the answer is given.
//
// Levels: easy, one effect of 10 times the noise; medium, two of 6 times, states shifted as a whole; hard, three of 4
// times, and all that a workshop does to a campaign (StudyConditions::together).
//
// Marks, 100 in all, shared evenly among the hidden effects: the effect 60 %, its driver 20 %, its size 20 %. An effect
// that holds the hidden one as a special case, or is held by it, counts half and has no marks for driver and size. A
// name that is not hidden costs a quarter of a share, a hint 10, and who ran the search first gets half.
//   driver: the driver given explains the noise-free signal nearly as well as the best of the catalogue does (R^2 of a
//           least-squares fit through one lag at least 0.9 of the best); right for effects that no log drives.
//   size:   largest change between two states at one point, noise-free, as displacement (um) or as rotation (urad); an
//           effect that changes both may be answered in either. Right within twice u, u^2 = 2 sigma^2 (two readings of
//           the real noise) + (0.1 size)^2 (the simulation is a little off).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/job_context.h"
#include "core/machine/component.h"
#include "core/simulation/study_campaigns.h"

namespace spindrift {

enum class ExerciseLevel { Easy, Medium, Hard };

[[nodiscard]] std::string_view toString(ExerciseLevel level) noexcept;
/// Throws InputError naming the levels.
[[nodiscard]] ExerciseLevel exerciseLevelFromString(std::string_view name);

/// What an exercise is, without its truth.
struct Exercise {
  std::uint64_t seed = 1;
  ExerciseLevel level = ExerciseLevel::Easy;

  [[nodiscard]] int effects() const noexcept { return 1 + static_cast<int>(level); }
  /// exercise.json of a campaign; nothing if it is no exercise. Throws InputError for a file that is none.
  [[nodiscard]] static std::optional<Exercise> of(const std::filesystem::path& campaign);
};

/// The case behind it: who calls this knows the answer.
[[nodiscard]] StudyCase exerciseCase(const Exercise& exercise);

/// Writes the campaign and exercise.json. Throws InputError if the folder is there and not empty.
void writeExercise(const Exercise& exercise, const std::filesystem::path& folder, JobContext& job);

/// Largest change of one component between two states at one point, noise-free.
struct EffectSize {
  Component component = Component::EX;
  double value = 0.0;        ///< um or urad
  double uncertainty = 0.0;  ///< u above
};

/// One hidden effect with what counts as right.
struct HiddenEffect {
  std::string id;
  std::vector<std::string> drivers;  ///< accepted, as driverText writes them; empty: nothing in the log drives it
  std::vector<std::string> alike;    ///< ids that hold it or that it holds
  /// First that which stands out most of the noise; then that of the other kind (displacement, rotation), where it is
  /// larger than 2 u.
  std::vector<EffectSize> sizes;
};

struct ExerciseKey {
  Exercise exercise;
  std::vector<HiddenEffect> hidden;
  /// By id of an effect that can be named: the units that its size may have ("um", "urad").
  std::map<std::string, std::vector<std::string>> units;
};
/// Runs the virtual machine again.
[[nodiscard]] ExerciseKey exerciseKey(const Exercise& exercise, JobContext& job);

/// An effect that a learner may pick, and drivers to choose from.
struct ExerciseChoice {
  std::string id;
  std::string title;
  std::string family;                ///< "ball_screw"
  std::vector<std::string> drivers;  ///< as the log has them, inputs that act together joined by " + "
  std::vector<std::string> units;    ///< "um", "urad": what it changes where the campaign observes
};
/// Everything that the machine and the log of the campaign allow, family by family; says nothing of what is hidden.
[[nodiscard]] std::vector<ExerciseChoice> exerciseChoices(const std::filesystem::path& campaign);

/// A size as a learner gives it.
struct NamedSize {
  double value = 0.0;
  std::string unit;  ///< "um" or "urad"
};

/// What a learner says. A driver may be left out, a size as well.
struct AnsweredEffect {
  std::string id;
  std::string driver;
  std::optional<NamedSize> size;
  /// "column.bending.a:column_difference:12.5um". Throws InputError.
  [[nodiscard]] static AnsweredEffect parse(const std::string& text);
};

struct ExerciseAnswer {
  std::vector<AnsweredEffect> named;
  int hints = 0;                 ///< used, 0 ... 3
  bool searched_before = false;  ///< the search had been run
};

struct ExerciseScore {
  struct Line {
    HiddenEffect hidden;
    std::string named;  ///< what was counted for it; empty: nothing
    bool exact = false;
    bool driver_right = false;
    bool size_right = false;
    std::optional<NamedSize> size_named;
    double marks = 0.0;
    /// What the size is held against: of the unit that was given, else the first.
    [[nodiscard]] const EffectSize& size() const;
  };
  std::vector<Line> lines;         ///< one for each hidden effect
  std::vector<std::string> wrong;  ///< names that are not hidden
  ExerciseAnswer answer;
  int total = 0;  ///< 0 ... 100

  [[nodiscard]] bool allNamed() const;
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string text() const;
};
/// Throws InputError for an id that stands twice, a size in a unit that the effect named cannot have, or hints that
/// there are not.
[[nodiscard]] ExerciseScore scoreExercise(const ExerciseKey& key, const ExerciseAnswer& answer);

inline constexpr int exercise_hints = 3;
/// Hint 1: components in which the gap is largest; 2: what drives it; 3: families of what is hidden. As names, each
/// once: "EX"; drivers, or "none"; "ball_screw".
[[nodiscard]] std::vector<std::string> exerciseHint(const ExerciseKey& key, int number);
[[nodiscard]] std::string exerciseHintText(const ExerciseKey& key, int number);

}  // namespace spindrift
