// SPDX-License-Identifier: GPL-3.0-or-later
// A control of the window by what a person would call it, so that it is found again in another run of the program: in
// a window of another size, scale or theme. What it is called depends on the language.
#pragma once

#include <QPoint>
#include <QString>
#include <optional>

class QWidget;

namespace spindrift::gui {

/// "QPushButton Fit the model", the second of the same name: number 1.
struct ControlName {
  QString window;  ///< class of the dialog or menu that it is in; empty: the main window
  QString name;    ///< class and label
  int number = 0;  ///< among the visible ones of that name, in the order of their making
};

/// The text on it, else its accessible name, else its object name; mnemonics and line breaks are left out.
[[nodiscard]] QString labelOf(const QWidget& control);
[[nodiscard]] ControlName nameOf(const QWidget& control);
/// The visible control of that name; null: there is none.
[[nodiscard]] QWidget* findControl(const ControlName& name);

/// A part of a control that stands where it stands today: the entry of a menu, the tab of a bar, the cell of a table.
struct PartOfControl {
  QString label;  ///< of an entry or a tab
  int row = -1;   ///< of a cell
  int column = -1;
};
/// The part at a place of the control; nothing: it has no parts there.
[[nodiscard]] std::optional<PartOfControl> partAt(const QWidget& control, QPoint at);
/// The middle of the part, scrolled into view; nothing: it is not there.
[[nodiscard]] std::optional<QPoint> placeOf(QWidget& control, const PartOfControl& part);

}  // namespace spindrift::gui
