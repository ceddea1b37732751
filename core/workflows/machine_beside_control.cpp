// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/machine_beside_control.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/steady_seconds.h"
#include "core/base/text.h"
#include "core/connect/append_file.h"
#include "core/connect/hal_commands.h"
#include "core/connect/source.h"
#include "core/control/control_configuration.h"
#include "core/simulation/virtual_machine.h"

namespace spindrift {
namespace {

constexpr double row_s = 30.0;

struct Sensor {
  SensorOptions options;
  std::vector<int> volumes;
  double reading_degC = 20.0;
};

/// What the control does, as HAL has it.
struct Driven {
  double spindle_rpm = 0.0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d compensation_um = Eigen::Vector3d::Zero();
};

class MachineBesideControl {
 public:
  explicit MachineBesideControl(const BesideControlOptions& options)
      : options_(options),
        environment_(options.scenario.environment, options.duration_s, options.scenario.seed),
        plant_(options.scenario.machine, environment_, options.scenario.physics, options.scenario.seed),
        random_(options.scenario.seed ^ 0xc0117301ULL),
        truth_(options.truth) {
    for (const auto& [id, effect] : options.scenario.effects) {
      if (!effect.setting.on || effect.setting.size == 0.0) continue;
      if (effect.strength)
        throw InputError(fmt::format("effect \"{}\" states a strength; a driven machine needs a size.", id));
      effects_.emplace_back(effect.setting.size, plant_.effect(id, effect.setting));
    }
    const std::vector<SensorOptions> sensors =
        options.scenario.sensors.empty() ? standardSensors(options.scenario.machine) : options.scenario.sensors;
    for (const SensorOptions& sensor : sensors)
      sensors_.push_back({sensor, volumesAt(plant_.thermal().bodies, sensor.place, {}), environment_.room_degC(0.0)});
    if (truth_.size() == 0) (void)truth_.append("time_s,ex_um,ey_um,ez_um,cx_um,cy_um,cz_um,spindle_rpm\n");
  }

  void run(const std::function<bool()>& ended) {
    const double began = steadySeconds();
    double next_try = 0.0;
    while (!ended()) {
      const double now_s = (steadySeconds() - began) * options_.factor;
      if (now_s > options_.duration_s) return;
      if (!hal_.started() && steadySeconds() >= next_try) {
        try {
          hal_.start();
        } catch (const ConnectionError&) {
          next_try = steadySeconds() + 0.2;
        }
      }
      Driven driven = last_;
      try {
        if (hal_.started()) driven = read();
      } catch (const ConnectionError&) {
        driven.spindle_rpm = 0.0;  // without a control nothing turns
        driven.compensation_um.setZero();
      }
      if (!hal_.started()) driven.spindle_rpm = 0.0;
      last_ = driven;
      ProgrammeSegment speeds;
      speeds.spindle_rpm = driven.spindle_rpm;
      for (int axis = 0; axis < 3; ++axis)
        speeds.position_mm[static_cast<std::size_t>(axis)] = driven.position_mm[axis];
      plant_.advance(speeds, now_s);
      // Between two steps of the heat flow everything runs linearly: one step behind.
      const double at_s = std::max(0.0, now_s - ThermalStepper::step_s);
      try {
        if (hal_.started()) write(driven, at_s, now_s);
      } catch (const ConnectionError&) {
      }
      if (now_s >= next_row_s_) {
        next_row_s_ = std::floor(now_s / row_s + 1.0) * row_s;
        const Eigen::Vector3d e = deviation_um(options_.reference_mm, at_s);
        const Eigen::Vector3d& c = driven.compensation_um;
        if (!truth_.append(fmt::format("{:.1f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:g}\n", now_s, e.x(), e.y(),
                                       e.z(), c.x(), c.y(), c.z(), driven.spindle_rpm)))
          throw InputError(truth_.failure());
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

 private:
  [[nodiscard]] Eigen::Vector3d deviation_um(const Eigen::Vector3d& position_mm, double time_s) const {
    PlantQuery query;
    query.time_s = time_s;
    query.position_mm = position_mm;
    Eigen::Vector3d total = Eigen::Vector3d::Zero();
    for (const auto& [size, function] : effects_) total += size * function(query).translation_mm;
    return 1e3 * total;
  }

  Driven read() {
    static const std::vector<std::string> names{
        "spindle.0.speed-out", "joint.0.motor-pos-cmd", "joint.1.motor-pos-cmd", "joint.2.motor-pos-cmd",
        "offset-x.offset",     "offset-y.offset",       "offset-z.offset",       "motion-controller.time"};
    const std::vector<std::optional<std::string>> texts = hal_.read(names);
    std::vector<double> values(names.size(), 0.0);
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (texts[i] && parseNumber(*texts[i], values[i])) continue;
      hal_.close();
      throw ConnectionError(fmt::format("HAL has no {}.", names[i]));
    }
    // A control that was killed leaves its memory behind, and who holds it reads pins that never change again, or none,
    // beside the control that was started in its place. How long a cycle takes is never the same for long.
    if (values.back() != cycle_time_) {
      cycle_time_ = values.back();
      changed_s_ = steadySeconds();
    } else if (steadySeconds() > changed_s_ + 1.5) {
      changed_s_ = steadySeconds();
      hal_.close();
      throw ConnectionError("The servo cycle stands still.");
    }
    Driven out;
    out.spindle_rpm = std::abs(values[0]);
    out.position_mm = {values[1], values[2], values[3]};
    out.compensation_um = 1e3 * Eigen::Vector3d(values[4], values[5], values[6]);
    return out;
  }

  void write(const Driven& driven, double at_s, double now_s) {
    const Eigen::Vector3d e_mm = 1e-3 * deviation_um(driven.position_mm, at_s);
    std::vector<std::pair<std::string, double>> values{
        {"error-x", e_mm.x()}, {"error-y", e_mm.y()}, {"error-z", e_mm.z()}, {"machine-time", now_s}};
    if (now_s >= next_reading_s_) {
      next_reading_s_ = now_s + 5.0;
      for (Sensor& sensor : sensors_) {
        const SensorOptions& o = sensor.options;
        const double noise_K = random_.normal(0.0, o.noise_K);
        const double body_degC = plant_.temperature_degC(sensor.volumes, at_s);
        sensor.reading_degC = body_degC + o.bias_K + noise_K;
        values.emplace_back(temperatureSignal(o.name), sensor.reading_degC);
      }
    }
    hal_.setSignals(values);
  }

  const BesideControlOptions& options_;
  Environment environment_;
  VirtualMachine plant_;
  Random random_;
  AppendFile truth_;
  HalCommands hal_;
  std::vector<std::pair<double, PlantEffectFunction>> effects_;
  std::vector<Sensor> sensors_;
  Driven last_;
  double next_row_s_ = 0.0;
  double next_reading_s_ = 0.0;
  double cycle_time_ = -1.0;  ///< of the servo cycle, as the control states it
  double changed_s_ = 0.0;    ///< when it was another one
};

}  // namespace

void BesideControlOptions::validate() const {
  if (!(factor > 0.0 && factor <= 1000.0))
    throw InputError(fmt::format("The speed factor of the machine is {:g}; allowed: above 0, up to 1000.", factor));
  if (!(duration_s > 0.0))
    throw InputError(fmt::format("The machine is to run for {:g} s; allowed: above 0.", duration_s));
}

void runBesideControl(const BesideControlOptions& options, const std::function<bool()>& ended) {
  options.validate();
  MachineBesideControl(options).run(ended);
}

}  // namespace spindrift
