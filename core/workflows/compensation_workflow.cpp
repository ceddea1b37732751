// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/compensation_workflow.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/base/csv.h"
#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/discrepancy/effect_model.h"
#include "core/machine/table_polynomial.h"
#include "core/math/distributions.h"

namespace spindrift {
namespace {

/// The simulation, with its stated gain uncertainty, and the effects added.
class SumModel final : public ErrorModel {
 public:
  SumModel(std::shared_ptr<const ErrorModel> base, double gain_uncertainty, std::shared_ptr<const ErrorModel> effects)
      : base_(std::move(base)), gain_uncertainty_(gain_uncertainty), effects_(std::move(effects)) {}
  [[nodiscard]] std::string description() const override {
    return effects_->description() + " on top of " + base_->description();
  }
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& query, Component component) const override {
    return sum(base_->predict(query, component), effects_->predict(query, component));
  }
  [[nodiscard]] PredictedComponent predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                                 Component component) const override {
    return sum(base_->predictChange(query, reference, component), effects_->predictChange(query, reference, component));
  }

 private:
  /// One gain holds everywhere, so that a change is as uncertain as its size.
  [[nodiscard]] PredictedComponent sum(const PredictedComponent& base, const PredictedComponent& effects) const {
    return {base.value + effects.value, std::hypot(base.sigma, gain_uncertainty_ * base.value, effects.sigma)};
  }

  std::shared_ptr<const ErrorModel> base_;
  double gain_uncertainty_;
  std::shared_ptr<const ErrorModel> effects_;
};

std::string chosenState(const ObservationSet& observations, const std::string& asked) {
  const std::vector<std::string> states = observations.states();
  if (states.empty()) throw InputError({observations.file, ""}, "holds no observation; allowed: at least one state.");
  if (asked.empty()) return warmestState(observations);
  if (std::find(states.begin(), states.end(), asked) == states.end()) {
    throw InputError(fmt::format("state \"{}\" was not observed; allowed: {}.", asked, joinedList(states, "or")));
  }
  return asked;
}

/// A model with what it does not describe of EX, EY, EZ in the sigma of every prediction.
class LackingModel final : public ErrorModel {
 public:
  LackingModel(std::shared_ptr<const ErrorModel> model, Eigen::Vector3d lack_um)
      : model_(std::move(model)), lack_um_(std::move(lack_um)) {}
  [[nodiscard]] std::string description() const override { return model_->description(); }
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& query, Component component) const override {
    PredictedComponent predicted = model_->predict(query, component);
    if (!isRotation(component)) predicted.sigma = std::hypot(predicted.sigma, lack_um_[static_cast<int>(component)]);
    return predicted;
  }
  [[nodiscard]] PredictedComponent predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                                 Component component) const override {
    PredictedComponent change = model_->predictChange(query, reference, component);
    if (isRotation(component) || query == reference) return change;
    const double lack_um = lack_um_[static_cast<int>(component)];  // its own at every place
    change.sigma = std::hypot(change.sigma, lack_um, lack_um);
    return change;
  }

 private:
  std::shared_ptr<const ErrorModel> model_;
  Eigen::Vector3d lack_um_;
};

struct PreparedModel {
  std::shared_ptr<const ErrorModel> everywhere;  ///< what the grid and the tables are made of
  DeviationQuery conditions;
};

void noteLack(CompensationPlan& plan) {
  if (!(plan.lack_of_fit_um.maxCoeff() > 0.0)) return;
  plan.warnings.push_back(fmt::format(
      "What the model does not describe (X {:.1f} µm, Y {:.1f} µm, Z {:.1f} µm) is part of the uncertainty of "
      "every correction.",
      plan.lack_of_fit_um.x(), plan.lack_of_fit_um.y(), plan.lack_of_fit_um.z()));
}

/// What remains on data not used for fitting, of a fit of one state.
void addUnseen(const NineParameterFit& fit, const ErrorModel& model, const TableOrders& orders,
               CompensationPlan& plan) {
  std::vector<std::string> held_out;
  double before = 0.0, after = 0.0, count = 0.0;
  const auto add = [&](const NineParameterResidual& r, double predicted_um) {
    before += r.value_um * r.value_um;
    after += std::pow(r.value_um - predicted_um, 2);
    count += 1.0;
  };
  for (const NineParameterResidual& r : fit.residuals) {
    if (r.used || isRotation(r.component)) continue;
    if (std::find(held_out.begin(), held_out.end(), r.point) == held_out.end()) held_out.push_back(r.point);
    DeviationQuery query;
    query.state = fit.state;
    query.position_mm = r.position_mm;
    add(r, model.predict(query, r.component).value);
  }
  if (count > 0.0) {
    plan.unseen = fmt::format("at {}, held out",
                              held_out.size() > 6 ? fmt::format("{} points", held_out.size()) : joinedList(held_out));
  } else {
    const LeftOut left_out = predictLeftOut(fit, orders);
    for (std::size_t i = 0; i < left_out.rows.size(); ++i) {
      add(fit.residuals[left_out.rows[i]], left_out.predicted_um[i]);
    }
    plan.unseen = count > 0.0 ? "at every point, predicted without it"
                              : "no point was held out, and none can be left out: how the correction does elsewhere is "
                                "not known";
  }
  if (count == 0.0) return;
  plan.rms_before_unseen_um = std::sqrt(before / count);
  plan.rms_after_unseen_um = std::sqrt(after / count);
}

