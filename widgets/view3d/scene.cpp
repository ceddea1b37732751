// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/scene.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellPicker.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <QElapsedTimer>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>

#include "widgets/view3d/cloud_layer.h"
#include "widgets/view3d/field_texture.h"
#include "widgets/view3d/glyph_layers.h"
#include "widgets/view3d/offscreen_window.h"
#include "widgets/view3d/overlay.h"
#include "widgets/view3d/scene_pieces.h"

namespace spindrift::gui {
namespace {

/// Smooth edges cost four times as much in software, which a moving view has no time for.
constexpr int samples_at_rest = 4;

/// The nodes of a field with their values as a mesh; cells without a value are left out.
vtkSmartPointer<vtkPolyData> fieldMesh(const Field& field, const std::function<double(std::size_t)>& height_mm) {
  const FieldGrid& grid = field.grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  vtkNew<vtkCellArray> quads;
  const auto known = [&](int ix, int iy) { return std::isfinite(field.value[grid.index(ix, iy)]); };
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      points->InsertNextPoint(grid.place_mm(grid.x_mm(ix), grid.y_mm(iy), height_mm(i)).data());
      values->InsertNextValue(field.value[i]);
      if (ix + 1 == grid.nx || iy + 1 == grid.ny) continue;
      if (!known(ix, iy) || !known(ix + 1, iy) || !known(ix, iy + 1) || !known(ix + 1, iy + 1)) continue;
      const vtkIdType first = static_cast<vtkIdType>(iy) * grid.nx + ix;
      const std::array<vtkIdType, 4> ids{first, first + 1, first + grid.nx + 1, first + grid.nx};
      quads->InsertNextCell(4, ids.data());
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(quads);
  mesh->GetPointData()->SetScalars(values);
  return mesh;
}

}  // namespace

struct Scene::Impl {
  vtkSmartPointer<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  std::optional<MachineBodies> bodies;
  bool all_bodies = true;
  bool tool_side = true;
  Piece table, table_edges, grid_lines;
  Piece lower, lower_edges;
  Piece upper, upper_edges;
  Piece surface, contour_lines, zero_line, significance_lines, border_lines;
  Piece shape_faces, shape_lines;
  std::vector<ViewShape> shapes;
  vtkNew<vtkTexture> texture;
  vtkNew<vtkImageData> texture_image;
  std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> field_bounds;
  Eigen::Vector3d field_normal = Eigen::Vector3d::Zero();  ///< zero: there is no field
  double over_field_mm = 0.0;                              ///< along it, of what is to be seen on the field
  double field_plane_mm = 0.0;                             ///< of the places that the field is of
  CloudLayer cloud{renderer};
  ArrowLayer arrows{renderer};
  SurfaceLayer surface_plot{renderer};
  std::optional<ViewSurface> plotted;
  vtkSmartPointer<vtkLight> sky;
  vtkNew<vtkPlane> clip;
  bool clipped = false;

  void setPlane(vtkMapper* mapper) {
    mapper->RemoveAllClippingPlanes();
    if (clipped) mapper->AddClippingPlane(clip);
  }

  /// Arrows begin on the field. Who looks at it as at a map sees them whole, also those that go down from it.
  void raiseArrows(const Camera& camera) {
    double by_mm = over_field_mm;
    if (std::abs(camera.forward().dot(field_normal)) > 0.99) {
      const double lowest = arrows.lowest_mm(field_normal);
      if (std::isfinite(lowest)) by_mm = std::max(by_mm, field_plane_mm + over_field_mm - lowest);
    }
    arrows.raise(by_mm * field_normal);
  }

  void applyClip() {
    for (Piece* piece : pieces()) setPlane(piece->mapper);
    arrows.onMappers([this](vtkMapper* mapper) { setPlane(mapper); });
    surface_plot.onMappers([this](vtkMapper* mapper) { setPlane(mapper); });
    cloud.onPieces([this](Piece& piece) { setPlane(piece.mapper); });
  }

