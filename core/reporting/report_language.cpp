// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/report_language.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "core/discrepancy/effect_titles.h"
#include "core/reporting/report_wording.h"

namespace spindrift {
namespace {

std::optional<ReportLanguage>& offered() {
  static std::optional<ReportLanguage> one;
  return one;
}

/// The sentence that withEffectTitles() was given; nothing if the text was not made so.
std::optional<std::string> withEffectIds(const ReportText& text) {
  std::string sentence;
  bool any = false;
  for (const ReportText::Run& run : text.runs) {
    if (!run.small) {
      sentence += run.text;
      continue;
    }
    if (!effectTitleOf(run.text)) return {};
    const std::string title = effectTitle(run.text) + ' ';
    if (!sentence.ends_with(title)) return {};
    sentence.erase(sentence.size() - title.size());
    sentence += run.text;
    any = true;
  }
  return any ? std::optional(sentence) : std::nullopt;
}

/// A character of the private use area stands for a name while the text around it is translated.
std::string standIn(std::size_t index) {
  constexpr std::size_t first = 0xE000;
  const std::size_t code = first + index;
  return {static_cast<char>(0xE0U | code >> 12U), static_cast<char>(0x80U | (code >> 6U & 0x3FU)),
          static_cast<char>(0x80U | (code & 0x3FU))};
}

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// The language that leaves names as they are. One of a letter or two may be a part of any word.
ReportLanguage keeping(const ReportLanguage& language, std::vector<std::string> names) {
  constexpr std::size_t shortest = 3, most = 1000;
  std::erase_if(names, [&](const std::string& name) { return name.size() < shortest; });
  // A name within another is found in what is left.
  std::stable_sort(names.begin(), names.end(),
                   [](const std::string& a, const std::string& b) { return a.size() > b.size(); });
  if (names.size() > most) names.resize(most);
  return {language.code, [words = language.words, names = std::move(names)](const std::string& english) {
            std::string text = english;
            for (std::size_t i = 0; i < names.size(); ++i) replaceAll(text, names[i], standIn(i));
            text = words(text);
            for (std::size_t i = 0; i < names.size(); ++i) replaceAll(text, standIn(i), names[i]);
            return text;
          }};
}

struct Translation {
  const ReportLanguage& language;

  [[nodiscard]] std::string operator()(const std::string& english) const {
    return english.empty() ? english : language.words(english);
  }
  [[nodiscard]] ReportText operator()(const ReportText& english) const {
    if (const auto sentence = withEffectIds(english))
      return withEffectTitles((*this)(*sentence), [this](const std::string& title) { return (*this)(title); });
    ReportText out = english;
    for (ReportText::Run& run : out.runs) {
      if (!run.small) run.text = (*this)(run.text);
    }
    return out;
  }
  [[nodiscard]] ReportRow operator()(const ReportRow& english) const {
    ReportRow out;
    out.reserve(english.size());
    for (const ReportText& cell : english) out.push_back((*this)(cell));
    return out;
  }

  [[nodiscard]] ReportBlock operator()(const HeadingBlock& b) const { return HeadingBlock{b.level, (*this)(b.text)}; }
  [[nodiscard]] ReportBlock operator()(const TextBlock& b) const { return TextBlock{(*this)(b.text)}; }
  [[nodiscard]] ReportBlock operator()(const CalloutBlock& b) const { return CalloutBlock{b.kind, (*this)(b.text)}; }
  [[nodiscard]] ReportBlock operator()(const CodeBlock& b) const { return b; }
  [[nodiscard]] ReportBlock operator()(const FigureBlock& b) const {
    return FigureBlock{inLanguage(b.drawing, language), (*this)(b.caption)};
  }
  [[nodiscard]] ReportBlock operator()(const TableBlock& b) const {
    TableBlock out{(*this)(b.header), {}, (*this)(b.caption), b.of_words};
    out.rows.reserve(b.rows.size());
    for (const ReportRow& row : b.rows) out.rows.push_back((*this)(row));
    return out;
  }
};

}  // namespace

void offerReportLanguage(std::optional<ReportLanguage> language) {
  offered() = std::move(language);
}

const std::optional<ReportLanguage>& offeredReportLanguage() {
  return offered();
}

ReportText inLanguage(const ReportText& english, const ReportLanguage& language) {
  return Translation{language}(english);
}

Drawing inLanguage(const Drawing& english, const ReportLanguage& language) {
  return english.withTexts([&](const std::string& text) { return text.empty() ? text : language.words(text); });
}

Report inLanguage(const Report& english, const ReportLanguage& language, std::vector<std::string> names) {
  const ReportLanguage around = keeping(language, std::move(names));
  const Translation translation{around};
  return english.translated(around.code, around.words, [&](const ReportBlock& block) {
    return std::visit([&](const auto& b) -> ReportBlock { return translation(b); }, block);
  });
}

}  // namespace spindrift
