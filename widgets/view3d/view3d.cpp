// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/view3d.h"

#include <QFontMetrics>
#include <QPainter>
#include <QTextDocument>
#include <QThread>
#include <QTimer>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "widgets/theme/fonts.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/overlay.h"
#include "widgets/view3d/point_labels.h"
#include "widgets/view3d/scene.h"
#include "widgets/view3d/view_tools.h"

namespace spindrift::gui {
namespace {

constexpr int rest_before_refining_ms = 120;
}  // namespace

View3D::View3D(QWidget* parent) : QWidget(parent), tools_(new ViewTools(this)) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAttribute(Qt::WA_AcceptTouchEvents);
  setAccessibleName(tr("3D view"));
  setAccessibleDescription(
      tr("Arrow keys turn, plus and minus zoom, R fits, 1 to 4 are standard views, P switches "
         "perspective, M measures a distance, C clips."));
  refine_timer_.setSingleShot(true);
  connect(&refine_timer_, &QTimer::timeout, this, &View3D::refineStep);
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, [this] {
    if (scene_ != nullptr) {
      scene_->setColours();
      if (field_ != nullptr && scale_) scene_->setField(field_.get(), field_style_, *scale_);
    }
    changed();
  });
  connect(&UnitsNotifier::instance(), &UnitsNotifier::changed, this, [this] {
    if (scene_ != nullptr && field_ != nullptr && scale_)
      scene_->setField(field_.get(), field_style_, *scale_);  // contours
    changed();
  });
  camera_.look(StandardView::Isometric);
}

View3D::~View3D() = default;

void View3D::ensureScene() {
  if (scene_ != nullptr || !failure_.isEmpty()) return;
  try {
    scene_ = std::make_unique<Scene>();
  } catch (const std::exception& e) {
    failure_ = QString::fromUtf8(e.what());
    return;
  }
  scene_->setBodies(bodies_.value_or(MachineBodies{}));
  scene_->setBodiesVisible(machine_visible_, tool_side_visible_);
  if (field_ != nullptr && scale_) scene_->setField(field_.get(), field_style_, *scale_);
  if (cloud_.xyz_mm != nullptr) scene_->setCloud(cloud_, scale_);
  scene_->setShapes(shapes_);
  scene_->setArrows(arrows_, exaggeration_);
  placeSurface();
  scene_->setClip(clip_);
}

void View3D::clear() {
  bodies_.reset();
  points_.clear();
  arrows_.clear();
  shapes_.clear();
  field_.reset();
  cloud_ = {};
  scale_.reset();
  caption_.clear();
  selected_.clear();
  measured_.clear();
  surface_.reset();
  clip_.reset();
  fitted_ = false;
  if (scene_ != nullptr) {
    scene_->setClip(clip_);
    scene_->setBodies({});
    scene_->setField(nullptr, {}, {});
    scene_->setCloud({}, std::nullopt);
    scene_->setShapes({});
    scene_->setArrows({}, 0.0);
  }
  placeSurface();
  changed();
}

void View3D::setMachine(const MachineDescription& machine) {
  machine_ = machine;
  bodies_ = machineBodies(machine);
  if (camera_.vertical != bodies_->vertical) {
    camera_.vertical = bodies_->vertical;
    if (!at_map_) camera_.look(StandardView::Isometric);
  }
  if (scene_ != nullptr) scene_->setBodies(*bodies_);
  fitted_ = false;
  changed();
}

void View3D::setMachineVisible(bool visible) {
  if (machine_visible_ == visible) return;
  machine_visible_ = visible;
  if (scene_ != nullptr) scene_->setBodiesVisible(machine_visible_, tool_side_visible_);
  fitted_ = false;
  changed();
}

void View3D::setToolSideVisible(bool visible) {
  if (tool_side_visible_ == visible) return;
  tool_side_visible_ = visible;
  if (scene_ != nullptr) scene_->setBodiesVisible(machine_visible_, tool_side_visible_);
  fitted_ = false;
  changed();
}

