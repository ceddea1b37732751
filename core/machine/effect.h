// SPDX-License-Identifier: Apache-2.0
// A named physical cause of deviation: driver x dynamics x shape (EFFECTS.md). An error model is a sum of effects.
//
//   deviation(component, place, t) = sum over inputs i, shape columns k:  gain_ik * q_i(t) * shape_k(component, place)
//
// q_i is a driver of the operating log after its dynamics. Units: um or urad for the deviation, mm for places, s for
// times; the driver's unit is part of the gain's name ("gain_um_per_krpm"). Frame: MCF, sign of FORMATS.md.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/component.h"
#include "core/machine/error_model.h"
#include "core/machine/machine_description.h"
#include "core/machine/operating_log.h"

namespace spindrift {

/// How a driver turns into q(t).
enum class Dynamics {
  None,           ///< q = driver
  Lag,            ///< tau q' + q = driver, exact for states that hold and temperatures that are linear between rows
  AsymmetricLag,  ///< a lag whose time constant differs while the driver is on and off
  Step,           ///< 0 before the onset, 1 after it; no driver
  Pulse,          ///< rises through a lag from the onset and falls after `length`; no driver
  Start,          ///< what was warm when the log began and cools through the lag: exp(-t / tau); no driver
};

[[nodiscard]] std::string_view toString(Dynamics dynamics) noexcept;

/// One additive input of an effect.
struct EffectInput {
  std::string driver;  ///< name in the table of drivers ("spindle_rpm^1.5", "T_room_degC"); empty for Step and Pulse
  Dynamics dynamics = Dynamics::Lag;
};

/// One way in which an effect may be driven. All variants of an effect have the same shape and the same name.
struct EffectVariant {
  std::vector<EffectInput> inputs;
  bool shared_lag = false;  ///< all inputs have the same time constant, or the same two
};

/// Deviation per unit gain of one shape column: um per unit for EX..EZ, urad per unit for EA..EC.
using ShapeFunction = std::function<double(const DeviationQuery& place, Component component)>;

struct ShapeColumn {
  std::string gain_unit;  ///< "um", "um_per_m", "urad"; the gain's name is gain_<gain_unit>_per_<driver unit>
  ShapeFunction value;
};

/// One effect: of the catalogue, or of a file of the user's.
struct Effect {
  std::string id;                       ///< stable id of EFFECTS.md: "ball_screw.expansion.x"
  std::string title;                    ///< what people call it; "%1" stands for `subject`
  std::string subject;                  ///< axis or point of the title; empty where it has no "%1"
  std::string physics;                  ///< one paragraph for the user
  std::string formula;                  ///< of its shape: "ez = g q (z - z0)"
  std::vector<std::string> references;  ///< where the physics is described
  std::vector<ShapeColumn> shape;
  std::vector<EffectVariant> variants;
  int sign = 0;  ///< +1 or -1: physical sign of the first gain of temperature and heat inputs; 0 free
  std::vector<std::string> contains;  ///< simpler effects that this one holds as special cases (ids)
  /// A column pair (slope, constant) with an origin that is not known: origin = -constant / slope must lie in here.
  bool free_origin = false;
  double origin_low_mm = 0.0;
  double origin_high_mm = 0.0;
  /// |gain of shape column k| <= largest_ratio[k] x |sum of the gains of the columns `ratio_to`|, 0: free. Empty: all
  /// free, as all are where nothing is observed that one of these columns moves.
  std::vector<double> largest_ratio;
  std::vector<std::size_t> ratio_to{0};
  /// Combinations of the shape columns that it can be, with one gain each (that of the first column); empty: every
  /// column has a gain of its own.
  std::vector<std::vector<double>> forms;
  /// Of one form of another (formsApart): that one, and which form of it.
  std::shared_ptr<const Effect> of_forms;
  std::size_t form = 0;
  std::optional<std::array<double, 2>> tau_s;  ///< bounds of its lags; empty: as the observations allow
  double least_lag_s = 0.0;                    ///< what takes up heat needs so long; 0: it may follow at once
  bool own = false;                            ///< comes from a file of the user's
  bool two_lags = false;                       ///< its heat may reach it through two lags
  bool refinement = false;                     ///< refines another effect of the same cause (ball_screw.nonuniform)
  bool follows_room = false;                   ///< what the driver heats also follows the room, a little
  bool of_machine = true;  ///< a part of the machine moves, which follows the room; false: the instrument does
  bool over_time = false;  ///< its shape depends on the time of the query: a tangent of a simulation
  /// The same cause under other names (ids): what a mechanism of the simulation makes in the catalogue's words. They
  /// are no rivals of each other.
  std::vector<std::string> same_cause;
  int choices = 1;              ///< among so many forms the one at hand was chosen by the data
  bool driver_missing = false;  ///< the driver that matters most for this effect is not in the log
  bool always_driven = false;   ///< what drives it changes whether the log tells or not: the room
};

}  // namespace spindrift
