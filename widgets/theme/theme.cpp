// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/theme/theme.h"

#include <QAbstractButton>
#include <QApplication>
#include <QFont>
#include <QPalette>
#include <QStyle>
#include <QStyleFactory>
#include <QVariant>
#include <QWidget>
#include <cmath>

#include "widgets/theme/fonts.h"
#include "widgets/theme/icons.h"
#include "widgets/theme/light_colours.h"
#include "widgets/theme/style_sheet.h"

/// Resources of a static library are linked in only when they are asked for, and only outside of namespaces.
static void loadIcons() {
  Q_INIT_RESOURCE(icons);
}

namespace spindrift::gui {
namespace {

const Theme* current_theme = &Theme::light();

Theme makeLight() {
  Theme t;
  t.kind = ThemeKind::Light;
  t.window = 0xF3F5F6;
  t.surface = 0xFFFFFF;
  t.surface_alt = 0xEDF0F2;
  t.border = 0xD9DFE3;
  t.border_strong = 0xAFBAC1;
  t.text = 0x1B2429;
  t.text_secondary = 0x53616A;
  t.text_disabled = 0x8A969D;
  t.accent = 0x0B6F82;
  t.accent_hover = 0x095B6B;
  t.accent_text = 0xFFFFFF;
  t.accent_soft = 0xDDEFF2;
  t.good = 0x1D7437;
  t.good_soft = 0xE2F2E6;
  t.attention = 0x875300;
  t.attention_soft = 0xFBEFD8;
  t.bad = 0xB0251D;
  t.bad_soft = 0xFBE8E6;
  t.outdated = 0x655A86;
  t.outdated_soft = 0xEBE8F3;
  t.view_top = 0xFAFBFC;
  t.view_bottom = 0xE6EBEE;
  t.grid = 0xC5CED3;
  t.body = 0xD3DADE;
  t.body_edge = 0x8C989F;
  t.axis_x = 0xB83227;
  t.axis_y = 0x2A7F46;
  t.axis_z = 0x2460B4;
  t.neutral_zero = 0xDDDDDD;
  t.series = {QColor(0x0072B2), QColor(0xC85200), QColor(0x00835F),
              QColor(0xA8518A), QColor(0x3C94C9), QColor(0xA87400)};
  return t;
}

Theme makeDark() {
  Theme t;
  t.kind = ThemeKind::Dark;
  t.window = 0x14191C;
  t.surface = 0x1D2428;
  t.surface_alt = 0x273036;
  t.border = 0x323C42;
  t.border_strong = 0x55636B;
  t.text = 0xE7ECEE;
  t.text_secondary = 0xA6B3BA;
  t.text_disabled = 0x6C7A82;
  t.accent = 0x52B9CB;
  t.accent_hover = 0x74CBDA;
  t.accent_text = 0x05242A;
  t.accent_soft = 0x1A3B43;
  t.good = 0x71C78D;
  t.good_soft = 0x1B3525;
  t.attention = 0xE3B05A;
  t.attention_soft = 0x3B2F17;
  t.bad = 0xF1908A;
  t.bad_soft = 0x432422;
  t.outdated = 0xB7ADD9;
  t.outdated_soft = 0x2F2B43;
  t.view_top = 0x232B30;
  t.view_bottom = 0x171C1F;
  t.grid = 0x465259;
  t.body = 0x4A565D;
  t.body_edge = 0x808D94;
  t.axis_x = 0xF0776B;
  t.axis_y = 0x67C584;
  t.axis_z = 0x74A9F2;
  t.neutral_zero = 0xDDDDDD;
  t.series = {QColor(0x5AAEE6), QColor(0xF08A4B), QColor(0x3CC79B),
              QColor(0xD991BF), QColor(0x9AD2F2), QColor(0xE6B54A)};
  return t;
}

QPalette makePalette(const Theme& t) {
  QPalette p;
  p.setColor(QPalette::Window, t.window);
  p.setColor(QPalette::WindowText, t.text);
  p.setColor(QPalette::Base, t.surface);
  p.setColor(QPalette::AlternateBase, t.surface_alt);
  p.setColor(QPalette::Text, t.text);
  p.setColor(QPalette::Button, t.surface);
  p.setColor(QPalette::ButtonText, t.text);
  p.setColor(QPalette::BrightText, t.bad);
  p.setColor(QPalette::Highlight, t.accent_soft);
  p.setColor(QPalette::HighlightedText, t.text);
  p.setColor(QPalette::Link, t.accent);
  p.setColor(QPalette::ToolTipBase, t.surface);
  p.setColor(QPalette::ToolTipText, t.text);
  p.setColor(QPalette::PlaceholderText, t.text_secondary);
  p.setColor(QPalette::Mid, t.border);
  p.setColor(QPalette::Dark, t.border_strong);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    p.setColor(QPalette::Disabled, role, t.text_disabled);
  }
  return p;
}

double luminance(const QColor& c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(c.redF()) + 0.7152 * linear(c.greenF()) + 0.0722 * linear(c.blueF());
}

}  // namespace