void finishPoint(CompensationPoint& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (p.measured_um[i]) p.remains_um[i] = *p.measured_um[i] + p.correction_um[static_cast<Eigen::Index>(i)];
  }
}

/// The points of a fit with what was measured there: the mean of repeats, of both directions of approach. At another
/// angle of the table a point is another place, and named so where it was measured at several.
void addMeasuredPoints(const NineParameterFit& fit, CompensationPlan& plan) {
  std::map<std::string, std::set<double>> angles;
  for (const NineParameterResidual& r : fit.residuals) angles[r.point].insert(r.c_deg);
  std::map<std::pair<std::string, double>, std::size_t> index;
  std::vector<std::array<std::vector<Eigen::Index>, 3>> readings;  // of every point
  for (std::size_t k = 0; k < fit.residuals.size(); ++k) {
    const NineParameterResidual& r = fit.residuals[k];
    plan.time_s = std::max(plan.time_s, r.time_s);
    if (isRotation(r.component)) continue;
    const auto [at, fresh] = index.try_emplace({r.point, r.c_deg}, plan.points.size());
    if (fresh) {
      plan.points.emplace_back();
      plan.points.back().point = angles.at(r.point).size() > 1 ? fmt::format("{}, C {:g}°", r.point, r.c_deg) : r.point;
      plan.points.back().position_mm = r.position_mm;
      readings.emplace_back();
    }
    readings[at->second][static_cast<std::size_t>(axisIndex(r.component))].push_back(static_cast<Eigen::Index>(k));
    plan.points[at->second].used = plan.points[at->second].used && r.used;
  }
  for (std::size_t point = 0; point < readings.size(); ++point) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::vector<Eigen::Index>& of = readings[point][i];
      if (of.empty()) continue;
      double sum = 0.0;
      double variance = 0.0;  // repeats share the noise of what they are compared with
      for (const Eigen::Index a : of) {
        sum += fit.residuals[static_cast<std::size_t>(a)].value_um;
        for (const Eigen::Index b : of) variance += fit.value_covariance(a, b);
      }
      const auto count = static_cast<double>(of.size());
      plan.points[point].measured_um[i] = sum / count;
      plan.points[point].measured_sigma_um[i] = std::sqrt(std::max(0.0, variance)) / count;
    }
  }
}

PreparedModel prepareNineParameters(const ObservationSet& observations, const CompensationRequest& request,
                                    CompensationPlan& plan) {
  NineParameterOptions options = request.fit;
  options.state = plan.state;
  const NineParameterFit fit = fitNineParameters(observations, options);
  if (fit.status != FitStatus::Converged) {
    throw InputError(
        {observations.file},
        fmt::format("state {} cannot be compensated: {}. The nine-parameter model needs at least three points that are "
                    "not on one line.",
                    fit.state, fit.message));
  }
  plan.reference = fit.reference_state.empty() ? "zero" : "state " + fit.reference_state;
  plan.warnings = fit.warnings;
  const TableOrderChoice choice = chooseTableOrder(fit);
  std::shared_ptr<const ErrorModel> model;
  TableOrders orders{1, 1, 1};
  if (request.source == CompensationSource::HigherOrder) {
    if (!choice.richer()) plan.warnings.push_back("A model of higher order is not supported. " + choice.reason);
    orders = choice.orders;
    model = choice.model;
    plan.lack_of_fit_um.setConstant(choice.lack_of_fit_um);
    plan.model = fmt::format("Model of {} of state {} against {}", orderText(orders), fit.state, plan.reference);
  } else {
    model = std::make_shared<NineParameterModel>(fit.predictingModel());
    plan.lack_of_fit_um = fit.lack_of_fit_um;
    plan.model = fmt::format("Nine-parameter model of state {} against {}", fit.state, plan.reference);
    if (choice.richer()) plan.richer_model = choice.reason;
  }
  noteLack(plan);
  if (!plan.richer_model.empty()) plan.warnings.push_back("A richer model fits better. " + plan.richer_model);
  addUnseen(fit, *model, orders, plan);
  PreparedModel out{model, {}};
  out.conditions.state = fit.state;
  addMeasuredPoints(fit, plan);
  for (CompensationPoint& p : plan.points) {
    DeviationQuery query = out.conditions;
    query.position_mm = p.position_mm;
    for (int i = 0; i < 3; ++i) {
      const PredictedComponent predicted = model->predict(query, static_cast<Component>(i));
      p.correction_um[i] = 0.0 - predicted.value;
      p.sigma_um[i] = predicted.sigma;
    }
  }
  return out;
}

