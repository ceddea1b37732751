// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/camera.h"

#include <gtest/gtest.h>

#include <QRectF>
#include <string>

#include "core/base/json_reader.h"
#include "core/machine/machine_description.h"
#include "widgets/view3d/machine_bodies.h"

namespace spindrift::gui {
namespace {

constexpr double tiny = 1e-9;
const QSizeF picture(800, 600);

// The top view has X to the right and Y up, as on a drawing.
TEST(Camera, TopViewShowsTheTableAsDrawn) {
  Camera camera;
  camera.look(StandardView::Top);
  EXPECT_NEAR((camera.right() - Eigen::Vector3d::UnitX()).norm(), 0, tiny);
  EXPECT_NEAR((camera.up() - Eigen::Vector3d::UnitY()).norm(), 0, tiny);
}

// Front of a horizontal machine: X to the right, Y up.
TEST(Camera, FrontViewOfAHorizontalMachine) {
  Camera camera;
  camera.vertical = Eigen::Vector3d::UnitY();
  camera.look(StandardView::Front);
  EXPECT_NEAR((camera.up() - Eigen::Vector3d::UnitY()).norm(), 0, tiny);
  EXPECT_NEAR(std::abs(camera.right().x()), 1, tiny);
}

// Nothing stands between the viewer and what measures: the column is behind the spindle, the spindle over the table.
TEST(Camera, ColumnStandsBehindTheSpindleOfEitherKindOfMachine) {
  for (const char* chain : {"V [w-X'-Y'-b-Z-(C)-t]", "H [w-Z'-b-X-Y-(C)-t]"}) {
    const std::string text = std::string(R"({"format":"spindrift-machine","version":1,"name":"m","chain":")") + chain +
                             R"(","axes":[{"name":"X","travel_mm":[0,500]},{"name":"Y","travel_mm":[0,500]},
{"name":"Z","travel_mm":[0,500]}]})";
    const MachineBodies bodies =
        machineBodies(MachineDescription::parse(JsonNode::parse(text, "machine.json"), "machine.json"), 0.0);
    Camera camera;
    camera.vertical = bodies.vertical;
    camera.look(StandardView::Isometric);
    const auto depthOf = [&](BodyKind kind) {
      for (const auto& body : bodies.bodies)
        if (body.kind == kind) return camera.depth_mm(0.5 * (body.low_mm + body.high_mm));
      ADD_FAILURE() << chain;
      return 0.0;
    };
    EXPECT_LT(depthOf(BodyKind::Spindle), depthOf(BodyKind::Column)) << chain;
    EXPECT_LT(depthOf(BodyKind::Table), depthOf(BodyKind::Column)) << chain;
  }
}

TEST(Camera, ZoomKeepsWhatIsUnderTheCursor) {
  for (const bool orthographic : {true, false}) {
    Camera camera;
    camera.orthographic = orthographic;
    const QPointF cursor(210, 455);
    const auto before =
        camera.meetPlane(cursor, picture, -camera.forward(), -camera.forward().dot(camera.focal_point_mm));
    ASSERT_TRUE(before);
    camera.zoom(1.7, cursor, picture);
    const auto after = camera.project(*before, picture);
    ASSERT_TRUE(after);
    EXPECT_NEAR(after->x(), cursor.x(), 1e-6);
    EXPECT_NEAR(after->y(), cursor.y(), 1e-6);
  }
}

TEST(Camera, PixelToPlaneAndBack) {
  for (const bool orthographic : {true, false}) {
    Camera camera;
    camera.orthographic = orthographic;
    camera.turn(0.4, 0.2);
    const auto p = camera.meetPlane(QPointF(333, 222), picture, Eigen::Vector3d::UnitZ(), 12.5);
    ASSERT_TRUE(p);
    EXPECT_NEAR(p->z(), 12.5, tiny);
    const auto back = camera.project(*p, picture);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->x(), 333, 1e-6);
    EXPECT_NEAR(back->y(), 222, 1e-6);
  }
}

TEST(Camera, FitShowsEveryCorner) {
  Camera camera;
  const Eigen::Vector3d low(-20, 10, 0);
  const Eigen::Vector3d high(400, 90, 300);
  for (const auto view : {StandardView::Isometric, StandardView::Top, StandardView::Front, StandardView::Right}) {
    camera.look(view);
    camera.fit(low, high, picture);
    for (const double x : {low.x(), high.x()}) {
      for (const double y : {low.y(), high.y()}) {
        for (const double z : {low.z(), high.z()}) {
          const auto p = camera.project({x, y, z}, picture);
          ASSERT_TRUE(p);
          EXPECT_TRUE(QRectF(QPointF(0, 0), picture).contains(*p));
        }
      }
    }
  }
}

// A plane f = x - 30 crosses zero on the straight line x = 30.
}  // namespace
}  // namespace spindrift::gui
