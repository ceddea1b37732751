// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/artefact_design.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/base/atomic_file.h"
#include "core/base/printed_number.h"
#include "core/base/units.h"
#include "core/machine/component.h"

namespace spindrift {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

struct Place {
  Eigen::Vector3d point;
  Eigen::Vector3d g;
};

std::string directionName(const Vector6& direction) {
  std::string name;
  for (const Component k : all_components) {
    const double v = direction[static_cast<int>(k)];
    if (std::abs(v) < 0.15) continue;
    name += fmt::format("{}{:+.2f} {}", name.empty() ? "" : " ", v, toString(k));
  }
  return name;
}

/// Triangles of a binary STL.
class StlText {
 public:
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    put((b - a).cross(c - a).normalized());
    put(a);
    put(b);
    put(c);
    body_.append(2, '\0');
    ++count_;
  }
  [[nodiscard]] std::string text() const {
    std::string out = "Artefact surface, mm";
    out.resize(80, ' ');
    word(out, count_);
    return out + body_;
  }

 private:
  static void word(std::string& out, std::uint32_t value) {
    for (int i = 0; i < 4; ++i) out.push_back(static_cast<char>((value >> (8 * i)) & 0xFFU));
  }
  void put(const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i) {
      const float f = static_cast<float>(v[i]);
      std::uint32_t bits = 0;
      std::memcpy(&bits, &f, sizeof bits);
      word(body_, bits);
    }
  }
  std::string body_;
  std::uint32_t count_ = 0;
};

}  // namespace

void ArtefactDesignOptions::validate() const {
  constexpr double least_um = 1e-6;
  constexpr double most_um = 1e6;
  if (!(noise_um >= least_um && noise_um <= most_um))
    throw InputError(fmt::format("Noise of the profiler: found {} µm; allowed: {:g} to {:g}.", printed(noise_um),
                                 printed(least_um), printed(most_um)));
  constexpr double most_points = 1e12;
  if (!(point_count >= 100.0 && point_count <= most_points))
    throw InputError(fmt::format("Number of points of a scan: found {}; allowed: 100 to {:g}.", printed(point_count),
                                 printed(most_points)));
  if (!(steepest_slope > 0.0))
    throw InputError(fmt::format("Steepest slope: found {}; allowed: more than 0.", printed(steepest_slope)));
  if (drift_order < 0 || drift_order > 2)
    throw InputError(fmt::format("Order of the drift: found {}; allowed: 0 to 2.", drift_order));
  if (!(weak_ratio > 1.0)) throw InputError("The ratio that makes a direction weak must be more than 1.");
  if (lattice < 10 || lattice > 5000)
    throw InputError(fmt::format("Places per side: found {}; allowed: 10 to 5000.", lattice));
}

