// SPDX-License-Identifier: Apache-2.0
#include "core/machine/table_polynomial.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/math/least_squares.h"
#include "core/math/singular_values.h"

namespace spindrift {
namespace {

constexpr int highest_order = 3;
constexpr int spare_rows = 3;      ///< beyond the parameters, so that the residuals say something
constexpr double accepted = 0.05;  ///< the nine parameters are kept at this probability and above
constexpr double rank_tolerance = 1e-7;

/// Monomials of order 2 ... order.
int monomials(int order) {
  int count = 0;
  for (int n = 2; n <= order; ++n) count += n + 1;
  return count;
}

/// The fitted rows of a nine-parameter fit, whitened but for the lack of fit: V = Q diag(lambda) Q^T.
struct Rows {
  std::vector<std::size_t> index;  ///< of the fit's residuals
  Eigen::MatrixXd turn;            ///< Q^T
  Eigen::VectorXd lambda;
  Eigen::VectorXd v;  ///< Q^T v
};

/// Fitted points, of many every n-th: more say no more about a few coefficients, and cost their number cubed.
std::vector<std::string> pointsOf(const NineParameterFit& fit) {
  constexpr std::size_t most_points = 100;
  std::vector<std::string> points;
  std::set<std::string> seen;
  for (const NineParameterResidual& r : fit.residuals)
    if (r.used && seen.insert(r.point).second) points.push_back(r.point);
  const std::size_t stride = (points.size() + most_points - 1) / most_points;
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < points.size(); i += std::max<std::size_t>(stride, 1)) kept.push_back(points[i]);
  return kept;
}

std::vector<std::size_t> rowsAt(const NineParameterFit& fit, const std::set<std::string>& points) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < fit.residuals.size(); ++i)
    if (fit.residuals[i].used && points.contains(fit.residuals[i].point)) rows.push_back(i);
  return rows;
}

Eigen::MatrixXd covarianceOf(const NineParameterFit& fit, const std::vector<std::size_t>& index) {
  const auto n = static_cast<Eigen::Index>(index.size());
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto a = static_cast<Eigen::Index>(index[static_cast<std::size_t>(i)]);
    for (Eigen::Index j = 0; j < n; ++j) {
      covariance(i, j) = fit.value_covariance(a, static_cast<Eigen::Index>(index[static_cast<std::size_t>(j)]));
    }
    // A row of which the robust fit thought little counts as little here.
    const NineParameterResidual& r = fit.residuals[static_cast<std::size_t>(a)];
    covariance(i, i) += r.sigma_um * r.sigma_um * (1.0 / std::max(r.weight, 1e-6) - 1.0);
  }
  return covariance;
}

Eigen::VectorXd valuesOf(const NineParameterFit& fit, const std::vector<std::size_t>& index) {
  Eigen::VectorXd value(static_cast<Eigen::Index>(index.size()));
  for (std::size_t i = 0; i < index.size(); ++i) value(static_cast<Eigen::Index>(i)) = fit.residuals[index[i]].value_um;
  return value;
}

Rows rowsOf(const NineParameterFit& fit) {
  Rows rows;
  const std::vector<std::string> points = pointsOf(fit);
  rows.index = rowsAt(fit, {points.begin(), points.end()});
  const Eigen::VectorXd value = valuesOf(fit, rows.index);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(covarianceOf(fit, rows.index));
  rows.turn = modes.eigenvectors().transpose();
  rows.lambda = modes.eigenvalues().cwiseMax(1e-12 * std::max(modes.eigenvalues().maxCoeff(), 1e-12));
  rows.v = rows.turn * value;
  return rows;
}

struct Solution {
  double chi2 = 0.0;
  double log_likelihood = 0.0;
  Eigen::VectorXd x;
  Eigen::MatrixXd covariance;
};

