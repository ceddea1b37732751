// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/scan_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <new>

#include "core/base/error.h"
#include "core/scanning/scan_points.h"

namespace spindrift {

std::vector<ScanCheck> checkScans(const Campaign& campaign, const JobContext& job) {
  std::vector<ScanCheck> checks;
  for (const ScanCapture& capture : readScanList(campaign)) {
    if (campaign.excluded_captures.contains(capture.cloud)) continue;
    ScanCheck check;
    check.capture = capture;
    checks.push_back(std::move(check));
  }
  std::mutex mutex;
  std::size_t done = 0;
  parallelFor(checks.size(), job, [&](std::size_t i) {
    ScanCheck& check = checks[i];
    try {
      const ScanPoints scan = readScanPoints(campaign, check.capture.cloud);
      check.points = scan.cloud.size();
      check.profiles = scan.cloud.profileCount();
      check.edge_points = scan.count(PointFate::Edge);
      check.outlier_points = scan.count(PointFate::Outlier);
      check.painted_points = scan.count(PointFate::Painted);
      check.usable = true;
      if (check.profiles == 0) check.reason = "the points are not ordered: profiles cannot be distinguished";
    } catch (const InputError& error) {
      check.reason = error.what();
    } catch (const std::bad_alloc&) {
      check.reason = "there is not enough memory for the cloud";
    }
    const std::scoped_lock lock(mutex);
    job.report(static_cast<double>(++done) / static_cast<double>(checks.size()), "reading scans");
  });
  std::map<std::string, std::size_t> fullest;
  for (const ScanCheck& c : checks) fullest[c.capture.artefact] = std::max(fullest[c.capture.artefact], c.points);
  for (ScanCheck& c : checks) {
    const std::size_t most = fullest[c.capture.artefact];
    if (most > 0) c.completeness = static_cast<double>(c.points) / static_cast<double>(most);
    if (c.usable && c.reason.empty() && c.completeness < complete_scan) {
      c.reason = fmt::format("only {:.0f} % of the points of the fullest scan of {}: cut short or hidden",
                             100.0 * c.completeness, c.capture.artefact);
    }
  }
  return checks;
}

}  // namespace spindrift
