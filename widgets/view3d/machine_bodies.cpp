// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/machine_bodies.h"

#include <QCoreApplication>
#include <algorithm>
#include <array>

namespace spindrift::gui {
namespace {

/// Positions are laid out in local directions: 0 = across (X), 1 = depth towards the column, 2 = up.
/// A vertical spindle has depth Y and up Z, a horizontal one depth Z and up Y.
struct Layout {
  std::array<int, 3> axis{0, 1, 2};

  [[nodiscard]] Eigen::Vector3d machine(const Eigen::Vector3d& local) const {
    Eigen::Vector3d p;
    for (int i = 0; i < 3; ++i) p[axis[static_cast<std::size_t>(i)]] = local[i];
    return p;
  }
  [[nodiscard]] Eigen::Vector3d local(const Eigen::Vector3d& machine_mm) const {
    Eigen::Vector3d p;
    for (int i = 0; i < 3; ++i) p[i] = machine_mm[axis[static_cast<std::size_t>(i)]];
    return p;
  }
};

QString translated(const char* text) {
  return QCoreApplication::translate("MachineBodies", text);
}

struct Extent {
  double low = 0;
  double high = 0;
  [[nodiscard]] double middle() const { return 0.5 * (low + high); }
  [[nodiscard]] double length() const { return high - low; }
};

}  // namespace

MachineBodies machineBodies(const MachineDescription& machine) {
  MachineBodies result;
  Layout layout;
  const bool vertical = machine.chain.verticalSpindle();
  if (!vertical) layout.axis = {0, 2, 1};
  result.vertical = vertical ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();

  std::array<Extent, 3> travel{Extent{0, 300}, Extent{0, 200}, Extent{0, 200}};
  for (const LinearAxis& axis : machine.axes) {
    const std::size_t letter = std::string_view("XYZ").find(axis.name.empty() ? ' ' : axis.name.front());
    if (letter == std::string_view::npos) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      if (static_cast<std::size_t>(layout.axis[i]) == letter) travel[i] = {axis.travel_mm[0], axis.travel_mm[1]};
    }
  }
  double table_height = travel[2].low;
  if (!machine.points.empty()) {
    table_height = layout.local(machine.points.front().position_mm).z();
    for (const MachinePoint& point : machine.points) {
      const Eigen::Vector3d p = layout.local(point.position_mm);
      table_height = std::min(table_height, p.z());
      for (int i = 0; i < 2; ++i) {
        auto& extent = travel[static_cast<std::size_t>(i)];
        extent.low = std::min(extent.low, p[i]);
        extent.high = std::max(extent.high, p[i]);
      }
    }
  }
  const double size = std::max({travel[0].length(), travel[1].length(), travel[2].length(), 1.0});
  const double margin = 0.06 * size;
  const Extent across{travel[0].low - margin, travel[0].high + margin};
  const Extent deep{travel[1].low - margin, travel[1].high + margin};
  const auto add = [&](QString name, BodyKind kind, Extent a, Extent d, Extent u) {
    const Eigen::Vector3d low = layout.machine({a.low, d.low, u.low});
    const Eigen::Vector3d high = layout.machine({a.high, d.high, u.high});
    result.bodies.push_back({std::move(name), kind, low.cwiseMin(high), low.cwiseMax(high)});
  };
  // A round body about a local direction.
  const auto addRound = [&](QString name, BodyKind kind, int about, Extent a, Extent d, Extent u) {
    add(std::move(name), kind, a, d, u);
    result.bodies.back().round_about = layout.axis[static_cast<std::size_t>(about)];
  };
  const auto around = [](double middle, double half) { return Extent{middle - half, middle + half}; };

  // Workpiece side: the table, then one slide for each further axis that carries it, down to the bed.
  double under = table_height;
  std::vector<const ChainAxis*> carriers;
  for (const ChainAxis& axis : machine.chain.axes()) {
    if (axis.carries_workpiece) carriers.push_back(&axis);
  }
  const double slab = 0.055 * size;
  add(translated("Table"), BodyKind::Table, across, deep, {under - slab, under});
  under -= slab;
  for (std::size_t i = 0; i < carriers.size(); ++i) {
    const ChainAxis& carrier = *carriers[i];
    const Eigen::Vector3d direction = layout.local(carrier.direction).cwiseAbs();
    const QString name = QString::fromStdString(carrier.name);
    if (carrier.rotary && direction.z() > 0.5) {  // a turning table: a disc
      const double radius = 0.4 * std::min(across.length(), deep.length());
      addRound(translated("%1 turning table").arg(name), BodyKind::WorkpieceSide, 2, around(across.middle(), radius),
               around(deep.middle(), radius), {under - 1.4 * slab, under});
      under -= 1.4 * slab;
      continue;
    }
    if (carrier.rotary) {  // a swivelling table: a shaft between two bearings
      const bool across_shaft = direction.x() > 0.5;
      const double radius = 0.09 * size;
      const Extent height{under - 2 * radius, under};
      const Extent& along = across_shaft ? across : deep;
      const Extent shaft_across = across_shaft ? along : around(across.middle(), radius);
      const Extent shaft_deep = across_shaft ? around(deep.middle(), radius) : along;
      addRound(translated("%1 swivel").arg(name), BodyKind::WorkpieceSide, across_shaft ? 0 : 1, shaft_across,
               shaft_deep, height);
      for (const double end : {along.low, along.high}) {
        const Extent bearing = around(end, 0.04 * size);
        add(translated("%1 bearing").arg(name), BodyKind::WorkpieceSide,
            across_shaft ? bearing : around(across.middle(), 1.3 * radius),
            across_shaft ? around(deep.middle(), 1.3 * radius) : bearing, {height.low, under - 0.2 * slab});
      }
      under = height.low;
      continue;
    }
    if (i == 0) continue;  // the slide that is the table
    const bool moves_across = direction.x() > 0.5;
    const Extent a = moves_across ? Extent{across.low + 0.1 * across.length(), across.high - 0.1 * across.length()}
                                  : around(across.middle(), 0.3 * across.length());
    const Extent d = moves_across ? around(deep.middle(), 0.3 * deep.length()) : deep;
    add(translated("%1 slide").arg(name), BodyKind::WorkpieceSide, a, d, {under - slab, under});
    under -= slab;
  }

