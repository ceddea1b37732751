// SPDX-License-Identifier: Apache-2.0
// Effects of the user's: effects.json of FORMATS.md. An effect = drivers (columns of the log, powers allowed) x
// dynamics x shape (expressions of muParser in x, y, z (mm), c (rad), dirx, diry, dirz; um or urad for each unit of the
// gain).
//
// Drivers: temperatures count from the machine's reference temperature in absolute campaigns and from their first value
// otherwise, and are linear between rows; all other columns are taken as logged and hold until the next row. In an
// absolute campaign what follows a temperature through a lag has followed its first value for long when the log begins.
// Without a driver an effect is constant in time, or a step or pulse at an unknown time.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/discrepancy/drivers.h"
#include "core/machine/effect.h"
#include "core/machine/observation.h"
#include "core/math/expression.h"

namespace spindrift {

class JsonNode;

/// A name of a driver as the user wrote it, and where.
struct OwnDriver {
  std::string text;  ///< "spindle_rpm^1.5"
  SourcePlace place;
};

/// One component of one shape column.
struct OwnExpression {
  Component component = Component::EX;
  Expression value;
  SourcePlace place;
};

struct OwnEffect {
  Effect effect;  ///< without variants: they depend on the log
  Dynamics dynamics = Dynamics::None;
  std::vector<std::vector<OwnDriver>> drivers;    ///< alternatives; each holds inputs together
  std::vector<std::vector<OwnExpression>> shape;  ///< of every gain
  SourcePlace place;
};

class OwnEffects {
 public:
  /// Reads effects.json. Throws InputError: format, an expression that cannot be read or has an unknown variable, a
  /// duplicate id, an id of the catalogue (unless built_in is false), bounds of lags that are reversed, a wrong sign,
  /// `contains` of an id that is not there.
  [[nodiscard]] static std::shared_ptr<const OwnEffects> read(const std::filesystem::path& file);
  /// The same from text; `name` stands for the file in errors.
  [[nodiscard]] static std::shared_ptr<const OwnEffects> parse(std::string_view text,
                                                               const std::filesystem::path& name);

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  /// False: the catalogue is left out.
  [[nodiscard]] bool builtIn() const noexcept { return built_in_; }
  [[nodiscard]] const std::vector<OwnEffect>& effects() const noexcept { return effects_; }
  /// False: nothing depends on what happened before, as heat does.
  [[nodiscard]] bool anyLag() const;
  [[nodiscard]] const OwnEffect* find(std::string_view id) const;

  /// The effects with their variants; their drivers are added to `drivers`. Throws InputError for a column that the log
  /// does not have and for a power that has no value (of a negative number).
  [[nodiscard]] std::vector<Effect> bind(DriverTable& drivers, const OperatingLog* log,
                                         double reference_temperature_degC, bool absolute) const;

  /// Throws InputError where an expression is not finite at a place observed. Takes out of `effects` those that are
  /// zero at every row to be fitted, with a sentence in `warnings`.
  void check(std::vector<Effect>& effects, const std::vector<Observation>& rows,
             std::vector<std::string>& warnings) const;

 private:
  [[nodiscard]] static std::shared_ptr<const OwnEffects> parseNode(const JsonNode& root,
                                                                   const std::filesystem::path& file);
  std::filesystem::path file_;
  bool built_in_ = true;
  std::vector<OwnEffect> effects_;
};

/// Name in the table of drivers of a column that the user wrote: apart from the catalogue's own, which are scaled.
[[nodiscard]] std::string ownDriverName(std::string_view text);
/// What the user wrote, of such a name; any other name as it is.
[[nodiscard]] std::string_view driverAsWritten(std::string_view name);

}  // namespace spindrift