void View3D::setPoints(std::vector<ViewPoint> points) {
  points_ = std::move(points);
  placeTable();
  extentChanged();
  tools_->refresh();
  update();
}

void View3D::placeTable() {
  if (!bodies_) return;
  double lowest_mm = std::numeric_limits<double>::infinity();
  for (const ViewPoint& point : points_) lowest_mm = std::min(lowest_mm, bodies_->vertical.dot(point.position_mm));
  MachineBodies placed = machineBodies(machine_, lowest_mm);
  if ((placed.table_low_mm - bodies_->table_low_mm).norm() < 1e-6) return;
  bodies_ = std::move(placed);
  if (scene_ != nullptr) scene_->setBodies(*bodies_);
  changed();
}

void View3D::setArrows(std::vector<ViewArrow> arrows, double exaggeration) {
  arrows_ = std::move(arrows);
  exaggeration_ = exaggeration;
  if (scene_ != nullptr) scene_->setArrows(arrows_, exaggeration_);
  changed();
}

void View3D::setShapes(std::vector<ViewShape> shapes) {
  shapes_ = std::move(shapes);
  if (scene_ != nullptr) scene_->setShapes(shapes_);
  extentChanged();
  changed();
}

void View3D::setField(std::shared_ptr<const Field> field, const FieldStyle& style) {
  field_ = std::move(field);
  field_style_ = style;
  if (scene_ != nullptr) {
    scene_->setField(scale_ ? field_.get() : nullptr, field_style_, scale_.value_or(ColourScale{}));
  }
  const bool moved = fitted_ && !(camera_ == automatic_);
  Camera facing = camera_;
  facing.look(mapView());
  if (field_ != nullptr && at_map_ && !moved && !(facing == camera_)) lookAtMap();
  changed();
}

void View3D::setCloud(const ViewCloud& cloud) {
  cloud_ = cloud;
  if (scene_ != nullptr) scene_->setCloud(cloud_, scale_);
  fitted_ = false;
  changed();
}

void View3D::setColourScale(const std::optional<ColourScale>& scale) {
  if (scale_ == scale) return;
  scale_ = scale;
  if (scene_ != nullptr) {
    if (field_ != nullptr)
      scene_->setField(scale_ ? field_.get() : nullptr, field_style_, scale_.value_or(ColourScale{}));
    if (cloud_.xyz_mm != nullptr) scene_->setCloud(cloud_, scale_);
  }
  placeSurface();
  changed();
}

void View3D::setSurface(std::optional<ViewSurface> surface) {
  surface_ = std::move(surface);
  placeSurface();
  extentChanged();
  changed();
}

void View3D::placeSurface() {
  surface_box_.reset();
  if (surface_ && scale_) {
    // A single row or column gets some room.
    const auto limits = [](const std::vector<double>& v) {
      const double room = v.back() > v.front() ? 0.0 : std::max(1e-9, 0.5 * std::abs(v.front()) + 0.5);
      return std::pair{v.front() - room, v.back() + room};
    };
    const auto x = limits(surface_->x);
    const auto y = limits(surface_->y);
    surface_box_ = SurfaceBox{{x.first, y.first, scale_->low}, {x.second, y.second, scale_->high}};
  }
  if (scene_ == nullptr) return;
  scene_->setSurface(surface_box_ ? surface_ : std::nullopt, surface_box_.value_or(SurfaceBox{}),
                     scale_.value_or(ColourScale{}));
}

void View3D::setCaption(const QString& text) {
  caption_ = text;
  update();
}

void View3D::setEmptyText(const QString& title, const QString& how) {
  empty_title_ = title;
  empty_how_ = how;
  update();
}

void View3D::setSelected(const QString& point_id) {
  selected_ = point_id;
  update();
}

bool View3D::empty() const {
  return !bodies_ && field_ == nullptr && (cloud_.xyz_mm == nullptr || cloud_.xyz_mm->empty()) && points_.empty() &&
         shapes_.empty() && !surface_;
}

