// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/catalogue.h"

#include <algorithm>

namespace spindrift {

std::string_view toString(Dynamics dynamics) noexcept {
  switch (dynamics) {
    case Dynamics::None:
      return "none";
    case Dynamics::Lag:
      return "lag";
    case Dynamics::AsymmetricLag:
      return "asymmetric_lag";
    case Dynamics::Step:
      return "step";
    case Dynamics::Pulse:
      return "pulse";
    case Dynamics::Start:
      return "start";
  }
  return "none";
}

ShapeColumn constantShape(Component component, double sign) {
  return {"um", [component, sign](const DeviationQuery&, Component c) { return c == component ? sign : 0.0; }};
}

void addLagVariants(Effect& effect, const std::vector<std::string>& drivers) {
  for (const std::string& driver : drivers) effect.variants.push_back({{{driver, Dynamics::Lag}}, false});
}

std::vector<Effect> effectCatalogue(const CatalogueContext& context) {
  std::vector<Effect> out;
  addSpindleEffects(context, out);
  addHeadEffects(context, out);
  addColumnEffects(context, out);
  addBallScrewEffects(context, out);
  addScaleEffects(context, out);
  addTableEffects(context, out);
  addFrameEffects(context, out);
  addCrossbeamEffects(context, out);
  addAmbientEffects(context, out);
  addInstrumentEffects(context, out);
  addFixtureEffects(context, out);
  addPeriodicEffects(context, out);
  addBacklashEffects(context, out);
  addCoolantEffects(context, out);
  addExternalHeatEffects(context, out);
  addHeatSourceEffects(context, out);
  addRotaryEffects(context, out);
  addArtefactEffects(context, out);
  // What an effect holds, all that this holds is held as well.
  for (std::size_t pass = 0; pass < 3; ++pass) {
    for (Effect& effect : out) {
      std::vector<std::string> more;
      for (const std::string& id : effect.contains) {
        for (const Effect& inner : out) {
          if (inner.id == id) more.insert(more.end(), inner.contains.begin(), inner.contains.end());
        }
      }
      for (const std::string& id : more) {
        if (std::find(effect.contains.begin(), effect.contains.end(), id) == effect.contains.end()) {
          effect.contains.push_back(id);
        }
      }
    }
  }
  return out;
}

}  // namespace spindrift
