// SPDX-License-Identifier: Apache-2.0
// Clocks of camera, probe and logger differ. An offset per source says what to add to its times to be on the clock of
// the campaign (time = source's time + offset_s, s).
//
// An offset is entered by hand or estimated from an event both saw, such as a commanded motion: the shift that fits one
// record best to the other (normalised cross-correlation on
// a common grid, its peak found by halving steps). Uncertainty: width of the peak over what noise leaves of it, and the
// sampling of both records, between whose samples an event cannot be placed. Failure: InputError for a record without
// an event, or a peak that is not clear.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "core/machine/campaign.h"

namespace spindrift {

struct CampaignClockOffset {
  double offset_s = 0.0;
  double sigma_s = 0.0;
  std::string how;  ///< "entered", or what it was estimated from

  bool operator==(const CampaignClockOffset&) const = default;
};

/// By source: "log", or the instrument as it stands in the observations ("microscope", "probe", ...).
using ClockOffsets = std::map<std::string, CampaignClockOffset>;
[[nodiscard]] nlohmann::json toJson(const ClockOffsets& offsets);
/// Throws InputError.
[[nodiscard]] ClockOffsets clockOffsetsFrom(const nlohmann::json& json);

struct OffsetEstimate {
  double offset_s = 0.0;
  double sigma_s = 0.0;
  double correlation = 0.0;  ///< at the peak
};

/// What to add to the times of `source` so that it fits `reference`; |offset| <= longest_s. Both ascending in time.
[[nodiscard]] OffsetEstimate estimateClockOffset(std::span<const double> reference_time_s,
                                                 std::span<const double> reference,
                                                 std::span<const double> source_time_s, std::span<const double> source,
                                                 double longest_s);

/// Offset of an instrument against the log from the commanded motion both know: `pos_x_mm` (y, z) of the log and the
/// positions of its observations. Throws InputError: no positions in the log, an instrument without observations.
[[nodiscard]] CampaignClockOffset estimateFromMotion(const Campaign& campaign, const ObservationSet& observations,
                                                     const std::string& instrument, double longest_s);

/// Log and own observations moved to the clock of the campaign. Sources that are not there are ignored.
void applyClockOffsets(Campaign& campaign, const ClockOffsets& offsets);
void applyClockOffsets(ObservationSet& observations, const ClockOffsets& offsets);

}  // namespace spindrift
