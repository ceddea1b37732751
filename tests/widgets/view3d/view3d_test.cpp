// SPDX-License-Identifier: GPL-3.0-or-later
// The 3D view on the offscreen platform: pictures are not empty, show what they should, and picking finds it again.
#include "widgets/view3d/view3d.h"

#include <gtest/gtest.h>

#include <QElapsedTimer>
#include <QSignalSpy>
#include <QTest>
#include <cmath>
#include <ctime>
#include <set>

#include "core/base/random.h"
#include "core/base/units.h"
#include "widgets/view3d/overlay.h"
#include "widgets/view3d/point_labels.h"

namespace spindrift::gui {
namespace {

MachineDescription desktopMill() {
  return MachineDescription::parse(
      JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-(C)-t]",
        "axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,130]},{"name":"Z","travel_mm":[0,150]}],
        "points":[{"id":"F1","kind":"fiducial","x_mm":20,"y_mm":15,"z_mm":0},
                  {"id":"F2","kind":"fiducial","x_mm":280,"y_mm":15,"z_mm":0},
                  {"id":"F3","kind":"fiducial","x_mm":280,"y_mm":115,"z_mm":0}]})",
                      "machine.json"),
      "machine.json");
}

std::shared_ptr<Field> tiltedField(int n) {
  auto field = std::make_shared<Field>();
  field->grid = {0, 300, 0, 130, 0, n, n};
  field->component = Component::EX;
  for (int iy = 0; iy < n; ++iy) {
    for (int ix = 0; ix < n; ++ix) {
      const double x = field->grid.x_mm(ix);
      field->value.push_back((x - 150) * 0.1);
      field->sigma.push_back(0.8);
      field->extrapolated.push_back(x < 20 || x > 280);
    }
  }
  return field;
}

std::vector<ViewPoint> eightPoints() {
  std::vector<ViewPoint> points;
  for (int i = 0; i < 8; ++i) {
    ViewPoint p;
    p.id = QStringLiteral("F%1").arg(i + 1);
    p.label = p.id;
    p.position_mm = {20.0 + 37 * i, i % 2 == 0 ? 20.0 : 110.0, 0};
    p.value = (p.position_mm.x() - 150) * 0.1;
    p.value_text = QStringLiteral("%1 um").arg(*p.value, 0, 'f', 1);
    points.push_back(p);
  }
  return points;
}

double distance(QRgb a, QRgb b) {
  return std::hypot(qRed(a) - qRed(b), qGreen(a) - qGreen(b), qBlue(a) - qBlue(b));
}

std::size_t coloursIn(const QImage& image) {
  std::set<QRgb> colours;
  for (int y = 0; y < image.height(); y += 3) {
    for (int x = 0; x < image.width(); x += 3) colours.insert(image.pixel(x, y));
  }
  return colours.size();
}

TEST(View3D, AnEmptyViewSaysWhatWillAppear) {
  View3D view;
  view.resize(500, 400);
  view.setEmptyText(QStringLiteral("Heat map"), QStringLiteral("Fit the model to see it here."));
  const QImage picture = view.grab().toImage();
  EXPECT_GT(coloursIn(picture), 10U);  // text is there
}

TEST(View3D, DrawsAMachine) {
  View3D view;
  view.resize(640, 480);
  view.setMachine(desktopMill());
  const QImage picture = view.grab().toImage();
  ASSERT_TRUE(view.failure().isEmpty()) << view.failure().toStdString();
  EXPECT_GT(coloursIn(picture), 60U);
  // The middle shows a body and not the background.
  EXPECT_GT(distance(picture.pixel(320, 240), theme().view_top.rgb()), 12);
}

TEST(View3D, HeatMapHasTheColoursOfItsValues) {
  View3D view;
  view.resize(700, 420);
  view.setMachine(desktopMill());
  view.setMachineVisible(false);
  const ColourScale scale = ColourScale::symmetric(15, QStringLiteral("EX"), QStringLiteral("um"));
  view.setColourScale(scale);
  FieldStyle style;
  style.contours = false;
  view.setField(tiltedField(50), style);
  view.resetCamera(StandardView::Top);
  const QImage picture = view.grab().toImage();
  for (const double x : {60.0, 100.0, 200.0, 250.0}) {
    const auto pixel = view.pixelOf({x, 47, 0});
    ASSERT_TRUE(pixel);
    const QRgb found = picture.pixel(pixel->toPoint());
    EXPECT_LT(distance(found, scale.rgb((x - 150) * 0.1)), 12) << x;
  }
  // Within the noise: faded, far from the full colour but near neutral.
  const auto middle = view.pixelOf({152, 47, 0});
  EXPECT_LT(distance(picture.pixel(middle->toPoint()), qRgb(230, 230, 230)), 40);
}

