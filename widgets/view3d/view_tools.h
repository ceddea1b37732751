// SPDX-License-Identifier: GPL-3.0-or-later
// Buttons over the 3D view: standard views, fit, perspective, measure, clip. Where the view is too small for the row,
// one button holds all of them as a menu. The row is one stop of the Tab key; arrows go along it.
#pragma once

#include <QFrame>
#include <QMarginsF>
#include <QRectF>
#include <vector>

class QAction;
class QBoxLayout;
class QSlider;
class QToolButton;

namespace spindrift::gui {

class View3D;

class ViewTools : public QFrame {
  Q_OBJECT
 public:
  explicit ViewTools(View3D* view);
  /// Follows the view: what there is to show, its size, perspective, measuring, clipping.
  void refresh();
  /// Goes where the view has arranged it, in the next turn of the event loop.
  void arrangeSoon();
  /// False: one button holds everything.
  [[nodiscard]] bool isOpen() const;
  [[nodiscard]] bool columnFits() const;
  /// The rectangle that the buttons take, at the bottom right, as a row or as a column; pixels of the view.
  [[nodiscard]] QRectF place(bool in_column) const;
  /// What they take from the picture: below it (row) or beside it (column); nothing where they are one button.
  [[nodiscard]] QMarginsF margins(bool in_column) const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void arrange();
  [[nodiscard]] QSize openSize(bool in_column) const;
  QAction* add(const char* icon_name, const QString& text, const QString& key, bool checkable = false);
  void moveFocus(int step);
  void sendClip();
  /// Extent of what is shown along the axis of the clip plane, mm.
  void setClipRange();

  View3D* view_;
  QBoxLayout* line_;
  std::vector<QAction*> actions_;
  std::vector<QToolButton*> buttons_;
  QToolButton* menu_button_;
  QAction* perspective_;
  QAction* measure_;
  QAction* clip_;
  QFrame* clip_panel_;
  QToolButton* clip_axis_;
  QSlider* clip_at_;
  QToolButton* clip_side_;
  int axis_ = 2;
  bool keep_low_ = true;
  double clip_low_mm_ = 0.0;
  double clip_high_mm_ = 1.0;
};

}  // namespace spindrift::gui