  std::vector<Piece*> pieces() {
    return {&table,       &table_edges, &grid_lines,    &lower,     &lower_edges,        &upper,
            &upper_edges, &surface,     &contour_lines, &zero_line, &significance_lines, &border_lines,
            &shape_faces, &shape_lines};
  }

  void aim(const Camera& camera) {
    vtkCamera* view = renderer->GetActiveCamera();
    const Eigen::Vector3d eye = camera.eye_mm();
    const Eigen::Vector3d up = camera.up();
    view->SetFocalPoint(camera.focal_point_mm.x(), camera.focal_point_mm.y(), camera.focal_point_mm.z());
    view->SetPosition(eye.x(), eye.y(), eye.z());
    view->SetViewUp(up.x(), up.y(), up.z());
    view->SetParallelProjection(camera.orthographic);
    view->SetParallelScale(camera.half_height_mm);
    view->SetViewAngle(2 * half_view_angle_rad * 180 / std::numbers::pi);
    // Of the cloud all that will be drawn later counts.
    std::array<double, 6> box{};
    renderer->ComputeVisiblePropBounds(box.data());
    if (cloud.bounds()) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        const bool alone = box[2 * i] > box[2 * i + 1];
        box[2 * i] = alone ? cloud.bounds()->first[k] : std::min(box[2 * i], cloud.bounds()->first[k]);
        box[2 * i + 1] = alone ? cloud.bounds()->second[k] : std::max(box[2 * i + 1], cloud.bounds()->second[k]);
      }
    }
    renderer->ResetCameraClippingRange(box.data());
  }

  Impl() : window(makeOffscreenWindow()) {
    window->AddRenderer(renderer);
    window->SetMultiSamples(0);
    vtkNew<vtkLight> from_above;
    from_above->SetLightTypeToSceneLight();
    from_above->SetPositional(false);
    from_above->SetIntensity(0.30);
    sky = from_above;
    vtkNew<vtkLight> from_viewer;
    from_viewer->SetLightTypeToHeadlight();
    from_viewer->SetIntensity(0.72);
    renderer->AutomaticLightCreationOff();
    renderer->AddLight(from_above);
    renderer->AddLight(from_viewer);
    for (Piece* piece : pieces()) {
      piece->actor->VisibilityOff();
      renderer->AddActor(piece->actor);
    }
    for (Piece* piece : {&table, &lower, &upper, &surface, &shape_faces}) piece->actor->PickableOn();
    texture->SetInputData(texture_image);
    texture->InterpolateOn();
    texture->MipmapOff();
    texture->SetColorModeToDirectScalars();
  }

  void showBodies() {
    const bool some = bodies.has_value();
    table.actor->SetVisibility(some);
    table_edges.actor->SetVisibility(some);
    grid_lines.actor->SetVisibility(some);
    lower.actor->SetVisibility(some && all_bodies);
    lower_edges.actor->SetVisibility(some && all_bodies);
    upper.actor->SetVisibility(some && all_bodies && tool_side);
    upper_edges.actor->SetVisibility(some && all_bodies && tool_side);
  }

  void buildBodies() {
    if (!bodies) return;
    std::vector<const Body*> table_bodies, low, high;
    for (const Body& body : bodies->bodies) {
      switch (body.kind) {
        case BodyKind::Table:
          table_bodies.push_back(&body);
          break;
        case BodyKind::Bed:
        case BodyKind::WorkpieceSide:
          low.push_back(&body);
          break;
        default:
          high.push_back(&body);
      }
    }
    makeBodies(table, table_edges, table_bodies);
    makeBodies(lower, lower_edges, low);
    makeBodies(upper, upper_edges, high);
    // Grid on the table, at round values.
    const double spacing = gridSpacing_mm(*bodies);
    const Eigen::Vector3d& a = bodies->table_low_mm;
    const Eigen::Vector3d& b = bodies->table_high_mm;
    int up = 2;
    for (int i = 0; i < 3; ++i) {
      if (std::abs(bodies->vertical[i]) > 0.5) up = i;
    }
    std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> lines;
    for (int i = 0; i < 3; ++i) {
      if (i == up) continue;
      for (double v = std::ceil(a[i] / spacing) * spacing; v <= b[i] + 1e-9; v += spacing) {
        Eigen::Vector3d from = a;
        Eigen::Vector3d to = b;
        from[i] = to[i] = v;
        to[up] = from[up];
        lines.emplace_back(from, to);
      }
    }
    makeLines(grid_lines, lines);
    setColour(grid_lines, theme().grid);
    showBodies();
  }

  /// Draws what is visible over the last picture.
  void addToPicture() {
    // Clearing a picture also sets what may be written; without it the masks of the last pass would stay.
    if (auto* gl = vtkOpenGLRenderWindow::SafeDownCast(window); gl != nullptr) {
      window->MakeCurrent();
      gl->GetState()->ResetGLColorMaskState();
      gl->GetState()->ResetGLDepthMaskState();
      gl->GetState()->vtkglColorMask(true, true, true, true);
      gl->GetState()->vtkglDepthMask(true);
      constexpr unsigned int gl_depth_test = 0x0B71;
      gl->GetState()->ResetEnumState(gl_depth_test);
      gl->GetState()->vtkglEnable(gl_depth_test);
    }
    window->SetErase(0);
    window->Render();
    window->SetErase(1);
  }

  [[nodiscard]] QImage read(const QSize& pixels) const {
    vtkNew<vtkUnsignedCharArray> data;
    // What was rendered lies averaged over its samples in the front buffer; the back buffer would be averaged once
    // more.
    constexpr int front = 1;
    window->GetRGBACharPixelData(0, 0, pixels.width() - 1, pixels.height() - 1, front, data);
    const QImage raw(data->GetPointer(0), pixels.width(), pixels.height(), 4 * pixels.width(), QImage::Format_RGBX8888);
    return raw.mirrored(false, true).convertToFormat(QImage::Format_RGB32);
  }
};