/// What every series (point and component) is compared with: its own readings in the first state that it was measured
/// in, less what the completed model says of them. The constant that a fit finds for a series is no such reference: it
/// takes up whatever the model lacks, and what a fit could not describe would count as compensated.
class FirstReadings {
 public:
  explicit FirstReadings(const DiscrepancyRun& run) : run_(run) {
    if (run.input.absolute) return;
    const auto& rows = run.input.observations.rows;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (!comparable(r)) continue;
      Series& s = series_.try_emplace({rows[r].point, rows[r].component}).first->second;
      if (s.count == 0.0) s.state = rows[r].state;
      if (rows[r].state != s.state) continue;
      s.count += 1.0;
      s.sum_um += rows[r].value - run.result.completed[r];
      s.variance_sum += std::pow(sigma(r), 2);
    }
  }
  [[nodiscard]] bool comparable(std::size_t r) const {
    const Observation& o = run_.input.observations.rows[r];
    return o.use != ObservationUse::Exclude && !isRotation(o.component) && std::isfinite(run_.result.completed[r]) &&
           std::isfinite(run_.result.constant[r]);
  }
  /// The deviation that was measured in a row since the start of the log.
  [[nodiscard]] double measured(std::size_t r) const {
    const Series* s = reference(r);
    return run_.input.observations.rows[r].value - (s != nullptr ? s->sum_um / s->count : run_.result.constant[r]);
  }
  [[nodiscard]] double referenceVariance(std::size_t r) const {
    const Series* s = reference(r);
    return s != nullptr ? s->variance_sum / (s->count * s->count) : 0.0;
  }
  /// Of one reading: a shift of its state is noise only where nothing else remains that may be in it.
  [[nodiscard]] double sigma(std::size_t r) const {
    const Observation& o = run_.input.observations.rows[r];
    const bool more_remains = std::any_of(run_.result.remainder.begin(), run_.result.remainder.end(),
                                          [&](const ComponentRemainder& c) { return c.component == o.component; });
    const NoiseEstimate* found = run_.result.noiseOf(o.component);
    if (more_remains && found != nullptr) return o.sigma * found->scale;
    return run_.result.readingSigma(o.component, o.sigma);
  }

 private:
  struct Series {
    std::string state;
    double count = 0.0;
    double sum_um = 0.0;
    double variance_sum = 0.0;
  };
  /// Null in that first state itself, which would agree with itself exactly.
  [[nodiscard]] const Series* reference(std::size_t r) const {
    const Observation& o = run_.input.observations.rows[r];
    const auto found = series_.find({o.point, o.component});
    return found == series_.end() || found->second.state == o.state ? nullptr : &found->second;
  }

  const DiscrepancyRun& run_;
  std::map<std::pair<std::string, Component>, Series> series_;
};

void addMeasuredRows(const DiscrepancyRun& run, const FirstReadings& first, CompensationPlan& plan,
                     DeviationQuery& conditions) {
  struct Sum {
    double count = 0.0, measured = 0.0, correction = 0.0, sigma = 0.0, model_sigma = 0.0, reference_variance = 0.0;
  };
  std::map<std::string, std::size_t> index;
  std::vector<std::array<Sum, 3>> sums;
  const auto& rows = run.input.observations.rows;
  double time = 0.0;
  double used = 0.0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Observation& o = rows[r];
    if (o.state != plan.state || !first.comparable(r)) continue;
    const auto [at, fresh] = index.try_emplace(o.point, plan.points.size());
    if (fresh) {
      plan.points.emplace_back();
      plan.points.back().point = o.point;
      plan.points.back().position_mm = o.position_mm;
      sums.emplace_back();
    }
    plan.points[at->second].used = o.use == ObservationUse::Fit;
    Sum& s = sums[at->second][static_cast<std::size_t>(axisIndex(o.component))];
    s.count += 1.0;
    s.measured += first.measured(r);
    s.sigma += std::pow(first.sigma(r), 2);
    s.reference_variance = first.referenceVariance(r);
    s.correction -= run.result.completed[r];
    s.model_sigma += std::hypot(run.result.model->predict(DeviationQuery::of(o), o.component).sigma,
                                run.input.simulation_gain_uncertainty * run.input.predicted[r]);
    time += o.time_s;
    used += 1.0;
  }
  if (plan.points.empty()) {
    throw InputError(fmt::format("state {} has no displacement with a prediction; choose another state.", plan.state));
  }
  plan.time_s = conditions.time_s = time / used;
  for (std::size_t k = 0; k < plan.points.size(); ++k) {
    CompensationPoint& p = plan.points[k];
    for (std::size_t i = 0; i < 3; ++i) {
      const Sum& s = sums[k][i];
      if (!(s.count > 0.0)) {
        p.correction_um[static_cast<Eigen::Index>(i)] = p.sigma_um[static_cast<Eigen::Index>(i)] = std::nan("");
        continue;
      }
      p.measured_um[i] = s.measured / s.count;
      p.measured_sigma_um[i] = std::sqrt(s.sigma / (s.count * s.count) + s.reference_variance);
      p.correction_um[static_cast<Eigen::Index>(i)] = 0.0 + s.correction / s.count;
      p.sigma_um[static_cast<Eigen::Index>(i)] = s.model_sigma / s.count;
    }
  }
}

