// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "app/cli/command.h"
#include "app/cli/picture_files.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/workflows/campaign_series.h"
#include "core/workflows/thermal_outputs.h"
#include "core/workflows/thermal_tests.h"
#include "core/workflows/thermal_tracking.h"
#include "core/workflows/thermal_workflow.h"

namespace spindrift::cli {
namespace {

struct IdentifyArguments {
  IdentifyRequest request;
  std::string log;
  std::string outputs;
  std::string inputs = "auto";
  std::string train;
  std::string test;
  std::string order;
  std::string prediction;
  std::string model;
};

std::optional<std::array<int, 3>> parseOrder(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::vector<std::string> parts = splitList(text);
  std::array<int, 3> order{};
  bool good = parts.size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    double value = 0.0;
    good = parseNumber(parts[i], value) && value == static_cast<int>(value) && value >= 0.0 && value <= 50.0;
    order[i] = static_cast<int>(value);
  }
  if (!good || order[0] < 1 || order[1] < 1) {
    throw InputError("--order \"" + text +
                     "\" is not an order; allowed: na,nb,nk with na and nb from 1 and nk from 0, such as 2,2,1.");
  }
  return order;
}

void addIdentify(CLI::App& parent, CommandLine& line) {
  auto a = std::make_shared<IdentifyArguments>();
  CLI::App* command = addCommand(
      parent, line, "identify",
      "Identify a dynamic model of measured outputs and validate it in free run on held-out rows",
      [a](JobContext& job) {
        a->request.log = a->log;
        if (a->inputs != "auto") a->request.inputs = splitList(a->inputs);
        a->request.train = TimeRange::parse(a->train, "--train");
        a->request.test = TimeRange::parse(a->test, "--test");
        a->request.order = parseOrder(a->order);
        const std::vector<std::string> outputs = splitList(a->outputs);
        if (outputs.size() > 1) {
          const SeveralOutputs several =
              std::filesystem::is_directory(a->log)
                  ? identifySeveralOutputs(campaignSeries(std::filesystem::path(a->log), job).series, a->request,
                                           outputs, job)
                  : identifySeveralOutputs(a->request, outputs, job);
          if (!a->prediction.empty()) several.writePrediction(a->prediction);
          if (!a->model.empty()) several.model.write(a->model);
          return CommandResult{several.json(), several.summary(), several.good_enough ? Done : NotGoodEnough};
        }
        a->request.output = a->outputs;
        const IdentifyResult result =
            std::filesystem::is_directory(a->log)
                ? identifyThermalModel(campaignSeries(std::filesystem::path(a->log), job).series, a->request, job)
                : identifyThermalModel(a->request, job);
        if (!a->prediction.empty()) result.writePrediction(a->prediction);
        if (!a->model.empty()) result.model.write(a->model);
        return CommandResult{result.json(), result.summary(), result.good_enough ? Done : NotGoodEnough};
      });
  command
      ->add_option("LOG", a->log,
                   "CSV with time_s and signals in columns; or the folder of a campaign, whose cycles or observations "
                   "become outputs beside its log (bar_EX0_um, F1_EZ_um)")
      ->required();
  command
      ->add_option(
          "--output", a->outputs,
          "Column to model, such as ch1_um; several, separated by commas, share their inputs where --inputs is auto "
          "and go into one model")
      ->required()
      ->type_name("NAME");
  command
      ->add_option("--inputs", a->inputs,
                   "Columns separated by commas, or auto: of temperatures, speeds, feeds and switches (never "
                   "displacements), at most eight that carry the information of all of them")
      ->capture_default_str();
  command->add_option("--train", a->train, "FROM:TO in s, FROM included, TO not")->required();
  command->add_option("--test", a->test, "FROM:TO in s; no measured output in it is used")->required();
  command->add_option("--period", a->request.period_s, "Sampling period of the identification in s (0: automatic)")
      ->check(nonNegativeNumber());
  command->add_option("--order", a->order, "na,nb,nk: poles, numerator coefficients per input, delay in samples");
  command
      ->add_option("--method", a->request.method,
                   "response (time constants of every input, averaged priors), arx or oe; default: arx with --order, "
                   "else chosen by free runs inside the training range among straight lines, few or shared time "
                   "constants, ridge regression and response")
      ->check(oneOf({"response", "arx", "oe"}));
  command
      ->add_option("--temperature-unit", a->request.temperature_unit,
                   "Unit of all temperature columns, in place of their names")
      ->check(oneOf({"degC", "K", "degF"}));
  command->add_flag(
      "--peers", a->request.peers,
      "Compare with two simple dynamic models: first-order ARX on two inputs, ridge regression on delayed inputs");
  command->add_option("--prediction", a->prediction, "Write time_s,measured,predicted over all rows to this CSV file")
      ->type_name("FILE");
  command->add_option("--model-out", a->model, "Write the model (spindrift-thermal-model JSON) to this file")
      ->type_name("FILE");
}

void addTrack(CLI::App& parent, CommandLine& line) {
  struct Arguments {
    TrackRequest request;
    std::string log;
    std::string model;
    std::string update = "kalman";
    std::string prediction;
    std::string context;
    PictureFiles pictures;
    double from_s = -1.0;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      addCommand(parent, line, "track", "Predict with a model that is updated by periodic on-machine measurements",
                 [a](JobContext& job) {
                   a->request.log = a->log;
                   a->request.model = a->model;
                   a->request.update = a->update == "gain"  ? UpdateKind::Gain
                                       : a->update == "arx" ? UpdateKind::Arx
                                                            : UpdateKind::Kalman;
                   if (a->from_s >= 0.0) a->request.from_s = a->from_s;
                   a->request.context = splitList(a->context);
                   const TrackResult result = trackThermalModel(a->request, job);
                   if (a->pictures.wanted()) a->pictures.write(result.diagram());
                   if (!a->prediction.empty()) result.writePrediction(a->prediction);
                   const bool worse = result.with.rmse > result.without.rmse;
                   std::string summary = result.summary();
                   if (worse) summary += "not good enough: the updates made the prediction worse than the free run\n";
                   return CommandResult{result.json(), summary, worse ? NotGoodEnough : Done};
                 });
  command->add_option("LOG", a->log, "CSV with time_s, the inputs of the model and the measured output")->required();
  command->add_option("--model", a->model, "Model: spindrift-thermal-model JSON, or the JSON of thermal identify")
      ->required();
  command
      ->add_option("--update", a->update,
                   "gain: measured / simulated; arx: state set to the measurement; kalman: gain and offset")
      ->check(oneOf({"gain", "arx", "kalman"}))
      ->capture_default_str();
  command->add_option("--interval", a->request.interval_s, "Time between two on-machine measurements in s")
      ->required()
      ->check(positiveNumber());
  command->add_option("--output", a->request.output, "Output of the model; default: its first");
  command->add_option("--from", a->from_s, "Time of the first measurement in s; default: end of training")
      ->check(nonNegativeNumber());
  command
      ->add_option("--sigma", a->request.measurement_sigma,
                   "Standard uncertainty of one measurement in the output's unit")
      ->check(positiveNumber())
      ->capture_default_str();
  command->add_option("--gain-bound", a->request.gain_bound, "Upper limit of the gain of --update gain; 0: no limit")
      ->check(nonNegativeNumber());
  command->add_option("--context", a->context,
                      "Columns that the gain may depend on, such as pos_z_mm (kalman only), separated by commas");
  a->pictures.addTo(*command, "the diagrams");
  command->add_option("--prediction", a->prediction, "Write time_s,measured,simulated,predicted,sigma to this CSV file")
      ->type_name("FILE");
}

void addCompensate(CLI::App& parent, CommandLine& line) {
  struct Arguments {
    CompensateRequest request;
    std::string log;
    std::string model;
    std::string out;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      addCommand(parent, line, "compensate",
                 "Run the controller's compensator over a log and show what it would have achieved. "
                 "Compensation = minus the predicted deviation (actual minus commanded), to be added "
                 "to the command; a reduction is positive where the rms becomes smaller",
                 [a](JobContext& job) {
                   a->request.log = a->log;
                   a->request.model = a->model;
                   const CompensateResult result = compensateLog(a->request, job);
                   if (!a->out.empty()) result.write(a->out);
                   bool worse = false;
                   for (const auto& o : result.outputs) worse = worse || o.worse();
                   std::string summary = result.summary();
                   if (worse) summary += "not good enough: an output is no better compensated than left alone\n";
                   const bool usable = !worse && !result.forced;
                   return CommandResult{result.json(), summary, usable ? Done : NotGoodEnough, result.warnings};
                 });
  command
      ->add_option("LOG", a->log,
                   "CSV with time_s and the inputs of the model; measured outputs are compared if they are there")
      ->required();
  command->add_option("--model", a->model, "Model: spindrift-thermal-model JSON, or the JSON of thermal identify")
      ->required();
  command->add_option("--cycle", a->request.cycle_s, "Cycle time of the controller in s; default: distance of the rows")
      ->check(nonNegativeNumber());
  command->add_option("--limit", a->request.limits.limit, "Bound of every output, µm or µrad")
      ->check(positiveNumber())
      ->capture_default_str();
  command->add_option("--slew", a->request.limits.slew_per_s, "Bound of the change of every output per s")
      ->check(positiveNumber())
      ->capture_default_str();
  command->add_option("--stale", a->request.limits.stale_after_s, "Age in s from which an input is stale")
      ->check(nonNegativeNumber())
      ->capture_default_str();
  command
      ->add_option("--out", a->out,
                   "Write time_s and the compensation of every output (minus its predicted deviation) to this CSV file")
      ->type_name("FILE");
}

void addIso230(CLI::App& parent, CommandLine& line) {
  struct Arguments {
    Iso230Request request;
    std::string log;
    std::string observations;
    std::string columns;
    PictureFiles pictures;
    std::string range;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      addCommand(parent, line, "iso230-3", "Evaluate a thermal test according to ISO 230-3", [a](JobContext& job) {
        a->request.log = a->log;
        a->request.observations = a->observations;
        a->request.columns = splitList(a->columns);
        if (!a->range.empty()) a->request.range = TimeRange::parse(a->range, "--range");
        const Iso230Result result = evaluateIso230Test(a->request, job);
        if (result.diagram && a->pictures.wanted()) a->pictures.write(*result.diagram);
        return CommandResult{result.json(), result.summary(), Done};
      });
  command->add_option("LOG", a->log,
                      "CSV with time_s and displacements (_um) or tilts (_urad); not needed for --test axis");
  command
      ->add_option("--test", a->request.test, "etve: environment; spindle: rotating spindle; axis: moving linear axis")
      ->required()
      ->check(oneOf({"etve", "spindle", "axis"}));
  command->add_option("--columns", a->columns,
                      "Displacements and tilts, separated by commas; default: all _um and _urad columns");
  command->add_option("--ambient", a->request.ambient, "Column of the ambient temperature (etve)");
  command->add_option("--speed", a->request.speed,
                      "Column of the spindle's speed (spindle); default: spindle_rpm, or the only one");
  command->add_option("--range", a->range, "Part of the log in s, such as one of several speed steps")
      ->type_name("FROM:TO");
  command
      ->add_option("--fraction", a->request.fraction,
                   "Fraction of the final value at which the time is reported (spindle)")
      ->check(numberBetween(0.01, 0.99))
      ->capture_default_str();
  command
      ->add_option("--window", a->request.window_s,
                   "Averaging time in s for a level (etve, spindle); 0: single readings")
      ->check(nonNegativeNumber())
      ->capture_default_str();
  command->add_option("--observations", a->observations,
                      "observations.csv with readings near both ends of travel (axis)");
  command->add_option("--axis", a->request.axis, "Moving axis: X, Y or Z")->capture_default_str();
  a->pictures.addTo(*command, "the diagram");
}

}  // namespace

void addThermalCommands(CLI::App& app, CommandLine& line) {
  CLI::App* thermal =
      app.add_subcommand("thermal", "Models over time: identification, update by measurement, compensation, ISO 230-3");
  thermal->require_subcommand(1);
  addIdentify(*thermal, line);
  addTrack(*thermal, line);
  addCompensate(*thermal, line);
  addIso230(*thermal, line);
  addThermalReplayCommands(*thermal, line);
}

}  // namespace spindrift::cli
