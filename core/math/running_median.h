// SPDX-License-Identifier: Apache-2.0
// The median of values that come one after the other, without going through them again.
#pragma once

#include <functional>
#include <queue>
#include <vector>

namespace spindrift {

class RunningMedian {
 public:
  void add(double value) {
    if (below_.empty() || value <= below_.top()) {
      below_.push(value);
    } else {
      above_.push(value);
    }
    if (below_.size() > above_.size() + 1) {
      above_.push(below_.top());
      below_.pop();
    } else if (above_.size() > below_.size()) {
      below_.push(above_.top());
      above_.pop();
    }
  }
  [[nodiscard]] bool empty() const { return below_.empty(); }
  /// The middle value, or the mean of the two in the middle. Only where there is one.
  [[nodiscard]] double value() const {
    return below_.size() > above_.size() ? below_.top() : 0.5 * (below_.top() + above_.top());
  }

 private:
  std::priority_queue<double> below_;  ///< the lower half, and the middle one
  std::priority_queue<double, std::vector<double>, std::greater<>> above_;
};

}  // namespace spindrift
