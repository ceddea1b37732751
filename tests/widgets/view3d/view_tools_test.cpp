// SPDX-License-Identifier: GPL-3.0-or-later
// The tools of the 3D view: standard views, perspective, distances, clip plane, fingers; and that what it shows fills
// the pane and stays in it.
#include "widgets/view3d/view_tools.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QMenu>
#include <QNativeGestureEvent>
#include <QPainter>
#include <QPointingDevice>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <QWheelEvent>
#include <cmath>
#include <cstdint>
#include <memory>
#include <set>

#include "widgets/view3d/overlay.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

MachineDescription mill() {
  return MachineDescription::parse(
      JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-(C)-t]",
        "axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,130]},{"name":"Z","travel_mm":[0,150]}]})",
                      "machine.json"),
      "machine.json");
}

std::shared_ptr<Field> field() {
  auto f = std::make_shared<Field>();
  f->grid = {0, 300, 0, 130, 0, 31, 31};
  f->component = Component::EX;
  for (int i = 0; i < 31 * 31; ++i) {
    f->value.push_back(0.5 * (i % 31) - 7.0);
    f->sigma.push_back(0.4);
  }
  return f;
}

ViewPoint point(const QString& id, const Eigen::Vector3d& at) {
  ViewPoint p;
  p.id = p.label = id;
  p.position_mm = at;
  p.value = 12.4;
  p.value_text = QStringLiteral("12.4 ± 0.3 µm");
  return p;
}

class ViewToolsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    view_.resize(760, 480);
    view_.setMachine(mill());
    view_.setMachineVisible(false);
    view_.setColourScale(ColourScale::symmetric(8, QStringLiteral("EX"), QStringLiteral("um")));
    view_.setField(field());
    view_.resetCamera(StandardView::Top);
    view_.show();
    (void)view_.grab();
  }
  QToolButton* button(const QString& name) {
    for (auto* b : view_.findChildren<QToolButton*>())
      if (b->accessibleName() == name && !b->isHidden()) return b;
    ADD_FAILURE() << "no button " << name.toStdString();
    return nullptr;
  }
  ViewTools* tools() { return view_.findChild<ViewTools*>(); }
  void click(const Eigen::Vector3d& at) {
    QTest::mouseClick(&view_, Qt::LeftButton, Qt::NoModifier, view_.pixelOf(at)->toPoint());
  }
  View3D view_;
};

TEST_F(ViewToolsTest, EveryStandardViewHasAButtonWithANameAndAKey) {
  const std::pair<const char*, StandardView> views[] = {{"Front", StandardView::Front},
                                                        {"Top", StandardView::Top},
                                                        {"Right", StandardView::Right},
                                                        {"Isometric", StandardView::Isometric}};
  for (const auto& [name, direction] : views) {
    Camera wanted;
    wanted.look(direction);
    button(QLatin1String(name))->click();
    EXPECT_NEAR(view_.camera().azimuth_rad, wanted.azimuth_rad, 1e-12) << name;
    EXPECT_NEAR(view_.camera().elevation_rad, wanted.elevation_rad, 1e-12) << name;
    EXPECT_TRUE(button(QLatin1String(name))->toolTip().contains(QLatin1Char('('))) << "its key is told";
  }
  // Fit keeps the direction and shows everything again.
  (void)view_.grab();
  const Camera fitted = view_.camera();
  QTest::keyClick(&view_, Qt::Key_Plus);
  QTest::keyClick(&view_, Qt::Key_Plus);
  button(QStringLiteral("Fit"))->click();
  (void)view_.grab();
  EXPECT_NEAR(view_.camera().half_height_mm, fitted.half_height_mm, 1e-9);
  button(QStringLiteral("Perspective"))->click();
  EXPECT_FALSE(view_.camera().orthographic);
  QTest::keyClick(&view_, Qt::Key_P);
  EXPECT_TRUE(view_.camera().orthographic);
  EXPECT_FALSE(button(QStringLiteral("Perspective"))->isChecked());
}

