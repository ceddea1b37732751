// SPDX-License-Identifier: Apache-2.0
#include "core/machine/nine_parameter_model.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_set>

#include "core/base/count_text.h"
#include "core/base/text.h"
#include "core/math/distributions.h"
#include "core/math/lack_of_fit.h"
#include "core/math/least_squares.h"
#include "core/math/singular_values.h"

namespace spindrift {
namespace {

/// Largest part of a prediction that may lie along a direction that is not determined.
constexpr double null_space_tolerance = 1e-6;
/// Efficiency of Huber's and Tukey's estimators at their usual thresholds on normal errors: variance = 1/efficiency.
constexpr double robust_efficiency = 0.95;
/// p-value of chi-squared below which a model is called rejected.
constexpr double rejection_level = 1e-3;

/// For sentences: the names without their units.
std::vector<std::string> symbolsOf(const std::vector<int>& parameters) {
  std::vector<std::string> symbols;
  for (const int i : parameters) {
    const std::string_view name = nine_parameter_names[static_cast<std::size_t>(i)];
    std::string symbol(name.substr(0, std::min(name.find("_um"), name.find("_urad"))));
    if (symbol.starts_with("alpha_")) symbol.replace(0, std::string_view("alpha_").size(), "α");
    symbols.push_back(std::move(symbol));
  }
  return symbols;
}

/// Gain of the weighted fit: x = G v. Weights act on the whitened rows through an inflated covariance.
Eigen::MatrixXd gainOf(const Eigen::MatrixXd& A, const Eigen::MatrixXd& covariance, double rank_tolerance) {
  const Eigen::LLT<Eigen::MatrixXd> cholesky(covariance);
  const Eigen::MatrixXd whitened = cholesky.matrixL().solve(A);
  Eigen::VectorXd scale = whitened.colwise().norm();
  for (Eigen::Index j = 0; j < scale.size(); ++j) {
    if (!(scale(j) > 0.0)) scale(j) = 1.0;
  }
  const SingularValues svd = singularValues(whitened * scale.cwiseInverse().asDiagonal());
  const Eigen::Index rank = svd.rank(rank_tolerance);
  const Eigen::MatrixXd pseudo = svd.right.leftCols(rank) * svd.values.head(rank).cwiseInverse().asDiagonal() *
                                 svd.left.leftCols(rank).transpose();
  // pinv(L^-1 A) L^-1 = (L^-T pinv^T)^T
  const Eigen::MatrixXd unwhitened = cholesky.matrixL().transpose().solve(pseudo.transpose());
  return scale.cwiseInverse().asDiagonal() * unwhitened.transpose();
}

double lossWeight(RobustLoss loss, double standardised) {
  switch (loss) {
    case RobustLoss::None:
      return 1.0;
    case RobustLoss::Huber:
      return huberWeight(standardised);
    case RobustLoss::Tukey:
      return tukeyWeight(standardised);
  }
  return 1.0;
}

std::optional<double> rmsOf(const std::vector<NineParameterResidual>& residuals, bool used) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const NineParameterResidual& r : residuals) {
    if (r.used != used || !std::isfinite(r.residual_um)) continue;
    sum += r.residual_um * r.residual_um;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(count));
}

struct WeightedFit {
  LinearFitResult linear;
  Eigen::MatrixXd gain;
  Eigen::VectorXd weight;
  double variance_factor = 1.0;  ///< cov(x) = factor * gain * cov(v) * gain^T
};

