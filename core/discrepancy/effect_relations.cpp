// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/effect_relations.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Rows of a sketch: what is a combination stays one in any mixture of the rows.
constexpr Index sketch_rows = 48;
/// Part of a column's power that may be outside for rounding.
constexpr double same_shape = 1e-9;

bool includes(Dynamics wide, Dynamics narrow) {
  if (wide == narrow) return true;
  switch (wide) {
    case Dynamics::Lag:
      return narrow == Dynamics::None;
    case Dynamics::AsymmetricLag:
      return narrow == Dynamics::Lag || narrow == Dynamics::None;
    case Dynamics::Pulse:
      return narrow == Dynamics::Step;
    case Dynamics::None:
    case Dynamics::Step:
    case Dynamics::Start:
      return false;
  }
  return false;
}

bool covers(const EffectVariant& wide, const EffectVariant& narrow) {
  return std::all_of(narrow.inputs.begin(), narrow.inputs.end(), [&](const EffectInput& b) {
    return std::any_of(wide.inputs.begin(), wide.inputs.end(),
                       [&](const EffectInput& a) { return a.driver == b.driver && includes(a.dynamics, b.dynamics); });
  });
}

bool drivenAs(const Effect& wide, const Effect& narrow, bool any_way) {
  if (wide.variants.empty() || narrow.variants.empty()) return false;
  const auto covered = [&](const EffectVariant& b) {
    return std::any_of(wide.variants.begin(), wide.variants.end(),
                       [&](const EffectVariant& a) { return covers(a, b); });
  };
  return any_way ? std::any_of(narrow.variants.begin(), narrow.variants.end(), covered)
                 : std::all_of(narrow.variants.begin(), narrow.variants.end(), covered);
}

/// Orthonormal basis of the columns that are not zero.
Eigen::MatrixXd basisOf(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd out(columns.rows(), columns.cols());
  Index used = 0;
  for (Index c = 0; c < columns.cols(); ++c) {
    Eigen::VectorXd v = columns.col(c);
    const double whole = v.norm();
    for (int pass = 0; pass < 2; ++pass) v -= out.leftCols(used) * (out.leftCols(used).transpose() * v);
    if (!(v.norm() > 1e-6 * whole) || !(whole > 0.0)) continue;
    out.col(used++) = v / v.norm();
  }
  return out.leftCols(used);
}

bool inside(const Eigen::MatrixXd& basis, const Eigen::MatrixXd& columns) {
  for (Index c = 0; c < columns.cols(); ++c) {
    const Eigen::VectorXd v = columns.col(c);
    if ((v - basis * (basis.transpose() * v)).squaredNorm() > same_shape * v.squaredNorm()) return false;
  }
  return true;
}

}  // namespace

EffectRelations effectRelations(const std::vector<Effect>& effects, const std::vector<Eigen::MatrixXd>& shapes,
                                bool any_way) {
  EffectRelations out;
  const std::size_t count = effects.size();
  out.holds.resize(count);
  if (count == 0) return out;
  // Sketches of all shapes: bases, and their columns one unit long.
  Random random(1);
  const Index rows = shapes.front().rows();
  Eigen::MatrixXd mixture(sketch_rows, rows);
  for (double& m : mixture.reshaped()) m = random.normal();
  std::vector<Index> basis_begin{0};
  std::vector<Index> column_begin{0};
  std::vector<Eigen::MatrixXd> bases;
  std::vector<Eigen::MatrixXd> units;
  for (const Eigen::MatrixXd& shape : shapes) {
    const Eigen::MatrixXd sketch = mixture * shape;
    bases.push_back(basisOf(sketch));
    Eigen::MatrixXd unit(sketch_rows, 0);
    for (Index c = 0; c < sketch.cols(); ++c) {
      if (!(sketch.col(c).norm() > 0.0)) continue;
      unit.conservativeResize(Eigen::NoChange, unit.cols() + 1);
      unit.rightCols<1>() = sketch.col(c).normalized();
    }
    units.push_back(unit);
    basis_begin.push_back(basis_begin.back() + bases.back().cols());
    column_begin.push_back(column_begin.back() + unit.cols());
  }
  Eigen::MatrixXd all_units(sketch_rows, column_begin.back());
  for (std::size_t b = 0; b < count; ++b) all_units.middleCols(column_begin[b], units[b].cols()) = units[b];
  std::vector<std::vector<bool>> holds(count, std::vector<bool>(count, false));
  std::vector<std::vector<bool>> partly(any_way ? count : 0, std::vector<bool>(count, false));
  for (std::size_t a = 0; a < count; ++a) {
    if (bases[a].cols() == 0) continue;
    const Eigen::MatrixXd dots = bases[a].transpose() * all_units;
    Eigen::MatrixXd basis;  // over all rows, once it is needed
    for (std::size_t b = 0; b < count; ++b) {
      if (a == b || units[b].cols() == 0) continue;
      bool within = true;
      for (Index c = column_begin[b]; within && c < column_begin[b + 1]; ++c) {
        within = dots.col(c).squaredNorm() > 1.0 - 1e-6;
      }
      if (!within || !drivenAs(effects[a], effects[b], any_way)) continue;
      if (basis.size() == 0) basis = basisOf(shapes[a]);
      if (!inside(basis, shapes[b])) continue;
      holds[a][b] = drivenAs(effects[a], effects[b], false);
      if (any_way) partly[a][b] = true;
    }
  }
  for (std::size_t a = 0; a < partly.size(); ++a) {
    for (std::size_t b = 0; b < count; ++b) {
      if (partly[a][b] && !partly[b][a]) holds[a][b] = true;
    }
  }
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < count; ++b) {
      if (!holds[a][b]) continue;
      if (!holds[b][a]) {
        out.holds[a].push_back(b);
      } else if (a < b) {
        out.same.emplace_back(a, b);
      }
    }
  }
  return out;
}

}  // namespace spindrift
