// SPDX-License-Identifier: Apache-2.0
#include "core/machine/error_model.h"

#include <cmath>

namespace spindrift {

PredictedComponent ErrorModel::predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                             Component component) const {
  const PredictedComponent there = predict(query, component);
  const PredictedComponent here = predict(reference, component);
  return {there.value - here.value, query == reference ? 0.0 : std::hypot(there.sigma, here.sigma)};
}

}  // namespace spindrift
