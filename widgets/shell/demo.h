// SPDX-License-Identifier: GPL-3.0-or-later
// The demo campaigns of the virtual machine, offered on the first screen and walked through by the tour.
#pragma once

#include <QString>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/job_context.h"

namespace spindrift::gui {

struct Demo {
  std::string name;      ///< "fiducials": for the command line and folder names
  std::string scenario;  ///< file in resources/scenarios, without its ending
  QString title;
  QString sentence;
  const char* icon;
  bool on_first_screen = true;  ///< else in the menu only
};

/// In the language of the window at this time.
[[nodiscard]] std::vector<Demo> demos();
/// Makes the campaign of a demo in a folder that does not exist yet. `small`: fewer and smaller images and clouds, for
/// tour and tests.
void makeDemoCampaign(const std::string& name, const std::filesystem::path& folder, bool small, JobContext& job);
/// What the virtual machine hides in that demo (simulate --truth): nothing of it is in the campaign.
[[nodiscard]] nlohmann::json demoTruth(const std::string& name, bool small, JobContext& job);

}  // namespace spindrift::gui