TEST_F(ViewToolsTest, TheRowIsOneTabStopAndArrowsGoAlongIt) {
  ASSERT_TRUE(tools()->isOpen());
  std::vector<QToolButton*> stops;
  const auto buttons = tools()->findChildren<QToolButton*>();
  ASSERT_EQ(buttons.size(), 8);
  for (auto* b : buttons)
    if ((b->focusPolicy() & Qt::TabFocus) != 0) stops.push_back(b);
  ASSERT_EQ(stops.size(), 1U);
  std::set<QToolButton*> reached;
  QToolButton* now = stops[0];
  for (int i = 0; i < 8; ++i) {
    reached.insert(now);
    QTest::keyClick(now, Qt::Key_Right);
    for (auto* b : buttons)
      if ((b->focusPolicy() & Qt::TabFocus) != 0) now = b;
  }
  EXPECT_EQ(reached.size(), 8U);
}

TEST_F(ViewToolsTest, ASmallViewHasOneButtonWithTheSameActions) {
  view_.resize(320, 240);
  QApplication::processEvents();
  EXPECT_FALSE(tools()->isOpen());
  EXPECT_TRUE(tools()->isHidden());
  QToolButton* all = button(QStringLiteral("View"));
  ASSERT_TRUE(all != nullptr && all->menu() != nullptr);
  EXPECT_EQ(all->menu()->actions().size(), 8);
  EXPECT_TRUE(view_.rect().contains(all->geometry()));
  view_.clear();
  EXPECT_TRUE(all->isHidden()) << "an empty view has nothing to turn";
}

TEST(Distance, OfTheFirstOrderInTheDeviations) {
  MeasuredPlace a{QStringLiteral("F1"), {0, 0, 0}, PointDeviation{{-1.0, 500.0, 0}, {0.6, 100.0, 0}}};
  MeasuredPlace b{QStringLiteral("F2"), {260, 0, 0}, PointDeviation{{3.2, 500.0, 0}, {0.8, 100.0, 0}}};
  const Distance d = distanceBetween(a, b);
  ASSERT_TRUE(d.change_um);
  EXPECT_NEAR(*d.change_um, 4.2, 1e-12);
  EXPECT_NEAR(d.sigma_um, 1.0, 1e-12) << "what lies across the line does not matter";
  EXPECT_EQ(distanceText(a, b).toStdString(), "F1 to F2: 260.0042 ± 0.0010 mm, 4.2 ± 1.0 µm more than nominal");
  // Against many readings with the same uncertainties, along a slanted line.
  a.deviation->sigma_um = {0.6, 1.5, 0.9};
  b.deviation->sigma_um = {0.8, 0.5, 0.4};
  b.position_mm = {200, 100, 50};
  const Distance slanted = distanceBetween(a, b);
  double sum = 0, squares = 0;
  std::uint64_t seed = 7;
  const auto uniform = [&] {  // of unit variance
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (static_cast<double>(seed >> 11) / 9007199254740992.0 - 0.5) * std::sqrt(12.0);
  };
  constexpr int readings = 40'000;
  for (int i = 0; i < readings; ++i) {
    Eigen::Vector3d p = a.position_mm + 1e-3 * a.deviation->deviation_um;
    Eigen::Vector3d q = b.position_mm + 1e-3 * b.deviation->deviation_um;
    for (int k = 0; k < 3; ++k) {
      p[k] += 1e-3 * a.deviation->sigma_um[k] * uniform();
      q[k] += 1e-3 * b.deviation->sigma_um[k] * uniform();
    }
    const double um = 1e3 * ((q - p).norm() - slanted.nominal_mm);
    sum += um;
    squares += um * um;
  }
  const double mean = sum / readings;
  EXPECT_NEAR(mean, *slanted.change_um, 0.03);
  EXPECT_NEAR(std::sqrt(squares / readings - mean * mean), slanted.sigma_um, 0.03);
}

