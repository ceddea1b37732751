// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/capture_check.h"

#include <fmt/format.h>

#include <atomic>
#include <new>

#include "core/base/error.h"
#include "core/imaging/capture_agreement.h"
#include "core/imaging/capture_verdict.h"
#include "core/imaging/evaluate_fiducials.h"
#include "core/imaging/fiducial_captures.h"
#include "core/imaging/image.h"

namespace spindrift {
namespace {

CheckedCapture judged(const Campaign& campaign, const FiducialCapture& c, const FiducialPattern& pattern,
                      SeenCapture& seen) {
  CheckedCapture checked;
  checked.image = c.image;
  try {
    const CaptureVerdict verdict =
        judgeCapture(readImage(campaign.path(c.image)), c.role == CaptureRole::Focus, pattern);
    checked.good = verdict.good;
    checked.sentence = verdict.sentence;
    checked.ellipses = static_cast<int>(verdict.decoded.subpatterns.size());
    checked.blur_px = verdict.decoded.exposure.blur_sigma_px;
    if (verdict.good) {
      seen.pose = poseOf(verdict.decoded, pattern);
      seen.sharpness = verdict.focus.normalised;
    }
  } catch (const InputError& e) {
    checked.sentence = e.what();
  } catch (const std::bad_alloc&) {
    checked.sentence = "There is not enough memory to read it.";
  }
  return checked;
}

}  // namespace

nlohmann::json CheckedCapture::json() const {
  return {{"image", image}, {"good", good}, {"sentence", sentence}, {"ellipses", ellipses}, {"blur_px", blur_px}};
}

std::vector<CheckedCapture> checkFiducialCaptures(const Campaign& campaign, JobContext& job) {
  const auto file = campaign.captureList("fiducials.csv");
  if (!file)
    throw InputError({campaign.path("captures/fiducials.csv"), ""}, "is not there; allowed: a list of images.");
  const std::vector<FiducialCapture> list = readFiducialCaptures(*file).captures;
  std::vector<CheckedCapture> checked(list.size());
  std::vector<SeenCapture> seen(list.size());
  const std::shared_ptr<const FiducialPattern> pattern = campaignPattern(campaign.folder);
  std::atomic<std::size_t> done{0};
  parallelFor(list.size(), job, [&](std::size_t i) {
    const FiducialCapture& c = list[i];
    seen[i] = {c.fiducial, c.state, c.role, c.index, c.position_mm, c.spindle_deg, std::nullopt, 0.0};
    checked[i] = judged(campaign, c, *pattern, seen[i]);
    if (campaign.excluded_captures.contains(c.image)) {
      seen[i].pose.reset();
      seen[i].sharpness = 0.0;
    }
    const std::size_t finished = done.fetch_add(1) + 1;
    job.report(static_cast<double>(finished) / static_cast<double>(list.size()),
               fmt::format("{} / {}", finished, list.size()));
  });
  AgreementOptions options;
  options.commanded = "the list says";
  const std::vector<std::string> contradictions = contradictionsOf(seen, options);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (contradictions[i].empty()) continue;
    checked[i].good = false;
    checked[i].sentence = "Take again: " + contradictions[i];
  }
  return checked;
}

}  // namespace spindrift
