// SPDX-License-Identifier: GPL-3.0-or-later
// A row of controls that goes on in the next line when the page is narrow, as text does.
#pragma once

#include <QLayout>
#include <vector>

namespace spindrift::gui {

/// Places its items from left to right at the width each asks for, and starts a new line when one does not fit. An item
/// is narrowed to its least width before it is moved to a line of its own, and an item whose policy expands takes what
/// its line leaves. Items of a line are centred vertically. Its smallest height is that of the lines it has now.
class WrapLayout : public QLayout {
 public:
  explicit WrapLayout(int spacing = 8);
  ~WrapLayout() override;

  void addItem(QLayoutItem* item) override;
  [[nodiscard]] int count() const override { return static_cast<int>(items_.size()); }
  [[nodiscard]] QLayoutItem* itemAt(int index) const override;
  QLayoutItem* takeAt(int index) override;
  [[nodiscard]] Qt::Orientations expandingDirections() const override { return Qt::Horizontal; }
  [[nodiscard]] bool hasHeightForWidth() const override { return true; }
  [[nodiscard]] int heightForWidth(int width) const override;
  [[nodiscard]] QSize minimumSize() const override;
  [[nodiscard]] QSize sizeHint() const override;
  void setGeometry(const QRect& area) override;
  /// A new line begins with this item whether or not it would have room before; -1: none.
  void setBreakBefore(int index);

 private:
  /// Lines as first index and one past the last.
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> lines(int width) const;
  int place(const QRect& area, bool move) const;
  /// Width of an item in a line that may be narrower than it would like.
  [[nodiscard]] int widthOf(const QLayoutItem& item, int line_width) const;

  std::vector<QLayoutItem*> items_;
  int break_before_ = -1;
  int width_ = 0;  ///< at which it was placed last; geometry() is forgotten whenever something changes
};

}  // namespace spindrift::gui