TEST(Distance, WithoutAnUncertaintyWhereOneEndWasNotMeasured) {
  const MeasuredPlace a{QStringLiteral("F1"), {0, 0, 0}, PointDeviation{{1, 1, 1}, {0.1, 0.1, 0.1}}};
  const MeasuredPlace surface{QString(), {0, 87.3, 0}, std::nullopt};
  EXPECT_FALSE(distanceBetween(a, surface).change_um);
  EXPECT_EQ(distanceText(a, surface).toStdString(), "F1 to surface: 87.300 mm");
  MeasuredPlace only_x = a;
  only_x.position_mm = {0, 50, 0};
  only_x.deviation->sigma_um.y() = std::nan("");
  EXPECT_FALSE(distanceBetween(a, only_x).change_um) << "the line runs along what was not measured";
}

TEST_F(ViewToolsTest, TwoPicksMeasureADistance) {
  std::vector<ViewPoint> points{point(QStringLiteral("F1"), {20, 20, 0}), point(QStringLiteral("F2"), {280, 20, 0})};
  points[0].deviation = PointDeviation{{-1, 0, 0}, {0.6, 0.6, 0.6}};
  points[1].deviation = PointDeviation{{3.2, 0, 0}, {0.8, 0.8, 0.8}};
  view_.setPoints(points);
  (void)view_.grab();
  QSignalSpy said(&view_, &View3D::distanceMeasured);
  QSignalSpy picked(&view_, &View3D::pointPicked);
  button(QStringLiteral("Measure a distance"))->click();
  EXPECT_TRUE(view_.measuring());
  click({20, 20, 0});
  click({280, 20, 0});
  ASSERT_EQ(said.count(), 1);
  EXPECT_EQ(said[0][0].toString().toStdString(), "F1 to F2: 260.0042 ± 0.0010 mm, 4.2 ± 1.0 µm more than nominal");
  EXPECT_EQ(picked.count(), 0) << "no point is chosen meanwhile";
  // The line is drawn between them.
  const QImage with = view_.grab().toImage();
  const QPoint beside = view_.pixelOf({150, 20, 0})->toPoint();
  view_.setMeasuring(false);
  const QImage without = view_.grab().toImage();
  int differ = 0;
  for (int dx = -20; dx <= 20; ++dx)
    differ += with.pixel(beside + QPoint(dx, 0)) != without.pixel(beside + QPoint(dx, 0));
  EXPECT_GT(differ, 15);
  // From a point to a place on the surface of the field.
  view_.setMeasuring(true);
  click({20, 20, 0});
  click({150, 90, 0});
  ASSERT_EQ(view_.measuredPlaces().size(), 2U);
  EXPECT_NEAR(view_.measuredPlaces()[1].position_mm.x(), 150, 0.6);
  EXPECT_NEAR(view_.measuredPlaces()[1].position_mm.y(), 90, 0.6);
  EXPECT_FALSE(said.back()[0].toString().contains(QStringLiteral("±")));
  QTest::keyClick(&view_, Qt::Key_Escape);
  EXPECT_FALSE(view_.measuring());
}

TEST_F(ViewToolsTest, TheClipPlaneHidesWhatLiesBeyond) {
  view_.setPoints({point(QStringLiteral("F1"), {40, 100, 0}), point(QStringLiteral("F2"), {260, 100, 0})});
  const QImage whole = view_.grab().toImage();
  const QPoint low = view_.pixelOf({60, 50, 0})->toPoint();
  const QPoint high = view_.pixelOf({240, 50, 0})->toPoint();
  view_.setClip(ClipPlane{0, 150.0, true});
  QImage clipped = view_.grab().toImage();
  EXPECT_EQ(clipped.pixel(low), whole.pixel(low));
  EXPECT_NE(clipped.pixel(high), whole.pixel(high));
  EXPECT_EQ(view_.pointAt(*view_.pixelOf({40, 100, 0})), QStringLiteral("F1"));
  EXPECT_TRUE(view_.pointAt(*view_.pixelOf({260, 100, 0})).isEmpty()) << "what is hidden is not picked";
  EXPECT_FALSE(view_.placeAt(*view_.pixelOf({240, 50, 0})));
  button(QStringLiteral("Keep the other side"))->click();
  clipped = view_.grab().toImage();
  EXPECT_NE(clipped.pixel(low), whole.pixel(low));
  EXPECT_EQ(clipped.pixel(high), whole.pixel(high));
  view_.setClip(std::nullopt);
  EXPECT_EQ(view_.grab().toImage().pixel(low), whole.pixel(low));
  QTest::keyClick(&view_, Qt::Key_C);
  ASSERT_TRUE(view_.clip());
  EXPECT_EQ(view_.clip()->axis, 2) << "across the vertical";
}

