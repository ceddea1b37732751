// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/field.h"

#include <gmock/gmock.h>

#include "core/base/csv.h"

namespace spindrift {
namespace {

class Slope final : public ErrorModel {
 public:
  [[nodiscard]] std::string description() const override { return "ex = x / 10"; }
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& query, Component component) const override {
    return {component == Component::EX ? query.position_mm.x() / 10.0 : 0.0, 0.5};
  }
};

TEST(Field, EvaluatesTheModelAtTheNodesAndMarksExtrapolation) {
  FieldGrid grid{0.0, 100.0, 0.0, 50.0, 7.0, 11, 6};
  const Field field = evaluateField(Slope(), grid, Component::EX, {},
                                    {{0.0, 0.0}, {50.0, 0.0}, {50.0, 50.0}, {0.0, 50.0}, {25.0, 25.0}});
  EXPECT_DOUBLE_EQ(field.value[grid.index(10, 3)], 10.0);
  EXPECT_FALSE(field.extrapolated[grid.index(5, 5)]);
  EXPECT_TRUE(field.extrapolated[grid.index(6, 0)]);
  EXPECT_DOUBLE_EQ(field.largestMagnitude(), 10.0);
  const CsvTable table = CsvTable::parse(field.csv(), "field.csv");
  EXPECT_EQ(table.rowCount(), 66U);
  EXPECT_DOUBLE_EQ(table.numbers("x_mm")[10], 100.0);
  EXPECT_DOUBLE_EQ(table.numbers("z_mm")[0], 7.0);
  EXPECT_DOUBLE_EQ(table.numbers("value")[65], 10.0);
}

TEST(Field, HullOfPointLineAndSquare) {
  EXPECT_TRUE(insideHull(convexHull({{1.0, 2.0}}), {1.0, 2.0}));
  EXPECT_FALSE(insideHull(convexHull({{1.0, 2.0}}), {1.0, 2.1}));
  const auto line = convexHull({{0.0, 0.0}, {2.0, 2.0}, {1.0, 1.0}});
  EXPECT_TRUE(insideHull(line, {1.5, 1.5}));
  EXPECT_FALSE(insideHull(line, {3.0, 3.0}));
  EXPECT_EQ(convexHull({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}, {0.5, 0.0}}).size(), 4U);
  EXPECT_FALSE(insideHull({}, {0.0, 0.0}));
}

}  // namespace
}  // namespace spindrift
