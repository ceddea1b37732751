// SPDX-License-Identifier: Apache-2.0
#include "core/machine/measuring_points.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/random.h"
#include "core/machine/nine_parameter_model.h"

namespace spindrift {
namespace {

constexpr std::array<Component, 3> translations{Component::EX, Component::EY, Component::EZ};

/// Information of each candidate and moment matrix of the region, both in scaled parameters of similar size.
class Design {
 public:
  Design(const std::vector<Eigen::Vector3d>& candidates, const PlacementOptions& options)
      : options_(options), places_mm_(candidates) {
    const double x = std::max({1.0, std::abs(options.region_from_mm.x()), std::abs(options.region_to_mm.x())}) * 1e-3;
    const double y = std::max({1.0, std::abs(options.region_from_mm.y()), std::abs(options.region_to_mm.y())}) * 1e-3;
    scale_ << 1, 1, 1, 1 / y, 1 / x, 1 / x, 1 / y, 1 / x, 1 / y;
    for (const Eigen::Vector3d& p : candidates) {
      Rows rows;
      for (const Component c : translations)
        rows.row(static_cast<int>(c)) = (scale_.cwiseProduct(nineParameterRow(p, c)) / sigma(c)).transpose();
      rows_.push_back(rows);
      information_.emplace_back(rows.transpose() * rows);
      z_mm_ += p.z() / static_cast<double>(candidates.size());
    }
    moment_.setZero();
    constexpr int nodes = 21;
    for (int ix = 0; ix < nodes; ++ix) {
      for (int iy = 0; iy < nodes; ++iy) {
        for (const Component c : translations) {
          const NineVector row = regionRow(ix, iy, nodes, c);
          moment_ += row * row.transpose() / (3.0 * nodes * nodes);
        }
      }
    }
  }

  [[nodiscard]] const NineMatrix& information(std::size_t candidate) const { return information_[candidate]; }

  /// To be made small; infinite if singular.
  [[nodiscard]] double cost(const NineMatrix& information) const {
    const Eigen::LLT<NineMatrix> cholesky(information);
    const double singular = std::numeric_limits<double>::infinity();
    if (cholesky.info() != Eigen::Success) return singular;
    const NineVector diagonal = NineMatrix(cholesky.matrixL()).diagonal();
    // Rounding leaves a tiny positive pivot where the choice is singular.
    for (int i = 0; i < nine_parameter_count; ++i) {
      if (diagonal(i) * diagonal(i) < 1e-10 * information(i, i)) return singular;
    }
    if (options_.criterion == PlacementCriterion::D) return -2.0 * diagonal.array().log().sum();
    return std::sqrt(cholesky.solve(moment_).trace());
  }

  /// The cost with one more candidate, for many candidates: three more rows, not a matrix anew (matrix determinant
  /// lemma, Woodbury identity).
  [[nodiscard]] auto costsWith(const NineMatrix& information) const {
    const bool usable = std::isfinite(cost(information));
    NineMatrix covariance = NineMatrix::Zero();
    NineMatrix spread = NineMatrix::Zero();
    double alone = 0.0;
    if (usable) {
      const Eigen::LLT<NineMatrix> cholesky(information);
      covariance = cholesky.solve(NineMatrix::Identity());
      spread = covariance * moment_ * covariance;
      alone = options_.criterion == PlacementCriterion::D
                  ? -2.0 * NineMatrix(cholesky.matrixL()).diagonal().array().log().sum()
                  : (covariance * moment_).trace();
    }
    return [this, information, usable, covariance, spread, alone](std::size_t candidate) {
      if (!usable) return cost(information + information_[candidate]);
      const Rows& rows = rows_[candidate];
      const Eigen::Matrix3d capacity = Eigen::Matrix3d::Identity() + rows * covariance * rows.transpose();
      const double determinant = capacity.determinant();
      if (options_.criterion == PlacementCriterion::D) return alone - std::log(determinant);
      const Eigen::Matrix3d gain = rows * spread * rows.transpose();
      return std::sqrt(std::max(0.0, alone - capacity.inverse().cwiseProduct(gain).sum()));
    };
  }

