// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/thermal/resolution_check_panel.h"

#include <QHBoxLayout>
#include <QTableView>
#include <QVBoxLayout>

#include "core/base/error.h"
#include "core/base/text.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/models/session_model.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {

ResolutionCheckPanel::ResolutionCheckPanel(SessionModel& session, const QString& instruction, const QString& button,
                                           double part, std::string kind, QWidget* parent)
    : QWidget(parent), session_(session), part_(part), kind_(std::move(kind)) {
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
  connect(button_, &QPushButton::clicked, this, &ResolutionCheckPanel::check);
}

void ResolutionCheckPanel::refresh() {
  const auto set = session_.observations();
  button_->setEnabled(set != nullptr && set->states().size() > 1);
  if (!button_->isEnabled()) {
    verdict_->set(Tone::Neutral, tr("Needs observations of at least two states; evaluate the captures first."));
    rows_->setRows({});
  } else if (session_.state(kind_).there && session_.state(kind_).current) {
    check();
  } else {
    verdict_->set(Tone::Neutral, {});
    rows_->setRows({});
  }
}

void ResolutionCheckPanel::check() {
  const auto set = session_.observations();
  if (!set || session_.campaign() == nullptr) return;
  try {
    const ResolutionCheck result = checkAgainstResolution(*set, session_.campaign()->machine, part_);
    show(result);
    const ResultState known = session_.state(kind_);
    if (!known.there || !known.current) {
      session_.storeResult(kind_, {{"part", part_}}, {{"passed", result.passed}, {"reason", result.reason}});
    }
  } catch (const InputError& e) {
    rows_->setRows({});
    verdict_->show(Tone::Bad, coreSentence(e.what()));
  }
}

void ResolutionCheckPanel::show(const ResolutionCheck& check) {
  std::vector<Row> rows;
  const auto um = [](double value, int digits) {
    Cell cell{QStringLiteral("%1 µm").arg(decimalText(value, 'f', digits))};
    cell.right = true;
    return cell;
  };
  for (const AxisVerdict& v : check.axes) {
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
  QString reason = coreSentence(check.reason);
  if (!reason.isEmpty()) reason[0] = reason[0].toUpper();
  verdict_->show(check.passed ? Tone::Good : Tone::Attention, reason);
}

}  // namespace spindrift::gui
