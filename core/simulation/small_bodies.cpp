// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/small_bodies.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/simulation/thermal_network.h"

namespace spindrift {
namespace {

/// Advances a network over the campaign, calling `set` before and `read` after every step.
SampledSignal run(ThermalNetwork& network, double duration_s, const std::function<void(double)>& set,
                  const std::function<double()>& read) {
  SampledSignal signal;
  signal.values.push_back(read());
  const auto steps = static_cast<std::size_t>(std::ceil(duration_s / signal.step_s));
  for (std::size_t i = 0; i < steps; ++i) {
    set((static_cast<double>(i) + 0.5) * signal.step_s);
    network.advance(signal.step_s);
    signal.values.push_back(read());
  }
  return signal;
}

}  // namespace

double SampledSignal::at(double time_s) const {
  const double place = std::clamp(time_s / step_s, 0.0, static_cast<double>(values.size() - 1));
  const auto i = static_cast<std::size_t>(place);
  const std::size_t next = std::min(i + 1, values.size() - 1);
  return values[i] + (place - static_cast<double>(i)) * (values[next] - values[i]);
}

SampledSignal coolantSplash(const Programme& programme, const Environment& environment,
                            const PlantParameters& parameters, double duration_s) {
  ThermalNetwork net;
  const double start = environment.room_degC(0.0);
  const int room = net.addBoundary(start);
  const int coolant = net.addBoundary(environment.coolant_degC());
  const double capacity = 6000.0 * parameters.structure_mass;
  const int splashed = net.addNode(capacity, start);
  const int twin = net.addNode(capacity, start);
  net.addLink(splashed, room, 5.0 * parameters.convection);
  net.addLink(twin, room, 5.0 * parameters.convection);
  const int wet = net.addLink(splashed, coolant, 0.0);
  return run(
      net, duration_s,
      [&](double t) {
        net.setTemperature(room, environment.room_degC(t));
        net.setConductance(wet, programme.at(t).coolant ? 18.0 * parameters.convection : 0.0);
      },
      [&] { return net.temperature(splashed) - net.temperature(twin); });
}

SampledSignal sunlitWall(const PlantParameters& parameters, double onset_s, double length_s, double flux_W,
                         double duration_s) {
  ThermalNetwork net;
  const int room = net.addBoundary(0.0);
  const int outer = net.addNode(3000.0 * parameters.structure_mass, 0.0);
  const int inner = net.addNode(9000.0 * parameters.structure_mass, 0.0);
  net.addLink(outer, room, 4.0 * parameters.convection);
  net.addLink(outer, inner, 14.0 * parameters.conduction);
  net.addLink(inner, room, 3.0 * parameters.convection);
  return run(
      net, duration_s, [&](double t) { net.setHeat(outer, t >= onset_s && t < onset_s + length_s ? flux_W : 0.0); },
      [&] { return net.temperature(inner); });
}

SampledSignal instrumentWarmUp(const Programme& programme, double duration_s) {
  ThermalNetwork net;
  const int room = net.addBoundary(0.0);
  const int electronics = net.addNode(260.0, 0.0);
  const int optics = net.addNode(420.0, 0.0);
  net.addLink(electronics, optics, 0.45);
  net.addLink(electronics, room, 0.12);
  net.addLink(optics, room, 0.22);
  // Steady rise of the optics for 1 W in the electronics.
  const double steady = 0.45 / (0.57 * 0.67 - 0.45 * 0.45);
  return run(
      net, duration_s, [&](double t) { net.setHeat(electronics, programme.at(t).instrument_on ? 1.0 : 0.0); },
      [&] { return net.temperature(optics) / steady; });
}

SampledSignal positionHeat(const MachineDescription& machine, const Programme& programme,
                           const PlantParameters& parameters, int axis, double duration_s) {
  const LinearAxis* linear = machine.findAxis(std::string(1, "XYZ"[axis]));
  SPINDRIFT_ASSERT(linear != nullptr, "an axis that the machine does not have");
  constexpr int count = 12;
  ThermalNetwork net;
  const int room = net.addBoundary(0.0);
  const int first = net.addRod(count, 1700.0 * parameters.structure_mass, 0.25 * parameters.conduction, 0.0);
  for (int i = 0; i < count; ++i) net.addLink(first + i, room, 0.7 * parameters.convection);
  const BearingFriction friction;
  const double from = linear->travel_mm[0];
  const double travel = linear->travel_mm[1] - from;
  return run(
      net, duration_s,
      [&](double t) {
        const ProgrammeSegment& now = programme.at(t);
        const double place = (now.position_mm[static_cast<std::size_t>(axis)] - from) / travel * count - 0.5;
        const double power_W =
            0.25 * parameters.friction *
            (bearingPower_W(friction, now.spindle_rpm, 5.0) + motorPower_W(now.spindle_rpm, 6000.0, 45.0));
        net.clearHeat();
        const double low = std::clamp(std::floor(place), 0.0, count - 2.0);
        const double part = std::clamp(place - low, 0.0, 1.0);
        net.addHeat(first + static_cast<int>(low), power_W * (1.0 - part));
        net.addHeat(first + static_cast<int>(low) + 1, power_W * part);
      },
      [&] {
        double sum = 0.0;
        for (int i = 0; i < count; ++i) sum += net.temperature(first + i) * ((i + 0.5) / count - 0.5);
        return sum;
      });
}

}  // namespace spindrift
