// SPDX-License-Identifier: GPL-3.0-or-later
// The higher-order model is chosen by evidence, on the page as by `fit`: offered where the table bends, not where nine
// parameters are enough.
#include "widgets/pages/kinematics/nine_parameter_page.h"

#include <fmt/format.h>

#include <QCheckBox>
#include <QComboBox>
#include <QTableView>
#include <cmath>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/machine/nine_parameter_model.h"
#include "core/machine/observation.h"
#include "tests/widgets/support/page_test.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/theme/numbers.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

class NineParameterPageTest : public PageTest {
 protected:
  /// 5 x 4 points; a linear field, and a table that bends along X by `bend_um` at its ends.
  std::filesystem::path campaign(double bend_um) {
    std::string points;
    ObservationSet set;
    Random random(5);
    for (const char* state : {"M0", "M1"}) {
      const bool warm = std::string(state) == "M1";
      for (int i = 0; i < 20; ++i) {
        const Eigen::Vector3d at(40.0 + 80.0 * (i % 5), 30.0 + 90.0 * (i / 5), 0.0);
        if (warm)
          points += fmt::format(R"({}{{"id":"F{}","kind":"fiducial","x_mm":{},"y_mm":{},"z_mm":0}})", i > 0 ? "," : "",
                                i + 1, at.x(), at.y());
        for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
          Observation o;
          o.time_s = warm ? 3600.0 : 0.0;
          o.state = state;
          o.point = fmt::format("F{}", i + 1);
          o.position_mm = at;
          o.component = c;
          o.sigma = 0.5;
          o.instrument = "microscope";
          const double u = (at.x() - 200.0) / 160.0;
          if (warm)
            o.value = 4.0 + 0.01 * at.x() + (c == Component::EZ ? bend_um * u * u : 0.0) + random.normal(0, 0.5);
          set.rows.push_back(o);
        }
      }
    }
    const std::string name = fmt::format("bend_{:.0f}", bend_um);
    std::filesystem::create_directories(folder_ / name);
    folder_.write(name + "/campaign.json",
                  R"({"format":"spindrift-campaign","version":1,"name":"table","start_utc":"2026-03-01T08:00:00Z"})");
    folder_.write(
        name + "/machine.json",
        R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-t]","axes":[)"
        R"({"name":"X","travel_mm":[0,400]},{"name":"Y","travel_mm":[0,330]},{"name":"Z","travel_mm":[0,300]}],)"
        R"("spindle":{"axis":"Z","max_rpm":6000},"points":[)" +
            points + "]}");
    set.write(folder_ / name / "observations.csv");
    return folder_ / name;
  }
  /// The table that lists the parameters: rows of the model behind it.
  static int parameterRows(const NineParameterPage& page) {
    for (const QTableView* table : page.findChildren<QTableView*>())
      if (table->accessibleName() == QStringLiteral("Parameters")) return table->model()->rowCount();
    return -1;
  }
  static double largestEZ(const NineParameterPage& page) {
    const Field* field = page.field();
    if (field == nullptr) return std::nan("");
    double largest = 0.0;
    for (const double v : field->value) largest = std::max(largest, std::abs(v));
    return largest;
  }
};

TEST_F(NineParameterPageTest, ShowsTheDifferencesThatAreFitted) {
  // Half of the noise of a component is shared by all readings of a session: it cancels in the change of a state.
  const std::filesystem::path folder = campaign(0.0);
  ObservationSet set = ObservationSet::read(folder / "observations.csv");
  for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
    SharedNoise::Factor factor;
    for (std::size_t i = 0; i < set.rows.size(); ++i)
      if (set.rows[i].component == c) factor.push_back({i, 0.4});
    set.shared.addFactor(std::move(factor));
  }
  set.write(folder / "observations.csv");
  open(folder);
  auto* page = go<NineParameterPage>(StepId::Model);
  ASSERT_NE(page, nullptr);
  press();
  const QTableView* points = nullptr;
  for (const QTableView* table : page->findChildren<QTableView*>())
    if (table->accessibleName() == QStringLiteral("Points")) points = table;
  ASSERT_NE(points, nullptr);
  const NineParameterFit fit = fitNineParameters(*window_->session().observations());
  ASSERT_EQ(points->model()->rowCount(), 20);
  int compared = 0;
  for (int row = 0; row < 20; ++row) {
    for (const NineParameterResidual& r : fit.residuals) {
      if (fromCore(r.point) != points->model()->index(row, 0).data().toString()) continue;
      const int column = 3 + static_cast<int>(r.component) - static_cast<int>(Component::EX);
      EXPECT_EQ(points->model()->index(row, column).data().toString(),
                shownNumbers(fromCore(withUncertainty(r.value_um, r.sigma_um, ""))).trimmed());
      EXPECT_NEAR(r.sigma_um, std::sqrt(2.0) * 0.3, 1e-3) << "not the root of the sum of both squares, 0.71";
      ++compared;
    }
  }
  EXPECT_EQ(compared, 60);
}

