// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/carrying_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "core/base/random.h"
#include "core/simulation/structure.h"

namespace spindrift {
namespace {

/// Castings of one pattern differ by this part in what they take up.
constexpr double spread = 0.05;

struct Span {
  double from_mm = 0.0;
  double to_mm = 0.0;
  [[nodiscard]] double length() const { return to_mm - from_mm; }
};

/// Travel of an axis and what stands out of it on both sides.
Span spanOf(const MachineDescription& machine, const char* name, double beyond_mm) {
  const LinearAxis* axis = machine.findAxis(name);
  if (axis == nullptr) return {-beyond_mm, 400.0 + beyond_mm};
  return {axis->travel_mm[0] - beyond_mm, axis->travel_mm[1] + beyond_mm};
}

using Signals = std::shared_ptr<const std::vector<SampledSignal>>;

Signals shared(std::vector<SampledSignal> signals) {
  return std::make_shared<const std::vector<SampledSignal>>(std::move(signals));
}

double at(const Signals& signals, std::size_t i, double time_s) {
  return (*signals)[i].at(time_s);
}

Follower volume(Random& random, double part) {
  return {part + random.uniform(-spread, spread), random.uniform(250.0, 450.0)};
}

/// A plate on four feet, -x-y, +x-y, -x+y, +x+y, two of which take up the heat.
PlantEffectFunction tiltingBed(const VirtualMachine& plant, int axis, const Eigen::Vector3d& origin,
                               const Rise& drive) {
  const Span x = spanOf(plant.machine(), "X", 150.0);
  const Span y = spanOf(plant.machine(), "Y", 150.0);
  Random random(plant.seed() ^ (0xbed0ULL + static_cast<std::uint64_t>(axis)));
  std::vector<Follower> feet;
  for (int k = 0; k < 4; ++k) {
    const bool right = k % 2 == 1;
    const bool rear = k / 2 == 1;
    const bool warm = axis == 0 ? rear : !right;
    feet.push_back(volume(random, warm ? 1.0 : 0.0));
  }
  const Signals rise = shared(followers(drive, feet, plant.duration_s()));
  const double alpha = steel_per_K * plant.parameters().expansion;
  const double height = 600.0 / 900.0 * (axis == 0 ? y.length() : x.length());
  return [=](const PlantQuery& q) {
    std::array<double, 4> w{};
    for (std::size_t k = 0; k < 4; ++k) w[k] = alpha * height * at(rise, k, q.time_s);
    const auto lift = [&](const Eigen::Vector3d& p) {
      const double u = (p.x() - x.from_mm) / x.length();
      const double v = (p.y() - y.from_mm) / y.length();
      return (1.0 - v) * ((1.0 - u) * w[0] + u * w[1]) + v * ((1.0 - u) * w[2] + u * w[3]);
    };
    const double u = (q.position_mm.x() - x.from_mm) / x.length();
    const double v = (q.position_mm.y() - y.from_mm) / y.length();
    const double slope_x = ((1.0 - v) * (w[1] - w[0]) + v * (w[3] - w[2])) / x.length();
    const double slope_y = ((1.0 - u) * (w[2] - w[0]) + u * (w[3] - w[1])) / y.length();
    const double z = q.position_mm.z() - origin.z();
    SmallError e;
    e.rotation_rad = {slope_y, -slope_x, 0.0};
    e.translation_mm = {-slope_x * z, -slope_y * z, lift(q.position_mm) - lift(origin)};
    return e;
  };
}

/// Left and right rail along Y: 600 mm of each before the travel follow the heat, what the bridge travels on takes up a
/// tenth of it.
PlantEffectFunction yawingBridge(const VirtualMachine& plant, const Eigen::Vector3d& origin, const Rise& drive) {
  const Span y = spanOf(plant.machine(), "Y", 0.0);
  Random random(plant.seed() ^ 0xbed2ULL);
  const Signals rise =
      shared(followers(drive, {volume(random, 0.0), volume(random, 1.0), volume(random, 0.1)}, plant.duration_s()));
  const double alpha = steel_per_K * plant.parameters().expansion;
  return [=](const PlantQuery& q) {
    const double left = at(rise, 0, q.time_s);
    const double right = at(rise, 1, q.time_s);
    const double along = at(rise, 2, q.time_s);
    const Eigen::Vector3d r = q.position_mm - origin;
    const double yaw = alpha * (600.0 * (right - left) + along * (q.position_mm.y() - y.from_mm)) / 900.0;
    SmallError e;
    e.rotation_rad.z() = yaw;
    e.translation_mm = {-yaw * r.y(), yaw * r.x() + 0.5 * alpha * along * r.y(), 0.0};
    return e;
  };
}

}  // namespace

std::vector<SampledSignal> followers(const Rise& drive, const std::vector<Follower>& volumes, double duration_s) {
  std::vector<SampledSignal> signals(volumes.size());
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    SampledSignal& signal = signals[i];
    const double take = 1.0 - std::exp(-signal.step_s / volumes[i].lag_s);
    double value = 0.0;
    signal.values.push_back(value);
    const auto steps = static_cast<std::size_t>(std::ceil(duration_s / signal.step_s));
    for (std::size_t k = 0; k < steps; ++k) {
      value += take * (volumes[i].part * drive((static_cast<double>(k) + 0.5) * signal.step_s) - value);
      signal.values.push_back(value);
    }
  }
  return signals;
}

PlantEffectFunction turningFrame(const VirtualMachine& plant, int axis, const Eigen::Vector3d& origin_mm,
                                 const Rise& drive) {
  return axis == 2 ? yawingBridge(plant, origin_mm, drive) : tiltingBed(plant, axis, origin_mm, drive);
}

