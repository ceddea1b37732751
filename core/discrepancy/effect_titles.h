// SPDX-License-Identifier: Apache-2.0
// What people call the effects of the catalogue, for reports, command line and window; each effect says it itself.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace spindrift {

/// The pattern is one of a fixed set, so that a window can translate it; "%1" stands for `subject`.
struct EffectTitle {
  std::string_view pattern;
  std::string subject;  ///< axis or point; empty where the pattern has no %1
};

/// "ball_screw.expansion.y" -> {"thermal expansion of the %1 ball screw", "Y"}; nothing for what is no id of the
/// catalogue.
[[nodiscard]] std::optional<EffectTitle> effectTitleOf(std::string_view id);

/// "thermal expansion of the Y ball screw"; an id that is not known stays as it is.
[[nodiscard]] std::string effectTitle(std::string_view id);

/// The pattern with its subject in place of "%1".
[[nodiscard]] std::string titleText(std::string_view pattern, std::string_view subject);

}  // namespace spindrift
