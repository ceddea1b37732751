// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/machine_bodies.h"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <utility>

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

QString bodyText(const char* text) {
  return QCoreApplication::translate("MachineBodies", text);
}

struct Extent {
  double low = 0;
  double high = 0;
  [[nodiscard]] double middle() const { return 0.5 * (low + high); }
  [[nodiscard]] double length() const { return high - low; }
};

Extent extentAround(double middle, double half) {
  return {middle - half, middle + half};
}

/// Puts the bodies together: what carries the workpiece downwards from the table, then what carries the tool.
class Builder {
 public:
  Builder(const MachineDescription& machine, double lowest_mm)
      : machine_(machine), vertical_(machine.chain.verticalSpindle()), lowest_mm_(lowest_mm) {
    if (!vertical_) layout_.axis = {0, 2, 1};
    result_.vertical = vertical_ ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
    findExtents();
  }

  [[nodiscard]] MachineBodies build() {
    const double under = addWorkpieceSide();
    addToolSide(under);
    addMotions();
    result_.table_low_mm = layout_.machine({across_.low, deep_.low, table_height_});
    result_.table_high_mm = layout_.machine({across_.high, deep_.high, table_height_});
    return std::move(result_);
  }

 private:
  void findExtents();
  /// Returns the height at which the bed begins.
  double addWorkpieceSide();
  void addTurningTable(const QString& name, double& under);
  void addSwivellingTable(const QString& name, bool across_shaft, double& under);
  void addToolSide(double under);
  void addVerticalTool(double under, double bed_bottom);
  void addSwivelHeads(double across_middle, double deep_middle, double tip);
  void addHorizontalTool(double under);
  void addMotions();
  void addMotion(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int local_axis);

  void add(QString name, BodyKind kind, Extent a, Extent d, Extent u) {
    const Eigen::Vector3d low = layout_.machine({a.low, d.low, u.low});
    const Eigen::Vector3d high = layout_.machine({a.high, d.high, u.high});
    result_.bodies.push_back({std::move(name), kind, low.cwiseMin(high), low.cwiseMax(high)});
  }
  /// A round body about a local direction.
  void addRound(QString name, BodyKind kind, int about, Extent a, Extent d, Extent u) {
    add(std::move(name), kind, a, d, u);
    result_.bodies.back().round_about = layout_.axis[static_cast<std::size_t>(about)];
  }
  /// Absolute direction of an axis: across, deep, up.
  [[nodiscard]] Eigen::Vector3d localDirection(const ChainAxis& axis) const {
    return layout_.local(axis.direction).cwiseAbs();
  }

  const MachineDescription& machine_;
  bool vertical_;
  double lowest_mm_;
  Layout layout_;
  MachineBodies result_;
  std::array<Extent, 3> travel_{Extent{0, 300}, Extent{0, 200}, Extent{0, 200}};
  Extent across_;
  Extent deep_;
  double table_height_ = 0;
  double size_ = 1;  ///< the longest travel, to which everything is scaled
  double slab_ = 0;  ///< thickness of a slide
};

void Builder::findExtents() {
  for (const LinearAxis& axis : machine_.axes) {
    const std::size_t letter = std::string_view("XYZ").find(axis.name.empty() ? ' ' : axis.name.front());
    if (letter == std::string_view::npos) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      if (static_cast<std::size_t>(layout_.axis[i]) == letter) travel_[i] = {axis.travel_mm[0], axis.travel_mm[1]};
    }
  }
  table_height_ = travel_[2].low;
  if (!machine_.points.empty()) table_height_ = layout_.local(machine_.points.front().position_mm).z();
  for (const MachinePoint& point : machine_.points) {
    const Eigen::Vector3d p = layout_.local(point.position_mm);
    table_height_ = std::min(table_height_, p.z());
    for (int i = 0; i < 2; ++i) {
      auto& extent = travel_[static_cast<std::size_t>(i)];
      extent.low = std::min(extent.low, p[i]);
      extent.high = std::max(extent.high, p[i]);
    }
  }
  table_height_ = std::min(table_height_, lowest_mm_);
  size_ = std::max({travel_[0].length(), travel_[1].length(), travel_[2].length(), 1.0});
  slab_ = 0.055 * size_;
  const double margin = 0.06 * size_;
  across_ = {travel_[0].low - margin, travel_[0].high + margin};
  deep_ = {travel_[1].low - margin, travel_[1].high + margin};
}

