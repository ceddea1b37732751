// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/cloud_alignment.h"

#include "core/base/module.h"

namespace spindrift {

const CloudAligner& cloudAligner() {
  static const auto* const aligner =
      static_cast<const CloudAligner*>(moduleSymbol("spindrift-cloud-alignment.so", "spindrift_cloud_aligner"));
  return *aligner;
}

}  // namespace spindrift
