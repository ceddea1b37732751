// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/campaign_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/natural_order.h"
#include "core/base/unit_text.h"
#include "core/math/statistics.h"
#include "core/probing/evaluate_touches.h"
#include "core/workflows/compensated_data.h"

namespace spindrift {
namespace {

void addCycles(const Campaign& campaign, const std::filesystem::path& touches, CampaignSeries& out, JobContext& job) {
  const TouchEvaluation evaluation =
      evaluateTouchList(campaign, TouchList::read(touches), HoleCycleOptions{}, BallCycleOptions{}, job);
  std::vector<const CycleEvaluation*> all;
  for (const HoleCycleResult& r : evaluation.hole_cycles) all.push_back(&r);
  for (const BallCycleResult& r : evaluation.ball_cycles) all.push_back(&r);
  for (const CycleEvaluation* cycles : all) {
    if (cycles->status != FitStatus::Converged) {
      out.series.notes.push_back(fmt::format("{}: {}", cycles->artefact, cycles->message));
      continue;
    }
    TimeSeries sparse;
    sparse.file = touches;
    sparse.time_s = cycles->cycle_time_s;
    for (std::size_t p = 0; p < cycles->names.size(); ++p) {
      Signal signal{cycles->names[p], SignalKind::Displacement, {}};
      std::vector<double> sigma;
      for (const auto& cycle : cycles->parameters) {
        signal.values.push_back(cycle[p].determined ? cycle[p].value : std::nan(""));
        // The first cycle is zero by definition.
        if (cycle[p].determined && cycle[p].standard_uncertainty > 0.0) sigma.push_back(cycle[p].standard_uncertainty);
      }
      if (sigma.empty()) continue;
      out.sigma[signal.name] = median(sigma);
      sparse.signals.push_back(std::move(signal));
    }
    out.series = merged(out.series, sparse, std::max(60.0, out.series.medianPeriod_s()));
  }
}

void addObservations(const ObservationSet& set, CampaignSeries& out, std::size_t least_times) {
  std::map<std::string, std::vector<const Observation*>, NaturalOrder> columns;
  for (const Observation& o : set.rows) {
    if (o.use == ObservationUse::Exclude) continue;
    columns[fmt::format("{}_{}_{}", o.point, toString(o.component), isRotation(o.component) ? "urad" : "um")].push_back(
        &o);
  }
  for (auto& [name, rows] : columns) {
    std::stable_sort(rows.begin(), rows.end(), [](auto* a, auto* b) { return a->time_s < b->time_s; });
    TimeSeries sparse;
    sparse.file = set.file;
    Signal signal{name, SignalKind::Displacement, {}};
    std::vector<double> sigma;
    for (const Observation* o : rows) {
      if (!sparse.time_s.empty() && o->time_s <= sparse.time_s.back()) continue;  // two values at one time: the first
      sparse.time_s.push_back(o->time_s);
      signal.values.push_back(o->value);
      sigma.push_back(o->sigma);
    }
    if (sparse.time_s.size() < least_times || out.series.find(name) != nullptr) continue;
    out.sigma[name] = median(sigma);
    sparse.signals.push_back(std::move(signal));
    out.series = merged(out.series, sparse, std::max(60.0, out.series.medianPeriod_s()));
  }
}

}  // namespace

CampaignSeries campaignSeries(const Campaign& campaign, const ObservationSet* observations, JobContext& job,
                              std::size_t least_times) {
  if (!campaign.log)
    throw InputError({campaign.path("log.csv"), ""},
                     "is missing, so there are no temperatures to predict from; allowed: a campaign with a log.");
  CampaignSeries out;
  out.series = readTimeSeries(campaign.path("log.csv"));
  // On the clock of the campaign (core/workflows/clock_offsets.h).
  const std::vector<double>& clock = campaign.log->time_s();
  if (!clock.empty() && clock.size() == out.series.time_s.size()) out.series.time_s = clock;
  if (const auto touches = campaign.captureList("touches.csv")) {
    addCycles(campaign, *touches, out, job);
  } else if (observations == nullptr && campaign.observations) {
    observations = &*campaign.observations;
  }
  if (observations != nullptr && !campaign.captureList("touches.csv")) addObservations(*observations, out, least_times);
  if (outputSignals(out.series).empty())
    throw InputError({campaign.folder, ""},
                     fmt::format("holds nothing measured over time: no displacement in the log, no cycles, no point "
                                 "with {} or more observations; allowed: measure the same points again and again.",
                                 least_times));
  leaveOutCompensated(out.series);
  return out;
}

CampaignSeries campaignSeries(const std::filesystem::path& folder, JobContext& job) {
  return campaignSeries(Campaign::read(folder), nullptr, job);
}

std::vector<std::string> outputSignals(const TimeSeries& series) {
  std::vector<std::string> names;
  for (const Signal& s : series.signals) {
    if (!unitOfSignal(s.name).empty()) names.push_back(s.name);
  }
  return names;
}

bool isSparse(const Signal& output) {
  const auto measured =
      std::count_if(output.values.begin(), output.values.end(), [](double v) { return std::isfinite(v); });
  return measured * 5 < std::ssize(output.values);
}

}  // namespace spindrift
