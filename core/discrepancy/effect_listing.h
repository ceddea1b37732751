// SPDX-License-Identifier: Apache-2.0
// A list of effects for people and for other programs: of the catalogue, of one machine, with the user's own. Keys as
// in effects.json, so that an entry can be taken as a start for an effect of one's own.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/discrepancy/own_effects.h"

namespace spindrift {

/// What an effect is called: its title with its subject.
[[nodiscard]] std::string titleOf(const Effect& effect);

/// Alternatives of inputs that act together, by the names of the drivers; each once. Empty: nothing drives it.
[[nodiscard]] std::vector<std::vector<std::string>> driversOf(const Effect& effect);

/// "none", "lag", "asymmetric_lag", "step", "pulse": the widest of its ways.
[[nodiscard]] std::string dynamicsOf(const Effect& effect);

/// `own`: where expressions of the user's effects come from; may be null.
[[nodiscard]] nlohmann::json effectsJson(const std::vector<Effect>& effects, const OwnEffects* own);
[[nodiscard]] std::string effectsText(const std::vector<Effect>& effects);

}  // namespace spindrift
