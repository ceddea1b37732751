// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/effect_titles.h"

#include <map>

#include "core/discrepancy/catalogue.h"

namespace spindrift {
namespace {

constexpr std::string_view slip = "fixture.slip.";

/// Effects of the catalogue by id; the slip of any point under its stem.
const std::map<std::string, const Effect*, std::less<>>& effectsById() {
  static const std::map<std::string, const Effect*, std::less<>> known = [] {
    std::map<std::string, const Effect*, std::less<>> out;
    for (const Effect& effect : everyEffect())
      out.emplace(effect.id.starts_with(slip) ? std::string(slip) : effect.id, &effect);
    return out;
  }();
  return known;
}

}  // namespace

std::optional<EffectTitle> effectTitleOf(std::string_view id) {
  const auto& known = effectsById();
  const bool slips = id.starts_with(slip) && id.size() > slip.size();
  const auto found = known.find(slips ? slip : id);
  if (found == known.end() || (id == slip)) return std::nullopt;
  const Effect& effect = *found->second;
  return EffectTitle{effect.title, slips ? std::string(id.substr(slip.size())) : effect.subject};
}

std::string titleText(std::string_view pattern, std::string_view subject) {
  std::string text(pattern);
  const std::size_t at = text.find("%1");
  if (at != std::string::npos) text.replace(at, 2, subject);
  return text;
}

std::string effectTitle(std::string_view id) {
  const auto title = effectTitleOf(id);
  return title ? titleText(title->pattern, title->subject) : std::string(id);
}

}  // namespace spindrift