  // Tool side.
  const double tip = table_height + 0.3 * travel[2].length() + 0.02 * size;
  const double column_front = deep.high + 0.03 * size;
  const double column_back = column_front + 0.24 * size;
  const double top = table_height + travel[2].length() + 0.5 * size;
  bool gantry = false;
  for (const ChainAxis& axis : machine.chain.axes()) {
    if (!axis.carries_workpiece && !axis.rotary && axis.direction.x() > 0.5) gantry = true;
  }
  const double bed_bottom = under - 0.12 * size;
  add(translated("Bed"), BodyKind::Bed, {across.low - 0.02 * size, across.high + 0.02 * size},
      {deep.low - 0.02 * size, column_back}, {bed_bottom, under});
  const double head_half = 0.1 * size;
  if (vertical) {
    const double a0 = travel[0].middle();
    const double d0 = travel[1].middle();
    const Extent head_height{tip + 0.16 * size, tip + 0.44 * size};
    if (gantry) {
      const double post = 0.07 * size;
      add(translated("Column"), BodyKind::Column, {across.low - 0.02 * size - post, across.low - 0.02 * size},
          around(column_front, 0.12 * size), {bed_bottom, head_height.high});
      add(translated("Column"), BodyKind::Column, {across.high + 0.02 * size, across.high + 0.02 * size + post},
          around(column_front, 0.12 * size), {bed_bottom, head_height.high});
      add(translated("Crossbeam"), BodyKind::Column,
          {across.low - 0.02 * size - post, across.high + 0.02 * size + post},
          {d0 + head_half, column_front + 0.1 * size}, {head_height.low + 0.05 * size, head_height.high});
    } else {
      add(translated("Column"), BodyKind::Column, around(a0, 0.2 * size), {column_front, column_back}, {under, top});
    }
    add(translated("Head"), BodyKind::ToolSide, around(a0, head_half),
        {d0 - head_half, gantry ? d0 + head_half : column_front}, head_height);
    for (const ChainAxis& axis : machine.chain.axes()) {
      if (!axis.rotary || axis.carries_workpiece || axis.spindle) continue;
      const Eigen::Vector3d direction = layout.local(axis.direction).cwiseAbs();
      const int about = direction.x() > 0.5 ? 0 : direction.y() > 0.5 ? 1 : 2;
      const double long_half = about == 2 ? 0.085 * size : 0.13 * size;
      addRound(translated("%1 swivel").arg(QString::fromStdString(axis.name)), BodyKind::ToolSide, about,
               around(a0, about == 0 ? long_half : 0.085 * size), around(d0, about == 1 ? long_half : 0.085 * size),
               {tip + 0.13 * size, tip + 0.30 * size});
    }
    addRound(translated("Spindle"), BodyKind::Spindle, 2, around(a0, 0.055 * size), around(d0, 0.055 * size),
             {tip + 0.05 * size, tip + 0.16 * size});
    addRound(translated("Tool"), BodyKind::Spindle, 2, around(a0, 0.012 * size), around(d0, 0.012 * size),
             {tip, tip + 0.05 * size});
  } else {
    const double a0 = travel[0].middle();
    const double u0 = table_height + 0.45 * travel[2].length();
    add(translated("Column"), BodyKind::Column, around(a0, 0.26 * size), {column_front, column_back}, {under, top});
    add(translated("Head"), BodyKind::ToolSide, around(a0, head_half), {column_front - 0.1 * size, column_front},
        around(u0, head_half));
    addRound(translated("Spindle"), BodyKind::Spindle, 1, around(a0, 0.055 * size),
             {column_front - 0.24 * size, column_front - 0.1 * size}, around(u0, 0.055 * size));
    addRound(translated("Tool"), BodyKind::Spindle, 1, around(a0, 0.012 * size),
             {column_front - 0.3 * size, column_front - 0.24 * size}, around(u0, 0.012 * size));
  }

  const auto motion = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, int local_axis) {
    const int direction = layout.axis[static_cast<std::size_t>(local_axis)];
    for (const LinearAxis& axis : machine.axes) {
      if (axis.name.empty() || axis.name.front() != "XYZ"[direction]) continue;
      result.motions.push_back(
          {QString::fromStdString(axis.name), direction, layout.machine(from), layout.machine(to)});
      return;
    }
  };
  const double beside = 0.1 * size;
  motion({travel[0].low, deep.low - beside, table_height}, {travel[0].high, deep.low - beside, table_height}, 0);
  motion({across.high + beside, travel[1].low, table_height}, {across.high + beside, travel[1].high, table_height}, 1);
  motion({across.low - beside, deep.high, table_height},
         {across.low - beside, deep.high, table_height + travel[2].length()}, 2);

  result.table_low_mm = layout.machine({across.low, deep.low, table_height});
  result.table_high_mm = layout.machine({across.high, deep.high, table_height});
  return result;
}

}  // namespace spindrift::gui
