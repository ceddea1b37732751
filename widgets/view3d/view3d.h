// SPDX-License-Identifier: GPL-3.0-or-later
// The 3D view: machine, table grid, points, arrows, heat maps and clouds. Works with and without a display.
//
// Solid things are drawn by VTK into an off-screen window and painted here; labels, markers, arrows, colour bar and
// axes are painted on top with the program's own font. Lengths mm in MCF, deviations um or urad.
//
// Mouse: left drag turns, middle or right drag (or Shift + left) pans, wheel zooms at the cursor, click picks,
// double-click resets. Touch: one finger turns, two fingers pan and pinch; two fingers on a touch pad pan, with Ctrl
// they zoom. Keys: arrows turn, Shift + arrows pan, + and - zoom, R or Home fits, 1 2 3 4 standard views, P switches
// perspective, M measures a distance between two picks, C clips, N and B pick the next and the previous point.
#pragma once

#include <Eigen/Core>
#include <QImage>
#include <QMarginsF>
#include <QPointer>
#include <QTimer>
#include <QWidget>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/machine/field.h"
#include "core/machine/machine_description.h"
#include "widgets/theme/colour_map.h"
#include "widgets/theme/theme.h"
#include "widgets/view3d/camera.h"
#include "widgets/view3d/machine_bodies.h"
#include "widgets/view3d/measurement.h"

class QTouchEvent;

namespace spindrift::gui {

class Scene;
class ViewTools;

/// A point with a label that faces the viewer. `value` (if there is one) is shown beside the label and colours the
/// mark.
struct ViewPoint {
  QString id;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  QString label;                            ///< "F1"
  QString value_text;                       ///< "12.4 ± 0.3 um" or empty
  std::optional<double> value;              ///< colour by the scale of the view
  bool used = true;                         ///< false: drawn hollow (validation, excluded)
  Tone tone = Tone::Accent;                 ///< colour without a value
  bool mark = true;                         ///< false: the label alone, for what is drawn as a shape
  std::optional<PointDeviation> deviation;  ///< as measured, for distances between points
};

/// What lies beyond a plane across one axis is not drawn.
struct ClipPlane {
  int axis = 2;  ///< 0, 1, 2 for X, Y, Z
  double offset_mm = 0.0;
  bool keep_low = true;  ///< the side with the smaller coordinates is kept
  [[nodiscard]] bool keeps(const Eigen::Vector3d& p_mm) const {
    return keep_low ? p_mm[axis] <= offset_mm : p_mm[axis] >= offset_mm;
  }
  [[nodiscard]] bool operator==(const ClipPlane&) const = default;
};

/// A deviation at a place, drawn `exaggeration` times larger.
struct ViewArrow {
  Eigen::Vector3d from_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d deviation_um = Eigen::Vector3d::Zero();
  Tone tone = Tone::Neutral;
};

enum class ShapeKind {
  Sphere,  ///< one point: the centre
  Rod,     ///< two points: the ends of a cylinder
  Path,    ///< a line through all points
};

/// A simple solid or a path. Neutral: the colour of bodies, or of secondary text for paths.
struct ViewShape {
  ShapeKind kind = ShapeKind::Sphere;
  std::vector<Eigen::Vector3d> points_mm;
  double radius_mm = 1.0;  ///< of spheres and rods
  Tone tone = Tone::Neutral;
};

struct FieldStyle {
  double significance = 2.0;       ///< |value| below this many sigma is drawn faded; 0 switches that off
  double relief_exaggeration = 0;  ///< > 0: the surface is lifted by the value times this (um -> mm * 1e-3)
  bool contours = true;
};

/// Points coloured by a scalar. The vectors are shared, not copied.
struct ViewCloud {
  std::shared_ptr<const std::vector<float>> xyz_mm;  ///< x y z x y z ...
  std::shared_ptr<const std::vector<float>> scalar;  ///< one a point, in the unit of the scale; may be null
  std::shared_ptr<const std::vector<float>> sigma;   ///< standard uncertainties of the scalars; may be null
  double point_size = 2.0;
};

/// A quantity over two others as a surface in a box with axes. Rows and columns as far apart as their numbers say.
struct ViewSurface {
  std::vector<double> x;                  ///< columns, ascending
  std::vector<double> y;                  ///< rows, ascending
  std::vector<double> value;              ///< row major; NaN: no value
  std::vector<double> sigma;              ///< standard uncertainties, empty or one a node: bars of one each way
  QString x_title, y_title, value_title;  ///< "Position / mm"
  [[nodiscard]] std::size_t index(std::size_t column, std::size_t row) const { return row * x.size() + column; }
};

/// Where a surface stands in the view: the numbers at the ends of its axes and the box they span.
struct SurfaceBox {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();  ///< x, y, value
  Eigen::Vector3d high = Eigen::Vector3d::Ones();
  /// The box reaches from the origin to here.
  inline static const Eigen::Vector3d size_mm{100.0, 100.0, 62.0};
  [[nodiscard]] Eigen::Vector3d place_mm(const Eigen::Vector3d& numbers) const {
    return (numbers - low).cwiseQuotient(high - low).cwiseProduct(size_mm);
  }
};

class View3D : public QWidget {
  Q_OBJECT
 public:
  explicit View3D(QWidget* parent = nullptr);
  ~View3D() override;