/// Least squares, or iteratively reweighted least squares with residuals standardised by sigma sqrt(1 - leverage).
WeightedFit solveWeighted(const Eigen::MatrixXd& A, const Eigen::VectorXd& v, const Eigen::MatrixXd& covariance,
                          const NineParameterOptions& options) {
  const LinearFitOptions linear_options{options.rank_tolerance, options.scale_by_residuals};
  WeightedFit fit;
  fit.weight = Eigen::VectorXd::Ones(v.size());
  fit.linear = solveLinearCorrelated(A, v, covariance, linear_options);
  if (fit.linear.status == FitStatus::Rejected) return fit;
  fit.gain = gainOf(A, covariance, options.rank_tolerance);
  if (options.robust == RobustLoss::None) {
    if (options.scale_by_residuals && fit.linear.degrees_of_freedom > 0) {
      fit.variance_factor = fit.linear.chi2 / fit.linear.degrees_of_freedom;
    }
    return fit;
  }
  // Tukey's loss has several minima: it starts from Huber's solution.
  constexpr int iterations = 100;
  constexpr double smallest_weight = 1e-8;
  const auto iterate = [&](RobustLoss loss) {
    for (int iteration = 0; iteration < iterations; ++iteration) {
      Eigen::VectorXd weight(v.size());
      const Eigen::VectorXd leverage = (A * fit.gain).diagonal();
      for (Eigen::Index i = 0; i < v.size(); ++i) {
        const double spread = std::sqrt(covariance(i, i) * std::max(1.0 - leverage(i), 0.05));
        weight(i) = std::max(lossWeight(loss, fit.linear.residuals(i) / spread), smallest_weight);
      }
      const double change = (weight - fit.weight).cwiseAbs().maxCoeff();
      fit.weight = weight;
      const Eigen::VectorXd inflate = weight.cwiseSqrt().cwiseInverse();
      const Eigen::MatrixXd inflated = inflate.asDiagonal() * covariance * inflate.asDiagonal();
      fit.linear = solveLinearCorrelated(A, v, inflated, linear_options);
      fit.gain = gainOf(A, inflated, options.rank_tolerance);
      if (change < 1e-6) break;
    }
  };
  iterate(RobustLoss::Huber);
  if (options.robust == RobustLoss::Tukey) iterate(RobustLoss::Tukey);
  // The weights downplay rows whose sigma stays what it is: the covariance is that of x = G v, times the loss of
  // efficiency that comes from having chosen the weights by the residuals.
  fit.variance_factor = 1.0 / robust_efficiency;
  if (options.scale_by_residuals && fit.linear.degrees_of_freedom > 0) {
    fit.variance_factor *= fit.linear.chi2 / fit.linear.degrees_of_freedom;
  }
  Eigen::MatrixXd x_covariance = fit.gain * covariance * fit.gain.transpose() * fit.variance_factor;
  for (const int i : fit.linear.undetermined) {
    x_covariance.row(i).setZero();
    x_covariance.col(i).setZero();
    x_covariance(i, i) = std::numeric_limits<double>::infinity();
  }
  fit.linear.covariance = x_covariance;
  return fit;
}

/// Per component where its own residuals tell, else of all together.
Eigen::Vector3d lackOfFitOf(const std::vector<NineParameterResidual>& rows, const std::vector<Eigen::Index>& used,
                            const Eigen::MatrixXd& A, const Eigen::VectorXd& v, const Eigen::MatrixXd& covariance,
                            const WeightedFit& fit) {
  constexpr double chance_level = 0.05;
  constexpr double outlier_weight = 0.5;
  constexpr double enough_freedom = 3.0;
  const int dof = fit.linear.degrees_of_freedom;
  if (dof < 1 || chiSquaredTail(fit.linear.chi2, dof) >= chance_level) return Eigen::Vector3d::Zero();
  const Eigen::VectorXd freedom = Eigen::VectorXd::Ones(v.size()) - (A * fit.gain).diagonal();
  Eigen::Vector3d of_component = Eigen::Vector3d::Zero();
  std::vector<int> component(used.size());
  for (std::size_t k = 0; k < used.size(); ++k) {
    component[k] = static_cast<int>(rows[static_cast<std::size_t>(used[k])].component);
    of_component[component[k]] += freedom(static_cast<Eigen::Index>(k));
  }
  const bool each = (of_component.array() == 0.0 || of_component.array() >= enough_freedom).all();
  std::vector<int> group(used.size());
  for (std::size_t k = 0; k < used.size(); ++k) {
    const bool outlier = fit.weight(static_cast<Eigen::Index>(k)) < outlier_weight;
    group[k] = outlier ? -1 : each ? component[k] : 0;
  }
  const Eigen::VectorXd variance = lackOfFitVariance(A, v, covariance, fit.gain, group, each ? 3 : 1);
  return each ? Eigen::Vector3d(variance.cwiseSqrt()) : Eigen::Vector3d::Constant(std::sqrt(variance(0)));
}

}  // namespace

