// SPDX-License-Identifier: GPL-3.0-or-later
// Units, effects, parameters and signals as a report prints them.
#include "core/reporting/report_wording.h"
#include "core/discrepancy/catalogue.h"
#include "core/machine/driver_words.h"
#include "core/machine/parameter_meanings.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/discrepancy/effect_titles.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

TEST(PrintedText, EffectsHaveTheirTitleWithTheIdSmallBesideIt) {
  const ReportText text = withEffectTitles("Missing in the simulation: ball_screw.expansion.x and head.tilt.a.");
  EXPECT_EQ(text.plain(),
            "Missing in the simulation: thermal expansion of the X ball screw ball_screw.expansion.x and tilt of the "
            "head about X head.tilt.a.");
  EXPECT_TRUE(text.runs[1].small && !text.runs[2].small);
  EXPECT_EQ(withEffectTitles("see machine.json, 3.5 and e.g. this.").plain(), "see machine.json, 3.5 and e.g. this.");
  EXPECT_EQ(withEffectTitles("fixture.slip.P1.2").plain(), "slip of point P1.2 in its fixture fixture.slip.P1.2");
  EXPECT_EQ(effectHeading("column.bending.a").plain(), "Bending of the column towards Y column.bending.a");
  Report report("t", "s");
  report.subsection(effectHeading("ball_screw.expansion.x"));
  EXPECT_THAT(htmlOf(report),
              HasSubstr("<h3>Thermal expansion of the X ball screw <small>ball_screw.expansion.x</small></h3>"));
}

TEST(PrintedText, ParametersAndSignalsAreWordsWithAUnit) {
  EXPECT_EQ(parameterTitle("gain_um_per_m2_per_K"), "gain / (µm/(m² K))");
  EXPECT_EQ(parameterTitle("gain_um_per_m_per_m_per_min"), "gain / (µm/((m/min) m))");
  EXPECT_EQ(parameterTitle("gain_um_per_krpm"), "gain / (µm/(1000 rpm))");
  EXPECT_EQ(parameterTitle("gain_um"), "gain / µm");
  EXPECT_EQ(parameterTitle("gain_um_per_krpm1.5"), "gain / (µm/(1000 rpm)¹·⁵)");
  EXPECT_EQ(parameterTitle("tau_on_s"), "time constant on / s");
  EXPECT_EQ(gainUnit("um_per_m2"), "µm/m²");
  EXPECT_EQ(gainUnit("um_per_m_lift"), "µm/m");
  EXPECT_EQ(gainUnit("um/mm"), "µm/mm");
  EXPECT_EQ(signalTitle("feed_x_mm_min").name, "feed X");
  EXPECT_EQ(signalTitle("feed_x_mm_min").unit, "mm/min");
  EXPECT_EQ(signalTitle("T_column_front_degC").name, "column front");
  EXPECT_EQ(signalTitle("spindle_rpm").name, "spindle speed");
  EXPECT_EQ(driversInWords("feed_x (lag 2400 s) + T_ambient_degC (lag 9000 s)"),
            "feed X (lag 40 min) + temperature of ambient (lag 2.5 h)");
  EXPECT_EQ(driversInWords("spindle_rpm^2*pos_z (lag 60 s)"), "spindle speed² × position Z (lag 60 s)");
  EXPECT_EQ(driversInWords("spindle_rpm^1.5"), "spindle speed¹·⁵");
  EXPECT_EQ(driversInWords("spindle_rpm^1"), "spindle speed");
  EXPECT_EQ(driversInWords("column_side_difference (time constant 60 s on, 7200 s off)"),
            "temperature difference left minus right of the column (time constant 60 s on, 2.0 h off)");
  EXPECT_EQ(driversInWords("coolant*T_room_degC"), "coolant × temperature of room");
  EXPECT_EQ(driversInWords("feed_override"), "feed override") << "a column of the user's is no axis";
  EXPECT_EQ(driversInWords("step at 1200 s"), "step at 20 min");
  EXPECT_EQ(driversInWords("20 % too low in the simulation: 3000 s there, measured 3600 ± 200 s"),
            "20 % too low in the simulation: 50 min there, measured 3600 ± 200 s")
      << "value and uncertainty keep one unit";
  EXPECT_EQ(driversInWords({{"feed_x", "feed_y"}, {"T_table_degC"}}), "feed X + feed Y or temperature of table");
  const auto german = [](std::string_view text) {
    return text == "feed %1" ? std::string("Vorschub %1") : text == "or" ? std::string("oder") : std::string(text);
  };
  EXPECT_EQ(driversInWords({{"feed_x^2"}, {"pos_y"}}, german), "Vorschub X² oder position Y");
}

