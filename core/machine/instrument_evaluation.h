// SPDX-License-Identifier: Apache-2.0
// What the evaluation of an instrument's captures gives, the same for images, touches and scans.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/machine/observation.h"

namespace spindrift {

/// A capture that could not be used, and why in one sentence.
struct RejectedCapture {
  std::string capture;  ///< path or row as the list names it
  std::string reason;
};

struct InstrumentEvaluation {
  std::string instrument;  ///< "microscope", "touch_probe", "profiler"
  ObservationSet observations;
  std::vector<RejectedCapture> rejected;
  std::vector<std::string> warnings;                  ///< sentences for the user about what was evaluated all the same
  nlohmann::json details = nlohmann::json::object();  ///< merged into the JSON of `evaluate` (keys of FORMATS.md)
  std::string summary;                                ///< a few lines for people
  bool good_enough = true;  ///< false: done, but the answer is "not good enough" (exit status 1); say why in warnings
};

}  // namespace spindrift