// The lines stand where the values are those of the ticks, and end where values are missing.
TEST(View3D, ContoursFollowTheValues) {
  auto field = tiltedField(31);
  field->sigma.clear();
  field->extrapolated.clear();
  for (int iy = 20; iy < 31; ++iy)
    for (int ix = 0; ix < 31; ++ix) field->value[field->grid.index(ix, iy)] = std::nan("");
  const ColourScale scale = ColourScale::symmetric(15, QStringLiteral("EX"), QStringLiteral("um"));
  QImage with, without;
  std::vector<QPoint> on, off, beyond;
  for (const bool contours : {true, false}) {
    View3D view;
    view.resize(700, 420);
    view.setMachine(desktopMill());
    view.setMachineVisible(false);
    view.setColourScale(scale);
    FieldStyle style;
    style.contours = contours;
    view.setField(field, style);
    view.resetCamera(StandardView::Top);
    (contours ? with : without) = view.grab().toImage();
    on.clear();
    off.clear();
    beyond.clear();
    for (const double tick : scale.ticks()) {
      const double x = 150 + 10 * tick;
      if (x < 10 || x > 290) continue;
      on.push_back(view.pixelOf({x, 40, 0})->toPoint());
      off.push_back(view.pixelOf({x + 9, 40, 0})->toPoint());
      beyond.push_back(view.pixelOf({x, 118, 0})->toPoint());
    }
  }
  const auto changedNear = [&](const QPoint& p) {
    for (int dx = -2; dx <= 2; ++dx)
      if (with.pixel(p + QPoint(dx, 0)) != without.pixel(p + QPoint(dx, 0))) return true;
    return false;
  };
  ASSERT_GE(on.size(), 5U);
  for (std::size_t i = 0; i < on.size(); ++i) {
    EXPECT_TRUE(changedNear(on[i])) << i;
    EXPECT_FALSE(changedNear(off[i])) << i;
    EXPECT_FALSE(changedNear(beyond[i])) << i;
  }
}

// What stands before an arrow hides it.
TEST(View3D, ArrowsAreCoveredByWhatStandsBeforeThem) {
  View3D view;
  view.setShapes({{ShapeKind::Sphere, {{0, 0, 0}}, 20.0, Tone::Neutral},
                  {ShapeKind::Path, {{-60, -60, -60}, {60, 60, 60}}, 1.0, Tone::Neutral}});
  view.resetCamera(StandardView::Front);
  const auto red = [&] {
    const QImage picture = view.picture({400, 300}, 1.0);
    int count = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const QColor c = picture.pixelColor(x, y);
        count += c.red() > c.green() + 60 && c.red() > c.blue() + 60 ? 1 : 0;
      }
    }
    return count;
  };
  const int none = red();
  const double length_um = 16e3;
  view.setArrows({{{-8, -30, 0}, {length_um, 0, 0}, Tone::Bad}}, 1.0);
  EXPECT_GT(red(), none + 60) << "before the ball";
  view.setArrows({{{-8, 30, 0}, {length_um, 0, 0}, Tone::Bad}}, 1.0);
  EXPECT_EQ(red(), none) << "behind the ball";
}

TEST(View3D, ASurfaceStandsInItsBoxAndTellsItsNodes) {
  View3D view;
  view.resize(640, 480);
  ViewSurface surface;
  surface.x = {150, 550, 1350};
  surface.y = {0, 30, 90};
  surface.x_title = QStringLiteral("Position / mm");
  surface.y_title = QStringLiteral("Time / min");
  surface.value_title = QStringLiteral("EXY / um");
  surface.value = {0, 0, 0, 4, -6, 8, 9, std::nan(""), -12};
  surface.sigma = {0, 0, 0, 2, 2, 2, 2, 2, 2};
  view.setColourScale(ColourScale::symmetric(12, QStringLiteral("EXY"), QStringLiteral("um")));
  view.setSurface(surface);
  EXPECT_FALSE(view.empty());
  const QImage picture = view.grab().toImage();
  ASSERT_TRUE(view.surfaceBox());
  const auto pixel = view.pixelOf(view.surfaceBox()->place_mm({550, 30, -6}));
  EXPECT_EQ(view.surfaceNodeAt(*pixel), surface.index(1, 1));
  // A node without a value is nowhere.
  for (int y = 0; y < 480; y += 5)
    for (int x = 0; x < 640; x += 5) EXPECT_NE(view.surfaceNodeAt(QPointF(x, y)), surface.index(1, 2));
  QSignalSpy hovered(&view, &View3D::hovered);
  QMouseEvent move(QEvent::MouseMove, *pixel, *pixel, Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&view, &move);
  ASSERT_FALSE(hovered.empty());
  EXPECT_EQ(hovered.back()[0].toString().toStdString(), "Position 550 mm, Time 30 min: −6.0 ± 2.0 µm");
  // Coloured by the scale: blue where it is low.
  const QColor low = picture.pixelColor(view.pixelOf(view.surfaceBox()->place_mm({1350, 90, -12}))->toPoint());
  EXPECT_GT(low.blue(), low.red() + 20);
  if (qEnvironmentVariableIsSet("SPINDRIFT_KEEP_PICTURES"))
    view.picture({640, 480}, 1.0)
        .save(qEnvironmentVariable("SPINDRIFT_KEEP_PICTURES") + QStringLiteral("/surface.png"));
  view.setSurface(std::nullopt);
  EXPECT_TRUE(view.empty());
}

