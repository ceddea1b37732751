// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/inside_folder.h"
#include "core/imaging/fiducial_captures.h"
#include "core/imaging/image.h"
#include "core/imaging/pattern.h"
#include "tests/fuzz/readers.h"

namespace spindrift::testing {
namespace {

void image(std::string_view bytes) {
  (void)decodeImageBytes(bytes, "image");
}

void pattern(std::string_view bytes) {
  const FiducialPattern read = parsePattern(bytes, "pattern.json");
  (void)parsePattern(patternJson(read), "back.json");
}

void captures(std::string_view bytes) {
  (void)readFiducialCaptures(scratchFile("captures/fiducials.csv", bytes));
}

constexpr Reader readers[] = {{"image", image}, {"pattern", pattern}, {"fiducials", captures}};

}  // namespace

std::span<const Reader> imagingReaders() {
  return readers;
}

}  // namespace spindrift::testing
