// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/focus.h"

#include "core/imaging/contrast_curve.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <glog/logging.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

namespace spindrift {
namespace {

constexpr int half_window_px = 7;
constexpr double derivative_sigma_px = half_window_px / 2.5;
constexpr int coarse_factor = 4;
constexpr int shape_terms = 3;
/// Heights are scaled by this, so that all parameters are of the order of one.
constexpr double unit_mm = 0.25;

double gradientEnergy(const cv::Mat& level) {
  cv::Mat smooth(1, 2 * half_window_px + 1, CV_32F);
  cv::Mat derivative(1, 2 * half_window_px + 1, CV_32F);
  double sum = 0.0;
  for (int i = -half_window_px; i <= half_window_px; ++i) {
    const double g = std::exp(-i * i / (2.0 * derivative_sigma_px * derivative_sigma_px));
    sum += g;
    smooth.at<float>(i + half_window_px) = static_cast<float>(g);
  }
  smooth /= sum;
  for (int i = -half_window_px; i <= half_window_px; ++i) {
    derivative.at<float>(i + half_window_px) =
        static_cast<float>(-i / (derivative_sigma_px * derivative_sigma_px)) * smooth.at<float>(i + half_window_px);
  }
  // In bands, so that the intermediate pictures stay in the cache and memory stays small.
  constexpr int band = 128;
  double energy = 0.0;
  cv::Mat gradient;
  for (int top = 0; top < level.rows; top += band) {
    const cv::Mat part = level.rowRange(top, std::min(top + band, level.rows));
    cv::sepFilter2D(part, gradient, CV_32F, derivative, smooth);
    energy += gradient.dot(gradient);
    cv::sepFilter2D(part, gradient, CV_32F, smooth, derivative);
    energy += gradient.dot(gradient);
  }
  return energy / static_cast<double>(level.total());
}

/// Parameters: peaks, log gains, shape. Heights in units of unit_mm.
struct CurveModel {
  const std::vector<FocusSet>& sets;
  const std::vector<std::size_t>& used;

