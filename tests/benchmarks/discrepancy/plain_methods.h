// SPDX-License-Identifier: GPL-3.0-or-later
// Two plain methods to compare the search with: what a script would do over the same candidates.
//
// Both take the residual observation - simulation on the rows to be fitted, relative to the mean of each point and
// component, divided by sigma; the candidates are all effects of the catalogue with all their drivers on a grid of lags
// and onsets.
//   stepwise: add the candidate that lowers BIC = n ln(RSS) + k ln(n) most, until none lowers it
//   LASSO:    all columns at once (standardised), penalty by BIC along the path (Tibshirani 1996; Zou, Hastie,
//   Tibshirani
//             2007); an effect is named if it carries more than a tenth of the variance explained
#pragma once

#include "core/discrepancy/discrepancy.h"
#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"

namespace spindrift::study {

[[nodiscard]] Answer forwardStepwiseBic(const DiscrepancyInput& input);
[[nodiscard]] Answer lassoBic(const DiscrepancyInput& input);

}  // namespace spindrift::study
