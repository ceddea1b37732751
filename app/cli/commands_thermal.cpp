// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "app/cli/command.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/workflows/thermal_workflow.h"

namespace spindrift::cli {
namespace {

struct IdentifyArguments {
  IdentifyRequest request;
  std::string log;
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
  CLI::App* command =
      addCommand(parent, line, "identify",
                 "Find a dynamic model of one measured output and judge it in free run on rows it has not seen",
                 [a](JobContext& job) {
                   a->request.log = a->log;
                   if (a->inputs != "auto") a->request.inputs = splitList(a->inputs);
                   a->request.train = TimeRange::parse(a->train, "--train");
                   a->request.test = TimeRange::parse(a->test, "--test");
                   a->request.order = parseOrder(a->order);
                   const IdentifyResult result = identifyThermalModel(a->request, job);
                   if (!a->prediction.empty()) result.writePrediction(a->prediction);
                   if (!a->model.empty()) result.model.write(a->model);
                   return CommandResult{result.json(), result.summary(), result.good_enough ? Done : NotGoodEnough};
                 });
  command->add_option("LOG", a->log, "CSV with time_s and signals in columns")->required();
  command->add_option("--output", a->request.output, "Column to model, such as ch1_um")->required();
  command
      ->add_option(
          "--inputs", a->inputs,
          "Columns separated by commas, or auto: temperatures, speeds, feeds and switches, never displacements")
      ->capture_default_str();
  command->add_option("--train", a->train, "FROM:TO in s, FROM included, TO not")->required();
  command->add_option("--test", a->test, "FROM:TO in s; nothing measured in it is used")->required();
  command->add_option("--period", a->request.period_s, "Sampling period of the identification in s (0: automatic)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--order", a->order, "na,nb,nk: poles, numerator coefficients per input, delay in samples");
  command
      ->add_option("--method", a->request.method,
                   "response (lags of all inputs, averaged priors), arx or oe; default by --order")
      ->check(CLI::IsMember({"response", "arx", "oe"}));
  command
      ->add_option("--temperature-unit", a->request.temperature_unit,
                   "Unit of all temperature columns, in place of their names")
      ->check(CLI::IsMember({"degC", "K", "degF"}));
  command->add_option("--prediction", a->prediction, "Write time_s,measured,predicted over all rows to this CSV file")
      ->type_name("FILE");
  command->add_option("--model-out", a->model, "Write the model (spindrift-thermal-model JSON) to this file")
      ->type_name("FILE");
}

}  // namespace

void addThermalCommands(CLI::App& app, CommandLine& line) {
  CLI::App* thermal =
      app.add_subcommand("thermal", "Models over time: identification, update by measurement, compensation, ISO 230-3");
  thermal->require_subcommand(1);
  addIdentify(*thermal, line);
}

}  // namespace spindrift::cli
