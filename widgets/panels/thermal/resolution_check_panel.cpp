// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/thermal/resolution_check_panel.h"

#include <QHBoxLayout>
#include <QTableView>
#include <QVBoxLayout>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/workflows/instrument_checks.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/session_model.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {

std::optional<ResolutionCheck> showResolutionCheck(const SessionModel& session, const std::string& task,
                                                   Callout& verdict) {
  const StoredResult* stored = session.latest(task);
  if (session.campaign() != nullptr) {
    if (const TaskStatus status = session.tasks().status(task); status.state == TaskState::Failed) {
      verdict.show(Tone::Bad, coreSentence(status.reason));
      return {};
    }
  }
  if (stored == nullptr) {
    verdict.set(Tone::Neutral, {});
    return {};
  }
  try {
    ResolutionCheck check = resolutionCheckFrom(stored->payload);
    if (const ResultState state = session.state(task); !state.current) {
      verdict.show(Tone::Outdated,
                   ResolutionCheckPanel::tr("Changed since this was checked: %1. Check again.").arg(state.changed));
    } else {
      verdict.show(check.passed ? Tone::Good : Tone::Attention, coreSentence(check.reason));
    }
    return check;
  } catch (const InputError& e) {
    verdict.show(Tone::Bad, coreSentence(e.what()));
    return {};
  }
}

ResolutionCheckPanel::ResolutionCheckPanel(SessionModel& session, const QString& instruction, const QString& button,
                                           std::string task, std::function<void()> check, QWidget* parent)
    : QWidget(parent), session_(session), task_(std::move(task)), states_([this] { refresh(); }) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  auto* line = new QHBoxLayout;
  auto* text = makeLabel(instruction, "instruction");
  text->setWordWrap(true);
  line->addWidget(text, 1);
  button_ = makeButton(button, "check");
  line->addWidget(button_);
  column->addLayout(line);
  verdict_ = new Callout;
  verdict_->set(Tone::Neutral, {});
  column->addWidget(verdict_);
  rows_ = new RowsModel({tr("Axis"), tr("Largest"), tr("Where"), tr("rms"), tr("Allowed"), tr("Verdict")}, this);
  column->addWidget(makeTable(rows_, button, tr("The verdict of each axis appears here after the check.")), 1);
  connect(button_, &QPushButton::clicked, this, [check = std::move(check)] { check(); });
}

void ResolutionCheckPanel::refresh() {
  const auto set = session_.observations();
  const auto states =
      !set ? nullptr
           : states_.ask(set, {}, [](const ObservationSet& observations) { return observations.states().size(); });
  button_->setEnabled(states != nullptr && *states > 1);
  const std::optional<ResolutionCheck> check = showResolutionCheck(session_, task_, *verdict_);
  if (!set || (states != nullptr && *states < 2))
    verdict_->set(Tone::Neutral, tr("Needs observations of at least two states; evaluate the captures first."));
  std::vector<Row> rows;
  const auto um = [](double value, int digits) {
    Cell cell{QStringLiteral("%1 µm").arg(decimalText(value, 'f', digits))};
    cell.right = true;
    return cell;
  };
  for (const AxisVerdict& v : check ? check->axes : std::vector<AxisVerdict>()) {
    Row row;
    row.id = QString::fromStdString(std::string(toString(v.component)));
    Cell name{row.id};
    name.bold = true;
    Cell largest{shownNumbers(QString::fromStdString(withUncertainty(v.largest_um, v.largest_sigma_um, "um")))};
    largest.right = true;
    row.cells = {name,
                 largest,
                 {QString::fromStdString(v.largest_at)},
                 um(v.rms_um, 2),
                 um(v.limit_um, 2),
                 {v.passed ? tr("passed") : tr("not passed"), v.passed ? Tone::Good : Tone::Attention,
                  v.passed ? "check-circle" : "alert"}};
    rows.push_back(std::move(row));
  }
  rows_->setRows(std::move(rows));
}

}  // namespace spindrift::gui