void View3D::setCamera(const Camera& camera) {
  camera_ = camera;
  fitted_ = true;
  changed();
}

void View3D::lookAtMap() {
  resetCamera(mapView());
  at_map_ = true;
}

StandardView View3D::mapView() const {
  if (field_ == nullptr) return StandardView::Top;
  const int normal = field_->grid.normal_axis;
  if (std::abs(camera_.vertical[normal]) > 0.5) return StandardView::Top;
  return normal == 0 ? StandardView::Right : StandardView::Front;
}

void View3D::resetCamera(StandardView view) {
  at_map_ = false;
  camera_.look(view);
  fitted_ = false;
  cameraMoved();
}

void View3D::setOrthographic(bool on) {
  camera_.orthographic = on;
  cameraMoved();
}

void View3D::link(View3D* other) {
  if (other == nullptr || other == this) return;
  linked_.push_back(other);
  other->linked_.push_back(this);
}

void View3D::changed() {
  dirty_ = true;
  refine_timer_.stop();
  tools_->refresh();
  update();
}

void View3D::extentChanged() {
  if (fitted_ && camera_ == automatic_) fitted_ = false;
}

void View3D::cameraMoved() {
  changed();
  Q_EMIT cameraChanged();
  shareCamera();
}

void View3D::shareCamera() {
  if (following_) return;
  for (const QPointer<View3D>& other : linked_) {
    if (other == nullptr) continue;
    other->following_ = true;
    other->setCamera(camera_);
    other->fitted_ = fitted_;
    other->following_ = false;
  }
}

void View3D::ensureFrame(const QSize& size, double ratio) {
  ensureScene();
  if (scene_ == nullptr) return;
  const QSize pixels(std::max(1, static_cast<int>(std::lround(size.width() * ratio))),
                     std::max(1, static_cast<int>(std::lround(size.height() * ratio))));
  // Notes that came after the fit would cover what it shows.
  if (camera_ == automatic_ && placeOfNotes(size, arrangement_).height() > fitted_beside_.height()) fitted_ = false;
  if (!fitted_) {
    const Camera before = camera_;
    fitCamera(size);
    if (!(camera_ == before)) dirty_ = true;
  }
  if (!dirty_ && frame_pixels_ == pixels) return;
  frame_ = scene_->draw(camera_, pixels, ratio, false);
  frame_.setDevicePixelRatio(ratio);
  frame_pixels_ = pixels;
  dirty_ = false;
  smooth_ = false;
  refine_timer_.start(rest_before_refining_ms);
}

bool View3D::showsScale() const {
  return scale_ &&
         (field_ != nullptr || surface_ || cloud_.scalar != nullptr ||
          std::any_of(points_.begin(), points_.end(), [](const ViewPoint& p) { return p.value.has_value(); }));
}

void View3D::refineStep() {
  if (scene_ == nullptr || dirty_) return;
  const double ratio = frame_.devicePixelRatio();
  if (!scene_->complete()) {
    const bool more = scene_->refine(frame_, false);
    frame_.setDevicePixelRatio(ratio);
    update();
    if (more) refine_timer_.start(scene_->sorting() ? rest_before_refining_ms / 4 : 0);
    return;
  }
  if (cloud_.xyz_mm != nullptr || smooth_) return;
  frame_ = scene_->draw(camera_, frame_pixels_, ratio, true);
  frame_.setDevicePixelRatio(ratio);
  smooth_ = true;
  update();
}

bool View3D::refining() const {
  if (scene_ == nullptr || empty()) return false;
  if (dirty_ || !scene_->complete()) return true;
  return cloud_.xyz_mm == nullptr && !smooth_;
}

