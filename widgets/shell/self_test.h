// SPDX-License-Identifier: GPL-3.0-or-later
// What a user runs after installing: all demos through the real window, held against what the virtual machine hides.
#pragma once

#include <QString>
#include <nlohmann/json.hpp>
#include <vector>

namespace spindrift::gui {

class MainWindow;

/// One part of the self-test.
struct SelfTestPart {
  QString name;  ///< "fiducials"
  bool passed = false;
  QString sentence;  ///< what was found, with numbers
  nlohmann::json figures = nlohmann::json::object();
};

struct SelfTestResult {
  std::vector<SelfTestPart> parts;  ///< the demos, and "memory": at most 1 GB in use after all of them
  double memory_MB = 0.0;           ///< after all demos; 0 where the system does not tell
  double peak_memory_MB = 0.0;
  [[nodiscard]] bool passed() const;
  [[nodiscard]] nlohmann::json json() const;
};

/// Runs every step of every demo in `window`. Measuring demos pass if at least 95 % of the deviations lie within three
/// stated standard uncertainties of the truth; the discrepancy demo passes if the hidden cause is named or among the
/// rivals of what is named.
[[nodiscard]] SelfTestResult runSelfTest(MainWindow& window);

}  // namespace spindrift::gui