std::string_view nineParameterUnit(int parameter) {
  SPINDRIFT_ASSERT(parameter >= 0 && parameter < nine_parameter_count, "a parameter out of range");
  if (parameter < 3) return "um";
  return parameter < 7 ? "urad" : "um/m";
}

NineVector nineParameterRow(const Eigen::Vector3d& position_mm, Component component) {
  // mm times urad (or um/m) is 1e-3 um.
  const Eigen::Vector3d p = position_mm * 1e-3;
  NineVector row = NineVector::Zero();
  switch (component) {
    case Component::EX:
      row << 1, 0, 0, 0, p.z(), -p.y(), -p.y(), p.x(), 0;
      break;
    case Component::EY:
      row << 0, 1, 0, -p.z(), 0, p.x(), 0, 0, p.y();
      break;
    case Component::EZ:
      row << 0, 0, 1, p.y(), -p.x(), 0, 0, 0, 0;
      break;
    case Component::EA:
      row(3) = 1.0;
      break;
    case Component::EB:
      row(4) = 1.0;
      break;
    case Component::EC:
      row(5) = 1.0;
      break;
  }
  return row;
}

NineParameterModel::NineParameterModel(const NineVector& parameters, const NineMatrix& covariance,
                                       std::string description, Eigen::MatrixXd null_space,
                                       Eigen::Vector3d lack_of_fit_um)
    : parameters_(parameters),
      covariance_(covariance),
      description_(std::move(description)),
      null_space_(std::move(null_space)),
      lack_of_fit_um_(std::move(lack_of_fit_um)) {}

PredictedComponent NineParameterModel::predict(const DeviationQuery& query, Component component) const {
  return combined(nineParameterRow(query.position_mm, component), component, 1.0);
}

PredictedComponent NineParameterModel::predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                                     Component component) const {
  // What the model does not describe is its own at every place.
  return combined(nineParameterRow(query.position_mm, component) - nineParameterRow(reference.position_mm, component),
                  component, query.position_mm == reference.position_mm ? 0.0 : 2.0);
}

PredictedComponent NineParameterModel::combined(const NineVector& row, Component component, double lacks) const {
  PredictedComponent predicted;
  predicted.value = row.dot(parameters_);
  for (Eigen::Index k = 0; k < null_space_.cols(); ++k) {
    const double size = row.cwiseProduct(null_space_.col(k)).cwiseAbs().maxCoeff();
    if (std::abs(row.dot(null_space_.col(k))) > null_space_tolerance * std::max(size, 1e-12)) {
      predicted.sigma = std::numeric_limits<double>::infinity();
      return predicted;
    }
  }
  double variance = 0.0;
  for (int i = 0; i < nine_parameter_count; ++i) {
    for (int j = 0; j < nine_parameter_count; ++j) {
      if (row(i) != 0.0 && row(j) != 0.0) variance += row(i) * covariance_(i, j) * row(j);
    }
  }
  if (!isRotation(component)) variance += lacks * std::pow(lack_of_fit_um_[static_cast<int>(component)], 2);
  predicted.sigma = std::sqrt(std::max(variance, 0.0));
  return predicted;
}