double Builder::addWorkpieceSide() {
  double under = table_height_;
  add(bodyText("Table"), BodyKind::Table, across_, deep_, {under - slab_, under});
  under -= slab_;
  bool table_is_slide = true;  // the first linear axis moves the table itself
  for (const ChainAxis& axis : machine_.chain.axes()) {
    if (!axis.carries_workpiece) continue;
    const Eigen::Vector3d direction = localDirection(axis);
    const QString name = QString::fromStdString(axis.name);
    if (axis.rotary) {
      table_is_slide = false;
      direction.z() > 0.5 ? addTurningTable(name, under) : addSwivellingTable(name, direction.x() > 0.5, under);
      continue;
    }
    if (std::exchange(table_is_slide, false)) continue;
    const bool moves_across = direction.x() > 0.5;
    const Extent a = moves_across ? Extent{across_.low + 0.1 * across_.length(), across_.high - 0.1 * across_.length()}
                                  : extentAround(across_.middle(), 0.3 * across_.length());
    const Extent d = moves_across ? extentAround(deep_.middle(), 0.3 * deep_.length()) : deep_;
    add(bodyText("%1 slide").arg(name), BodyKind::WorkpieceSide, a, d, {under - slab_, under});
    under -= slab_;
  }
  return under;
}

void Builder::addTurningTable(const QString& name, double& under) {
  const double radius = 0.4 * std::min(across_.length(), deep_.length());
  const double height = 1.4 * slab_;
  addRound(bodyText("%1 turning table").arg(name), BodyKind::WorkpieceSide, 2, extentAround(across_.middle(), radius),
           extentAround(deep_.middle(), radius), {under - height, under});
  under -= height;
}

/// A shaft between two bearings.
void Builder::addSwivellingTable(const QString& name, bool across_shaft, double& under) {
  const double radius = 0.09 * size_;
  const Extent height{under - 2 * radius, under};
  const Extent& along = across_shaft ? across_ : deep_;
  addRound(bodyText("%1 swivel").arg(name), BodyKind::WorkpieceSide, across_shaft ? 0 : 1,
           across_shaft ? along : extentAround(across_.middle(), radius),
           across_shaft ? extentAround(deep_.middle(), radius) : along, height);
  for (const double end : {along.low, along.high}) {
    const Extent bearing = extentAround(end, 0.04 * size_);
    add(bodyText("%1 bearing").arg(name), BodyKind::WorkpieceSide,
        across_shaft ? bearing : extentAround(across_.middle(), 1.3 * radius),
        across_shaft ? extentAround(deep_.middle(), 1.3 * radius) : bearing, {height.low, under - 0.2 * slab_});
  }
  under = height.low;
}

void Builder::addToolSide(double under) {
  const double bed_bottom = under - 0.12 * size_;
  const double column_back = deep_.high + 0.27 * size_;
  add(bodyText("Bed"), BodyKind::Bed, {across_.low - 0.02 * size_, across_.high + 0.02 * size_},
      {deep_.low - 0.02 * size_, column_back}, {bed_bottom, under});
  vertical_ ? addVerticalTool(under, bed_bottom) : addHorizontalTool(under);
}

