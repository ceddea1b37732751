// SPDX-License-Identifier: GPL-3.0-or-later
// The one table of named colours, light and dark, and the sizes everything on screen is built from.
#pragma once

#include <QColor>
#include <QObject>
#include <array>

class QApplication;
class QString;
class QWidget;

namespace spindrift::gui {

enum class ThemeKind { Light, Dark };

/// The four meanings colours are used for, and nothing else. Never by colour alone: an icon and a word stand beside it.
enum class Tone { Neutral, Accent, Good, Attention, Bad, Outdated };

/// Named colours. Text on its own surface has a contrast of at least 4.5 : 1 (proven by a test).
struct Theme {
  ThemeKind kind = ThemeKind::Light;
  QColor window;       ///< behind everything
  QColor surface;      ///< cards, lists, fields
  QColor surface_alt;  ///< headers, hovered rows
  QColor border;
  QColor border_strong;  ///< borders of controls
  QColor text;
  QColor text_secondary;
  QColor text_disabled;
  QColor accent;  ///< what can be pressed
  QColor accent_hover;
  QColor accent_text;  ///< text on accent
  QColor accent_soft;  ///< selection
  QColor good, good_soft;
  QColor attention, attention_soft;
  QColor bad, bad_soft;
  QColor outdated, outdated_soft;
  // pictures
  QColor view_top, view_bottom;  ///< background of the 3D view
  QColor grid;
  QColor body, body_edge;  ///< machine bodies
  QColor axis_x, axis_y, axis_z;
  QColor neutral_zero;           ///< zero of the diverging map
  std::array<QColor, 6> series;  ///< lines of plots, distinguishable for the colour-blind (Okabe and Ito)

  [[nodiscard]] QColor tone(Tone t) const;
  [[nodiscard]] QColor toneSoft(Tone t) const;

  [[nodiscard]] static const Theme& light();
  [[nodiscard]] static const Theme& dark();
};

/// Sizes, device-independent pixels.
namespace sizes {
inline constexpr int step = 8;
inline constexpr int half_step = 4;
inline constexpr int control_height = 40;
inline constexpr int icon = 20;
inline constexpr int font_secondary = 12;
inline constexpr int font_body = 14;
inline constexpr int font_section = 18;
inline constexpr int font_number = 24;
}  // namespace sizes

/// The theme now in use. Widgets that paint themselves read it while painting and repaint on `changed`.
[[nodiscard]] const Theme& theme();

/// Tells self-painting widgets that the colours changed.
class ThemeNotifier : public QObject {
  Q_OBJECT
 public:
  static ThemeNotifier& instance();

 Q_SIGNALS:
  void changed();
};

/// Sets fonts, palette, style sheet. Callable again at any time to switch.
void applyTheme(QApplication& application, ThemeKind kind);

/// Contrast ratio of WCAG 2.1, 1 ... 21.
[[nodiscard]] double contrastRatio(const QColor& a, const QColor& b);
/// Mixes a towards b by `amount` in [0, 1].
[[nodiscard]] QColor mixed(const QColor& a, const QColor& b, double amount);

/// Marks a widget for the style sheet: `role` is one of "primary", "secondary", "quiet", "card", "sectionTitle",
/// "pageTitle", "bigNumber", "secondaryText", ... (style_sheet.cpp lists them).
void setRole(QWidget* widget, const char* role);

}  // namespace spindrift::gui
