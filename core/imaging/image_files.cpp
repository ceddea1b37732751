// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/image_files.h"

#include "core/base/module.h"

namespace spindrift {

const ImageFiles& imageFiles() {
  static const auto* const files =
      static_cast<const ImageFiles*>(moduleSymbol("spindrift-image-files.so", "spindrift_image_files"));
  return *files;
}

}  // namespace spindrift
