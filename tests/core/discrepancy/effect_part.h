// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/discrepancy/effect_model.h"

namespace spindrift {

/// Sum of the effects of a model (without its base) for many rows at once, um or urad.
inline std::vector<double> effectPart(const EffectModel& model, std::span<const Observation> rows) {
  std::vector<double> sum(rows.size(), 0.0);
  for (const ModelEffect& e : model.effects()) {
    const std::vector<double> part = EffectModel::contribution(model.drivers(), e, rows);
    for (std::size_t r = 0; r < rows.size(); ++r) sum[r] += part[r];
  }
  return sum;
}

}  // namespace spindrift
