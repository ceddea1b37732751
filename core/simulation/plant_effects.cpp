// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/plant_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/units.h"
#include "core/simulation/carrying_bodies.h"
#include "core/simulation/structure.h"

namespace spindrift {
namespace {

/// What every function below looks at; copied into closures.
struct View {
  const VirtualMachine* plant;
  const ThermalRun* run;
  const BodyIndex* b;
  double alpha;

  explicit View(const VirtualMachine& machine)
      : plant(&machine),
        run(&machine.thermal()),
        b(&machine.thermal().bodies),
        alpha(steel_per_K * machine.parameters().expansion) {}

  /// What the machine's own heat adds to a volume.
  double own(int node, double t) const { return run->heated.at(node, t) - run->passive.at(node, t); }
  double ownMean(const RodIndex& rod, double t) const {
    return run->heated.meanRise(rod, t) - run->passive.meanRise(rod, t);
  }
  double rise(int node, double t) const { return run->heated.rise(node, t); }
  double mean(const RodIndex& rod, double t) const { return run->heated.meanRise(rod, t); }
};

Eigen::Vector3d reference(const PlantQuery& q) {
  return q.position_mm - q.tool_offset_mm;
}

/// The body that drives a cause whose driver may be chosen.
std::function<double(double)> chosenDriver(const View& v, const std::string& driver) {
  if (driver == "column") return [v](double t) { return v.mean(v.b->column[0], t); };
  if (driver == "spindle") return [v](double t) { return v.ownMean(v.b->head_bottom, t); };
  return [v](double t) { return v.mean(v.b->pedestal, t); };
}

/// Turns by the angle of a body at the spindle reference: what the error model calls complete translations, plus the
/// lever of a tool that stands off the reference.
SmallError statedAtReference(const SmallError& e, const PlantQuery& q) {
  return e.at(q.tool_offset_mm);
}

PlantEffectFunction spindleEffect(const View& v, const std::string& id) {
  if (id == "spindle.growth.z") {  // the nose grows out of the rear bearing, towards the table
    return [v](const PlantQuery& q) {
      return translation(2, -v.alpha * v.ownMean(v.b->shaft, q.time_s) * (v.b->shaft.to_mm - v.b->shaft.from_mm));
    };
  }
  if (id == "spindle.centrifugal.z") {  // balls climb in their grooves and pull the shaft back
    return [v](const PlantQuery& q) {
      const double part = v.plant->programme().at(q.time_s).spindle_rpm / 6000.0;
      return translation(2, 0.008 * part * part);
    };
  }
  if (id == "spindle.drift.y") {  // the head grows away from the column
    return [v](const PlantQuery& q) {
      const double rise = 0.5 * (v.ownMean(v.b->head_top, q.time_s) + v.ownMean(v.b->head_bottom, q.time_s));
      return translation(1, -v.alpha * rise * (v.b->head_top.to_mm - v.b->head_top.from_mm));
    };
  }
  // spindle.drift.x: the motor side of the housing is 90 mm off the plane of symmetry
  return [v](const PlantQuery& q) { return translation(0, v.alpha * 90.0 * v.own(v.b->housing.first + 3, q.time_s)); };
}

PlantEffectFunction headTilt(const View& v, const std::string& id, const PlantEffectSetting& s) {
  const Eigen::Vector3d lever(s.parameter("lever_x_mm", 40.0), s.parameter("lever_y_mm", -280.0),
                              s.parameter("lever_z_mm", -220.0));
  const bool ram = s.parameter("ram", 0.0) != 0.0;  // the pivot does not travel with Z
  const int axis = lastAxis(id);
  return [v, lever, ram, axis](const PlantQuery& q) {
    double angle = 0.0;
    if (axis == 0) {
      // The lower side is warmer: the nose rises, a negative turn about X since the head points towards -Y.
      const std::vector<double> low = rises(v.run->heated, v.b->head_bottom, q.time_s);
      std::vector<double> top = rises(v.run->heated, v.b->head_top, q.time_s);
      angle = -cantilever(v.b->head_top, low, top, v.alpha, 220.0, v.b->head_top.to_mm).slope_rad;
    } else {
      const double difference = v.own(v.b->housing.first + 3, q.time_s) - v.ownMean(v.b->head_bottom, q.time_s);
      angle = v.alpha * difference * 1.2;  // motor side against the other side of the head
    }
    Eigen::Vector3d r = lever + q.tool_offset_mm;
    if (ram) r.z() += reference(q).z();
    SmallError e;
    e.rotation_rad[axis] = angle;
    e.translation_mm = e.rotation_rad.cross(r);
    return e;
  };
}

PlantEffectFunction columnEffect(const View& v, const std::string& id, const PlantEffectSetting& s) {
  if (id == "column.expansion.z") {
    return [v](const PlantQuery& q) {
      std::vector<double> mean(static_cast<std::size_t>(v.b->column[0].count), 0.0);
      for (const RodIndex& wall : v.b->column) {
        const std::vector<double> rise = rises(v.run->heated, wall, q.time_s);
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += 0.25 * rise[i];
      }
      const RodIndex& wall = v.b->column[0];
      return translation(2, strainIntegral_mm(wall, mean, v.alpha, wall.from_mm, reference(q).z()));
    };
  }
  const bool about_x = id.back() == 'a';
  const Eigen::Vector2d overhang = columnOverhang_mm(v.plant->machine(), s);
  return [v, about_x, overhang](const PlantQuery& q) {
    const RodIndex& hot = v.b->column[about_x ? 0 : 2];
    const RodIndex& cold = v.b->column[about_x ? 1 : 3];
    const Bending bend = cantilever(hot, rises(v.run->heated, hot, q.time_s), rises(v.run->heated, cold, q.time_s),
                                    v.alpha, 380.0, reference(q).z());
    SmallError e;
    if (about_x) {  // a warm front (towards -Y) leans the column back, towards +Y
      e.translation_mm.y() = bend.deflection_mm;
      e.rotation_rad.x() = -bend.slope_rad;
    } else {  // a warm left wall (-X) leans it towards +X
      e.translation_mm.x() = bend.deflection_mm;
      e.rotation_rad.y() = bend.slope_rad;
    }
    liftOverhang(e, overhang);
    return statedAtReference(e, q);
  };
}

PlantEffectFunction screwEffect(const View& v, const std::string& id) {
  const int axis = lastAxis(id);
  const MachineDescription& machine = v.plant->machine();
  const LinearAxis* linear = machine.findAxis(std::string(1, "XYZ"[axis]));
  const double fixed = linear->fixed_bearing_mm.value_or(linear->travel_mm[0]);
  const bool uniform = id.starts_with("ball_screw.expansion");
  return [v, &machine, axis, fixed, uniform](const PlantQuery& q) {
    const RodIndex& screw = v.b->screw[static_cast<std::size_t>(axis)];
    const double place = reference(q)[axis];
    const double evenly = v.alpha * v.mean(screw, q.time_s) * (place - fixed);
    double out = evenly;
    if (!uniform) {
      out = strainIntegral_mm(screw, rises(v.run->heated, screw, q.time_s), v.alpha, fixed, place) - evenly;
    }
    // A longer screw carries the moved part further from the fixed bearing; a table moves against the coordinate.
    const ChainAxis* in_chain = machine.chain.find(std::string(1, "XYZ"[axis]));
    const double sign = in_chain != nullptr && in_chain->carries_workpiece ? -1.0 : 1.0;
    return throughChain(machine, axis, translation(axis, sign * out), q);
  };
}

PlantEffectFunction scaleEffect(const View& v, const std::string& id) {
  const int axis = lastAxis(id);
  const LinearAxis* linear = v.plant->machine().findAxis(std::string(1, "XYZ"[axis]));
  const double datum = linear->datum_mm.value_or(linear->travel_mm[0]);
  const double glass_per_K = 8.5e-6 * v.plant->parameters().expansion;
  return [v, axis, datum, glass_per_K](const PlantQuery& q) {
    const double rise = v.rise(v.b->scale[static_cast<std::size_t>(axis)], q.time_s);
    return translation(axis, glass_per_K * rise * (reference(q)[axis] - datum));
  };
}

/// Displacement of a point of the table plate from its centre, in table coordinates (mm).
Eigen::Vector2d tableGrowth(const View& v, const Eigen::Vector2d& centre, const Eigen::Vector2d& at, double t) {
  constexpr int n = BodyIndex::table_cells;
  const auto along = [&](int axis) {
    const double from[2] = {v.b->table_from_x_mm, v.b->table_from_y_mm};
    const double to[2] = {v.b->table_to_x_mm, v.b->table_to_y_mm};
    const int other = 1 - axis;
    const double cross = std::clamp((at[other] - from[other]) / (to[other] - from[other]) * n - 0.5, 0.0, n - 1.0);
    const int low = std::min(static_cast<int>(cross), n - 2);
    const double part = cross - low;
    std::vector<double> rise(n);
    for (int i = 0; i < n; ++i) {
      const int a = axis == 0 ? v.b->table + low * n + i : v.b->table + i * n + low;
      const int b = axis == 0 ? a + n : a + 1;
      rise[static_cast<std::size_t>(i)] = (1.0 - part) * v.rise(a, t) + part * v.rise(b, t);
    }
    const RodIndex row{0, n, from[axis], to[axis]};
    return strainIntegral_mm(row, rise, v.alpha, centre[axis], at[axis]);
  };
  return {along(0), along(1)};
}

PlantEffectFunction tableEffect(const View& v) {
  const MachineDescription& machine = v.plant->machine();
  Eigen::Vector2d centre(0.5 * (v.b->table_from_x_mm + v.b->table_to_x_mm),
                         0.5 * (v.b->table_from_y_mm + v.b->table_to_y_mm));
  if (!machine.rotary.empty()) centre = machine.rotary.front().centre_mm.head<2>();
  if (machine.table_centre_mm) centre = *machine.table_centre_mm;
  return [v, centre](const PlantQuery& q) {
    const Eigen::Rotation2Dd mcf_from_table(q.c_rad);
    const Eigen::Vector2d in_table = mcf_from_table.inverse() * (q.placeOnTable_mm().head<2>() - centre) + centre;
    const Eigen::Vector2d moved = mcf_from_table * tableGrowth(v, centre, in_table, q.time_s);
    SmallError e;
    e.translation_mm.head<2>() = -moved;
    return e;
  };
}

PlantEffectFunction frameEffect(const View& v, const std::string& id, const PlantEffectSetting& s) {
  const auto driver = chosenDriver(v, s.driver);
  const Eigen::Vector3d origin(s.parameter("origin_x_mm", 0.0), s.parameter("origin_y_mm", 0.0),
                               s.parameter("origin_z_mm", 0.0));
  if (id.starts_with("squareness")) return turningGuideway(*v.plant, origin.y(), driver);
  return turningFrame(*v.plant, lastAxis(id), origin, driver);
}

PlantEffectFunction beamEffect(const View& v) {
  return [v](const PlantQuery& q) {
    const Bending bend =
        simplySupported(v.b->beam_top, rises(v.run->heated, v.b->beam_top, q.time_s),
                        rises(v.run->heated, v.b->beam_bottom, q.time_s), v.alpha, 320.0, reference(q).y());
    SmallError e;
    e.translation_mm.z() = bend.deflection_mm;
    e.rotation_rad.x() = bend.slope_rad;
    e.translation_mm += e.rotation_rad.cross(q.tool_offset_mm);
    return e;
  };
}

PlantEffectFunction rotaryEffect(const View& v, const std::string& id) {
  const auto drive = [v](double t) { return v.own(v.b->rotary_drive, t); };
  if (id == "rotary.expansion.r0t") {
    return rotaryHub(*v.plant, id, drive, [v](double t) { return v.rise(v.b->rotary_hub, t); });
  }
  return rotaryHub(*v.plant, id, drive, [v](double t) { return v.own(v.b->rotary_hub, t); });
}

PlantEffectFunction artefactEffect(const View& v) {
  const MachineDescription& machine = v.plant->machine();
  const Artefact& artefact = machine.artefacts.front();
  const double alpha = artefact.expansion_um_per_m_K.value_or(11.5) * 1e-6 * v.plant->parameters().expansion;
  if (artefact.kind == "hole_bar") {
    const Eigen::Vector3d centre =
        machine.rotary.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(machine.rotary.front().centre_mm);
    return [v, alpha, centre, &artefact](const PlantQuery& q) {
      const Eigen::AngleAxisd turn(q.c_rad, Eigen::Vector3d::UnitZ());
      const Eigen::Vector3d in_table = turn.inverse() * (q.position_mm - centre) - artefact.reference_in_table_mm;
      const double along = in_table.dot(artefact.direction_at_c0);
      RodIndex bar = v.b->artefact;
      const double growth = strainIntegral_mm(bar, rises(v.run->heated, bar, q.time_s), alpha, 0.0, along);
      SmallError e;
      e.translation_mm = -(turn * artefact.direction_at_c0) * growth;
      return e;
    };
  }
  // Balls on a frame: it grows from the first ball in all directions.
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  for (const MachinePoint& point : machine.points) {
    if (!artefact.balls.empty() && point.id == artefact.balls.front().id) first = point.position_mm;
  }
  return [v, alpha, first](const PlantQuery& q) {
    SmallError e;
    e.translation_mm = -alpha * v.mean(v.b->artefact, q.time_s) * (q.position_mm - first);
    return e;
  };
}

}  // namespace

int lastAxis(const std::string& id) {
  const char letter = id.back();
  return letter >= 'x' ? letter - 'x' : letter - 'a';
}

SmallError throughChain(const MachineDescription& machine, int axis, const SmallError& moved_part,
                        const PlantQuery& query) {
  const Eigen::Vector3d ref = reference(query);
  AxisPositions positions;
  for (int i = 0; i < 3; ++i) positions[std::string(1, "XYZ"[i])] = ref[i];
  const AxisErrors errors{{std::string(1, "XYZ"[axis]), moved_part}};
  return machine.chain.toolDeviation(positions, errors, query.tool_offset_mm);
}

PlantEffectFunction makePlantEffect(const VirtualMachine& plant, const std::string& id,
                                    const PlantEffectSetting& setting) {
  if (PlantEffectFunction mechanism = makeMechanismEffect(plant, id, setting)) return mechanism;
  const View v(plant);
  if (id.starts_with("spindle.")) return spindleEffect(v, id);
  if (id.starts_with("head.tilt")) return headTilt(v, id, setting);
  if (id.starts_with("column.")) return columnEffect(v, id, setting);
  if (id.starts_with("ball_screw.")) return screwEffect(v, id);
  if (id.starts_with("scale.")) return scaleEffect(v, id);
  if (id == "table.expansion.xy") return tableEffect(v);
  if (id.starts_with("frame.") || id.starts_with("squareness.")) return frameEffect(v, id, setting);
  if (id == "crossbeam.sag.z") return beamEffect(v);
  if (id.starts_with("rotary.")) return rotaryEffect(v, id);
  if (id == "artefact.expansion") return artefactEffect(v);
  if (id.starts_with("ambient.drift")) {
    // The bed follows the room; 500 mm of it stay uncompensated, and a tenth of what lies along the travel.
    const int axis = lastAxis(id);
    const LinearAxis* linear = plant.machine().findAxis(std::string(1, "XYZ"[axis]));
    const double middle = 0.5 * (linear->travel_mm[0] + linear->travel_mm[1]);
    return [v, axis, middle](const PlantQuery& q) {
      const double length = (axis == 1 ? -500.0 : 500.0) + 0.1 * (reference(q)[axis] - middle);
      return translation(axis, v.alpha * length * v.run->passive.meanRise(v.b->pedestal, q.time_s));
    };
  }
  SPINDRIFT_ASSERT(false, "an effect that whyNotPossible() knows and makePlantEffect() does not");
  return {};
}

}  // namespace spindrift
