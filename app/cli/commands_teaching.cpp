// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "app/cli/command.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/machine/driver_words.h"
#include "core/workflows/discrepancy_workflow.h"
#include "core/workflows/exercise.h"
#include "core/workflows/what_if.h"

namespace spindrift::cli {
namespace {

struct WhatIfArguments {
  std::string campaign, machine, svg, png;
  std::vector<std::string> settings;
  bool list = false;
};

CommandResult whatIf(const WhatIfArguments& arguments) {
  WhatIfRequest request;
  request.campaign = arguments.campaign;
  request.machine = arguments.machine;
  request.settings = arguments.settings;
  request.svg = arguments.svg;
  request.png = arguments.png;
  const WhatIf what_if = runWhatIf(request);
  CommandResult result;
  result.json = arguments.list ? whatIfParametersJson(what_if) : what_if.json();
  result.summary = arguments.list ? whatIfParametersText(what_if) : whatIfText(what_if);
  return result;
}

struct ExerciseArguments {
  std::string campaign, level = "easy", out;
  std::vector<std::string> answers;
  int seed = 1;
  int hints = 0;
  bool searched = false, search = false;
};

nlohmann::json exerciseJson(const Exercise& exercise) {
  return {{"seed", exercise.seed}, {"level", toString(exercise.level)}, {"hidden_effects", exercise.effects()}};
}

CommandResult newExercise(const ExerciseArguments& arguments, JobContext& job) {
  if (!arguments.answers.empty() || arguments.hints > 0 || arguments.search)
    throw InputError("--answer, --hints and --search belong to the CAMPAIGN of an exercise; none is given.");
  if (arguments.out.empty())
    throw InputError(
        "Neither a CAMPAIGN nor --out is given; allowed: --out for a new exercise, or the CAMPAIGN of one.");
  const Exercise exercise{static_cast<std::uint64_t>(arguments.seed), exerciseLevelFromString(arguments.level)};
  writeExercise(exercise, arguments.out, job);
  CommandResult result;
  result.json = exerciseJson(exercise);
  result.json["campaign"] = arguments.out;
  result.summary = fmt::format(
      "{}: campaign of a machine whose simulation lacks {} (level {}, seed {}).\n"
      "Look at it, then: spindrift-cli exercise {} --answer EFFECT:DRIVER:SIZE",
      arguments.out, exercise.effects() == 1 ? "one effect" : fmt::format("{} effects", exercise.effects()),
      arguments.level, arguments.seed, arguments.out);
  return result;
}

CommandResult continueExercise(const ExerciseArguments& arguments, JobContext& job) {
  if (!arguments.out.empty()) throw InputError("A CAMPAIGN and --out are both given; allowed: one of them.");
  const auto exercise = Exercise::of(arguments.campaign);
  if (!exercise) {
    throw InputError({std::filesystem::path(arguments.campaign) / "exercise.json", ""},
                     "is missing: this campaign is not an exercise; \"exercise --out DIR\" makes one.");
  }
  const bool answered = !arguments.answers.empty();
  CommandResult result;
  result.json = exerciseJson(*exercise);
  JobContext first = job.part(0.0, arguments.search ? 0.2 : 1.0);
  if (!answered && arguments.hints == 0) {
    nlohmann::json choices = nlohmann::json::array();
    for (const ExerciseChoice& choice : exerciseChoices(arguments.campaign)) {
      choices.push_back({{"id", choice.id},
                         {"title", choice.title},
                         {"family", choice.family},
                         {"drivers", choice.drivers},
                         {"units", choice.units}});
      result.summary +=
          fmt::format("{:<26} {} ({})\n", choice.id, choice.title, printedUnit(joinedList(choice.units, "or")));
      for (const std::string& driver : choice.drivers)
        result.summary += fmt::format("{:>30}{}  {}\n", "", driver, driversInWords(driver));
    }
    result.json["choices"] = choices;
    return result;
  }
  const ExerciseKey key = exerciseKey(*exercise, first);
  result.json["hints"] = nlohmann::json::array();
  for (int hint = 1; hint <= arguments.hints; ++hint) {
    result.json["hints"].push_back(exerciseHintText(key, hint));
    if (!answered) result.summary += exerciseHintText(key, hint) + "\n";
  }
  if (!answered) return result;
  ExerciseAnswer answer;
  for (const std::string& text : arguments.answers) answer.named.push_back(AnsweredEffect::parse(text));
  answer.hints = arguments.hints;
  answer.searched_before = arguments.searched;
  const ExerciseScore score = scoreExercise(key, answer);
  result.json.update(score.json());
  result.summary = score.text();
  result.exit_status = score.allNamed() ? Done : NotGoodEnough;
  if (arguments.search) {
    DiscrepancyRequest request;
    request.campaign = arguments.campaign;
    JobContext searching = job.part(0.2, 1.0);
    const DiscrepancyRun run = runDiscrepancy(request, searching);
    const nlohmann::json found = run.json();
    result.json["search"] = {{"verdict", found.at("verdict")}, {"effects", nlohmann::json::array()}};
    result.summary += fmt::format("the search: {}", found.at("verdict").get<std::string>());
    for (const nlohmann::json& effect : found.at("effects")) {
      result.json["search"]["effects"].push_back({{"id", effect.at("id")}, {"confidence", effect.at("confidence")}});
      result.summary +=
          fmt::format(", {} ({:.2f})", effect.at("id").get<std::string>(), effect.at("confidence").get<double>());
    }
    result.summary += "\n";
  }
  return result;
}

}  // namespace

void addTeachingCommands(CLI::App& app, CommandLine& line) {
  auto what = std::make_shared<WhatIfArguments>();
  CLI::App* what_if = addCommand(
      app, line, "what-if",
      "Set geometric errors and thermal effects of a machine, and show what they do to probing points, artefacts and a "
      "milled test piece",
      [what](JobContext&) { return whatIf(*what); });
  what_if->add_option("CAMPAIGN", what->campaign, "Campaign folder of the machine; default: a standard machine");
  what_if->add_option("--machine", what->machine, "Machine (machine.json), in place of a campaign")->type_name("FILE");
  what_if
      ->add_option("--set", what->settings,
                   "Value of an error parameter (EC0Y_urad=20) or of the driver of an effect (column.bending.a=2); may "
                   "be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  what_if->add_flag("--list", what->list, "List all parameters with unit, range, driver and sensitivity");
  what_if->add_option("--svg", what->svg, "Picture of the test piece with its deviations exaggerated")
      ->type_name("FILE");
  what_if->add_option("--png", what->png, "The same as PNG")->type_name("FILE");

  auto arguments = std::make_shared<ExerciseArguments>();
  CLI::App* exercise = addCommand(
      app, line, "exercise",
      "Find the missing effect: write a campaign with hidden effects drawn at random, list what can be named, mark an "
      "answer",
      [arguments](JobContext& job) {
        return arguments->campaign.empty() ? newExercise(*arguments, job) : continueExercise(*arguments, job);
      });
  exercise->add_option("CAMPAIGN", arguments->campaign,
                       "Campaign of an exercise; without --answer and --hints: list the effects to choose from");
  exercise->add_option("--out", arguments->out, "Folder of a new exercise: new or empty")->type_name("DIR");
  exercise->add_option("--seed", arguments->seed, "Random seed: selects the exercise")
      ->check(nonNegativeNumber())
      ->capture_default_str();
  exercise->add_option("--level", arguments->level, "Number of hidden effects (1, 2, 3), their size and the noise")
      ->check(oneOf({"easy", "medium", "hard"}))
      ->capture_default_str();
  exercise
      ->add_option("--answer", arguments->answers,
                   "A hidden effect, its driver and its size (largest change at one point, such as 12µm or 30µrad); "
                   "may be repeated. Exit status 1 if not all are named")
      ->allow_extra_args(false)
      ->type_name("EFFECT:DRIVER:SIZE");
  exercise
      ->add_option("--hints", arguments->hints,
                   "Number of hints to show, or to count as used: components, drivers, "
                   "families; each costs 10 marks")
      ->check(numberBetween(0, exercise_hints))
      ->type_name("N");
  exercise->add_flag("--searched", arguments->searched, "The search was run before the answer: half the marks");
  exercise->add_flag("--search", arguments->search, "After the answer, run the search and show what it names");
}

}  // namespace spindrift::cli
