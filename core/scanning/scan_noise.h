// SPDX-License-Identifier: Apache-2.0
// Noise of the observations that scans give, as what scans share and what each has for itself.
//
// Model of the deviation (u, w) of a scan: own noise, minus the noise h of the reference scan that all scans of its
// artefact were registered to, plus the calibration of the profiler, which all scans share. The registration of a scan
// states C = cov(own) + cov(h); alike scans have cov(h) = C / 2. So cov(h) of an artefact is half of its smallest C,
// made smaller where a scan states less than that in any direction: the largest c <= 1 with c C_min / 2 <= C for all
// scans. The row of the reference scan, 0 by definition, has h once more beside its own, so that its difference to any
// other scan has the covariance that was stated for that scan.
//
// Where a scan has a change of shape (free_form.h) beside its motion, the part F of C that it makes is no noise of a
// scan: C - F takes the place of C above. Two scans of an artefact have of F what their changes have in common, by the
// correlation of their shapes: what cannot be told from a motion is as alike as what can.
#pragma once

#include <cstddef>
#include <vector>

#include "core/machine/shared_noise.h"
#include "core/scanning/scan_evaluation.h"

namespace spindrift {

/// A component (0 ... 5: EX ... EC) of a scan that is observed: its variance in the registration is finite.
struct ScanRow {
  std::size_t scan = 0;
  int component = 0;
};

struct ScanNoise {
  std::vector<double> sigma;  ///< of the rows, um or urad
  SharedNoise shared;         ///< loads in um or urad
};

/// Noise of the observations `rows` of scans. A row without any (the reference of an artefact that nothing was compared
/// with) has 1e-4 um or 0.01 urad.
[[nodiscard]] ScanNoise noiseOfScans(const std::vector<ScanResult>& scans, const std::vector<ScanRow>& rows);

}  // namespace spindrift
