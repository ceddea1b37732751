// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/scanning/scan_mask_bar.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QVBoxLayout>

#include "widgets/commands/campaign_undo.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/common/quantity_box.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/panels/scanning/cloud_painter.h"

namespace spindrift::gui {

ScanMaskBar::ScanMaskBar(View3D* view, SessionModel& session, CampaignUndo& undo, QWidget* parent)
    : QWidget(parent), session_(session), undo_(undo), painter_(new CloudPainter(view)) {
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(0, 0, 0, 0);
  auto* line = new WrapLayout;
  rows->addLayout(line);
  tools_ = new Segments({tr("Look"), tr("Brush"), tr("Rectangle"), tr("Lasso")}, tr("Tool on the scan"));
  tools_->setToolTip(tr("Brush, rectangle and lasso select in the top view"));
  line->addWidget(tools_);
  radius_ = new QuantityBox(QStringLiteral("mm"), 2);
  radius_->setRange(0.1, 20.0);
  radius_->setSingleStep(0.1);
  radius_->setValue(1.0);
  radius_->setPrefix(tr("r "));
  radius_->setAccessibleName(tr("Radius of the brush"));
  line->addWidget(radius_);
  effect_ = new Segments({tr("Erase"), tr("Restore")}, tr("What painting does"));
  line->addWidget(effect_);
  reason_ = new QComboBox;
  reason_->setEditable(true);
  reason_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  reason_->setMinimumContentsLength(10);
  reason_->addItems(
      {tr("dirt or chips on the surface"), tr("reflection"), tr("something lay in the way"), tr("damaged surface")});
  reason_->setAccessibleName(tr("Reason for the mask"));
  reason_->setToolTip(tr("The report will say so"));
  clear_ = makeButton(tr("Take all back"), "restore");
  // Only while something is painted: the row above already is as wide as the list beside it can bear.
  detail_ = new QWidget;
  auto* second = new QHBoxLayout(detail_);
  second->setContentsMargins(0, 0, 0, 0);
  second->addWidget(makeLabel(tr("Reason"), "sectionTitle"));
  second->addWidget(reason_, 1);
  second->addWidget(clear_);
  rows->addWidget(detail_);

  connect(tools_, &Segments::chosen, this, [this](int index) {
    painter_->setTool(static_cast<PaintTool>(index));
    refresh();
  });
  connect(effect_, &Segments::chosen, this, [this](int index) {
    painter_->setErase(index == 0);
    if (index == 1) Q_EMIT restoring();
  });
  connect(radius_, &QDoubleSpinBox::valueChanged, painter_, &CloudPainter::setBrushRadius);
  connect(painter_, &CloudPainter::painted, this, &ScanMaskBar::add);
  connect(clear_, &QPushButton::clicked, this, [this] { push({}, tr("clear the mask")); });
  connect(&session_, &SessionModel::inputsChanged, this, &ScanMaskBar::refresh);
  refresh();
}

void ScanMaskBar::setCloud(const QString& cloud) {
  if (cloud_ == cloud) return;
  cloud_ = cloud;
  const auto [item, reason] = mask();
  if (!reason.isEmpty()) {
    reason_->setEditText(reason);
    reason_->lineEdit()->setCursorPosition(0);
  }
  refresh();
}

std::pair<QString, QString> ScanMaskBar::maskOf(const SessionModel& session, const QString& cloud) {
  if (cloud.isEmpty()) return {};
  const QString start = QString::fromStdString(maskItem(cloud.toStdString(), {}));
  const auto found = session.excluded().lower_bound(start);
  if (found == session.excluded().end() || !found->first.startsWith(start)) return {};
  return *found;
}

std::pair<QString, QString> ScanMaskBar::mask() const {
  return maskOf(session_, cloud_);
}

void ScanMaskBar::refresh() {
  for (QWidget* w : {static_cast<QWidget*>(tools_), static_cast<QWidget*>(effect_), static_cast<QWidget*>(reason_)})
    w->setEnabled(!cloud_.isEmpty());
  radius_->setEnabled(!cloud_.isEmpty() && painter_->tool() == PaintTool::Brush);
  clear_->setEnabled(!mask().first.isEmpty());
  detail_->setVisible(painter_->tool() != PaintTool::Look || clear_->isEnabled());
}

void ScanMaskBar::add(const MaskStroke& stroke) {
  if (cloud_.isEmpty()) return;
  const QString item = mask().first;
  MaskStrokes strokes;
  if (!item.isEmpty()) strokes = masksOf({item.toStdString()}).begin()->second;
  if (strokes.empty() && !stroke.erase) return;  // nothing to take back
  strokes.push_back(stroke);
  push(strokes, stroke.erase ? tr("mask part of a scan") : tr("unmask part of a scan"));
}

void ScanMaskBar::push(const MaskStrokes& strokes, const QString& text) {
  QString reason = reason_->currentText().trimmed();
  if (reason.isEmpty()) reason = reason_->itemText(0);
  const auto before = mask();
  std::pair<QString, QString> after;
  if (!strokes.empty()) after = {QString::fromStdString(maskItem(cloud_.toStdString(), strokes)), reason};
  undo_.push(new ReplaceExclusionCommand(session_, before, after, text));
}

}  // namespace spindrift::gui