/// What remains on readings held out: of this state, or of all states where nothing of this one was.
void addHeldOut(const DiscrepancyRun& run, const FirstReadings& first, CompensationPlan& plan) {
  const auto& rows = run.input.observations.rows;
  const auto held_out = [&](std::size_t r) { return rows[r].use == ObservationUse::Holdout && first.comparable(r); };
  const auto judge = [&](bool this_state_alone) {
    double before = 0.0, after = 0.0, count = 0.0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (!held_out(r) || (this_state_alone && rows[r].state != plan.state)) continue;
      const double measured_um = first.measured(r);
      before += measured_um * measured_um;
      after += std::pow(measured_um - run.result.completed[r], 2);
      count += 1.0;
    }
    if (count == 0.0) return false;
    plan.rms_before_unseen_um = std::sqrt(before / count);
    plan.rms_after_unseen_um = std::sqrt(after / count);
    plan.unseen = this_state_alone ? "at the points held out" : "readings held out in other states";
    return true;
  };
  if (!judge(true) && !judge(false))
    plan.unseen = "nothing was held out: how the correction does elsewhere is not known";
}

/// What remains at the points beyond the uncertainty of the readings, per component (of all where one has few values);
/// zero where chance explains it.
Eigen::Vector3d lackAtPoints(const std::vector<CompensationPoint>& points) {
  constexpr double chance_level = 0.05;
  constexpr double enough_values = 3.0;
  Eigen::Vector3d excess = Eigen::Vector3d::Zero();
  Eigen::Vector3d count = Eigen::Vector3d::Zero();
  double chi2 = 0.0;
  for (const CompensationPoint& p : points) {
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (!p.used || !p.measured_um[at]) continue;
      const double remains = *p.measured_um[at] + p.correction_um[i];
      const double variance = std::pow(p.measured_sigma_um[at], 2);
      chi2 += remains * remains / variance;
      excess[i] += remains * remains - variance;
      count[i] += 1.0;
    }
  }
  if (count.sum() < 1.0 || chiSquaredTail(chi2, count.sum()) >= chance_level) return Eigen::Vector3d::Zero();
  const double pooled = excess.sum() / count.sum();
  Eigen::Vector3d lack;
  for (int i = 0; i < 3; ++i) {
    lack[i] = std::sqrt(std::max(0.0, count[i] >= enough_values ? excess[i] / count[i] : pooled));
  }
  return lack;
}

PreparedModel prepareCompleted(const Campaign& campaign, const ObservationSet& observations,
                               const CompensationRequest& request, CompensationPlan& plan, JobContext& job) {
  DiscrepancyOptions options;
  options.accept = request.added;
  options.reject = request.reject;
  options.max_effects = 0;
  options.suggest = false;
  const DiscrepancyRun run = searchDiscrepancy(campaign, observations, options, job);
  std::vector<std::string> names;
  for (const FoundEffect& e : run.result.effects) names.push_back(e.id);
  if (names.empty()) throw InputError("no effect of the model can be fitted to these observations; choose others.");
  plan.reference = "the start of the log";
  plan.warnings = run.result.warnings;
  plan.model = fmt::format("Simulation completed by {}", joinedList(names));
  PreparedModel out;
  out.conditions.state = plan.state;
  const FirstReadings first(run);
  addMeasuredRows(run, first, plan, out.conditions);
  addHeldOut(run, first, plan);
  plan.lack_of_fit_um = lackAtPoints(plan.points);
  for (CompensationPoint& p : plan.points) {
    p.sigma_um = (p.sigma_um.array().square() + plan.lack_of_fit_um.array().square()).sqrt();
  }
  noteLack(plan);
  if (run.input.base != nullptr) {
    out.everywhere = std::make_shared<LackingModel>(
        std::make_shared<SumModel>(run.input.base, run.input.simulation_gain_uncertainty, run.result.model),
        plan.lack_of_fit_um);
  } else {
    out.everywhere = std::make_shared<LackingModel>(run.result.model, plan.lack_of_fit_um);
    plan.limitation = fmt::format(
        "The simulation is a table ({}) and knows only the measured points. Grid and tables hold the effects added "
        "alone: use them where the control already compensates what was simulated.",
        run.input.base_table);
  }
  return out;
}

/// Appends a file of the control unless there is nothing to write; what the control cannot take is said.
template <class Write>
void addControlFile(CompensationPlan& plan, CompensationFile file, const Write& write) {
  try {
    file.content = write();
    if (!file.content.empty()) plan.files.push_back(std::move(file));
  } catch (const InputError& e) {
    plan.warnings.push_back(fmt::format("The file {} is not written: {}", file.name, e.sentence()));
  }
}

