// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/registration.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>

#include "core/base/count_text.h"
#include "core/base/job_context.h"
#include "core/base/text.h"
#include "core/scanning/pcl_bridge.h"
#include "core/scanning/registration_solver.h"

namespace spindrift {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::string direction(const Eigen::Vector3d& v) {
  const Eigen::Vector3d u = v.normalized();
  for (int i = 0; i < 3; ++i)
    if (std::abs(u[i]) > 0.98) return std::string(1, "XYZ"[i]);
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", u.x(), u.y(), u.z());
}

/// Names the directions that span the free space, shifts first.
std::vector<std::string> freeDirections(const Matrix6& projector, int count, double length,
                                        const Eigen::Vector3d& centre) {
  std::vector<std::string> names;
  // Pure shifts inside the free space: eigenvalues 1 of the upper left block.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> shifts(projector.topLeftCorner<3, 3>());
  Matrix6 rest = projector;
  for (int i = 2; i >= 0; --i)
    if (shifts.eigenvalues()[i] > 0.98) {
      names.push_back("shift along " + direction(shifts.eigenvectors().col(i)));
      Vector6 v = Vector6::Zero();
      v.head<3>() = shifts.eigenvectors().col(i);
      rest -= v * v.transpose();
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> others(rest);
  for (int i = 5; i >= 0 && static_cast<int>(names.size()) < count; --i) {
    if (others.eigenvalues()[i] < 0.5) break;
    const Eigen::Vector3d shift = others.eigenvectors().col(i).head<3>();
    const Eigen::Vector3d turn = others.eigenvectors().col(i).tail<3>() / length;
    const Eigen::Vector3d point = centre + turn.cross(shift) / std::max(turn.squaredNorm(), 1e-30);
    names.push_back(fmt::format("rotation about {} through ({:.1f}, {:.1f}, {:.1f}) mm", direction(turn), point.x(),
                                point.y(), point.z()));
  }
  return names;
}

void fillTransform(const ScanMotion& motion, const Eigen::Matrix3d& machine_from_profiler, RegistrationResult& result) {
  result.centroid_mm = motion.centre;
  result.translation_mm = motion.shift;
  result.rotation_rad = RigidTransform(motion.rotation, Eigen::Vector3d::Zero()).rotationVector_rad();
  result.drift_mm = motion.drift;
  result.drift_length_mm = motion.drift_length;
  const Eigen::Matrix3d r = machine_from_profiler.transpose() * motion.rotation * machine_from_profiler;
  result.target_from_source = RigidTransform(r, motion.centre + motion.to_cloud * motion.shift - r * motion.centre);
}

/// Translates, mirrors or swaps the axes of a cloud to see what would have fitted.
PointCloud mirrored(const PointCloud& cloud, int kind) {
  PointCloud out;
  out.name = cloud.name;
  out.points_mm = cloud.points_mm;
  const Eigen::Vector3d c = cloud.centroid_mm();
  for (Eigen::Vector3d& p : out.points_mm) {
    if (kind == 0) p.x() = 2.0 * c.x() - p.x();
    if (kind == 1) p.y() = 2.0 * c.y() - p.y();
    if (kind == 2) p.z() = 2.0 * c.z() - p.z();
    if (kind == 3) {
      p.x() = 2.0 * c.x() - p.x();
      p.y() = 2.0 * c.y() - p.y();
    }
  }
  return out;
}

/// Standard deviation of the heights about their plane (mm).
double reliefOf(const CellGrid& grid) {
  Eigen::Matrix3d n = Eigen::Matrix3d::Zero();
  Eigen::Vector3d r = Eigen::Vector3d::Zero();
  double zz = 0.0;
  for (const SurfaceCell& cell : grid.cells) {
    if (cell.count <= 0.0) continue;
    const Eigen::Vector3d d = cell.mean - grid.centroid_mm;
    const Eigen::Vector3d row(1.0, d.x(), d.y());
    n += cell.count * row * row.transpose();
    r += cell.count * d.z() * row;
    zz += cell.count * d.z() * d.z();
  }
  const Eigen::Vector3d plane = n.fullPivLu().solve(r);
  return std::sqrt(std::max(0.0, zz - plane.dot(r)) / n(0, 0));
}

/// What u can change by within half a scan (mm); machines drift by some um.
constexpr double largest_drift_mm = 0.5;

/// Cells agree within a hundredth of the relief, or within the noise where there is hardly any relief.
double agreeWithin_mm(const RegistrationTarget& target, double source_noise) {
  const double noise = std::sqrt(0.5 * (source_noise * source_noise + target.grid().noise_mm * target.grid().noise_mm));
  return std::max(0.01 * target.relief_mm(), 6.0 * noise);
}

bool fits(const RegistrationSolver::Outcome& o, const RegistrationTarget& target, const RegistrationOptions& options,
          double source_noise) {
  // A drift of the size of the artefact would turn its mirror image into itself.
  if (o.motion.drift_order > 0 && !(o.motion.drift.cwiseAbs().maxCoeff() < largest_drift_mm)) return false;
  return o.cells.size() >= 12 && o.inliers >= options.least_inliers &&
         o.median_residual < agreeWithin_mm(target, source_noise);
}

struct Matched {
  RegistrationSolver::Outcome outcome;
  double source_noise = 0.0;
};

/// Start, then search where it does not fit as well as the noise allows.
RegistrationSolver::Outcome match(const RegistrationSolver& solver, const RegistrationTarget& target,
                                  const CellGrid& source, const RegistrationOptions& options) {
  RegistrationSolver::Outcome best = solver.solve(solver.start(), solver.allCells(), options.most_iterations);
  const double noise =
      std::sqrt(0.5 * (source.noise_mm * source.noise_mm + target.grid().noise_mm * target.grid().noise_mm));
  const bool clean = fits(best, target, options, source.noise_mm) && best.scale < 3.0 * noise && best.inliers > 0.8 &&
                     best.overlap > 0.8;
  if (clean) return best;
  const RegistrationSolver::Outcome found = solver.search();
  if (found.cells.empty()) return best;
  RegistrationSolver::Outcome refined = solver.solve(found.motion, solver.allCells(), options.most_iterations);
  const bool best_fits = fits(best, target, options, source.noise_mm);
  const bool refined_fits = fits(refined, target, options, source.noise_mm);
  if (refined_fits != best_fits) return refined_fits ? refined : best;
  return solver.cost(refined) < 0.9 * solver.cost(best) ? refined : best;
}

}  // namespace

ScanModel scanModelFromString(std::string_view name) {
  if (name == "rigid") return ScanModel::Rigid;
  if (name == "push_broom") return ScanModel::PushBroom;
  throw InputError(fmt::format("Scan model '{}' is not known; allowed: rigid, push_broom.", name));
}

std::string_view toString(ScanModel model) noexcept {
  return model == ScanModel::Rigid ? "rigid" : "push_broom";
}

std::string_view printedName(ScanModel model) noexcept {
  return model == ScanModel::Rigid ? "rigid" : "push broom";
}

void RegistrationOptions::validate() const {
  if (most_iterations < 1) throw InputError("The registration needs at least one iteration.");
  if (!(tukey_threshold > 2.0)) throw InputError("Tukey's threshold must be above 2 standard deviations.");
  if (!(search_mm >= 0.0) || !(search_rad >= 0.0)) throw InputError("The range of the search must not be negative.");
  if (!start_translation_mm.allFinite() || !start_rotation_rad.allFinite())
    throw InputError("The start must be finite.");
  if (!(smooth_length_mm > 0.0)) throw InputError("The length over which errors change must be positive (mm).");
  if (at_y_mm && !std::isfinite(*at_y_mm)) throw InputError("The place along the scan must be finite (mm).");
  if (!(least_inliers >= 0.0 && least_inliers <= 1.0) || !(least_overlap >= 0.0 && least_overlap <= 1.0))
    throw InputError("The least parts of overlap and agreement must lie between 0 and 1.");
}

RegistrationTarget::RegistrationTarget(const PointCloud& cloud, const CellGridOptions& options)
    : grid_(compressCloud(cloud, options)), spline_(grid_), relief_mm_(reliefOf(grid_)) {}

namespace {

/// Of a source that is compressed already; `begin` is when its work began.
RegistrationResult registerCells(const PointCloud& source, const CellGrid& grid, const RegistrationTarget& target,
                                 const RegistrationOptions& options, Clock::time_point begin) {
  RegistrationResult result;
  result.scan_model = options.scan_model;
  result.method = "surface";
  const RegistrationSolver solver(grid, target, options);
  RegistrationSolver::Outcome o = match(solver, target, grid, options);
  if (options.scan_model == ScanModel::PushBroom && options.drift_order > 1 && o.converged) o = solver.bend(o);
  std::optional<FreeFormOutcome> changed;
  if (options.free_form) {
    changed = freeFormOutcome(solver, o, grid, target.grid(), options);
    if (changed && fits(changed->outcome, target, options, grid.noise_mm)) {
      o = std::move(changed->outcome);
    } else {
      changed.reset();
    }
  }
  fillTransform(o.motion, options.machine_from_profiler, result);
  result.covariance.diagonal().setConstant(std::numeric_limits<double>::infinity());
  result.white_covariance = result.covariance;
  result.iterations = o.iterations;
  result.inliers = o.inliers;
  double seen_points = 0.0, target_points = 0.0, squares = 0.0;
  for (const CellResidual& c : o.cells) {
    if (c.robust <= 0.0) continue;
    const SurfaceCell& cell = grid.cells[c.cell];
    seen_points += cell.count;
    squares += cell.count * c.residual * c.residual + (cell.count - 1.0) * std::max(cell.variance, 0.0);
  }
  for (const SurfaceCell& cell : target.grid().cells) target_points += cell.count > 0.0 ? 1.0 : 0.0;
  // Both lattices have their own cell size: compare areas.
  const double area =
      static_cast<double>(o.cells.size()) * grid.size.prod() / (target_points * target.grid().size.prod());
  result.overlap = std::min(1.0, area);
  result.points_used = static_cast<std::size_t>(seen_points);
  result.rms_mm = seen_points > 0.0 ? std::sqrt(squares / seen_points) : 0.0;
  result.elapsed_ms = millisecondsSince(begin);

  const auto reject = [&](FitStatus status, std::string message) {
    result.status = status;
    result.message = std::move(message);
    result.elapsed_ms = millisecondsSince(begin);
    return result;
  };
  const bool fitting = fits(o, target, options, grid.noise_mm);
  // A surface that nearly equals its own mirror image can be matched by half; then a mirrored one fits on far more.
  const double agreement = o.overlap * o.inliers;
  const bool doubtful = fitting && agreement < 0.75;
  const double relief = reliefOf(grid);
  if (!fitting && relief < 0.2 * target.relief_mm() && o.overlap > 0.5)
    return reject(FitStatus::Rejected,
                  fmt::format("The scan is nearly flat: its heights vary by {:.3g} mm about a plane, those of the "
                              "reference by {:.3g} mm; another surface, or none.",
                              relief, target.relief_mm()));
  if (!fitting || doubtful) {
    // Say what it is, if it is something known.
    constexpr const char* kinds[] = {"mirrored in x", "mirrored in y", "upside down (mirrored in z)",
                                     "turned by 180 degrees about Z"};
    int best_kind = -1;
    double best = 0.0;
    for (int kind = 0; kind < 4; ++kind) {
      const CellGrid other = compressCloud(mirrored(source, kind));
      const RegistrationSolver try_solver(other, target, options);
      const RegistrationSolver::Outcome t = match(try_solver, target, other, options);
      if (!fits(t, target, options, other.noise_mm) || t.overlap <= 0.6 || t.inliers <= 0.8) continue;
      if (doubtful && (t.overlap * t.inliers < agreement + 0.2 || t.median_residual > 1.5 * o.median_residual))
        continue;
      // The one that agrees on most of the surface without a large shift.
      const double merit = t.overlap * t.inliers - 0.01 * t.motion.shift.norm();
      if (best_kind >= 0 && merit <= best) continue;
      best_kind = kind;
      best = merit;
    }
    if (best_kind >= 0)
      return reject(FitStatus::Rejected,
                    fmt::format("The scan is {}: it matches the reference only after this transformation is undone.",
                                kinds[best_kind]));
  }
  if (!fitting) {
    if (o.cells.size() < 12) return reject(FitStatus::Rejected, "The scan and the reference have no common region.");
    const double within_mm = agreeWithin_mm(target, grid.noise_mm);
    const auto agreeing = std::count_if(o.cells.begin(), o.cells.end(),
                                        [&](const CellResidual& c) { return std::abs(c.residual) < within_mm; });
    return reject(
        FitStatus::Rejected,
        fmt::format("The scan does not show the same surface as the reference: after the best fit the heights differ "
                    "by {:.0f} µm "
                    "({:.0f} % of the cells agree); another artefact, something over it, or it has moved by more than "
                    "{:.1f} mm.",
                    1e3 * o.median_residual,
                    100.0 * static_cast<double>(agreeing) / static_cast<double>(o.cells.size()), options.search_mm));
  }
  if (result.overlap < options.least_overlap)
    return reject(FitStatus::Rejected,
                  fmt::format("The scan covers only {:.0f} % of the reference; at least {:.0f} % are needed.",
                              100.0 * result.overlap, 100.0 * options.least_overlap));
  if (!o.converged)
    return reject(FitStatus::NoConvergence,
                  agreement < 0.8
                      ? fmt::format("Only {:.0f} % of the reference is seen as it was (the rest is cut short or hidden "
                                    "by something), too little for the registration to settle.",
                                    100.0 * std::min(agreement, result.overlap))
                      : fmt::format("The registration did not settle within {} iterations.", options.most_iterations));

  RegistrationNoise noise = registrationNoise(o, grid, target.grid(), solver.inverseNormal(o));
  if (changed) {
    noise.covariance += changed->form.motion_covariance;
    result.free_form = std::move(changed->form);
  }
  result.covariance = noise.covariance;
  result.white_covariance = noise.white;
  result.misfit_ratio = noise.misfit_ratio;
  result.noise_correlation = noise.correlation;
  result.status = FitStatus::Converged;
  if (o.free_count > 0) {
    result.free_directions =
        freeDirections(o.free.topLeftCorner<6, 6>(), o.free_count, solver.length(), o.motion.centre);
    for (int i = 0; i < 6; ++i)
      if (o.free(i, i) > 0.01) {
        result.covariance.row(i).setZero();
        result.covariance.col(i).setZero();
        result.covariance(i, i) = std::numeric_limits<double>::infinity();
        result.white_covariance(i, i) = std::numeric_limits<double>::infinity();
      }
    result.status = FitStatus::Degenerate;
    result.message = fmt::format("The surface leaves {} free: {}.",
                                 o.free_count == 1 ? "one direction" : fmt::format("{} directions", o.free_count),
                                 joinedList(result.free_directions));
  }
  if (grid.stray_points > 0) {
    if (!result.message.empty()) result.message += " ";
    result.message += fmt::format("{} far outside the scan left out.", countOf(grid.stray_points, "point"));
  }
  result.elapsed_ms = millisecondsSince(begin);
  return result;
}

}  // namespace

RegistrationResult registerToSurface(const PointCloud& source, const RegistrationTarget& target,
                                     const RegistrationOptions& options) {
  options.validate();
  const auto begin = Clock::now();
  return registerCells(source, compressCloud(source), target, options, begin);
}

RegistrationResult registerClouds(const PointCloud& source, const PointCloud& target,
                                  const RegistrationOptions& options) {
  options.validate();
  const auto begin = Clock::now();
  // The clouds know nothing of each other until they are compressed; what is wrong with the source is said first.
  const auto forBoth = [](const auto& work) {
    std::array<std::exception_ptr, 2> failure;
    parallelFor(2, JobContext(), [&](std::size_t i) {
      try {
        work(i);
      } catch (const InputError&) {
        failure[i] = std::current_exception();
      }
    });
    for (const std::exception_ptr& f : failure)
      if (f) std::rethrow_exception(f);
  };
  forBoth([&](std::size_t i) { requireUsableCloud(i == 0 ? source : target); });
  if (options.method != RegistrationMethod::Surface) return registerWithPcl(source, target, options);
  RegistrationResult result;
  std::optional<InputError> unusable;
  try {
    CellGridOptions cells;
    cells.checked = true;
    CellGrid grid;
    std::optional<RegistrationTarget> surface;
    forBoth([&](std::size_t i) {
      if (i == 0) {
        grid = compressCloud(source, cells);
      } else {
        surface.emplace(target, cells);
      }
    });
    result = registerCells(source, grid, *surface, options, begin);
  } catch (const InputError& error) {
    if (!options.fall_back) throw;
    unusable = error;
    result.status = FitStatus::Rejected;
    result.message = error.what();
  }
  if (options.fall_back && result.status == FitStatus::Rejected) {
    RegistrationOptions other = options;
    other.method = RegistrationMethod::Gicp;
    RegistrationResult free_form;
    try {
      free_form = registerWithPcl(source, target, other);
    } catch (const InputError&) {
      if (unusable) throw *unusable;  // of no use either way: what is wrong with them as they are
    }
    if (free_form.usable()) {
      free_form.message =
          "As a height map the clouds do not fit (" + result.message + "); registered as free-form clouds.";
      result = std::move(free_form);
    }
  }
  result.elapsed_ms = millisecondsSince(begin);
  return result;
}

std::vector<float> deviations_um(const PointCloud& source, const RegistrationTarget& target,
                                 const RegistrationResult& registration, const RegistrationOptions& options) {
  Eigen::Matrix3d lever = options.machine_from_profiler;
  Eigen::Matrix3d m = lever;
  if (registration.scan_model == ScanModel::PushBroom) {
    m.col(1) = Eigen::Vector3d::UnitY();
    lever.col(1).setZero();
  }
  const Eigen::Matrix3d rotation =
      RigidTransform::fromRotationVector(registration.rotation_rad, Eigen::Vector3d::Zero()).rotation();
  const Eigen::Matrix3d to_cloud = m.inverse();
  const Eigen::Matrix3d turn = to_cloud * (rotation - Eigen::Matrix3d::Identity()) * lever;
  const Eigen::Vector3d shift = to_cloud * registration.translation_mm;
  const Eigen::Matrix<double, 3, 2> drift = to_cloud * registration.drift_mm;
  std::vector<float> out;
  out.reserve(source.size());
  HeightSpline::Value h;
  for (const Eigen::Vector3d& p : source.points_mm) {
    const double t = (p.y() - registration.centroid_mm.y()) / registration.drift_length_mm;
    const Eigen::Vector3d q =
        p + shift + drift.col(0) * t + drift.col(1) * (t * t) + turn * (p - registration.centroid_mm);
    out.push_back(target.surface().evaluate(q.x(), q.y(), h) ? static_cast<float>(1e3 * (q.z() - h.z)) : std::nanf(""));
  }
  return out;
}

}  // namespace spindrift
