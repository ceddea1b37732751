// SPDX-License-Identifier: Apache-2.0
#include "core/math/distributions.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "core/base/error.h"

namespace spindrift {
namespace {

constexpr double tiny = 1e-300;
constexpr double epsilon = 1e-15;

/// Regularised lower incomplete gamma by its series; good for x < a + 1.
double lowerGammaSeries(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (int n = 1; n < 100000; ++n) {
    term *= x / (a + n);
    sum += term;
    if (std::abs(term) < std::abs(sum) * epsilon) break;
  }
  return sum * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

/// Regularised upper incomplete gamma by its continued fraction; good for x >= a + 1.
double upperGammaFraction(double a, double x) {
  double b = x + 1.0 - a;
  double c = 1.0 / tiny;
  double d = 1.0 / b;
  double h = d;
  for (int i = 1; i < 100000; ++i) {
    const double an = -i * (i - a);
    b += 2.0;
    d = an * d + b;
    if (std::abs(d) < tiny) d = tiny;
    c = b + an / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1.0 / d;
    const double delta = d * c;
    h *= delta;
    if (std::abs(delta - 1.0) < epsilon) break;
  }
  return h * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

double betaFraction(double a, double b, double x) {
  double c = 1.0;
  double d = 1.0 - (a + b) * x / (a + 1.0);
  if (std::abs(d) < tiny) d = tiny;
  d = 1.0 / d;
  double h = d;
  for (int m = 1; m < 100000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1.0 + even * d;
    if (std::abs(d) < tiny) d = tiny;
    c = 1.0 + even / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1.0 / d;
    h *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1.0 + odd * d;
    if (std::abs(d) < tiny) d = tiny;
    c = 1.0 + odd / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1.0 / d;
    const double delta = d * c;
    h *= delta;
    if (std::abs(delta - 1.0) < epsilon) break;
  }
  return h;
}

/// Regularised incomplete beta I_x(a, b).
double incompleteBeta(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1.0) / (a + b + 2.0)) return front * betaFraction(a, b, x) / a;
  return 1.0 - front * betaFraction(b, a, 1.0 - x) / b;
}

/// Root of a rising function by bisection between bounds that are widened until they hold it.
double invert(const std::function<double(double)>& cdf, double p, double low, double high) {
  while (cdf(high) < p) high *= 2.0;
  for (int i = 0; i < 200 && high - low > 1e-15 * (std::abs(low) + std::abs(high)); ++i) {
    const double middle = 0.5 * (low + high);
    (cdf(middle) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double normalCdf(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

double normalQuantile(double p) {
  SPINDRIFT_ASSERT(p > 0.0 && p < 1.0, "probability outside (0, 1)");
  if (p == 0.5) return 0.0;
  double low = -40.0;
  double high = 40.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (normalCdf(middle) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double chiSquaredCdf(double x, double dof) {
  if (x <= 0.0) return 0.0;
  const double a = 0.5 * dof;
  const double y = 0.5 * x;
  return y < a + 1.0 ? lowerGammaSeries(a, y) : 1.0 - upperGammaFraction(a, y);
}

double chiSquaredTail(double x, double dof) {
  if (x <= 0.0) return 1.0;
  const double a = 0.5 * dof;
  const double y = 0.5 * x;
  return y < a + 1.0 ? 1.0 - lowerGammaSeries(a, y) : upperGammaFraction(a, y);
}

double chiSquaredQuantile(double p, double dof) {
  SPINDRIFT_ASSERT(p > 0.0 && p < 1.0 && dof > 0.0, "probability outside (0, 1)");
  return invert([dof](double x) { return chiSquaredCdf(x, dof); }, p, 0.0, dof + 10.0);
}

double studentCdf(double t, double dof) {
  const double tail = 0.5 * incompleteBeta(0.5 * dof, 0.5, dof / (dof + t * t));
  return t > 0.0 ? 1.0 - tail : tail;
}

double studentQuantile(double p, double dof) {
  SPINDRIFT_ASSERT(p > 0.0 && p < 1.0 && dof > 0.0, "probability outside (0, 1)");
  if (p == 0.5) return 0.0;
  if (p < 0.5) return -studentQuantile(1.0 - p, dof);
  return invert([dof](double t) { return studentCdf(t, dof); }, p, 0.0, 10.0);
}

double fisherTail(double f, double dof1, double dof2) {
  if (f <= 0.0) return 1.0;
  return incompleteBeta(0.5 * dof2, 0.5 * dof1, dof2 / (dof2 + dof1 * f));
}

}  // namespace spindrift
