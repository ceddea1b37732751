// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/review_workflow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/workflows/fit_campaign.h"

namespace spindrift {
namespace {

/// Changes of a state from the reference, by point.
std::vector<ReviewPoint> measuredPoints(const ObservationSet& observations, const std::string& state) {
  const std::vector<std::string> states = observations.states();
  if (std::find(states.begin(), states.end(), state) == states.end())
    throw InputError(
        fmt::format("State '{}' is not among the observations; allowed: one of {}.", state, states.size()));
  const std::string& reference = states.front();
  std::vector<ReviewPoint> points;
  const auto place = [&](const std::string& id) -> ReviewPoint* {
    const auto at = std::find_if(points.begin(), points.end(), [&](const ReviewPoint& p) { return p.id == id; });
    return at == points.end() ? nullptr : &*at;
  };
  for (const Observation& o : observations.rows) {
    if (o.state != state) continue;
    ReviewPoint* p = place(o.point);
    if (p == nullptr) {
      points.push_back({o.point, o.position_mm, true, {}});
      p = &points.back();
    }
    p->used = p->used && o.use == ObservationUse::Fit;
    p->components[o.component] = {o.value, o.sigma};
  }
  if (state == reference) return points;
  for (const Observation& o : observations.rows) {
    if (o.state != reference) continue;
    ReviewPoint* p = place(o.point);
    if (p == nullptr || !p->components.contains(o.component)) continue;
    ReviewValue& v = p->components[o.component];
    v = {v.value - o.value, std::hypot(v.sigma, o.sigma)};
  }
  return points;
}

void findLargest(ReviewPicture& picture) {
  picture.largest = 0.0;
  for (const ReviewPoint& p : picture.points) {
    const auto v = p.components.find(picture.component);
    if (v != p.components.end() && std::isfinite(v->second.value))
      picture.largest = std::max(picture.largest, std::abs(v->second.value));
  }
  if (!picture.field) return;
  for (std::size_t i = 0; i < picture.field->value.size(); ++i)
    if (std::isfinite(picture.field->sigma[i]))
      picture.largest = std::max(picture.largest, std::abs(picture.field->value[i]));
}

FieldGrid gridOf(const MachineDescription& machine, const NineParameterFit& fit, int nodes) {
  double z = 0.0;
  for (const NineParameterResidual& r : fit.residuals)
    z += r.position_mm.z() / static_cast<double>(fit.residuals.size());
  FieldGrid grid = tableGrid(machine, nodes, nodes, z);
  const double x = grid.x_to_mm - grid.x_from_mm, y = grid.y_to_mm - grid.y_from_mm;
  grid.nx = std::max(2, static_cast<int>(std::lround(nodes * x / std::max(x, y))));
  grid.ny = std::max(2, static_cast<int>(std::lround(nodes * y / std::max(x, y))));
  return grid;
}

/// Puts the model's value (or measured minus model) in the place of the measured one.
void applyModel(ReviewPicture& picture, const NineParameterFit& fit, bool residual) {
  const NineParameterModel model = fit.model();
  for (ReviewPoint& p : picture.points) {
    DeviationQuery here;
    here.state = fit.state;
    here.position_mm = p.position_mm;
    for (auto& [component, v] : p.components) {
      const PredictedComponent predicted = model.predict(here, component);
      if (!std::isfinite(predicted.sigma)) {
        v = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
      } else if (residual) {
        v.value -= predicted.value;  // sigma stays that of the measurement
      } else {
        v = {predicted.value, predicted.sigma};
      }
    }
  }
}

const char* nameOf(ReviewQuantity quantity) {
  return quantity == ReviewQuantity::Measured ? "measured" : quantity == ReviewQuantity::Model ? "model" : "residual";
}

}  // namespace

ReviewPicture reviewOf(const ObservationSet& observations, const MachineDescription& machine,
                       const ReviewRequest& request) {
  ReviewPicture picture;
  picture.component = request.component;
  picture.title = fmt::format("{} {}", request.state, nameOf(request.quantity));
  picture.points = measuredPoints(observations, request.state);
  if (request.quantity != ReviewQuantity::Measured) {
    try {
      NineParameterOptions options;
      options.state = request.state;
      const NineParameterFit fit = fitNineParameters(observations, options);
      if (fit.status == FitStatus::Rejected) throw InputError(fit.message);
      applyModel(picture, fit, request.quantity == ReviewQuantity::Residual);
      if (request.quantity == ReviewQuantity::Model) {
        picture.field =
            tableField(fit, fit.model(), gridOf(machine, fit, std::max(2, request.nodes)), request.component);
        picture.field->markers.clear();
        const auto& s = picture.field->sigma;
        if (std::none_of(s.begin(), s.end(), [](double v) { return std::isfinite(v); })) {
          picture.field.reset();
          picture.message = fmt::format("{} has no heat map: {}", toString(request.component), fit.message);
        }
      }
    } catch (const InputError& error) {
      picture.points.clear();
      picture.message = fmt::format("No model of {}: {}", request.state, error.what());
    }
  }
  findLargest(picture);
  return picture;
}

ReviewPicture reviewDifference(const ReviewPicture& a, const ReviewPicture& b) {
  ReviewPicture d;
  d.component = b.component;
  d.title = fmt::format("{} minus {}", b.title, a.title);
  for (const ReviewPoint& p : b.points) {
    const auto other =
        std::find_if(a.points.begin(), a.points.end(), [&](const ReviewPoint& q) { return q.id == p.id; });
    if (other == a.points.end()) continue;
    ReviewPoint both{p.id, p.position_mm, p.used && other->used, {}};
    for (const auto& [component, v] : p.components) {
      const auto w = other->components.find(component);
      if (w != other->components.end())
        both.components[component] = {v.value - w->second.value, std::hypot(v.sigma, w->second.sigma)};
    }
    if (!both.components.empty()) d.points.push_back(std::move(both));
  }
  if (a.field && b.field && a.component == b.component) {
    // Evaluated on b's grid; a's is looked up there (both are tables of machines, usually the same).
    d.field = *b.field;
    const FieldGrid& g = b.field->grid;
    const bool same = a.field->grid.nx == g.nx && a.field->grid.ny == g.ny && a.field->grid.x_from_mm == g.x_from_mm &&
                      a.field->grid.x_to_mm == g.x_to_mm && a.field->grid.y_from_mm == g.y_from_mm &&
                      a.field->grid.y_to_mm == g.y_to_mm;
    if (same) {
      for (std::size_t i = 0; i < d.field->value.size(); ++i) {
        d.field->value[i] -= a.field->value[i];
        d.field->sigma[i] = std::hypot(d.field->sigma[i], a.field->sigma[i]);
        if (!a.field->extrapolated.empty() && a.field->extrapolated[i]) d.field->extrapolated[i] = true;
      }
    } else {
      d.field.reset();
      d.message = "The tables differ in size, so there is no difference of heat maps; the common points are compared.";
    }
  }
  if (d.points.empty() && !d.field) d.message = "The two have neither a point nor a heat map in common.";
  findLargest(d);
  return d;
}

ReviewSection reviewSection(const Field& field, bool along_x, double at_mm) {
  ReviewSection section;
  const FieldGrid& g = field.grid;
  const double from = along_x ? g.y_from_mm : g.x_from_mm, to = along_x ? g.y_to_mm : g.x_to_mm;
  const int across = along_x ? g.ny : g.nx, along = along_x ? g.nx : g.ny;
  const double u = std::clamp((at_mm - from) / (to - from), 0.0, 1.0) * (across - 1);
  const int low = std::min(static_cast<int>(u), across - 2);
  const double part = u - low;
  for (int i = 0; i < along; ++i) {
    const std::size_t a = along_x ? g.index(i, low) : g.index(low, i);
    const std::size_t b = along_x ? g.index(i, low + 1) : g.index(low + 1, i);
    const double sigma = (1.0 - part) * field.sigma[a] + part * field.sigma[b];
    if (!std::isfinite(sigma)) continue;
    section.place_mm.push_back(along_x ? g.x_mm(i) : g.y_mm(i));
    section.value.push_back((1.0 - part) * field.value[a] + part * field.value[b]);
    section.sigma.push_back(sigma);
  }
  return section;
}

}  // namespace spindrift