/// What was written, read as the control reads it, has to leave the same deviation all along every base axis.
void requireSameEverywhere(const std::vector<ControlTable>& read, const std::vector<AxisComponentTable>& components,
                           double rounding_mm) {
  for (const ControlTable& table : read) {
    const auto of = std::find_if(components.begin(), components.end(),
                                 [&](const AxisComponentTable& c) { return c.axis[0] == table.base; });
    SPINDRIFT_ASSERT(of != components.end(), "a table of an axis of the machine");
    double least = 1e300;
    double most = -1e300;
    for (std::size_t row = 0; row < of->position_mm.size(); ++row) {
      const double left_mm = table.movementAt(of->position_mm[row]) +
                             of->deviation[row][static_cast<std::size_t>(table.axis - 'X')] * mm_per_um;
      least = std::min(least, left_mm);
      most = std::max(most, left_mm);
    }
    SPINDRIFT_ASSERT(most - least <= rounding_mm, "a table leaves the deviation that it was made for");
  }
}

/// Tables over the position of an axis that are written for all axes together, or in the control's own steps.
void makeControlTables(const MachineDescription& machine, const PreparedModel& prepared,
                       const CompensationRequest& request, const std::vector<AxisComponentTable>& components,
                       const MeasuredBox& measured, const std::string& relative, CompensationPlan& plan) {
  constexpr double text_rounding_mm = 2.1e-6;
  addControlFile(
      plan,
      {"siemens_cec.ini",
       "Siemens sag and angularity error compensation",
       fmt::format(
           "$AN_CEC in mm, one table for each axis that is moved over the position of another: the deviation itself, "
           "{}, zero at the reference position; a positive value moves the axis in the negative direction. With the "
           "tables of $AA_ENC_COMP all displacements along the axes through the reference position are compensated; "
           "what depends on two axes together (the higher-order terms) is in no such table. It stands in place of "
           "the tables that the control has. Beyond what was measured it is extrapolated; the ISO 230-1 tables say "
           "where.",
           relative),
       {}},
      [&] {
        std::string text = siemensSagCompensation(components, measured);
        requireSameEverywhere(readSiemensTables(text, "siemens_cec.ini"), components, text_rounding_mm);
        return text;
      });
  int fanuc_number = 0;
  for (const AxisComponentTable& table : components) {
    addControlFile(plan,
                   {fmt::format("heidenhain_{}_com.csv", table.axis),
                    fmt::format("Heidenhain compensation values over {}", table.axis),
                    fmt::format("Values of a .COM table in mm, to be entered in the control's table editor (the layout "
                                "of the file is not public): the deviation itself, {}, zero at the first position; "
                                "positive where the axis travels too far. In the .CMA it is the table of {}. Beyond "
                                "what was measured it is extrapolated; the ISO 230-1 tables say where.",
                                relative, table.axis),
                    {}},
                   [&] {
                     std::string text = heidenhainCompensation(table, measured);
                     if (!text.empty())
                       requireSameEverywhere(readHeidenhainTable(text, "heidenhain_com.csv"), {table},
                                             text_rounding_mm);
                     return text;
                   });
    const auto axis = static_cast<std::size_t>(table.axis[0] - 'X');
    if (!request.fanuc_step || !knownErrors(table, measured)[axis]) continue;
    const FanucPoints points = FanucPoints::over(*machine.findAxis(table.axis), request.positions, fanuc_number);
    fanuc_number = points.last + 1;
    addControlFile(
        plan,
        {fmt::format("fanuc_{}_pitch.nc", table.axis),
         fmt::format("Fanuc pitch error data of {}", table.axis),
         fmt::format("Program (G10 L50) with steps in detection units of {:g} µm from point to point, {}: a positive "
                     "value moves the axis to {}, as stated. Points, distance and magnification are those of its head "
                     "(parameters 3620 to 3624). It stands in place of the data that the control has. Beyond what was "
                     "measured it is extrapolated; the ISO 230-1 tables say where.",
                     request.fanuc_unit_um, relative, *request.fanuc_step == FanucStep::Positive ? "+" : "−"),
         {}},
        [&] {
          const AxisComponentTable ends = axisComponentsAt(*prepared.everywhere, machine, table.axis, plan.reference_mm,
                                                           points.position_mm(), prepared.conditions);
          std::string text = fanucPitchError(ends, points, *request.fanuc_step, request.fanuc_unit_um, measured);
          requireSameEverywhere({readFanucPitchError(text, "fanuc_pitch.nc")}, {ends},
                                1.001 * request.fanuc_unit_um * mm_per_um);
          return text;
        });
  }
  if (!request.fanuc_step) {
    plan.not_written =
        "No pitch error data are written for Fanuc until it is stated which way a positive value moves the axis: "
        "public documents give their format, not that. Set one value of 10 detection units on the control, move over "
        "its section in the positive direction with an indicator on the axis, and see whether it goes further than "
        "before (positive) or less far (negative).";
  }
}

/// Of what the model was made from: what was held out only judges it.
MeasuredBox measuredBox(const std::vector<CompensationPoint>& points) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  MeasuredBox measured{Eigen::Vector3d::Constant(infinity), Eigen::Vector3d::Constant(-infinity), {}};
  const bool any_used = std::any_of(points.begin(), points.end(), [](const CompensationPoint& p) { return p.used; });
  for (const CompensationPoint& p : points) {
    if (any_used && !p.used) continue;
    for (std::size_t i = 0; i < 3; ++i) measured.displacement[i] = measured.displacement[i] || p.measured_um[i];
    measured.low_mm = measured.low_mm.cwiseMin(p.position_mm);
    measured.high_mm = measured.high_mm.cwiseMax(p.position_mm);
    measured.places_mm.push_back(p.position_mm);
  }
  return measured;
}

