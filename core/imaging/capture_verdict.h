// SPDX-License-Identifier: Apache-2.0
// Is an image good enough to be evaluated? Said while the operator still stands at the machine.
//
// Rotations and positions along an axis need the numbers decoded and sharp edges; a focus series is blurred on purpose,
// so there only light and a pattern at all are asked for.
#pragma once

#include <string>

#include "core/imaging/decoder.h"
#include "core/imaging/focus.h"

namespace spindrift {

struct CaptureVerdictOptions {
  double largest_blur_px = 3.0;         ///< of rotations and positions
  double largest_saturated = 0.02;      ///< part of the pixels
  double least_contrast_levels = 20.0;  ///< bright minus dark level
};

struct CaptureVerdict {
  bool good = false;
  std::string sentence;  ///< what was found, or why to take it again
  DecodeResult decoded;
  FocusMeasure focus;
};

/// `focus_series`: the image belongs to one. Never throws for what is in the image.
[[nodiscard]] CaptureVerdict judgeCapture(const GrayImage& image, bool focus_series, const FiducialPattern& pattern,
                                          const CaptureVerdictOptions& options = {});

}  // namespace spindrift
