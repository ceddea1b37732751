// SPDX-License-Identifier: GPL-3.0-or-later
// Small building blocks all pages share: cards, sentences with a meaning, badges, empty places.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <QString>
#include <functional>

#include "widgets/theme/theme.h"

class QHBoxLayout;
class QAbstractItemModel;
class QComboBox;
class QPainter;
class QSplitter;
class QTabWidget;
class QTableView;
class QVBoxLayout;

namespace spindrift::gui {

/// Icon that goes with a meaning ("check-circle", "alert", "error", "outdated", "info").
[[nodiscard]] const char* toneIcon(Tone tone);

/// An icon that follows the theme.
class IconLabel : public QWidget {
  Q_OBJECT
 public:
  explicit IconLabel(QString name = {}, Tone tone = Tone::Neutral, int size = sizes::icon, QWidget* parent = nullptr);
  void set(const QString& name, Tone tone);
  [[nodiscard]] QSize sizeHint() const override { return {size_, size_}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString name_;
  Tone tone_;
  int size_;
};

/// One line that gives way where there is no room: it ends in dots then, and all of it is its tip.
class OneLine : public QLabel {
 public:
  explicit OneLine(const QString& text = {}, QWidget* parent = nullptr);
  [[nodiscard]] QSize minimumSizeHint() const override { return {0, QLabel::minimumSizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  [[nodiscard]] QString shown() const { return fontMetrics().elidedText(text(), Qt::ElideRight, width()); }
};

/// Sentences that are as high as their lines need at the width they have. A layout asks a label that is hidden, or
/// whose text has just changed, for the height of the text before, and the tabs of a page ask for none: a second line
/// is cut.
class WrappedLabel : public QLabel {
  Q_OBJECT
 public:
  explicit WrappedLabel(QWidget* parent = nullptr);
  void setText(const QString& text);

 protected:
  bool event(QEvent* event) override;

 private:
  void keepLines();
};

/// One sentence with a meaning: what is wrong (or good), what it means, what to do. Optionally one button.
class Callout : public QFrame {
  Q_OBJECT
 public:
  explicit Callout(QWidget* parent = nullptr);
  void show(Tone tone, const QString& sentence);
  /// Shows `sentence`, or hides the callout if it is empty.
  void set(Tone tone, const QString& sentence);
  void setAction(const QString& text, std::function<void()> action);
  /// As it was given; a line never ends between a number and its unit on screen.
  [[nodiscard]] const QString& sentence() const { return sentence_; }
  [[nodiscard]] Tone tone() const { return tone_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Tone tone_ = Tone::Neutral;
  QString sentence_;
  IconLabel* icon_;
  WrappedLabel* text_;
  QPushButton* button_;
  std::function<void()> action_;
};

/// A short word with an icon on a soft ground: "current", "outdated".
class Badge : public QWidget {
  Q_OBJECT
 public:
  explicit Badge(QWidget* parent = nullptr);
  void set(const QString& icon_name, Tone tone, const QString& word);
  [[nodiscard]] QString word() const { return word_; }
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString icon_;
  Tone tone_ = Tone::Neutral;
  QString word_;
};

/// A framed area with a title; content goes into `body()`.
class Card : public QFrame {
  Q_OBJECT
 public:
  explicit Card(const QString& title = {}, QWidget* parent = nullptr);
  [[nodiscard]] QVBoxLayout* body() const { return body_; }
  void setTitle(const QString& title);
  /// Places a widget at the right end of the title line.
  void addToTitle(QWidget* widget);

 private:
  QLabel* title_;
  QHBoxLayout* title_line_;
  QVBoxLayout* body_;
};

/// The one number that matters, with its name above and a sentence below.
class NumberTile : public QFrame {
  Q_OBJECT
 public:
  explicit NumberTile(const QString& name, QWidget* parent = nullptr);
  void set(const QString& value, const QString& note = {}, Tone tone = Tone::Neutral);
  [[nodiscard]] QString value() const { return value_->text(); }

 private:
  QLabel* value_;
  WrappedLabel* note_;
};

/// What stands where nothing is yet: what will appear here and how to get it.
class EmptyState : public QWidget {
  Q_OBJECT
 public:
  EmptyState(const char* icon_name, const QString& title, const QString& how, QWidget* parent = nullptr);
  void setTexts(const QString& title, const QString& how);
  QPushButton* addButton(const QString& text, bool primary = true);

 private:
  QLabel* title_;
  QLabel* how_;
  QVBoxLayout* layout_;
};

[[nodiscard]] QLabel* makeLabel(const QString& text, const char* role, QWidget* parent = nullptr);
[[nodiscard]] QPushButton* makeButton(const QString& text, const char* icon_name, const char* role = "secondary");
/// A read-only table in the program's manner: rows 32 px high, at least three in sight, no grid, columns as wide as
/// their content, the last stretched; all columns are in sight (titles may go on in a second line).
/// `empty_text` stands in it while there are no rows.
[[nodiscard]] QTableView* makeTable(QAbstractItemModel* model, const QString& accessible_name,
                                    const QString& empty_text = {});
/// Texts that have no room in their column go on in further lines, rows are as high as these. For tables of few rows.
void wrapCells(QTableView* table);
/// The same with sentences in its last column, which has the room that the others leave and as many lines as it needs.
[[nodiscard]] QTableView* makeSentenceTable(QAbstractItemModel* model, const QString& accessible_name,
                                            const QString& empty_text);
/// Two areas with a movable border, their sizes in the given proportion. Both give all that is in them its style at
/// once and again for every other parent: `parent` is where they stay, nullptr if that takes them itself.
[[nodiscard]] QSplitter* makeSplitter(QWidget* parent, QWidget* first, QWidget* second, int first_part, int second_part,
                                      Qt::Orientation orientation = Qt::Horizontal);
[[nodiscard]] QTabWidget* makeTabs(QWidget* parent);
/// A row of buttons of which one is down, like tabs: for two to six choices.
class Segments : public QWidget {
  Q_OBJECT
 public:
  explicit Segments(const QStringList& texts, const QString& accessible_name, QWidget* parent = nullptr);
  void setCurrent(int index);
  [[nodiscard]] int current() const { return current_; }
  [[nodiscard]] QPushButton* button(int index) const { return buttons_[static_cast<std::size_t>(index)]; }

 Q_SIGNALS:
  void chosen(int index);

 private:
  std::vector<QPushButton*> buttons_;
  int current_ = 0;
};

/// What will appear in a view that is empty, and how, in the middle of `area`.
void drawEmptyText(QPainter& painter, const QRect& area, const QString& title, const QString& how);

/// A line between two areas.
[[nodiscard]] QFrame* makeLine(Qt::Orientation orientation);

}  // namespace spindrift::gui
