// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/theme/theme.h"

namespace spindrift::gui {

/// Pixels of an exported picture for each one of the screen: fine enough for print.
inline constexpr double picture_ratio = 3.0;

/// While it lives pictures are drawn in the light colours, whatever the window shows: for export and print. No event
/// loop may run meanwhile.
class LightColours {
 public:
  LightColours();
  ~LightColours();
  LightColours(const LightColours&) = delete;
  LightColours& operator=(const LightColours&) = delete;

 private:
  ThemeKind before_;
};

}  // namespace spindrift::gui
