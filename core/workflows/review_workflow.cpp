// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/review_workflow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/base/error.h"
#include "core/base/no_number.h"
#include "core/machine/interpolated_field.h"
#include "core/workflows/fit_campaign.h"

namespace spindrift {
namespace {

/// Point, component, angle of the table: readings of one place in one pose.
using Place = std::tuple<std::string, Component, double>;
using PlacedValues = std::map<Place, ReviewValue>;

Place placeOf(const Observation& o) {
  return {o.point, o.component, o.c_deg};
}

/// Mean per place over the rows of a state, of the observations or of a prediction. The sigma of repeated
/// measurements falls with their number; a model errs alike in all.
PlacedValues meansOf(const ObservationSet& observations, const std::string& state, const ReviewPrediction* prediction) {
  std::map<Place, double> counts;
  PlacedValues means;
  for (std::size_t r = 0; r < observations.rows.size(); ++r) {
    const Observation& o = observations.rows[r];
    if (o.state != state) continue;
    const double value = prediction == nullptr ? o.value : prediction->value[r];
    const double sigma = prediction == nullptr ? o.sigma : prediction->sigma[r];
    if (!std::isfinite(value)) continue;
    ReviewValue& mean = means[placeOf(o)];
    mean.value += value;
    mean.sigma = prediction == nullptr ? std::hypot(mean.sigma, sigma) : mean.sigma + sigma;
    counts[placeOf(o)] += 1.0;
  }
  for (auto& [place, mean] : means) {
    mean.value /= counts[place];
    mean.sigma /= counts[place];
  }
  return means;
}

/// Changes of a state from the reference, by point; of one angle of the table or of all.
std::vector<ReviewPoint> measuredPoints(const ObservationSet& observations, const std::string& state,
                                        const std::optional<double>& c_deg) {
  const std::vector<std::string> states = observations.states();
  if (std::find(states.begin(), states.end(), state) == states.end())
    throw InputError(
        fmt::format("State '{}' is not among the observations; allowed: one of {}.", state, states.size()));
  const PlacedValues now = meansOf(observations, state, nullptr);
  const PlacedValues cold = state == states.front() ? PlacedValues() : meansOf(observations, states.front(), nullptr);
  // What the readings have in common (the reference of an evaluation) counts once.
  std::map<Place, std::vector<std::size_t>> rows_now, rows_cold;
  for (std::size_t r = 0; r < observations.rows.size(); ++r) {
    const Observation& o = observations.rows[r];
    if (!std::isfinite(o.value)) continue;
    if (o.state == state) rows_now[placeOf(o)].push_back(r);
    if (o.state == states.front() && state != states.front()) rows_cold[placeOf(o)].push_back(r);
  }
  const auto sigmaOf = [&](const Place& place) {
    std::vector<SharedNoise::Load> combination;
    const std::vector<std::size_t>& after = rows_now.at(place);
    for (const std::size_t r : after) combination.push_back({r, 1.0 / static_cast<double>(after.size())});
    if (const auto before = rows_cold.find(place); before != rows_cold.end())
      for (const std::size_t r : before->second)
        combination.push_back({r, -1.0 / static_cast<double>(before->second.size())});
    double variance = observations.shared.varianceOf(combination);
    for (const SharedNoise::Load& part : combination)
      variance += part.load * part.load * observations.shared.ownVariance(part.row, observations.rows[part.row].sigma);
    return std::sqrt(variance);
  };
  std::vector<ReviewPoint> points;
  std::map<std::pair<std::string, double>, std::size_t> index;
  for (const Observation& o : observations.rows) {
    if (o.state != state || (c_deg && o.c_deg != *c_deg)) continue;
    const auto [at, fresh] = index.try_emplace({o.point, o.c_deg}, points.size());
    if (fresh) points.push_back({o.point, o.position_mm, o.c_deg, true, {}});
    ReviewPoint& p = points[at->second];
    p.used = p.used && o.use == ObservationUse::Fit;
    const auto here = now.find(placeOf(o));
    if (here == now.end() || p.components.contains(o.component)) continue;
    ReviewValue v = here->second;
    if (const auto before = cold.find(here->first); before != cold.end()) v.value -= before->second.value;
    v.sigma = sigmaOf(here->first);
    p.components[o.component] = v;
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

/// Puts the model's value (or measured minus model) in the place of the measured one.
void applyModel(ReviewPicture& picture, const NineParameterFit& fit, bool residual) {
  // With the misfit in its uncertainty, as the map and the compensation have it.
  const NineParameterModel model = fit.predictingModel();
  for (ReviewPoint& p : picture.points) {
    DeviationQuery here;
    here.state = fit.state;
    here.position_mm = p.position_mm;
    for (auto& [component, v] : p.components) {
      const PredictedComponent predicted = model.predict(here, component);
      if (!std::isfinite(predicted.sigma)) {
        v = {no_number, no_number};
      } else if (residual) {
        v.value -= predicted.value;  // sigma stays that of the measurement
      } else {
        v = {predicted.value, predicted.sigma};
      }
    }
  }
}

/// The nine parameters in place of the measured values, or what they leave; with their heat map.
void showNineParameters(ReviewPicture& picture, const ObservationSet& observations, const MachineDescription& machine,
                        const ReviewRequest& request) {
  try {
    NineParameterOptions options = request.fit;
    options.state = request.state;
    const NineParameterFit fit = fitNineParameters(observations, options);
    if (fit.status == FitStatus::Rejected) throw InputError(fit.message);
    applyModel(picture, fit, request.quantity == ReviewQuantity::NineParametersLeft);
    if (request.quantity != ReviewQuantity::NineParameters) return;
    double z = 0.0;
    for (const NineParameterResidual& r : fit.residuals)
      z += r.position_mm.z() / static_cast<double>(fit.residuals.size());
    const auto grid = mapTable(machine, z, std::max(2, request.nodes));
    if (!grid) {
      picture.message = "The machine has no X or no Y axis, so there is no heat map.";
      return;
    }
    picture.field = tableField(fit, fit.predictingModel(), *grid, request.component);
    picture.field->markers.clear();
    const auto& s = picture.field->sigma;
    if (std::none_of(s.begin(), s.end(), [](double v) { return std::isfinite(v); })) {
      picture.field.reset();
      picture.message = fmt::format("{} has no heat map: {}", toString(request.component), fit.message);
    }
  } catch (const InputError& error) {
    picture.points.clear();
    picture.message = fmt::format("No model of {}: {}", request.state, error.what());
  }
}

/// A prediction in place of the measured values, or what it leaves of them. Values of the reference are as they are.
void showPrediction(ReviewPicture& picture, const ObservationSet& observations, const ReviewRequest& request,
                    const ReviewPrediction* prediction) {
  if (prediction == nullptr || prediction->value.empty()) {
    picture.points.clear();
    picture.message = prediction == nullptr ? std::string("There is no such model.") : prediction->why;
    return;
  }
  const bool left =
      request.quantity == ReviewQuantity::SimulationLeft || request.quantity == ReviewQuantity::CompletedLeft;
  if (!left) picture.uncertainty = prediction->uncertainty;
  const std::string reference = observations.states().front();
  const PlacedValues now = meansOf(observations, request.state, prediction);
  const PlacedValues cold = request.state == reference ? PlacedValues() : meansOf(observations, reference, prediction);
  for (ReviewPoint& p : picture.points) {
    for (auto& [component, v] : p.components) {
      const auto here = now.find({p.id, component, p.c_deg});
      ReviewValue model = here == now.end() ? ReviewValue{no_number, no_number} : here->second;
      if (const auto before = cold.find({p.id, component, p.c_deg}); before != cold.end()) {
        // What a gain of the model is uncertain by moves both alike: the change is as uncertain as the larger part.
        model = {model.value - before->second.value, std::max(model.sigma, before->second.sigma)};
      }
      if (left)
        v.value -= model.value;  // sigma stays that of the measurement
      else
        v = model;
    }
  }
}

/// A field between the points that took part; of a state that is held out as a whole, between all.
void addFieldBetween(ReviewPicture& picture, const MachineDescription& machine, int nodes) {
  const bool held_out =
      std::none_of(picture.points.begin(), picture.points.end(), [](const ReviewPoint& p) { return p.used; });
  std::vector<ScatteredValue> values;
  double largest = 0.0, z = 0.0;
  std::set<double> angles;
  for (const ReviewPoint& p : picture.points) {
    const auto v = p.components.find(picture.component);
    if (v == p.components.end() || !(p.used || held_out) || !std::isfinite(v->second.value)) continue;
    values.push_back({p.position_mm, v->second.value, v->second.sigma});
    largest = std::max(largest, std::abs(v->second.value));
    z += p.position_mm.z();
    angles.insert(p.c_deg);
  }
  const auto why = [&picture](std::string reason) {
    if (picture.message.empty()) picture.message = std::move(reason);
  };
  if (angles.size() > 1)
    return why(fmt::format("Points at {} angles of the table have no common heat map: choose one.", angles.size()));
  if (values.size() > 2 && !spreadsOverPlane(values))
    return why("The points lie on one line, so there is no heat map between them.");
  if (!spreadsOverPlane(values)) return;
  // A prediction may state no uncertainty; a field needs some.
  const double least = std::max(1e-4, 1e-3 * largest);
  for (ScatteredValue& v : values) v.sigma = std::isfinite(v.sigma) ? std::max(v.sigma, least) : least;
  if (const auto grid = mapTable(machine, z / static_cast<double>(values.size()), std::max(2, nodes / 2)))
    picture.field = fieldBetween(picture.component, values, *grid);
}

}  // namespace

std::string_view toString(ReviewQuantity quantity) noexcept {
  switch (quantity) {
    case ReviewQuantity::Measured:
      return "measured";
    case ReviewQuantity::NineParameters:
      return "nine parameters";
    case ReviewQuantity::NineParametersLeft:
      return "measured minus nine parameters";
    case ReviewQuantity::Simulation:
      return "simulation";
    case ReviewQuantity::SimulationLeft:
      return "measured minus simulation";
    case ReviewQuantity::Completed:
      return "simulation with effects";
    case ReviewQuantity::CompletedLeft:
      return "measured minus simulation with effects";
  }
  return "";
}

ReviewPrediction reviewSimulation(const Campaign& campaign, const ObservationSet& observations) {
  ReviewPrediction out;
  try {
    out.value = discrepancyInput(campaign, observations).predicted;
    for (const double v : out.value) out.sigma.push_back(campaign.simulation_gain_uncertainty * std::abs(v));
    out.uncertainty = fmt::format("± is {:g} % of the simulated change", 100.0 * campaign.simulation_gain_uncertainty);
  } catch (const InputError& error) {
    out.why = error.what();
  }
  return out;
}

ReviewPrediction reviewCompleted(const DiscrepancyStory& story, const ObservationSet& observations) {
  ReviewPrediction out;
  if (story.added.empty()) {
    out.why = "No effect has been added to the simulation yet.";
    return out;
  }
  // Stories that keep no places tell no angles apart.
  std::map<std::tuple<std::string, Component, double, double>, ReviewValue> known;
  std::set<std::pair<std::string, Component>> placed;
  for (const DiscrepancySeries& s : story.series) {
    if (!s.places.empty()) placed.emplace(s.point, s.component);
    for (std::size_t i = 0; i < s.completed.size(); ++i)
      known[{s.point, s.component, s.time_s[i], s.placeOf(i).c_deg}] = {s.completed[i], s.completed_sigma[i]};
  }
  for (const Observation& o : observations.rows) {
    const double c_deg = placed.contains({o.point, o.component}) ? o.c_deg : 0.0;
    const auto at = known.find({o.point, o.component, o.time_s, c_deg});
    out.value.push_back(at == known.end() ? no_number : at->second.value);
    out.sigma.push_back(at == known.end() ? no_number : at->second.sigma);
  }
  return out;
}

std::vector<double> tableAngles(const ObservationSet& observations) {
  std::set<double> angles;
  for (const Observation& o : observations.rows) angles.insert(o.c_deg);
  return {angles.begin(), angles.end()};
}

ReviewPicture reviewOf(const ObservationSet& observations, const MachineDescription& machine,
                       const ReviewRequest& request, const ReviewPrediction* prediction) {
  ReviewPicture picture;
  picture.component = request.component;
  picture.title = fmt::format("{}, {}", request.state, toString(request.quantity));
  picture.points = measuredPoints(observations, request.state, request.c_deg);
  if (picture.points.empty() && request.c_deg)
    picture.message = fmt::format("{} was not measured with the table at {:g}°.", request.state, *request.c_deg);
  switch (request.quantity) {
    case ReviewQuantity::Measured:
      break;
    case ReviewQuantity::NineParameters:
    case ReviewQuantity::NineParametersLeft:
      showNineParameters(picture, observations, machine, request);
      break;
    default:
      showPrediction(picture, observations, request, prediction);
  }
  if (!picture.points.empty() && picture.message.empty() &&
      std::none_of(picture.points.begin(), picture.points.end(), [](const ReviewPoint& p) { return p.used; }))
    picture.message = "Held out: dashed points took no part in any fit.";
  if (request.heat_map && request.quantity != ReviewQuantity::NineParameters)
    addFieldBetween(picture, machine, request.nodes);
  findLargest(picture);
  return picture;
}

ReviewPicture reviewDifference(const ReviewPicture& a, const ReviewPicture& b) {
  ReviewPicture d;
  d.component = b.component;
  d.title = fmt::format("{} minus {}", b.title, a.title);
  for (const ReviewPoint& p : b.points) {
    const auto other = std::find_if(a.points.begin(), a.points.end(),
                                    [&](const ReviewPoint& q) { return q.id == p.id && q.c_deg == p.c_deg; });
    if (other == a.points.end()) continue;
    ReviewPoint both{p.id, p.position_mm, p.c_deg, p.used && other->used, {}};
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