TEST(View3D, ProbeReadsTheValueUnderTheCursor) {
  View3D view;
  view.resize(700, 420);
  view.setColourScale(ColourScale::symmetric(15, QStringLiteral("EX"), QStringLiteral("um")));
  view.setField(tiltedField(31));
  (void)view.grab();
  const auto pixel = view.pixelOf({200, 60, 0});
  const auto probe = view.probeAt(*pixel);
  ASSERT_TRUE(probe);
  EXPECT_NEAR(probe->value, 5.0, 1e-6);
  EXPECT_NEAR(probe->sigma, 0.8, 1e-9);
  EXPECT_FALSE(probe->extrapolated);
  EXPECT_FALSE(view.probeAt(QPointF(1, 1)));
  QSignalSpy hovered(&view, &View3D::hovered);
  QMouseEvent move(QEvent::MouseMove, *pixel, *pixel, Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&view, &move);
  ASSERT_GE(hovered.count(), 1);
  EXPECT_TRUE(hovered.last().front().toString().contains(QStringLiteral("µm")));
}

TEST(View3D, ClickPicksTheRightPoint) {
  View3D view;
  view.resize(640, 480);
  view.setMachine(desktopMill());
  view.setPoints(eightPoints());
  (void)view.grab();
  QSignalSpy picked(&view, &View3D::pointPicked);
  for (const ViewPoint& point : eightPoints()) {
    const auto pixel = view.pixelOf(point.position_mm);
    QTest::mouseClick(&view, Qt::LeftButton, Qt::NoModifier, pixel->toPoint());
    ASSERT_FALSE(picked.isEmpty());
    EXPECT_EQ(picked.last().front().toString(), point.id);
  }
  const int before = picked.count();
  QTest::mouseClick(&view, Qt::LeftButton, Qt::NoModifier, QPoint(3, 3));
  EXPECT_EQ(picked.count(), before);
}

TEST(View3D, DragTurnsShiftDragPansWheelZoomsKeyResets) {
  View3D view;
  view.resize(640, 480);
  view.setMachine(desktopMill());
  const QImage start = view.grab().toImage();
  const Camera home = view.camera();
  QTest::mousePress(&view, Qt::LeftButton, Qt::NoModifier, QPoint(300, 200));
  QTest::mouseMove(&view, QPoint(360, 230));
  QMouseEvent move(QEvent::MouseMove, QPointF(380, 240), QPointF(380, 240), Qt::NoButton, Qt::LeftButton,
                   Qt::NoModifier);
  QCoreApplication::sendEvent(&view, &move);
  QTest::mouseRelease(&view, Qt::LeftButton, Qt::NoModifier, QPoint(380, 240));
  EXPECT_NE(view.camera().azimuth_rad, home.azimuth_rad);
  EXPECT_NE(view.grab().toImage(), start);
  QTest::keyClick(&view, Qt::Key_Left);
  QTest::keyClick(&view, Qt::Key_Plus);
  EXPECT_LT(view.camera().half_height_mm, home.half_height_mm);
  QTest::keyClick(&view, Qt::Key_1);
  (void)view.grab();
  EXPECT_NEAR(view.camera().half_height_mm, home.half_height_mm, 1e-9);
  EXPECT_NEAR(view.camera().azimuth_rad, home.azimuth_rad, 1e-9);
}

TEST(View3D, KeysGoThroughThePoints) {
  View3D view;
  view.resize(640, 480);
  view.setPoints(eightPoints());
  QSignalSpy picked(&view, &View3D::pointPicked);
  QTest::keyClick(&view, Qt::Key_N);
  QTest::keyClick(&view, Qt::Key_N);
  QTest::keyClick(&view, Qt::Key_B);
  ASSERT_EQ(picked.count(), 3);
  EXPECT_EQ(picked[0].front().toString(), QStringLiteral("F1"));
  EXPECT_EQ(picked[1].front().toString(), QStringLiteral("F2"));
  EXPECT_EQ(picked[2].front().toString(), QStringLiteral("F1"));
}

