// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "app/cli/command.h"
#include "core/base/atomic_file.h"
#include "core/base/text.h"
#include "core/workflows/compensation_workflow.h"
#include "core/workflows/evaluate_campaign.h"
#include "core/workflows/verify_compensation.h"

namespace spindrift::cli {
namespace {

struct CompensationArguments {
  std::string campaign;
  std::string observations;
  std::string model = "nine-parameter";
  std::string points;
  std::string reference;
  std::string out;
  std::string fanuc;
  bool force = false;
  CompensationRequest request;
};

CommandResult runCompensate(const CompensationArguments& a, JobContext& job) {
  CompensationRequest request = a.request;
  if (a.model == "completed") request.source = CompensationSource::CompletedModel;
  if (a.model == "higher-order") request.source = CompensationSource::HigherOrder;
  if (!a.fanuc.empty()) request.fanuc_step = a.fanuc == "positive" ? FanucStep::Positive : FanucStep::Negative;
  if (!request.added.empty() && request.source != CompensationSource::CompletedModel) {
    throw InputError(fmt::format(
        "--accept {} completes the simulation, which --model {} does not use; allowed with --model completed.",
        request.added.front(), a.model));
  }
  request.fit.points = splitList(a.points);
  if (!a.reference.empty()) {
    const std::vector<std::string> parts = splitList(a.reference);
    Eigen::Vector3d reference;
    bool read = parts.size() == 3;
    for (std::size_t i = 0; read && i < 3; ++i) read = parseNumber(parts[i], reference[static_cast<Eigen::Index>(i)]);
    if (!read) {
      throw InputError(
          fmt::format("--reference {} is not a position; allowed: X,Y,Z in mm such as 250,200,150.", a.reference));
    }
    request.reference_mm = reference;
  }
  request.validate();
  const Campaign campaign = Campaign::read(a.campaign);
  JobContext first = job.part(0.0, 0.5);
  std::vector<std::string> notes;
  const ObservationSet observations = observationsOf(campaign, a.observations, {}, first, &notes);
  JobContext second = job.part(0.5, 1.0);
  const CompensationPlan plan = planCompensation(campaign, observations, request, second);
  const bool harmless = plan.harm().empty();
  if (!a.out.empty() && !harmless && !a.force) {
    notes.push_back(fmt::format("nothing was written to {}; --force writes the files all the same.", a.out));
  } else if (!a.out.empty()) {
    for (const CompensationFile& f : plan.files) {
      writeFileAtomically(std::filesystem::path(a.out) / f.name, f.content);
    }
  }
  return noted({plan.json(), plan.summary(), harmless ? Done : NotGoodEnough}, notes);
}

struct VerifyArguments {
  std::string before;
  std::string after;
  VerifyRequest request;
  std::string criterion = "largest";
};

CommandResult runVerify(VerifyArguments a, JobContext& job) {
  a.request.criterion = a.criterion == "rms" ? VerifyCriterion::Rms : VerifyCriterion::Largest;
  a.request.validate();
  const Campaign before = Campaign::read(a.before);
  const Campaign after = Campaign::read(a.after);
  JobContext first = job.part(0.0, 0.5);
  const ObservationSet one = allObservationsOf(before, {}, {}, first);
  JobContext second = job.part(0.5, 1.0);
  const ObservationSet two = allObservationsOf(after, {}, {}, second);
  const VerifyResult result = verifyCampaigns(before, one, after, two, a.request);
  return {result.json(), result.summary(), result.verdict == VerifyVerdict::Met ? Done : NotGoodEnough};
}

void addVerify(CLI::App& app, CommandLine& line) {
  auto a = std::make_shared<VerifyArguments>();
  CLI::App* command = addCommand(
      app, line, "verify",
      "Compare measurements without and with compensation, and assess the residual error against a tolerance",
      [a](JobContext& job) { return runVerify(*a, job); });
  command->add_option("BEFORE", a->before, "Folder of the campaign measured without compensation")->required();
  command->add_option("AFTER", a->after, "Folder of the campaign measured with it; may be the same")->required();
  command->add_option("--goal", a->request.goal_um, "Goal in µm for EX, EY and EZ")
      ->check(positiveNumber())
      ->capture_default_str();
  command->add_option("--goal-urad", a->request.goal_urad, "Goal in µrad for rotations; 0: they are not judged")
      ->check(nonNegativeNumber());
  command->add_option("--criterion", a->criterion, "Quantity that the goal limits: the largest residual or the rms")
      ->check(oneOf({"largest", "rms"}))
      ->capture_default_str();
}

}  // namespace

void addCompensationCommands(CLI::App& app, CommandLine& line) {
  auto a = std::make_shared<CompensationArguments>();
  CLI::App* command =
      addCommand(app, line, "compensate",
                 "Calculate the compensation of a fitted model and write compensation tables for the control",
                 [a](JobContext& job) { return runCompensate(*a, job); });
  command->add_option("CAMPAIGN", a->campaign, "Folder of the campaign")->required();
  command->add_option("--observations", a->observations, "Observations in place of the campaign's own (CSV)")
      ->type_name("FILE");
  command
      ->add_option("--model", a->model,
                   "nine-parameter: fitted to one state; higher-order: the same with the higher-order terms in x and y "
                   "that the evidence supports; completed: the simulation with the effects of --accept")
      ->check(oneOf({"nine-parameter", "higher-order", "completed"}))
      ->capture_default_str();
  command->add_option("--state", a->request.state,
                      "Thermal state; default: the one with the largest rms of the measured deviations");
  command->add_option("--points", a->points, "Points used to fit the nine parameters, such as F1,F2,F3");
  command->add_option("--accept", a->request.added, "Effect that completes the simulation (id, repeatable)")
      ->type_name("ID");
  command->add_option("--positions", a->request.positions, "Positions along each axis, 2 to 51")->capture_default_str();
  command
      ->add_option("--reference", a->reference,
                   "Position through which the lines of the component tables pass, in mm; default: the middle of the "
                   "travels, or the measured position next to it")
      ->type_name("X,Y,Z");
  command
      ->add_option("--out", a->out,
                   "Folder for the files: corrections at points and on a grid, ISO 230-1 components, tables for "
                   "LinuxCNC, Siemens and Fanuc, compensation values for Heidenhain")
      ->type_name("DIR");
  command->add_flag("--force", a->force,
                    "Write the files even if data not used for fitting are no better with the correction");
  CLI::Option* fanuc =
      command
          ->add_option("--fanuc", a->fanuc,
                       "Direction in which a positive value of Fanuc pitch error data moves the axis, as tried on the "
                       "control; without it no such data are written")
          ->check(oneOf({"positive", "negative"}));
  command->add_option("--fanuc-unit", a->request.fanuc_unit_um, "Detection unit of the Fanuc control in µm")
      ->capture_default_str()
      ->needs(fanuc);
  addVerify(app, line);
}

}  // namespace spindrift::cli
