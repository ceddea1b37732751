// SPDX-License-Identifier: Apache-2.0
// The error parameters of FORMATS.md: one table of what they are called and what they mean, for pages, reports, the
// command line and the manual.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace spindrift {

/// One error parameter. Rotations and displacements are those of the tool relative to the table in MCF, unless the
/// meaning says otherwise.
struct ErrorParameter {
  std::string name;        ///< as in files: "hX_urad"
  std::string symbol;      ///< as printed: "hX", "αX"
  std::string iso_symbol;  ///< of ISO 230-1:2012 ("EA0S"); empty where the standard has none
  std::string unit;        ///< as in files, "/" for "per": "um", "urad", "um/m"
  std::string meaning;     ///< one line, English

  /// "hX (EA0S)": as printed, with the symbol of ISO 230-1 where that is another one.
  [[nodiscard]] std::string symbolWithIso() const;
};

/// All of them: six errors at the origin of the table, six of each linear axis, squareness, hole artefact, ball
/// artefact, expansion of the nine-parameter model.
[[nodiscard]] std::span<const ErrorParameter> errorParameters();

/// The one that files call `name`; null if there is none.
[[nodiscard]] const ErrorParameter* errorParameter(std::string_view name);

/// The same with symbol and unit as its name says, and no meaning, for a name that is not known ("EX0A_um").
[[nodiscard]] ErrorParameter describedParameter(std::string_view name);

/// Its meaning ("EC0C_urad" -> "rotation of the table about Z"), empty for a name that is not known.
[[nodiscard]] std::string parameterMeaning(std::string_view name);

}  // namespace spindrift