TEST_F(ViewToolsTest, TwoFingersPanAndPinchOneTurnsAndTaps) {
  QPointingDevice* screen = QTest::createTouchDevice();
  const Camera before = view_.camera();
  // Both fingers move right by 40: the scene goes with them.
  const Eigen::Vector3d under(150, 65, 0);
  const QPointF start = *view_.pixelOf(under);
  QTest::touchEvent(&view_, screen).press(1, QPoint(300, 200)).press(2, QPoint(400, 200));
  QTest::touchEvent(&view_, screen).move(1, QPoint(340, 200)).move(2, QPoint(440, 200));
  EXPECT_NEAR(view_.pixelOf(under)->x(), start.x() + 40, 1e-6);
  EXPECT_NEAR(view_.camera().half_height_mm, before.half_height_mm, 1e-9);
  // Apart by half: half as much is seen of the height... of 100 to 200 pixels.
  QTest::touchEvent(&view_, screen).move(1, QPoint(290, 200)).move(2, QPoint(490, 200));
  EXPECT_NEAR(view_.camera().half_height_mm, before.half_height_mm / 2, 1e-9);
  EXPECT_EQ(view_.camera().azimuth_rad, before.azimuth_rad) << "two fingers do not turn";
  QTest::touchEvent(&view_, screen).release(1, QPoint(290, 200)).release(2, QPoint(490, 200));
  QTest::touchEvent(&view_, screen).press(1, QPoint(300, 200));
  QTest::touchEvent(&view_, screen).move(1, QPoint(340, 200));
  QTest::touchEvent(&view_, screen).release(1, QPoint(340, 200));
  EXPECT_NE(view_.camera().azimuth_rad, before.azimuth_rad);
  // A tap picks.
  view_.setPoints({point(QStringLiteral("F1"), {40, 100, 0})});
  view_.resetCamera(StandardView::Top);
  (void)view_.grab();
  QSignalSpy picked(&view_, &View3D::pointPicked);
  const QPoint at = view_.pixelOf({40, 100, 0})->toPoint();
  QTest::touchEvent(&view_, screen).press(1, at);
  QTest::touchEvent(&view_, screen).release(1, at);
  EXPECT_EQ(picked.count(), 1);
}

