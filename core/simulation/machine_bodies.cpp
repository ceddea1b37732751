// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/machine_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/text.h"
#include "core/simulation/thermal_network.h"

namespace spindrift {
namespace {

/// Which motion stirs the air at a surface.
enum class Stirred { Still, Spindle, FeedX, FeedY, FeedZ, Table };

/// A surface in contact with the room.
struct Surface {
  int link = -1;
  double area_m2 = 0.0;
  double still_W_per_m2_K = 9.0;
  double gain_W_per_m2_K = 0.0;
  Stirred by = Stirred::Still;
};

/// One machine as a network, with or without its own heat.
class Plant {
 public:
  Plant(const MachineDescription& machine, const PlantParameters& parameters, double room_degC, double coolant_degC,
        bool heated)
      : machine_(machine), p_(parameters), start_degC_(room_degC), heated_(heated) {
    b_.room = net_.addBoundary(room_degC);
    b_.ground = net_.addBoundary(room_degC);
    b_.coolant = net_.addBoundary(coolant_degC);
    buildSpindle();
    buildColumn();
    buildTable();
    for (int axis = 0; axis < 3; ++axis) buildScrew(axis);
    buildBeam();
    buildSmallBodies();
  }

  const BodyIndex& bodies() const { return b_; }
  const std::vector<double>& temperatures() const { return net_.temperatures(); }

  void advance(const ProgrammeSegment& now, double room_degC, double duration_s) {
    net_.setTemperature(b_.room, room_degC);
    const std::array<double, 5> speeds{now.spindle_rpm, now.feed_mm_min[0], now.feed_mm_min[1], now.feed_mm_min[2],
                                       now.c_rpm};
    if (!convection_of_ || speeds != *convection_of_) setConvection(now);
    convection_of_ = speeds;
    net_.clearHeat();
    if (heated_) setHeat(now);
    net_.advance(duration_s);
  }

 private:
  void surface(int node, double area_m2, Stirred by = Stirred::Still, double gain = 0.0, double still = 9.0) {
    surfaces_.push_back({net_.addLink(node, b_.room, 0.0), area_m2, still, gain, by});
  }
  RodIndex rod(int count, double cell_J_per_K, double between_W_per_K, double from_mm, double to_mm) {
    return {net_.addRod(count, cell_J_per_K, between_W_per_K * p_.conduction, start_degC_), count, from_mm, to_mm};
  }
  int node(double capacity_J_per_K) { return net_.addNode(capacity_J_per_K, start_degC_); }
  void link(int a, int b, double W_per_K) { net_.addLink(a, b, W_per_K * p_.conduction); }

  void buildSpindle() {
    const double m = p_.spindle_mass;
    b_.front_bearing = node(1400.0 * m);
    b_.rear_bearing = node(1000.0 * m);
    b_.shaft = rod(4, 800.0 * m, 12.0, 0.0, 320.0);
    b_.housing = rod(4, 2800.0 * m, 18.0, 0.0, 320.0);
    b_.head_top = rod(4, 3600.0 * m, 22.0, 0.0, 280.0);
    b_.head_bottom = rod(4, 3600.0 * m, 22.0, 0.0, 280.0);
    link(b_.front_bearing, b_.shaft.first, 9.0);
    link(b_.front_bearing, b_.housing.first, 9.0);
    link(b_.rear_bearing, b_.shaft.first + 3, 8.0);
    link(b_.rear_bearing, b_.housing.first + 3, 8.0);
    for (int i = 0; i < 4; ++i) {
      surface(b_.shaft.first + i, i == 0 ? 0.02 : 0.004, Stirred::Spindle, 45.0);
      surface(b_.housing.first + i, 0.05, Stirred::Spindle, 4.0);
      surface(b_.head_top.first + i, 0.10);
      surface(b_.head_bottom.first + i, 0.08);
      link(b_.head_top.first + i, b_.head_bottom.first + i, 3.0);
    }
    link(b_.housing.first + 3, b_.head_top.first + 3, 9.0);
    link(b_.housing.first + 1, b_.head_bottom.first + 3, 16.0);
  }