Scene::Scene() : impl_(std::make_unique<Impl>()) {
  setColours();
}
Scene::~Scene() = default;

void Scene::setColours() {
  const Theme& t = theme();
  impl_->renderer->GradientBackgroundOn();
  impl_->renderer->SetBackground(t.view_bottom.redF(), t.view_bottom.greenF(), t.view_bottom.blueF());
  impl_->renderer->SetBackground2(t.view_top.redF(), t.view_top.greenF(), t.view_top.blueF());
  impl_->buildBodies();
  makeShapes(impl_->shape_faces, impl_->shape_lines, impl_->shapes);
  impl_->arrows.setColours();
  impl_->surface_plot.setColours();
}

void Scene::setArrows(const std::vector<ViewArrow>& arrows, double exaggeration) {
  impl_->arrows.set(arrows, exaggeration);
}

void Scene::setSurface(const std::optional<ViewSurface>& surface, const SurfaceBox& box, const ColourScale& scale) {
  impl_->plotted = surface;
  impl_->surface_plot.set(surface, box, scale);
}

void Scene::setShapes(const std::vector<ViewShape>& shapes) {
  impl_->shapes = shapes;
  makeShapes(impl_->shape_faces, impl_->shape_lines, impl_->shapes);
}

void Scene::setBodies(const MachineBodies& bodies) {
  if (bodies.bodies.empty()) {
    impl_->bodies.reset();
    impl_->showBodies();
    return;
  }
  impl_->bodies = bodies;
  impl_->buildBodies();
}

void Scene::setBodiesVisible(bool all, bool tool_side) {
  impl_->all_bodies = all;
  impl_->tool_side = tool_side;
  impl_->showBodies();
}