void NineParameterOptions::validate() const {
  if (!(rank_tolerance > 0.0 && rank_tolerance < 1.0)) {
    throw InputError(fmt::format("rank tolerance {} is not allowed; allowed: between 0 and 1.", rank_tolerance));
  }
}

bool NineParameterFit::determined(int parameter) const {
  return std::find(undetermined.begin(), undetermined.end(), parameter) == undetermined.end();
}

double NineParameterFit::standardUncertainty(int parameter) const {
  return std::sqrt(covariance(parameter, parameter));
}

NineParameterModel NineParameterFit::model() const {
  std::string from = reference_state.empty() ? fmt::format("state {}", state)
                                             : fmt::format("the change from state {} to {}", reference_state, state);
  return {parameters, estimable_covariance, fmt::format("nine-parameter model of {}", from), null_space};
}

bool NineParameterFit::rejected() const {
  return p_value && *p_value < rejection_level;
}

NineParameterModel NineParameterFit::predictingModel() const {
  if (lack_of_fit_um.isZero()) return model();
  Eigen::VectorXd extra(static_cast<Eigen::Index>(residuals.size()));
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    extra(static_cast<Eigen::Index>(i)) = std::pow(lack_of_fit_um[static_cast<int>(residuals[i].component)], 2);
  }
  const NineMatrix covariance_with = estimable_covariance + gain * extra.asDiagonal() * gain.transpose();
  return {parameters, covariance_with, model().description() + " with its lack of fit", null_space, lack_of_fit_um};
}

namespace {

/// Absolute values of many points, each state with fewer of them than a model of one state needs.
bool measuredInPassing(const ObservationSet& observations) {
  constexpr std::size_t few_points = 3;
  std::map<std::string, std::set<std::string>> points;
  for (const Observation& o : observations.rows) {
    if (o.use == ObservationUse::Exclude) continue;
    auto& of_state = points[o.state];
    of_state.insert(o.point);
    if (of_state.size() >= few_points) return false;
  }
  return true;
}

}  // namespace

std::string lastStateToFit(const ObservationSet& observations) {
  const std::vector<std::string> states = observations.states();
  if (states.empty()) return {};
  if (observations.absolute && states.size() > 1 && measuredInPassing(observations)) return std::string(every_state);
  std::unordered_set<std::string_view> to_fit;
  for (const Observation& row : observations.rows)
    if (row.use == ObservationUse::Fit && !isRotation(row.component)) to_fit.insert(row.state);
  for (auto state = states.rbegin(); state != states.rend(); ++state)
    if (to_fit.contains(*state) && (*state != states.front() || states.size() == 1)) return *state;
  return states.back();
}

double StateDifferences::sigma_um(std::size_t k) const {
  const auto i = static_cast<Eigen::Index>(k);
  return std::sqrt(covariance_um2(i, i));
}

