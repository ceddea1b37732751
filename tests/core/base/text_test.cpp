// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/text.h"
#include "core/base/printed_number.h"
#include "core/base/unit_text.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/natural_order.h"

namespace spindrift {
namespace {

TEST(Text, PValuesAreReadableAndPromiseNoMoreThanTheNoiseModelKnows) {
  EXPECT_EQ(pValueText(0.5123), "p = 0.51");
  EXPECT_EQ(pValueText(0.0012), "p = 0.0012");
  EXPECT_EQ(pValueText(6.4e-5), "p = 6 × 10⁻⁵");
  EXPECT_EQ(pValueText(1e-100), "p < 10⁻¹²");
  EXPECT_EQ(pValueText(0.0), "p < 10⁻¹²");
  EXPECT_EQ(pValueText(std::nan("")), "p not determined");
  EXPECT_EQ(probabilityText(1e-20), "< 10⁻¹²");
  EXPECT_EQ(probabilityText(3e-5), "3 × 10⁻⁵");
  EXPECT_EQ(probabilityText(9.7e-4), "1 × 10⁻³") << "not 10 × 10⁻⁴";
  EXPECT_EQ(probabilityText(0.04), "0.04");
  EXPECT_EQ(probabilityText(std::nan("")), "–");
}

TEST(Text, UnitsOfFilesAreSymbolsInTexts) {
  EXPECT_EQ(printedUnit("um"), "µm");
  EXPECT_EQ(printedUnit("urad/K"), "µrad/K");
  EXPECT_EQ(printedUnit("um/(m K)"), "µm/(m K)");
  EXPECT_EQ(printedUnit("degC"), "°C");
  EXPECT_EQ(printedUnit("um2, um urad, urad2"), "µm², µm µrad, µrad²");
  for (const char* unit : {"", "mm/min", "rpm", "umbra", "1"}) EXPECT_EQ(printedUnit(unit), unit);
  for (const auto& [name, unit] : {std::pair{"Z_um", "um"},
                                   {"A_urad", "urad"},
                                   {"EXX_um_per_m", "um/m"},
                                   {"Z_nm", "nm"},
                                   {"A_mrad", "mrad"},
                                   {"T_nose_degC", ""},
                                   {"pos_z_mm", ""},
                                   {"um", ""},
                                   {"", ""}})
    EXPECT_EQ(unitOfSignal(name), unit) << name;
}

TEST(Text, DigitsFollowTheUncertainty) {
  EXPECT_EQ(withUncertainty(0.0, std::numeric_limits<double>::infinity(), "um"), "not determined");
  EXPECT_EQ(withUncertainty(12.3456, 0.34, "um"), "12.3 \u00b1 0.3 µm");
  EXPECT_EQ(withUncertainty(-0.0001, 0.02, "rad"), "0.000 ± 0.020 rad") << "no minus sign before nothing";
  EXPECT_EQ(withUncertainty(-12.3456, 0.123, "um"), "\u221212.35 \u00b1 0.12 µm");
  EXPECT_EQ(withUncertainty(1234.5, 40.0, "urad"), "1230 \u00b1 40 µrad");
  EXPECT_EQ(withUncertainty(1036.2, 948.7, "urad"), "1000 \u00b1 900 µrad");
  EXPECT_EQ(withUncertainty(-3.0, 948.7, "urad"), "0 \u00b1 900 µrad");
  EXPECT_EQ(withUncertainty(1036.2, 150.3, "urad"), "1040 \u00b1 150 µrad");
  EXPECT_EQ(withUncertainty(31.4, 12.2, "urad"), "31 \u00b1 12 µrad");
  EXPECT_EQ(withUncertainty(0.000123456, 0.0000021, ""), "0.0001235 \u00b1 0.0000021");
  EXPECT_EQ(withUncertainty(5.25, std::nan(""), "mm"), "5.25 mm");
  EXPECT_EQ(withUncertainty(std::nan(""), 1.0, "mm"), "not determined");
}

TEST(Text, ExactNumberReadsBack) {
  for (const double value : {0.1, 1.0 / 3.0, -1e-300, 12345678.9, 5e-324}) {
    double back = 0.0;
    ASSERT_TRUE(parseNumber(exactNumber(value), back));
    EXPECT_EQ(back, value);
  }
}

TEST(PrintedNumber, HasATrueMinusNoSignBeforeZeroAndPowersOfTen) {
  EXPECT_EQ(fmt::format("{:.2f}", printed(-0.254)), "−0.25");
  EXPECT_EQ(fmt::format("{:.2f}", printed(-0.004)), "0.00");
  EXPECT_EQ(fmt::format("{:+.3f}", printed(0.0)), "0.000");
  EXPECT_EQ(fmt::format("{:+.1f}", printed(1.25)), "+1.2");
  EXPECT_EQ(fmt::format("{:g} to {:g}", printed(1e-6), printed(1e6)), "10⁻⁶ to 10⁶");
  EXPECT_EQ(fmt::format("{:.2g}", printed(-2.54e-12)), "−2.5 × 10⁻¹²");
  EXPECT_EQ(fmt::format("{:g}", printed(-0.0)), "0");
  EXPECT_EQ(fmt::format("{}", printed(-1.5)), "−1.5");
  EXPECT_EQ(fmt::format("{:.1f}", printed(std::nan(""))), "–");
  // Widths count characters, not bytes of the signs.
  EXPECT_EQ(fmt::format("[{:8.2f}] [{:<8.2f}] [{:>+8.2f}]", printed(-0.5), printed(-0.5), printed(0.5)),
            "[   −0.50] [−0.50   ] [   +0.50]");
  EXPECT_EQ(fmt::format("[{:3.2f}]", printed(-10.0)), "[−10.00]");
}

TEST(Text, ListsAndEscapes) {
  const std::vector<std::string> names{"F1", "F2", "F3"};
  EXPECT_EQ(joinedList(names), "F1, F2 and F3");
  EXPECT_EQ(joinedList(std::span(names).first(1)), "F1");
  EXPECT_EQ(shortenedList(names, 3, 2), "F1, F2 and F3");
  EXPECT_EQ(shortenedList(names, 2, 1), "F1 and 2 more");
  EXPECT_EQ(splitList(" F1, F2,,F3 "), names);
  EXPECT_EQ(escapedXml("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
}

TEST(NaturalOrder, NumbersInNamesCountByTheirValue) {
  std::vector<std::string> names{"H1@90",
                                 "F10_EX",
                                 "F2",
                                 "F10",
                                 "B1/p10",
                                 "F1",
                                 "H1",
                                 "B1/p2",
                                 "f1",
                                 "F01",
                                 "F9_EX",
                                 "F123456789012345678901",
                                 "F123456789012345678902",
                                 ""};
  std::sort(names.begin(), names.end(), NaturalOrder());
  EXPECT_EQ(names, (std::vector<std::string>{"", "B1/p2", "B1/p10", "F01", "F1", "F2", "F9_EX", "F10", "F10_EX",
                                             "F123456789012345678901", "F123456789012345678902", "H1", "H1@90", "f1"}));
  const NaturalOrder before;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t k = 0; k < names.size(); ++k) EXPECT_EQ(before(names[i], names[k]), i < k) << names[i] << names[k];
  EXPECT_TRUE(before(std::pair{std::string("F2"), 1}, std::pair{std::string("F10"), 0}));
  EXPECT_TRUE(before(std::pair{std::string("F2"), 0}, std::pair{std::string("F2"), 1}));
}

}  // namespace
}  // namespace spindrift
