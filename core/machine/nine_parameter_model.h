// SPDX-License-Identifier: Apache-2.0
// The nine-parameter thermal error model of a table (P0 (21)-(23) as PAPERS.md corrects it), for one thermal state.
//
//   ex = EX - (EC + EC0Y) y + EB z + alphaX x
//   ey = EY + EC x - EA z + alphaY y
//   ez = EZ - EB x + EA y
//
// with x, y, z in mm in MCF (z = 0 on the table, where the paper's form results), EX, EY, EZ in um, EA, EB, EC, EC0Y in
// urad (EC0Y: ISO 230-1 squareness of Y to X) and alphaX, alphaY in um/m. Deviations in um.
//
// Values of observations hold up to a constant per point and component, so a state is fitted as its change from the
// reference (first) state: v = y(state) - y(reference), cov(v) from the full covariance of both. The noise of the
// reference state counts, once, and is shared by all rows that use the same reference row. Where the reference was not
// measured the values are taken as they stand.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/machine/error_model.h"
#include "core/machine/observation.h"

namespace spindrift {

inline constexpr int nine_parameter_count = 9;
/// Names as in the JSON of `fit`, in the order of every parameter vector here.
inline constexpr std::array<std::string_view, nine_parameter_count> nine_parameter_names{
    "EX_um", "EY_um", "EZ_um", "EA_urad", "EB_urad", "EC_urad", "EC0Y_urad", "alpha_X_um_per_m", "alpha_Y_um_per_m"};

using NineVector = Eigen::Matrix<double, nine_parameter_count, 1>;
using NineMatrix = Eigen::Matrix<double, nine_parameter_count, nine_parameter_count>;

/// Unit of a parameter: "um", "urad" or "um/m".
[[nodiscard]] std::string_view nineParameterUnit(int parameter);

/// Sensitivity of a component (EX, EY, EZ; um) at a position to the nine parameters: one row of P0 (23).
[[nodiscard]] NineVector nineParameterRow(const Eigen::Vector3d& position_mm, Component component);

/// The model with known or fitted parameters. Rotations: EA, EB, EC are the parameters themselves.
class NineParameterModel final : public ErrorModel {
 public:
  /// `null_space`: columns are directions of the parameters that are not determined (may have no columns). A prediction
  /// that depends on one of them has an infinite sigma. `lack_of_fit_um`: standard deviation of what the model does not
  /// describe of EX, EY, EZ; part of the sigma of every prediction of them.
  NineParameterModel(const NineVector& parameters, const NineMatrix& covariance, std::string description,
                     Eigen::MatrixXd null_space = {}, Eigen::Vector3d lack_of_fit_um = Eigen::Vector3d::Zero());

  [[nodiscard]] std::string description() const override { return description_; }
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& query, Component component) const override;
  [[nodiscard]] PredictedComponent predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                                 Component component) const override;
  [[nodiscard]] const NineVector& parameters() const noexcept { return parameters_; }
  [[nodiscard]] const NineMatrix& covariance() const noexcept { return covariance_; }

 private:
  /// row * parameters with the uncertainty of the parameters, and `lacks` times the variance of the lack of fit.
  [[nodiscard]] PredictedComponent combined(const NineVector& row, Component component, double lacks) const;

  NineVector parameters_;
  NineMatrix covariance_;
  std::string description_;
  Eigen::MatrixXd null_space_;
  Eigen::Vector3d lack_of_fit_um_;
};

enum class RobustLoss { None, Huber, Tukey };

struct NineParameterOptions {
  /// Thermal state to fit; empty: see lastStateToFit. `every_state` in an absolute set: all states as one.
  std::string state;
  std::vector<std::string> points;  ///< points to fit, the others validate; empty: all rows with use `fit`
  RobustLoss robust = RobustLoss::None;
  /// false: values as they stand, even if the reference state was measured; so are those of an absolute set.
  bool relative_to_reference = true;
  bool scale_by_residuals = false;  ///< true: covariance times chi2/dof (sigmas known up to a factor)
  double rank_tolerance = 1e-8;     ///< of the whitened, column-scaled design matrix

  /// Throws InputError for options no fit can be made with.
  void validate() const;
};

/// A row of the state that was fitted or validated. um.
struct NineParameterResidual {
  std::string point;
  Component component = Component::EX;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double c_deg = 0.0;  ///< angle of the table
  double time_s = 0.0;
  double value_um = 0.0;     ///< change from the reference state
  double sigma_um = 0.0;     ///< its standard uncertainty, with the noise of the reference
  double residual_um = 0.0;  ///< value - prediction
  double weight = 1.0;       ///< of the robust fit, 0..1
  bool used = true;          ///< took part in the fit

  [[nodiscard]] double inSigmas() const noexcept { return sigma_um > 0.0 ? residual_um / sigma_um : 0.0; }
  /// Beyond three standard uncertainties.
  [[nodiscard]] bool outlying() const noexcept { return std::abs(inSigmas()) > 3.0; }
};