/// Points on a square of 100 mm with values that grow with their number.
std::vector<ViewPoint> crowd(int count) {
  Random random(17);
  std::vector<ViewPoint> points;
  for (int i = 0; i < count; ++i) {
    ViewPoint p;
    p.id = p.label = QStringLiteral("F%1").arg(i + 1);
    p.position_mm = {random.uniform(0.0, 100.0), random.uniform(0.0, 100.0), 0.0};
    p.value = i;
    p.value_text = QStringLiteral("%1 um").arg(i);
    points.push_back(p);
  }
  return points;
}

Camera fromAbove(const QSizeF& size) {
  Camera camera;
  camera.look(StandardView::Top);
  camera.fit({0, 0, 0}, {100, 100, 0}, size);
  return camera;
}

TEST(PointLabels, CoverNothingAndTheImportantOnesAreThere) {
  const QSizeF small(320, 220);
  const auto points = crowd(40);
  const Camera camera = fromAbove(small);
  const QRectF bar(240, 0, 80, 220);
  const auto labels = placeLabels(camera, small, points, {QStringLiteral("F1"), QStringLiteral("F2"), {bar}});
  ASSERT_GT(labels.size(), 5U);
  ASSERT_LT(labels.size(), 40U) << "there is no room for all";
  EXPECT_EQ(labels[0].point->id, QStringLiteral("F1"));
  EXPECT_EQ(labels[1].point->id, QStringLiteral("F2"));
  EXPECT_EQ(labels[2].point->id, QStringLiteral("F40")) << "the largest value comes first of the others";
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EXPECT_TRUE(QRectF(QPointF(0, 0), small).contains(labels[i].box)) << i;
    if (i < 2) continue;  // the emphasised ones may cover a mark where nothing is free
    EXPECT_FALSE(labels[i].box.intersects(bar)) << i;
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(labels[i].box.intersects(labels[j].box)) << i << ' ' << j;
    for (const ViewPoint& p : points) {
      const QPointF mark = *camera.project(p.position_mm, small);
      EXPECT_FALSE(labels[i].box.contains(mark)) << i;
    }
  }
}

// Four points in a column, each with a value: a label next to another point would be read as that one's.
TEST(PointLabels, StandNearestToTheirOwnPoint) {
  for (const double apart_mm : {9.0, 12.0, 16.0}) {
    const QSizeF size(240, 240);
    std::vector<ViewPoint> points;
    for (int i = 0; i < 4; ++i) {
      ViewPoint p;
      p.id = p.label = QStringLiteral("A%1").arg(i + 1);
      p.position_mm = {50.0, 26.0 + apart_mm * i, 0.0};
      p.value = 7.8 - 0.5 * i;
      p.value_text = QStringLiteral("%1 ± 0.017 µm").arg(7.845 - 0.5 * i);
      points.push_back(p);
    }
    const Camera camera = fromAbove(size);
    const auto labels = placeLabels(camera, size, points, {});
    EXPECT_EQ(labels.size(), points.size()) << apart_mm;
    EXPECT_GE(std::count_if(labels.begin(), labels.end(), [](const PlacedLabel& l) { return l.with_value; }), 2)
        << apart_mm;
    for (const PlacedLabel& label : labels) {
      if (!label.with_value) continue;
      const auto distance = [&](const QPointF& mark) {
        return std::hypot(std::max({label.box.left() - mark.x(), 0.0, mark.x() - label.box.right()}),
                          std::max({label.box.top() - mark.y(), 0.0, mark.y() - label.box.bottom()}));
      };
      for (const ViewPoint& p : points) {
        const QPointF mark = *camera.project(p.position_mm, size);
        EXPECT_LE(distance(label.mark), distance(mark) + 2.0)
            << apart_mm << ": the label of " << label.point->id.toStdString() << " stands at " << p.id.toStdString();
      }
    }
  }
}

TEST(PointLabels, AllAreShownWithTheirValuesWhereThereIsRoom) {
  const QSizeF large(1400, 1200);
  const auto points = crowd(12);
  const auto labels = placeLabels(fromAbove(large), large, points, {});
  ASSERT_EQ(labels.size(), points.size());
  for (const PlacedLabel& label : labels) EXPECT_TRUE(label.with_value);
}