void makeFiles(const MachineDescription& machine, const PreparedModel& prepared, const CompensationRequest& request,
               CompensationPlan& plan) {
  const ErrorModel& model = *prepared.everywhere;
  const std::string relative = fmt::format("relative to {}, for state {}", plan.reference, plan.state);
  std::string csv = fmt::format(
      "# correction to add to the command = minus the predicted deviation (actual minus commanded), {}\n"
      "point,x_mm,y_mm,z_mm,correction_x_um,correction_y_um,correction_z_um,sigma_x_um,sigma_y_um,sigma_z_um,"
      "measured_x_um,measured_y_um,measured_z_um,remains_x_um,remains_y_um,remains_z_um\n",
      relative);
  for (const CompensationPoint& p : plan.points) {
    csv += csvField(p.point);
    // A nanometre is more than a place is known to.
    for (int i = 0; i < 3; ++i) csv += fmt::format(",{}", std::round(1e6 * p.position_mm[i]) / 1e6);
    const auto add = [&](std::optional<double> v) {
      csv += v && std::isfinite(*v) ? fmt::format(",{:.4f}", *v) : std::string(",");
    };
    for (const double v : p.correction_um) add(v);
    for (const double v : p.sigma_um) add(v);
    for (const auto& v : p.measured_um) add(v);
    for (const auto& v : p.remains_um) add(v);
    csv += '\n';
  }
  plan.files.push_back({"compensation_points.csv", "Corrections at the measured points",
                        fmt::format("Correction to add to the command: minus the deviation, {}.", relative), csv});
  const MeasuredBox measured = measuredBox(plan.points);
  CompensationGridOptions grid = CompensationGridOptions::travelOf(machine);
  for (std::size_t i = 0; i < 3; ++i) {
    if (grid.nodes[i] > 1) grid.nodes[i] = request.positions;
  }
  plan.nodes = grid.nodes;
  plan.files.push_back(
      {"compensation_grid.csv", "Corrections on a grid",
       fmt::format("Correction to add to the command: minus the predicted deviation (actual minus commanded), {}.",
                   relative),
       compensationGridCsv(compensationGrid(model, grid, prepared.conditions), measured)});
  std::vector<AxisComponentTable> components;
  for (const char* axis : axis_names) {
    if (machine.findAxis(axis) == nullptr) continue;
    components.push_back(
        axisComponents(model, machine, axis, plan.reference_mm, request.positions, prepared.conditions));
    plan.files.push_back(
        {fmt::format("iso230_{}.csv", axis), fmt::format("ISO 230-1 component errors of {}", axis),
         fmt::format("Deviation, not correction: actual minus commanded, {}, zero at the reference position.",
                     relative),
         axisComponentsCsv(components.back(), measured)});
    if (!measured.extendsAlong(axis[0] - 'X')) {
      plan.warnings.push_back(
          fmt::format("Nothing was measured along {}: no component error of that axis is stated, and there is no screw "
                      "compensation for it.",
                      axis));
      continue;
    }
    if (!measured.displacement[static_cast<std::size_t>(axis[0] - 'X')]) {
      plan.warnings.push_back(fmt::format(
          "E{0} was not measured: no correction of {0} is stated, and there is no screw compensation for it.", axis));
      continue;
    }
    plan.files.push_back(
        {fmt::format("linuxcnc_{}.comp", axis), fmt::format("LinuxCNC screw compensation of {}", axis),
         fmt::format("Nominal, forward, reverse in mm (COMP_FILE_TYPE = 0): where the axis really is; LinuxCNC "
                     "subtracts by itself. {}{}. Measured from {:g} to {:g} mm; beyond that it is extrapolated.",
                     static_cast<char>(std::toupper(relative[0])), relative.substr(1), measured.low_mm[axis[0] - 'X'],
                     measured.high_mm[axis[0] - 'X']),
         linuxcncCompensation(model, machine, axis, plan.reference_mm, request.positions, prepared.conditions)});
    plan.files.push_back(
        {fmt::format("linuxcnc_{}_trim.comp", axis), fmt::format("LinuxCNC screw compensation of {}, as a trim", axis),
         "Nominal, forward, reverse in mm (COMP_FILE_TYPE = 1): minus the deviation, added to the motor's command. The "
         "same compensation in the control's other form; only one of the two files may be loaded.",
         linuxcncCompensation(model, machine, axis, plan.reference_mm, request.positions, prepared.conditions,
                              LinuxcncTable::Trim)});
    plan.files.push_back(
        {fmt::format("siemens_{}_eec.ini", axis),
         fmt::format("Siemens measuring system error compensation of {}", axis),
         fmt::format("$AA_ENC_COMP in mm: the deviation itself, {}, zero at the reference position; a positive value "
                     "moves the axis in the negative direction. Add the values of a table that the control has. "
                     "Measured from {:g} to {:g} mm; beyond that it is extrapolated.",
                     relative, measured.low_mm[axis[0] - 'X'], measured.high_mm[axis[0] - 'X']),
         siemensCompensation(model, machine, axis, plan.reference_mm, request.positions, prepared.conditions,
                             measured)});
  }
  makeControlTables(machine, prepared, request, components, measured, relative, plan);
}