ArtefactDesign designArtefact(const ArtefactSurface& surface, const ArtefactDesignOptions& options) {
  surface.validate();
  options.validate();
  ArtefactDesign design;
  std::vector<Place> places;
  const int n = options.lattice;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const double x = surface.size_mm.x() * (column + 0.5) / n;
      const double y = surface.size_mm.y() * (row + 0.5) / n;
      const Eigen::Vector2d slope = surface.gradient(x, y);
      design.largest_slope_x = std::max(design.largest_slope_x, std::abs(slope.x()));
      design.largest_slope_y = std::max(design.largest_slope_y, std::abs(slope.y()));
      if (slope.cwiseAbs().maxCoeff() > options.steepest_slope) continue;
      places.push_back({{x, y, surface.height_mm(x, y)}, {-slope.x(), -slope.y(), 1.0}});
    }
  design.visible_part = static_cast<double>(places.size()) / (static_cast<double>(n) * n);
  design.covariance.diagonal().setConstant(std::numeric_limits<double>::infinity());
  design.sigma.fill(std::numeric_limits<double>::infinity());
  if (design.visible_part < 0.05) {
    design.status = FitStatus::Rejected;
    design.message = fmt::format("Only {:.1f} % of the surface is flatter than the slope of {} that the profiler sees.",
                                 100.0 * design.visible_part, options.steepest_slope);
    return design;
  }
  for (const Place& p : places) design.centroid_mm += p.point / static_cast<double>(places.size());
  double square = 0.0;
  for (const Place& p : places) square += (p.point - design.centroid_mm).squaredNorm();
  design.length_mm = std::sqrt(square / static_cast<double>(places.size()));

  const bool push_broom = options.scan_model == ScanModel::PushBroom;
  const int drift = push_broom ? 3 * options.drift_order : 0;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(6 + drift, 6 + drift);
  Eigen::VectorXd jacobian(6 + drift);
  for (const Place& p : places) {
    Eigen::Vector3d q = p.point - design.centroid_mm;
    const double t = q.y() / (0.5 * surface.size_mm.y());
    if (push_broom) q.y() = 0.0;
    jacobian.head<3>() = p.g;
    jacobian.segment<3>(3) = q.cross(p.g) / design.length_mm;
    for (int k = 0; k < drift / 3; ++k) jacobian.segment<3>(6 + 3 * k) = p.g * std::pow(t, k + 1);
    normal.selfadjointView<Eigen::Lower>().rankUpdate(jacobian);
  }
  normal = Eigen::MatrixXd(normal.selfadjointView<Eigen::Lower>());
  const double sigma_mm = options.noise_um / um_per_mm;
  normal *= options.point_count / (static_cast<double>(n) * n) / (2.0 * sigma_mm * sigma_mm);

  Matrix6 information = normal.topLeftCorner<6, 6>();
  if (drift > 0) {
    // What a free drift explains is no information. The drift itself may be undetermined: pseudo-inverse.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> own(normal.bottomRightCorner(drift, drift));
    Eigen::VectorXd inverse = own.eigenvalues();
    const double limit = 1e-10 * inverse.maxCoeff();
    for (Eigen::Index i = 0; i < inverse.size(); ++i) inverse[i] = inverse[i] > limit ? 1.0 / inverse[i] : 0.0;
    const Eigen::MatrixXd cross = normal.topRightCorner(6, drift) * own.eigenvectors();
    information -= cross * inverse.asDiagonal() * cross.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(information);
  const double best = solver.eigenvalues()[5];
  const double free_limit = RegistrationOptions{}.degenerate_ratio * best;
  Matrix6 covariance = Matrix6::Zero();
  Vector6 lost = Vector6::Zero();
  for (int i = 0; i < 6; ++i) {
    const double value = solver.eigenvalues()[i];
    Vector6 v = solver.eigenvectors().col(i);
    Eigen::Index largest = 0;
    v.cwiseAbs().maxCoeff(&largest);
    if (v[largest] < 0.0) v = -v;
    const bool is_free = value <= free_limit;
    if (is_free)
      lost += v.cwiseAbs2();
    else
      covariance += v * v.transpose() / value;
    if (value * options.weak_ratio * options.weak_ratio > best) continue;
    design.weak.push_back(
        {directionName(v), v, is_free ? std::numeric_limits<double>::infinity() : um_per_mm / std::sqrt(value)});
  }
  Vector6 scale = Vector6::Ones();
  scale.tail<3>().setConstant(1.0 / design.length_mm);
  design.covariance = scale.asDiagonal() * covariance * scale.asDiagonal();
  std::string free_names;
  for (const Component k : all_components) {
    const int i = static_cast<int>(k);
    if (lost[i] > 1e-4) {
      design.covariance.row(i).setZero();
      design.covariance.col(i).setZero();
      design.covariance(i, i) = std::numeric_limits<double>::infinity();
      free_names += fmt::format(" {}", toString(k));
    }
    design.sigma[static_cast<std::size_t>(i)] =
        std::sqrt(design.covariance(i, i)) * (isRotation(k) ? urad_per_rad : um_per_mm);
  }
  design.status = free_names.empty() ? FitStatus::Converged : FitStatus::Degenerate;
  design.message = free_names.empty() ? "The surface determines all six errors."
                                      : fmt::format("The surface does not determine{}.", free_names);
  return design;
}

void writeArtefactStl(const std::filesystem::path& file, const ArtefactSurface& surface, double base_mm,
                      double step_mm) {
  surface.validate();
  if (!(base_mm > 0.0) || !std::isfinite(base_mm))
    throw InputError(fmt::format("Base below the lowest point: found {} mm; allowed: more than 0.", printed(base_mm)));
  const double longest = surface.size_mm.maxCoeff();
  if (!(step_mm >= longest / 2000.0) || !(step_mm <= surface.size_mm.minCoeff() / 2.0))
    throw InputError(fmt::format("Facets of the STL: found {} mm; allowed: {:.3g} to {:.3g} mm for this artefact.",
                                 printed(step_mm), printed(longest / 2000.0),
                                 printed(surface.size_mm.minCoeff() / 2.0)));
  const int columns = static_cast<int>(std::ceil(surface.size_mm.x() / step_mm));
  const int rows = static_cast<int>(std::ceil(surface.size_mm.y() / step_mm));
  std::vector<Eigen::Vector3d> top;
  double lowest = std::numeric_limits<double>::infinity();
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) {
      const double x = surface.size_mm.x() * c / columns;
      const double y = surface.size_mm.y() * r / rows;
      top.emplace_back(x, y, surface.height_mm(x, y));
      lowest = std::min(lowest, top.back().z());
    }
  const double bottom = lowest - base_mm;
  const auto up = [&](int c, int r) {
    return top[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns + 1) + static_cast<std::size_t>(c)];
  };
  const auto down = [&](int c, int r) {
    Eigen::Vector3d p = up(c, r);
    p.z() = bottom;
    return p;
  };
  StlText stl;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      stl.add(up(c, r), up(c + 1, r), up(c + 1, r + 1));
      stl.add(up(c, r), up(c + 1, r + 1), up(c, r + 1));
      stl.add(down(c, r), down(c + 1, r + 1), down(c + 1, r));
      stl.add(down(c, r), down(c, r + 1), down(c + 1, r + 1));
    }
  const auto wall = [&](int c0, int r0, int c1, int r1) {
    stl.add(down(c0, r0), down(c1, r1), up(c1, r1));
    stl.add(down(c0, r0), up(c1, r1), up(c0, r0));
  };
  for (int c = 0; c < columns; ++c) {
    wall(c, 0, c + 1, 0);
    wall(c + 1, rows, c, rows);
  }
  for (int r = 0; r < rows; ++r) {
    wall(0, r + 1, 0, r);
    wall(columns, r, columns, r + 1);
  }
  writeFileAtomically(file, stl.text());
}

}  // namespace spindrift
