// SPDX-License-Identifier: Apache-2.0
// Operating programmes that this machine can run, as its log shows, and what drives deviations while one runs. Internal
// to core/discrepancy.
//
// A programme begins on a machine that has rested overnight, at the time of day at which the log began: all lags start
// from rest, the room takes the course that it took in the log. Temperatures of the machine are predicted by
// first-order responses to speeds, feeds, coolant and room, fitted to the log (ridge regression; Hoerl and Kennard
// 1970).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/drivers.h"

namespace spindrift {

struct PlannedProgramme {
  std::vector<ProgrammeStep> steps;
  bool restart_instrument = false;
};

/// What is asked of the library of programmes.
struct ProgrammeQuestion {
  double hours = 8.0;
  bool instrument = false;  ///< a candidate is driven by switching the instrument on
  bool positions = false;   ///< a candidate depends on where the axes stand while there is heat
};

/// Everything at rest; each thing that moves, alone: for a while, on and off, one after another; the logged programme
/// again. Speeds and feeds are the highest of the log.
[[nodiscard]] std::vector<PlannedProgramme> possibleProgrammes(const DiscrepancyInput& input,
                                                               const ProgrammeQuestion& question);

/// Temperatures of the machine as responses to what it does, from its log.
class SensorResponses {
 public:
  explicit SensorResponses(const DriverTable& logged);
  /// Changes since the start at `times_s` of a programme; `motion` has its speeds, feeds and switches.
  [[nodiscard]] Eigen::VectorXd predict(const Driver& sensor, const DriverTable& motion,
                                        const std::vector<double>& times_s) const;

 private:
  struct Column {
    std::string driver;
    double tau_s = 0.0;
    double gain = 0.0;
  };
  struct Sensor {
    std::string name;
    std::vector<Column> columns;
  };
  const DriverTable* logged_;
  std::vector<Sensor> sensors_;
};

/// The drivers of a programme; times since its start.
[[nodiscard]] DriverTable plannedDrivers(const DiscrepancyInput& input, const DriverTable& logged,
                                         const SensorResponses& sensors, const PlannedProgramme& programme);

/// As inputResponses, for a programme after the campaign: what happened once (steps, pulses, a warm start) is over, and
/// what the programme does not drive stands still.
[[nodiscard]] Eigen::MatrixXd plannedResponses(const DriverTable& planned, const EffectVariant& variant,
                                               const std::vector<double>& parameters,
                                               const std::vector<double>& times_s);

}  // namespace spindrift
