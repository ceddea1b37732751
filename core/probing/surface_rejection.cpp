// SPDX-License-Identifier: Apache-2.0
#include "core/probing/surface_rejection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/base/units.h"
#include "core/math/statistics.h"
#include "core/probing/surface_heights.h"

namespace spindrift {
namespace {

struct Judged {
  std::size_t touch;
  SurfaceVerdict verdict;
};

std::vector<Judged> judgedSurfaces(const TouchList& list, const std::string& artefact, const Eigen::Vector3d& centre_mm,
                                   const Eigen::Vector3d& axis, const std::set<std::size_t>& gone) {
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> sets;  // cycle, stylus
  for (std::size_t i = 0; i < list.touches.size(); ++i) {
    const Touch& t = list.touches[i];
    if (t.artefact == artefact && !gone.contains(i) && isSurfaceTouch(t, axis)) sets[{t.cycle, t.stylus}].push_back(i);
  }
  std::vector<Judged> judged;
  for (const auto& [key, members] : sets) {
    std::vector<PlacedHeight> heights;
    for (const std::size_t i : members) {
      const Touch& t = list.touches[i];
      heights.push_back({t.position_mm, t.c_deg, axis.dot(t.position_mm) * um_per_mm});
    }
    const std::vector<SurfaceVerdict> verdicts = judgeSurfaceHeights(heights, centre_mm, axis);
    for (std::size_t m = 0; m < members.size(); ++m) {
      if (verdicts[m].judged) judged.push_back({members[m], verdicts[m]});
    }
  }
  return judged;
}

}  // namespace

std::vector<RejectedTouch> contradictedSurfaces(const TouchList& list, const std::string& artefact,
                                                const Eigen::Vector3d& centre_mm, const Eigen::Vector3d& axis,
                                                const std::vector<RejectedTouch>& rejected) {
  std::set<std::size_t> gone;
  for (const RejectedTouch& r : rejected) gone.insert(r.touch);
  const std::vector<Judged> judged = judgedSurfaces(list, artefact, centre_mm, axis, gone);
  std::map<Touch::Key, std::vector<double>> usual;
  for (const Judged& j : judged) usual[list.touches[j.touch].key()].push_back(j.verdict.off_um);
  std::vector<RejectedTouch> out;
  for (const Judged& j : judged) {
    if (!j.verdict.suspect) continue;
    const Touch& t = list.touches[j.touch];
    std::vector<double> others = usual[t.key()];
    others.erase(std::find(others.begin(), others.end(), j.verdict.off_um));
    if (!others.empty() && std::abs(j.verdict.off_um - median(others)) < 0.5 * SurfaceOptions().floor_um) continue;
    out.push_back({j.touch,
                   fmt::format("its height deviates by {:.0f} µm from the {} other surface touches of {}; excluded",
                               j.verdict.off_um, j.verdict.others, t.cycle),
                   j.verdict.off_um});
  }
  return out;
}

}  // namespace spindrift
