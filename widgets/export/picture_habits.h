// SPDX-License-Identifier: GPL-3.0-or-later
// What every picture of the window can do: copy (Ctrl+C while it has the focus), save, show all. One place for all
// plots, images and 3D views, as table_habits.h is for tables.
#pragma once

#include <QObject>
#include <QPoint>

namespace spindrift::gui {

/// Sees the events of all pictures of the program: a right click, the menu key and Ctrl+C. In a 3D view the right
/// button also pans: there the menu opens where the button is let go without having been moved. Copies and files have
/// light colours; an empty picture gives nothing away.
class PictureHabits : public QObject {
  Q_OBJECT
 public:
  explicit PictureHabits(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QPoint right_pressed_at_;
  bool right_moved_ = false;
};

}  // namespace spindrift::gui
