// SPDX-License-Identifier: Apache-2.0
// What the evaluation of an instrument's captures gives, the same for images, touches and scans.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/machine/observation.h"

namespace spindrift {

/// A capture that could not be used, and why in one sentence.
struct RejectedCapture {
  std::string capture;  ///< path or row as the list names it
  std::string reason;
};

/// What a warning of an evaluation is about.
enum class WarningKind {
  Finding,           ///< something that was found: to be looked at
  CalibrationLimit,  ///< what a calibration could not determine: no fault by itself, a finding says where it matters
};

/// A sentence for the user about what was evaluated all the same.
struct EvaluationWarning {
  EvaluationWarning(std::string words, WarningKind about = WarningKind::Finding)
      : sentence(std::move(words)), kind(about) {}
  EvaluationWarning(const char* words) : sentence(words) {}
  bool operator==(const EvaluationWarning&) const = default;

  std::string sentence;
  WarningKind kind = WarningKind::Finding;
};

struct InstrumentEvaluation {
  std::string instrument;  ///< "microscope", "touch_probe", "profiler"
  ObservationSet observations;
  std::vector<RejectedCapture> rejected;
  std::vector<EvaluationWarning> warnings;
  nlohmann::json details = nlohmann::json::object();  ///< merged into the JSON of `evaluate` (keys of FORMATS.md)
  std::string summary;                                ///< a few lines for people
  bool good_enough = true;  ///< false: done, but the answer is "not good enough" (exit status 1); say why in warnings
};

}  // namespace spindrift
