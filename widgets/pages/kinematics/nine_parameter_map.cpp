// SPDX-License-Identifier: GPL-3.0-or-later
// The map of the nine-parameter page: the model of a state, or what two sets of points disagree about.
#include <QCheckBox>
#include <QTabWidget>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/pages/kinematics/nine_parameter_page.h"
#include "widgets/theme/numbers.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

QString nameOf(const ComponentMap& map) {
  return fromCore(std::string(toString(map.field.component)));
}

}  // namespace

void NineParameterPage::setComponent(int index) {
  component_->setCurrent(index);
  showField();
}

/// Where the two sets of points disagree: other points minus checked ones, faded where that is within its uncertainty.
void NineParameterPage::showDifference() {
  const ComponentMap& map = result_->maps->difference->at(static_cast<std::size_t>(component_->current()));
  showMap(map, map.largest_um, FieldStyle{});
  view_->setArrows({}, 1.0);
  view_->setCaption(tr("%1: other points minus checked points").arg(nameOf(map)));
}

void NineParameterPage::showMap(const ComponentMap& map, double largest_um, const FieldStyle& style) {
  field_ = {result_, &map.field};
  std::vector<ViewPoint> points;
  for (const Field::Marker& m : map.field.markers) {
    ViewPoint point;
    point.id = point.label = QString::fromStdString(m.point);
    point.position_mm = m.position_mm;
    point.used = m.used;
    if (std::isfinite(m.sigma)) {
      point.value = m.value;
      point.value_text = shownNumbers(QString::fromStdString(withUncertainty(m.value, m.sigma, "um")));
    }
    points.push_back(point);
  }
  view_->setMachine(session().campaign()->machine);
  view_->setColourScale(ColourScale::symmetric(largest_um, nameOf(map), QStringLiteral("um")));
  view_->setField(field_, style);
  view_->setPoints(std::move(points));
}

void NineParameterPage::showField() {
  if (!result_ || session().campaign() == nullptr) return;
  if (!result_->maps) {
    field_.reset();
    view_->clear();
    view_->setEmptyText(tr("No map"), result_->fit.status == FitStatus::Rejected
                                          ? coreSentence(result_->fit.message)
                                          : tr("The machine has no X or no Y axis; describe it on the page Machine."));
    return;
  }
  const NineParameterMaps& maps = *result_->maps;
  if (tabs_->currentWidget()->isAncestorOf(comparison_verdict_) && maps.difference) return showDifference();
  const bool higher = higher_->isChecked() && maps.higher;
  const DisplacementMaps& shown = higher ? *maps.higher : maps.nine;
  const ComponentMap& map = shown[static_cast<std::size_t>(component_->current())];
  double largest = map.largest_um;
  if (same_scale_->isChecked())
    for (const ComponentMap& other : shown) largest = std::max(largest, other.largest_um);
  std::map<std::string, ViewArrow> arrow_of;
  double largest_arrow = 0;
  for (const ComponentMap& one : shown) {
    for (const Field::Marker& m : one.field.markers) {
      ViewArrow& arrow = arrow_of[m.point];
      arrow.from_mm = m.position_mm;
      arrow.deviation_um[axisIndex(one.field.component)] = m.value;
      largest_arrow = std::max(largest_arrow, arrow.deviation_um.norm());
    }
  }
  const FieldGrid& grid = map.field.grid;
  FieldStyle style;
  const double table = std::max(grid.x_to_mm - grid.x_from_mm, grid.y_to_mm - grid.y_from_mm);
  const double exaggeration = exaggerationFor(0.12 * table, largest_arrow);
  if (relief_->isChecked()) style.relief_exaggeration = exaggeration;
  showMap(map, largest, style);
  std::vector<ViewArrow> arrows;
  if (arrows_->isChecked())
    for (auto& [id, arrow] : arrow_of) arrows.push_back(arrow);
  view_->setArrows(std::move(arrows), exaggeration);
  const NineParameterFit& f = result_->fit;
  QString caption = tr("%1 of state %2 against %3")
                        .arg(nameOf(map), QString::fromStdString(f.state),
                             QString::fromStdString(f.reference_state.empty() ? "zero" : f.reference_state));
  if (higher) caption += QStringLiteral(", ") + coreSentence(orderText(result_->order.orders));
  view_->setCaption(caption);
}

}  // namespace spindrift::gui