  [[nodiscard]] PlacementResult judge(std::vector<std::size_t> chosen) const {
    std::sort(chosen.begin(), chosen.end());
    double closest_mm = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < chosen.size(); ++a)
      for (std::size_t b = a + 1; b < chosen.size(); ++b)
        closest_mm = std::min(closest_mm, (places_mm_[chosen[a]] - places_mm_[chosen[b]]).norm());
    NineMatrix information = NineMatrix::Zero();
    for (const std::size_t i : chosen) information += information_[i];
    PlacementResult result;
    result.chosen = std::move(chosen);
    result.least_distance_mm = closest_mm;
    if (!std::isfinite(cost(information))) {
      result.status = FitStatus::Degenerate;
      result.message =
          "the positions do not determine all nine parameters: at least three that are not on one line "
          "are needed";
      return result;
    }
    const Eigen::LLT<NineMatrix> cholesky(information);
    const NineMatrix covariance = cholesky.solve(NineMatrix::Identity());
    result.status = FitStatus::Converged;
    result.message = "all nine parameters are determined";
    result.log_det =
        2.0 * NineMatrix(cholesky.matrixL()).diagonal().array().log().sum() - 2.0 * scale_.array().log().sum();
    result.mean_sigma_um = std::sqrt((covariance * moment_).trace());
    constexpr int nodes = 11;
    for (int ix = 0; ix < nodes; ++ix) {
      for (int iy = 0; iy < nodes; ++iy) {
        for (const Component c : translations) {
          const NineVector row = regionRow(ix, iy, nodes, c);
          result.largest_sigma_um = std::max(result.largest_sigma_um, std::sqrt(row.dot(covariance * row)));
        }
      }
    }
    result.parameter_sigma = scale_.cwiseProduct(covariance.diagonal().cwiseSqrt());
    return result;
  }

 private:
  using Rows = Eigen::Matrix<double, 3, nine_parameter_count>;

  [[nodiscard]] double sigma(Component c) const {
    return c == Component::EZ ? options_.sigma_z_um : options_.sigma_xy_um;
  }
  [[nodiscard]] NineVector regionRow(int ix, int iy, int nodes, Component c) const {
    const Eigen::Vector2d part(ix / (nodes - 1.0), iy / (nodes - 1.0));
    const Eigen::Vector2d xy =
        options_.region_from_mm + (options_.region_to_mm - options_.region_from_mm).cwiseProduct(part);
    return scale_.cwiseProduct(nineParameterRow({xy.x(), xy.y(), z_mm_}, c));
  }

  const PlacementOptions& options_;
  const std::vector<Eigen::Vector3d>& places_mm_;
  NineVector scale_;
  double z_mm_ = 0.0;
  std::vector<Rows> rows_;
  std::vector<NineMatrix> information_;
  NineMatrix moment_;
};

double choices(std::size_t n, std::size_t k) {
  double count = 1.0;
  for (std::size_t i = 0; i < k; ++i) count *= static_cast<double>(n - i) / static_cast<double>(i + 1);
  return count;
}

}  // namespace

void PlacementOptions::validate(std::size_t candidates) const {
  if (count < 3) {
    throw InputError(fmt::format("{} positions are not enough; allowed: 3 or more for the nine parameters.", count));
  }
  if (static_cast<std::size_t>(count) > candidates) {
    throw InputError(fmt::format("{} positions cannot be chosen from {} candidates.", count, candidates));
  }
  if (fixed.size() > static_cast<std::size_t>(count)) {
    throw InputError(fmt::format("{} fixed positions are more than the {} to be chosen.", fixed.size(), count));
  }
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    SPINDRIFT_ASSERT(fixed[k] < candidates, "a fixed position must be a candidate");
    if (std::find(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(k), fixed[k]) !=
        fixed.begin() + static_cast<std::ptrdiff_t>(k))
      throw InputError("a position to be kept is listed twice; allowed: each once.");
  }
  if (least_distance_mm && !(*least_distance_mm >= 0.0)) {
    throw InputError(
        fmt::format("a distance of {:g} mm between positions is not allowed; allowed: 0 or more.", *least_distance_mm));
  }
  if (!(sigma_xy_um > 0.0) || !(sigma_z_um > 0.0)) {
    throw InputError("the uncertainties of a measured position must be greater than 0 µm.");
  }
  if (!(region_to_mm.x() > region_from_mm.x()) || !(region_to_mm.y() > region_from_mm.y())) {
    throw InputError("the region of the table is empty; allowed: to greater than from, in mm.");
  }
}

namespace {

/// A choice that keeps a distance: how many of the chosen stand too close to each candidate is counted.
class Choice {
 public:
  Choice(const std::vector<Eigen::Vector3d>& places_mm, double distance_mm)
      : places_mm_(places_mm), least_mm_(distance_mm - 1e-9), close_(places_mm.size(), 0) {}

  void take(std::size_t place) { change(place, 1); }
  void leave(std::size_t place) { change(place, -1); }
  [[nodiscard]] bool mayTake(std::size_t place) const { return close_[place] == 0; }

 private:
  void change(std::size_t place, int by) {
    for (std::size_t i = 0; i < close_.size(); ++i)  // itself too: nobody stands twice in one place
      if (i == place || (places_mm_[i] - places_mm_[place]).norm() < least_mm_) close_[i] += by;
  }

