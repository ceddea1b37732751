// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/effect_listing.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.h"
#include "core/discrepancy/effect_titles.h"
#include "core/machine/driver_words.h"

namespace spindrift {

std::string titleOf(const Effect& effect) {
  return titleText(effect.title, effect.subject);
}

std::vector<std::vector<std::string>> driversOf(const Effect& effect) {
  std::vector<std::vector<std::string>> out;
  for (const EffectVariant& variant : effect.variants) {
    std::vector<std::string> inputs;
    for (const EffectInput& input : variant.inputs) {
      if (!input.driver.empty()) inputs.emplace_back(driverAsWritten(input.driver));
    }
    if (!inputs.empty() && std::find(out.begin(), out.end(), inputs) == out.end()) out.push_back(std::move(inputs));
  }
  return out;
}

std::string dynamicsOf(const Effect& effect) {
  Dynamics widest = Dynamics::None;
  for (const EffectVariant& variant : effect.variants) {
    for (const EffectInput& input : variant.inputs) widest = std::max(widest, input.dynamics);
  }
  return std::string(toString(widest));
}

nlohmann::json effectsJson(const std::vector<Effect>& effects, const OwnEffects* own) {
  nlohmann::json list = nlohmann::json::array();
  for (const Effect& effect : effects) {
    nlohmann::json drivers = nlohmann::json::array();
    for (const std::vector<std::string>& inputs : driversOf(effect)) {
      drivers.push_back(inputs.size() == 1 ? nlohmann::json(inputs.front()) : nlohmann::json(inputs));
    }
    const OwnEffect* written = own != nullptr && effect.own ? own->find(effect.id) : nullptr;
    nlohmann::json shape = nlohmann::json::array();
    for (std::size_t k = 0; k < effect.shape.size(); ++k) {
      nlohmann::json column{{"gain_unit", effect.shape[k].gain_unit}};
      if (written != nullptr) {
        for (const OwnExpression& e : written->shape[k]) column[std::string(toString(e.component))] = e.value.text();
      }
      shape.push_back(std::move(column));
    }
    nlohmann::json entry{{"id", effect.id},
                         {"title", titleOf(effect)},
                         {"physics", effect.physics},
                         {"drivers", drivers},
                         {"dynamics", dynamicsOf(effect)},
                         {"shape", shape},
                         {"formula", effect.formula},
                         {"sign", effect.sign},
                         {"contains", effect.contains},
                         {"references", effect.references},
                         {"built_in", !effect.own}};
    if (effect.tau_s) entry["tau_s"] = {(*effect.tau_s)[0], (*effect.tau_s)[1]};
    list.push_back(std::move(entry));
  }
  return {{"effects", list}, {"count", effects.size()}};
}

std::string effectsText(const std::vector<Effect>& effects) {
  std::string text;
  for (const Effect& effect : effects) {
    text += fmt::format("{}  {}{}\n  {}\n", effect.id, titleOf(effect), effect.own ? " (own)" : "", effect.physics);
    const std::string drivers = driversInWords(driversOf(effect));
    std::string units;
    for (const ShapeColumn& column : effect.shape) units += (units.empty() ? "" : ", ") + gainUnit(column.gain_unit);
    text += fmt::format("  shape: {}  (gains: {})\n", formulaInSymbols(effect.formula), units);
    text += fmt::format("  driven by: {}; dynamics: {}\n", drivers.empty() ? "nothing logged" : drivers,
                        dynamicsInWords(dynamicsOf(effect)));
    if (!effect.contains.empty()) text += fmt::format("  nested: {}\n", joinedList(effect.contains));
    for (const std::string& reference : effect.references) text += fmt::format("  see {}\n", reference);
  }
  return text;
}

}  // namespace spindrift
