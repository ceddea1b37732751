// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/capture/arriving_panel.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QSplitter>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/capture/live_touch_panel.h"
#include "widgets/panels/capture/machine_state_line.h"
#include "widgets/panels/capture/plan_panel.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/services/connections_service.h"
#include "widgets/services/incoming_service.h"

namespace spindrift::gui {
namespace {

constexpr QSize thumbnail_size(64, 36);
/// The newest files; what is to be taken again is told beside the list whatever its age.
constexpr int shown_items = 1000;
/// From this width on the table has room for which capture a file is; the tip of its name says it too.
constexpr int width_for_capture = 640;

/// A word with its sign. The sign is in the text: icons of this table are as large as the thumbnails.
Cell stateCell(IncomingState state) {
  switch (state) {
    case IncomingState::Waiting:
      return Cell{ArrivingPanel::tr("waiting")};
    case IncomingState::Accepted:
      return Cell{QChar(0x2713) + QStringLiteral(" ") + ArrivingPanel::tr("accepted"), Tone::Good};
    case IncomingState::Retake:
      return Cell{QChar(0x2715) + QStringLiteral(" ") + ArrivingPanel::tr("take again"), Tone::Bad};
    case IncomingState::Twice:
      return Cell{ArrivingPanel::tr("duplicate")};
    case IncomingState::Ignored:
      return Cell{ArrivingPanel::tr("left aside")};
  }
  return {};
}

}  // namespace

ArrivingPanel::ArrivingPanel(PageContext page_context, Instrument instrument, QWidget* parent)
    : QWidget(parent), context_(std::move(page_context)), service_(IncomingService::of(context_.session)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  column->setSpacing(8);
  auto* line = new QHBoxLayout;
  choose_ = makeButton(tr("Watch folder …"), nullptr, "primary");
  choose_->setToolTip(tr("Every image, list of touches and cloud that appears in the folder is checked at once"));
  template_ = makeButton(tr("Printed text …"), "note");
  template_->setToolTip(tr("Template that reads the text which the control prints (.txt, .log, .prn)"));
  stop_ = makeButton(tr("Stop"), "stop");
  folder_ = makeLabel({}, "secondaryText");
  folder_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  line->addWidget(choose_);
  line->addWidget(template_);
  line->addWidget(stop_);
  line->addWidget(folder_, 1);
  column->addLayout(line);
  state_ = new Callout;
  retake_ = new Callout;
  column->addWidget(state_);
  column->addWidget(new MachineStateLine(context_.session));
  column->addWidget(retake_);

  arrived_ = new Card(tr("Arrived"));
  rows_ = new RowsModel({tr("File"), tr("State"), tr("Capture"), tr("What was found")}, this);
  table_ = makeTable(rows_, tr("Files that arrived"), tr("Files appear here as they arrive in the watched folder."));
  table_->setIconSize(thumbnail_size);
  table_->verticalHeader()->setMinimumSectionSize(56);
  // In as many lines as they need.
  stretchColumn(table_, 3);
  arrived_->body()->addWidget(table_, 1);
  touch_card_ = new Card(tr("Touches as they come in"));
  touches_ = new LiveTouchPanel(context_.session);
  touch_card_->body()->addWidget(touches_, 1);
  auto* plan_card = new Card(tr("Plan"));
  plan_ = new PlanPanel(context_, instrument);
  plan_card->body()->addWidget(plan_, 1);
  for (QSplitter** side : {&left_, &right_}) {
    *side = new QSplitter(Qt::Vertical);
    (*side)->setChildrenCollapsible(false);
  }
  left_->addWidget(touch_card_);
  right_->addWidget(plan_card);
  column->addWidget(makeSplitter(this, left_, right_, 7, 5), 1);
  setInstrument(instrument);

  connect(choose_, &QPushButton::clicked, this, [this] {
    const QString folder =
        QFileDialog::getExistingDirectory(this, tr("Folder into which the instrument writes"), service_.folder());
    if (!folder.isEmpty()) watch(folder);
  });
  connect(template_, &QPushButton::clicked, this, &ArrivingPanel::chooseTemplate);
  connect(stop_, &QPushButton::clicked, &service_, &IncomingService::stop);
  connect(&service_, &IncomingService::changed, this, &ArrivingPanel::refresh);
  connect(&service_, &IncomingService::planProgressed, this, &ArrivingPanel::refresh);
  connect(&service_, &IncomingService::touchesChanged, this, &ArrivingPanel::refresh);
}

void ArrivingPanel::setInstrument(Instrument instrument) {
  const bool probe = instrument == Instrument::TouchProbe;
  // Touches need the room; of files there are only a few then.
  touch_card_->setVisible(probe);
  (probe ? right_ : left_)->addWidget(arrived_);
  template_->setVisible(probe);
  plan_->setInstrument(instrument);
}

void ArrivingPanel::chooseTemplate() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Template of what the control prints"), {}, tr("Template (*.json)"));
  if (file.isEmpty()) return;
  template_file_ = file;
  if (service_.running()) watch(service_.folder());
  refresh();
}

