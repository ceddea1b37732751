// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/campaign.h"
#include "core/scanning/cloud_file.h"
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

constexpr Reader readers[] = {{"pcd", pcd}, {"ply", ply}, {"cloud_csv", cloudCsv}, {"scans", scans}};

}  // namespace

std::span<const Reader> scanningReaders() {
  return readers;
}

}  // namespace spindrift::testing
