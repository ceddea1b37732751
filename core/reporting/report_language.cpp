// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/report_language.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <unordered_set>
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

bool isPartOfWord(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || (static_cast<unsigned char>(c) & 0x80U) != 0;
}

/// Where it is a word, or words, of its own.
void replaceName(std::string& text, const std::string& name, const std::string& by) {
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at)) {
    const std::size_t end = at + name.size();
    const bool alone = (at == 0 || !isPartOfWord(text[at - 1]) || !isPartOfWord(name.front())) &&
                       (end == text.size() || !isPartOfWord(text[end]) || !isPartOfWord(name.back()));
    if (alone) text.replace(at, name.size(), by);
    at += alone ? by.size() : 1;
  }
}

/// The language that leaves names as they are, or as the program shows them.
ReportLanguage keeping(const ReportLanguage& language, const ReportNames& names) {
  std::vector<std::string> within = names.within;
  std::erase(within, std::string());
  // A name within another is found in what is left.
  std::stable_sort(within.begin(), within.end(),
                   [](const std::string& a, const std::string& b) { return a.size() > b.size(); });
  std::vector<std::string> shown = within;
  if (language.of_names) std::transform(within.begin(), within.end(), shown.begin(), language.of_names);
  std::unordered_set<std::string> whole(names.whole.begin(), names.whole.end());
  whole.erase(std::string());
  return {language.code,
          [words = language.words, within = std::move(within), shown = std::move(shown),
           whole = std::move(whole)](const std::string& english) {
            if (whole.contains(english)) return english;
            static const std::string colon = ": ";
            std::size_t kept = english.size();
            for (std::size_t at = english.find(colon); at != std::string::npos && kept == english.size();
                 at = english.find(colon, at + 1)) {
              if (whole.contains(english.substr(at + colon.size()))) kept = at + colon.size();
            }
            std::string text = english.substr(0, kept);
            for (std::size_t i = 0; i < within.size(); ++i) replaceName(text, within[i], standIn(i));
            text = words(text);
            for (std::size_t i = 0; i < within.size(); ++i) {
              const std::string mark = standIn(i);
              for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at))
                text.replace(at, mark.size(), shown[i]), at += shown[i].size();
            }
            return text + english.substr(kept);
          },
          language.of_files, language.of_names};
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

Report inLanguage(const Report& english, const ReportLanguage& language, const ReportNames& names) {
  const ReportLanguage around = keeping(language, names);
  const Translation translation{around};
  return english.translated(around.code, around.words, [&](const ReportBlock& block) {
    return std::visit([&](const auto& b) -> ReportBlock { return translation(b); }, block);
  });
}

Report inOfferedLanguage(Report english, const ReportNames& names) {
  const std::optional<ReportLanguage>& language = offeredReportLanguage();
  return language ? inLanguage(english, *language, names) : std::move(english);
}

}  // namespace spindrift
