// SPDX-License-Identifier: Apache-2.0
// Every image of a campaign judged: can it be evaluated (capture_verdict.h), and does it show what the list commands
// (capture_agreement.h)? The same that an arriving image is asked. Excluded images are judged on their own and take no
// part in the comparison.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/machine/campaign.h"

namespace spindrift {

struct CheckedCapture {
  std::string image;  ///< as the list names it
  bool good = false;
  std::string sentence;  ///< what was found, or why it is to be taken again
  int ellipses = 0;
  double blur_px = 0.0;

  [[nodiscard]] nlohmann::json json() const;
};

/// In order of the list. An image that cannot be read is an answer. Throws InputError if there is no list, or if it
/// cannot be read.
[[nodiscard]] std::vector<CheckedCapture> checkFiducialCaptures(const Campaign& campaign, JobContext& job);

}  // namespace spindrift
