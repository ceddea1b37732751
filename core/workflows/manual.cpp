// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/discrepancy/catalogue.h"
#include "core/discrepancy/effect_listing.h"
#include "core/machine/driver_words.h"
#include "core/machine/parameter_meanings.h"
#include "core/reporting/effect_drawing.h"
#include "core/reporting/markdown_report.h"
#include "core/workflows/file_reference.h"

namespace spindrift {
namespace {

void addParameterMeanings(Report& report) {
  report.section("Error parameters");
  report.paragraph(
      "As they stand in files; on screen and in reports units are written µm, µrad and µm/m. Symbols of the form E, "
      "direction, axis are "
      "those of ISO 230-1:2012: the error in the direction X, Y or Z (or about it: A, B, C) of the axis named last. 0 "
      "marks an error of the position or orientation of an axis.");
  std::vector<ReportRow> rows;
  for (const ErrorParameter& p : errorParameters()) rows.push_back({p.name, p.symbol, p.iso_symbol, p.meaning});
  report.table({"Parameter", "Symbol", "ISO 230-1", "Meaning"}, std::move(rows));
}

/// What is put together from words and symbols is translated word by word, before it is put together.
void addEffects(Report& report, const TextTranslation& translation = {}) {
  const auto inWords = [&](const std::string& english) { return translation ? translation(english) : english; };
  report.section("Effects that the search knows");
  report.paragraph(
      "An effect is a driver (a column of the log, after its dynamics q(t)) times a gain times a shape. The figures "
      "show "
      "the shape for a gain of one in the middle planes of a working volume of 500 mm x 500 mm x 400 mm: grey as "
      "commanded, coloured as displaced, magnified so that the largest displacement is a tenth of the volume.");
  EffectVolume one_point;
  one_point.points.push_back({"<point>", "", {250.0, 250.0, 200.0}});
  for (const Effect& effect : everyEffect()) {
    report.subsection(ReportText(titleOf(effect)) + ReportText::smallPrint("  " + effect.id));
    report.paragraph(effect.physics);
    const std::string drivers = driversInWords(driversOf(effect), translation);
    ReportFacts facts = {{"Shape", formulaInSymbols(inWords(effect.formula))},
                         {"Driven by", drivers.empty() ? std::string("nothing that is logged") : drivers},
                         {"Dynamics", std::string(dynamicsInWords(dynamicsOf(effect)))}};
    if (!effect.contains.empty()) facts.emplace_back("Nested models", joinedList(effect.contains));
    if (!effect.references.empty())
      facts.emplace_back("References", ReportText::smallPrint(fmt::format("{}", fmt::join(effect.references, "; "))));
    report.facts(facts);
    std::optional<EffectShape> shape = effectShape(effect, {});
    if (!shape) shape = effectShape(effect, one_point);  // one that moves nothing else
    if (!shape) continue;
    EffectDrawingOptions options;
    options.legend = inWords(effectLegend(*shape));
    report.figure(effectDrawing(*shape, options), "shape of " + effect.id);
  }
}

}  // namespace

Report manual(std::string_view commands) {
  Report report("Spindrift: the manual", "Version " SPINDRIFT_VERSION);
  report.withoutSignatures();
  for (const std::string& chapter : manualChapters()) addMarkdown(report, chapter);
  addMarkdown(report, filesMarkdown());
  addParameterMeanings(report);
  addEffects(report);
  addMarkdown(report, commands);
  return report;
}

Report manualIn(const ReportLanguage& language) {
  const std::vector<std::string>& chapters = manualChapters(language.code);
  SPINDRIFT_ASSERT(!chapters.empty(), "somebody wrote the chapters in this language");
  Report generated("Spindrift: the manual", "Version " SPINDRIFT_VERSION);
  addParameterMeanings(generated);
  addEffects(generated, [&](std::string_view english) { return language.words(std::string(english)); });
  generated.callout(CalloutKind::Note, "The reference of the commands is in the English manual.");
  Report report = inLanguage(Report(generated.title(), generated.subtitle()), language);
  report.withoutSignatures();
  for (const std::string& chapter : chapters) addMarkdown(report, chapter);
  addMarkdown(report, filesMarkdown({}, language.of_files));
  report.append(inLanguage(generated, language));
  return report;
}

}  // namespace spindrift