/// Generalised least squares with V + s^2 I. `turned`: Q^T A.
Solution solveAt(const Rows& rows, const Eigen::MatrixXd& turned, double variance, bool with_covariance = false) {
  const Eigen::VectorXd spread = (rows.lambda.array() + variance).sqrt();
  const Eigen::MatrixXd white = spread.cwiseInverse().asDiagonal() * turned;
  const Eigen::VectorXd value = rows.v.cwiseQuotient(spread);
  Solution out;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(white);
  out.x = qr.solve(value);
  out.chi2 = (value - white * out.x).squaredNorm();
  out.log_likelihood = -0.5 * out.chi2 - spread.array().log().sum();
  if (with_covariance) {
    const Eigen::Index k = turned.cols();
    const Eigen::MatrixXd R = qr.matrixQR().topRows(k).triangularView<Eigen::Upper>();
    const Eigen::MatrixXd inverse = R.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(k, k));
    out.covariance = inverse * inverse.transpose();
  }
  return out;
}

/// Columns of the basis for some rows; empty if these do not determine them.
Eigen::MatrixXd columnsOf(const NineParameterFit& fit, const std::vector<std::size_t>& index, const TableBasis& basis) {
  const auto n = static_cast<Eigen::Index>(index.size());
  if (n < basis.size()) return {};
  Eigen::MatrixXd A(n, basis.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const NineParameterResidual& r = fit.residuals[index[static_cast<std::size_t>(i)]];
    A.row(i) = basis.row(r.position_mm, r.component).transpose();
  }
  const Eigen::VectorXd norms = A.colwise().norm();
  if (!(norms.minCoeff() > 0.0)) return {};
  if (singularValues(A * norms.cwiseInverse().asDiagonal()).rank(rank_tolerance) < A.cols()) return {};
  return A;
}

/// s^2 of largest likelihood, by golden section in ln s between a thousandth and the whole of the scatter.
double likeliestVariance(const Rows& rows, const Eigen::MatrixXd& turned, Solution& best) {
  best = solveAt(rows, turned, 0.0);
  const double noise = rows.lambda.mean();
  const double scatter = std::max(noise, best.chi2 * noise / std::max<double>(1.0, static_cast<double>(rows.v.size())));
  const auto at = [&](double log_variance) { return solveAt(rows, turned, std::exp(log_variance)).log_likelihood; };
  double low = std::log(1e-4 * noise);
  double high = std::log(1e2 * scatter);
  constexpr double ratio = 0.6180339887498949;
  double a = high - ratio * (high - low);
  double b = low + ratio * (high - low);
  double la = at(a);
  double lb = at(b);
  for (int i = 0; i < 24; ++i) {
    if (la > lb) {
      high = b;
      b = a;
      lb = la;
      a = high - ratio * (high - low);
      la = at(a);
    } else {
      low = a;
      a = b;
      la = lb;
      b = low + ratio * (high - low);
      lb = at(b);
    }
  }
  const double variance = std::exp(0.5 * (low + high));
  Solution with = solveAt(rows, turned, variance);
  if (with.log_likelihood <= best.log_likelihood) return 0.0;
  best = std::move(with);
  return variance;
}

/// s^2 for which chi-squared is the degrees of freedom (Paule and Mandel 1982): likelihood alone makes it too small.
double unbiasedVariance(const Rows& rows, const Eigen::MatrixXd& turned) {
  const auto dof = static_cast<double>(turned.rows() - turned.cols());
  if (dof < 1.0 || solveAt(rows, turned, 0.0).chi2 <= dof) return 0.0;
  double low = 0.0;
  double high = rows.lambda.mean();
  while (solveAt(rows, turned, high).chi2 > dof && high < 1e12) high *= 4.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (solveAt(rows, turned, middle).chi2 > dof ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

struct Frame {
  Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();
  double length_mm = 1.0;
};

Frame frameOf(const NineParameterFit& fit) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (const NineParameterResidual& r : fit.residuals) {
    if (!r.used) continue;
    low = low.cwiseMin(r.position_mm.head<2>());
    high = high.cwiseMax(r.position_mm.head<2>());
  }
  Frame frame;
  if (!(low.array() <= high.array()).all()) return frame;
  frame.centre_mm = 0.5 * (low + high);
  frame.length_mm = std::max(1.0, 0.5 * (high - low).maxCoeff());
  return frame;
}

std::optional<double> polynomialRms(const NineParameterFit& fit, const LeftOut& left_out,
                                    const std::set<std::size_t>& among) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < left_out.rows.size(); ++i) {
    if (!among.contains(left_out.rows[i])) continue;
    sum += std::pow(fit.residuals[left_out.rows[i]].value_um - left_out.predicted_um[i], 2);
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  return std::sqrt(sum / count);
}

}  // namespace

