// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/free_form.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace spindrift {
namespace {

using Powers = std::array<double, FreeForm::most_order + 1>;

/// P_0 ... P_order at v.
void legendre(double v, int order, Powers& out) {
  out[0] = 1.0;
  if (order > 0) out[1] = v;
  for (int k = 2; k <= order; ++k) {
    const auto n = static_cast<std::size_t>(k);
    out[n] = ((2.0 * k - 1.0) * v * out[n - 1] - (k - 1.0) * out[n - 2]) / k;
  }
}

/// P_i(s) P_j(t) by i + j, then by j.
void products(double s, double t, int order, double* terms) {
  Powers along_x{}, along_y{};
  legendre(s, order, along_x);
  legendre(t, order, along_y);
  for (int both = 0; both <= order; ++both)
    for (int j = 0; j <= both; ++j)
      *terms++ = along_x[static_cast<std::size_t>(both - j)] * along_y[static_cast<std::size_t>(j)];
}

}  // namespace

Eigen::VectorXd FreeForm::terms(double s, double t) const {
  Eigen::VectorXd out(termCount(order));
  products(s, t, order, out.data());
  return out;
}

void FreeForm::evaluateTerms(const Place& place, double* terms) const noexcept {
  const Eigen::Vector2d half = 0.5 * (high_mm - low_mm);
  // A little beyond the rectangle a polynomial is what it is at its border.
  const double s = std::clamp((place.x_mm - low_mm.x()) / half.x() - 1.0, -1.0, 1.0);
  const double t = std::clamp((place.y_mm - low_mm.y()) / half.y() - 1.0, -1.0, 1.0);
  Powers along_x{}, along_y{}, slope_x{}, slope_y{};
  legendre(s, order, along_x);
  legendre(t, order, along_y);
  const double aside_x = (place.z_mm - middle_mm) * place.zx / half.x();
  const double aside_y = (place.z_mm - middle_mm) * place.zy / half.y();
  for (std::size_t k = 1; k <= static_cast<std::size_t>(order); ++k) {
    slope_x[k] = static_cast<double>(k) * along_x[k - 1] + s * slope_x[k - 1];
    slope_y[k] = static_cast<double>(k) * along_y[k - 1] + t * slope_y[k - 1];
  }
  for (int both = 0; both <= order; ++both)
    for (int k = 0; k <= both; ++k) {
      const auto i = static_cast<std::size_t>(both - k);
      const auto j = static_cast<std::size_t>(k);
      *terms++ = along_x[i] * along_y[j] + aside_x * slope_x[i] * along_y[j] + aside_y * along_x[i] * slope_y[j];
    }
}

double FreeForm::height_mm(const Place& place) const noexcept {
  std::array<double, (most_order + 1) * (most_order + 2) / 2> terms{};
  evaluateTerms(place, terms.data());
  return coefficients_mm.dot(Eigen::Map<const Eigen::VectorXd>(terms.data(), coefficients_mm.size()));
}

FreeForm::Value FreeForm::shape(double x_mm, double y_mm) const {
  const Eigen::Vector2d half = 0.5 * (high_mm - low_mm);
  Eigen::VectorXd here = terms((x_mm - low_mm.x()) / half.x() - 1.0, (y_mm - low_mm.y()) / half.y() - 1.0);
  here.head<plane_terms>().setZero();
  return {here.dot(coefficients_mm), std::sqrt(std::max(0.0, here.dot(covariance_mm2 * here)))};
}

Eigen::VectorXd FreeForm::shapeVector_mm() const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(coefficients_mm.size());
  Eigen::Index k = 0;
  for (int both = 0; both <= order; ++both)
    for (int j = 0; j <= both; ++j, ++k)
      if (k >= plane_terms)
        out[k] = coefficients_mm[k] / std::sqrt((2.0 * (both - j) + 1.0) * (2.0 * j + 1.0));  // rms of P_i P_j
  return out;
}

}  // namespace spindrift