const std::optional<MachineBodies>& Scene::bodies() const {
  return impl_->bodies;
}
bool Scene::bodiesShown() const {
  return impl_->all_bodies;
}
bool Scene::toolSideShown() const {
  return impl_->tool_side;
}

void Scene::setField(const Field* field, const FieldStyle& style, const ColourScale& scale) {
  Impl& s = *impl_;
  for (Piece* piece : {&s.surface, &s.contour_lines, &s.zero_line, &s.significance_lines, &s.border_lines}) {
    piece->actor->VisibilityOff();
  }
  s.field_bounds.reset();
  s.field_normal.setZero();
  if (field == nullptr || field->value.empty()) return;
  const FieldGrid& grid = field->grid;
  const bool relief = style.relief_exaggeration > 0;
  const double lift = 1e-3 * std::max(grid.x_to_mm - grid.x_from_mm, grid.y_to_mm - grid.y_from_mm);
  // Distance from the plane of the grid. A relief stands on the table: below it, it would not be seen.
  double lowest = 0.0;
  for (const double v : field->value) {
    if (relief && std::isfinite(v)) lowest = std::min(lowest, v);
  }
  const auto height = [&](double value) {
    return lift + (relief && std::isfinite(value) ? (value - lowest) * style.relief_exaggeration * 1e-3 : 0.0);
  };

  // Surface: a quad, or a mesh where it is lifted, with a texture.
  const QImage image = fieldTexture(*field, style, scale);
  s.texture_image->SetDimensions(image.width(), image.height(), 1);
  s.texture_image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (int row = 0; row < image.height(); ++row) {
    std::memcpy(s.texture_image->GetScalarPointer(0, image.height() - 1 - row, 0), image.constScanLine(row),
                static_cast<std::size_t>(image.width()) * 4);
  }
  s.texture_image->Modified();
  const int nx = relief ? grid.nx : 2;
  const int ny = relief ? grid.ny : 2;
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  vtkNew<vtkCellArray> quads;
  for (int iy = 0; iy < ny; ++iy) {
    for (int ix = 0; ix < nx; ++ix) {
      const float u = static_cast<float>(ix) / static_cast<float>(nx - 1);
      const float v = static_cast<float>(iy) / static_cast<float>(ny - 1);
      const Eigen::Vector3d place = grid.place_mm(grid.x_from_mm + u * (grid.x_to_mm - grid.x_from_mm),
                                                  grid.y_from_mm + v * (grid.y_to_mm - grid.y_from_mm),
                                                  relief ? height(field->value[grid.index(ix, iy)]) : height(0));
      points->InsertNextPoint(place.x(), place.y(), place.z());
      coordinates->InsertNextTuple2(u, v);
      if (ix + 1 < nx && iy + 1 < ny) {
        const vtkIdType i = static_cast<vtkIdType>(iy) * nx + ix;
        const std::array<vtkIdType, 4> ids{i, i + 1, i + nx + 1, i + nx};
        quads->InsertNextCell(4, ids.data());
      }
    }
  }
  s.surface.data->SetPoints(points);
  s.surface.data->SetPolys(quads);
  s.surface.data->GetPointData()->SetTCoords(coordinates);
  s.surface.data->Modified();
  s.surface.actor->SetTexture(s.texture);
  s.surface.actor->GetProperty()->LightingOff();
  s.surface.actor->GetProperty()->SetColor(1, 1, 1);
  s.surface.mapper->SetResolveCoincidentTopologyToPolygonOffset();
  s.surface.mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(1, 1);
  s.surface.actor->VisibilityOn();

  // Lines of equal value at the ticks of the colour bar; zero a little stronger; where significance ends.
  std::vector<double> levels, zero;
  for (const double level : style.contours ? scale.ticks() : std::vector<double>())
    (level == 0.0 && scale.map == ColourMap::Diverging ? zero : levels).push_back(level);
  const auto mesh = fieldMesh(*field, [&](std::size_t i) { return height(field->value[i]) + 0.2 * lift; });
  const QColor ink(0x33, 0x3B, 0x40);
  makeContours(s.contour_lines, mesh, levels);
  setColour(s.contour_lines, mixed(ink, QColor(0xDD, 0xDD, 0xDD), 0.45));
  makeContours(s.zero_line, mesh, zero);
  setColour(s.zero_line, ink);
  if (style.significance > 0 && !field->sigma.empty() && !relief) {
    vtkNew<vtkDoubleArray> beyond;  // how far the value lies beyond what counts as zero
    for (std::size_t i = 0; i < field->value.size(); ++i)
      beyond->InsertNextValue(std::abs(field->value[i]) - style.significance * field->sigma[i]);
    mesh->GetPointData()->SetScalars(beyond);
    makeContours(s.significance_lines, mesh, {0.0});
    setColour(s.significance_lines, QColor(0xFF, 0xFF, 0xFF));
  }
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> border;
  const auto at = [&](int ix, int iy) {
    const double value = field->value[grid.index(ix, iy)];
    return grid.place_mm(grid.x_mm(ix), grid.y_mm(iy), height(relief ? value : 0.0));
  };
  for (int ix = 0; ix + 1 < grid.nx; ++ix) {
    border.emplace_back(at(ix, 0), at(ix + 1, 0));
    border.emplace_back(at(ix, grid.ny - 1), at(ix + 1, grid.ny - 1));
  }
  for (int iy = 0; iy + 1 < grid.ny; ++iy) {
    border.emplace_back(at(0, iy), at(0, iy + 1));
    border.emplace_back(at(grid.nx - 1, iy), at(grid.nx - 1, iy + 1));
  }
  makeLines(s.border_lines, border);
  setColour(s.border_lines, theme().body_edge);
  double low = height(0);
  double high = low;
  if (relief) {
    for (const double v : field->value) {
      low = std::min(low, height(v));
      high = std::max(high, height(v));
    }
  }
  s.field_normal = Eigen::Vector3d::Unit(grid.normal_axis);
  s.over_field_mm = high + lift;
  s.field_plane_mm = grid.z_mm;
  s.field_bounds = {grid.place_mm(grid.x_from_mm, grid.y_from_mm, low),
                    grid.place_mm(grid.x_to_mm, grid.y_to_mm, high)};
}