StateDifferences differencesFromReference(const ObservationSet& set, const std::string& state, bool relative_asked) {
  const std::vector<std::string> states = set.states();
  if (states.empty()) throw InputError({set.file, ""}, "holds no observation; allowed: at least one row per point.");
  StateDifferences change;
  change.state = state;
  const bool named = std::find(states.begin(), states.end(), change.state) != states.end();
  const bool all = set.absolute && !named && change.state == every_state;
  const auto inState = [&](const Observation& o) { return all || o.state == change.state; };
  if (!named && !all) {
    throw InputError({set.file, ""},
                     fmt::format("state \"{}\" is not there; allowed: {}.", change.state, joinedList(states, "or")));
  }
  const bool deviations = relative_asked && !set.absolute;
  const bool relative = deviations && change.state != states.front();
  if (relative) change.reference = states.front();
  if (!relative && deviations && states.size() > 1) {
    change.warnings.push_back(fmt::format(
        "{} is the reference state: its values are zero up to an unknown constant, not deviations.", change.state));
  }
  using Key = std::tuple<std::string, Component, double>;
  const auto keyOf = [](const Observation& o) { return Key(o.point, o.component, o.c_deg); };
  std::map<Key, std::vector<std::size_t>> of_point;
  // A reading approached from another side along its component, or with another tool, is another measurand: backlash is
  // no change. Where the reference has none from the same side, those from the other stand for it, and it is said.
  const auto side = [](const Observation& o) { return o.approach[axisIndex(o.component)]; };
  struct References {
    std::vector<std::size_t> rows;
    bool from_another_side = false;
  };
  const auto referencesOf = [&](const Observation& o) {
    const std::vector<std::size_t>& there = of_point.at(keyOf(o));
    std::vector<std::size_t> same_side, alike;
    for (const std::size_t r : there) {
      const Observation& before = set.rows[r];
      if (side(before) != side(o)) continue;
      same_side.push_back(r);
      if (before.approach == o.approach && before.tool_offset_mm == o.tool_offset_mm) alike.push_back(r);
    }
    if (!alike.empty()) return References{alike, false};
    if (!same_side.empty()) return References{same_side, false};
    const bool stated = side(o) != 0.0 && std::none_of(there.begin(), there.end(),
                                                       [&](std::size_t r) { return side(set.rows[r]) == 0.0; });
    return References{there, stated};
  };
  std::vector<std::size_t> in_state;
  bool rotations = false;
  for (std::size_t i = 0; i < set.rows.size(); ++i) {
    const Observation& o = set.rows[i];
    if (o.use == ObservationUse::Exclude) continue;
    if (isRotation(o.component)) {
      rotations = rotations || inState(o);
      continue;
    }
    if (relative && o.state == change.reference) of_point[keyOf(o)].push_back(i);
    if (inState(o)) in_state.push_back(i);
  }
  if (rotations) {
    change.warnings.emplace_back("Observed rotations are left out: the nine parameters are fitted to displacements.");
  }
  std::vector<std::string> without_reference;
  std::size_t from_another_side = 0;
  for (const std::size_t i : in_state) {
    if (relative && !of_point.contains(keyOf(set.rows[i]))) {
      without_reference.push_back(fmt::format("{} of {}", toString(set.rows[i].component), set.rows[i].point));
      continue;
    }
    change.rows.push_back(i);
    if (relative && referencesOf(set.rows[i]).from_another_side) ++from_another_side;
  }
  if (from_another_side > 0) {
    change.warnings.push_back(fmt::format(
        "Compared with readings of {} that were approached from another side: {} of {}. The reversal error counts as a "
        "change in them.",
        change.reference, from_another_side, countOf(change.rows.size(), "value")));
  }
  if (!without_reference.empty()) {
    change.warnings.push_back(fmt::format("{} was not measured in the reference state {} and is left out.",
                                          joinedList(without_reference), change.reference));
  }
  // v = B y over the rows involved, cov(v) = B cov(y) B^T.
  std::map<std::size_t, Eigen::Index> column;
  const auto columnOf = [&column](std::size_t row) {
    return column.try_emplace(row, static_cast<Eigen::Index>(column.size())).first->second;
  };
  for (const std::size_t i : change.rows) {
    columnOf(i);
    if (relative) {
      for (const std::size_t r : referencesOf(set.rows[i]).rows) columnOf(r);
    }
  }
  const auto size = static_cast<Eigen::Index>(column.size());
  Eigen::VectorXd y(size);
  std::vector<std::size_t> involved(column.size());
  for (const auto& [row, c] : column) involved[static_cast<std::size_t>(c)] = row;
  // Variances are the stated ones also where a file states covariances that are none: the fit then says so.
  const Eigen::SparseMatrix<double> loads = set.shared.loads(involved);
  Eigen::MatrixXd covariance = Eigen::MatrixXd(loads * loads.transpose());
  for (const auto& [row, c] : column) {
    y(c) = set.rows[row].value;
    covariance(c, c) = set.rows[row].sigma * set.rows[row].sigma;
  }
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(change.rows.size()), size);
  for (std::size_t k = 0; k < change.rows.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    B(row, column[change.rows[k]]) = 1.0;
    if (!relative) continue;
    const std::vector<std::size_t> references = referencesOf(set.rows[change.rows[k]]).rows;
    double total = 0.0;
    for (const std::size_t r : references) total += 1.0 / (set.rows[r].sigma * set.rows[r].sigma);
    for (const std::size_t r : references) B(row, column[r]) -= 1.0 / (set.rows[r].sigma * set.rows[r].sigma) / total;
  }
  change.value_um = B * y;
  change.covariance_um2 = B * covariance * B.transpose();
  return change;
}

