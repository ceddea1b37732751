// SPDX-License-Identifier: Apache-2.0
#include "core/machine/measuring_points.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "core/base/random.h"
#include "core/machine/nine_parameter_model.h"

namespace spindrift {
namespace {

constexpr std::array<Component, 3> translations{Component::EX, Component::EY, Component::EZ};

/// Information of each candidate and moment matrix of the region, both in scaled parameters of similar size.
class Design {
 public:
  Design(const std::vector<Eigen::Vector3d>& candidates, const PlacementOptions& options) : options_(options) {
    const double x = std::max({1.0, std::abs(options.region_from_mm.x()), std::abs(options.region_to_mm.x())}) * 1e-3;
    const double y = std::max({1.0, std::abs(options.region_from_mm.y()), std::abs(options.region_to_mm.y())}) * 1e-3;
    scale_ << 1, 1, 1, 1 / y, 1 / x, 1 / x, 1 / y, 1 / x, 1 / y;
    for (const Eigen::Vector3d& p : candidates) {
      NineMatrix information = NineMatrix::Zero();
      for (const Component c : translations) {
        const NineVector row = scale_.cwiseProduct(nineParameterRow(p, c)) / sigma(c);
        information += row * row.transpose();
      }
      information_.push_back(information);
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

  [[nodiscard]] PlacementResult judge(std::vector<std::size_t> chosen) const {
    std::sort(chosen.begin(), chosen.end());
    NineMatrix information = NineMatrix::Zero();
    for (const std::size_t i : chosen) information += information_[i];
    PlacementResult result;
    result.chosen = std::move(chosen);
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
  NineVector scale_;
  double z_mm_ = 0.0;
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

PlacementResult judgeMeasuringPoints(const std::vector<Eigen::Vector3d>& candidates_mm,
                                     const std::vector<std::size_t>& chosen, const PlacementOptions& options) {
  return Design(candidates_mm, options).judge(chosen);
}

namespace {

/// The best choice in which free positions keep a distance from each other and from the fixed ones; nothing if there is
/// none that determines all parameters.
std::optional<PlacementResult> bestApart(const std::vector<Eigen::Vector3d>& candidates_mm,
                                         const PlacementOptions& options, const Design& design, double distance_mm,
                                         const JobContext& job) {
  NineMatrix base = NineMatrix::Zero();
  for (const std::size_t i : options.fixed) base += design.information(i);
  const auto apart = [&](std::size_t a, std::size_t b) {
    return (candidates_mm[a] - candidates_mm[b]).norm() >= distance_mm - 1e-9;
  };
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < candidates_mm.size(); ++i) {
    if (std::find(options.fixed.begin(), options.fixed.end(), i) != options.fixed.end()) continue;
    if (std::all_of(options.fixed.begin(), options.fixed.end(), [&](std::size_t f) { return apart(i, f); })) {
      free.push_back(i);
    }
  }
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
          best.clear();
          for (std::size_t k = 0; k < wanted; ++k) best.push_back(free[pick[k]]);
          found = true;
        }
        if (++tried % 4096 == 0) job.throwIfCancelled();
        return;
      }
      for (std::size_t i = from; i + (wanted - depth) <= free.size(); ++i) {
        bool keeps = true;
        for (std::size_t k = 0; k < depth && keeps; ++k) keeps = apart(free[i], free[pick[k]]);
        if (!keeps) continue;
        pick[depth] = i;
        sum[depth + 1] = sum[depth] + design.information(free[i]);
        self(self, depth + 1, i + 1);
      }
    };
    descend(descend, 0, 0);
  } else {
    Random random(options.seed);
    for (int start = 0; start < options.starts; ++start) {
      job.throwIfCancelled();
      job.report(start / static_cast<double>(options.starts), "choosing positions");
      std::vector<std::size_t> order(free.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
      // The first ones of a random order that keep the distance go to its front.
      std::size_t taken = 0;
      for (std::size_t i = 0; i < order.size() && taken < wanted; ++i) {
        bool keeps = true;
        for (std::size_t k = 0; k < taken && keeps; ++k) keeps = apart(free[order[i]], free[order[k]]);
        if (keeps) std::swap(order[taken++], order[i]);
      }
      if (taken < wanted) continue;
      NineMatrix sum = base;
      for (std::size_t k = 0; k < wanted; ++k) sum += design.information(free[order[k]]);
      double cost = design.cost(sum);
      for (bool improved = true; improved;) {
        improved = false;
        std::size_t out = 0;
        std::size_t in = 0;
        double lowest = cost;
        for (std::size_t k = 0; k < wanted; ++k) {
          const NineMatrix without = sum - design.information(free[order[k]]);
          for (std::size_t i = wanted; i < order.size(); ++i) {
            bool keeps = true;
            for (std::size_t other = 0; other < wanted && keeps; ++other) {
              keeps = other == k || apart(free[order[i]], free[order[other]]);
            }
            if (!keeps) continue;
            const double cost_with = design.cost(without + design.information(free[order[i]]));
            if (cost_with < lowest - 1e-12 * std::abs(lowest) || (std::isinf(lowest) && std::isfinite(cost_with))) {
              lowest = cost_with;
              out = k;
              in = i;
              improved = true;
            }
          }
        }
        if (improved) {
          std::swap(order[out], order[in]);
          sum = base;
          for (std::size_t k = 0; k < wanted; ++k) sum += design.information(free[order[k]]);
          cost = lowest;
        }
      }
      if (cost < best_cost || !found) {
        best_cost = cost;
        best.clear();
        for (std::size_t k = 0; k < wanted; ++k) best.push_back(free[order[k]]);
        found = true;
      }
    }
  }
  if (!found) return std::nullopt;
  best.insert(best.end(), options.fixed.begin(), options.fixed.end());
  PlacementResult result = design.judge(best);
  result.exhaustive = exhaustive;
  result.least_distance_mm = distance_mm;
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
