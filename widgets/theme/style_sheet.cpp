// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/theme/style_sheet.h"

#include <QHash>
#include <QRegularExpression>

#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

// @name@ stands for a colour of the theme.
constexpr auto text = R"(
* { outline: none; }
QMainWindow, QDialog { background: @window@; }
QLabel { background: transparent; }
QToolTip { background: @surface@; color: @text@; border: 1px solid @border_strong@; padding: 6px 8px; }

QLabel[role="pageTitle"] { font-size: 18px; font-weight: 600; color: @text@; }
QLabel[role="sectionTitle"] { font-size: 14px; font-weight: 600; color: @text@; }
QLabel[role="secondaryText"] { font-size: 12px; color: @text_secondary@; }
QLabel[role="bigNumber"] { font-size: 24px; font-weight: 600; color: @text@; }
QLabel[role="instruction"] { font-size: 14px; color: @text_secondary@; }

QFrame[role="card"] { background: @surface@; border: 1px solid @border@; border-radius: 8px; }
QFrame[role="sidebar"] { background: @surface@; border: none; border-right: 1px solid @border@; }
QFrame[role="bar"] { background: @surface@; border: none; border-top: 1px solid @border@; }
QFrame[role="topBar"] { background: @surface@; border: none; border-bottom: 1px solid @border@; }
QFrame[role="line"] { background: @border@; border: none; }

QPushButton, QToolButton[role="secondary"] { background: @surface@; color: @text@; border: 1px solid @border_strong@; border-radius: 6px;
  padding: 0 16px; min-height: 38px; }
QPushButton:hover, QToolButton[role="secondary"]:hover { background: @surface_alt@; border-color: @accent@; }
QPushButton:pressed { background: @accent_soft@; }
QPushButton:focus, QToolButton[role="secondary"]:focus { border: 2px solid @accent@; padding: 0 15px; min-height: 36px; }
QPushButton:disabled { color: @text_disabled@; border-color: @border@; background: @window@; }
QPushButton:checked { background: @accent_soft@; border-color: @accent@; color: @text@; }
QPushButton[role="primary"] { background: @accent@; color: @accent_text@; border: 1px solid @accent@; font-weight: 600; }
QPushButton[role="primary"]:hover { background: @accent_hover@; }
QPushButton[role="primary"]:focus { border: 2px solid @text@; }
QPushButton[role="primary"]:disabled { background: @surface_alt@; color: @text_disabled@; border-color: @border@; }
QPushButton[role="quiet"] { background: transparent; border: 1px solid transparent; padding: 0 10px; }
QPushButton[role="quiet"]:hover { background: @surface_alt@; }
QPushButton[role="quiet"]:focus { border: 2px solid @accent@; padding: 0 9px; }
QPushButton[role="quiet"]:checked { background: @accent_soft@; }

QToolButton { background: transparent; color: @text@; border: 1px solid transparent; border-radius: 6px; min-width: 38px;
  min-height: 38px; padding: 0; }
QToolButton:hover { background: @surface_alt@; }
QToolButton:focus { border: 2px solid @accent@; min-width: 36px; min-height: 36px; }
QToolButton:checked { background: @accent_soft@; border-color: @accent@; }
QToolButton:disabled { color: @text_disabled@; }
QToolButton::menu-indicator { image: none; }

QPushButton[segment="first"] { border-top-right-radius: 0; border-bottom-right-radius: 0; }
QPushButton[segment="middle"] { border-radius: 0; border-left: none; }
QPushButton[segment="last"] { border-top-left-radius: 0; border-bottom-left-radius: 0; border-left: none; }
QPushButton[segment] { padding: 0 12px; }

QLineEdit, QSpinBox, QDoubleSpinBox, QComboBox, QPlainTextEdit, QTextEdit { background: @surface@; color: @text@;
  border: 1px solid @border_strong@; border-radius: 6px; padding: 0 10px; min-height: 38px;
  selection-background-color: @accent@; selection-color: @accent_text@; }