TEST(Notes, TakeNoMoreThanAThirdOfTheView) {
  const QStringList notes{QStringLiteral("EX of state M1 against M0"),
                          QStringLiteral("Arrows 1000 times larger than the deviation"),
                          QStringLiteral("Faded: within 2 standard uncertainties of zero")};
  const double line = notesPanel({notes[0], notes[1]}, 1000).height() - notesPanel({notes[0]}, 1000).height();
  EXPECT_EQ(wrappedNotes(notes, 1000, 400), notes);
  for (const double room : {60.0, 120.0, 400.0}) {
    for (const double height : {120.0, 200.0, 400.0}) {
      const QStringList lines = wrappedNotes(notes, room, height);
      ASSERT_FALSE(lines.isEmpty());
      const bool one = lines == wrappedNotes({notes[0]}, room, height);
      EXPECT_TRUE(one || line * static_cast<double>(lines.size()) <= height / 3) << room << " of " << height;
    }
  }
}

TEST(Notes, ThatComeAfterTheFitDoNotCoverTheMap) {
  View3D view;
  view.resize(480, 400);
  view.setMachine(desktopMill());
  view.setMachineVisible(false);
  view.setField(tiltedField(40), {});
  view.lookAtMap();
  view.show();
  QApplication::processEvents();
  (void)view.grab();
  QStringList notes;
  const auto mapTop = [&] {
    double top = 1e9;
    for (const double y : {0.0, 140.0})
      for (const double x : {0.0, 320.0})
        if (const auto pixel = view.pixelOf({x, y, 0})) top = std::min(top, pixel->y());
    return top;
  };
  const double before = mapTop();
  for (int line = 0; line < 6; ++line)
    notes << QStringLiteral("What arrows, colours and stripes mean, line %1").arg(line);
  const double bottom = notesPanel(wrappedNotes(notes, 340, 400), 340).bottom();
  ASSERT_GT(bottom, before) << "they would not cover it anyway";
  view.setCaption(notes.join(QLatin1Char('\n')));
  (void)view.grab();
  EXPECT_GT(mapTop(), bottom);
  // Who turned it has decided what is covered.
  Camera turned = view.camera();
  turned.half_height_mm *= 0.8;
  view.setCamera(turned);
  view.setCaption(notes.join(QLatin1Char('\n')) + QStringLiteral("\nOne more\nand one more"));
  (void)view.grab();
  EXPECT_TRUE(view.camera() == turned);
}

TEST(Notes, AreNotCoveredByAMapThatTheButtonsPushUp) {
  View3D view;
  view.resize(476, 485);
  view.setMachine(desktopMill());
  view.setMachineVisible(false);
  view.setColourScale(ColourScale::symmetric(15, QStringLiteral("EX"), QStringLiteral("um")));
  view.setField(tiltedField(50));
  const QStringList notes{QStringLiteral("EX of state M1 against M0"),
                          QStringLiteral("Arrows 1000 times larger than the deviation"),
                          QStringLiteral("Faded: within 2 standard uncertainties of zero"),
                          QStringLiteral("Striped: outside the measured points")};
  view.setCaption(notes.mid(0, 2).join(QLatin1Char('\n')));  // of the others it speaks itself
  view.lookAtMap();
  view.show();
  QApplication::processEvents();
  (void)view.grab();
  const auto box = view.extent();
  ASSERT_TRUE(box);
  EXPECT_GT(view.camera().frame(box->first, box->second, view.size()).top(), notesPanel(notes, 1000).bottom());
}

TEST(MachineBodies, RotaryAxesAreRoundBodiesWhereTheChainHasThem) {
  MachineDescription machine = desktopMill();
  const auto about = [&](const char* chain, const QString& part) {
    machine.chain = KinematicChain::parse(chain);
    for (const Body& body : machineBodies(machine).bodies) {
      if (body.name.contains(part)) return body.round_about;
    }
    return -2;
  };
  const char* five_axes = "V [w-C2'-A'-X'-b-Y-Z-(C1)-t]";
  EXPECT_EQ(about(five_axes, QStringLiteral("C2 turning")), 2);
  EXPECT_EQ(about(five_axes, QStringLiteral("A swivel")), 0);
  EXPECT_EQ(about(five_axes, QStringLiteral("X slide")), -1);
  EXPECT_EQ(about(five_axes, QStringLiteral("Spindle")), 2);
  EXPECT_EQ(about(five_axes, QStringLiteral("Table")), -1);
  EXPECT_EQ(about("V [w-X'-b-Y-Z-B-(C)-t]", QStringLiteral("B swivel")), 1);
  EXPECT_EQ(about("V [w-X'-b-Y-Z-(C)-t]", QStringLiteral("swivel")), -2) << "the spindle is no swivel";
  EXPECT_EQ(about("H [w-B'-X'-b-Y-Z-(C)-t]", QStringLiteral("B turning")), 1);
  EXPECT_EQ(about("H [w-B'-X'-b-Y-Z-(C)-t]", QStringLiteral("Spindle")), 2);
}

