// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/scanning/artefact_designer.h"

#include <gtest/gtest.h>

#include <QDoubleSpinBox>
#include <QTest>
#include <filesystem>

#include "tests/support/temp_folder.h"
#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

double sigma(const ArtefactDesigner& designer, int component, int column) {
  return designer.sigmas()
      ->rows()[static_cast<std::size_t>(component)]
      .cells[static_cast<std::size_t>(column)]
      .text.toDouble();
}

TEST(ArtefactDesigner, ShowsWhatTheSurfaceTellsUnderEitherScanModel) {
  ArtefactDesigner designer;
  designer.show();
  ASSERT_EQ(designer.sigmas()->rowCount(), 6);
  EXPECT_EQ(designer.verdict()->tone(), Tone::Good);
  EXPECT_NEAR(sigma(designer, 0, 1), 0.0021, 0.0008) << "EX, um";
  EXPECT_GT(sigma(designer, 3, 2), 5.0 * sigma(designer, 3, 1)) << "pitch is seen far less well under push_broom";
  EXPECT_GT(designer.weak()->rowCount(), 0);
  EXPECT_FALSE(designer.view()->empty());
  ASSERT_TRUE(QTest::qWaitFor([&] { return designer.view()->camera().half_height_mm < 60.0; }, 2000))
      << "an artefact of 41 mm fills the picture";
  // Twice the noise, twice the uncertainty; a moment after the last change.
  const double before = sigma(designer, 0, 1);
  designer.number("noise")->setValue(1.0);
  ASSERT_TRUE(QTest::qWaitFor([&] { return sigma(designer, 0, 1) > 1.9 * before; }, 20000));
}

TEST(ArtefactDesigner, MarksWhatIsTooSteepAndSaysWhatIsFree) {
  ArtefactDesigner designer;
  designer.number("amplitude x")->setValue(4.0);  // slope 2.4
  designer.recompute();
  EXPECT_EQ(designer.verdict()->tone(), Tone::Attention);
  EXPECT_TRUE(designer.verdict()->sentence().contains(QStringLiteral("too steep")))
      << designer.verdict()->sentence().toStdString();
  QTest::mouseClick(designer.colouring()->button(1), Qt::LeftButton);
  EXPECT_EQ(designer.view()->colourScale()->high, 20.0) << "% over the limit";
  // A plane: the profiler sees all of it and it tells little.
  designer.number("amplitude x")->setValue(0.0);
  designer.number("amplitude y")->setValue(0.0);
  designer.recompute();
  EXPECT_TRUE(designer.verdict()->sentence().contains(QStringLiteral("EX")))
      << designer.verdict()->sentence().toStdString();
  EXPECT_EQ(designer.sigmas()->rows()[0].cells[1].tone, Tone::Attention);
}

TEST(ArtefactDesigner, WritesTheBodyForMilling) {
  const testing::TempFolder folder;
  ArtefactDesigner designer;
  designer.chooseSurface(1);
  EXPECT_EQ(designer.surface().bumps.size(), 2U);
  designer.number("step")->setValue(0.5);
  designer.writeStl(folder / "a.stl");
  EXPECT_GT(std::filesystem::file_size(folder / "a.stl"), 100000U);
}

}  // namespace
}  // namespace spindrift::gui