TEST(PrintedText, FormulasHaveSymbols) {
  EXPECT_EQ(formulaInSymbols("ey = -g q (z - z0)^2 / 2, EA = g q (z - z0), ez = EA ry"),
            "EY = −g q (z − z₀)² / 2, EA = g q (z − z₀), EZ = EA ry");
  EXPECT_EQ(formulaInSymbols("(ex, ey, ez) = g q n x (p - p0), n along the axis"),
            "(EX, EY, EZ) = g q n × (p − p₀), n along the axis");
  EXPECT_EQ(formulaInSymbols("ex = g (1 - exp(-t / tau))"), "EX = g (1 − exp(−t / τ))");
  EXPECT_EQ(formulaInSymbols("EX = 0.5 * x^1.5 * (y - 2e-3)"), "EX = 0.5·x¹·⁵·(y − 2e−3)");
  EXPECT_EQ(formulaInSymbols("ex = g q sin(2 pi x / pitch) + g' q"), "EX = g q sin(2 π x / pitch) + g′ q");
  for (const Effect& effect : everyEffect()) {
    const std::string text = formulaInSymbols(effect.formula);
    EXPECT_EQ(text.find_first_of("^_*"), std::string::npos) << text;
  }
}

TEST(PrintedText, MomentsAndProbabilities) {
  EXPECT_EQ(utcInWords("2026-03-02T07:00:12Z"), "2026-03-02 07:00 UTC");
  EXPECT_EQ(utcInWords("yesterday"), "yesterday");
}

TEST(ParameterMeanings, ExplainEveryNameOfTheContract) {
  for (const char* name :
       {"EXX_um_per_m", "EX0C_um",  "EY0C_um", "EZ0T_um", "ER0T_um",   "EA0C_urad",       "EB0C_urad", "EC0C_urad",
        "EME_um_per_m", "hX_urad",  "hZ_urad", "aY_urad", "dZ_um",     "gX_um_per_m",     "EXY_um",    "EYY_um",
        "EAY_urad",     "ECY_urad", "EX_um",   "EC_urad", "EC0Y_urad", "alpha_X_um_per_m"}) {
    EXPECT_NE(parameterMeaning(name), "") << name;
  }
  EXPECT_EQ(parameterMeaning("EAY_urad"), "angular error of the Y axis about X");
  EXPECT_EQ(parameterMeaning("EXY_um"), "straightness error of the Y axis in the direction of X");
  EXPECT_EQ(parameterMeaning("EXX_um"), "positioning error of the X axis");
  EXPECT_EQ(parameterMeaning("gX_um_per_m"), "thermal expansion of the X ball screw from its fixed bearing");
  EXPECT_EQ(parameterMeaning("EBY_urad"), "roll error of the Y axis");
  EXPECT_EQ(errorParameter("aX_urad")->iso_symbol, "");  // EA0Z is the squareness of Z to Y
  EXPECT_EQ(describedParameter("alpha_X_um_per_m").symbol, "αX");
  EXPECT_EQ(describedParameter("EX0A_urad").symbol, "EX0A");
  EXPECT_EQ(describedParameter("EX0A_urad").unit, "urad");
  for (const char* name : {"EQX_um", "E_um", "rms_um", "EAX_um", "hello"})
    EXPECT_EQ(parameterMeaning(name), "") << name;
}

}  // namespace
}  // namespace spindrift
