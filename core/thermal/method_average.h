// SPDX-License-Identifier: Apache-2.0
// The average of candidates as one model with its uncertainty, and the verdicts on inputs that go with it (private to
// thermal; core/thermal/method_choice.h says what it is for).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/thermal/method_evidence.h"

namespace spindrift::choice {

struct Averaged {
  ThermalModel model;
  std::vector<InputVerdict> verdicts;
  std::map<Method, double> shares;
};

/// The average of plain candidates. Units: those of the dictionary.
[[nodiscard]] Averaged averaged(const response::Dictionary& d, const Evidence& evidence,
                                const std::vector<Candidate>& candidates, const std::vector<std::string>& names,
                                const std::string& output, const MethodChoiceOptions& options);

/// Verdicts on all inputs of a projected response, those kept first.
[[nodiscard]] std::vector<InputVerdict> explained(const ProjectionResult& few, const ProjectedModel& model,
                                                  const std::vector<std::string>& usable);

}  // namespace spindrift::choice