void Builder::addVerticalTool(double under, double bed_bottom) {
  const double head_half = 0.1 * size_;
  const double tip = table_height_ + 0.3 * travel_[2].length() + 0.02 * size_;
  const double top = table_height_ + travel_[2].length() + 0.5 * size_;
  const double column_front = deep_.high + 0.03 * size_;
  const double a0 = travel_[0].middle();
  const double d0 = travel_[1].middle();
  const Extent head_height{tip + 0.16 * size_, tip + 0.44 * size_};
  const auto& axes = machine_.chain.axes();
  const bool gantry = std::any_of(axes.begin(), axes.end(), [](const ChainAxis& axis) {
    return !axis.carries_workpiece && !axis.rotary && axis.direction.x() > 0.5;
  });
  if (gantry) {
    const double post = 0.07 * size_;
    const Extent posts{across_.low - 0.02 * size_ - post, across_.high + 0.02 * size_ + post};
    for (const Extent& side : {Extent{posts.low, posts.low + post}, Extent{posts.high - post, posts.high}}) {
      add(bodyText("Column"), BodyKind::Column, side, extentAround(column_front, 0.12 * size_),
          {bed_bottom, head_height.high});
    }
    add(bodyText("Crossbeam"), BodyKind::Column, posts, {d0 + head_half, column_front + 0.1 * size_},
        {head_height.low + 0.05 * size_, head_height.high});
  } else {
    add(bodyText("Column"), BodyKind::Column, extentAround(a0, 0.2 * size_),
        {column_front, column_front + 0.24 * size_}, {under, top});
  }
  add(bodyText("Head"), BodyKind::ToolSide, extentAround(a0, head_half),
      {d0 - head_half, gantry ? d0 + head_half : column_front}, head_height);
  addSwivelHeads(a0, d0, tip);
  addRound(bodyText("Spindle"), BodyKind::Spindle, 2, extentAround(a0, 0.055 * size_), extentAround(d0, 0.055 * size_),
           {tip + 0.05 * size_, tip + 0.16 * size_});
  addRound(bodyText("Tool"), BodyKind::Spindle, 2, extentAround(a0, 0.012 * size_), extentAround(d0, 0.012 * size_),
           {tip, tip + 0.05 * size_});
}

void Builder::addSwivelHeads(double across_middle, double deep_middle, double tip) {
  for (const ChainAxis& axis : machine_.chain.axes()) {
    if (!axis.rotary || axis.carries_workpiece || axis.spindle) continue;
    const Eigen::Vector3d direction = localDirection(axis);
    const int about = direction.x() > 0.5 ? 0 : direction.y() > 0.5 ? 1 : 2;
    const double radius = 0.085 * size_;
    const double long_half = about == 2 ? radius : 0.13 * size_;
    addRound(bodyText("%1 swivel").arg(QString::fromStdString(axis.name)), BodyKind::ToolSide, about,
             extentAround(across_middle, about == 0 ? long_half : radius),
             extentAround(deep_middle, about == 1 ? long_half : radius), {tip + 0.13 * size_, tip + 0.30 * size_});
  }
}

void Builder::addHorizontalTool(double under) {
  const double column_front = deep_.high + 0.03 * size_;
  const double top = table_height_ + travel_[2].length() + 0.5 * size_;
  const double a0 = travel_[0].middle();
  const double u0 = table_height_ + 0.45 * travel_[2].length();
  add(bodyText("Column"), BodyKind::Column, extentAround(a0, 0.26 * size_), {column_front, column_front + 0.24 * size_},
      {under, top});
  add(bodyText("Head"), BodyKind::ToolSide, extentAround(a0, 0.1 * size_), {column_front - 0.1 * size_, column_front},
      extentAround(u0, 0.1 * size_));
  addRound(bodyText("Spindle"), BodyKind::Spindle, 1, extentAround(a0, 0.055 * size_),
           {column_front - 0.24 * size_, column_front - 0.1 * size_}, extentAround(u0, 0.055 * size_));
  addRound(bodyText("Tool"), BodyKind::Spindle, 1, extentAround(a0, 0.012 * size_),
           {column_front - 0.3 * size_, column_front - 0.24 * size_}, extentAround(u0, 0.012 * size_));
}

void Builder::addMotions() {
  const double beside = 0.1 * size_;
  addMotion({travel_[0].low, deep_.low - beside, table_height_}, {travel_[0].high, deep_.low - beside, table_height_},
            0);
  addMotion({across_.high + beside, travel_[1].low, table_height_},
            {across_.high + beside, travel_[1].high, table_height_}, 1);
  addMotion({across_.low - beside, deep_.high, table_height_},
            {across_.low - beside, deep_.high, table_height_ + travel_[2].length()}, 2);
}

void Builder::addMotion(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int local_axis) {
  const int direction = layout_.axis[static_cast<std::size_t>(local_axis)];
  for (const LinearAxis& axis : machine_.axes) {
    if (axis.name.empty() || axis.name.front() != "XYZ"[direction]) continue;
    result_.motions.push_back(
        {QString::fromStdString(axis.name), direction, layout_.machine(from), layout_.machine(to)});
    return;
  }
}

}  // namespace

MachineBodies machineBodies(const MachineDescription& machine, double lowest_mm) {
  return Builder(machine, lowest_mm).build();
}

}  // namespace spindrift::gui
