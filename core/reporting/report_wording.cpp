// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/report_wording.h"

#include <fmt/format.h>

#include <cctype>
#include <utility>

#include "core/base/unit_text.h"
#include "core/discrepancy/effect_titles.h"

namespace spindrift {
namespace {

bool inWord(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || (static_cast<unsigned char>(c) & 0x80U) != 0;
}

std::string capital(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace

std::string printedUnitOf(Component component) {
  return printedUnit(unitOf(component));
}

ReportText withEffectTitles(std::string_view text, const std::function<std::string(const std::string&)>& words) {
  const auto inId = [](char c) { return inWord(c) || c == '.' || c == '-'; };
  ReportText out;
  std::string plain;
  for (std::size_t i = 0; i < text.size();) {
    if (!inId(text[i])) {
      plain += text[i++];
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && inId(text[end])) ++end;
    std::size_t id_end = end;
    while (id_end > i && (text[id_end - 1] == '.' || text[id_end - 1] == '-')) --id_end;  // of the sentence
    const std::string_view id = text.substr(i, id_end - i);
    if (id.find('.') != std::string_view::npos && effectTitleOf(id)) {
      const std::string title = effectTitle(id);
      out = out + ReportText(plain + (words ? words(title) : title) + ' ') + ReportText::smallPrint(id);
      plain.clear();
    } else {
      plain += id;
    }
    plain += text.substr(id_end, end - id_end);
    i = end;
  }
  return out + ReportText(plain);
}

ReportText effectHeading(std::string_view id, std::string_view own_title) {
  const bool own = !own_title.empty() && own_title != id;
  if (!own && !effectTitleOf(id)) return id;
  return capital(own ? std::string(own_title) : effectTitle(id)) + ' ' + ReportText::smallPrint(id);
}

std::string titleWithUnit(const std::string& name) {
  for (const auto& [ending, unit] : {std::pair{"_um_per_m", "µm/m"}, {"_urad", "µrad"}, {"_um", "µm"}, {"_mm", "mm"}}) {
    if (name.ends_with(ending)) return fmt::format("{} / {}", name.substr(0, name.rfind(ending)), unit);
  }
  return name;
}

std::string utcInWords(std::string_view utc) {
  if (utc.size() != 20 || utc[10] != 'T' || utc[19] != 'Z') return std::string(utc);
  return fmt::format("{} {} UTC", utc.substr(0, 10), utc.substr(11, 5));
}

}  // namespace spindrift