  // Content. Each call replaces what was there; nothing is drawn until the next paint.
  void clear();
  /// The box model, its table grid and travels; also decides what is up.
  void setMachine(const MachineDescription& machine);
  void setMachineVisible(bool visible);   ///< bodies and travels; the table with its grid stays
  void setToolSideVisible(bool visible);  ///< column, head, spindle
  void setPoints(std::vector<ViewPoint> points);
  void setArrows(std::vector<ViewArrow> arrows, double exaggeration);
  /// Balls, styli, the path of a programme: part of the scene, covered and lit as bodies are.
  void setShapes(std::vector<ViewShape> shapes);
  [[nodiscard]] const std::vector<ViewShape>& shapes() const { return shapes_; }
  void setField(std::shared_ptr<const Field> field, const FieldStyle& style = {});
  void setCloud(const ViewCloud& cloud);
  /// Coloured and as high as the colour scale says; empty: none.
  void setSurface(std::optional<ViewSurface> surface);
  void setColourScale(const std::optional<ColourScale>& scale);
  void setCaption(const QString& text);  ///< small text at the top left: what is shown
  /// What stands there while there is nothing to draw: what will appear and how to get it.
  void setEmptyText(const QString& title, const QString& how);
  void setSelected(const QString& point_id);  ///< marks a point; empty: none

  [[nodiscard]] bool empty() const;
  [[nodiscard]] const std::optional<ColourScale>& colourScale() const { return scale_; }
  [[nodiscard]] const std::vector<ViewPoint>& points() const { return points_; }
  [[nodiscard]] const std::vector<ViewArrow>& arrows() const { return arrows_; }
  [[nodiscard]] const QString& selected() const { return selected_; }

  // Camera.
  [[nodiscard]] const Camera& camera() const { return camera_; }
  void setCamera(const Camera& camera);
  void resetCamera(StandardView view = StandardView::Isometric);
  /// Looks along the normal of the heat map, from above where there is none; also at maps that come later, until
  /// somebody moves the camera.
  void lookAtMap();
  /// From where the heat map is seen as a map.
  [[nodiscard]] StandardView mapView() const;
  void setOrthographic(bool on);
  /// Shows everything from where the camera looks.
  void fit();
  /// Box around what is shown, mm; empty if there is nothing.
  [[nodiscard]] std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> extent() const;
  /// From now on both views always look the same way.
  void link(View3D* other);

  // Clip plane and distance.
  void setClip(const std::optional<ClipPlane>& plane);
  [[nodiscard]] const std::optional<ClipPlane>& clip() const { return clip_; }
  /// On: through the middle of what is shown, across the vertical.
  void setClipping(bool on);
  /// Where colour bar and buttons stand.
  struct Arrangement {
    bool bar_below = false;        ///< the colour bar lies below the picture, for panes higher than what they show
    bool tools_in_column = false;  ///< the buttons stand one below the other, for panes wider than what they show
  };
  [[nodiscard]] const Arrangement& arrangement() const { return arrangement_; }
  /// While it is on a click picks an end of the distance: a point, a point of the cloud or a place on a surface. The
  /// third pick begins anew.
  void setMeasuring(bool on);
  [[nodiscard]] bool measuring() const { return measuring_; }
  /// The picked ends, none to two.
  [[nodiscard]] const std::vector<MeasuredPlace>& measuredPlaces() const { return measured_; }
  /// What is under a pixel, nearest to the viewer: a point before a cloud before a surface.
  [[nodiscard]] std::optional<MeasuredPlace> placeAt(const QPointF& pixel) const;

  /// The id of the point at a pixel; empty if there is none within 12 px.
  [[nodiscard]] QString pointAt(const QPointF& pixel) const;
  /// Value of the field (or nothing) under a pixel.
  struct Probe {
    Eigen::Vector2d xy_mm;  ///< on the plane of the field: FieldGrid::firstAxis, secondAxis
    double value;
    double sigma;
    bool extrapolated;
  };
  [[nodiscard]] std::optional<Probe> probeAt(const QPointF& pixel) const;
  /// The cloud's point nearest to a pixel (within 6 px), its index.
  [[nodiscard]] std::optional<std::size_t> cloudPointAt(const QPointF& pixel) const;
  /// The node of the surface nearest to a pixel (within 12 px): its index.
  [[nodiscard]] std::optional<std::size_t> surfaceNodeAt(const QPointF& pixel) const;
  [[nodiscard]] const std::optional<SurfaceBox>& surfaceBox() const { return surface_box_; }
  [[nodiscard]] std::optional<QPointF> pixelOf(const Eigen::Vector3d& point_mm) const;

