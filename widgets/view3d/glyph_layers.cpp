// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/glyph_layers.h"

#include <vtkCellArray.h>
#include <vtkConeSource.h>
#include <vtkDoubleArray.h>
#include <vtkLookupTable.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

constexpr double arrow_head_px = 11.0;
constexpr double node_mm = 1.3;

vtkSmartPointer<vtkAlgorithm> cone() {
  auto source = vtkSmartPointer<vtkConeSource>::New();
  source->SetResolution(20);
  source->SetRadius(0.42);
  source->SetCenter(-0.5, 0, 0);  // the tip is the place
  return source;
}

vtkSmartPointer<vtkAlgorithm> ball() {
  auto source = vtkSmartPointer<vtkSphereSource>::New();
  source->SetRadius(node_mm);
  source->SetThetaResolution(16);
  source->SetPhiResolution(12);
  return source;
}

vtkSmartPointer<vtkLookupTable> tableOf(const ColourScale& scale) {
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  const auto& colours = colourTable(scale.map);
  table->SetNumberOfTableValues(static_cast<vtkIdType>(colours.size()));
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const QColor c(colours[i]);
    table->SetTableValue(static_cast<vtkIdType>(i), c.redF(), c.greenF(), c.blueF());
  }
  table->SetTableRange(scale.low, scale.high);
  return table;
}

}  // namespace

Glyphs::Glyphs(vtkAlgorithm* shape) {
  mapper->SetInputData(data);
  mapper->SetSourceConnection(shape->GetOutputPort());
  actor->SetMapper(mapper);
  actor->PickableOff();
  actor->VisibilityOff();
}

ArrowLayer::ArrowLayer(vtkRenderer* renderer) : heads_(cone()) {
  shafts_.actor->VisibilityOff();
  shafts_.mapper->SetColorModeToDirectScalars();
  heads_.mapper->SetColorModeToDirectScalars();
  heads_.mapper->SetOrientationArray("direction");
  heads_.mapper->SetScaleArray("length");
  heads_.mapper->SetScaleModeToScaleByMagnitude();
  for (vtkActor* actor : {shafts_.actor.Get(), heads_.actor.Get()}) {
    actor->GetProperty()->LightingOff();
    renderer->AddActor(actor);
  }
}

void ArrowLayer::set(const std::vector<ViewArrow>& arrows, double exaggeration) {
  arrows_ = arrows;
  exaggeration_ = exaggeration;
  build();
}

void ArrowLayer::setColours() {
  build();
}

void ArrowLayer::build() {
  vtkNew<vtkPoints> ends, tips;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkDoubleArray> direction, length;
  direction->SetName("direction");
  direction->SetNumberOfComponents(3);
  length->SetName("length");
  vtkNew<vtkUnsignedCharArray> line_colours, head_colours;
  line_colours->SetNumberOfComponents(3);
  head_colours->SetNumberOfComponents(3);
  for (const ViewArrow& arrow : arrows_) {
    const Eigen::Vector3d d = 1e-3 * exaggeration_ * arrow.deviation_um;
    const double norm = d.norm();
    if (!(norm > 1e-9)) continue;
    const Eigen::Vector3d tip = arrow.from_mm + d;
    const double head = std::min(head_mm_, 0.5 * norm);
    const Eigen::Vector3d neck = tip - d * (0.8 * head / norm);
    const QColor c = arrow.tone == Tone::Neutral ? theme().text : theme().tone(arrow.tone);
    const std::array<unsigned char, 3> rgb{static_cast<unsigned char>(c.red()), static_cast<unsigned char>(c.green()),
                                           static_cast<unsigned char>(c.blue())};
    const std::array<vtkIdType, 2> ids{ends->InsertNextPoint(arrow.from_mm.data()), ends->InsertNextPoint(neck.data())};
    lines->InsertNextCell(2, ids.data());
    tips->InsertNextPoint(tip.data());
    direction->InsertNextTuple(d.data());
    length->InsertNextValue(head);
    line_colours->InsertNextTypedTuple(rgb.data());
    line_colours->InsertNextTypedTuple(rgb.data());
    head_colours->InsertNextTypedTuple(rgb.data());
  }
  shafts_.data->SetPoints(ends);
  shafts_.data->SetLines(lines);
  shafts_.data->GetPointData()->SetScalars(line_colours);
  heads_.data->SetPoints(tips);
  heads_.data->GetPointData()->SetScalars(head_colours);
  heads_.data->GetPointData()->AddArray(direction);
  heads_.data->GetPointData()->AddArray(length);
  const bool some = tips->GetNumberOfPoints() > 0;
  shafts_.actor->SetVisibility(some);
  heads_.actor->SetVisibility(some);
}