QLineEdit:focus, QSpinBox:focus, QDoubleSpinBox:focus, QComboBox:focus, QPlainTextEdit:focus { border: 2px solid @accent@;
  padding: 0 9px; min-height: 36px; }
QLineEdit:disabled, QComboBox:disabled, QSpinBox:disabled, QDoubleSpinBox:disabled { color: @text_disabled@; background: @window@;
  border-color: @border@; }
QLineEdit[invalid="true"], QDoubleSpinBox[invalid="true"] { border: 2px solid @bad@; }
QComboBox { padding-right: 28px; }
QComboBox::drop-down { border: none; width: 28px; }
QComboBox::down-arrow { image: url(:/icons/@kind@/chevron-down.svg); width: 16px; height: 16px; }
QComboBox QAbstractItemView { background: @surface@; border: 1px solid @border_strong@; selection-background-color: @accent_soft@;
  selection-color: @text@; padding: 4px; }
QComboBox QAbstractItemView::item { min-height: 36px; }
QSpinBox::up-button, QDoubleSpinBox::up-button { border: none; width: 24px; subcontrol-position: top right; }
QSpinBox::down-button, QDoubleSpinBox::down-button { border: none; width: 24px; subcontrol-position: bottom right; }
QSpinBox::up-arrow, QDoubleSpinBox::up-arrow { image: url(:/icons/@kind@/chevron-up.svg); width: 14px; height: 14px; }
QSpinBox::down-arrow, QDoubleSpinBox::down-arrow { image: url(:/icons/@kind@/chevron-down.svg); width: 14px; height: 14px; }

QCheckBox, QRadioButton { spacing: 8px; min-height: 40px; background: transparent; }
QCheckBox::indicator, QRadioButton::indicator { width: 18px; height: 18px; border: 1px solid @border_strong@; background: @surface@; }
QCheckBox::indicator { border-radius: 4px; }
QRadioButton::indicator { border-radius: 9px; }
QCheckBox::indicator:checked { background: @accent@; border-color: @accent@; image: url(:/icons/@kind@/check-on-accent.svg); }
QRadioButton::indicator:checked { border: 6px solid @accent@; width: 8px; height: 8px; }
QCheckBox::indicator:focus, QRadioButton::indicator:focus { border: 2px solid @accent@; width: 16px; height: 16px; }
QCheckBox::indicator:disabled { background: @window@; border-color: @border@; }

QAbstractItemView { background: @surface@; alternate-background-color: @surface@; color: @text@; border: none;
  selection-background-color: @accent_soft@; selection-color: @text@; gridline-color: @border@; }
QTableView::item, QTreeView::item, QListView::item { padding: 0 6px; border: none; }
QTableView::item:selected, QTreeView::item:selected, QListView::item:selected { background: @accent_soft@; color: @text@; }
QTableView::item:hover:!selected, QTreeView::item:hover:!selected, QListView::item:hover:!selected { background: @surface_alt@; }
QTableView::indicator, QTreeView::indicator { width: 18px; height: 18px; border: 1px solid @border_strong@; border-radius: 4px;
  background: @surface@; }
QTableView::indicator:checked, QTreeView::indicator:checked { background: @accent@; border-color: @accent@;
  image: url(:/icons/@kind@/check-on-accent.svg); }
QHeaderView { background: @surface@; border: none; }
QHeaderView::section { background: @surface@; color: @text_secondary@; border: none; border-bottom: 1px solid @border@; padding: 6px 6px;
  font-size: 12px; font-weight: 600; }
QHeaderView::up-arrow { image: url(:/icons/@kind@/chevron-up.svg); width: 12px; height: 12px; }
QHeaderView::down-arrow { image: url(:/icons/@kind@/chevron-down.svg); width: 12px; height: 12px; }
QAbstractScrollArea::corner { background: transparent; border: none; }
QTableCornerButton::section { background: @surface@; border: none; }

