// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/scene.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellPicker.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
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

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "widgets/view3d/contours.h"
#include "widgets/view3d/field_texture.h"
#include "widgets/view3d/offscreen_window.h"
#include "widgets/view3d/overlay.h"
#include "widgets/view3d/scene_pieces.h"
#include "widgets/view3d/shapes.h"

namespace spindrift::gui {
namespace {

/// About 35 ms with software rendering.
constexpr std::size_t points_per_part = 200'000;

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
  ViewCloud cloud;
  std::optional<ColourScale> cloud_scale;
  std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> cloud_bounds;
  std::vector<std::unique_ptr<Piece>> parts;  // of the cloud; null until first drawn
  std::size_t drawn_parts = 0;
  vtkSmartPointer<vtkLight> sky;
  vtkNew<vtkPlane> clip;
  bool clipped = false;

  /// Everything that is drawn.
  template <class Act>
  void forEach(const Act& act) {
    for (Piece* piece : {&table, &table_edges, &grid_lines, &lower, &lower_edges, &upper, &upper_edges, &surface,
                         &contour_lines, &zero_line, &significance_lines, &border_lines, &shape_faces, &shape_lines})
      act(*piece);
    for (const auto& part : parts)
      if (part != nullptr) act(*part);
  }

  void applyClip(Piece& piece) {
    piece.mapper->RemoveAllClippingPlanes();
    if (clipped) piece.mapper->AddClippingPlane(clip);
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
    renderer->ResetCameraClippingRange();
  }