/// Nothing is known of any parameter, and so of any prediction.
void reject(NineParameterFit& fit, std::string message) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  fit.status = FitStatus::Rejected;
  fit.message = std::move(message);
  fit.parameters.setConstant(nothing);
  fit.covariance.setZero();
  fit.covariance.diagonal().setConstant(std::numeric_limits<double>::infinity());
  fit.undetermined.resize(nine_parameter_count);
  std::iota(fit.undetermined.begin(), fit.undetermined.end(), 0);
  fit.null_space = NineMatrix::Identity();
  fit.condition_number = nothing;
  fit.chi2 = nothing;
  for (NineParameterResidual& r : fit.residuals) r.residual_um = nothing;
}

NineParameterFit fitNineParameters(const ObservationSet& observations, const NineParameterOptions& options) {
  options.validate();
  StateDifferences change =
      differencesFromReference(observations, options.state.empty() ? lastStateToFit(observations) : options.state,
                               options.relative_to_reference);
  NineParameterFit fit;
  fit.state = change.state;
  fit.reference_state = change.reference;
  fit.warnings = std::move(change.warnings);
  for (const std::string& point : options.points) {
    const bool known = std::any_of(change.rows.begin(), change.rows.end(),
                                   [&](std::size_t i) { return observations.rows[i].point == point; });
    if (known) continue;
    std::vector<std::string> there;
    for (const std::size_t i : change.rows) {
      if (std::find(there.begin(), there.end(), observations.rows[i].point) == there.end()) {
        there.push_back(observations.rows[i].point);
      }
    }
    throw InputError({observations.file, ""}, fmt::format("point \"{}\" was not measured in state {}; allowed: {}.",
                                                          point, change.state, joinedList(there, "or")));
  }
  std::vector<Eigen::Index> used;
  const auto count = static_cast<Eigen::Index>(change.rows.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    const Observation& o = observations.rows[change.rows[static_cast<std::size_t>(i)]];
    const bool chosen = options.points.empty() ||
                        std::find(options.points.begin(), options.points.end(), o.point) != options.points.end();
    NineParameterResidual residual;
    residual.point = o.point;
    residual.component = o.component;
    residual.position_mm = o.position_mm;
    residual.c_deg = o.c_deg;
    residual.time_s = o.time_s;
    residual.value_um = change.value_um(i);
    residual.sigma_um = change.sigma_um(static_cast<std::size_t>(i));
    residual.used = chosen && o.use == ObservationUse::Fit;
    if (residual.used) used.push_back(i);
    fit.residuals.push_back(residual);
  }
  if (used.empty()) {
    throw InputError(
        {observations.file, ""},
        fmt::format("no displacement of state {} can be fitted; allowed: rows EX, EY or EZ with use fit{}.",
                    change.state, change.reference.empty() ? "" : " that were measured in the reference state too"));
  }
  const auto rows = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd A(rows, nine_parameter_count);
  Eigen::VectorXd v(rows);
  Eigen::MatrixXd covariance(rows, rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const NineParameterResidual& r = fit.residuals[static_cast<std::size_t>(used[static_cast<std::size_t>(k)])];
    A.row(k) = nineParameterRow(r.position_mm, r.component).transpose();
    v(k) = r.value_um;
    for (Eigen::Index l = 0; l < rows; ++l) {
      covariance(k, l) = change.covariance_um2(used[static_cast<std::size_t>(k)], used[static_cast<std::size_t>(l)]);
    }
  }
  const WeightedFit weighted = solveWeighted(A, v, covariance, options);
  if (weighted.linear.status == FitStatus::Rejected) {
    reject(fit, fmt::format("{} of state {}", weighted.linear.message, change.state));
    return fit;
  }
  const LinearFitResult& linear = weighted.linear;
  fit.parameters = linear.x;
  fit.covariance = linear.covariance;
  fit.undetermined = linear.undetermined;
  fit.null_space = linear.null_space;
  fit.condition_number = linear.condition_number;
  fit.chi2 = linear.chi2;
  fit.degrees_of_freedom = linear.degrees_of_freedom;
  if (options.robust == RobustLoss::None && !options.scale_by_residuals && fit.degrees_of_freedom > 0) {
    fit.p_value = chiSquaredTail(fit.chi2, fit.degrees_of_freedom);
    if (fit.rejected()) {
      fit.warnings.push_back(
          fmt::format("The residuals are larger than the stated uncertainties allow (chi-squared {:.1f} with {} "
                      "degrees of freedom, "
                      "{}): the nine parameters do not describe this state, or a point is disturbed.",
                      fit.chi2, fit.degrees_of_freedom, pValueText(*fit.p_value)));
    }
  }
  fit.lack_of_fit_um = lackOfFitOf(fit.residuals, used, A, v, covariance, weighted);
  fit.value_covariance = change.covariance_um2;
  fit.gain = Eigen::MatrixXd::Zero(nine_parameter_count, count);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const Eigen::Index i = used[static_cast<std::size_t>(k)];
    fit.gain.col(i) = weighted.gain.col(k);
    fit.residuals[static_cast<std::size_t>(i)].weight = weighted.weight(k);
  }
  fit.estimable_covariance = weighted.variance_factor * fit.gain * fit.value_covariance * fit.gain.transpose();
  fit.status = linear.status;
  if (fit.undetermined.empty()) {
    fit.message = "all nine parameters are determined";
  } else {
    fit.message =
        fmt::format("the points and components that were fitted do not determine {}; the other parameters hold",
                    joinedList(symbolsOf(fit.undetermined)));
  }
  const NineParameterModel model = fit.model();
  for (NineParameterResidual& r : fit.residuals) {
    DeviationQuery query;
    query.position_mm = r.position_mm;
    const PredictedComponent predicted = model.predict(query, r.component);
    r.residual_um =
        std::isfinite(predicted.sigma) ? r.value_um - predicted.value : std::numeric_limits<double>::quiet_NaN();
  }
  fit.rms_fit_um = rmsOf(fit.residuals, true);
  fit.rms_validation_um = rmsOf(fit.residuals, false);
  return fit;
}

