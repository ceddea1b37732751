// SPDX-License-Identifier: Apache-2.0
// The fast log of a campaign with its sparse measurements merged in: what a model over time is identified from.
//
// Outputs are displacement columns of the log itself, the parameters of probing cycles (named as in the JSON of
// `evaluate`, "EXX_um_per_m"), and the deviations of every point measured at least `least_times` times ("F1_EZ_um").
// Between measurements they are missing. Values taken while the control was compensating are left out, with a note.
// Units as the names say, time s. Failure: InputError without a log, or with nothing measured over time.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/thermal/time_series.h"

namespace spindrift {

struct CampaignSeries {
  TimeSeries series;
  std::map<std::string, double> sigma;  ///< median standard uncertainty of one value of a sparse output
};

/// `observations` may be null: then the campaign's own, if it has any. Cycles of several artefacts are joined if only
/// one has the parameter; a parameter of two artefacts is an InputError.
[[nodiscard]] CampaignSeries campaignSeries(const Campaign& campaign, const ObservationSet* observations,
                                            JobContext& job, std::size_t least_times = 8);
[[nodiscard]] CampaignSeries campaignSeries(const std::filesystem::path& folder, JobContext& job);

/// Names of the measured outputs of a series.
[[nodiscard]] std::vector<std::string> outputSignals(const TimeSeries& series);

/// True if the output is measured at so few rows that only the method "response" can use it.
[[nodiscard]] bool isSparse(const Signal& output);

}  // namespace spindrift
