// SPDX-License-Identifier: GPL-3.0-or-later
// What a user did at the window, as a list that can be kept in a file, read by people and done again: a report of a
// fault that others can follow, and a test.
//
// `spindrift --record FILE` writes one (JSON, "spindrift-recording"). Controls are named and not placed
// (control_name.h), so that the list holds for windows of any size, scale and theme, in the language it was made in.
// Everything that is typed is in it.
// tests/widgets/shell/recordings_test.cpp does what is in one.
#pragma once

#include <QObject>
#include <QPointF>
#include <QSize>
#include <QString>
#include <QTimer>
#include <filesystem>
#include <optional>
#include <vector>

#include "widgets/recording/control_name.h"

class QKeyEvent;
class QMouseEvent;

namespace spindrift::gui {

/// One thing that was done.
struct Interaction {
  enum class Kind {
    Press,        ///< pressed and released at one place
    DoublePress,  ///< twice
    Drag,         ///< pressed at `at`, released at `to`
    Wheel,        ///< turned by `steps` at `at`
    Key,          ///< `key` with `modifiers`, or the character `text`
    Look          ///< nothing done: what is seen now is worth a picture, called `text`
  };
  Kind kind = Kind::Press;
  ControlName control;
  QPointF at, to;                     ///< parts of width and height of the control, 0 to 1
  std::optional<PartOfControl> part;  ///< in place of `at`
  Qt::MouseButton button = Qt::LeftButton;
  Qt::KeyboardModifiers modifiers = Qt::NoModifier;
  int key = 0;  ///< Qt::Key; 0: `text` tells it
  QString text;
  int steps = 0;
};

struct Recording {
  QString demo;  ///< sample data that it begins with; empty: none
  QString language = QStringLiteral("en");
  QSize window{1440, 900};
  std::vector<Interaction> done;

  /// Throws InputError: not readable, or something in it is not what is written above.
  [[nodiscard]] static Recording read(const std::filesystem::path& file);
  /// Throws InputError where it cannot be written.
  void write(const std::filesystem::path& file) const;
};

/// Watches what is done at all windows of the application while it lives.
class Recorder : public QObject {
 public:
  /// What it begins with is told by the caller.
  Recorder(QString demo, QString language, QSize window);
  /// Writes what was not written yet.
  ~Recorder() override;

  /// All until now. A press that was not released yet is left out.
  [[nodiscard]] const Recording& recording() const { return recording_; }
  void look(const QString& name);
  /// Writes the file now and a moment after each thing done, so that what came before a crash is in it.
  void keepIn(const std::filesystem::path& file);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void press(QWidget& control, const QMouseEvent& event, Interaction::Kind kind);
  void release(const QMouseEvent& event);
  void key(const QKeyEvent& event);
  /// A press is done when it is released, or where a menu has opened and took the release.
  void finishPress();
  void add(const Interaction& one);
  /// An event that nobody wanted goes on to the parents of the control that it was for.
  [[nodiscard]] bool goesOn(const QWidget& control, const QEvent& event, QPoint place);

  Recording recording_;
  std::optional<Interaction> pressed_;
  const QWidget* pressed_on_ = nullptr;  ///< compared only, it may be gone
  QPoint pressed_at_;
  const QWidget* last_ = nullptr;
  int last_type_ = 0;
  QPoint last_place_;
  std::filesystem::path file_;
  QTimer later_;
};

}  // namespace spindrift::gui
