// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "app/cli/command.h"
#include "app/cli/picture_files.h"
#include "app/cli/session_source.h"
#include "core/base/atomic_file.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/reporting/heatmap_picture.h"
#include "core/workflows/evaluate_campaign.h"
#include "core/workflows/fit_campaign.h"
#include "core/workflows/instrument_checks.h"

namespace spindrift::cli {
namespace {

struct FitArguments {
  std::string campaign;
  std::string of_session;  ///< name of a campaign
  std::string observations;
  std::string model = "nine-parameter";
  std::string state;
  std::string points;
  std::string robust = "none";
  // heatmap
  std::string component = "EX";
  std::string grid;
  PictureFiles pictures;
  std::string csv;
  double limit = 0.0;
  // compare
  std::string other_points;
  // placement
  int count = 4;
  std::string criterion = "I";
  std::string lattice;
  std::string fixed;
  double margin_mm = 15.0;
  double distance_mm = -1.0;
  double sigma_xy_um = 0.5;
  double sigma_z_um = 1.0;
  // checks
  std::string point;
  double drift_limit_um_per_h = 1.0;
};

NineParameterOptions fitOptions(const FitArguments& a) {
  NineParameterOptions options;
  options.state = a.state;
  options.points = splitList(a.points);
  options.robust = a.robust == "huber" ? RobustLoss::Huber : a.robust == "tukey" ? RobustLoss::Tukey : RobustLoss::None;
  return options;
}

std::pair<int, int> pairOf(const std::string& text, const char* what) {
  const std::vector<std::string> parts = splitList(text);
  double nx = 0.0;
  double ny = 0.0;
  if (parts.size() != 2 || !parseNumber(parts[0], nx) || !parseNumber(parts[1], ny) || nx != static_cast<int>(nx) ||
      ny != static_cast<int>(ny)) {
    throw InputError(fmt::format("{} \"{}\" is not allowed; allowed: two whole numbers such as 61,41.", what, text));
  }
  return {static_cast<int>(nx), static_cast<int>(ny)};
}

void addCommonOptions(CLI::App* command, const std::shared_ptr<FitArguments>& a) {
  command->add_option("CAMPAIGN", a->campaign, "Folder of the campaign")->required();
  command
      ->add_option("--observations", a->observations,
                   "Observations to use (CSV); default: those of the campaign, or its evaluated captures")
      ->type_name("FILE");
}

void addFitOptions(CLI::App* command, const std::shared_ptr<FitArguments>& a, bool higher_order = false) {
  addCommonOptions(command, a);
  if (higher_order) {
    command
        ->add_option("--model", a->model,
                     "Error model: nine-parameter, or higher-order: with the higher-order terms in x and y that the "
                     "evidence supports")
        ->check(oneOf({"nine-parameter", "higher-order"}))
        ->capture_default_str();
  } else {
    command->add_option("--model", a->model, "Error model: nine-parameter")->check(oneOf({"nine-parameter"}));
  }
  command->add_option("--state", a->state, "Thermal state, such as M1; default: the last one");
  command->add_option("--points", a->points,
                      "Points to fit, such as F1,F2,F3; the others are used for validation. Default: all");
  command
      ->add_option("--robust", a->robust, "Loss function of the fit; huber and tukey reduce the influence of outliers")
      ->check(oneOf({"none", "huber", "tukey"}));
}

CommandResult runFit(const FitArguments& a, JobContext& job) {
  const Campaign campaign = Campaign::read(a.campaign);
  std::vector<std::string> notes;
  const ObservationSet observations = observationsOf(campaign, a.observations, {}, job, &notes);
  const NineParameterFit fit = [&] {
    try {
      return fitNineParameters(observations, fitOptions(a));
    } catch (const InputError& e) {
      // What was left out may be why.
      if (notes.empty()) throw;
      throw InputError(fmt::format("{} {}", e.what(), notes.back()));
    }
  }();
  const TableOrderChoice choice = chooseTableOrder(fit);
  return noted({toJson(fit, choice), summaryOf(fit, choice), fit.status == FitStatus::Converged ? Done : NotGoodEnough},
               notes);
}

CommandResult runHeatmap(const FitArguments& a, JobContext& job) {
  HeatmapOptions options;
  options.fit = fitOptions(a);
  options.component = *componentFromString(a.component);
  options.higher_order = a.model == "higher-order";
  if (!a.grid.empty()) std::tie(options.nx, options.ny) = pairOf(a.grid, "grid");
  options.validate();
  HeatmapPictureOptions picture;
  if (a.limit > 0.0) picture.limit = a.limit;
  const Campaign campaign = Campaign::read(a.campaign);
  std::vector<std::string> notes;
  const ObservationSet observations = observationsOf(campaign, a.observations, {}, job, &notes);
  const HeatmapResult result = heatmapOf(campaign, observations, options);
  if (!result.determined) return noted({result.json(), result.message, NotGoodEnough}, notes);
  picture.title = result.title();
  picture.subtitle = result.subtitle();
  std::string summary = fmt::format("{}: {} over {} × {} nodes\n", result.title(),
                                    printedUnit(unitOf(options.component)), options.nx, options.ny);
  if (a.pictures.wanted()) summary += a.pictures.write(heatmapPicture(result.field, picture));
  if (!a.csv.empty()) {
    writeFileAtomically(a.csv, result.field.csv());
    summary += fmt::format("written: {}\n", a.csv);
  }
  if (result.order) summary += fmt::format("higher order: {}\n", result.order->reason);
  for (const std::string& warning : result.fit.warnings) summary += fmt::format("note: {}\n", warning);
  return noted({result.json(), summary, Done}, notes);
}

CommandResult runCompare(const FitArguments& a, JobContext& job) {
  const Campaign campaign = Campaign::read(a.campaign);
  const ObservationSet observations = observationsOf(campaign, a.observations, {}, job);
  NineParameterOptions first = fitOptions(a);
  NineParameterOptions second = first;
  second.points = splitList(a.other_points);
  const NineParameterComparison comparison = compareNineParameters(observations, first, second);
  CommandResult result{toJson(comparison), summaryOf(comparison), Done};
  const bool usable = comparison.a.status == FitStatus::Converged && comparison.b.status == FitStatus::Converged;
  if (!usable) {
    result.exit_status = NotGoodEnough;
    for (const NineParameterFit* fit : {&comparison.a, &comparison.b}) {
      if (fit->status != FitStatus::Converged) result.summary += fit->message + "\n";
    }
  }
  if (usable && a.pictures.wanted()) {
    const FieldGrid grid = tableGrid(campaign.machine, 61, 41, 0.0);
    const NineParameterModel difference = comparison.differenceModel();
    Field field = tableField(comparison.a, difference, grid, *componentFromString(a.component));
    field.markers.clear();
    HeatmapPictureOptions picture;
    picture.title = fmt::format("{} of state {}: difference of two sets", a.component, comparison.a.state);
    picture.subtitle = fmt::format("from {} minus from {}", a.other_points, a.points);
    a.pictures.write(heatmapPicture(field, picture));
  }
  return result;
}

CommandResult runPlacement(const FitArguments& a, JobContext& job) {
  const Campaign campaign = Campaign::read(a.campaign);
  PlacementRequest request;
  if (!a.lattice.empty()) std::tie(request.lattice_nx, request.lattice_ny) = pairOf(a.lattice, "lattice");
  request.margin_mm = a.margin_mm;
  request.fixed = splitList(a.fixed);
  request.options.count = a.count;
  request.options.criterion = a.criterion == "D" ? PlacementCriterion::D : PlacementCriterion::I;
  if (a.distance_mm >= 0.0) request.options.least_distance_mm = a.distance_mm;
  request.options.sigma_xy_um = a.sigma_xy_um;
  request.options.sigma_z_um = a.sigma_z_um;
  const PlacementAnswer answer = placeFiducials(campaign.machine, request, job);
  return {answer.json(), answer.summary(), answer.result.status == FitStatus::Converged ? Done : NotGoodEnough};
}

CheckResult warmUpOf(const Campaign& campaign, const FitArguments& a, JobContext& job) {
  WarmUpOptions options;
  options.drift_limit_um_per_h = a.drift_limit_um_per_h;
  std::optional<ObservationSet> set;
  if (a.observations.empty()) set = warmUpMeasurement(campaign, {});
  if (!set) set = observationsOf(campaign, a.observations, {}, job);
  return checkResultOf(judgeWarmUp(*set, a.point, options, campaign.log ? &*campaign.log : nullptr));
}

template <CheckResult (*check)(const ObservationSet&, const MachineDescription&)>
CheckResult againstResolution(const Campaign& campaign, const FitArguments& a, JobContext& job) {
  return check(observationsOf(campaign, a.observations, {}, job), campaign.machine);
}

CheckResult readWarmUp(const nlohmann::json& stored) {
  return checkResultOf(warmUpFrom(stored));
}

CheckResult readResolutionCheck(const nlohmann::json& stored) {
  return checkResultOf(resolutionCheckFrom(stored));
}

/// A check of the instrument: of the folder of a campaign, and as the task of a session.
struct InstrumentCheckCommand {
  const char* name;
  const char* task;
  const char* description;
  CheckResult (*run)(const Campaign&, const FitArguments&, JobContext&);
  CheckResult (*read)(const nlohmann::json& stored);
};
constexpr std::array check_commands{
    InstrumentCheckCommand{"warm-up", "check-warm-up",
                           "Check whether the instrument is thermally stable: drift per axis (µm/h) from repeated "
                           "measurements of one point",
                           warmUpOf, readWarmUp},
    InstrumentCheckCommand{"validate-jogs", "check-jogs",
                           "Validate measured axis steps (jogs), one per state, against the axis resolution",
                           againstResolution<checkJogs>, readResolutionCheck},
    InstrumentCheckCommand{"repeatability", "check-repeatability",
                           "Cold repeatability: all states measured cold; verdict against half the axis resolution",
                           againstResolution<checkRepeatability>, readResolutionCheck},
};

/// Of a session: what it keeps, if that still holds, else worked out and kept.
CommandResult checkInSession(const FitArguments& a, JobContext& job, const InstrumentCheckCommand& check) {
  if (!a.observations.empty())
    throw InputError({a.campaign, ""},
                     "is a session, which keeps its own observations; --observations is for the folder of a campaign.");
  if (!a.point.empty() || a.drift_limit_um_per_h != WarmUpOptions().drift_limit_um_per_h)
    throw InputError(
        {a.campaign, ""},
        "is a session, which judges the warm-up as the window does; --point and --limit are for the folder "
        "of a campaign.");
  SessionSource source(a.campaign, a.of_session, job);
  const bool made = !source.tasks().run(check.task, job).empty();
  const nlohmann::json& stored = source.tasks().graph().latest(check.task)->payload;
  const CheckResult result = check.read(stored);
  return {stored, made ? result.summary : result.summary + "taken from the session: still current\n",
          result.passed ? Done : NotGoodEnough};
}

CommandResult runCheck(const FitArguments& a, JobContext& job, const InstrumentCheckCommand& check) {
  if (isSession(a.campaign)) return checkInSession(a, job, check);
  const CheckResult result = check.run(Campaign::read(a.campaign), a, job);
  return {result.json, result.summary, result.passed ? Done : NotGoodEnough};
}

}  // namespace

void addKinematicsCommands(CLI::App& app, CommandLine& line) {
  {
    auto a = std::make_shared<FitArguments>();
    CLI::App* command = addCommand(app, line, "fit", "Fit the error model of one thermal state (µm, µrad, µm/m)",
                                   [a](JobContext& job) { return runFit(*a, job); });
    addFitOptions(command, a);
  }
  {
    auto a = std::make_shared<FitArguments>();
    CLI::App* command =
        addCommand(app, line, "heatmap", "Map one component of the fitted model over the table (µm, with uncertainty)",
                   [a](JobContext& job) { return runHeatmap(*a, job); });
    addFitOptions(command, a, true);
    command->add_option("--component", a->component, "EX, EY or EZ (µm)")->check(oneOf({"EX", "EY", "EZ"}));
    command->add_option("--grid", a->grid, "Nodes along X and Y, such as 61,41")->type_name("NX,NY");
    command
        ->add_option("--limit", a->limit,
                     "Limit of the colour scale in µm, for comparing figures; default: from the data")
        ->check(positiveNumber());
    a->pictures.addTo(*command, "the picture");
    command->add_option("--csv", a->csv, "Write x_mm,y_mm,z_mm,component,value,sigma,extrapolated")->type_name("FILE");
  }
  {
    auto a = std::make_shared<FitArguments>();
    CLI::App* command =
        addCommand(app, line, "compare", "Compare the models that two sets of points give for one thermal state",
                   [a](JobContext& job) { return runCompare(*a, job); });
    addFitOptions(command, a);
    command->add_option("--with", a->other_points, "The second set of points, such as F2,F4,F5,F7")->required();
    command->add_option("--component", a->component, "Component of the picture: EX, EY or EZ (µm)")
        ->check(oneOf({"EX", "EY", "EZ"}));
    a->pictures.addTo(*command, "the map of the difference");
  }
  {
    auto a = std::make_shared<FitArguments>();
    CLI::App* command = addCommand(app, line, "placement", "Choose optimal positions of N fiducials on the table",
                                   [a](JobContext& job) { return runPlacement(*a, job); });
    command->add_option("CAMPAIGN", a->campaign, "Folder of the campaign (its machine.json is used)")->required();
    command->add_option("--count", a->count, "Number of fiducials, 3 or more");
    command
        ->add_option("--criterion", a->criterion,
                     "I: smallest mean variance over the table; D: smallest volume of "
                     "the parameters' confidence region")
        ->check(oneOf({"I", "D"}));
    command
        ->add_option("--lattice", a->lattice,
                     "Candidate positions on a lattice over the table; default: the machine's fiducials")
        ->type_name("NX,NY");
    command->add_option("--margin", a->margin_mm, "Distance of the lattice from the edge of the table in mm");
    command
        ->add_option("--distance", a->distance_mm,
                     "Minimum distance between two fiducials in mm; default: a tenth of the diagonal of the table, or "
                     "what the candidates allow")
        ->check(nonNegativeNumber());
    command->add_option("--keep", a->fixed, "Points to include in any case, such as F1,F2");
    command->add_option("--sigma-xy", a->sigma_xy_um, "Standard uncertainty of a displacement in the plane in µm");
    command->add_option("--sigma-z", a->sigma_z_um, "Standard uncertainty of a height in µm");
  }
  for (const InstrumentCheckCommand& check : check_commands) {
    auto a = std::make_shared<FitArguments>();
    CLI::App* command =
        addCommand(app, line, check.name, std::string(check.description) + "; of a session, the result is kept there",
                   [a, &check](JobContext& job) { return runCheck(*a, job, check); });
    addCommonOptions(command, a);
    command->get_option("CAMPAIGN")->description("Folder of the campaign, or of a session");
    command->add_option("--campaign", a->of_session, "Campaign of the session; default: the one opened last")
        ->type_name("NAME");
    if (check.run != warmUpOf) continue;
    command->add_option("--point", a->point,
                        "The point that was measured repeatedly; default: the one with the most rows");
    command
        ->add_option("--limit", a->drift_limit_um_per_h,
                     "Drift in µm/h below which the instrument is regarded as stable")
        ->check(positiveNumber());
  }
}

}  // namespace spindrift::cli