TEST(View3D, AReliefOfNegativeValuesStandsOnTheTable) {
  View3D view;
  view.resize(640, 480);
  view.setMachine(desktopMill());
  view.setMachineVisible(false);
  auto field = tiltedField(31);
  for (double& v : field->value) v = -20.0 + 0.2 * v;  // -23 to -17 um
  field->extrapolated.assign(field->extrapolated.size(), false);
  view.setField(field, {2.0, 1000.0, false});
  ColourScale scale;
  scale.low = -24;
  scale.high = 24;
  view.setColourScale(scale);
  view.show();
  const QImage picture = view.picture({640, 480}, 1.0);
  int blue = 0;
  for (int y = 0; y < picture.height(); y += 2) {
    for (int x = 0; x < 540; x += 2) {
      const QColor c = picture.pixelColor(x, y);
      if (c.blue() > c.red() + 60) ++blue;
    }
  }
  EXPECT_GT(blue, 2000);
}

TEST(View3D, LinkedViewsLookTheSameWay) {
  View3D a, b;
  a.resize(300, 200);
  b.resize(300, 200);
  a.setMachine(desktopMill());
  b.setMachine(desktopMill());
  a.link(&b);
  (void)a.grab();
  QTest::keyClick(&a, Qt::Key_Left);
  EXPECT_EQ(a.camera(), b.camera());
  QTest::keyClick(&b, Qt::Key_Up);
  EXPECT_EQ(a.camera(), b.camera());
}

// At a scale of 1.5 a view begins in the middle of a pixel as often as not, and the top of it may be scrolled away.
TEST(View3D, PaintsEveryPixelAtAScaleOfOneAndAHalf) {
  QWidget window;
  window.resize(330, 230);
  View3D view(&window);
  view.setMachine(desktopMill());
  window.show();
  const QColor nothing(255, 0, 255);
  for (const QSize size : {QSize(300, 200), QSize(301, 201), QSize(243, 191)}) {
    for (int y = -60; y <= 3; ++y) {
      view.setGeometry(QRect(QPoint(y & 3, y), size));
      QImage picture((QSizeF(window.size()) * 1.5).toSize(), QImage::Format_RGB32);
      picture.setDevicePixelRatio(1.5);
      picture.fill(nothing);
      window.render(&picture);
      int left = 0;
      for (int row = 0; row < picture.height(); ++row)
        for (int x = 0; x < picture.width(); ++x) left += picture.pixel(x, row) == nothing.rgb() ? 1 : 0;
      ASSERT_EQ(left, 0) << "of a view of " << size.width() << " x " << size.height() << " at " << y;
    }
  }
}

// A layout comes to one view after the other, and a picture may be drawn in between.
TEST(View3D, LinkedViewsFollowTheirSizeOneAfterTheOther) {
  View3D a, b, alone;
  for (View3D* view : {&a, &b, &alone}) {
    view->resize(300, 200);
    view->show();
    view->setMachine(desktopMill());
    view->setMachineVisible(false);
    view->resetCamera(StandardView::Top);
  }
  a.link(&b);
  for (const QSize size : {QSize(300, 200), QSize(640, 300), QSize(420, 420)}) {
    for (View3D* view : {&a, &b, &alone}) {
      view->resize(size);
      (void)view->grab();
    }
    EXPECT_EQ(a.camera().half_height_mm, alone.camera().half_height_mm) << size.width();
    EXPECT_EQ(b.camera(), a.camera()) << size.width();
  }
}

TEST(View3D, AViewThatNobodyTurnedShowsEverythingAtEverySize) {
  View3D view;
  view.resize(700, 500);
  view.show();  // else the sizes come only with the first picture
  view.setMachine(desktopMill());
  view.setMachineVisible(false);
  view.resetCamera(StandardView::Top);
  (void)view.grab();
  const auto inside = [&] {
    for (const double x : {0.0, 300.0}) {
      const auto pixel = view.pixelOf({x, 65.0, 0.0});
      if (!pixel || pixel->x() < 0.0 || pixel->x() > view.width()) return false;
    }
    return true;
  };
  EXPECT_TRUE(inside());
  view.resize(260, 500);
  (void)view.grab();
  EXPECT_TRUE(inside());
  // Once it is turned it stays as the user left it.
  QTest::keyClick(&view, Qt::Key_Plus);
  const Camera chosen = view.camera();
  view.resize(700, 300);
  (void)view.grab();
  EXPECT_EQ(view.camera(), chosen);
}