void ArrowLayer::place(double mm_per_pixel, double line_width) {
  shafts_.actor->GetProperty()->SetLineWidth(static_cast<float>(line_width));
  if (std::abs(arrow_head_px * mm_per_pixel - head_mm_) < 1e-3 * head_mm_) return;
  head_mm_ = arrow_head_px * mm_per_pixel;
  if (!arrows_.empty()) build();
}

void ArrowLayer::raise(const Eigen::Vector3d& by_mm) {
  for (vtkActor* actor : {shafts_.actor.Get(), heads_.actor.Get()}) actor->SetPosition(by_mm.x(), by_mm.y(), by_mm.z());
}

double ArrowLayer::lowest_mm(const Eigen::Vector3d& direction) const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const ViewArrow& arrow : arrows_) {
    const Eigen::Vector3d tip = arrow.from_mm + 1e-3 * exaggeration_ * arrow.deviation_um;
    lowest = std::min({lowest, direction.dot(arrow.from_mm), direction.dot(tip)});
  }
  return lowest;
}

void ArrowLayer::onMappers(const std::function<void(vtkMapper*)>& act) {
  act(shafts_.mapper);
  act(heads_.mapper);
}

SurfaceLayer::SurfaceLayer(vtkRenderer* renderer) : nodes_(ball()) {
  nodes_.mapper->SetScaling(false);
  mesh_.mapper->SetInputData(faces_.data);
  mesh_.mapper->ScalarVisibilityOff();
  mesh_.actor->GetProperty()->SetRepresentationToWireframe();
  faces_.mapper->InterpolateScalarsBeforeMappingOn();
  faces_.mapper->SetResolveCoincidentTopologyToPolygonOffset();
  faces_.mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(1, 1);
  faces_.actor->PickableOn();
  for (vtkActor* actor : {frame_.actor.Get(), faces_.actor.Get(), mesh_.actor.Get(), bars_.actor.Get()}) {
    actor->GetProperty()->LightingOff();
    actor->VisibilityOff();
    renderer->AddActor(actor);
  }
  renderer->AddActor(nodes_.actor);
  setColours();
}

void SurfaceLayer::setColours() {
  const Theme& t = theme();
  setColour(mesh_, mixed(t.text, t.surface, 0.35));
  setColour(bars_, t.text_secondary);
  setColour(frame_, t.grid);
}

void SurfaceLayer::setLineWidth(double pixels) {
  for (Piece* piece : {&mesh_, &frame_}) piece->actor->GetProperty()->SetLineWidth(static_cast<float>(pixels));
  bars_.actor->GetProperty()->SetLineWidth(static_cast<float>(1.5 * pixels));
}

void SurfaceLayer::onMappers(const std::function<void(vtkMapper*)>& act) {
  for (Piece* piece : {&faces_, &mesh_, &bars_}) act(piece->mapper);
  act(nodes_.mapper);
}

