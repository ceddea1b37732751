// SPDX-License-Identifier: Apache-2.0
// Causes with a mechanism of their own, and those that no catalogue knows.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/simulation/carrying_bodies.h"
#include "core/simulation/plant_effects.h"
#include "core/simulation/small_bodies.h"
#include "core/simulation/structure.h"

namespace spindrift {
namespace {

double travelPart(const MachineDescription& machine, int axis, double place_mm) {
  const LinearAxis* a = machine.findAxis(std::string(1, "XYZ"[axis]));
  if (a == nullptr) return 0.0;
  return (place_mm - a->travel_mm[0]) / (a->travel_mm[1] - a->travel_mm[0]) - 0.5;
}

PlantEffectFunction sun(const VirtualMachine& plant, const std::string& id, const PlantEffectSetting& s) {
  const double onset = s.parameter("onset_s", 0.35 * plant.duration_s());
  const double length = s.parameter("length_s", 0.25 * plant.duration_s());
  const auto wall = std::make_shared<SampledSignal>(
      sunlitWall(plant.parameters(), onset, length, s.parameter("flux_W", 60.0), plant.duration_s()));
  const double alpha = steel_per_K * plant.parameters().expansion;
  if (id.back() == 'z') {
    return [wall, alpha](const PlantQuery& q) { return translation(2, alpha * 500.0 * wall->at(q.time_s)); };
  }
  const bool about_x = id.back() == 'a';
  const RodIndex column = plant.thermal().bodies.column[0];
  // The sun shines on the rear or the right side, more on one half of its height than on the other.
  Random random(plant.seed() ^ 0x50a7ULL);
  const double more = random.uniform(-0.4, 0.4);
  const double middle = random.uniform(-0.25, 0.25);
  std::vector<double> part;
  for (int i = 0; i < column.count; ++i) {
    const double h = (i + 0.5) / column.count - 0.5;
    part.push_back(1.0 + 2.0 * more * h + middle * (1.0 - 6.0 * h * h));
  }
  const Eigen::Vector2d overhang = columnOverhang_mm(plant.machine(), s);
  return [wall, alpha, about_x, column, part, overhang](const PlantQuery& q) {
    std::vector<double> lit = part;
    for (double& value : lit) value *= wall->at(q.time_s);
    const std::vector<double> shade(lit.size(), 0.0);
    const Bending bend = cantilever(column, shade, lit, alpha, 380.0, q.position_mm.z() - q.tool_offset_mm.z());
    SmallError e;
    if (about_x) {
      e.translation_mm.y() = bend.deflection_mm;
      e.rotation_rad.x() = -bend.slope_rad;
    } else {
      e.translation_mm.x() = bend.deflection_mm;
      e.rotation_rad.y() = bend.slope_rad;
    }
    liftOverhang(e, overhang);
    return e.at(q.tool_offset_mm);
  };
}

PlantEffectFunction hydraulics(const VirtualMachine& plant, const PlantEffectSetting& s) {
  // A pump that fills an accumulator: on for 35 % of a fixed period; the oil line warms and cools between.
  const double period = s.parameter("period_s", 2900.0);
  Random random(plant.seed() ^ 0x5eedULL);
  const double phase = random.uniform() * period;
  const double up = 0.10 * period;
  const double down = 0.22 * period;
  const double on = 0.35 * period;
  // Periodic solution of a first-order rise and decay.
  const double gain_on = 1.0 - std::exp(-on / up);
  const double keep = std::exp(-(period - on) / down);
  const double low = gain_on * keep / (1.0 - (1.0 - gain_on) * keep);
  return [=](const PlantQuery& q) {
    const double t = std::fmod(q.time_s + phase, period);
    const double value = t < on ? 1.0 + (low - 1.0) * std::exp(-t / up)
                                : (1.0 + (low - 1.0) * std::exp(-on / up)) * std::exp(-(t - on) / down);
    return translation(0, 0.006 * value);
  };
}

PlantEffectFunction powerSupply(const VirtualMachine& plant) {
  // The voltage of an amplifier changes between levels at times that nobody logs; the axis follows.
  Random random(plant.seed() ^ 0xface1ULL);
  auto times = std::make_shared<std::vector<double>>();
  auto levels = std::make_shared<std::vector<double>>();
  double time = 0.0;
  double level = 0.0;
  while (time < plant.duration_s()) {
    times->push_back(time);
    levels->push_back(level);
    time += random.uniform(0.5, 1.5) * std::min(5000.0, plant.duration_s() / 8.0);
    level = (level > 0.0 ? -1.0 : 1.0) * random.uniform(0.3, 1.0);
  }
  return [times, levels](const PlantQuery& q) {
    std::size_t i = 0;
    while (i + 1 < times->size() && (*times)[i + 1] <= q.time_s) ++i;
    return translation(1, 0.006 * (*levels)[i]);
  };
}

PlantEffectFunction outside(const VirtualMachine& plant, const std::string& id, const PlantEffectSetting& s) {
  const MachineDescription& machine = plant.machine();
  if (id == "unknown.hydraulics") return hydraulics(plant, s);
  if (id == "unknown.power_supply") return powerSupply(plant);
  if (id == "unknown.foundation_creep") {
    // The ground under the machine gives way under the load, quickly at first; the bed twists and bows.
    const double tau = 0.08 * plant.duration_s();
    const double whole = std::log1p(plant.duration_s() / tau);
    return [&machine, tau, whole](const PlantQuery& q) {
      const double x = travelPart(machine, 0, q.position_mm.x());
      const double y = travelPart(machine, 1, q.position_mm.y());
      return translation(2, 0.06 * std::log1p(q.time_s / tau) / whole * (x * y + 0.35 * x * x));
    };
  }
  if (id == "unknown.humidity") {
    // A filled polymer bed swells with the humidity of the hall and saddles.
    const double tau = 2400.0;
    auto follow = std::make_shared<SampledSignal>();
    double value = 0.0;
    const auto steps = static_cast<std::size_t>(plant.duration_s() / follow->step_s) + 2;
    for (std::size_t i = 0; i < steps; ++i) {
      const double target = plant.environment().humidity_percent(static_cast<double>(i) * follow->step_s);
      value += (1.0 - std::exp(-follow->step_s / tau)) * (target - value);
      follow->values.push_back(value);
    }
    return [&machine, follow](const PlantQuery& q) {
      const double x = travelPart(machine, 0, q.position_mm.x());
      const double y = travelPart(machine, 1, q.position_mm.y());
      return translation(2, 0.006 * follow->at(q.time_s) * (x * x - y * y));
    };
  }
  // unknown.chip_load: hot chips pile up in a corner of the table and are swept away now and then.
  Random random(plant.seed() ^ 0xc41fULL);
  auto sweeps = std::make_shared<std::vector<double>>();
  for (double t = random.uniform(0.1, 0.2) * plant.duration_s(); t < plant.duration_s();
       t += random.uniform(0.12, 0.28) * plant.duration_s()) {
    sweeps->push_back(t);
  }
  return [&machine, sweeps](const PlantQuery& q) {
    double since = q.time_s;
    for (const double sweep : *sweeps) {
      if (sweep <= q.time_s) since = q.time_s - sweep;
    }
    const double x = travelPart(machine, 0, q.position_mm.x()) - 0.3;
    const double y = travelPart(machine, 1, q.position_mm.y()) + 0.3;
    return translation(2, 0.014 * (1.0 - std::exp(-since / 4000.0)) * std::exp(-(x * x + y * y) / 0.12));
  };
}

}  // namespace

PlantEffectFunction makeMechanismEffect(const VirtualMachine& plant, const std::string& id,
                                        const PlantEffectSetting& s) {
  const MachineDescription& machine = plant.machine();
  if (id.starts_with("unknown.")) return outside(plant, id, s);
  if (id.starts_with("external_heat.")) return sun(plant, id, s);
  if (id.starts_with("fixture.slip.")) {
    const double time = s.parameter("time_s", 0.45 * plant.duration_s());
    const Eigen::Vector3d step_mm =
        mm_per_um *
        Eigen::Vector3d(s.parameter("step_x_um", 4.0), s.parameter("step_y_um", -3.0), s.parameter("step_z_um", 2.0));
    return [time, step_mm, point = id.substr(13)](const PlantQuery& q) {
      SmallError e;
      if (q.time_s >= time && q.point == point) e.translation_mm = step_mm;
      return e;
    };
  }
  if (id.starts_with("backlash.")) {
    const int axis = lastAxis(id);
    return [axis](const PlantQuery& q) { return translation(axis, -0.002 * q.approach[axis]); };
  }
  if (id.starts_with("periodic.pitch.")) {
    const int axis = lastAxis(id);
    const double pitch = machine.findAxis(std::string(1, "XYZ"[axis]))->pitch_mm.value_or(10.0);
    const double phase = s.parameter("phase_rad", 0.4);
    const double steady_mm = s.parameter("steady_um", 0.0) * mm_per_um;
    const TemperatureHistory& heated = plant.thermal().heated;
    const RodIndex& screw = plant.thermal().bodies.screw[static_cast<std::size_t>(axis)];
    return [&heated, &screw, axis, pitch, phase, steady_mm](const PlantQuery& q) {
      // A warm screw runs out of true in its bearings: 1 um for a kelvin, a little of it from where the nut stands.
      const double place = q.position_mm[axis] - q.tool_offset_mm[axis];
      const int cell = std::clamp(static_cast<int>((place - screw.from_mm) / screw.cell_mm()), 0, screw.count - 1);
      const double rise = 0.92 * heated.meanRise(screw, q.time_s) + 0.08 * heated.rise(screw.first + cell, q.time_s);
      const double amplitude = steady_mm + 0.001 * rise;
      return translation(axis, amplitude * std::sin(2.0 * std::numbers::pi * place / pitch + phase));
    };
  }
  if (id.starts_with("instrument.warm_up.")) {
    const int axis = lastAxis(id);
    const double size_mm = (axis == 0 ? 10.0 : axis == 1 ? 25.0 : 20.0) * mm_per_um;
    const auto warm = std::make_shared<SampledSignal>(instrumentWarmUp(plant.programme(), plant.duration_s()));
    return [warm, axis, size_mm](const PlantQuery& q) { return translation(axis, size_mm * warm->at(q.time_s)); };
  }
  if (id.starts_with("coolant.shock.")) {
    const int axis = lastAxis(id);
    const auto splash = std::make_shared<SampledSignal>(
        coolantSplash(plant.programme(), plant.environment(), plant.parameters(), plant.duration_s()));
    const double alpha = steel_per_K * plant.parameters().expansion;
    return [splash, axis, alpha, &machine](const PlantQuery& q) {
      // 350 mm of casting, and a little of what lies along the travel.
      const double along = 40.0 * travelPart(machine, axis, q.position_mm[axis] - q.tool_offset_mm[axis]);
      return translation(axis, alpha * ((axis == 1 ? -350.0 : 350.0) + along) * splash->at(q.time_s));
    };
  }
  if (id.starts_with("heat_source.position.")) {
    const auto heat = std::make_shared<SampledSignal>(
        positionHeat(machine, plant.programme(), plant.parameters(), lastAxis(id), plant.duration_s()));
    const double length = 240.0 * steel_per_K * plant.parameters().expansion;
    return [heat, length](const PlantQuery& q) { return translation(2, length * heat->at(q.time_s)); };
  }
  return {};
}

}  // namespace spindrift
