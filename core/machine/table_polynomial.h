// SPDX-License-Identifier: Apache-2.0
// A model of one thermal state of higher order than the nine parameters, chosen by evidence (an open question of P0).
//
//   e_c(x, y, z) = nine parameters + sum_{2 <= i + j <= order_c} q_cij u^i w^j,   u = (x - x0) / L, w = (y - y0) / L
//
// for c = EX, EY, EZ with order_c = 1 (the nine parameters alone), 2 or 3. u and w lie in [-1, 1] over the fitted
// points; q in um. Values are the changes of a fit of the nine parameters, with their covariance V:
//   v = A theta + d + e,   e ~ N(0, V),   d ~ N(0, s^2 I): what the orders cannot describe, s by largest likelihood
// Evidence of a choice of orders: ln L - (parameters / 2) ln(rows) (Schwarz 1978), all choices equally probable
// beforehand. A richer model is taken only if the nine parameters alone are less than 5 % probable and if it predicts
// points that were left out, each in turn, better than they do. Lengths mm, deviations um.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/error_model.h"
#include "core/machine/nine_parameter_model.h"

namespace spindrift {

using TableOrders = std::array<int, 3>;  ///< of EX, EY, EZ: 1, 2 or 3

/// The columns of the model at a place, in the order of its parameters.
class TableBasis {
 public:
  TableBasis(const TableOrders& orders, const Eigen::Vector2d& centre_mm, double length_mm);
  [[nodiscard]] int size() const noexcept { return size_; }
  /// Of a displacement; zeros for those of the other components.
  [[nodiscard]] Eigen::VectorXd row(const Eigen::Vector3d& position_mm, Component component) const;
  /// "EX", ... as nine_parameter_names, then "EZ x2", "EZ xy" ... (um).
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] const TableOrders& orders() const noexcept { return orders_; }

 private:
  TableOrders orders_;
  Eigen::Vector2d centre_mm_;
  double length_mm_;
  int size_;
};

class TablePolynomialModel final : public ErrorModel {
 public:
  TablePolynomialModel(TableBasis basis, Eigen::VectorXd parameters, Eigen::MatrixXd covariance, double lack_of_fit_um,
                       std::string description);
  [[nodiscard]] std::string description() const override { return description_; }
  /// Rotations are those of the nine parameters. The sigma of a displacement holds the lack of fit.
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& query, Component component) const override;
  [[nodiscard]] PredictedComponent predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                                 Component component) const override;
  [[nodiscard]] const TableBasis& basis() const noexcept { return basis_; }
  [[nodiscard]] const Eigen::VectorXd& parameters() const noexcept { return parameters_; }
  [[nodiscard]] const Eigen::MatrixXd& covariance() const noexcept { return covariance_; }

 private:
  TableBasis basis_;
  Eigen::VectorXd parameters_;
  Eigen::MatrixXd covariance_;
  double lack_of_fit_um_;
  std::string description_;
};

/// One choice of orders that the points determine.
struct TableCandidate {
  TableOrders orders{1, 1, 1};
  int parameters = nine_parameter_count;
  double log_evidence = 0.0;
  double probability = 0.0;  ///< among all candidates
  double lack_of_fit_um = 0.0;
};

struct TableOrderChoice {
  FitStatus status = FitStatus::NotRun;    ///< Degenerate: the points do not even determine the nine parameters
  std::vector<TableCandidate> candidates;  ///< most probable first
  TableOrders orders{1, 1, 1};             ///< chosen
  int parameters = nine_parameter_count;   ///< of the chosen
  double probability_of_nine = 1.0;        ///< that the nine parameters are enough, among the candidates
  double lack_of_fit_um = 0.0;             ///< of the chosen
  /// rms of the points left out one after another, um; empty where the rest does not determine the model.
  std::optional<double> left_out_nine_um;
  std::optional<double> left_out_chosen_um;
  std::string reason;                                 ///< one sentence
  std::shared_ptr<const TablePolynomialModel> model;  ///< of the chosen orders; null if not Converged

  [[nodiscard]] bool richer() const noexcept { return orders != TableOrders{1, 1, 1}; }
  [[nodiscard]] nlohmann::json json() const;
};

/// From a fit of the nine parameters (its rows, their covariance and which of them were fitted).
[[nodiscard]] TableOrderChoice chooseTableOrder(const NineParameterFit& fit);

/// Values of a model fitted without a point, at that point.
struct LeftOut {
  std::vector<std::size_t> rows;  ///< of NineParameterFit::residuals
  std::vector<double> predicted_um;
};
/// Every fitted point left out in turn; points without which the rest does not determine the model are not in it.
[[nodiscard]] LeftOut predictLeftOut(const NineParameterFit& fit, const TableOrders& orders);

/// "second order in EX and EZ"; "the nine parameters" for first order in all.
[[nodiscard]] std::string orderText(const TableOrders& orders);

}  // namespace spindrift
