// SPDX-License-Identifier: GPL-3.0-or-later
// Roles of temperature sensors on the page Machine: read from names, confirmed, applied and undone.
#include <QComboBox>
#include <QTabWidget>
#include <QTableWidget>

#include "tests/widgets/support/page_test.h"
#include "widgets/pages/machine/machine_page.h"

namespace spindrift::gui {
namespace {

class MachineSensorsTest : public PageTest {
 protected:
  MachinePage* page() {
    auto session = std::make_unique<Session>(Session::create(folder_ / "session"));
    const std::int64_t id =
        session->newCampaign("new", "2026-01-31T08:00:00Z",
                             R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",
        "axes":[{"name":"X","travel_mm":[0,400]},{"name":"Y","travel_mm":[0,400]},{"name":"Z","travel_mm":[0,400]}],
        "temperature_sensors":[{"name":"T_column_degC","place":"column front"},{"name":"T_broom_degC"},
                               {"name":"T_1_degC","role":"bed"}]})");
    window_->session().adopt(std::move(session), id);
    auto* machine = go<MachinePage>(StepId::Machine);
    machine->findChild<QTabWidget*>(QStringLiteral("machineTabs"))->setCurrentIndex(2);
    return machine;
  }
  static QComboBox* role(MachinePage* page, int row) {
    return qobject_cast<QComboBox*>(page->sensors()->cellWidget(row, 2));
  }
  [[nodiscard]] std::optional<SensorRole> stated(std::size_t sensor) const {
    return window_->session().campaign()->machine.temperature_sensors[sensor].role;
  }
  static void click(MachinePage* page, const QString& text) {
    for (auto* button : page->findChildren<QPushButton*>()) {
      if (button->text().trimmed() == text && button->isVisible()) QTest::mouseClick(button, Qt::LeftButton);
    }
  }
};

TEST_F(MachineSensorsTest, WhatWasReadIsShownConfirmedAndUndone) {
  MachinePage* machine = page();
  ASSERT_EQ(machine->sensors()->rowCount(), 3);
  EXPECT_EQ(role(machine, 0)->currentData().toString(), "column_front");
  EXPECT_EQ(role(machine, 1)->currentData().toString(), "other");
  EXPECT_EQ(role(machine, 2)->currentData().toString(), "bed");
  EXPECT_EQ(machine->sensors()->item(2, 3)->text(), "machine.json");
  EXPECT_NE(machine->sensors()->item(0, 3)->text(), "machine.json");
  // One is put right and applied: the others stay as they were read.
  role(machine, 1)->setCurrentIndex(static_cast<int>(SensorRole::Room));
  Q_EMIT role(machine, 1)->activated(role(machine, 1)->currentIndex());
  click(machine, QStringLiteral("Apply changes"));
  EXPECT_EQ(stated(1), SensorRole::Room);
  EXPECT_EQ(stated(0), std::nullopt);
  click(machine, QStringLiteral("Confirm all"));
  click(machine, QStringLiteral("Apply changes"));
  EXPECT_EQ(stated(0), SensorRole::ColumnFront);
  EXPECT_EQ(stated(2), SensorRole::Bed);
  EXPECT_EQ(window_->session().campaign()->machine.source["temperature_sensors"][0]["place"], "column front");
  window_->undoStack().undo();
  EXPECT_EQ(stated(0), std::nullopt);
  EXPECT_EQ(stated(1), SensorRole::Room);
}

}  // namespace
}  // namespace spindrift::gui
