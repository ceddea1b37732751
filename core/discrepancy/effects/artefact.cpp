// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// The artefact itself warms and grows from its reference feature; it turns with the table.
namespace effect_family {

void artefact(const CatalogueContext& context, std::vector<Effect>& out) {
  if (context.machine->artefacts.empty()) return;
  const Artefact artefact = context.machine->artefacts.front();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const RotaryAxis& axis : context.machine->rotary) {
    if (!axis.name.empty() && axis.name[0] == 'C') centre = axis.centre_mm;
  }
  const DriverTable& drivers = *context.drivers;
  Effect effect;
  effect.id = "artefact.expansion";
  effect.title = "expansion of the artefact";
  effect.formula = "e = -g q (growth from the reference feature, turned by c)";
  effect.references = {references::iso_230_3, references::ibaraki_knapp};
  effect.physics = "The artefact warms with the table or the room and grows away from its reference feature.";
  effect.shape = {{"um_per_m", [artefact, centre](const DeviationQuery& q, Component c) {
                     if (isRotation(c)) return 0.0;
                     const double angle = q.c_deg * 3.14159265358979323846 / 180.0;
                     const auto turned = [angle](const Eigen::Vector3d& v) {
                       return Eigen::Vector3d(std::cos(angle) * v.x() - std::sin(angle) * v.y(),
                                              std::sin(angle) * v.x() + std::cos(angle) * v.y(), v.z());
                     };
                     Eigen::Vector3d growth = Eigen::Vector3d::Zero();
                     if (artefact.kind == "hole_bar") {
                       const Eigen::Vector3d reference = centre + turned(artefact.reference_in_table_mm);
                       const Eigen::Vector3d along = turned(artefact.direction_at_c0);
                       growth = along * along.dot(q.position_mm - reference);
                     } else {
                       for (const ArtefactBall& ball : artefact.balls) {
                         if (ball.id == q.point) growth = turned(ball.certified_mm);
                       }
                     }
                     return -growth[axisIndex(c)] * 1e-3;
                   }}};
  addLagVariants(effect, drivers.temperatures({SensorRole::Artefact, SensorRole::Table}));
  effect.sign = 1;
  effect.driver_missing = effect.variants.empty();
  out.push_back(std::move(effect));
}

}  // namespace effect_family
}  // namespace spindrift