void SurfaceLayer::set(const std::optional<ViewSurface>& surface, const SurfaceBox& box, const ColourScale& scale) {
  for (vtkActor* actor :
       {faces_.actor.Get(), mesh_.actor.Get(), bars_.actor.Get(), frame_.actor.Get(), nodes_.actor.Get()})
    actor->SetVisibility(surface.has_value());
  if (!surface) return;
  const ViewSurface& s = *surface;
  vtkNew<vtkPoints> points, known;
  vtkNew<vtkDoubleArray> values, known_values;
  vtkNew<vtkCellArray> quads;
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> bars, frame;
  for (std::size_t row = 0; row < s.y.size(); ++row) {
    for (std::size_t column = 0; column < s.x.size(); ++column) {
      const double v = s.value[s.index(column, row)];
      const auto at = [&](double value) { return box.place_mm({s.x[column], s.y[row], value}); };
      const Eigen::Vector3d p = at(std::isfinite(v) ? v : box.low.z());
      points->InsertNextPoint(p.data());
      values->InsertNextValue(v);
      if (!std::isfinite(v)) continue;
      known->InsertNextPoint(p.data());
      known_values->InsertNextValue(v);
      const double sigma = s.sigma.size() == s.value.size() ? s.sigma[s.index(column, row)] : std::nan("");
      if (std::isfinite(sigma)) bars.emplace_back(at(v - sigma), at(v + sigma));
    }
  }
  for (std::size_t row = 0; row + 1 < s.y.size(); ++row) {
    for (std::size_t column = 0; column + 1 < s.x.size(); ++column) {
      const std::array<std::size_t, 4> corners{s.index(column, row), s.index(column + 1, row),
                                               s.index(column + 1, row + 1), s.index(column, row + 1)};
      if (!std::all_of(corners.begin(), corners.end(), [&](std::size_t i) { return std::isfinite(s.value[i]); }))
        continue;
      std::array<vtkIdType, 4> ids{};
      std::copy(corners.begin(), corners.end(), ids.begin());
      quads->InsertNextCell(4, ids.data());
    }
  }
  // The floor with the lines of its numbers, the edges of the box and the level of zero.
  const Eigen::Vector3d& size = SurfaceBox::size_mm;
  for (const double v : roundTicks(box.low.x(), box.high.x(), 5))
    frame.emplace_back(box.place_mm({v, box.low.y(), box.low.z()}), box.place_mm({v, box.high.y(), box.low.z()}));
  for (const double v : roundTicks(box.low.y(), box.high.y(), 5))
    frame.emplace_back(box.place_mm({box.low.x(), v, box.low.z()}), box.place_mm({box.high.x(), v, box.low.z()}));
  for (const double z : {0.0, scale.low < 0 && scale.high > 0 ? box.place_mm({0, 0, 0}).z() : 0.0}) {
    const std::array<Eigen::Vector3d, 4> corners{
        Eigen::Vector3d(0, 0, z), {size.x(), 0, z}, {size.x(), size.y(), z}, {0, size.y(), z}};
    for (std::size_t i = 0; i < 4; ++i) frame.emplace_back(corners[i], corners[(i + 1) % 4]);
  }
  for (const auto& corner : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(size.x(), 0, 0),
                             Eigen::Vector3d(size.x(), size.y(), 0), Eigen::Vector3d(0, size.y(), 0)})
    frame.emplace_back(corner, corner + Eigen::Vector3d(0, 0, size.z()));
  faces_.data->SetPoints(points);
  faces_.data->SetPolys(quads);
  faces_.data->GetPointData()->SetScalars(values);
  nodes_.data->SetPoints(known);
  nodes_.data->GetPointData()->SetScalars(known_values);
  const auto table = tableOf(scale);
  for (vtkMapper* mapper : {static_cast<vtkMapper*>(faces_.mapper), static_cast<vtkMapper*>(nodes_.mapper)}) {
    mapper->SetLookupTable(table);
    mapper->UseLookupTableScalarRangeOn();
  }
  makeLines(bars_, bars);
  makeLines(frame_, frame);
}

}  // namespace spindrift::gui
