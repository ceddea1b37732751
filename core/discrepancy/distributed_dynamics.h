// SPDX-License-Identifier: Apache-2.0
// The dynamics of accepted effects as they are predicted with. A name is judged by the simplest dynamics that the data
// ask for; but no machine is one or two lags, and of drivers that moved alike while it was measured the simplest choice
// may be the one that goes wrong afterwards. So, once the names are decided, every driver that an effect may have comes
// in at several lags, through the effect's own pattern in space, with gains that a prior keeps small:
//
//   r = sum of terms (gain of the main driver free) + C c + e,   c ~ N(0, s^2 / n) for a driver of n lags
//
// with the columns of C scaled to the rms of their effect, so that s is a part of its amplitude; the s of every driver
// maximise the marginal likelihood. The posterior mean is the prediction. Internal to core/discrepancy.
// Sources: Akaike 1980, MacKay 1992 (evidence for the width of a prior); Pillonetto and De Nicolao 2010 (impulse
// responses with a Gaussian prior).
#pragma once

#include <vector>

#include "core/discrepancy/effect_search.h"

namespace spindrift {

struct DistributedFit {
  JointFit fit;                              ///< the terms with all their inputs, gains of the posterior mean
  std::vector<Eigen::VectorXd> prior_sigma;  ///< per term and gain; 0: free
};

/// Under the problem's present nuisances. A fit without lags comes back as it is. `width` > 0: that is
/// the s of all that comes in, and all that is in stays free.
[[nodiscard]] DistributedFit distributedDynamics(const EffectSearch& search, const ResidualProblem& problem,
                                                 const DriverTable& drivers, const JointFit& fit, double width = 0.0);

}  // namespace spindrift