QTabWidget::pane { border: none; border-top: 1px solid @border@; }
QTabBar { background: transparent; }
QTabBar::scroller { width: 28px; }
QTabBar::tear { width: 0; border: none; image: none; }
QLineEdit > QToolButton, QLineEdit > QToolButton:focus { min-width: 0; min-height: 0; padding: 0; border: none; }
QTabBar QToolButton { min-width: 26px; max-width: 26px; border: none; border-radius: 4px; }
QTabBar::tab { background: transparent; color: @text_secondary@; border: none; border-bottom: 3px solid transparent; padding: 0 16px;
  min-height: 37px; }
QTabBar[narrow="true"]::tab { padding: 0 5px; }
QTabBar::tab:hover { color: @text@; }
QTabBar::tab:selected { color: @text@; border-bottom: 3px solid @accent@; font-weight: 600; }
QTabBar::tab:focus { background: @accent_soft@; }

QScrollArea, QScrollArea > QWidget > QWidget { background: transparent; border: none; }
QScrollBar:vertical { background: transparent; width: 12px; margin: 0; }
QScrollBar:horizontal { background: transparent; height: 12px; margin: 0; }
QScrollBar::handle { background: @border_strong@; border-radius: 4px; margin: 2px; min-height: 32px; min-width: 32px; }
QScrollBar::handle:hover { background: @text_secondary@; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; border: none; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }

QSplitter::handle { background: transparent; }
QSplitter::handle:hover { background: @accent_soft@; }

QMenuBar { background: @surface@; color: @text@; border-bottom: 1px solid @border@; padding: 2px 4px; }
QMenuBar::item { padding: 8px 12px; border-radius: 6px; background: transparent; }
QMenuBar::item:selected { background: @surface_alt@; }
QMenu { background: @surface@; color: @text@; border: 1px solid @border_strong@; padding: 4px; }
QMenu::item { padding: 8px 28px 8px 12px; border-radius: 4px; }
QMenu::item:selected { background: @accent_soft@; }
QMenu::item:disabled { color: @text_disabled@; }
QMenu::separator { height: 1px; background: @border@; margin: 4px 8px; }
QMenu::icon { padding-left: 8px; }

QProgressBar { background: @surface_alt@; border: none; border-radius: 3px; min-height: 6px; max-height: 6px; }
QProgressBar::chunk { background: @accent@; border-radius: 3px; }
QSlider::groove:horizontal { height: 4px; background: @border_strong@; border-radius: 2px; }
QSlider::sub-page:horizontal { background: @accent@; border-radius: 2px; }
QSlider::handle:horizontal { background: @accent@; width: 18px; height: 18px; margin: -7px 0; border-radius: 9px; }
QSlider { min-height: 40px; }
QGroupBox { border: none; font-weight: 600; margin-top: 24px; }
QGroupBox::title { subcontrol-origin: margin; left: 0; }
)";

}  // namespace

QString styleSheet(const Theme& t) {
  const QHash<QString, QString> names{
      {QStringLiteral("window"), t.window.name()},
      {QStringLiteral("surface"), t.surface.name()},
      {QStringLiteral("surface_alt"), t.surface_alt.name()},
      {QStringLiteral("border"), t.border.name()},
      {QStringLiteral("border_strong"), t.border_strong.name()},
      {QStringLiteral("text"), t.text.name()},
      {QStringLiteral("text_secondary"), t.text_secondary.name()},
      {QStringLiteral("text_disabled"), t.text_disabled.name()},
      {QStringLiteral("accent"), t.accent.name()},
      {QStringLiteral("accent_hover"), t.accent_hover.name()},
      {QStringLiteral("accent_text"), t.accent_text.name()},
      {QStringLiteral("accent_soft"), t.accent_soft.name()},
      {QStringLiteral("bad"), t.bad.name()},
      {QStringLiteral("kind"), t.kind == ThemeKind::Dark ? QStringLiteral("dark") : QStringLiteral("light")},
  };
  QString sheet = QString::fromLatin1(text);
  for (auto it = names.begin(); it != names.end(); ++it) {
    sheet.replace(QLatin1Char('@') + it.key() + QLatin1Char('@'), it.value());
  }
  return sheet;
}

}  // namespace spindrift::gui
