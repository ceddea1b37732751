// SPDX-License-Identifier: Apache-2.0
// What a campaign consists of, as far as it decides which work there is to do on it.
#pragma once

#include "core/machine/campaign.h"

namespace spindrift {

struct CampaignFacts {
  bool images = false;   ///< captures/fiducials.csv
  bool touches = false;  ///< captures/touches.csv
  bool scans = false;    ///< captures/scans.csv
  bool own_observations = false;
  bool simulation = false;  ///< one to compare with
  bool log = false;
  bool warm_up = false;  ///< a measurement for the warm-up alone (warm_up.csv)
  /// A log with a measured output over time, without captures or observations.
  bool log_only = false;

  [[nodiscard]] bool captures() const { return images || touches || scans; }
  [[nodiscard]] static CampaignFacts of(const Campaign& campaign);
};

}  // namespace spindrift
