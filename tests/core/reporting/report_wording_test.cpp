// SPDX-License-Identifier: GPL-3.0-or-later
// Units, effects, parameters and signals as a report prints them.
#include "core/reporting/report_wording.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/discrepancy/effect_titles.h"
#include "core/reporting/html_document.h"
#include "core/reporting/parameter_meanings.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(PrintedText, UnitsAreWholeWordsAndNamesOfColumnsStay) {
  EXPECT_EQ(printedUnits("3.2 um, 5 urad at 20 degC; 11 um/(m K)"), "3.2 µm, 5 µrad at 20 °C; 11 µm/(m K)");
  EXPECT_EQ(printedUnits("column growth_um, T_room_degC, aluminium, Aum"),
            "column growth_um, T_room_degC, aluminium, Aum");
  EXPECT_EQ(printedUnits("misses by -7.2 um (-33 times), z -7.94 to -0.39 mm"),
            "misses by −7.2 µm (−33 times), z −7.94 to −0.39 mm");
  EXPECT_EQ(printedUnits("2026-11-22, M0-1, --order, a - 3"), "2026-11-22, M0-1, --order, a - 3");
  EXPECT_EQ(printedUnitsOfDrawing(R"(<text id="um">EX / um</text><image href="um,degC"/>)"),
            R"(<text id="um">EX / µm</text><image href="um,degC"/>)");
}

TEST(PrintedText, EffectsHaveTheirTitleWithTheIdSmallBesideIt) {
  const std::string text = withEffectTitles("Missing in the simulation: ball_screw.expansion.x and head.tilt.a.");
  EXPECT_EQ(withoutSmallPrint(text),
            "Missing in the simulation: thermal expansion of the X ball screw ball_screw.expansion.x and tilt of the "
            "head about X head.tilt.a.");
  EXPECT_EQ(withEffectTitles(text), text) << "titles are put in once";
  EXPECT_EQ(withEffectTitles("see machine.json, 3.5 and e.g. this."), "see machine.json, 3.5 and e.g. this.");
  EXPECT_EQ(withoutSmallPrint(withEffectTitles("fixture.slip.P1.2")),
            "slip of point P1.2 in its fixture fixture.slip.P1.2");
  EXPECT_EQ(withoutSmallPrint(effectHeading("column.bending.a")), "Bending of the column towards Y column.bending.a");
  HtmlDocument document("t", "s");
  document.subsection(effectHeading("ball_screw.expansion.x")).paragraph("30 um at 21 degC");
  EXPECT_THAT(document.html(),
              HasSubstr("<h3>Thermal expansion of the X ball screw <small>ball_screw.expansion.x</small></h3>"));
  EXPECT_THAT(document.html(), HasSubstr("30 µm at 21 °C"));
  EXPECT_THAT(document.html(), Not(HasSubstr("\x1f")));
}

TEST(PrintedText, ParametersAndSignalsAreWordsWithAUnit) {
  EXPECT_EQ(parameterTitle("gain_um_per_m2_per_K"), "gain / um/(m² K)");
  EXPECT_EQ(parameterTitle("gain_um_per_m_per_m_per_min"), "gain / um/((m/min) m)");
  EXPECT_EQ(parameterTitle("gain_um_per_krpm"), "gain / um/(1000 rpm)");
  EXPECT_EQ(parameterTitle("gain_um"), "gain / um");
  EXPECT_EQ(parameterTitle("tau_on_s"), "time constant on / s");
  EXPECT_EQ(signalTitle("feed_x_mm_min").name, "feed X");
  EXPECT_EQ(signalTitle("feed_x_mm_min").unit, "mm/min");
  EXPECT_EQ(signalTitle("T_column_front_degC").name, "column front");
  EXPECT_EQ(signalTitle("spindle_rpm").name, "spindle speed");
  EXPECT_EQ(driversInWords("feed_x (lag 2400 s) + T_ambient_degC (lag 9000 s)"),
            "feed X (lag 40 min) + temperature of ambient (lag 2.5 h)");
  EXPECT_EQ(driversInWords("spindle_rpm^2*pos_z (lag 60 s)"), "spindle speed² × position Z (lag 60 s)");
  EXPECT_EQ(driversInWords("step at 1200 s"), "step at 20 min");
}

TEST(PrintedText, MomentsAndProbabilities) {
  EXPECT_EQ(utcInWords("2026-03-02T07:00:12Z"), "2026-03-02 07:00 UTC");
  EXPECT_EQ(utcInWords("yesterday"), "yesterday");
  EXPECT_EQ(probabilityInWords(1e-20), "< 10⁻¹²");
  EXPECT_EQ(probabilityInWords(3e-5), "3 × 10⁻⁵");
  EXPECT_EQ(probabilityInWords(9.7e-4), "1 × 10⁻³") << "not 10 × 10⁻⁴";
  EXPECT_EQ(probabilityInWords(0.04), "0.04");
  EXPECT_EQ(probabilityInWords(std::nan("")), "–");
}

TEST(ParameterMeanings, ExplainEveryNameOfTheContract) {
  for (const char* name :
       {"EXX_um_per_m", "EX0C_um",  "EY0C_um", "EZ0T_um", "ER0T_um",   "EA0C_urad",       "EB0C_urad", "EC0C_urad",
        "EME_um_per_m", "hX_urad",  "hZ_urad", "aY_urad", "dZ_um",     "gX_um_per_m",     "EXY_um",    "EYY_um",
        "EAY_urad",     "ECY_urad", "EX_um",   "EC_urad", "EC0Y_urad", "alpha_X_um_per_m"}) {
    EXPECT_NE(parameterMeaning(name), "") << name;
  }
  EXPECT_EQ(parameterMeaning("EAY_urad"), "rotation about X of the Y axis");
  EXPECT_EQ(parameterMeaning("EXY_um"), "displacement along X of the Y axis");
  EXPECT_EQ(parameterMeaning("EXX_um"), "displacement along X of the X axis");
  EXPECT_EQ(parameterMeaning("gX_um_per_m"), "expansion of the X screw from its fixed bearing");
  for (const char* name : {"EQX_um", "E_um", "rms_um", "EAX_um", "hello"})
    EXPECT_EQ(parameterMeaning(name), "") << name;
}

}  // namespace
}  // namespace spindrift