NineParameterModel NineParameterComparison::differenceModel() const {
  Eigen::MatrixXd null_space(nine_parameter_count, a.null_space.cols() + b.null_space.cols());
  if (a.null_space.cols() > 0) null_space.leftCols(a.null_space.cols()) = a.null_space;
  if (b.null_space.cols() > 0) null_space.rightCols(b.null_space.cols()) = b.null_space;
  return {difference, estimable_covariance, fmt::format("difference of two nine-parameter models of state {}", a.state),
          null_space};
}

NineParameterComparison compareNineParameters(const ObservationSet& observations, const NineParameterOptions& a,
                                              const NineParameterOptions& b, double level) {
  if (!(level > 0.0 && level < 1.0)) {
    throw InputError(fmt::format("level {} is not allowed; allowed: a probability between 0 and 1.", level));
  }
  NineParameterComparison comparison;
  comparison.a = fitNineParameters(observations, a);
  comparison.b = fitNineParameters(observations, b);
  if (comparison.a.state != comparison.b.state || comparison.a.reference_state != comparison.b.reference_state) {
    throw InputError(
        fmt::format("states {} and {} cannot be compared as sets of points; allowed: the same state twice.",
                    comparison.a.state, comparison.b.state));
  }
  comparison.p_value.fill(1.0);
  if (comparison.a.status == FitStatus::Rejected || comparison.b.status == FitStatus::Rejected) {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    comparison.difference.setConstant(nothing);
    comparison.covariance.diagonal().setConstant(std::numeric_limits<double>::infinity());
    comparison.chi2 = comparison.p_value_all = nothing;
    return comparison;
  }
  comparison.difference = comparison.b.parameters - comparison.a.parameters;
  const Eigen::MatrixXd gain = comparison.b.gain - comparison.a.gain;
  comparison.estimable_covariance = gain * comparison.a.value_covariance * gain.transpose();
  comparison.covariance = comparison.estimable_covariance;
  std::vector<int> determined;
  for (int i = 0; i < nine_parameter_count; ++i) {
    if (!comparison.a.determined(i) || !comparison.b.determined(i)) {
      comparison.covariance.row(i).setZero();
      comparison.covariance.col(i).setZero();
      comparison.covariance(i, i) = std::numeric_limits<double>::infinity();
      continue;
    }
    determined.push_back(i);
    const double sigma = std::sqrt(comparison.covariance(i, i));
    const double reference = comparison.a.standardUncertainty(i);
    if (!(sigma > 1e-9 * reference)) continue;  // the same points: no difference at all
    comparison.p_value[static_cast<std::size_t>(i)] = 2.0 * normalCdf(-std::abs(comparison.difference(i)) / sigma);
    if (comparison.p_value[static_cast<std::size_t>(i)] < level / nine_parameter_count) {
      comparison.significant.push_back(i);
    }
  }
  // Differences may be linearly dependent (common points): test in the space they span.
  const auto n = static_cast<Eigen::Index>(determined.size());
  Eigen::VectorXd d(n);
  Eigen::MatrixXd C(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int p = determined[static_cast<std::size_t>(i)];
    const double si = std::sqrt(std::max(comparison.a.covariance(p, p), 1e-300));
    d(i) = comparison.difference(p) / si;
    for (Eigen::Index j = 0; j < n; ++j) {
      const int q = determined[static_cast<std::size_t>(j)];
      C(i, j) = comparison.covariance(p, q) / si / std::sqrt(std::max(comparison.a.covariance(q, q), 1e-300));
    }
  }
  if (n > 0) {
    const SingularValues svd = singularValues(C);
    for (Eigen::Index k = 0; k < n; ++k) {
      if (!(svd.values(k) > 1e-9 * std::max(1.0, svd.values(0)))) break;
      const double part = svd.left.col(k).dot(d);
      comparison.chi2 += part * part / svd.values(k);
      ++comparison.degrees_of_freedom;
    }
    if (comparison.degrees_of_freedom > 0) {
      comparison.p_value_all = chiSquaredTail(comparison.chi2, comparison.degrees_of_freedom);
    }
  }
  return comparison;
}

std::optional<NineParameterComparison> compareWithOthers(const ObservationSet& observations,
                                                         const NineParameterFit& fit,
                                                         const NineParameterOptions& options) {
  if (options.points.empty()) return std::nullopt;
  std::set<std::string> others;
  for (const NineParameterResidual& r : fit.residuals) others.insert(r.point);
  for (const std::string& point : options.points) others.erase(point);
  if (others.size() < 3) return std::nullopt;
  NineParameterOptions of_others = options;
  of_others.points.assign(others.begin(), others.end());
  return compareNineParameters(observations, options, of_others);
}

}  // namespace spindrift
