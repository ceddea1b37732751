// SPDX-License-Identifier: GPL-3.0-or-later
// How an answer is judged when the truth is known.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/simulation/study_campaigns.h"
#include "core/simulation/virtual_campaign.h"

namespace spindrift::study {

/// Right (Named, or Rival if a hidden effect is only among the rivals of a listed one): every hidden effect is listed
/// or a rival of a listed one, in sets of at most three, and nothing else is listed. Wrong: an effect is listed that is
/// not hidden and has no hidden one among its rivals. Abstained: neither.
enum class Outcome { Named, Rival, Abstained, Wrong };

struct Verdict {
  Outcome outcome = Outcome::Abstained;
  int found = 0;  ///< hidden effects that are listed or rivals of a listed one, each by a listed effect of its own
};

struct Answer {
  std::string verdict;  ///< "named", "ambiguous", "unknown", "none"
  struct Listed {
    std::string id;
    std::vector<std::string> rivals;  ///< without containers
    double confidence = 0.0;
  };
  std::vector<Listed> effects;
};

/// Effects that are one and the same on the machine at hand (EFFECTS.md).
[[nodiscard]] bool sameEffect(const std::string& a, const std::string& b);

/// True if `simple` is a special case of `container` (EFFECTS.md): such a container in a set of rivals is allowed and
/// not counted.
[[nodiscard]] bool containsEffect(const std::string& container, const std::string& simple);

[[nodiscard]] Verdict judge(const Answer& answer, const std::vector<std::string>& hidden);

/// What the search is given: machine, log, observations and the simulation's rows, and nothing of the truth.
[[nodiscard]] DiscrepancyInput inputOf(const VirtualCampaign& campaign);

/// Sums of squares over the held-out rows in units of sigma, of values relative to their mean over the fitted rows of
/// the same point and component.
struct HeldOutSignal {
  double hidden = 0.0;
  double missed = 0.0;  ///< estimate - hidden
  /// NaN if nothing is hidden.
  [[nodiscard]] double explained() const { return 1.0 - missed / hidden; }
};
/// rms of the hidden signal over the held-out rows, about its mean over the fitted ones, in the component where it is
/// largest, in sigma.
[[nodiscard]] double heldOutStrength(const VirtualCampaign& campaign);
[[nodiscard]] HeldOutSignal heldOutSignal(const VirtualCampaign& campaign, const std::vector<double>& effect_part);
/// The part of the hidden signal that is explained on held-out rows.
[[nodiscard]] double explainedFraction(const VirtualCampaign& campaign, const std::vector<double>& effect_part);

/// What the best fit explains that knows which effects are hidden: the same catalogue, data, choice of drivers and
/// lags.
struct OracleFit {
  double explained = 0.0;    ///< as explainedFraction, from the observations as they are
  double noise_free = 0.0;   ///< the same, from observations without noise: what the form of the model can reach
  double noise_cost = 0.0;   ///< squared difference of the two fits over held-out rows, as a part of the hidden signal
  double stated_cost = 0.0;  ///< the variance that the model states for its prediction there, as the same part
  double strength = 0.0;     ///< rms of the hidden signal over the held-out rows that it moves, in sigma
};
[[nodiscard]] OracleFit fitKnowingNames(const VirtualCampaign& campaign, const std::vector<std::string>& hidden);

/// Gain in BIC of each hidden effect that `answer` lacks, beside the others, where all that are hidden are put in by
/// hand: below about 10 no search can name it from these data.
[[nodiscard]] std::vector<std::pair<std::string, double>> gainsOfMissed(const DiscrepancyInput& input,
                                                                        const std::vector<std::string>& hidden,
                                                                        const Answer& answer);

}  // namespace spindrift::study
