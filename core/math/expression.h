// SPDX-License-Identifier: Apache-2.0
// A formula that a user wrote: "z*sin(y*_pi/180)". Syntax and functions of muParser (sin, cos, sqrt, abs, sign, min,
// max, a ? b : c, ^, _pi, _e, ...), numbers with a point whatever the locale is. A formula has one value and assigns
// nothing.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace spindrift {

/// Compiled once; copies share what was compiled. Safe to use from threads.
class Expression {
 public:
  /// Throws InputError with a sentence without a place: what is wrong in the text, where, and what is allowed.
  Expression(const std::string& text, const std::vector<std::string>& variables);

  [[nodiscard]] const std::string& text() const noexcept;
  /// `values` of the variables in their order. May be infinite or NaN, as 1/x at x = 0.
  [[nodiscard]] double operator()(std::span<const double> values) const;
  /// True if the value depends on this variable.
  [[nodiscard]] bool uses(const std::string& variable) const;

 private:
  struct Compiled;
  std::shared_ptr<Compiled> compiled_;
};

}  // namespace spindrift
