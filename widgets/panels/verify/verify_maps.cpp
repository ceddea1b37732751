// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/verify/verify_maps.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "widgets/common/parts.h"
#include "widgets/common/table_angle.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"
#include "widgets/theme/numbers.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {

VerifyMaps::VerifyMaps(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  auto* line = new QHBoxLayout;
  line->addWidget(new QLabel(tr("State")));
  state_ = new QComboBox;
  state_->setAccessibleName(tr("Thermal state on the table"));
  state_->setMinimumWidth(160);
  line->addWidget(state_);
  line->addStretch();
  column->addLayout(line);
  for (View3D*& view : views_) {
    view = new View3D;
    view->setMachineVisible(false);
    view->setEmptyText(tr("The table will appear here"), tr("Compare before and after."));
    view->lookAtMap();
    column->addWidget(view, 1);
  }
  views_[0]->link(views_[1]);
  connect(state_, &QComboBox::activated, this, [this](int) { Q_EMIT stateChosen(); });
}

QString VerifyMaps::nameOf(const VerifyPose& pose) const {
  const bool one = std::all_of(poses_.begin(), poses_.end(),
                               [&](const VerifyPose& other) { return other.c_deg == poses_.front().c_deg; });
  return one ? fromCore(pose.state) : withTableAngle(fromCore(pose.state), pose.c_deg);
}

void VerifyMaps::setPoses(std::vector<VerifyPose> poses) {
  const QString chosen = state_->currentIndex() > 0 ? state_->currentText() : QString();
  const QSignalBlocker quiet(state_);
  poses_ = std::move(poses);
  state_->clear();
  state_->addItem(tr("The worst after compensating"));
  for (const VerifyPose& pose : poses_) state_->addItem(nameOf(pose));
  state_->setCurrentIndex(std::max(0, state_->findText(chosen)));
}

std::optional<VerifyPose> VerifyMaps::pose() const {
  if (state_->currentIndex() <= 0) return std::nullopt;
  return poses_[static_cast<std::size_t>(state_->currentIndex() - 1)];
}

void VerifyMaps::clear() {
  for (View3D* view : views_) view->clear();
}

void VerifyMaps::show(const VerifyMap& map, const MachineDescription& machine, double goal) {
  double largest = std::max(0.01, goal);
  for (const auto& side : map.points)
    for (const Field::Marker& p : side) largest = std::max(largest, std::abs(p.value));
  const QString name = fromCore(std::string(toString(map.component)));
  const QString unit = unitText(unitOf(map.component));
  for (std::size_t side = 0; side < 2; ++side) {
    View3D* view = views_[side];
    if (view->empty()) {
      view->setMachine(machine);
      view->setMachineVisible(false);
    }
    view->setColourScale(ColourScale::symmetric(largest, name, unit));
    view->setField(map.fields[side] ? std::make_shared<const Field>(*map.fields[side]) : nullptr);
    std::vector<ViewPoint> points;
    for (const Field::Marker& p : map.points[side]) {
      ViewPoint v;
      v.id = v.label = fromCore(p.point);
      v.position_mm = p.position_mm;
      v.value = p.value;
      v.value_text = shownNumbers(fromCore(withUncertainty(p.value, p.sigma, unitOf(map.component))));
      points.push_back(std::move(v));
    }
    view->setPoints(std::move(points));
    view->setCaption((side == 0 ? tr("Before: %1 in %2") : tr("After: %1 in %2")).arg(name, nameOf(map.pose)));
  }
}

}  // namespace spindrift::gui