TEST_F(ViewToolsTest, ATouchPadPansWithTwoFingersAndAMouseWheelZooms) {
  const QPointingDevice pad(QStringLiteral("pad"), 71, QInputDevice::DeviceType::TouchPad,
                            QPointingDevice::PointerType::Finger,
                            QInputDevice::Capability::Position | QInputDevice::Capability::Scroll, 2, 0);
  const QPointF at(380, 240);
  const auto scroll = [&](const QPointingDevice& device, Qt::KeyboardModifiers keys) {
    QWheelEvent event(at, at, QPoint(0, 30), QPoint(0, 120), Qt::NoButton, keys, Qt::ScrollUpdate, false,
                      Qt::MouseEventNotSynthesized, &device);
    QCoreApplication::sendEvent(&view_, &event);
  };
  const Camera before = view_.camera();
  scroll(pad, Qt::NoModifier);
  EXPECT_EQ(view_.camera().half_height_mm, before.half_height_mm);
  EXPECT_NE(view_.camera().focal_point_mm, before.focal_point_mm);
  scroll(pad, Qt::ControlModifier);
  EXPECT_LT(view_.camera().half_height_mm, before.half_height_mm);
  const Camera zoomed = view_.camera();
  scroll(*QPointingDevice::primaryPointingDevice(), Qt::NoModifier);
  EXPECT_LT(view_.camera().half_height_mm, zoomed.half_height_mm);
  const Camera wheel = view_.camera();
  QNativeGestureEvent pinch(Qt::ZoomNativeGesture, &pad, 2, at, at, at, 0.25, QPointF());
  QCoreApplication::sendEvent(&view_, &pinch);
  EXPECT_NEAR(view_.camera().half_height_mm, wheel.half_height_mm / 1.25, 1e-9);
}

TEST_F(ViewToolsTest, HoveringAPointTellsItsValueWithItsUncertainty) {
  view_.setPoints({point(QStringLiteral("F1"), {40, 100, 0})});
  QSignalSpy hovered(&view_, &View3D::hovered);
  const QPointF at = *view_.pixelOf({40, 100, 0});
  QMouseEvent move(QEvent::MouseMove, at, at, Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&view_, &move);
  ASSERT_FALSE(hovered.empty());
  EXPECT_EQ(hovered.back()[0].toString().toStdString(), "F1: 12.4 ± 0.3 µm");
}

TEST_F(ViewToolsTest, HeatMapsFillTheirPane) {
  const MachineBodies bodies = machineBodies(mill());
  for (const QSize size : {QSize(760, 480), QSize(420, 300), QSize(360, 620), QSize(1200, 420)}) {
    view_.resize(size);
    view_.resetCamera(StandardView::Top);
    (void)view_.grab();
    QApplication::processEvents();
    const QImage seen = view_.grab().toImage();
    if (qEnvironmentVariableIsSet("SPINDRIFT_KEEP_PICTURES")) {
      seen.save(qEnvironmentVariable("SPINDRIFT_KEEP_PICTURES") + QStringLiteral("/fill-%1.png").arg(size.width()));
    }
    const QRectF pane = QRectF(QPointF(0, 0), QSizeF(size));
    QRectF table = view_.camera().frame(bodies.table_low_mm, bodies.table_high_mm, QSizeF(size));
    for (const OverlayText& text : tableScale(view_.camera(), QSizeF(size), bodies)) table |= text.box;
    EXPECT_TRUE(pane.contains(table)) << size.width();
    // Free of what stands beside it.
    const double bar = view_.arrangement().bar_below ? 0.0 : colourBarWidth(*view_.colourScale());
    const double wide = table.width() / (size.width() - bar);
    const double high = table.height() / size.height();
    std::printf("%d x %d: the table takes %.2f of the width, %.2f of the height\n", size.width(), size.height(), wide,
                high);
    // Notes at the top left take room only of what they would cover.
    EXPECT_GT(std::max(wide, high), size.height() < 440 ? 0.84 : 0.90) << size.width() << " x " << size.height();
    for (const auto* tool : view_.findChildren<QToolButton*>()) {
      if (tool->isHidden() || tool->parentWidget()->isHidden()) continue;
      EXPECT_FALSE(table.intersects(QRectF(QRect(tool->mapTo(&view_, QPoint(0, 0)), tool->size()))))
          << tool->accessibleName().toStdString() << " covers the table of " << size.width();
    }
  }
}

