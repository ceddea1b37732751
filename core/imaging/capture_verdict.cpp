// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/capture_verdict.h"

#include <fmt/format.h>

#include "core/base/count_text.h"

namespace spindrift {

CaptureVerdict judgeCapture(const GrayImage& image, bool focus_series, const FiducialPattern& pattern,
                            const CaptureVerdictOptions& options) {
  CaptureVerdict verdict;
  verdict.focus = measureFocus(image);
  verdict.decoded = decodeImage(image, pattern);
  const ExposureStatistics& light = verdict.decoded.exposure;
  if (light.saturated_fraction > options.largest_saturated) {
    verdict.sentence = fmt::format("{:.0f} % of the pixels are overexposed: reduce the illumination.",
                                   100.0 * light.saturated_fraction);
    return verdict;
  }
  if (light.bright_level - light.dark_level < options.least_contrast_levels) {
    verdict.sentence = fmt::format(
        "The image has too little contrast ({:.0f} grey levels). Increase the illumination or check for an obstructed "
        "lens.",
        light.bright_level - light.dark_level);
    return verdict;
  }
  const auto count = verdict.decoded.subpatterns.size();
  if (focus_series) {
    verdict.good = verdict.focus.normalised > 0.0;
    verdict.sentence =
        !verdict.good ? "No structure is in view."
        : count > 0 ? fmt::format("Sharpness {:.3g}, {} decoded.", verdict.focus.normalised, countOf(count, "ellipse"))
                    : fmt::format("Sharpness {:.3g}.", verdict.focus.normalised);
    return verdict;
  }
  if (!verdict.decoded.usable()) {
    verdict.sentence = verdict.decoded.message;
    return verdict;
  }
  if (light.blur_sigma_px > options.largest_blur_px) {
    verdict.sentence = fmt::format("Out of focus: edges are blurred by {:.1f} px, allowed are {:.1f} px.",
                                   light.blur_sigma_px, options.largest_blur_px);
    return verdict;
  }
  verdict.good = true;
  verdict.sentence = fmt::format("{} decoded, blur {:.1f} px, centres within {:.3f} px rms of the pattern.",
                                 countOf(count, "ellipse"), light.blur_sigma_px, verdict.decoded.map_rms_px);
  return verdict;
}

}  // namespace spindrift
