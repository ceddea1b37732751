// SPDX-License-Identifier: Apache-2.0
// The dynamics of accepted effects as they are predicted with. A name is judged by the simplest dynamics that the data
// ask for; but no machine is one or two lags, and of drivers that moved alike while it was measured the simplest choice
// may be the one that goes wrong afterwards. So, once the names are decided, every driver that an effect may have comes
// in at several lags, through the effect's own pattern in space, with gains that a prior keeps small:
//
//   r = sum of terms (gain of the main driver free) + C c + e,   c ~ N(0, s^2 / n) for a driver of n lags
//
// with the columns of C scaled to the rms of their effect, so that s is a part of its amplitude; the s of every driver
// maximise the marginal likelihood. What all readings of an effect do together in one span of time and in no other is
// taken for the scatter of its drivers and predicted nowhere. Of several drivers that may be the main one, and the data
// often cannot tell which, every one is tried, and the predictions are averaged with their evidence as weights.
// Internal to core/discrepancy.
// Sources: Akaike 1980, MacKay 1992 (evidence for the width of a prior); Pillonetto and De Nicolao 2010 (impulse
// responses with a Gaussian prior); Hoeting, Madigan, Raftery and Volinsky 1999 (averaging of models).
#pragma once

#include <vector>

#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/effect_search.h"

namespace spindrift {

struct DistributedFit {
  JointFit fit;                              ///< the terms with all their inputs, gains of the posterior mean
  std::vector<Eigen::VectorXd> prior_sigma;  ///< per term and gain; 0: free
  double log_evidence = 0.0;                 ///< logarithm of the marginal likelihood, up to what all fits share
};

/// Under the problem's present nuisances. A fit without lags comes back as it is, but a load that had not ended when
/// the last state was fitted ends there. `width` > 0: that is the s of all that comes in, and all that is in stays
/// free.
[[nodiscard]] DistributedFit distributedDynamics(const EffectSearch& search, const ResidualProblem& problem,
                                                 const DriverTable& drivers, const JointFit& fit, double width = 0.0);

/// One choice of main drivers and what it weighs.
struct WeightedDynamics {
  DistributedFit distributed;
  double weight = 1.0;
};

/// `fit` and the same effects with other main drivers of the catalogue, whose weights are worth mentioning; heaviest
/// first, weights add up to 1.
[[nodiscard]] std::vector<WeightedDynamics> alternativeDynamics(const EffectSearch& search,
                                                                const ResidualProblem& problem,
                                                                const DriverTable& drivers, const JointFit& fit);

/// The effects whose prediction is the weighted mean of those of `parts` (one list of effects each, the same effects in
/// the same order), with the scatter among them in their covariance.
[[nodiscard]] std::vector<ModelEffect> averagedEffects(const std::vector<std::vector<ModelEffect>>& parts,
                                                       const std::vector<double>& weights);

}  // namespace spindrift