PlantEffectFunction turningGuideway(const VirtualMachine& plant, double origin_y_mm, const Rise& drive) {
  const Span y = spanOf(plant.machine(), "Y", 40.0);
  constexpr int cells = 8;
  std::vector<Follower> volumes{{1.0, 300.0}};  // the saddle, then one flank of the guideway
  for (int i = 0; i < cells; ++i) volumes.push_back({0.25 * std::exp(-i / 6.0), 400.0 + 100.0 * i});
  const Signals rise = shared(followers(drive, volumes, plant.duration_s()));
  const double alpha = steel_per_K * plant.parameters().expansion;
  const RodIndex guideway{0, cells, y.from_mm, y.to_mm};
  return [=](const PlantQuery& q) {
    std::vector<double> warm;
    for (std::size_t i = 0; i < cells; ++i) warm.push_back(at(rise, i + 1, q.time_s));
    const std::vector<double> cold(cells, 0.0);
    const auto bent = [&](double place) { return cantilever(guideway, warm, cold, alpha, 250.0, place).deflection_mm; };
    const double place = q.position_mm.y() - q.tool_offset_mm.y();
    const double turn = 0.8 * alpha * at(rise, 0, q.time_s);
    SmallError e;
    e.translation_mm.x() = -(turn * (place - origin_y_mm) + bent(place) - bent(origin_y_mm));
    return e;
  };
}

PlantEffectFunction rotaryHub(const VirtualMachine& plant, const std::string& id, const Rise& drive, const Rise& hub) {
  const Eigen::Vector3d centre = plant.machine().rotary.front().centre_mm;
  const double alpha = steel_per_K * plant.parameters().expansion;
  if (id == "rotary.expansion.r0t") {
    const Signals rings = shared(followers(hub, {{0.93, 300.0}, {0.86, 600.0}}, plant.duration_s()));
    return [=](const PlantQuery& q) {
      const std::vector<double> rise{hub(q.time_s), at(rings, 0, q.time_s), at(rings, 1, q.time_s)};
      const Eigen::Vector2d r = q.placeOnTable_mm().head<2>() - centre.head<2>();
      const double growth = strainIntegral_mm({0, 3, 0.0, 360.0}, rise, alpha, 0.0, r.norm());
      SmallError e;
      if (r.norm() > 0.0) e.translation_mm.head<2>() = -growth * r.normalized();
      return e;
    };
  }
  // Walls towards +x, +y, -x, -y at 160 mm from the axis, 160 mm high.
  const bool tilt = id.starts_with("rotary.tilt");
  const std::string which = id.substr(id.rfind('.') + 1);
  const int axis = tilt ? which.front() - 'a' : which.front() - 'x';
  Random random(plant.seed() ^ (0x40b0ULL + static_cast<std::uint64_t>(axis + (tilt ? 3 : 0))));
  std::vector<Follower> walls;
  const bool lifts = !tilt && axis == 2;
  for (int k = 0; k < 4; ++k) {
    const bool warm = lifts || (tilt && ((axis == 0 && k == 1) || (axis == 1 && k == 2)));
    walls.push_back(volume(random, warm ? 1.0 : 0.0));
  }
  walls.push_back({1.0, random.uniform(150.0, 300.0)});  // the side of the housing that the motor stands on
  const Signals rise = shared(followers(lifts ? hub : drive, walls, plant.duration_s()));
  return [=](const PlantQuery& q) {
    std::array<double, 5> t{};
    for (std::size_t k = 0; k < 5; ++k) t[k] = at(rise, k, q.time_s);
    SmallError table;  // movement of the table in MCF at its centre
    constexpr double radius = 160.0;
    constexpr double height = 160.0;
    table.rotation_rad.x() = alpha * height * (t[1] - t[3]) / (2.0 * radius);
    table.rotation_rad.y() = -alpha * height * (t[0] - t[2]) / (2.0 * radius);
    const double mean = 0.25 * (t[0] + t[1] + t[2] + t[3]);
    table.translation_mm.z() = alpha * height * mean * (lifts ? 1.0 : 0.1);
    if (tilt && axis == 2) {
      table.rotation_rad.z() = alpha * 0.5 * t[4];
      table.translation_mm.head<2>() = alpha * 90.0 * Eigen::Vector2d(t[0], t[1]);
    } else if (!tilt && !lifts) {
      table.translation_mm[axis] = alpha * 90.0 * t[4];
      table.translation_mm[1 - axis] = alpha * 90.0 * t[0];
    }
    return -table.at(q.position_mm - centre);
  };
}

Eigen::Vector2d columnOverhang_mm(const MachineDescription& machine, const PlantEffectSetting& setting) {
  Eigen::Vector2d overhang = Eigen::Vector2d::Zero();
  const auto column = machine.source.find("column");
  if (column != machine.source.end() && column->is_object()) {
    const auto stated = column->find("overhang_mm");
    if (stated != column->end() && stated->is_array() && stated->size() == 2 && (*stated)[0].is_number() &&
        (*stated)[1].is_number()) {
      overhang = {(*stated)[0].get<double>(), (*stated)[1].get<double>()};
    }
  }
  return {setting.parameter("overhang_x_mm", overhang.x()), setting.parameter("overhang_y_mm", overhang.y())};
}

void liftOverhang(SmallError& e, const Eigen::Vector2d& overhang_mm) {
  e.translation_mm.z() += e.rotation_rad.x() * overhang_mm.y() - e.rotation_rad.y() * overhang_mm.x();
}

}  // namespace spindrift