const Theme& Theme::light() {
  static const Theme table = makeLight();
  return table;
}

const Theme& Theme::dark() {
  static const Theme table = makeDark();
  return table;
}

QColor Theme::tone(Tone t) const {
  switch (t) {
    case Tone::Neutral:
      return text_secondary;
    case Tone::Accent:
      return accent;
    case Tone::Good:
      return good;
    case Tone::Attention:
      return attention;
    case Tone::Bad:
      return bad;
    case Tone::Outdated:
      return outdated;
  }
  return text;
}

QColor Theme::toneSoft(Tone t) const {
  switch (t) {
    case Tone::Neutral:
      return surface_alt;
    case Tone::Accent:
      return accent_soft;
    case Tone::Good:
      return good_soft;
    case Tone::Attention:
      return attention_soft;
    case Tone::Bad:
      return bad_soft;
    case Tone::Outdated:
      return outdated_soft;
  }
  return surface;
}

const Theme& theme() {
  return *current_theme;
}

ThemeNotifier& ThemeNotifier::instance() {
  static ThemeNotifier notifier;
  return notifier;
}

LightColours::LightColours() : before_(theme().kind) {
  if (before_ == ThemeKind::Light) return;
  current_theme = &Theme::light();
  Q_EMIT ThemeNotifier::instance().changed();
}

LightColours::~LightColours() {
  if (before_ == ThemeKind::Light) return;
  current_theme = &Theme::dark();
  Q_EMIT ThemeNotifier::instance().changed();
}

void applyTheme(QApplication& application, ThemeKind kind) {
  current_theme = kind == ThemeKind::Dark ? &Theme::dark() : &Theme::light();
  static bool first = true;
  if (first) {
    first = false;
    loadIcons();
    application.setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
    application.setFont(bodyFont());
  }
  application.setPalette(makePalette(*current_theme));
  application.setStyleSheet(styleSheet(*current_theme));
  Q_EMIT ThemeNotifier::instance().changed();
}

double contrastRatio(const QColor& a, const QColor& b) {
  const double la = luminance(a);
  const double lb = luminance(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

QColor mixed(const QColor& a, const QColor& b, double amount) {
  const auto mix = [amount](float x, float y) { return static_cast<float>(x + (y - x) * amount); };
  return QColor::fromRgbF(mix(a.redF(), b.redF()), mix(a.greenF(), b.greenF()), mix(a.blueF(), b.blueF()),
                          mix(a.alphaF(), b.alphaF()));
}

void setRole(QWidget* widget, const char* role) {
  widget->setProperty("role", QString::fromLatin1(role));
  widget->style()->unpolish(widget);
  widget->style()->polish(widget);
  if (auto* button = qobject_cast<QAbstractButton*>(widget))
    drawIconOnAccent(*button, widget->property("role").toString() == QLatin1String("primary"));
}

}  // namespace spindrift::gui