TableBasis::TableBasis(const TableOrders& orders, const Eigen::Vector2d& centre_mm, double length_mm)
    : orders_(orders), centre_mm_(centre_mm), length_mm_(length_mm), size_(nine_parameter_count) {
  for (const int order : orders_) {
    SPINDRIFT_ASSERT(order >= 1 && order <= highest_order, "an order of a table model out of range");
    size_ += monomials(order);
  }
}

Eigen::VectorXd TableBasis::row(const Eigen::Vector3d& position_mm, Component component) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(size_);
  out.head<nine_parameter_count>() = nineParameterRow(position_mm, component);
  const Eigen::Vector2d p = (position_mm.head<2>() - centre_mm_) / length_mm_;
  Eigen::Index at = nine_parameter_count;
  for (int c = 0; c < 3; ++c) {
    for (int n = 2; n <= orders_[static_cast<std::size_t>(c)]; ++n) {
      for (int j = 0; j <= n; ++j, ++at) {
        if (c == static_cast<int>(component)) out(at) = std::pow(p.x(), n - j) * std::pow(p.y(), j);
      }
    }
  }
  return out;
}

std::vector<std::string> TableBasis::names() const {
  std::vector<std::string> out(nine_parameter_names.begin(), nine_parameter_names.end());
  const auto power = [](char letter, int n) {
    return n == 0 ? std::string() : n == 1 ? std::string(1, letter) : fmt::format("{}{}", letter, n);
  };
  for (std::size_t c = 0; c < 3; ++c) {
    for (int n = 2; n <= orders_[c]; ++n) {
      for (int j = 0; j <= n; ++j) {
        out.push_back(fmt::format("{}_{}{}_um", toString(static_cast<Component>(c)), power('x', n - j), power('y', j)));
      }
    }
  }
  return out;
}

TablePolynomialModel::TablePolynomialModel(TableBasis basis, Eigen::VectorXd parameters, Eigen::MatrixXd covariance,
                                           double lack_of_fit_um, std::string description)
    : basis_(std::move(basis)),
      parameters_(std::move(parameters)),
      covariance_(std::move(covariance)),
      lack_of_fit_um_(lack_of_fit_um),
      description_(std::move(description)) {}

PredictedComponent TablePolynomialModel::predict(const DeviationQuery& query, Component component) const {
  const Eigen::VectorXd row = basis_.row(query.position_mm, component);
  const double lack = isRotation(component) ? 0.0 : lack_of_fit_um_;
  return {row.dot(parameters_), std::sqrt(std::max(0.0, row.dot(covariance_ * row)) + lack * lack)};
}

PredictedComponent TablePolynomialModel::predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                                       Component component) const {
  const Eigen::VectorXd row = basis_.row(query.position_mm, component) - basis_.row(reference.position_mm, component);
  // What the model does not describe is its own at every place.
  const bool same = isRotation(component) || query.position_mm == reference.position_mm;
  const double lack = same ? 0.0 : lack_of_fit_um_;
  return {row.dot(parameters_), std::sqrt(std::max(0.0, row.dot(covariance_ * row)) + 2.0 * lack * lack)};
}

std::string orderText(const TableOrders& orders) {
  std::string text;
  for (int order = 2; order <= highest_order; ++order) {
    std::vector<std::string> components;
    for (std::size_t c = 0; c < 3; ++c)
      if (orders[c] == order) components.emplace_back(toString(static_cast<Component>(c)));
    if (components.empty()) continue;
    if (!text.empty()) text += ", ";
    text += order == 2 ? fmt::format("second order in {}", joinedList(components))
                       : fmt::format("third order in {}", joinedList(components));
  }
  return text.empty() ? "the nine parameters" : text;
}

