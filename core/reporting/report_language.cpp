// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/report_language.h"

#include <string_view>
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

Report inLanguage(const Report& english, const ReportLanguage& language) {
  const Translation translation{language};
  return english.translated(language.code, translation, [&](const ReportBlock& block) {
    return std::visit([&](const auto& b) -> ReportBlock { return translation(b); }, block);
  });
}

}  // namespace spindrift