TEST(View3D, AViewJoinsOthersOnlyIfTheyShowTheSameMachine) {
  MachineDescription larger = desktopMill();
  for (LinearAxis& axis : larger.axes) axis.travel_mm[1] *= 4.0;
  View3D same, other, joining;
  for (View3D* view : {&same, &other, &joining}) {
    view->resize(300, 200);
    view->show();
  }
  joining.link(&same);
  same.setMachine(desktopMill());
  (void)same.grab();
  QTest::keyClick(&same, Qt::Key_Left);
  joining.setMachine(desktopMill());
  (void)joining.grab();
  EXPECT_EQ(joining.camera(), same.camera()) << "turned as the one it joins";
  joining.setMachine(larger);
  (void)joining.grab();
  EXPECT_NE(joining.camera().half_height_mm, same.camera().half_height_mm) << "another machine needs another picture";
}

TEST(View3D, ALargeCloudIsDrawnBitByBitAndCompletes) {
  const std::size_t count = 1'600'000;
  auto xyz = std::make_shared<std::vector<float>>();
  auto scalar = std::make_shared<std::vector<float>>();
  Random random(5);
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(random.uniform(0, 300));
    xyz->push_back(x);
    xyz->push_back(static_cast<float>(random.uniform(0, 130)));
    xyz->push_back(static_cast<float>(random.uniform(0, 2)));
    scalar->push_back((x - 150) / 10 + static_cast<float>(random.normal(0, 3)));
  }
  View3D view;
  view.resize(640, 480);
  view.setColourScale(ColourScale::symmetric(15, QStringLiteral("EZ"), QStringLiteral("um")));
  view.setCloud({xyz, scalar, nullptr, 2.0});
  const QImage first = view.grab().toImage();
  EXPECT_TRUE(view.refining());
  EXPECT_TRUE(QTest::qWaitFor([&] { return !view.refining(); }, 20000));
  const QImage full = view.grab().toImage();
  EXPECT_NE(first, full);
  // Left is blue, right is red.
  const auto left = view.pixelOf({40, 65, 1});
  const auto right = view.pixelOf({260, 65, 1});
  const auto surplusOfRed = [&](const QPoint& at) {
    int sum = 0;
    for (int dy = -8; dy <= 8; ++dy) {
      for (int dx = -8; dx <= 8; ++dx)
        sum += qRed(full.pixel(at + QPoint(dx, dy))) - qBlue(full.pixel(at + QPoint(dx, dy)));
    }
    return sum;
  };
  EXPECT_LT(surplusOfRed(left->toPoint()), 0);
  EXPECT_GT(surplusOfRed(right->toPoint()), 0);
  const std::size_t i = 777'777;
  const Eigen::Vector3d p((*xyz)[3 * i], (*xyz)[3 * i + 1], (*xyz)[3 * i + 2]);
  const auto picked = view.cloudPointAt(*view.pixelOf(p));
  ASSERT_TRUE(picked);
  const Eigen::Vector3d q((*xyz)[3 * *picked], (*xyz)[3 * *picked + 1], (*xyz)[3 * *picked + 2]);
  EXPECT_LT((view.pixelOf(q)->toPoint() - view.pixelOf(p)->toPoint()).manhattanLength(), 4);
  // Under the cursor: the value with its uncertainty, if there is one.
  auto sigma = std::make_shared<std::vector<float>>(count, 3.0F);
  view.setCloud({xyz, scalar, sigma, 2.0});
  (void)view.grab();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !view.refining(); }, 20000));
  QSignalSpy hovered(&view, &View3D::hovered);
  const QPointF at = *view.pixelOf(p);
  QMouseEvent move(QEvent::MouseMove, at, at, Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&view, &move);
  ASSERT_FALSE(hovered.empty());
  EXPECT_TRUE(hovered.back()[0].toString().contains(QStringLiteral("± 3 µm")))
      << hovered.back()[0].toString().toStdString();
}

TEST(View3D, PictureOfAnyScaleAndBothThemes) {
  View3D view;
  view.resize(400, 300);
  view.setMachine(desktopMill());
  view.setPoints(eightPoints());
  (void)view.grab();
  const Camera before = view.camera();
  const QImage once = view.picture({600, 400}, 1.0);
  const QImage twice = view.picture({600, 400}, 2.0);
  EXPECT_EQ(once.size(), QSize(600, 400));
  EXPECT_EQ(twice.size(), QSize(1200, 800));
  EXPECT_EQ(view.camera(), before);
  auto& application = *static_cast<QApplication*>(QCoreApplication::instance());
  applyTheme(application, ThemeKind::Dark);
  const QImage dark = view.picture({600, 400}, 1.0);
  applyTheme(application, ThemeKind::Light);
  EXPECT_LT(qGray(dark.pixel(590, 5)), 80);
  EXPECT_GT(qGray(once.pixel(590, 5)), 200);
}

