// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/recording/control_name.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QApplication>
#include <QLabel>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QTabBar>

namespace spindrift::gui {
namespace {

QString plain(QString text) {
  text.remove(QLatin1Char('&'));
  return text.simplified();
}

QString className(const QWidget& widget) {
  return QString::fromLatin1(widget.metaObject()->className()).section(QStringLiteral("::"), -1);
}

QString fullName(const QWidget& control) {
  return QStringLiteral("%1 %2").arg(className(control), labelOf(control)).trimmed();
}

QString windowOf(const QWidget& control) {
  const QWidget* window = control.window();
  return qobject_cast<const QMainWindow*>(window) != nullptr ? QString() : className(*window);
}

/// The view whose viewport this is.
QAbstractItemView* viewOf(const QWidget& viewport) {
  auto* view = qobject_cast<QAbstractItemView*>(viewport.parentWidget());
  return view != nullptr && view->viewport() == &viewport ? view : nullptr;
}

QAction* entryAt(const QWidget& control, QPoint at) {
  if (const auto* menu = qobject_cast<const QMenu*>(&control)) return menu->actionAt(at);
  if (const auto* bar = qobject_cast<const QMenuBar*>(&control)) return bar->actionAt(at);
  return nullptr;
}

/// Visible controls of that name in all windows of that class.
std::vector<QWidget*> visibleOf(const QString& window, const QString& name) {
  std::vector<QWidget*> found;
  for (QWidget* top : QApplication::topLevelWidgets()) {
    if (!top->isVisible() || windowOf(*top) != window) continue;
    if (fullName(*top) == name) found.push_back(top);
    for (auto* control : top->findChildren<QWidget*>()) {
      if (control->window() == top && control->isVisible() && fullName(*control) == name) found.push_back(control);
    }
  }
  return found;
}

}  // namespace

QString labelOf(const QWidget& control) {
  QString label;
  if (const auto* button = qobject_cast<const QAbstractButton*>(&control)) label = plain(button->text());
  if (const auto* text = qobject_cast<const QLabel*>(&control); text != nullptr && label.isEmpty())
    label = plain(text->text());
  if (const QAbstractItemView* view = viewOf(control)) return labelOf(*view);
  if (label.isEmpty()) label = plain(control.accessibleName());
  return label.isEmpty() && !control.objectName().startsWith(QLatin1String("qt_")) ? control.objectName() : label;
}

ControlName nameOf(const QWidget& control) {
  ControlName name{windowOf(control), fullName(control), 0};
  for (const QWidget* other : visibleOf(name.window, name.name)) {
    if (other == &control) break;
    ++name.number;
  }
  return name;
}

QWidget* findControl(const ControlName& name) {
  const std::vector<QWidget*> found = visibleOf(name.window, name.name);
  return static_cast<std::size_t>(name.number) < found.size() ? found[static_cast<std::size_t>(name.number)] : nullptr;
}

std::optional<PartOfControl> partAt(const QWidget& control, QPoint at) {
  if (const QAction* entry = entryAt(control, at)) return PartOfControl{plain(entry->text())};
  if (const auto* tabs = qobject_cast<const QTabBar*>(&control); tabs != nullptr && tabs->tabAt(at) >= 0)
    return PartOfControl{plain(tabs->tabText(tabs->tabAt(at)))};
  if (const QAbstractItemView* view = viewOf(control)) {
    const QModelIndex index = view->indexAt(at);
    if (index.isValid()) return PartOfControl{QString(), index.row(), index.column()};
  }
  return std::nullopt;
}

std::optional<QPoint> placeOf(QWidget& control, const PartOfControl& part) {
  for (QAction* entry : control.actions()) {
    if (part.row >= 0 || plain(entry->text()) != part.label || !entry->isVisible()) continue;
    if (const auto* menu = qobject_cast<QMenu*>(&control)) return menu->actionGeometry(entry).center();
    if (const auto* bar = qobject_cast<QMenuBar*>(&control)) return bar->actionGeometry(entry).center();
  }
  if (const auto* tabs = qobject_cast<QTabBar*>(&control)) {
    for (int i = 0; i < tabs->count(); ++i)
      if (plain(tabs->tabText(i)) == part.label) return tabs->tabRect(i).center();
  }
  if (QAbstractItemView* view = viewOf(control); view != nullptr && view->model() != nullptr) {
    const QModelIndex index = view->model()->index(part.row, part.column, view->rootIndex());
    if (!index.isValid()) return std::nullopt;
    view->scrollTo(index);
    return view->visualRect(index).center();
  }
  return std::nullopt;
}

}  // namespace spindrift::gui