  [[nodiscard]] Eigen::Index size() const { return 2 * static_cast<Eigen::Index>(used.size()) + shape_terms; }
  [[nodiscard]] Eigen::Index rows() const {
    std::size_t n = 0;
    for (const std::size_t i : used) n += sets[i].height_mm.size();
    return static_cast<Eigen::Index>(n);
  }
  /// ln(1/n) of the model, and its derivatives; false where the shape is not positive.
  bool evaluate(const Eigen::VectorXd& p, Eigen::VectorXd& y, Eigen::MatrixXd* J) const {
    const auto n = static_cast<Eigen::Index>(used.size());
    if (J != nullptr) J->setZero();
    Eigen::Index row = 0;
    for (Eigen::Index k = 0; k < n; ++k) {
      for (const double height : sets[used[static_cast<std::size_t>(k)]].height_mm) {
        const double u = height / unit_mm - p(k);
        double H = 1.0;
        double slope = 0.0;
        for (int t = 0; t < shape_terms; ++t) {
          H += p(2 * n + t) * std::pow(u, t + 2);
          slope += p(2 * n + t) * (t + 2) * std::pow(u, t + 1);
        }
        if (!(H > 1e-3)) return false;
        y(row) = p(n + k) + std::log(H);
        if (J != nullptr) {
          (*J)(row, k) = -slope / H;
          (*J)(row, n + k) = 1.0;
          for (int t = 0; t < shape_terms; ++t) (*J)(row, 2 * n + t) = std::pow(u, t + 2) / H;
        }
        ++row;
      }
    }
    return true;
  }
};

/// What the curves leave of ln(1/n).
class CurveCost : public ceres::CostFunction {
 public:
  CurveCost(const CurveModel& model, const Eigen::VectorXd& y) : model_(&model), y_(&y) {
    set_num_residuals(static_cast<int>(model.rows()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(model.size()));
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::VectorXd p = Eigen::Map<const Eigen::VectorXd>(parameters[0], model_->size());
    Eigen::VectorXd prediction(y_->size());
    const bool with_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    Eigen::MatrixXd J(with_jacobian ? y_->size() : 0, model_->size());
    if (!model_->evaluate(p, prediction, with_jacobian ? &J : nullptr)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, y_->size()) = prediction - *y_;
    if (with_jacobian)
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(jacobians[0], J.rows(),
                                                                                         J.cols()) = J;
    return true;
  }

 private:
  const CurveModel* model_;
  const Eigen::VectorXd* y_;
};

/// Least squares from p on; false if it does not end at a minimum.
bool minimise(const CurveModel& model, const Eigen::VectorXd& y, Eigen::VectorXd& p) {
  // What ends a fit is told in our own sentences.
  FLAGS_minloglevel = google::GLOG_FATAL;
  CurveCost cost(model, y);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, p.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.max_num_consecutive_invalid_steps = 50;  // a shape that is not positive somewhere
  options.function_tolerance = 1e-16;
  options.gradient_tolerance = 1e-16;
  options.parameter_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.termination_type == ceres::CONVERGENCE;
}

/// Parabola through 1/n at the sharpest height and its neighbours: height of its minimum.
double startingPeak(const std::vector<std::pair<double, double>>& curve, std::size_t sharpest) {
  const auto [z0, a] = curve[sharpest - 1];
  const auto [z1, b] = curve[sharpest];
  const auto [z2, c] = curve[sharpest + 1];
  const double s1 = (1 / b - 1 / a) / (z1 - z0);
  const double s2 = (1 / c - 1 / b) / (z2 - z1);
  const double curvature = (s2 - s1) / (z2 - z0);
  return curvature > 0.0 ? 0.5 * (z0 + z1) - s1 / (2.0 * curvature) : z1;
}

}  // namespace

void FocusOptions::validate() const {
  if (!(expected_noise > 0.0) || !(expected_weight >= 0.0)) {
    throw InputError("the expected noise of a contrast must be greater than zero and its weight not negative.");
  }
}

FocusMeasure measureFocus(const GrayImage& image) {
  FocusMeasure measure;
  if (image.empty()) return measure;
  const cv::Mat grey(image.height(), image.width(), CV_8U, const_cast<std::uint8_t*>(image.data()));
  measure.mean_level = cv::mean(grey)[0];
  measure.contrast = gradientEnergy(grey);
  cv::Mat exact;
  cv::Mat small;
  grey.convertTo(exact, CV_32F);
  cv::resize(exact, small,
             cv::Size(std::max(1, image.width() / coarse_factor), std::max(1, image.height() / coarse_factor)), 0, 0,
             cv::INTER_AREA);
  measure.coarse_contrast = gradientEnergy(small) / (coarse_factor * coarse_factor);
  // Below this there is nothing in the image but noise.
  constexpr double least_coarse_contrast = 1e-4;
  if (measure.coarse_contrast > least_coarse_contrast) measure.normalised = measure.contrast / measure.coarse_contrast;
  return measure;
}

double FocusResult::curve(std::size_t set, double height_mm) const {
  return contrastAt(shape, peaks[set].gain, peaks[set].peak_um, height_mm);
}

FocusResult fitFocus(const std::vector<FocusSet>& sets, const FocusOptions& options) {
  options.validate();
  FocusResult result;
  const auto count = static_cast<Eigen::Index>(sets.size());
  result.peaks.resize(sets.size());
  result.covariance = Eigen::MatrixXd::Zero(count, count);
  result.shape = Eigen::VectorXd::Zero(shape_terms);
  std::vector<std::size_t> used;
  std::vector<double> start;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const FocusSet& set = sets[i];
    SPINDRIFT_ASSERT(set.height_mm.size() == set.normalised.size(), "a focus set has one contrast per height");
    std::vector<std::pair<double, double>> curve;
    for (std::size_t k = 0; k < set.height_mm.size(); ++k) curve.emplace_back(set.height_mm[k], set.normalised[k]);
    std::sort(curve.begin(), curve.end());
    FocusPeak& peak = result.peaks[i];
    peak.status = FitStatus::Rejected;
    const std::set<double> heights(set.height_mm.begin(), set.height_mm.end());
    if (heights.size() < 5) {
      peak.message = fmt::format("{} has {} usable focus heights; at least 5 are needed.", set.name, heights.size());
      continue;
    }
    const auto sharpest = static_cast<std::size_t>(
        std::max_element(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.second < b.second; }) -
        curve.begin());
    if (sharpest == 0 || sharpest + 1 == curve.size()) {
      peak.message = fmt::format(
          "all heights of {} lie on one side of focus: the sharpest image is the {} one; move the range of heights {}.",
          set.name, sharpest == 0 ? "lowest" : "highest", sharpest == 0 ? "down" : "up");
      continue;
    }
    peak.status = FitStatus::Converged;
    used.push_back(i);
    start.push_back(startingPeak(curve, sharpest) / unit_mm);
  }
  if (used.empty()) {
    result.status = FitStatus::Rejected;
    result.message = "no set of focus images could be used";
    return result;
  }
  const CurveModel model{sets, used};
  const auto n = static_cast<Eigen::Index>(used.size());
  Eigen::VectorXd y(model.rows());
  Eigen::Index row = 0;
  Eigen::VectorXd p = Eigen::VectorXd::Zero(model.size());
  for (Eigen::Index k = 0; k < n; ++k) {
    p(k) = start[static_cast<std::size_t>(k)];
    double largest = 0.0;
    for (const double c : sets[used[static_cast<std::size_t>(k)]].normalised) {
      y(row++) = -std::log(c);
      largest = std::max(largest, c);
    }
    p(n + k) = -std::log(largest);
  }
  p(2 * n) = 0.5;
  Eigen::VectorXd prediction(y.size());
  Eigen::MatrixXd J(y.size(), p.size());
  if (!model.evaluate(p, prediction, nullptr)) p(2 * n) = 0.0;
  const bool converged = minimise(model, y, p);
  if (!converged) {
    result.status = FitStatus::NoConvergence;
    result.message = "the contrast curves do not settle on a common shape";
    for (const std::size_t i : used) result.peaks[i].status = FitStatus::NoConvergence;
    return result;
  }
  model.evaluate(p, prediction, &J);
  const double chi2 = (y - prediction).squaredNorm();
  result.degrees_of_freedom = static_cast<int>(y.size() - p.size());
  const double spread = options.expected_weight * options.expected_noise * options.expected_noise;
  const double variance =
      (spread + chi2) / std::max(options.expected_weight + std::max(result.degrees_of_freedom, 0), 1.0);
  result.relative_noise = std::sqrt(variance);
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> qr(J);
  const Eigen::MatrixXd inverse = qr.pseudoInverse();
  const Eigen::MatrixXd covariance = variance * inverse * inverse.transpose();
  constexpr double um_per_unit = unit_mm * 1e3;
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t i = used[static_cast<std::size_t>(k)];
    FocusPeak& peak = result.peaks[i];
    peak.peak_um = p(k) * um_per_unit;
    peak.gain = std::exp(p(n + k));
    for (Eigen::Index l = 0; l < n; ++l) {
      result.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(used[static_cast<std::size_t>(l)])) =
          covariance(k, l) * um_per_unit * um_per_unit;
    }
    peak.sigma_um = std::sqrt(covariance(k, k)) * um_per_unit;
    // Of the two columns of the set alone, with its gain free.
    const double by_gain = J.col(k).dot(J.col(n + k)) / J.col(n + k).squaredNorm();
    peak.own_sigma_um =
        std::min(peak.sigma_um, std::sqrt(variance) / (J.col(k) - by_gain * J.col(n + k)).norm() * um_per_unit);
    const auto [low, high] = std::minmax_element(sets[i].height_mm.begin(), sets[i].height_mm.end());
    if (!(p(2 * n) > 0.0) || peak.peak_um < *low * 1e3 || peak.peak_um > *high * 1e3) {
      peak.status = FitStatus::Rejected;
      peak.message = fmt::format("the contrast of {} has no maximum between its heights.", sets[i].name);
      result.covariance.row(static_cast<Eigen::Index>(i)).setZero();
      result.covariance.col(static_cast<Eigen::Index>(i)).setZero();
    }
  }
  for (int t = 0; t < shape_terms; ++t) result.shape(t) = p(2 * n + t) / std::pow(unit_mm, t + 2);
  result.status = FitStatus::Converged;
  result.message = fmt::format("{} contrast curves share one shape", used.size());
  return result;
}

}  // namespace spindrift
