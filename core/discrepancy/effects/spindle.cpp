// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// Bearings and motor heat the spindle in proportion to speed^p (1 <= p <= 2: viscous and load-dependent friction). The
// shaft grows along its axis through one or two lags (bearing, housing) and drifts sideways when its support warms
// unevenly. Centrifugal forces shorten or lengthen the shaft with the square of the speed at once.
namespace effect_family {

void spindle(const CatalogueContext& context, std::vector<Effect>& out) {
  const std::vector<std::string> heat = context.drivers->spindleHeat();
  Effect growth;
  growth.id = "spindle.growth.z";
  growth.title = "growth of the spindle along Z";
  growth.formula = "ez = g q";
  growth.references = {references::iso_230_3, references::abele, references::harris};
  growth.physics =
      "The spindle shaft and housing grow along Z as the bearings heat them; the heat follows the speed and reaches "
      "the structure with one or two first-order time constants.";
  growth.shape = {constantShape(Component::EZ)};
  addLagVariants(growth, heat);
  growth.follows_room = true;
  growth.two_lags = true;
  growth.driver_missing = heat.empty();
  out.push_back(growth);

  Effect centrifugal;
  centrifugal.id = "spindle.centrifugal.z";
  centrifugal.title = "shortening of the spindle by its speed along Z";
  centrifugal.formula = "ez = g n^2, n the spindle speed";
  centrifugal.references = {references::abele, references::harris};
  centrifugal.physics =
      "Centrifugal forces change the bearing contact and the diameter of the shaft, so the nose moves along Z with the "
      "square of the speed and without delay.";
  centrifugal.shape = {constantShape(Component::EZ)};
  if (context.drivers->has("spindle_rpm^2")) {
    centrifugal.variants.push_back({{{"spindle_rpm^2", Dynamics::None}}, false});
  }
  centrifugal.driver_missing = centrifugal.variants.empty();
  out.push_back(centrifugal);

  for (int axis = 0; axis < 2; ++axis) {
    Effect drift;
    drift.id = std::string("spindle.drift.") + axis_letters[axis];
    drift.title = "drift of the spindle along %1";
    drift.subject = axis_names[axis];
    drift.formula = fmt::format("e{} = g q", axis_letters[axis]);
    drift.references = {references::iso_230_3, references::abele};
    drift.physics =
        "The spindle support warms unevenly and shifts the nose sideways, the same everywhere in the working space, "
        "following the spindle heat with one or two first-order time constants.";
    drift.shape = {constantShape(static_cast<Component>(axis))};
    addLagVariants(drift, heat);
    drift.follows_room = true;
    drift.two_lags = true;
    drift.driver_missing = heat.empty();
    out.push_back(drift);
  }
}

}  // namespace effect_family
}  // namespace spindrift
