// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reporting/effect_drawing.h"

#include <gmock/gmock.h>

#include <cmath>

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Effect effectOf(ShapeFunction value, std::string unit = "um") {
  Effect effect;
  effect.id = "one";
  ShapeColumn column;
  column.gain_unit = std::move(unit);
  column.value = std::move(value);
  effect.shape.push_back(std::move(column));
  return effect;
}

TEST(EffectDrawing, ViewsArePlanesThroughTheMiddleAndColouredByWhatIsOutOfThem) {
  // A bend over X that lifts: seen from above only as colour, from the front as a curve.
  const Effect bend = effectOf([](const DeviationQuery& q, Component c) {
    const double x = q.position_mm.x() / 250.0 - 1.0;
    return c == Component::EZ ? 3.0 * x * x : 0.0;
  });
  const auto shape = effectShape(bend, {});
  ASSERT_TRUE(shape);
  EXPECT_FALSE(shape->rotations);
  EXPECT_NEAR(shape->largest, 3.0, 1e-12);
  EXPECT_NEAR(shape->largest_out, 3.0, 1e-12);
  EXPECT_EQ(shape->limit(), 3.0);
  EXPECT_EQ(shape->colouredIn(shape->views[0]), Component::EZ);
  EXPECT_EQ(shape->views[0].nodes.front().at_mm, Eigen::Vector3d(0.0, 0.0, 200.0));
  EXPECT_EQ(shape->views[2].nodes.back().at_mm, Eigen::Vector3d(250.0, 500.0, 400.0));
  EXPECT_EQ(shape->views[2].nodes.back().deviation.z(), 0.0) << "the side view is at the middle of X";
  const std::string svg = svgOf(effectDrawing(*shape));
  for (const char* text : {"Top, colour EZ", "Front, colour EY", "Side, colour EX", "at most 3 µm", "−3"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_FALSE(effectShape(bend, {}, 1)) << "no such column";
  EXPECT_FALSE(effectShape(effectOf([](const DeviationQuery&, Component) { return 0.0; }), {}));
}

TEST(EffectDrawing, PolesAreLeftOutAndShortAxesStretched) {
  const Effect pole = effectOf(
      [](const DeviationQuery& q, Component c) { return c == Component::EA ? 1.0 / (q.position_mm.x() - 250.0) : 0.0; },
      "urad");
  EffectVolume volume;
  volume.travel_mm[2] = {0.0, 5.0};
  const auto shape = effectShape(pole, volume);
  ASSERT_TRUE(shape);
  EXPECT_TRUE(shape->rotations);
  EXPECT_LT(shape->largest, 1.0);
  const std::string svg = svgOf(effectDrawing(*shape));
  EXPECT_THAT(svg, HasSubstr("Rotation of the tool"));
  EXPECT_THAT(svg, HasSubstr("µrad"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(EffectDrawing, APointThatSlipsIsDrawnAlone) {
  const Effect slip =
      effectOf([](const DeviationQuery& q, Component c) { return q.point == "P2" && c == Component::EX ? 2.0 : 0.0; });
  EffectVolume volume;
  volume.points = {{"P1", "surface", {100.0, 100.0, 0.0}}, {"P2", "surface", {300.0, 200.0, 0.0}}};
  const auto shape = effectShape(slip, volume);
  ASSERT_TRUE(shape);
  EXPECT_TRUE(shape->one_point);
  EXPECT_EQ(shape->views[0].points[1].deviation.x(), 2.0);
  EXPECT_FALSE(effectShape(slip, {})) << "nothing moves where there is no point";
}

}  // namespace
}  // namespace spindrift
