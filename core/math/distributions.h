// SPDX-License-Identifier: Apache-2.0
// Distribution functions used by tests and intervals, of Boost.Math: what is not defined is NaN.
// Source: J. Maddock et al., Boost.Math, "Statistical Distributions and Functions".
#pragma once

namespace spindrift {

[[nodiscard]] double normalDensity(double z);
[[nodiscard]] double normalCdf(double z);
/// Inverse of normalCdf, p in (0, 1).
[[nodiscard]] double normalQuantile(double p);
/// P(X <= x) for chi-squared with `dof` degrees of freedom.
[[nodiscard]] double chiSquaredCdf(double x, double dof);
/// P(X > x): the p-value of a chi-squared test, accurate in the far tail.
[[nodiscard]] double chiSquaredTail(double x, double dof);
[[nodiscard]] double chiSquaredQuantile(double p, double dof);
[[nodiscard]] double studentCdf(double t, double dof);
[[nodiscard]] double studentQuantile(double p, double dof);
/// P(F > f): the p-value of an F test.
[[nodiscard]] double fisherTail(double f, double dof1, double dof2);

}  // namespace spindrift