  const std::vector<Eigen::Vector3d>& places_mm_;
  double least_mm_;
  std::vector<int> close_;
};

/// The best choice in which free positions keep a distance from each other and from the fixed ones; nothing if there is
/// none that determines all parameters.
std::optional<PlacementResult> bestApart(const std::vector<Eigen::Vector3d>& candidates_mm,
                                         const PlacementOptions& options, const Design& design, double distance_mm,
                                         const JobContext& job) {
  Choice choice(candidates_mm, distance_mm);
  NineMatrix base = NineMatrix::Zero();
  for (const std::size_t i : options.fixed) {
    base += design.information(i);
    choice.take(i);
  }
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < candidates_mm.size(); ++i)
    if (choice.mayTake(i)) free.push_back(i);
  const std::size_t wanted = static_cast<std::size_t>(options.count) - options.fixed.size();
  if (free.size() < wanted) return std::nullopt;
  double best_cost = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> best;
  bool found = false;
  const bool exhaustive = choices(free.size(), wanted) <= static_cast<double>(options.exhaustive_limit);
  if (exhaustive) {
    // Depth first, ascending indices; the sums of information along the path are kept.
    std::vector<std::size_t> pick(wanted);
    std::vector<NineMatrix> sum(wanted + 1, base);
    std::size_t tried = 0;
    const auto descend = [&](auto&& self, std::size_t depth, std::size_t from) -> void {
      if (depth == wanted) {
        const double cost = design.cost(sum[depth]);
        if (cost < best_cost || !found) {
          best_cost = cost;
          best = pick;
          found = true;
        }
        if (++tried % 4096 == 0) job.throwIfCancelled();
        return;
      }
      for (std::size_t i = from; i + (wanted - depth) <= free.size(); ++i) {
        if (!choice.mayTake(free[i])) continue;
        pick[depth] = free[i];
        choice.take(free[i]);
        sum[depth + 1] = sum[depth] + design.information(free[i]);
        self(self, depth + 1, i + 1);
        choice.leave(free[i]);
      }
    };
    descend(descend, 0, 0);
  } else {
    // Many positions make one start as good as another, and a pass through all of them nearly as good as the next.
    constexpr double most_exchanges = 8e6;
    double looked_at = 0.0;
    Random random(options.seed);
    std::vector<std::size_t> order = free;
    for (int start = 0; start < options.starts && (start == 0 || looked_at < most_exchanges); ++start) {
      job.report(std::max(start / static_cast<double>(options.starts), std::min(1.0, looked_at / most_exchanges)),
                 "choosing positions");
      for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
      Choice current = choice;
      NineMatrix sum = base;
      std::vector<std::size_t> chosen;
      for (std::size_t i = 0; i < order.size() && chosen.size() < wanted; ++i) {
        if (!current.mayTake(order[i])) continue;
        current.take(order[i]);
        sum += design.information(order[i]);
        chosen.push_back(order[i]);
      }
      if (chosen.size() < wanted) continue;
      double cost = design.cost(sum);
      for (bool improved = true; improved;) {
        improved = false;
        for (std::size_t& place : chosen) {
          job.throwIfCancelled();
          current.leave(place);
          const NineMatrix without = sum - design.information(place);
          const auto costWith = design.costsWith(without);
          std::size_t into = place;
          double lowest = cost;
          for (const std::size_t i : free) {
            if (i == place || !current.mayTake(i)) continue;
            looked_at += 1.0;
            const double here = costWith(i);
            if (here < lowest - 1e-12 * std::abs(lowest) || (std::isinf(lowest) && std::isfinite(here))) {
              lowest = here;
              into = i;
            }
          }
          improved = improved || into != place;
          place = into;
          current.take(place);
          sum = without + design.information(place);
          cost = lowest;
        }
        sum = base;  // rounding does not gather
        for (const std::size_t i : chosen) sum += design.information(i);
        cost = design.cost(sum);
        if (looked_at >= most_exchanges) break;
      }
      if (cost < best_cost || !found) {
        best_cost = cost;
        best = chosen;
        found = true;
      }
    }
  }
  if (!found) return std::nullopt;
  best.insert(best.end(), options.fixed.begin(), options.fixed.end());
  PlacementResult result = design.judge(best);
  result.exhaustive = exhaustive;
  return result;
}

}  // namespace

PlacementResult chooseMeasuringPoints(const std::vector<Eigen::Vector3d>& candidates_mm,
                                      const PlacementOptions& options, const JobContext& job) {
  options.validate(candidates_mm.size());
  const Design design(candidates_mm, options);
  double distance_mm = options.least_distance_mm.value_or(0.1 * (options.region_to_mm - options.region_from_mm).norm());
  std::optional<PlacementResult> best = bestApart(candidates_mm, options, design, distance_mm, job);
  // Not asked for by anybody: as far apart as the candidates allow.
  constexpr int halvings = 4;
  for (int i = 0; i <= halvings && !options.least_distance_mm; ++i) {
    if (best && best->status == FitStatus::Converged) break;
    distance_mm = i < halvings ? 0.5 * distance_mm : 0.0;
    best = bestApart(candidates_mm, options, design, distance_mm, job);
  }
  if (best) return *best;
  PlacementResult none;
  none.status = FitStatus::Degenerate;
  none.message = fmt::format("no choice of {} positions among the candidates keeps {:g} mm between any two",
                             options.count, distance_mm);
  return none;
}

}  // namespace spindrift