  void buildColumn() {
    const LinearAxis* z = machine_.findAxis("Z");
    const double low = z != nullptr ? z->travel_mm[0] : 0.0;
    const double high = z != nullptr ? z->travel_mm[1] : 500.0;
    const double base = machine_.column_base_mm.value_or(low - 200.0);
    const double top = std::max(high, base + 100.0) + 60.0;
    const double height_m = (top - base) / 1000.0;
    constexpr int levels = 10;
    // A cast wall 0.4 m wide and 25 mm thick.
    const double cell_J = 7200.0 * 500.0 * 0.4 * 0.025 * height_m / levels * p_.structure_mass;
    const double between = 50.0 * 0.4 * 0.025 * levels / height_m;
    const double outside_m2 = 0.4 * height_m / levels * 1.6;  // outside and part of the inside
    for (int wall = 0; wall < 4; ++wall) {
      b_.column[static_cast<std::size_t>(wall)] = rod(levels, cell_J, between, base, top);
      for (int i = 0; i < levels; ++i) surface(b_.column[static_cast<std::size_t>(wall)].first + i, outside_m2);
      link(b_.column[static_cast<std::size_t>(wall)].first, b_.ground, 2.0);
    }
    for (int i = 0; i < levels; ++i) {  // round the corner
      for (const auto& [a, c] : {std::pair{0, 2}, {0, 3}, {1, 2}, {1, 3}}) {
        link(b_.column[static_cast<std::size_t>(a)].first + i, b_.column[static_cast<std::size_t>(c)].first + i,
             50.0 * 0.025 * height_m / levels / 0.4);
      }
    }
    // The head sits on the guides of the front wall, which spread its heat along them; the motor stands on the left.
    for (int i = 0; i < levels; ++i) {
      link(b_.head_top.first, b_.column[0].first + i, 6.0 / levels);
      link(b_.head_bottom.first, b_.column[0].first + i, 4.0 / levels);
      link(b_.housing.first + 3, b_.column[2].first + i, 2.0 / levels);
    }
  }

  void buildTable() {
    const auto span = [&](const char* name, double& from, double& to) {
      const LinearAxis* a = machine_.findAxis(name);
      from = a != nullptr ? a->travel_mm[0] : 0.0;
      to = a != nullptr ? a->travel_mm[1] : 400.0;
      from -= 40.0;
      to += 40.0;
    };
    span("X", b_.table_from_x_mm, b_.table_to_x_mm);
    span("Y", b_.table_from_y_mm, b_.table_to_y_mm);
    constexpr int n = BodyIndex::table_cells;
    const double dx = (b_.table_to_x_mm - b_.table_from_x_mm) / 1000.0 / n;
    const double dy = (b_.table_to_y_mm - b_.table_from_y_mm) / 1000.0 / n;
    constexpr double thick_m = 0.045;
    b_.table = net_.addNode(7200.0 * 500.0 * dx * dy * thick_m * p_.structure_mass, start_degC_);
    for (int i = 1; i < n * n; ++i) node(7200.0 * 500.0 * dx * dy * thick_m * p_.structure_mass);
    for (int iy = 0; iy < n; ++iy) {
      for (int ix = 0; ix < n; ++ix) {
        const int cell = b_.table + iy * n + ix;
        if (ix + 1 < n) link(cell, cell + 1, 52.0 * thick_m * dy / dx);
        if (iy + 1 < n) link(cell, cell + n, 52.0 * thick_m * dx / dy);
        surface(cell, 2.0 * dx * dy, Stirred::Table, 5.0);
      }
    }
  }

  void buildScrew(int axis) {
    const auto a = static_cast<std::size_t>(axis);
    const LinearAxis* linear = machine_.findAxis(std::string(1, "XYZ"[axis]));
    const double from = linear != nullptr ? linear->travel_mm[0] : 0.0;
    const double to = linear != nullptr ? linear->travel_mm[1] : 400.0;
    const int count = std::clamp(static_cast<int>((to - from) / 36.0), 6, 24);
    constexpr double section_m2 = 8.0e-4;  // 32 mm in diameter
    constexpr double perimeter_m = 0.1;
    const double cell_m = (to - from) / 1000.0 / count;
    b_.screw[a] =
        rod(count, 7800.0 * 460.0 * section_m2 * cell_m * p_.screw_mass, 46.0 * section_m2 / cell_m, from, to);
    const Stirred by = axis == 0 ? Stirred::FeedX : axis == 1 ? Stirred::FeedY : Stirred::FeedZ;
    for (int i = 0; i < count; ++i) surface(b_.screw[a].first + i, perimeter_m * cell_m, by, 6.0, 12.0);
    b_.nut[a] = node(900.0 * p_.screw_mass);
    b_.screw_bearing[a] = node(1500.0 * p_.screw_mass);
    surface(b_.nut[a], 0.04, by, 5.0);
    surface(b_.screw_bearing[a], 0.05);
    const bool fixed_at_end = linear != nullptr && linear->fixed_bearing_mm.value_or(from) > 0.5 * (from + to);
    link(b_.screw_bearing[a], fixed_at_end ? b_.screw[a].first + count - 1 : b_.screw[a].first, 0.5);
    if (axis < 2) {  // the nuts of X and Y warm the table
      constexpr int n = BodyIndex::table_cells;
      for (int i = 0; i < n * n; ++i) link(b_.nut[a], b_.table + i, 1.2 / (n * n));
    }
    b_.scale[a] = node(350.0 * p_.screw_mass);
    surface(b_.scale[a], 0.025);
  }