/// Result of a fit. If `status` is Degenerate the parameters in `undetermined` have no value (infinite variance), the
/// others hold. If it is Rejected no parameter has one: all are NaN and in `undetermined`, and so are condition number,
/// chi2 and residuals NaN.
struct NineParameterFit {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  std::string state;
  std::string reference_state;  ///< empty: the values were taken as they stand
  NineVector parameters = NineVector::Zero();
  NineMatrix covariance = NineMatrix::Zero();
  std::vector<int> undetermined;
  Eigen::MatrixXd null_space;
  /// Finite covariance of the pseudo-inverse solution: that of every prediction the data determine.
  NineMatrix estimable_covariance = NineMatrix::Zero();
  double condition_number = 0.0;
  double chi2 = 0.0;
  int degrees_of_freedom = 0;
  std::optional<double> p_value;  ///< of chi2; small: the model or the sigmas do not hold
  /// Standard deviation of what the model leaves of EX, EY, EZ beyond the stated uncertainties, um; zero where chi2 is
  /// what chance allows (5 %). See core/math/lack_of_fit.h.
  Eigen::Vector3d lack_of_fit_um = Eigen::Vector3d::Zero();
  std::vector<NineParameterResidual> residuals;
  std::optional<double> rms_fit_um;
  std::optional<double> rms_validation_um;
  std::vector<std::string> warnings;
  Eigen::MatrixXd gain;              ///< 9 x rows: parameters = gain * values (zero columns where not used)
  Eigen::MatrixXd value_covariance;  ///< rows x rows, um^2

  [[nodiscard]] bool determined(int parameter) const;
  [[nodiscard]] double standardUncertainty(int parameter) const;
  [[nodiscard]] NineParameterModel model() const;
  /// The values and sigmas of `residuals` do not hold for a model that was rejected (p below 0.001).
  [[nodiscard]] bool rejected() const;
  /// The same values with the uncertainty of a prediction: the lack of fit stays at every place and makes the
  /// parameters less certain. What is compensated with.
  [[nodiscard]] NineParameterModel predictingModel() const;
};

/// Names all states of an absolute set together, unless a state is called so.
inline constexpr std::string_view every_state = "all";

/// The state that is fitted if none is named: `every_state` where an absolute set has few points in each; else the last
/// one with a displacement (EX, EY, EZ) of use `fit`, the reference state only if there is no other; the last of all if
/// none has one; empty without observations.
[[nodiscard]] std::string lastStateToFit(const ObservationSet& observations);

/// Displacements of one state as changes from the reference state: v = y(state) - y(reference), um. What is fitted, and
/// what is shown of it.
struct StateDifferences {
  std::string state;
  std::string reference;          ///< empty: the values are taken as they stand
  std::vector<std::size_t> rows;  ///< of the set, one a value; rows of use `exclude` are not among them
  Eigen::VectorXd value_um;
  Eigen::MatrixXd covariance_um2;     ///< with the noise of the reference and all that rows share
  std::vector<std::string> warnings;  ///< what was left out and why
  [[nodiscard]] double sigma_um(std::size_t k) const;
};

/// `relative` false: values as they stand, as those of an absolute set always are. Throws InputError for a state that
/// does not exist and for a set without rows.
[[nodiscard]] StateDifferences differencesFromReference(const ObservationSet& observations, const std::string& state,
                                                        bool relative = true);

/// Fits one state. Throws InputError for a state or point that does not exist or a state without any row to fit.
[[nodiscard]] NineParameterFit fitNineParameters(const ObservationSet& observations,
                                                 const NineParameterOptions& options = {});

/// Two fits of the same state from different sets of points (P0, Table 2 and Figures 22 and 23).
struct NineParameterComparison {
  NineParameterFit a;
  NineParameterFit b;
  NineVector difference = NineVector::Zero();  ///< b - a
  NineMatrix covariance = NineMatrix::Zero();  ///< of the difference; points in both sets are counted as common
  NineMatrix estimable_covariance = NineMatrix::Zero();  ///< finite, for fields
  std::array<double, nine_parameter_count> p_value{};    ///< two-sided, of each difference; 1 where not determined
  std::vector<int> significant;                          ///< parameters that differ at the level asked for
  /// Chi-squared test of all determined differences at once.
  double chi2 = 0.0;
  int degrees_of_freedom = 0;
  double p_value_all = 1.0;  ///< NaN, as chi2 and all differences, if a fit was rejected

  /// Difference b - a as a model: its field with sigma shows where the sets disagree.
  [[nodiscard]] NineParameterModel differenceModel() const;
};

/// `level`: probability of a false alarm over the nine parameters together (Bonferroni). Throws InputError as the fits.
[[nodiscard]] NineParameterComparison compareNineParameters(const ObservationSet& observations,
                                                            const NineParameterOptions& a,
                                                            const NineParameterOptions& b, double level = 0.05);

/// The points that `fit` was made from with these options against all others of its state; empty if fewer than three
/// are left. Throws InputError as the fits.
[[nodiscard]] std::optional<NineParameterComparison> compareWithOthers(const ObservationSet& observations,
                                                                       const NineParameterFit& fit,
                                                                       const NineParameterOptions& options);

}  // namespace spindrift