TEST_F(NineParameterPageTest, OffersTheHigherOrderWhereTheEvidenceAsksForIt) {
  open(campaign(12.0));
  auto* page = go<NineParameterPage>(StepId::Model);
  ASSERT_NE(page, nullptr);
  press();
  ASSERT_TRUE(page->orderChoice().richer()) << page->orderChoice().reason;
  EXPECT_LT(page->orderChoice().probability_of_nine, 0.05);
  EXPECT_EQ(page->orderChoice().orders[0], 1) << "only what bends gets more terms";
  EXPECT_GE(page->orderChoice().orders[2], 2);
  EXPECT_TRUE(page->higherOrderBox()->isEnabled());
  EXPECT_FALSE(page->higherOrderBox()->isChecked()) << "offered, not taken";
  EXPECT_EQ(parameterRows(*page), page->orderChoice().parameters);
  EXPECT_FALSE(page->higherOrderBox()->toolTip().isEmpty());

  page->setComponent(2);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  const double nine = largestEZ(*page);
  page->higherOrderBox()->setChecked(true);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  const double higher = largestEZ(*page);
  EXPECT_GT(higher, nine + 3.0) << "the ends of the table bend up by 12 um, which a plane cannot follow";

  const auto stored = window_->session().result("fit");
  ASSERT_TRUE(stored);
  const nlohmann::json& order = stored->payload.at("higher_order");
  EXPECT_EQ(order.at("reason"), page->orderChoice().reason) << "stored as chosen";
}

TEST_F(NineParameterPageTest, TheStateThatIsShownIsTheOneThatIsFitted) {
  // Measured in passing: every point at a time of its own, which is a state of its own.
  const std::filesystem::path folder = campaign(0.0);
  ObservationSet set = ObservationSet::read(folder / "observations.csv");
  std::erase_if(set.rows, [](const Observation& o) { return o.state == "M0"; });
  for (Observation& o : set.rows) {
    o.state = "at " + o.point;
    o.time_s += 10.0 * std::stod(o.point.substr(1));
  }
  set.write(folder / "observations.csv");
  folder_.write("bend_0/campaign.json", R"({"format":"spindrift-campaign","version":1,"name":"table",)"
                                        R"("reference":"absolute","start_utc":"2026-03-01T08:00:00Z"})");
  open(folder);
  auto* page = go<NineParameterPage>(StepId::Model);
  ASSERT_NE(page, nullptr);
  const QComboBox* state = nullptr;
  for (const QComboBox* box : page->findChildren<QComboBox*>())
    if (box->accessibleName() == QStringLiteral("Thermal state to fit")) state = box;
  ASSERT_NE(state, nullptr);
  EXPECT_EQ(state->currentText(), QStringLiteral("all states together"));
  press();
  ASSERT_NE(page->fit(), nullptr);
  EXPECT_EQ(page->fit()->state, "all");
  EXPECT_EQ(state->currentData().toString(), fromCore(page->fit()->state));
}

TEST_F(NineParameterPageTest, KeepsToNineParametersWhereTheyAreEnough) {
  open(campaign(0.0));
  auto* page = go<NineParameterPage>(StepId::Model);
  ASSERT_NE(page, nullptr);
  press();
  EXPECT_FALSE(page->orderChoice().richer()) << page->orderChoice().reason;
  EXPECT_FALSE(page->higherOrderBox()->isEnabled());
  EXPECT_EQ(parameterRows(*page), 9);
  EXPECT_FALSE(page->orderChoice().reason.empty());
}

}  // namespace
}  // namespace spindrift::gui
