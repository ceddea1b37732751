// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/manual.h"

#include <array>
#include <optional>
#include <utility>

#include "core/base/text.h"
#include "core/discrepancy/catalogue.h"
#include "core/discrepancy/effect_listing.h"
#include "core/reporting/effect_drawing.h"
#include "core/reporting/markdown_report.h"
#include "core/reporting/parameter_meanings.h"

namespace spindrift {
namespace {

/// As in files, with what stands before them in the table.
constexpr std::array<std::string_view, 42> parameters{
    "EX_um",        "EY_um",    "EZ_um",    "EA_urad",     "EB_urad",          "EC_urad",          "EXX_um",
    "EYX_um",       "EZX_um",   "EAX_urad", "EBX_urad",    "ECX_urad",         "EYY_um",           "EZZ_um",
    "EAY_urad",     "EBY_urad", "ECY_urad", "EC0Y_urad",   "alpha_X_um_per_m", "alpha_Y_um_per_m", "EXX_um_per_m",
    "EX0C_um",      "EY0C_um",  "EZ0T_um",  "ER0T_um",     "EA0C_urad",        "EB0C_urad",        "EC0C_urad",
    "EME_um_per_m", "hX_urad",  "hY_urad",  "hZ_urad",     "aX_urad",          "aY_urad",          "aZ_urad",
    "dX_um",        "dY_um",    "dZ_um",    "gX_um_per_m", "gY_um_per_m",      "gZ_um_per_m",      "EXY_um"};

void addParameterMeanings(Report& report) {
  report.section("Error parameters");
  report.paragraph(
      "As they stand in files; on screen and in reports units are written µm, µrad and µm/m. Symbols of the form E, "
      "direction, axis are "
      "those of ISO 230-1:2012: the error in the direction X, Y or Z (or about it: A, B, C) of the axis named last. 0 "
      "marks an error of the position or orientation of an axis.");
  std::vector<ReportRow> rows;
  for (const std::string_view name : parameters)
    if (const std::string meaning = parameterMeaning(name); !meaning.empty())
      rows.push_back({std::string(name), meaning});
  report.table({"Parameter", "Meaning"}, std::move(rows));
}

void addEffects(Report& report) {
  report.section("Effects that the search knows");
  report.paragraph(
      "An effect is a driver (a column of the log, after its dynamics q(t)) times a gain times a shape. The figures "
      "show "
      "the shape for a gain of one in the middle planes of a working volume of 500 mm x 500 mm x 400 mm: grey as "
      "commanded, coloured as displaced, magnified so that the largest displacement is a tenth of the volume.");
  for (const Effect& effect : everyEffect()) {
    report.subsection(ReportText(titleOf(effect)) + ReportText::smallPrint("  " + effect.id));
    report.paragraph(effect.physics);
    std::vector<std::string> drivers;
    for (const std::vector<std::string>& inputs : driversOf(effect)) drivers.push_back(joinedList(inputs, "with"));
    ReportFacts facts = {
        {"Shape", effect.formula},
        {"Driven by", drivers.empty() ? std::string("nothing that is logged") : joinedList(drivers, "or")},
        {"Dynamics", dynamicsOf(effect)}};
    if (!effect.contains.empty()) facts.emplace_back("Nested models", joinedList(effect.contains));
    if (!effect.references.empty()) facts.emplace_back("References", joinedList(effect.references));
    report.facts(facts);
    if (std::optional<Drawing> drawing = effectDrawing(effect))
      report.figure(std::move(*drawing), "shape of " + effect.id);
  }
}

}  // namespace

Report manual(std::string_view commands) {
  Report report("Spindrift: the manual", "Version " SPINDRIFT_VERSION);
  report.withoutSignatures();
  for (const std::string& chapter : manualChapters()) addMarkdown(report, chapter);
  addParameterMeanings(report);
  addEffects(report);
  addMarkdown(report, commands);
  return report;
}

}  // namespace spindrift
