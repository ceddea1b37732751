// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/theme/theme.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QFile>
#include <QFontMetricsF>
#include <QLineEdit>
#include <QPushButton>
#include <QToolButton>
#include <cmath>
#include <memory>

#include "widgets/common/parts.h"
#include "widgets/theme/colour_map.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/icons.h"
#include "widgets/workflow/workflow.h"

namespace spindrift::gui {
namespace {

// LOOK.md: text has at least 4.5 : 1 on what it stands on, in both themes.
TEST(Theme, TextHasEnoughContrast) {
  for (const Theme* t : {&Theme::light(), &Theme::dark()}) {
    for (const QColor& ground : {t->window, t->surface, t->surface_alt}) {
      EXPECT_GE(contrastRatio(t->text, ground), 4.5);
      EXPECT_GE(contrastRatio(t->text_secondary, ground), 4.5);
    }
    EXPECT_GE(contrastRatio(t->accent_text, t->accent), 4.5);
    EXPECT_GE(contrastRatio(t->text, t->accent_soft), 4.5);
    for (const Tone tone : {Tone::Neutral, Tone::Accent, Tone::Good, Tone::Attention, Tone::Bad, Tone::Outdated}) {
      EXPECT_GE(contrastRatio(t->tone(tone), t->toneSoft(tone)), 4.5) << static_cast<int>(tone);
      EXPECT_GE(contrastRatio(t->tone(tone), t->surface), 4.5) << static_cast<int>(tone);
    }
  }
}

TEST(Theme, FiguresAreTabular) {
  // Of texts, not of characters: a single character is measured without the features of the font.
  const QFontMetricsF metrics(bodyFont());
  const double width = metrics.horizontalAdvance(QStringLiteral("0000000000"));
  for (char c = '1'; c <= '9'; ++c) {
    EXPECT_NEAR(metrics.horizontalAdvance(QString(10, QLatin1Char(c))), width, 0.5) << c;
  }
}

TEST(Theme, EveryStepAndStateHasAnIcon) {
  for (const StepId step : all_steps) {
    EXPECT_TRUE(QFile::exists(QStringLiteral(":/icons/%1.svg").arg(QString::fromLatin1(stepIcon(step)))));
    EXPECT_FALSE(stepTitle(step).isEmpty());
    EXPECT_FALSE(stepInstruction(step).isEmpty());
  }
  for (const StepState state : {StepState::NotStarted, StepState::InProgress, StepState::Attention, StepState::Current,
                                StepState::Outdated, StepState::Blocked}) {
    EXPECT_TRUE(QFile::exists(QStringLiteral(":/icons/%1.svg").arg(QString::fromLatin1(stateIcon(state)))));
    EXPECT_FALSE(stateWord(state).isEmpty());
  }
}

TEST(Icons, AreTintedAndSharpAtAnyRatio) {
  const QImage image = iconPixmap(QStringLiteral("check"), QColor(200, 10, 10), 20, 2.0).toImage();
  EXPECT_EQ(image.width(), 40);
  int coloured = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const QColor c = image.pixelColor(x, y);
      if (c.alpha() > 200 && c.red() > 150 && c.green() < 60) ++coloured;
    }
  }
  EXPECT_GT(coloured, 20);
}

/// Most of what is drawn has the colour of the text beside it, in both themes and after the role has changed.
TEST(Icons, HaveTheColourOfTheTextOfTheirButton) {
  const auto inkOf = [](const QPushButton& button) {
    const QImage picture = button.icon().pixmap(QSize(32, 32)).toImage();
    QColor ink;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x)
        if (picture.pixelColor(x, y).alpha() == 255) ink = picture.pixelColor(x, y);
    return ink;
  };
  for (const ThemeKind kind : {ThemeKind::Dark, ThemeKind::Light}) {
    applyTheme(*qApp, kind);
    const std::unique_ptr<QPushButton> button(makeButton(QStringLiteral("Next"), "plus", "primary"));
    EXPECT_EQ(inkOf(*button).name(), theme().accent_text.name());
    setRole(button.get(), "secondary");
    EXPECT_EQ(inkOf(*button).name(), theme().text.name());
    setRole(button.get(), "primary");
    EXPECT_EQ(inkOf(*button).name(), theme().accent_text.name());
  }
}

TEST(ColourMap, DivergesFromANeutralZero) {
  const ColourScale scale = ColourScale::symmetric(13, QStringLiteral("EX"), QStringLiteral("um"));
  EXPECT_DOUBLE_EQ(scale.high, 15);
  EXPECT_DOUBLE_EQ(scale.low, -15);
  const QColor zero = scale.colour(0);
  EXPECT_LT(std::max({zero.red(), zero.green(), zero.blue()}) - std::min({zero.red(), zero.green(), zero.blue()}), 12);
  EXPECT_GT(scale.colour(15).red(), scale.colour(15).blue());
  EXPECT_GT(scale.colour(-15).blue(), scale.colour(-15).red());
  // Lightness falls evenly to both sides.
  EXPECT_NEAR(qGray(scale.rgb(10)), qGray(scale.rgb(-10)), 40);
}

TEST(ColourMap, TicksAreFiveToSevenRoundNumbers) {
  for (const double largest : {0.013, 0.7, 1.0, 3.3, 8.0, 14.9, 47.0, 260.0, 9999.0}) {
    const std::vector<double> ticks = ColourScale::symmetric(largest, {}, {}).ticks();
    EXPECT_GE(ticks.size(), 5U) << largest;
    EXPECT_LE(ticks.size(), 9U) << largest;
    EXPECT_NE(std::find(ticks.begin(), ticks.end(), 0.0), ticks.end()) << largest;
  }
  EXPECT_EQ(tickText(-2.5, 2.5), QString(QChar(0x2212)) + QStringLiteral("2.5"));
}

/// The button that clears a field is as small as the field: the rule for buttons of tool bars once made it stick out.
TEST(Theme, TheButtonThatClearsAFieldLiesInItsMiddle) {
  applyTheme(*qApp, ThemeKind::Light);
  QLineEdit field;
  field.setClearButtonEnabled(true);
  field.setText(QStringLiteral("text"));
  field.show();
  QCoreApplication::processEvents();
  const auto* button = field.findChild<QToolButton*>();
  ASSERT_NE(button, nullptr);
  EXPECT_TRUE(field.rect().contains(button->geometry()));
  EXPECT_NEAR(button->geometry().center().y(), field.rect().center().y(), 2);
}

}  // namespace
}  // namespace spindrift::gui