bool View3D::waitsForItsTurn() {
  // Of the GUI thread: one window of OpenGL and its first picture take so long that two are too much for one turn.
  static bool taken = false;
  // Without an event loop there is no next turn: a picture that is asked for directly has to be complete.
  if (scene_ != nullptr || !failure_.isEmpty() || QThread::currentThread()->loopLevel() == 0) return false;
  if (taken) {
    QTimer::singleShot(0, this, qOverload<>(&View3D::update));
    return true;
  }
  taken = true;
  QTimer::singleShot(0, [] { taken = false; });
  return false;
}

void View3D::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (!empty() && !waitsForItsTurn()) ensureFrame(size(), devicePixelRatioF());
  // At a scale of 1.5 a view may begin in the middle of a pixel: a picture of its size then leaves one row or column
  // out, and nothing is painted under a view that says it is opaque.
  const QRect whole = rect().adjusted(-1, -1, 1, 1);
  if (empty() || !failure_.isEmpty() || frame_.isNull()) {
    QLinearGradient background(0, 0, 0, height());
    background.setColorAt(0, theme().view_top);
    background.setColorAt(1, theme().view_bottom);
    painter.fillRect(whole, background);
  } else {
    painter.fillRect(whole, theme().view_bottom);
    painter.drawImage(QPointF(0, 0), frame_);
  }
  paintOverlay(painter, size(), true);
  if (hasFocus()) {
    painter.setPen(QPen(theme().accent, 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(QRectF(rect()).adjusted(1, 1, -1, -1));
  }
}

void View3D::paintOverlay(QPainter& painter, const QSize& size, bool with_tools) const {
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& t = theme();
  if (empty() || !failure_.isEmpty()) {
    const QString title = failure_.isEmpty() ? empty_title_ : tr("The 3D view cannot be drawn");
    const QString how = failure_.isEmpty() ? empty_how_ : failure_;
    const QRect area = QRect(QPoint(0, 0), size).adjusted(32, 32, -32, -32);
    painter.setFont(textFont(sizes::font_body, QFont::DemiBold));
    const QRect title_box = painter.fontMetrics().boundingRect(area, Qt::AlignHCenter | Qt::TextWordWrap, title);
    const QFont body = textFont(sizes::font_body);
    const QRect how_box = QFontMetrics(body).boundingRect(area, Qt::AlignHCenter | Qt::TextWordWrap, how);
    const int total = title_box.height() + 8 + how_box.height();
    const int top = (size.height() - total) / 2;
    painter.setPen(t.text);
    painter.drawText(QRect(area.left(), top, area.width(), title_box.height()), Qt::AlignHCenter | Qt::TextWordWrap,
                     title);
    painter.setFont(body);
    painter.setPen(t.text_secondary);
    painter.drawText(QRect(area.left(), top + title_box.height() + 8, area.width(), how_box.height() + 4),
                     Qt::AlignHCenter | Qt::TextWordWrap, how);
    return;
  }
  const QSizeF area(size);
  const QRectF whole(QPointF(0, 0), area);
  const QMarginsF beside = with_tools ? tools_->margins(arrangement_.tools_in_column) : QMarginsF();
  QRectF bar;
  if (showsScale()) bar = paintColourBar(painter, whole.marginsRemoved(beside), *scale_, arrangement_.bar_below);
  if (bodies_) {
    if (machine_visible_) {
      paintMotions(painter, camera_, area, *bodies_);
    } else {
      paintTableScale(painter, camera_, area, *bodies_, bar);
    }
  }
  if (surface_box_) paintSurfaceAxes(painter, camera_, area, *surface_, *surface_box_, *scale_);
  painter.setFont(textFont(sizes::font_secondary));
  const QFontMetricsF metrics(painter.font());
  const double room = area.width() - 48 - (bar.isEmpty() || arrangement_.bar_below ? 0.0 : area.width() - bar.left());
  const QStringList lines = wrappedNotes(notes(size), room, size.height());
  const double line_height = metrics.height() + 3;
  const QRectF panel = notesPanel(lines, room);
  const QRectF triad = triadPlace(whole, camera_);
  std::vector<QRectF> keep_out{bar, panel, triad};
  if (with_tools && !tools_->isHidden()) keep_out.emplace_back(tools_->geometry());
  if (bodies_ && !machine_visible_)
    for (const OverlayText& text : tableScale(camera_, area, *bodies_)) keep_out.push_back(text.box);
  std::vector<ViewPoint> points = points_;
  for (ViewPoint& p : points) p.value_text = onScreen(p.value_text);
  std::erase_if(points, [this](const ViewPoint& p) { return clip_ && !clip_->keeps(p.position_mm); });
  paintPoints(painter, camera_, area, points, scale_, {selected_, hovered_point_, keep_out});
  paintMeasurement(painter, area);
  if (!surface_) paintTriad(painter, whole, camera_);  // a surface has axes of its own
  if (lines.isEmpty()) return;
  painter.setFont(textFont(sizes::font_secondary));
  QColor back = t.surface;
  back.setAlphaF(0.85F);
  painter.setPen(Qt::NoPen);
  painter.setBrush(back);
  painter.drawRoundedRect(panel, 6, 6);
  double y = 13 + metrics.ascent();
  for (qsizetype i = 0; i < lines.size(); ++i) {
    painter.setPen(i == 0 && !caption_.isEmpty() ? t.text : t.text_secondary);
    painter.drawText(QPointF(16, y), lines[i]);
    y += line_height;
  }
}

QStringList View3D::notes(const QSize& size) const {
  QStringList notes;
  if (measuring_ && measured_.size() < 2) {
    notes << (measured_.empty() ? tr("Distance: click the first place") : tr("Distance: click the second place"));
    return notes;
  }
  if (!caption_.isEmpty()) notes << onScreen(caption_).split(QLatin1Char('\n'));
  if (!arrows_.empty()) {
    notes << tr("Arrows %1 times larger than the deviation").arg(decimalText(exaggeration_, 'f', 0));
  }
  if (field_ != nullptr && field_style_.relief_exaggeration > 0) {
    notes << tr("Height %1 times larger").arg(decimalText(field_style_.relief_exaggeration, 'f', 0));
  }
  const bool faded = field_ != nullptr && field_style_.significance > 0 && !field_->sigma.empty();
  const bool striped = field_ != nullptr && std::find(field_->extrapolated.begin(), field_->extrapolated.end(), true) !=
                                                field_->extrapolated.end();
  const QString significance = QString::number(field_style_.significance);
  if (size.height() < low_view_px && faded && striped) {
    notes << tr("Faded: within %1 σ of zero; striped: outside the points").arg(significance);
  } else {
    if (faded) notes << tr("Faded: within %1 standard uncertainties of zero").arg(significance);
    if (striped) notes << tr("Striped: outside the measured points");
  }
  return notes;
}

QImage View3D::picture(const QSize& size, double ratio) {
  QImage image(
      QSize(static_cast<int>(std::lround(size.width() * ratio)), static_cast<int>(std::lround(size.height() * ratio))),
      QImage::Format_RGB32);
  image.setDevicePixelRatio(ratio);
  image.fill(theme().view_top);
  dirty_ = true;
  const bool had_fit = fitted_;
  const Camera before = camera_;
  const Arrangement arrangement = arrangement_;
  fitting_for_picture_ = true;
  fitted_ = had_fit && size == this->size();
  if (!empty()) {
    ensureFrame(size, ratio);
    if (scene_ != nullptr) {
      while (scene_->refine(frame_, true)) {
      }
      if (cloud_.xyz_mm == nullptr) frame_ = scene_->draw(camera_, frame_pixels_, ratio, true);
      frame_.setDevicePixelRatio(ratio);
    }
  }
  QPainter painter(&image);
  if (!frame_.isNull()) painter.drawImage(QPointF(0, 0), frame_);
  paintOverlay(painter, size, false);
  painter.end();
  if (had_fit) camera_ = before;
  fitted_ = had_fit;
  arrangement_ = arrangement;
  fitting_for_picture_ = false;
  changed();
  return image;
}

}  // namespace spindrift::gui