  void buildBeam() {
    const double from = machine_.crossbeam ? machine_.crossbeam->from_mm : 0.0;
    const double to = machine_.crossbeam ? machine_.crossbeam->to_mm : 600.0;
    constexpr int count = 12;
    const double cell_m = std::max(0.02, std::abs(to - from) / 1000.0 / count);
    const double cell_J = 7800.0 * 480.0 * 0.25 * 0.02 * cell_m * p_.structure_mass;
    b_.beam_top = rod(count, cell_J, 48.0 * 0.25 * 0.02 / cell_m, from, to);
    b_.beam_bottom = rod(count, cell_J, 48.0 * 0.25 * 0.02 / cell_m, from, to);
    for (int i = 0; i < count; ++i) {
      surface(b_.beam_top.first + i, 0.45 * cell_m);
      surface(b_.beam_bottom.first + i, 0.30 * cell_m);
      link(b_.beam_top.first + i, b_.beam_bottom.first + i, 50.0 * 0.03 * cell_m / 0.3);
      if (machine_.crossbeam) link(b_.nut[1], b_.beam_top.first + i, 2.5 / count);  // drive and guides lie on top
    }
  }

  void buildSmallBodies() {
    b_.pedestal = rod(3, 9000.0 * p_.structure_mass, 40.0, 0.0, 600.0);
    for (int i = 0; i < 3; ++i) surface(b_.pedestal.first + i, 0.30);
    b_.bed = node(60000.0 * p_.structure_mass);
    surface(b_.bed, 1.5);
    b_.rotary_drive = node(3500.0 * p_.structure_mass);
    b_.rotary_hub = node(9000.0 * p_.structure_mass);
    surface(b_.rotary_drive, 0.15);
    surface(b_.rotary_hub, 0.25, Stirred::Table, 4.0);
    link(b_.rotary_drive, b_.rotary_hub, 7.0);
    constexpr int n = BodyIndex::table_cells;
    if (!machine_.rotary.empty()) {
      for (int i = 0; i < n * n; ++i) link(b_.rotary_hub, b_.table + i, 10.0 / (n * n));
    }
    b_.artefact = rod(6, 160.0, 2.0, 0.0, 400.0);
    for (int i = 0; i < 6; ++i) {
      surface(b_.artefact.first + i, 0.012, Stirred::Table, 5.0);
      const int row = n / 2;
      link(b_.artefact.first + i, b_.table + row * n + i, 0.08);
    }
  }

  double speedOf(const ProgrammeSegment& now, Stirred by, double& reference) const {
    reference = 10000.0;
    switch (by) {
      case Stirred::Still:
        return 0.0;
      case Stirred::Spindle:
        reference = 6000.0;
        return now.spindle_rpm;
      case Stirred::FeedX:
        return now.feed_mm_min[0];
      case Stirred::FeedY:
        return now.feed_mm_min[1];
      case Stirred::FeedZ:
        return now.feed_mm_min[2];
      case Stirred::Table:
        return std::hypot(now.feed_mm_min[0], now.feed_mm_min[1]) + 40.0 * now.c_rpm;
    }
    return 0.0;
  }

  void setConvection(const ProgrammeSegment& now) {
    for (const Surface& s : surfaces_) {
      double reference = 1.0;
      const double speed = speedOf(now, s.by, reference);
      const double gain = s.gain_W_per_m2_K * p_.convection_speed;
      net_.setConductance(
          s.link, p_.convection * s.area_m2 * convection_W_per_m2_K(s.still_W_per_m2_K, gain, speed, reference));
    }
  }