void Scene::setCloud(const ViewCloud& cloud, const std::optional<ColourScale>& scale) {
  impl_->cloud.set(cloud, scale);
}

void Scene::setClip(const std::optional<ClipPlane>& plane) {
  Impl& s = *impl_;
  s.clipped = plane.has_value();
  if (plane) {
    const Eigen::Vector3d normal = (plane->keep_low ? -1.0 : 1.0) * Eigen::Vector3d::Unit(plane->axis);
    const Eigen::Vector3d origin = plane->offset_mm * Eigen::Vector3d::Unit(plane->axis);
    s.clip->SetNormal(normal.x(), normal.y(), normal.z());
    s.clip->SetOrigin(origin.x(), origin.y(), origin.z());
  }
  s.applyClip();
}

std::optional<Eigen::Vector3d> Scene::surfaceAt(const Camera& camera, const QPointF& pixel, const QSizeF& size) const {
  Impl& s = *impl_;
  s.aim(camera);
  const int* pixels = s.window->GetSize();
  vtkNew<vtkCellPicker> picker;
  picker->SetTolerance(1e-6);
  if (picker->Pick(pixel.x() / size.width() * pixels[0], (1.0 - pixel.y() / size.height()) * pixels[1], 0.0,
                   s.renderer) == 0)
    return std::nullopt;
  Eigen::Vector3d at;
  picker->GetPickPosition(at.data());
  return at;
}