void addNumbers(CompensationPlan& plan) {
  double before = 0.0, after = 0.0, count = 0.0, sigma = 0.0, sigma_count = 0.0;
  for (CompensationPoint& p : plan.points) {
    finishPoint(p);
    plan.largest_um = std::max(plan.largest_um, p.correction_um.array().isFinite().select(p.correction_um, 0.0).norm());
    for (std::size_t i = 0; i < 3; ++i) {
      if (!p.measured_um[i]) continue;
      before += *p.measured_um[i] * *p.measured_um[i];
      after += *p.remains_um[i] * *p.remains_um[i];
      count += 1.0;
      const double s = p.sigma_um[static_cast<Eigen::Index>(i)];
      sigma += s * s;
      sigma_count += 1.0;
    }
  }
  if (count > 0.0) {
    plan.rms_before_um = std::sqrt(before / count);
    plan.rms_after_um = std::sqrt(after / count);
    plan.rms_sigma_um = std::sqrt(sigma / sigma_count);
  }
}

}  // namespace

std::string_view toString(CompensationSource source) noexcept {
  switch (source) {
    case CompensationSource::NineParameters:
      return "nine-parameter";
    case CompensationSource::CompletedModel:
      return "completed";
    case CompensationSource::HigherOrder:
      return "higher-order";
  }
  return "";
}

std::string warmestState(const ObservationSet& observations) {
  const std::vector<std::string> states = observations.states();
  if (states.empty()) return {};
  struct Mean {
    double sum = 0.0;
    double count = 0.0;
  };
  std::map<std::string, std::map<std::pair<std::string, Component>, Mean>> means;
  for (const Observation& o : observations.rows) {
    // The first state only says what the others are compared with.
    const bool counts = o.state == states.front() ? o.use != ObservationUse::Exclude : o.use == ObservationUse::Fit;
    if (!counts || isRotation(o.component)) continue;
    Mean& mean = means[o.state][{o.point, o.component}];
    mean.sum += o.value;
    mean.count += 1.0;
  }
  const auto& first = means[states.front()];
  std::string warmest = states.back();
  double largest = -1.0;
  for (std::size_t i = 1; i < states.size(); ++i) {
    double squares = 0.0;
    double count = 0.0;
    for (const auto& [series, mean] : means[states[i]]) {
      const auto reference = first.find(series);
      if (reference == first.end()) continue;
      const double change = mean.sum / mean.count - reference->second.sum / reference->second.count;
      squares += change * change;
      count += 1.0;
    }
    if (count == 0.0 || squares / count <= largest) continue;
    largest = squares / count;
    warmest = states[i];
  }
  return warmest;
}

void CompensationRequest::validate() const {
  if (positions < 2 || positions > 51) {
    throw InputError(fmt::format("{} positions along an axis are not allowed; allowed: 2 to 51.", positions));
  }
  if (!(fanuc_unit_um >= 0.001) || fanuc_unit_um > 100.0) {
    throw InputError(fmt::format("a detection unit of {:g} µm is not allowed; allowed: 0.001 to 100.", fanuc_unit_um));
  }
  if (source == CompensationSource::CompletedModel && added.empty()) {
    throw InputError("the completed model needs at least one effect that was added; add one in the discrepancy.");
  }
}

Eigen::Vector3d usualReference(const MachineDescription& machine, const ObservationSet& observations,
                               const std::string& state) {
  Eigen::AlignedBox3d measured;
  for (const Observation& o : observations.rows) {
    if (o.state == state && o.use != ObservationUse::Exclude) measured.extend(o.position_mm);
  }
  Eigen::Vector3d reference_mm = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const LinearAxis* axis = machine.findAxis(axis_names[static_cast<std::size_t>(i)]);
    if (axis == nullptr) continue;
    const double middle_mm = 0.5 * (axis->travel_mm[0] + axis->travel_mm[1]);
    const double near_mm = measured.isEmpty() ? middle_mm : std::clamp(middle_mm, measured.min()[i], measured.max()[i]);
    reference_mm[i] = std::clamp(near_mm, axis->travel_mm[0], axis->travel_mm[1]);
  }
  return reference_mm;
}

namespace {
/// The lines of the tables pass through a place where the machine can go.
void requireWithinTravel(const MachineDescription& machine, const Eigen::Vector3d& reference_mm) {
  for (int i = 0; i < 3; ++i) {
    const LinearAxis* axis = machine.findAxis(std::string(1, "XYZ"[i]));
    if (axis == nullptr || (reference_mm[i] >= axis->travel_mm[0] && reference_mm[i] <= axis->travel_mm[1])) continue;
    throw InputError({machine.file, ""},
                     fmt::format("the reference position {} {:g} mm lies outside the travel; allowed: {:g} to {:g} mm.",
                                 axis->name, reference_mm[i], axis->travel_mm[0], axis->travel_mm[1]));
  }
}
}  // namespace