  /// A finished picture of any size (device-independent pixels), as it is drawn on screen.
  [[nodiscard]] QImage picture(const QSize& size, double device_pixel_ratio);
  /// True while a large cloud is still being drawn bit by bit, or edges are being smoothed.
  [[nodiscard]] bool refining() const;
  /// Sentence for the user if there is no OpenGL at all, else empty.
  [[nodiscard]] const QString& failure() const { return failure_; }

  [[nodiscard]] QSize sizeHint() const override { return {640, 480}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {240, 200}; }

 Q_SIGNALS:
  void pointPicked(const QString& id);
  void cameraChanged();
  /// The cursor over the view, without a button (pixels of this widget).
  void cursorMoved(const QPointF& pixel);
  /// The value under the cursor, ready to be read ("x 120.0 mm, y 40.0 mm: 3.2 ± 0.4 um"); empty outside.
  void hovered(const QString& text);
  /// A distance was picked: "F1 to F3: 260.0042 ± 0.0008 mm ...".
  void distanceMeasured(const QString& text);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void changed();  ///< redraw solid things
  // What mouse and fingers share.
  void press(const QPointF& position);
  void drag(const QPointF& position, bool pan);
  void release(const QPointF& position, bool picks);
  void hover(const QPointF& position);
  void touch(QTouchEvent* event);
  void pickEnd(const QPointF& position);
  void paintMeasurement(QPainter& painter, const QSizeF& size) const;
  /// What is to be seen has another extent: a view that nobody has turned is fitted again.
  void extentChanged();
  void placeTable();
  [[nodiscard]] QMarginsF marginsFor(const QSize& size, const Arrangement& arrangement) const;
  [[nodiscard]] Camera cameraFor(const QSize& size, const Arrangement& arrangement) const;
  /// What the notes at the top left say: caption, exaggeration, what faded and striped mean.
  [[nodiscard]] QStringList notes(const QSize& size) const;
  [[nodiscard]] QRectF placeOfNotes(const QSize& size, const Arrangement& arrangement) const;
  void cameraMoved();  ///< redraw, thinned, and refine a moment later
  void ensureFrame(const QSize& size, double ratio);
  /// True if another view drew its first picture in this turn of the event loop: this one is painted again in the next.
  bool waitsForItsTurn();
  void fitCamera(const QSize& size);
  void setHoveredPoint(const QString& id);  ///< its label is always shown
  void shareCamera();                       ///< with the linked views
  void paintOverlay(QPainter& painter, const QSize& size, bool with_tools) const;
  [[nodiscard]] QSizeF viewSize() const { return {static_cast<double>(width()), static_cast<double>(height())}; }
  void refineStep();
  [[nodiscard]] QString textAt(const QPointF& position) const;  ///< what stands under the cursor
  void placeSurface();                                          ///< in the box that the scale spans
  /// True if something is coloured by the scale, so that its bar has to be there.
  [[nodiscard]] bool showsScale() const;

  void ensureScene();

  std::unique_ptr<Scene> scene_;  ///< made when it is first painted
  MachineDescription machine_;
  std::optional<MachineBodies> bodies_;  ///< of it, on a table under all points
  bool machine_visible_ = true;
  bool tool_side_visible_ = true;
  ViewCloud cloud_;
  Camera camera_;
  std::optional<ColourScale> scale_;
  std::vector<ViewPoint> points_;
  std::vector<ViewArrow> arrows_;
  double exaggeration_ = 0;
  std::vector<ViewShape> shapes_;
  std::shared_ptr<const Field> field_;
  FieldStyle field_style_;
  QString caption_;
  QString empty_title_;
  QString empty_how_;
  QString selected_;
  QString hovered_point_;
  QString failure_;
  QImage frame_;
  bool dirty_ = true;
  bool at_map_ = false;   ///< looks at the map, whatever it will be
  bool fitted_ = false;   ///< the camera has been fitted to the content
  Camera automatic_;      ///< as it was fitted: while nobody turns it, it is fitted again when the size changes
  QSize automatic_for_;   ///< the size that it was fitted to
  QRectF fitted_beside_;  ///< the place of the notes then
  bool following_ = false;
  QPointF press_position_;
  QPointF last_position_;
  bool dragging_ = false;
  QTimer refine_timer_;
  QSize frame_pixels_;
  bool smooth_ = false;  ///< the edges of what is shown are smoothed
  std::optional<ViewSurface> surface_;
  std::optional<SurfaceBox> surface_box_;
  std::vector<QPointer<View3D>> linked_;
  ViewTools* tools_;
  std::optional<ClipPlane> clip_;
  bool measuring_ = false;
  std::vector<MeasuredPlace> measured_;
  int fingers_ = 0;
  Arrangement arrangement_;
  bool fitting_for_picture_ = false;  ///< without buttons
  /// Views lower than this give the notes at the top a place of their own, two lines.
  static constexpr int low_view_px = 360;
};

}  // namespace spindrift::gui
