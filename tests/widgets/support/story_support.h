// SPDX-License-Identifier: GPL-3.0-or-later
// A small campaign with a simulation that lacks something, and the real window on it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/temp_folder.h"
#include "widgets/shell/main_window.h"

namespace spindrift::gui {

/// What the simulation lacks.
enum class Hidden { Nothing, SpindleGrowth, Oscillation };

/// How much is measured over the eight hours.
struct StorySize {
  int states = 24;
  int log_rows = 480;
};

/// Six points in a volume, 24 states over eight hours, a spindle that runs in two steps; the last quarter is held
/// out. The growth is 9 um (1 - exp(-t / 40 min)) at full speed along Z; the oscillation has no driver (EX, 23 min).
/// Noise 0.4 um, seeded.
[[nodiscard]] std::filesystem::path writeStoryCampaign(const testing::TempFolder& folder, Hidden hidden,
                                                       bool with_simulation = true, StorySize size = {});

class StoryTest : public ::testing::Test {
 protected:
  void SetUp() override;
  /// Takes the sessions that were made for the test away again.
  void TearDown() override;
  /// Opens the campaign and goes to the step.
  void open(const std::filesystem::path& campaign, StepId step);
  template <class PageType>
  [[nodiscard]] PageType* page() {
    return qobject_cast<PageType*>(window_->currentPage());
  }
  void wait();
  /// Every step of the demo, run, and each of the tabs of its page: `look` is called with the name of what is shown.
  void walk(const QString& demo, const std::function<void(const std::string& what)>& look);

  testing::TempFolder folder_;
  std::vector<std::filesystem::path> sessions_;
  std::unique_ptr<MainWindow> window_;
};

}  // namespace spindrift::gui