  void setHeat(const ProgrammeSegment& now) {
    const double ring_K = net_.temperature(b_.front_bearing) - net_.temperature(b_.housing.first);
    BearingFriction front;
    BearingFriction rear;
    rear.viscous_W = 25.0;
    rear.load_W = 15.0;
    net_.addHeat(b_.front_bearing, p_.friction * bearingPower_W(front, now.spindle_rpm, ring_K));
    net_.addHeat(b_.rear_bearing, p_.friction * bearingPower_W(rear, now.spindle_rpm, 0.5 * ring_K));
    net_.addHeat(b_.housing.first + 3, p_.friction * motorPower_W(now.spindle_rpm, 6000.0, 45.0));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const RodIndex& screw = b_.screw[axis];
      const double power_W =
          p_.screw_friction * nutPower_W(now.feed_mm_min[axis], 12.0 * (screw.to_mm - screw.from_mm) / 500.0);
      net_.addHeat(b_.nut[axis], 0.45 * power_W);
      net_.addHeat(b_.screw_bearing[axis], 0.12 * power_W);
      // The rest enters the screw where the nut travels.
      const double half_mm = 0.5 * std::max(screw.cell_mm(), now.stroke_part[axis] * (screw.to_mm - screw.from_mm));
      const double middle = std::clamp(now.position_mm[axis], std::min(screw.from_mm + half_mm, screw.to_mm - half_mm),
                                       std::max(screw.from_mm + half_mm, screw.to_mm - half_mm));
      std::array<double, 64> share{};
      double total = 0.0;
      for (int i = 0; i < screw.count; ++i) {
        const double low = std::max(screw.from_mm + i * screw.cell_mm(), middle - half_mm);
        const double high = std::min(screw.from_mm + (i + 1) * screw.cell_mm(), middle + half_mm);
        share[static_cast<std::size_t>(i)] = std::max(0.0, high - low);
        total += share[static_cast<std::size_t>(i)];
      }
      for (int i = 0; i < screw.count && total > 0.0; ++i) {
        net_.addHeat(screw.first + i, 0.43 * power_W * share[static_cast<std::size_t>(i)] / total);
      }
    }
    net_.addHeat(b_.rotary_drive, p_.screw_friction * 1.6 * std::abs(now.c_rpm));
    if (now.coolant) net_.addHeat(b_.bed, 25.0);
  }

  const MachineDescription& machine_;
  PlantParameters p_;
  double start_degC_;
  bool heated_;
  ThermalNetwork net_;
  BodyIndex b_;
  std::vector<Surface> surfaces_;
  std::optional<std::array<double, 5>> convection_of_;  ///< speeds that the conductances are of
};

}  // namespace

void TemperatureHistory::append(const std::vector<double>& temperatures) {
  SPINDRIFT_ASSERT(temperatures.size() == nodes_, "another network");
  values_.insert(values_.end(), temperatures.begin(), temperatures.end());
}

double TemperatureHistory::at(int node, double time_s) const {
  const std::size_t samples = values_.size() / nodes_;
  const double place = std::clamp(time_s / step_s_, 0.0, static_cast<double>(samples - 1));
  const auto i = static_cast<std::size_t>(place);
  const std::size_t next = std::min(i + 1, samples - 1);
  const double a = values_[i * nodes_ + static_cast<std::size_t>(node)];
  return a + (place - static_cast<double>(i)) * (values_[next * nodes_ + static_cast<std::size_t>(node)] - a);
}

double TemperatureHistory::meanRise(const RodIndex& rod, double time_s) const {
  double sum = 0.0;
  for (int i = 0; i < rod.count; ++i) sum += rise(rod.first + i, time_s);
  return sum / rod.count;
}

struct ThermalStepper::Parts {
  Parts(const MachineDescription& described, const Environment& around, const PlantParameters& parameters)
      : machine(described),
        environment(around),
        heated(machine, parameters, around.room_degC(0.0), around.coolant_degC(), true),
        passive(machine, parameters, around.room_degC(0.0), around.coolant_degC(), false) {
    run.bodies = heated.bodies();
    run.heated = TemperatureHistory(heated.temperatures().size(), step_s);
    run.passive = run.heated;
    run.heated.append(heated.temperatures());
    run.passive.append(passive.temperatures());
  }
  MachineDescription machine;
  Environment environment;
  Plant heated;
  Plant passive;
  ThermalRun run;
  std::size_t steps = 0;
};

ThermalStepper::ThermalStepper(const MachineDescription& machine, const Environment& environment,
                               const PlantParameters& parameters)
    : parts_(std::make_unique<Parts>(machine, environment, parameters)) {}

ThermalStepper::~ThermalStepper() = default;

double ThermalStepper::time_s() const noexcept {
  return static_cast<double>(parts_->steps) * step_s;
}