  Impl() : window(makeOffscreenWindow()) {
    window->AddRenderer(renderer);
    // Smooth edges come from averaging shifted pictures (View3D): multisampling costs four times as much in software.
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
    forEach([this](Piece& piece) {
      piece.actor->VisibilityOff();
      renderer->AddActor(piece.actor);
    });
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

  void buildShapes() {
    makeShapeFaces(shape_faces.data, shapes);
    makeShapeLines(shape_lines.data, shapes);
    shape_faces.mapper->SetColorModeToDirectScalars();
    shape_faces.actor->GetProperty()->SetAmbient(0.40);
    shape_faces.actor->GetProperty()->SetDiffuse(0.85);
    shape_faces.actor->SetVisibility(shape_faces.data->GetNumberOfPolys() > 0);
    shape_lines.mapper->SetColorModeToDirectScalars();
    shape_lines.mapper->SetScalarModeToUseCellData();
    shape_lines.actor->GetProperty()->LightingOff();
    shape_lines.actor->SetVisibility(shape_lines.data->GetNumberOfLines() > 0);
  }

  /// Points k, k + n, k + 2n ... of the cloud: every part is a thinned picture of the whole.
  void buildPart(std::size_t k) {
    if (parts[k] != nullptr) return;
    auto piece = std::make_unique<Piece>();
    const std::size_t count = cloud.xyz_mm->size() / 3;
    const std::size_t stride = parts.size();
    const std::size_t size = k < count ? (count - k - 1) / stride + 1 : 0;
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetNumberOfComponents(3);
    coordinates->SetNumberOfTuples(static_cast<vtkIdType>(size));
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetNumberOfComponents(3);
    colours->SetNumberOfTuples(static_cast<vtkIdType>(size));
    float* xyz = coordinates->GetPointer(0);
    unsigned char* rgb = colours->GetPointer(0);
    const QColor plain = theme().series[0];
    const bool coloured = cloud.scalar != nullptr && cloud_scale.has_value();
    for (std::size_t i = k, j = 0; i < count; i += stride, ++j) {
      std::memcpy(xyz + 3 * j, cloud.xyz_mm->data() + 3 * i, 3 * sizeof(float));
      const QRgb c = coloured ? cloud_scale->rgb(static_cast<double>((*cloud.scalar)[i])) : plain.rgb();
      rgb[3 * j] = static_cast<unsigned char>(qRed(c));
      rgb[3 * j + 1] = static_cast<unsigned char>(qGreen(c));
      rgb[3 * j + 2] = static_cast<unsigned char>(qBlue(c));
    }
    vtkNew<vtkPoints> points;
    points->SetData(coordinates);
    vtkNew<vtkIdTypeArray> offsets;
    offsets->InsertNextValue(0);
    offsets->InsertNextValue(static_cast<vtkIdType>(size));
    vtkNew<vtkIdTypeArray> connectivity;
    connectivity->SetNumberOfValues(static_cast<vtkIdType>(size));
    for (std::size_t i = 0; i < size; ++i) connectivity->SetValue(static_cast<vtkIdType>(i), static_cast<vtkIdType>(i));
    vtkNew<vtkCellArray> vertices;
    vertices->SetData(offsets, connectivity);
    piece->data->SetPoints(points);
    piece->data->SetVerts(vertices);
    piece->data->GetPointData()->SetScalars(colours);
    piece->mapper->SetColorModeToDirectScalars();
    piece->actor->GetProperty()->LightingOff();
    piece->actor->GetProperty()->SetPointSize(static_cast<float>(cloud.point_size));
    applyClip(*piece);
    renderer->AddActor(piece->actor);
    parts[k] = std::move(piece);
  }

  [[nodiscard]] QImage read(const QSize& pixels) const {
    vtkNew<vtkUnsignedCharArray> data;
    window->GetRGBACharPixelData(0, 0, pixels.width() - 1, pixels.height() - 1, 0, data);
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
  impl_->buildShapes();
}

void Scene::setShapes(const std::vector<ViewShape>& shapes) {
  impl_->shapes = shapes;
  impl_->buildShapes();
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
const ViewCloud& Scene::cloud() const {
  return impl_->cloud;
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
  using Segments = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;
  const auto lifted = [&](const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& flat, double value) {
    Segments lines;
    const double out = height(value) + 0.2 * lift;
    for (const auto& [a, b] : flat)
      lines.emplace_back(grid.place_mm(a.x(), a.y(), out), grid.place_mm(b.x(), b.y(), out));
    return lines;
  };
  Segments contours, zero, border;
  if (style.contours) {
    for (const double level : scale.ticks()) {
      const Segments lines = lifted(contourSegments(
                                        grid, [&](std::size_t i) { return field->value[i]; }, level),
                                    level);
      Segments& target = level == 0.0 && scale.map == ColourMap::Diverging ? zero : contours;
      target.insert(target.end(), lines.begin(), lines.end());
    }
  }
  const QColor ink(0x33, 0x3B, 0x40);
  makeLines(s.contour_lines, contours);
  setColour(s.contour_lines, mixed(ink, QColor(0xDD, 0xDD, 0xDD), 0.45));
  makeLines(s.zero_line, zero);
  setColour(s.zero_line, ink);
  if (style.significance > 0 && !field->sigma.empty() && !relief) {
    Segments edge;
    for (const double sign : {1.0, -1.0}) {
      const Segments part = lifted(
          contourSegments(
              grid, [&](std::size_t i) { return sign * field->value[i] - style.significance * field->sigma[i]; }, 0.0),
          0.0);
      edge.insert(edge.end(), part.begin(), part.end());
    }
    makeLines(s.significance_lines, edge);
    setColour(s.significance_lines, QColor(0xFF, 0xFF, 0xFF));
  }
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
  s.field_bounds = {grid.place_mm(grid.x_from_mm, grid.y_from_mm, low),
                    grid.place_mm(grid.x_to_mm, grid.y_to_mm, high)};
}

void Scene::setCloud(const ViewCloud& cloud, const std::optional<ColourScale>& scale) {
  Impl& s = *impl_;
  for (const auto& part : s.parts) {
    if (part != nullptr) s.renderer->RemoveActor(part->actor);
  }
  s.parts.clear();
  s.cloud = cloud;
  s.cloud_scale = scale;
  s.cloud_bounds.reset();
  s.drawn_parts = 0;
  if (cloud.xyz_mm == nullptr || cloud.xyz_mm->size() < 3) return;
  const std::size_t count = cloud.xyz_mm->size() / 3;
  s.parts.resize(std::max<std::size_t>(1, (count + points_per_part - 1) / points_per_part));
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector3f high = -low;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Map<const Eigen::Vector3f> p(cloud.xyz_mm->data() + 3 * i);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  s.cloud_bounds = {low.cast<double>(), high.cast<double>()};
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
  s.forEach([&s](Piece& piece) { s.applyClip(piece); });
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
  if (impl_->cloud_bounds) include(impl_->cloud_bounds->first, impl_->cloud_bounds->second);
  return box;
}

QImage Scene::draw(const Camera& camera, const QSize& pixels, double ratio) {
  Impl& s = *impl_;
  s.window->SetSize(pixels.width(), pixels.height());
  for (Piece* piece : {&s.table_edges, &s.lower_edges, &s.upper_edges, &s.grid_lines, &s.contour_lines, &s.border_lines,
                       &s.shape_lines}) {
    piece->actor->GetProperty()->SetLineWidth(static_cast<float>(ratio));
  }
  s.zero_line.actor->GetProperty()->SetLineWidth(static_cast<float>(1.6 * ratio));
  s.significance_lines.actor->GetProperty()->SetLineWidth(static_cast<float>(2 * ratio));
  if (!s.parts.empty()) {
    s.buildPart(0);
    for (std::size_t k = 0; k < s.parts.size(); ++k) {
      if (s.parts[k] == nullptr) continue;
      s.parts[k]->actor->SetVisibility(k == 0);
      s.parts[k]->actor->GetProperty()->SetPointSize(static_cast<float>(s.cloud.point_size * ratio));
    }
    s.drawn_parts = 1;
  }
  s.sky->SetFocalPoint(0, 0, 0);
  s.sky->SetPosition(camera.vertical.x() + 0.2, camera.vertical.y() - 0.1, camera.vertical.z());
  s.aim(camera);
  s.window->SetErase(1);
  s.window->Render();
  return s.read(pixels);
}

bool Scene::complete() const {
  return impl_->drawn_parts >= impl_->parts.size();
}

bool Scene::refine(QImage& picture) {
  Impl& s = *impl_;
  if (complete()) return false;
  s.buildPart(s.drawn_parts);
  // Only the new points are drawn; colours and depths of what is there already are kept.
  vtkActorCollection* actors = s.renderer->GetActors();
  std::vector<vtkActor*> hidden;
  actors->InitTraversal();
  while (vtkActor* actor = actors->GetNextActor()) {
    if (actor->GetVisibility() != 0) {
      hidden.push_back(actor);
      actor->VisibilityOff();
    }
  }
  vtkActor* part = s.parts[s.drawn_parts]->actor;
  part->VisibilityOn();
  part->GetProperty()->SetPointSize(s.parts[0]->actor->GetProperty()->GetPointSize());
  // Clearing a picture also sets what may be written; without it the masks of the last pass would stay.
  if (auto* gl = vtkOpenGLRenderWindow::SafeDownCast(s.window); gl != nullptr) {
    s.window->MakeCurrent();
    gl->GetState()->ResetGLColorMaskState();
    gl->GetState()->ResetGLDepthMaskState();
    gl->GetState()->vtkglColorMask(true, true, true, true);
    gl->GetState()->vtkglDepthMask(true);
    constexpr unsigned int gl_depth_test = 0x0B71;
    gl->GetState()->ResetEnumState(gl_depth_test);
    gl->GetState()->vtkglEnable(gl_depth_test);
  }
  s.window->SetErase(0);
  s.window->Render();
  s.window->SetErase(1);
  part->VisibilityOff();
  for (vtkActor* actor : hidden) actor->VisibilityOn();
  ++s.drawn_parts;
  picture = s.read(picture.size());
  return !complete();
}

}  // namespace spindrift::gui
