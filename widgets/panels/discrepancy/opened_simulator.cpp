// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/opened_simulator.h"

#include <QCoreApplication>
#include <QStringList>

#include "core/simulator/simulator_file.h"
#include "core/workflows/open_simulator.h"
#include "widgets/common/core_sentence.h"

namespace spindrift::gui {
namespace {

QString openedText(const char* text) {
  return QCoreApplication::translate("SimulationPanel", text);
}

/// The programs that a simulator.json starts, each once, as it names them.
QStringList programsOf(const SimulatorFile& file) {
  QStringList out;
  const auto run = file.root.find("run");
  if (!run) return out;
  for (const JsonNode& command : run->items()) {
    const std::vector<JsonNode> words = command.items();
    if (words.empty()) continue;
    const QString program = QString::fromStdString(words.front().string());
    if (!out.contains(program)) out << program;
  }
  return out;
}

void tellKind(const SimulatorFile& file, OpenedSimulator& out) {
  switch (file.kind) {
    case SimulatorKind::Scenario:
      out.kind = openedText("scenario of the virtual machine");
      out.runs = openedText("It is run inside Spindrift: no other program is started.");
      break;
    case SimulatorKind::Sensitivities:
      out.kind = openedText("table of sensitivities");
      out.runs = openedText("Nothing is run: the table says what each parameter changes.");
      break;
    case SimulatorKind::Command:
    case SimulatorKind::Calculix: {
      out.kind = file.kind == SimulatorKind::Calculix ? openedText("CalculiX") : openedText("a program with templates");
      const QStringList programs = programsOf(file);
      out.runs = (programs.size() > 1 ? openedText("Programs that will be run, each time in a folder of their own: %1.")
                                      : openedText("Program that will be run, each time in a folder of its own: %1."))
                     .arg(programs.join(QStringLiteral(", "))) +
                 QLatin1Char(' ') + openedText("Nothing is started before you press one of the buttons above.");
      break;
    }
  }
}

}  // namespace

OpenedSimulator OpenedSimulator::read(const std::filesystem::path& file, const Campaign& campaign,
                                      const ObservationSet& observations) {
  OpenedSimulator out;
  try {
    const SimulatorFile simulator = openSimulatorFile(file);
    out.parameters = simulator.parameters;
    tellKind(simulator, out);
    const std::unique_ptr<Simulator> opened = openSimulator(file, campaign, observations);
    out.parameters = opened->parameters();
    out.windows = opened->windows();
  } catch (const std::exception& e) {
    out.error = coreSentence(e.what());
  }
  return out;
}

}  // namespace spindrift::gui
