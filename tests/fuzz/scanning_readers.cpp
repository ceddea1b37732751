// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/machine/campaign.h"
#include "core/scanning/cloud_file.h"
#include "core/scanning/painted_mask.h"
#include "core/scanning/scan_evaluation.h"
#include "tests/fuzz/readers.h"

namespace spindrift::testing {
namespace {

void pcd(std::string_view bytes) {
  (void)readCloud(scratchFile("cloud.pcd", bytes));
}
void ply(std::string_view bytes) {
  (void)readCloud(scratchFile("cloud.ply", bytes));
}
void cloudCsv(std::string_view bytes) {
  (void)readCloud(scratchFile("cloud.csv", bytes));
}
void scans(std::string_view bytes) {
  Campaign campaign;
  campaign.folder = scratchFile("scans/captures/scans.csv", bytes).parent_path().parent_path();
  (void)readScanList(campaign);
}

/// Strokes that a person painted, one scan a line; what is written is read back.
void masks(std::string_view bytes) {
  std::set<std::string> items;
  for (std::size_t from = 0; from < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', from), bytes.size());
    items.emplace(bytes.substr(from, end - from));
    from = end + 1;
  }
  PointCloud cloud;
  for (int i = 0; i < 50; ++i) cloud.points_mm.emplace_back(0.2 * (i % 10), 0.7 * (i / 10), 0.0);
  for (const auto& [name, strokes] : masksOf(items)) {
    (void)paintedMask(cloud, strokes);
    SPINDRIFT_ASSERT(maskStrokesFromText(toText(strokes)).size() == strokes.size(), "every stroke is written");
  }
}

constexpr Reader readers[] = {{"pcd", pcd}, {"ply", ply}, {"cloud_csv", cloudCsv}, {"scans", scans}, {"masks", masks}};

}  // namespace

std::span<const Reader> scanningReaders() {
  return readers;
}

}  // namespace spindrift::testing
