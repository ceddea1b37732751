// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/recording/recording.h"

#include <QApplication>
#include <QKeySequence>
#include <QMouseEvent>
#include <QWheelEvent>
#include <QWidget>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/json_reader.h"
#include "core/base/log.h"
#include "core/base/text.h"

namespace spindrift::gui {
namespace {

constexpr const char* format_name = "spindrift-recording";
constexpr int format_version = 1;
constexpr int still_px = 4;              ///< a hand that moves less while it presses does not drag
constexpr int wheel_step_eighths = 120;  ///< of a degree

using Kind = Interaction::Kind;

const std::vector<std::pair<Kind, std::string>>& kindNames() {
  static const std::vector<std::pair<Kind, std::string>> names{{Kind::Press, "press"}, {Kind::DoublePress, "double"},
                                                               {Kind::Drag, "drag"},   {Kind::Wheel, "wheel"},
                                                               {Kind::Key, "key"},     {Kind::Look, "look"}};
  return names;
}

/// Shift, control and alt as bits for people: "Ctrl+Shift".
std::string modifierText(Qt::KeyboardModifiers modifiers) {
  std::string text;
  for (const auto& [one, name] :
       {std::pair{Qt::ControlModifier, "Ctrl"}, {Qt::AltModifier, "Alt"}, {Qt::ShiftModifier, "Shift"}}) {
    if (modifiers.testFlag(one)) text += (text.empty() ? "" : "+") + std::string(name);
  }
  return text;
}

Qt::KeyboardModifiers modifiersOf(const JsonNode& node) {
  Qt::KeyboardModifiers modifiers;
  if (!node.has("held")) return modifiers;
  for (const std::string& one : splitList(node.at("held").string(), '+')) {
    if (one == "Ctrl") {
      modifiers |= Qt::ControlModifier;
    } else if (one == "Alt") {
      modifiers |= Qt::AltModifier;
    } else if (one == "Shift") {
      modifiers |= Qt::ShiftModifier;
    } else {
      node.at("held").reject("Ctrl, Alt and Shift, joined by +");
    }
  }
  return modifiers;
}

nlohmann::json pointJson(QPointF point) {
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  return {rounded(point.x()), rounded(point.y())};
}

QPointF pointOf(const JsonNode& node) {
  const std::vector<double> values = node.numbers();
  if (values.size() != 2 || values[0] < 0.0 || values[0] > 1.0 || values[1] < 0.0 || values[1] > 1.0)
    node.reject("two numbers from 0 to 1");
  return {values[0], values[1]};
}

nlohmann::json toJson(const Interaction& one) {
  nlohmann::json out = nlohmann::json::object();
  for (const auto& [kind, name] : kindNames())
    if (kind == one.kind) out["do"] = name;
  if (one.kind == Kind::Look) {
    out["name"] = one.text.toStdString();
    return out;
  }
  if (one.kind == Kind::Key) {
    if (one.key != 0)
      out["key"] = QKeySequence(one.key).toString(QKeySequence::PortableText).toStdString();
    else
      out["text"] = one.text.toStdString();
    if (const std::string held = modifierText(one.modifiers); !held.empty()) out["held"] = held;
    return out;
  }
  out["on"] = one.control.name.toStdString();
  if (one.control.number > 0) out["number"] = one.control.number;
  if (!one.control.window.isEmpty()) out["in"] = one.control.window.toStdString();
  if (one.part && one.part->row >= 0)
    out["cell"] = {one.part->row, one.part->column};
  else if (one.part)
    out["part"] = one.part->label.toStdString();
  else
    out["at"] = pointJson(one.at);
  if (one.kind == Kind::Drag) out["to"] = pointJson(one.to);
  if (one.kind == Kind::Wheel) out["steps"] = one.steps;
  if (one.button == Qt::RightButton) out["button"] = "right";
  if (one.button == Qt::MiddleButton) out["button"] = "middle";
  if (const std::string held = modifierText(one.modifiers); !held.empty()) out["held"] = held;
  return out;
}

QString textOf(const JsonNode& node, const char* key) {
  return QString::fromStdString(node.stringOr(key, ""));
}

int keyOf(const JsonNode& node) {
  const QKeySequence sequence(QString::fromStdString(node.string()), QKeySequence::PortableText);
  if (sequence.count() != 1 || sequence[0].key() == Qt::Key_unknown) node.reject("one key, such as Return");
  return sequence[0].key();
}

Interaction interactionOf(const JsonNode& node) {
  std::vector<std::string> allowed;
  for (const auto& [kind, name] : kindNames()) allowed.push_back(name);
  const std::string done = node.at("do").oneOf(allowed);
  Interaction one;
  for (const auto& [kind, name] : kindNames())
    if (name == done) one.kind = kind;
  one.modifiers = modifiersOf(node);
  if (one.kind == Kind::Look) {
    one.text = QString::fromStdString(node.at("name").name());
    return one;
  }
  if (one.kind == Kind::Key) {
    if (node.has("key"))
      one.key = keyOf(node.at("key"));
    else
      one.text = QString::fromStdString(node.at("text").string());
    if (one.key == 0 && one.text.size() != 1) node.at("text").reject("one character");
    return one;
  }
  one.control = {textOf(node, "in"), QString::fromStdString(node.at("on").name()),
                 node.has("number") ? node.at("number").integer() : 0};
  if (one.control.number < 0) node.at("number").reject("0 or more");
  if (node.has("cell")) {
    const std::vector<double> cell = node.at("cell").numbers();
    if (cell.size() != 2 || cell[0] < 0.0 || cell[1] < 0.0) node.at("cell").reject("row and column from 0 on");
    one.part = PartOfControl{QString(), static_cast<int>(cell[0]), static_cast<int>(cell[1])};
  } else if (node.has("part")) {
    one.part = PartOfControl{QString::fromStdString(node.at("part").name())};
  } else {
    one.at = pointOf(node.at("at"));
  }
  if (one.kind == Kind::Drag) one.to = pointOf(node.at("to"));
  if (one.kind == Kind::Wheel) one.steps = node.at("steps").integer();
  if (node.has("button")) {
    const std::string button = node.at("button").oneOf({"left", "middle", "right"});
    one.button = button == "right" ? Qt::RightButton : button == "middle" ? Qt::MiddleButton : Qt::LeftButton;
  }
  return one;
}

QPointF partOf(const QWidget& control, QPoint place) {
  const auto part = [](int value, int whole) {
    return whole > 0 ? std::clamp(static_cast<double>(value) / whole, 0.0, 1.0) : 0.0;
  };
  return {part(place.x(), control.width()), part(place.y(), control.height())};
}

/// Shift, Ctrl and Alt alone do nothing.
bool holdsOnly(int key) {
  return key == Qt::Key_Shift || key == Qt::Key_Control || key == Qt::Key_Alt || key == Qt::Key_Meta ||
         key == Qt::Key_AltGr;
}

}  // namespace

Recording Recording::read(const std::filesystem::path& file) {
  const JsonNode node = JsonNode::read(file);
  node.requireFormat(format_name, format_version);
  Recording recording;
  recording.demo = textOf(node, "demo");
  recording.language = QString::fromStdString(node.stringOr("language", "en"));
  if (node.has("window")) {
    const std::vector<double> size = node.at("window").numbers();
    if (size.size() != 2 || size[0] < 1.0 || size[1] < 1.0) node.at("window").reject("width and height in pixels");
    recording.window = QSize(static_cast<int>(size[0]), static_cast<int>(size[1]));
  }
  for (const JsonNode& one : node.at("done").items()) recording.done.push_back(interactionOf(one));
  return recording;
}

void Recording::write(const std::filesystem::path& file) const {
  const nlohmann::json head = {{"format", format_name},
                               {"version", format_version},
                               {"demo", demo.toStdString()},
                               {"language", language.toStdString()},
                               {"window", {window.width(), window.height()}}};
  // One line for each thing done.
  std::string text = head.dump(1);
  text.resize(text.rfind('\n'));
  text += ",\n \"done\": [";
  for (std::size_t i = 0; i < done.size(); ++i) text += (i > 0 ? ",\n  " : "\n  ") + toJson(done[i]).dump();
  text += "\n ]\n}\n";
  writeFileAtomically(file, text);
}

Recorder::Recorder(QString demo, QString language, QSize window) {
  recording_.demo = std::move(demo);
  recording_.language = std::move(language);
  recording_.window = window;
  QCoreApplication::instance()->installEventFilter(this);
}

Recorder::~Recorder() {
  QCoreApplication::instance()->removeEventFilter(this);
  if (!later_.isActive()) return;
  try {
    recording_.write(file_);
  } catch (const InputError& e) {
    log(LogLevel::Error, e.what());
  }
}

void Recorder::keepIn(const std::filesystem::path& file) {
  file_ = file;
  recording_.write(file_);
  later_.setSingleShot(true);
  later_.setInterval(200);
  connect(&later_, &QTimer::timeout, this, [this] { recording_.write(file_); });
}

void Recorder::add(const Interaction& one) {
  recording_.done.push_back(one);
  if (!file_.empty()) later_.start();
}

void Recorder::look(const QString& name) {
  finishPress();
  Interaction one;
  one.kind = Kind::Look;
  one.text = name;
  add(one);
}

bool Recorder::goesOn(const QWidget& control, const QEvent& event, QPoint place) {
  const bool on = last_ != nullptr && last_type_ == event.type() && last_place_ == place && control.isAncestorOf(last_);
  last_ = &control;
  last_type_ = event.type();
  last_place_ = place;
  return on;
}

void Recorder::finishPress() {
  if (pressed_) add(*pressed_);
  pressed_.reset();
}

void Recorder::press(QWidget& control, const QMouseEvent& event, Kind kind) {
  finishPress();
  Interaction one;
  one.kind = kind;
  one.control = nameOf(control);
  one.at = partOf(control, event.position().toPoint());
  one.part = partAt(control, event.position().toPoint());
  one.button = event.button();
  one.modifiers = event.modifiers();
  // The first press of two has been told by itself; the second event replaces it.
  if (kind == Kind::DoublePress && !recording_.done.empty() && recording_.done.back().kind == Kind::Press)
    recording_.done.pop_back();
  pressed_ = one;
  pressed_on_ = &control;
  pressed_at_ = event.position().toPoint();
}

void Recorder::release(const QMouseEvent& event) {
  if (!pressed_) return;
  const QPoint place = event.position().toPoint();
  if (pressed_->kind == Kind::Press && (place - pressed_at_).manhattanLength() > still_px && last_ == pressed_on_) {
    pressed_->kind = Kind::Drag;
    pressed_->part.reset();
    pressed_->to = partOf(*last_, place);
  }
  finishPress();
}

void Recorder::key(const QKeyEvent& event) {
  if (holdsOnly(event.key())) return;
  finishPress();
  Interaction one;
  one.kind = Kind::Key;
  one.modifiers = event.modifiers() & (Qt::ShiftModifier | Qt::ControlModifier | Qt::AltModifier);
  const QString text = event.text();
  const bool character = text.size() == 1 && text.front().isPrint() && !one.modifiers.testFlag(Qt::ControlModifier) &&
                         !one.modifiers.testFlag(Qt::AltModifier);
  if (character) {
    one.text = text;
    one.modifiers = Qt::NoModifier;
  } else {
    one.key = event.key();
  }
  add(one);
}

bool Recorder::eventFilter(QObject* watched, QEvent* event) {
  auto* control = qobject_cast<QWidget*>(watched);
  if (control == nullptr) return false;
  switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseButtonRelease: {
      const auto& mouse = static_cast<const QMouseEvent&>(*event);
      if (goesOn(*control, *event, mouse.globalPosition().toPoint())) break;
      if (event->type() == QEvent::MouseButtonRelease)
        release(mouse);
      else
        press(*control, mouse, event->type() == QEvent::MouseButtonPress ? Kind::Press : Kind::DoublePress);
      break;
    }
    case QEvent::Wheel: {
      const auto& wheel = static_cast<const QWheelEvent&>(*event);
      if (goesOn(*control, *event, wheel.globalPosition().toPoint())) break;
      finishPress();
      Interaction one;
      one.kind = Kind::Wheel;
      one.control = nameOf(*control);
      one.at = partOf(*control, wheel.position().toPoint());
      one.steps = wheel.angleDelta().y() / wheel_step_eighths;
      one.modifiers = wheel.modifiers();
      if (one.steps != 0) add(one);
      break;
    }
    // Seen before every key press, also before one that is a shortcut and reaches no control.
    case QEvent::ShortcutOverride:
      if (!goesOn(*control, *event, {})) key(static_cast<const QKeyEvent&>(*event));
      break;
    // A second key of the same kind at the same control is one more.
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
      last_ = nullptr;
      break;
    default:
      break;
  }
  return false;
}

}  // namespace spindrift::gui
