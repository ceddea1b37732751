// SPDX-License-Identifier: GPL-3.0-or-later
// The options of every command that draws: --svg, --png and --pdf, of the same figure.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

#include "core/reporting/drawing.h"

namespace spindrift::cli {

struct PictureFiles {
  std::string svg;
  std::string png;
  std::string pdf;

  /// `what` is drawn: "the diagrams".
  void addTo(CLI::App& command, std::string_view what);
  [[nodiscard]] bool wanted() const { return !svg.empty() || !png.empty() || !pdf.empty(); }
  /// A line for people for each file that was written. Throws InputError.
  std::string write(const Drawing& drawing) const;
};

}  // namespace spindrift::cli