std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> Scene::bounds() const {
  std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> box;
  const auto include = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    if (!box) {
      box = {low, high};
      return;
    }
    box->first = box->first.cwiseMin(low);
    box->second = box->second.cwiseMax(high);
  };
  if (impl_->bodies) {
    for (const Body& body : impl_->bodies->bodies) {
      const bool upper =
          body.kind == BodyKind::Column || body.kind == BodyKind::ToolSide || body.kind == BodyKind::Spindle;
      if (body.kind == BodyKind::Table || (impl_->all_bodies && (!upper || impl_->tool_side))) {
        include(body.low_mm, body.high_mm);
      }
    }
  }
  for (const ViewShape& shape : impl_->shapes) {
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(shape.kind == ShapeKind::Path ? 0.0 : shape.radius_mm);
    for (const Eigen::Vector3d& p : shape.points_mm) include(p - reach, p + reach);
  }
  if (impl_->field_bounds) include(impl_->field_bounds->first, impl_->field_bounds->second);
  if (impl_->cloud.bounds()) include(impl_->cloud.bounds()->first, impl_->cloud.bounds()->second);
  if (impl_->plotted) include(Eigen::Vector3d::Zero(), SurfaceBox::size_mm);
  return box;
}

QImage Scene::draw(const Camera& camera, const QSize& pixels, double ratio, bool smooth) {
  Impl& s = *impl_;
  QElapsedTimer timer;
  timer.start();
  s.window->SetSize(pixels.width(), pixels.height());
  for (Piece* piece : s.pieces()) piece->actor->GetProperty()->SetLineWidth(static_cast<float>(ratio));
  s.zero_line.actor->GetProperty()->SetLineWidth(static_cast<float>(1.6 * ratio));
  s.significance_lines.actor->GetProperty()->SetLineWidth(static_cast<float>(2 * ratio));
  s.surface_plot.setLineWidth(ratio);
  s.raiseArrows(camera);
  s.arrows.place(2 * camera.half_height_mm * ratio / pixels.height(), 2 * ratio);
  s.cloud.showSome(camera, QSizeF(pixels) / ratio, ratio);
  s.window->SetMultiSamples(smooth ? samples_at_rest : 0);
  s.sky->SetFocalPoint(0, 0, 0);
  s.sky->SetPosition(camera.vertical.x() + 0.2, camera.vertical.y() - 0.1, camera.vertical.z());
  s.aim(camera);
  s.window->SetErase(1);
  s.window->Render();
  QImage picture = s.read(pixels);
  s.cloud.tookTime(1e-6 * static_cast<double>(timer.nsecsElapsed()));
  return picture;
}

bool Scene::complete() const {
  return impl_->cloud.complete();
}

bool Scene::sorting() const {
  return !impl_->cloud.complete() && impl_->cloud.tree() == nullptr;
}

std::optional<std::size_t> Scene::cloudPointAt(const Camera& camera, const QSizeF& size, const QPointF& pixel,
                                               const std::function<bool(const Eigen::Vector3d&)>& shown) const {
  const CloudOctree* tree = impl_->cloud.tree();
  constexpr double radius_px = 6;
  return tree == nullptr ? std::nullopt : tree->pointAt(camera, size, pixel, radius_px, shown);
}

bool Scene::refine(QImage& picture, bool wait) {
  Impl& s = *impl_;
  if (complete()) return false;
  // Only the new points are drawn; colours and depths of what is there already are kept.
  s.cloud.hide();
  vtkActorCollection* actors = s.renderer->GetActors();
  std::vector<vtkActor*> hidden;
  actors->InitTraversal();
  while (vtkActor* actor = actors->GetNextActor()) {
    if (actor->GetVisibility() != 0) {
      hidden.push_back(actor);
      actor->VisibilityOff();
    }
  }
  const bool more = s.cloud.showNext(wait);
  if (more) s.addToPicture();
  s.cloud.hide();
  for (vtkActor* actor : hidden) actor->VisibilityOn();
  if (more) picture = s.read(picture.size());
  return !complete();
}

}  // namespace spindrift::gui
