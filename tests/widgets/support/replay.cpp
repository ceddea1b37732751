// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/widgets/support/replay.h"

#include <QApplication>
#include <QEventLoop>
#include <QKeySequence>
#include <QScrollArea>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>
#include <QWindow>
#include <algorithm>
#include <optional>
#include <utility>

#include "widgets/shell/main_window.h"
#include "widgets/shell/tour.h"

namespace spindrift::gui {
namespace {

constexpr int between_ms = 20;
constexpr int patience = 100;  ///< turns in which a control may still appear

/// The menu or dialog that takes all events; null: none.
QWidget* inFront() {
  QWidget* popup = QApplication::activePopupWidget();
  return popup != nullptr ? popup : QApplication::activeModalWidget();
}

QWidget* front(MainWindow& window) {
  if (QWidget* first = inFront()) return first;
  // A window beside the main one, such as the list of jobs.
  for (QWidget* top : QApplication::topLevelWidgets()) {
    if (top != &window && top->isVisible() && top->windowType() != Qt::ToolTip) return top;
  }
  return &window;
}

QString described(const Interaction& one) {
  if (one.kind == Interaction::Kind::Key)
    return one.key != 0 ? QKeySequence(one.key).toString(QKeySequence::PortableText) : one.text;
  return one.control.window.isEmpty() ? one.control.name
                                      : QStringLiteral("%1 in %2").arg(one.control.name, one.control.window);
}

}  // namespace

Replay::Replay(MainWindow& window, Recording recording, Look look)
    : window_(window), recording_(std::move(recording)), look_(std::move(look)) {}

QString Replay::run(int seconds) {
  QEventLoop loop;
  done_ = [&loop] { loop.quit(); };
  QTimer::singleShot(1000 * seconds, &loop, [&] {
    if (failure_.isEmpty()) failure_ = QStringLiteral("not done after %1 s").arg(seconds);
    loop.quit();
  });
  QTimer::singleShot(between_ms, this, &Replay::next);
  loop.exec();
  return failure_;
}

void Replay::fail(const Interaction& one, const QString& reason) {
  if (failure_.isEmpty()) failure_ = QStringLiteral("%1 (%2): %3").arg(at_).arg(described(one), reason);
}

void Replay::next() {
  if (!failure_.isEmpty() || at_ == recording_.done.size()) {
    // A dialog that stands there would keep the loop from ending.
    while (QWidget* dialog = QApplication::activeModalWidget()) dialog->close();
    done_();
    return;
  }
  if (!doing_) finishWhatWasPutOff();
  if (!settled(window_) || (doing_ && inFront() == in_front_)) {
    QTimer::singleShot(between_ms, this, &Replay::next);
    return;
  }
  const Interaction one = recording_.done[at_];
  const bool named = one.kind != Interaction::Kind::Key && one.kind != Interaction::Kind::Look;
  if (named && findControl(one.control) == nullptr) {
    if (++waited_ > patience) {
      ++at_;
      fail(one, QStringLiteral("there is no such control"));
    }
    QTimer::singleShot(between_ms, this, &Replay::next);
    return;
  }
  waited_ = 0;
  if (one.kind == Interaction::Kind::Look) {
    look_(one.text, *front(window_));
    ++at_;
    QTimer::singleShot(between_ms, this, &Replay::next);
    return;
  }
  ++at_;
  // What is done may open a dialog or a menu and return when that is closed: what follows is asked for before, and
  // waits for the end of what is done unless one has come up.
  doing_ = true;
  in_front_ = inFront();
  QTimer::singleShot(between_ms, this, &Replay::next);
  doIt(one);
  doing_ = false;
}

void Replay::press(QWidget& control, const Interaction& one) {
  for (QWidget* above = control.parentWidget(); above != nullptr; above = above->parentWidget()) {
    if (auto* area = qobject_cast<QScrollArea*>(above)) area->ensureWidgetVisible(&control);
  }
  const auto local = [&](QPointF part) {
    return QPoint(std::min(control.width() - 1, qRound(part.x() * control.width())),
                  std::min(control.height() - 1, qRound(part.y() * control.height())));
  };
  QPoint place = local(one.at);
  if (one.part) {
    const std::optional<QPoint> part = placeOf(control, *one.part);
    if (!part) return fail(one, QStringLiteral("it has no such part"));
    place = *part;
  }
  QWidget* top = control.window();
  QWindow* handle = top->windowHandle();
  const auto inWindow = [&](QPoint at) { return control.mapTo(top, at); };
  QWidget* there = top->childAt(inWindow(place));
  if (there != nullptr && there != &control && !control.isAncestorOf(there))
    return fail(one, QStringLiteral("%1 stands before it").arg(labelOf(*there)));
  switch (one.kind) {
    case Interaction::Kind::DoublePress:
      return QTest::mouseDClick(handle, one.button, one.modifiers, inWindow(place));
    case Interaction::Kind::Drag:
      QTest::mousePress(handle, one.button, one.modifiers, inWindow(place));
      QTest::mouseMove(handle, inWindow((place + local(one.to)) / 2));
      QTest::mouseMove(handle, inWindow(local(one.to)));
      return QTest::mouseRelease(handle, one.button, one.modifiers, inWindow(local(one.to)));
    case Interaction::Kind::Wheel: {
      QWheelEvent event(place, control.mapToGlobal(place), {}, QPoint(0, 120 * one.steps), Qt::NoButton, one.modifiers,
                        Qt::NoScrollPhase, false);
      QCoreApplication::sendEvent(&control, &event);
      return;
    }
    default:
      QTest::mouseMove(handle, inWindow(place));
      QTest::mouseClick(handle, one.button, one.modifiers, inWindow(place));
  }
}

void Replay::doIt(const Interaction& one) {
  switch (one.kind) {
    case Interaction::Kind::Key: {
      QWindow* handle = front(window_)->windowHandle();
      if (one.key != 0)
        QTest::keyClick(handle, static_cast<Qt::Key>(one.key), one.modifiers);
      else
        QTest::keyClick(handle, one.text.front().toLatin1(), one.modifiers);
      return;
    }
    default:
      press(*findControl(one.control), one);
  }
}

}  // namespace spindrift::gui