TEST_F(ViewToolsTest, NumbersAlongBothEdgesOfTheTableAreSeenBesideTheColourBar) {
  const auto of = [](const std::string& chain) {
    return MachineDescription::parse(
        JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"mill","chain":")" + chain +
                            R"(","axes":[{"name":"X","travel_mm":[0,560]},{"name":"Y","travel_mm":[0,500]},)" +
                            R"({"name":"Z","travel_mm":[0,500]}]})",
                        "machine.json"),
        "machine.json");
  };
  for (const char* chain : {"V [w-X'-Y'-b-Z-(C)-t]", "H [w-Z'-b-X-Y-(C)-t]"}) {
    const MachineDescription machine = of(chain);
    view_.setMachine(machine);
    view_.setMachineVisible(false);
    view_.setField(nullptr);
    view_.setPoints({point(QStringLiteral("F1"), {40, 45, 20})});
    const MachineBodies bodies = machineBodies(machine);
    for (const QSize size : {QSize(306, 332), QSize(530, 480), QSize(760, 480), QSize(520, 700)}) {
      view_.resize(size);
      view_.resetCamera(StandardView::Top);
      (void)view_.grab();
      QApplication::processEvents();
      (void)view_.grab();
      const QRectF pane(QPointF(0, 0), QSizeF(size));
      const QRectF table = view_.camera().frame(bodies.table_low_mm, bodies.table_high_mm, QSizeF(size));
      const double bar =
          view_.arrangement().bar_below ? size.width() : size.width() - colourBarWidth(*view_.colourScale());
      int beside = 0, below = 0;
      for (const OverlayText& text : tableScale(view_.camera(), QSizeF(size), bodies)) {
        EXPECT_TRUE(pane.contains(text.box)) << chain << ", " << size.width() << ": " << text.text.toStdString();
        EXPECT_LE(text.box.right(), bar + 1) << chain << ", " << size.width() << ": " << text.text.toStdString();
        (text.box.center().y() > table.bottom() ? below : beside) += 1;
      }
      EXPECT_GE(beside, 3) << chain << ", " << size.width();
      EXPECT_GE(below, 3) << chain << ", " << size.width();
    }
  }
}

TEST_F(ViewToolsTest, ArrowsOnAHeatMapAreSeen) {
  const QImage without = view_.grab().toImage();
  view_.setArrows({{{60, 40, 0}, {20, 0, 0}, Tone::Good}}, 3000.0);
  const QImage with = view_.grab().toImage();
  const QPoint middle = view_.pixelOf({90, 40, 0})->toPoint();
  int changed = 0;
  for (int dy = -3; dy <= 3; ++dy)
    changed += with.pixel(middle + QPoint(0, dy)) != without.pixel(middle + QPoint(0, dy)) ? 1 : 0;
  EXPECT_GE(changed, 1);
  // One that goes down as well, below the map: from above it is seen whole.
  view_.setArrows({{{60, 40, 0}, {20, 0, -15}, Tone::Good}}, 3000.0);
  view_.lookAtMap();
  const QImage down = view_.grab().toImage();
  view_.setArrows({}, 3000.0);
  const QImage none = view_.grab().toImage();
  for (const double x : {75.0, 90.0, 105.0}) {
    const QPoint at = view_.pixelOf({x, 40, 0})->toPoint();
    int seen = 0;
    for (int dy = -3; dy <= 3; ++dy) seen += down.pixel(at + QPoint(0, dy)) != none.pixel(at + QPoint(0, dy)) ? 1 : 0;
    EXPECT_GE(seen, 1) << x;
  }
}

// However few numbers have room, they are at even distances and the last one has the unit.
TEST(Overlay, NumbersAlongTheTableAreEvenAndHaveTheirUnit) {
  const MachineBodies bodies = machineBodies(mill());
  for (const double width : {90.0, 130.0, 180.0, 260.0, 420.0}) {
    const QSizeF size(width, width);
    Camera camera;
    camera.look(StandardView::Top);
    camera.fit(bodies.table_low_mm, bodies.table_high_mm, size);
    std::vector<double> along_x;
    bool unit = false;
    const auto texts = tableScale(camera, size, bodies);
    for (const OverlayText& text : texts) {
      const auto bottom = camera.project(bodies.table_low_mm, size);
      if (text.box.center().y() < bottom->y()) continue;
      unit = unit || text.text.endsWith(QStringLiteral(" mm"));
      along_x.push_back(text.text.section(QLatin1Char(' '), 0, 0).toDouble());
    }
    ASSERT_GE(along_x.size(), 1U) << width;
    EXPECT_TRUE(unit) << width;
    for (std::size_t k = 2; k < along_x.size(); ++k)
      EXPECT_NEAR(along_x[k] - along_x[k - 1], along_x[1] - along_x[0], 1e-9) << width;
  }
}