void ArrivingPanel::watch(const QString& folder) {
  const QString failure = service_.start(folder, template_file_.isEmpty() ? service_.templateFile() : template_file_);
  if (!failure.isEmpty()) {
    state_->show(Tone::Bad, failure);
    return;
  }
  refresh();
}

void ArrivingPanel::refresh() {
  if (!isVisible()) return;
  std::vector<Row> rows;
  const std::vector<IncomingItem>& items = service_.items();
  const auto accepted = std::count_if(items.begin(), items.end(),
                                      [](const IncomingItem& item) { return item.state == IncomingState::Accepted; });
  const std::size_t from = std::max<std::size_t>(items.size(), shown_items) - shown_items;
  for (std::size_t i = items.size(); i-- > from;) {  // the newest on top
    const IncomingItem& item = items[i];
    Row row;
    row.id = fromCore(item.name);
    row.cells = {nameCell(row.id), stateCell(item.state),
                 item.plan_item.empty() ? dashCell() : Cell{fromCore(item.plan_item)},
                 Cell{coreSentence(item.sentence)}};
    const QImage picture = service_.thumbnail(item.name);
    if (!picture.isNull()) {
      row.cells.front().picture =
          QPixmap::fromImage(picture.scaled(thumbnail_size, Qt::KeepAspectRatio, Qt::SmoothTransformation));
    }
    row.cells.front().tip = item.plan_item.empty() ? row.id : row.id + QStringLiteral(": ") + fromCore(item.plan_item);
    // Beside what was found, what the machine did at that moment.
    const bool capture = item.state != IncomingState::Waiting && item.kind != IncomingKind::Other;
    const QString machine = capture ? ConnectionsService::of(context_.session).machineAt(item.time_s) : QString();
    if (!machine.isEmpty())
      row.cells.back().text +=
          (item.sentence.empty() ? QString() : QStringLiteral("\n")) + tr("Machine: %1").arg(machine);
    row.cells.back().tip = row.cells.back().text;
    rows.push_back(std::move(row));
  }
  table_->setColumnHidden(2, table_->width() < width_for_capture);
  rows_->setRows(std::move(rows));
  stop_->setEnabled(service_.running());
  const QString folder = service_.folder();
  folder_->setText(folder.isEmpty() ? QString() : QFileInfo(folder).fileName());
  folder_->setToolTip(folder);
  if (!service_.problem().isEmpty()) {
    state_->show(Tone::Bad, service_.problem());
  } else if (service_.running()) {
    state_->show(Tone::Good,
                 tr("Watching the folder %1: %n files, %2 accepted. Capturing goes on when this page is left.", nullptr,
                    static_cast<int>(items.size()))
                     .arg(QFileInfo(folder).fileName())
                     .arg(accepted));
  } else if (!folder.isEmpty()) {
    state_->show(Tone::Neutral, tr("Not watching. The last folder was %1; what arrived meanwhile is found when it is "
                                   "watched again.")
                                    .arg(folder));
  } else {
    state_->show(Tone::Neutral, tr("Choose the folder into which the instrument writes. Every file is checked as it "
                                   "arrives and copied into the session."));
  }
  const QStringList again = service_.retakes();
  retake_->set(Tone::Bad, again.isEmpty()
                              ? QString()
                              : again.mid(0, 2).join(QLatin1Char(' ')) +
                                    (again.size() > 2 ? tr(" And %1 more.").arg(again.size() - 2) : QString()));
}

void ArrivingPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  table_->setColumnHidden(2, table_->width() < width_for_capture);
}

void ArrivingPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  touches_->refresh();
  refresh();
}

}  // namespace spindrift::gui
