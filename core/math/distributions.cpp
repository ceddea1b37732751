// SPDX-License-Identifier: Apache-2.0
#include "core/math/distributions.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "core/base/error.h"

namespace spindrift {
namespace {

namespace policies = boost::math::policies;

/// What is not defined is NaN, what is too large infinite: callers test for both. No wider type: it is slow and gains
/// nothing that a double keeps.
using Policy =
    policies::policy<policies::domain_error<policies::ignore_error>, policies::overflow_error<policies::ignore_error>,
                     policies::evaluation_error<policies::ignore_error>, policies::pole_error<policies::ignore_error>,
                     policies::promote_double<false>>;
using Normal = boost::math::normal_distribution<double, Policy>;
using ChiSquared = boost::math::chi_squared_distribution<double, Policy>;
using Student = boost::math::students_t_distribution<double, Policy>;
using Fisher = boost::math::fisher_f_distribution<double, Policy>;

}  // namespace

double normalDensity(double z) {
  return pdf(Normal(), z);
}

double normalCdf(double z) {
  return cdf(Normal(), z);
}

double normalQuantile(double p) {
  SPINDRIFT_ASSERT(p > 0.0 && p < 1.0, "probability outside (0, 1)");
  return quantile(Normal(), p);
}

double chiSquaredCdf(double x, double dof) {
  if (x <= 0.0) return 0.0;
  return std::isinf(x) ? 1.0 : cdf(ChiSquared(dof), x);
}

double chiSquaredTail(double x, double dof) {
  if (x <= 0.0) return 1.0;
  return std::isinf(x) ? 0.0 : cdf(complement(ChiSquared(dof), x));
}

double chiSquaredQuantile(double p, double dof) {
  SPINDRIFT_ASSERT(p > 0.0 && p < 1.0 && dof > 0.0, "probability outside (0, 1)");
  return quantile(ChiSquared(dof), p);
}

double studentCdf(double t, double dof) {
  return cdf(Student(dof), t);
}

double studentQuantile(double p, double dof) {
  SPINDRIFT_ASSERT(p > 0.0 && p < 1.0 && dof > 0.0, "probability outside (0, 1)");
  return quantile(Student(dof), p);
}

double fisherTail(double f, double dof1, double dof2) {
  if (f <= 0.0) return 1.0;
  return std::isinf(f) ? 0.0 : cdf(complement(Fisher(dof1, dof2), f));
}

}  // namespace spindrift
