// SPDX-License-Identifier: GPL-3.0-or-later
// What the user has decided about effects: which are in the model, which are not to be considered, and effects of the
// user's as edited. Kept in the session as one option of the campaign, so that it can be undone; results that depend on
// it keep it with their options.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "widgets/models/session_model.h"

namespace spindrift::gui {

struct DiscrepancyChoice {
  std::vector<std::string> added;
  std::vector<std::string> rejected;
  /// effects.json as edited, in place of the one that campaign.json names (which is never altered); null: that one.
  nlohmann::json effects;

  [[nodiscard]] static DiscrepancyChoice of(const SessionModel& session);
  [[nodiscard]] static std::string key(const SessionModel& session);
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] bool considers(const std::string& id) const;
  /// Takes an effect out of both lists, or puts it into one.
  void consider(const std::string& id, bool considered);

  /// The campaign with the effects as edited, which are put down in the folder of the session. Any thread.
  [[nodiscard]] std::shared_ptr<const Campaign> applied(std::shared_ptr<const Campaign> campaign,
                                                        const std::filesystem::path& file) const;
  /// That file, for the campaign at hand.
  [[nodiscard]] static std::filesystem::path file(const SessionModel& session);
};

}  // namespace spindrift::gui
