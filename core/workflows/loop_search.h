// SPDX-License-Identifier: Apache-2.0
// The discrepancy step of a closed loop: what was measured is held against the simulation, what is named is accepted
// or rejected (by rule, or by the operator, who may take his time), and what was accepted is fitted. All of it beside
// the loop, on threads of its own: the compensation has to be kept alive meanwhile.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_model.h"
#include "core/workflows/closed_loop.h"

namespace spindrift {

class LoopSearch {
 public:
  struct Decision {
    std::vector<std::string> accepted;
    std::vector<std::string> rejected;
    std::shared_ptr<const EffectModel> model;  ///< of the accepted ones; null: they could not be fitted
  };

  LoopSearch(const LoopPlan& plan, const LoopOperator& who) : plan_(plan), who_(who) {}
  /// Asks what runs to stop, and waits for it.
  ~LoopSearch() { stop_.request_stop(); }
  LoopSearch(const LoopSearch&) = delete;
  LoopSearch& operator=(const LoopSearch&) = delete;

  void begin(DiscrepancyInput input);
  [[nodiscard]] bool searching() const { return search_.valid(); }
  [[nodiscard]] bool running() const { return search_.valid() || decision_.valid(); }
  /// The operator has been asked and has not answered.
  [[nodiscard]] bool asking() const;
  /// What was found, once; the decision begins with it. Throws InputError.
  [[nodiscard]] std::optional<DiscrepancyResult> named();
  /// What became of it, once.
  [[nodiscard]] std::optional<Decision> decided();

 private:
  [[nodiscard]] Decision decide(const DiscrepancyResult& found) const;

  const LoopPlan& plan_;
  const LoopOperator& who_;
  std::stop_source stop_;
  DiscrepancyInput input_;
  std::future<DiscrepancyResult> search_;
  std::future<Decision> decision_;
};

}  // namespace spindrift