const ThermalRun& ThermalStepper::run() const noexcept {
  return parts_->run;
}

ThermalRun ThermalStepper::take() && {
  return std::move(parts_->run);
}

void ThermalStepper::step(const ProgrammeSegment& now) {
  Parts& p = *parts_;
  const double room_degC = p.environment.room_degC(time_s() + 0.5 * step_s);
  p.heated.advance(now, room_degC, step_s);
  p.passive.advance(now, room_degC, step_s);
  p.run.heated.append(p.heated.temperatures());
  p.run.passive.append(p.passive.temperatures());
  ++p.steps;
}

ThermalRun runThermal(const MachineDescription& machine, const Programme& programme, const Environment& environment,
                      const PlantParameters& parameters, double duration_s, const JobContext& job) {
  ThermalStepper stepper(machine, environment, parameters);
  const auto steps = static_cast<std::size_t>(std::ceil(duration_s / ThermalStepper::step_s));
  for (std::size_t i = 0; i < steps; ++i) {
    stepper.step(programme.at(stepper.time_s() + 0.5 * ThermalStepper::step_s));
    if (i % 128 == 0) {
      job.throwIfCancelled();
      job.report(static_cast<double>(i) / static_cast<double>(steps), "heat flow");
    }
  }
  return std::move(stepper).take();
}

std::vector<int> volumesAt(const BodyIndex& b, std::string_view place, const SourcePlace& where) {
  std::string_view body = place;
  double along = -1.0;
  if (const auto mark = place.find('@'); mark != std::string_view::npos) {
    body = trimmed(place.substr(0, mark));
    if (!parseNumber(trimmed(place.substr(mark + 1)), along) || along < 0.0 || along > 1.0) {
      throw InputError(where, fmt::format("place \"{}\": the position after @ is not a number from 0 to 1.", place));
    }
  }
  const auto single = [](int node) { return std::vector<int>{node}; };
  const auto cells = [&](const RodIndex& rod) {
    std::vector<int> nodes;
    if (along >= 0.0) return single(rod.first + std::min(rod.count - 1, static_cast<int>(along * rod.count)));
    for (int i = 0; i < rod.count; ++i) nodes.push_back(rod.first + i);
    return nodes;
  };
  if (body == "room" || body == "ambient") return single(b.room);
  if (body == "coolant") return single(b.coolant);
  if (body == "front bearing") return single(b.front_bearing);
  if (body == "rear bearing") return single(b.rear_bearing);
  if (body == "shaft") return cells(b.shaft);
  if (body == "spindle housing") return cells(b.housing);
  if (body == "head top") return cells(b.head_top);
  if (body == "head bottom") return cells(b.head_bottom);
  if (body == "column front" || body == "column") return cells(b.column[0]);
  if (body == "column rear") return cells(b.column[1]);
  if (body == "column left") return cells(b.column[2]);
  if (body == "column right") return cells(b.column[3]);
  if (body == "crossbeam top") return cells(b.beam_top);
  if (body == "crossbeam bottom") return cells(b.beam_bottom);
  if (body == "pedestal") return cells(b.pedestal);
  if (body == "bed") return single(b.bed);
  if (body == "rotary drive") return single(b.rotary_drive);
  if (body == "artefact") return cells(b.artefact);
  if (body == "table") {
    constexpr int n = BodyIndex::table_cells;
    if (along >= 0.0) return single(b.table + (n / 2) * n + std::min(n - 1, static_cast<int>(along * n)));
    std::vector<int> nodes;
    for (int i = 0; i < n * n; ++i) nodes.push_back(b.table + i);
    return nodes;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const char letter = "xyz"[axis];
    if (body == fmt::format("screw {}", letter)) return cells(b.screw[axis]);
    if (body == fmt::format("nut {}", letter)) return single(b.nut[axis]);
    if (body == fmt::format("screw bearing {}", letter)) return single(b.screw_bearing[axis]);
    if (body == fmt::format("scale {}", letter)) return single(b.scale[axis]);
  }
  throw InputError(
      where,
      fmt::format("place \"{}\" is not a body of the virtual machine; allowed: room, coolant, front bearing, rear "
                  "bearing, shaft, spindle housing, head top, head bottom, column front, column rear, column left, "
                  "column right, table, screw x, nut x, screw bearing x, scale x (or y, z), crossbeam top, crossbeam "
                  "bottom, pedestal, bed, rotary drive, artefact, each row also with @0 ... @1.",
                  place));
}

}  // namespace spindrift
