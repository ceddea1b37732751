// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/capture/live_touch_panel.h"

#include <QLabel>
#include <QProgressBar>
#include <QTableView>
#include <QVBoxLayout>

#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/preferences.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/services/incoming_service.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

/// As many as one looks at; all of them are in the campaign.
constexpr std::size_t shown_touches = 300;

QString vectorText(const Eigen::Vector3d& n) {
  return QStringLiteral("%1, %2, %3")
      .arg(decimalText(n.x(), 'f', 2))
      .arg(decimalText(n.y(), 'f', 2))
      .arg(decimalText(n.z(), 'f', 2));
}

}  // namespace

LiveTouchPanel::LiveTouchPanel(SessionModel& session, QWidget* parent)
    : QWidget(parent), service_(IncomingService::of(session)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  now_ = makeLabel(tr("No touch has come in yet."), "sectionTitle");
  now_->setWordWrap(true);
  column->addWidget(now_);
  bar_ = new QProgressBar;
  bar_->setAccessibleName(tr("Progress in the cycle"));
  bar_->setTextVisible(false);
  bar_->setVisible(false);
  column->addWidget(bar_);
  rows_ = new RowsModel({tr("Touch"), tr("Verdict"), tr("Position error\n/ mm"), tr("Change\n/ µm"), tr("Spread\n/ µm"),
                         tr("Approach"), tr("Why")},
                        this);
  table_ = makeTable(rows_, tr("Touches as they come in"),
                     tr("Touches appear here while the control writes its list or prints its text."));
  column->addWidget(table_, 1);
  connect(&service_, &IncomingService::touchesChanged, this, &LiveTouchPanel::refresh);
  connect(&service_, &IncomingService::changed, this, [this] {
    if (service_.touches() == nullptr) refresh();
  });
}

QString LiveTouchPanel::progressText() const {
  return now_->text();
}

void LiveTouchPanel::refresh() {
  std::vector<Row> rows;
  const TouchFeed* feed = service_.touches();
  if (feed == nullptr || feed->live().touches().empty()) {
    rows_->setRows({});
    now_->setText(tr("No touch has come in yet."));
    bar_->setVisible(false);
    return;
  }
  const std::vector<LiveTouch>& all = feed->live().touches();
  const std::size_t from = all.size() > shown_touches ? all.size() - shown_touches : 0;
  for (std::size_t i = all.size(); i-- > from;) {  // the newest on top
    const LiveTouch& live = all[i];
    const Touch& t = live.touch;
    Row row;
    row.id = fromCore(t.id()) + QStringLiteral("#%1").arg(i);
    row.faded = live.replaced;
    QString name = QStringLiteral("%1 %2 · %3").arg(fromCore(t.cycle), fromCore(t.feature)).arg(t.touch);
    if (t.c_deg != 0.0) name += QStringLiteral(" @ %1°").arg(t.c_deg);
    row.cells = {nameCell(name),
                 live.replaced    ? Cell{tr("replaced")}
                 : live.plausible ? toneCell(tr("plausible"), Tone::Good)
                                  : toneCell(tr("touch again"), Tone::Bad),
                 numberCell(live.from_nominal_mm, lengthDecimals(3)),
                 numberCell(live.change_um, 1),
                 numberCell(live.feature_spread_um, 1),
                 Cell{vectorText(t.approach)},
                 Cell{coreSentence(live.reason)}};
    row.cells.back().tip = coreSentence(live.reason);
    rows.push_back(std::move(row));
  }
  rows_->setRows(std::move(rows));
  const LiveProgress progress = feed->live().progress();
  QString text =
      tr("Cycle %1: %2 with %3").arg(fromCore(progress.cycle), fromCore(progress.feature), fromCore(progress.stylus));
  if (progress.c_deg != 0.0) text += tr(" at %1°").arg(progress.c_deg);
  text += progress.expected > 0 ? tr(", %1 of %2 touches").arg(progress.done).arg(progress.expected)
                                : tr(", %n touches", nullptr, static_cast<int>(progress.done));
  if (!progress.next.empty()) text += tr("; next %1").arg(fromCore(progress.next));
  if (feed->waiting()) text += tr(" (a line is half written)");
  now_->setText(text);
  bar_->setVisible(progress.expected > 0);
  bar_->setRange(0, std::max(1, progress.expected));
  bar_->setValue(std::min(progress.done, progress.expected));
}

}  // namespace spindrift::gui