LeftOut predictLeftOut(const NineParameterFit& fit, const TableOrders& orders) {
  LeftOut out;
  const Frame frame = frameOf(fit);
  const TableBasis basis(orders, frame.centre_mm, frame.length_mm);
  const Rows all = rowsOf(fit);
  const Eigen::MatrixXd A_all = columnsOf(fit, all.index, basis);
  if (A_all.size() == 0) return out;
  const double lack = unbiasedVariance(all, all.turn * A_all);
  const std::vector<std::string> points = pointsOf(fit);
  for (const std::string& point : points) {
    std::set<std::string> others(points.begin(), points.end());
    others.erase(point);
    const std::vector<std::size_t> index = rowsAt(fit, others);
    const Eigen::MatrixXd A = columnsOf(fit, index, basis);
    if (A.size() == 0) continue;
    Eigen::MatrixXd covariance = covarianceOf(fit, index);
    covariance.diagonal().array() += lack;
    const LinearFitResult solution = solveLinearCorrelated(A, valuesOf(fit, index), covariance);
    if (!solution.usable()) continue;
    for (const std::size_t i : rowsAt(fit, {point})) {
      const NineParameterResidual& r = fit.residuals[i];
      out.rows.push_back(i);
      out.predicted_um.push_back(basis.row(r.position_mm, r.component).dot(solution.x));
    }
  }
  return out;
}

TableOrderChoice chooseTableOrder(const NineParameterFit& fit) {
  TableOrderChoice choice;
  if (fit.status != FitStatus::Converged) {
    choice.status = FitStatus::Degenerate;
    choice.reason = "The points do not determine the nine parameters, and so nothing of higher order.";
    return choice;
  }
  const Frame frame = frameOf(fit);
  const Rows rows = rowsOf(fit);
  const auto n = static_cast<double>(rows.index.size());
  for (int x = 1; x <= highest_order; ++x) {
    for (int y = 1; y <= highest_order; ++y) {
      for (int z = 1; z <= highest_order; ++z) {
        const TableBasis basis({x, y, z}, frame.centre_mm, frame.length_mm);
        const bool first = x + y + z == 3;
        if (!first && static_cast<int>(rows.index.size()) < basis.size() + spare_rows) continue;
        const Eigen::MatrixXd columns = columnsOf(fit, rows.index, basis);
        if (columns.size() == 0) continue;
        const Eigen::MatrixXd A = rows.turn * columns;
        Solution best;
        const double variance = likeliestVariance(rows, A, best);
        TableCandidate candidate;
        candidate.orders = basis.orders();
        candidate.parameters = basis.size();
        candidate.lack_of_fit_um = std::sqrt(variance);
        candidate.log_evidence = best.log_likelihood - 0.5 * basis.size() * std::log(n);
        choice.candidates.push_back(candidate);
      }
    }
  }
  SPINDRIFT_ASSERT(!choice.candidates.empty(), "a fit that converged determines the nine parameters");
  std::stable_sort(choice.candidates.begin(), choice.candidates.end(),
                   [](const TableCandidate& a, const TableCandidate& b) { return a.log_evidence > b.log_evidence; });
  double sum = 0.0;
  for (TableCandidate& c : choice.candidates) {
    c.probability = std::exp(c.log_evidence - choice.candidates.front().log_evidence);
    sum += c.probability;
  }
  for (TableCandidate& c : choice.candidates) {
    c.probability /= sum;
    if (c.orders == TableOrders{1, 1, 1}) choice.probability_of_nine = c.probability;
  }
  const TableOrders nine{1, 1, 1};
  const TableOrders likeliest = choice.candidates.front().orders;
  const LeftOut by_nine = predictLeftOut(fit, nine);
  std::set<std::size_t> both(by_nine.rows.begin(), by_nine.rows.end());
  const bool wanted = likeliest != nine && choice.probability_of_nine < accepted;
  if (wanted) {
    const LeftOut by_likeliest = predictLeftOut(fit, likeliest);
    std::set<std::size_t> common;
    for (const std::size_t row : by_likeliest.rows)
      if (both.contains(row)) common.insert(row);
    both = common;
    const auto richer_um = polynomialRms(fit, by_likeliest, both);
    const auto nine_um = polynomialRms(fit, by_nine, both);
    const bool enough = 2 * both.size() >= rows.index.size();
    if (enough && richer_um && nine_um && *richer_um < *nine_um) {
      choice.orders = likeliest;
      choice.left_out_chosen_um = richer_um;
      choice.left_out_nine_um = nine_um;
      choice.reason = fmt::format(
          "A model of {} is needed (the nine parameters alone: probability {:.2g}); it predicts points left out to "
          "{:.2f} "
          "µm, the "
          "nine parameters to {:.2f} µm.",
          orderText(likeliest), choice.probability_of_nine, *richer_um, *nine_um);
    } else if (!enough) {
      choice.reason = fmt::format(
          "The nine parameters alone are improbable ({:.2g}), but there are too few points to check a model of {} on "
          "points it was not fitted to.",
          choice.probability_of_nine, orderText(likeliest));
    } else {
      choice.reason = fmt::format(
          "The nine parameters alone are improbable ({:.2g}), but {} does not predict points left out any better "
          "({:.2f} µm against {:.2f} µm): single points are disturbed, or what is missing is of another kind.",
          choice.probability_of_nine, orderText(likeliest), richer_um.value_or(0.0), nine_um.value_or(0.0));
    }
  } else {
    choice.reason = choice.candidates.size() == 1
                        ? "There are too few points to see anything of higher order than the nine parameters."
                        : fmt::format("The nine parameters are enough (probability {:.2g} among {} models).",
                                      choice.probability_of_nine, choice.candidates.size());
  }
  if (!choice.richer()) {
    choice.left_out_nine_um = polynomialRms(fit, by_nine, both);
    choice.left_out_chosen_um = choice.left_out_nine_um;
  }
  TableBasis basis(choice.orders, frame.centre_mm, frame.length_mm);
  const Eigen::MatrixXd A = rows.turn * columnsOf(fit, rows.index, basis);
  const double variance = unbiasedVariance(rows, A);
  Solution solution = solveAt(rows, A, variance, true);
  choice.lack_of_fit_um = std::sqrt(variance);
  choice.parameters = basis.size();
  const std::string from = fit.reference_state.empty()
                               ? fmt::format("state {}", fit.state)
                               : fmt::format("the change from state {} to {}", fit.reference_state, fit.state);
  choice.model = std::make_shared<TablePolynomialModel>(
      std::move(basis), std::move(solution.x), std::move(solution.covariance), choice.lack_of_fit_um,
      fmt::format("model of {} of {}", orderText(choice.orders), from));
  choice.status = FitStatus::Converged;
  return choice;
}