CompensationPlan planCompensation(const Campaign& campaign, const ObservationSet& observations,
                                  const CompensationRequest& request, JobContext& job) {
  request.validate();
  CompensationPlan plan;
  plan.state = chosenState(observations, request.state);
  if (request.reference_mm) requireWithinTravel(campaign.machine, *request.reference_mm);
  plan.reference_mm = request.reference_mm.value_or(usualReference(campaign.machine, observations, plan.state));
  JobContext fitting = job.part(0.0, 0.7);
  const PreparedModel prepared = request.source == CompensationSource::CompletedModel
                                     ? prepareCompleted(campaign, observations, request, plan, fitting)
                                     : prepareNineParameters(observations, request, plan);
  addNumbers(plan);
  if (std::string why = plan.harm(); !why.empty()) plan.warnings.insert(plan.warnings.begin(), std::move(why));
  job.throwIfCancelled();
  job.report(0.7, "writing the tables");
  makeFiles(campaign.machine, prepared, request, plan);
  job.report(1.0, "done");
  return plan;
}

nlohmann::json CompensationPlan::json() const {
  nlohmann::json list = nlohmann::json::array();
  for (const CompensationPoint& p : points) {
    const auto vector = [](const Eigen::Vector3d& v) {
      return nlohmann::json{jsonNumber(v.x()), jsonNumber(v.y()), jsonNumber(v.z())};
    };
    const auto optional = [](const std::array<std::optional<double>, 3>& v) {
      return nlohmann::json{jsonNumber(v[0]), jsonNumber(v[1]), jsonNumber(v[2])};
    };
    list.push_back({{"point", p.point},
                    {"position_mm", vector(p.position_mm)},
                    {"measured_um", optional(p.measured_um)},
                    {"correction_um", vector(p.correction_um)},
                    {"standard_uncertainty_um", vector(p.sigma_um)},
                    {"remains_um", optional(p.remains_um)},
                    {"used", p.used}});
  }
  nlohmann::json written = nlohmann::json::array();
  for (const CompensationFile& f : files) {
    written.push_back({{"name", f.name}, {"title", f.title}, {"convention", f.convention}});
  }
  return {{"model", model},
          {"reference", reference},
          {"state", state},
          {"time_s", jsonNumber(time_s)},
          {"rms_before_um", jsonNumber(rms_before_um)},
          {"rms_after_um", jsonNumber(rms_after_um)},
          {"standard_uncertainty_um", jsonNumber(rms_sigma_um)},
          {"lack_of_fit_um", {lack_of_fit_um.x(), lack_of_fit_um.y(), lack_of_fit_um.z()}},
          {"unseen",
           {{"rms_before_um", jsonNumber(rms_before_unseen_um)},
            {"rms_after_um", jsonNumber(rms_after_unseen_um)},
            {"what", unseen}}},
          {"good_enough", harm().empty()},
          {"message", harm()},
          {"richer_model", richer_model.empty() ? nlohmann::json() : nlohmann::json(richer_model)},
          {"largest_correction_um", jsonNumber(largest_um)},
          {"limitation", limitation.empty() ? nlohmann::json() : nlohmann::json(limitation)},
          {"points", list},
          {"files", written},
          {"not_written", not_written.empty() ? nlohmann::json() : nlohmann::json(not_written)},
          {"warnings", warnings}};
}

std::string CompensationPlan::harm() const {
  if (!rms_after_unseen_um || *rms_after_unseen_um < *rms_before_unseen_um) return {};
  return fmt::format(
      "On data not used for fitting the correction leaves {:.2f} µm where {:.2f} µm were measured: it must not be "
      "used.",
      *rms_after_unseen_um, *rms_before_unseen_um);
}

std::string CompensationPlan::summary() const {
  std::string text = fmt::format(
      "{}, relative to {}\n  rms of the measured deviations of state {}: {:.2f} µm before, {:.2f} µm with the "
      "correction "
      "(uncertainty of the correction {:.2f} µm), largest correction {:.2f} µm\n",
      model, reference, state, rms_before_um, rms_after_um, rms_sigma_um, largest_um);
  if (rms_after_unseen_um) {
    text += fmt::format("  on data not used for fitting ({}): {:.2f} µm before, {:.2f} µm with the correction\n",
                        unseen, *rms_before_unseen_um, *rms_after_unseen_um);
  } else {
    text += fmt::format("  {}\n", unseen);
  }
  if (!limitation.empty()) text += fmt::format("  note: {}\n", limitation);
  for (const std::string& w : warnings) text += fmt::format("  note: {}\n", w);
  for (const CompensationFile& f : files) text += fmt::format("  {}: {}. {}\n", f.name, f.title, f.convention);
  if (!not_written.empty()) text += "  " + not_written + "\n";
  return text;
}

}  // namespace spindrift
