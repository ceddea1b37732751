// SPDX-License-Identifier: Apache-2.0
#include "core/probing/closed_forms.h"

#include "core/base/units.h"
#include "core/probing/star_stylus.h"

namespace spindrift {

std::vector<HeadComparison> closedFormsBeside(const BallCycleResult& balls, const MachineDescription& machine) {
  std::vector<HeadComparison> out;
  if (machine.styli.size() < 3 || balls.cycles.empty()) return out;
  const auto centreOf = [&](const std::string& cycle, const std::string& ball,
                            const std::string& stylus) -> const Eigen::Vector3d* {
    for (const ProbedFeature& f : balls.features) {
      if (f.cycle == cycle && f.feature == ball && f.stylus == stylus && f.status == FitStatus::Converged) {
        return &f.centre_mm;
      }
    }
    return nullptr;
  };
  StylusCentres before;
  for (std::size_t i = 0; i < 3; ++i) before[i] = machine.styli[i].offset_mm;
  const auto reference = static_cast<std::size_t>(balls.problem.reference_cycle);
  for (std::size_t k = 0; k < balls.cycles.size(); ++k) {
    if (k == reference) continue;
    for (const ArtefactBall& ball : machine.findArtefact(balls.artefact)->balls) {
      StylusCentres after = before;
      bool all = true;
      for (std::size_t i = 0; i < 3 && all; ++i) {
        const Eigen::Vector3d* cold = centreOf(balls.cycles[reference], ball.id, machine.styli[i].id);
        const Eigen::Vector3d* warm = centreOf(balls.cycles[k], ball.id, machine.styli[i].id);
        all = cold != nullptr && warm != nullptr;
        // The tip has moved by minus what the machine reads of the ball.
        if (all) after[i] -= *warm - *cold;
      }
      if (!all) continue;
      const HeadRotation head = closedFormRotation(before, after);
      HeadComparison c;
      c.cycle = balls.cycles[k];
      c.ball = ball.id;
      c.message = head.message;
      if (head.status == FitStatus::Converged) c.closed_form_urad = head.rotation_rad * urad_per_rad;
      Eigen::Vector3d drift;
      for (int p = 0; p < 3; ++p) {
        const auto h = static_cast<std::size_t>(p);
        c.joint_urad(p) = balls.parameters[k][h].value;
        c.joint_sigma_urad(p) = balls.parameters[k][h].standard_uncertainty;
        drift(p) = balls.parameters[k][h + 6].value;
      }
      c.spindle_drift_um = spindleDrift(before[0], after[0]) * um_per_mm;
      c.joint_drift_um = drift.norm();
      out.push_back(std::move(c));
    }
  }
  return out;
}

}  // namespace spindrift