nlohmann::json TableOrderChoice::json() const {
  const auto ordersJson = [](const TableOrders& o) { return nlohmann::json{{"EX", o[0]}, {"EY", o[1]}, {"EZ", o[2]}}; };
  nlohmann::json list = nlohmann::json::array();
  constexpr std::size_t most_listed = 8;
  for (std::size_t i = 0; i < std::min(candidates.size(), most_listed); ++i) {
    const TableCandidate& c = candidates[i];
    list.push_back({{"orders", ordersJson(c.orders)},
                    {"parameters", c.parameters},
                    {"probability", jsonNumber(c.probability)},
                    {"log_evidence", jsonNumber(c.log_evidence)},
                    {"lack_of_fit_um", jsonNumber(c.lack_of_fit_um)}});
  }
  nlohmann::json out{{"status", toString(status)},
                     {"needed", richer()},
                     {"reason", reason},
                     {"orders", ordersJson(orders)},
                     {"probability_of_nine_parameters", jsonNumber(probability_of_nine)},
                     {"lack_of_fit_um", jsonNumber(lack_of_fit_um)},
                     {"left_out_rms_um",
                      {{"nine_parameters", jsonNumber(left_out_nine_um)}, {"chosen", jsonNumber(left_out_chosen_um)}}},
                     {"candidates", list}};
  if (!model) return out;
  nlohmann::json values = nlohmann::json::object();
  const std::vector<std::string> names = model->basis().names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    values[names[i]] = {{"value", jsonNumber(model->parameters()(e))},
                        {"standard_uncertainty", jsonNumber(std::sqrt(model->covariance()(e, e)))}};
  }
  out["parameters"] = values;
  return out;
}

}  // namespace spindrift