// Holes are touched some millimetres below the face of their bar: a table above them would hide their map.
TEST_F(ViewToolsTest, TheTableLiesUnderAllThatWasMeasured) {
  Field under;
  under.grid = {0, 300, 0, 200, -3, 2, 2};
  under.value = {5, 5, 5, 5};
  under.sigma = {0.1, 0.1, 0.1, 0.1};
  view_.setPoints({});
  view_.setMachine(mill());
  view_.lookAtMap();
  view_.setColourScale(ColourScale::symmetric(5, QStringLiteral("EX"), QStringLiteral("um")));
  view_.setField(std::make_shared<const Field>(under), {});
  ViewPoint point;
  point.id = QStringLiteral("H1");
  point.position_mm = {20, 20, -3};
  view_.setPoints({point});
  const QImage picture = view_.grab().toImage();
  const QColor middle = picture.pixelColor(view_.pixelOf({150, 100, -3})->toPoint());
  EXPECT_GT(middle.red(), middle.blue() + 60) << middle.name().toStdString();
}

TEST_F(ViewToolsTest, AMapIsFacedWhicheverWayItStands) {
  Field standing;
  standing.grid = {0, 300, 0, 200, 50, 2, 2};
  standing.grid.normal_axis = 1;
  standing.value = {1, 2, 3, 4};
  standing.sigma = {0.1, 0.1, 0.1, 0.1};
  view_.lookAtMap();
  EXPECT_NEAR(std::abs(view_.camera().forward().z()), 1.0, 1e-9);
  (void)view_.grab();
  view_.setField(std::make_shared<const Field>(standing), {});
  EXPECT_NEAR(std::abs(view_.camera().forward().y()), 1.0, 1e-9) << "it came later";
  (void)view_.grab();
  Camera moved = view_.camera();
  moved.turn(0.3, 0.2);
  view_.setCamera(moved);
  view_.setField(nullptr, {});
  EXPECT_EQ(view_.camera(), moved) << "whoever has moved the camera keeps it";
}

// Text is painted with its whole box inside: a picture with a frame around it stays clean.
TEST(Overlay, LabelsNeverLeaveThePane) {
  const MachineBodies bodies = machineBodies(mill());
  constexpr int frame = 60;
  const QSizeF size(360, 260);
  for (const double azimuth : {-1.57, -0.9, 0.4, 2.2}) {
    for (const double zoom : {1.0, 1.7, 4.0}) {
      Camera camera;
      camera.look(StandardView::Isometric);
      camera.azimuth_rad = azimuth;
      camera.fit(bodies.table_low_mm, bodies.table_high_mm, size);
      camera.zoom(zoom, QPointF(200, 120), size);
      QImage image(static_cast<int>(size.width()) + 2 * frame, static_cast<int>(size.height()) + 2 * frame,
                   QImage::Format_RGB32);
      image.fill(Qt::magenta);
      const QImage clean = image;
      QPainter painter(&image);
      painter.translate(frame, frame);
      paintTableScale(painter, camera, size, bodies);
      painter.end();
      const QRect inside(frame, frame, static_cast<int>(size.width()), static_cast<int>(size.height()));
      int outside = 0;
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x)
          outside += !inside.contains(x, y) && image.pixel(x, y) != clean.pixel(x, y) ? 1 : 0;
      }
      EXPECT_EQ(outside, 0) << azimuth << ' ' << zoom;
    }
  }
}

}  // namespace
}  // namespace spindrift::gui