// Prints how long a heat map of 200 x 200 nodes with eight points takes (no assertion on the clock).
TEST(View3D, HeatMapTimes) {
  QElapsedTimer timer;
  timer.start();
  View3D view;
  view.resize(1280, 800);
  view.setMachine(desktopMill());
  view.setMachineVisible(false);
  view.setColourScale(ColourScale::symmetric(15, QStringLiteral("EX"), QStringLiteral("um")));
  view.setField(tiltedField(200));
  view.setPoints(eightPoints());
  (void)view.grab();
  const qint64 first = timer.restart();
  const std::clock_t cpu = std::clock();
  for (int i = 0; i < 10; ++i) {
    QTest::keyClick(&view, Qt::Key_Left);
    (void)view.grab();
  }
  std::printf(
      "heat map 200 x 200, eight points, 1280 x 800: first picture %lld ms, redraw %.1f ms (%.1f ms of processor "
      "time)\n",
      static_cast<long long>(first), static_cast<double>(timer.elapsed()) / 10,
      100.0 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC);
}

TEST(View3D, ShapesAreDrawnInTheSceneAndCountAsContent) {
  View3D view;
  view.setMachine(desktopMill());
  view.setMachineVisible(false);
  const QSize size(400, 300);
  const QImage before = view.picture(size, 1.0);
  view.setShapes({{ShapeKind::Sphere, {{150, 65, 20}}, 20.0, Tone::Bad},
                  {ShapeKind::Rod, {{40, 30, 0}, {40, 30, 60}}, 6.0, Tone::Accent},
                  {ShapeKind::Path, {{10, 10, 5}, {290, 120, 5}}, 1.0, Tone::Neutral}});
  EXPECT_EQ(view.shapes().size(), 3U);
  const QImage after = view.picture(size, 1.0);
  int changed = 0;
  for (int y = 0; y < size.height(); ++y) {
    for (int x = 0; x < size.width(); ++x) changed += before.pixel(x, y) != after.pixel(x, y) ? 1 : 0;
  }
  EXPECT_GT(changed, 300);
  // A view with nothing but shapes is not empty; without them it is.
  View3D alone;
  EXPECT_TRUE(alone.empty());
  alone.setShapes({{ShapeKind::Sphere, {{0, 0, 0}}, 5.0, Tone::Good}});
  EXPECT_FALSE(alone.empty());
  alone.clear();
  EXPECT_TRUE(alone.empty());
}

// A cloud so large that it is drawn bit by bit: what is added later must hide and be hidden as if drawn at once.
TEST(View3D, RefiningKeepsDepthsAndColours) {
  const ColourScale scale = ColourScale::symmetric(1.0, {}, QStringLiteral("um"));
  for (const int n : {200, 360}) {  // one part, several parts
    auto positions = std::make_shared<std::vector<float>>();
    auto values = std::make_shared<std::vector<float>>();
    for (const float value : {-1.0F, 1.0F}) {
      for (int i = 0; i < n * n; ++i) {
        const float x = 10.0F * static_cast<float>(i / n) / static_cast<float>(n);
        const float y = 10.0F * static_cast<float>(i % n) / static_cast<float>(n);
        // The second sheet lies above the first where y < 5 and below it elsewhere.
        positions->insert(positions->end(), {x, y, value > 0 ? 0.01F * (5.0F - y) : 0.0F});
        values->push_back(value);
      }
    }
    View3D view;
    view.setColourScale(scale);
    ViewCloud cloud;
    cloud.xyz_mm = positions;
    cloud.scalar = values;
    view.setCloud(cloud);
    view.resetCamera(StandardView::Top);
    const QImage picture = view.picture({500, 400}, 1.0);
    int low = 0, high = 0, mixed = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 100; x < 400; ++x) {  // beside the axes and the colour bar
        const QRgb c = picture.pixel(x, y) | 0xFF000000U;
        if (c == (scale.rgb(-1.0) | 0xFF000000U)) ++low;
        if (c == (scale.rgb(1.0) | 0xFF000000U)) ++high;
        if (std::max(qRed(c), qBlue(c)) - qGreen(c) > 90 && c != (scale.rgb(-1.0) | 0xFF000000U) &&
            c != (scale.rgb(1.0) | 0xFF000000U)) {
          ++mixed;
        }
      }
    }
    EXPECT_GT(low, 8000) << n;
    EXPECT_NEAR(static_cast<double>(low) / high, 1.0, 0.15) << n;
    EXPECT_LT(mixed, 50) << n;
  }
}

}  // namespace
}  // namespace spindrift::gui
