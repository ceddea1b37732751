// SPDX-License-Identifier: GPL-3.0-or-later
// The map of the nine-parameter page: the model of a state, or what two sets of points disagree about.
#include <QCheckBox>
#include <QTabWidget>
#include <cmath>
#include <map>

#include "core/base/text.h"
#include "core/workflows/fit_campaign.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/pages/kinematics/nine_parameter_page.h"
#include "widgets/theme/numbers.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr int map_nodes = 120;

}  // namespace

std::optional<FieldGrid> NineParameterPage::mapGrid() {
  double z_mm = 0.0;
  const std::vector<NineParameterResidual>& residuals = result_->fit.residuals;
  for (const NineParameterResidual& r : residuals) z_mm += r.position_mm.z() / static_cast<double>(residuals.size());
  auto grid = mapTable(session().campaign()->machine, z_mm, map_nodes);
  if (!grid) {
    field_.reset();
    view_->clear();
    view_->setEmptyText(tr("No map"), tr("The machine has no X or no Y axis; describe it on the page Machine."));
  }
  return grid;
}

void NineParameterPage::setComponent(int index) {
  component_->setCurrent(index);
  showField();
}

/// Where the two sets of points disagree: other points minus checked ones, faded where that is within its uncertainty.
void NineParameterPage::showDifference(const NineParameterComparison& comparison) {
  const Component component = shown_components[static_cast<std::size_t>(component_->current())];
  const NineParameterModel model = comparison.differenceModel();
  DeviationQuery conditions;
  conditions.state = comparison.a.state;
  std::vector<Eigen::Vector2d> measured;
  std::vector<ViewPoint> points;
  for (const NineParameterResidual& r : comparison.a.residuals) {
    if (r.component != component) continue;
    measured.push_back(r.position_mm.head<2>());
    DeviationQuery here = conditions;
    here.position_mm = r.position_mm;
    const PredictedComponent difference = model.predict(here, component);
    ViewPoint point;
    point.id = point.label = QString::fromStdString(r.point);
    point.position_mm = r.position_mm;
    point.used = r.used;
    if (std::isfinite(difference.sigma)) {
      point.value = difference.value;
      point.value_text =
          shownNumbers(QString::fromStdString(withUncertainty(difference.value, difference.sigma, "um")));
    }
    points.push_back(point);
  }
  const auto grid = mapGrid();
  if (!grid) return;
  auto field = std::make_shared<Field>(evaluateField(model, *grid, component, conditions, measured));
  field_ = field;
  double largest = 0.0;
  for (std::size_t i = 0; i < field->value.size(); ++i) {
    if (std::isfinite(field->sigma[i])) largest = std::max(largest, std::abs(field->value[i]));
  }
  const QString name = QString::fromStdString(std::string(toString(component)));
  view_->setMachine(session().campaign()->machine);
  view_->setColourScale(ColourScale::symmetric(largest, name, QStringLiteral("um")));
  view_->setField(field, FieldStyle{});
  view_->setPoints(std::move(points));
  view_->setArrows({}, 1.0);
  view_->setCaption(tr("%1: other points minus checked points").arg(name));
}

void NineParameterPage::showField() {
  if (!result_ || session().campaign() == nullptr) return;
  if (tabs_->currentWidget()->isAncestorOf(comparison_verdict_) && result_->compared) {
    showDifference(*result_->compared);
    return;
  }
  const NineParameterFit& f = result_->fit;
  const TableOrderChoice& order = result_->order;
  const NineParameterModel nine = f.predictingModel();
  const bool higher = higher_->isChecked() && order.richer();
  const ErrorModel& model = higher ? static_cast<const ErrorModel&>(*order.model) : nine;
  const Component component = shown_components[static_cast<std::size_t>(component_->current())];
  std::vector<Eigen::Vector2d> measured;
  std::vector<ViewPoint> points;
  std::map<std::string, ViewArrow> arrow_of;
  double largest = 0;
  const auto table_grid = mapGrid();
  if (!table_grid) return;
  const FieldGrid& grid = *table_grid;
  const auto counts = [&](Component c) { return same_scale_->isChecked() || c == component; };
  for (const Component c : shown_components) {
    if (!counts(c)) continue;
    for (const int ix : {0, grid.nx - 1}) {
      for (const int iy : {0, grid.ny - 1}) {
        DeviationQuery corner;
        corner.position_mm = {grid.x_mm(ix), grid.y_mm(iy), grid.z_mm};
        const PredictedComponent p = model.predict(corner, c);
        if (std::isfinite(p.sigma)) largest = std::max(largest, std::abs(p.value));
      }
    }
  }
  double largest_arrow = 0;
  for (const NineParameterResidual& r : f.residuals) {
    if (counts(r.component)) largest = std::max(largest, std::abs(r.value_um));
    ViewArrow& arrow = arrow_of[r.point];
    arrow.from_mm = r.position_mm;
    if (!isRotation(r.component)) arrow.deviation_um[axisIndex(r.component)] = r.value_um;
    largest_arrow = std::max(largest_arrow, arrow.deviation_um.norm());
    if (r.used) measured.push_back(r.position_mm.head<2>());
    if (r.component != component) continue;
    ViewPoint point;
    point.id = point.label = QString::fromStdString(r.point);
    point.position_mm = r.position_mm;
    point.value = r.value_um;
    point.value_text = shownNumbers(QString::fromStdString(withUncertainty(r.value_um, r.sigma_um, "um")));
    point.used = r.used;
    points.push_back(point);
  }
  DeviationQuery conditions;
  conditions.state = f.state;
  auto field = std::make_shared<Field>(evaluateField(model, grid, component, conditions, measured));
  field_ = field;
  const QString name = QString::fromStdString(std::string(toString(component)));
  const ColourScale scale = ColourScale::symmetric(largest, name, QStringLiteral("um"));
  FieldStyle style;
  const double table = std::max(grid.x_to_mm - grid.x_from_mm, grid.y_to_mm - grid.y_from_mm);
  const double exaggeration = exaggerationFor(0.12 * table, largest_arrow);
  if (relief_->isChecked()) style.relief_exaggeration = exaggeration;
  view_->setMachine(session().campaign()->machine);
  view_->setColourScale(scale);
  view_->setField(field, style);
  view_->setPoints(std::move(points));
  std::vector<ViewArrow> arrows;
  if (arrows_->isChecked()) {
    for (auto& [id, arrow] : arrow_of) arrows.push_back(arrow);
  }
  view_->setArrows(std::move(arrows), exaggeration);
  QString caption = tr("%1 of state %2 against %3")
                        .arg(name, QString::fromStdString(f.state),
                             QString::fromStdString(f.reference_state.empty() ? "zero" : f.reference_state));
  if (higher) caption += QStringLiteral(", ") + coreSentence(orderText(order.orders));
  view_->setCaption(caption);
}

}  // namespace spindrift::gui
