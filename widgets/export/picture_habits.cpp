// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/export/picture_habits.h"

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
#include <QImage>
#include <QKeyEvent>
#include <QMenu>
#include <QMessageBox>
#include <QMouseEvent>
#include <QWidget>
#include <algorithm>

#include "core/base/error.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/preferences.h"
#include "widgets/export/exportable.h"
#include "widgets/image_view/image_view.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/icons.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr int still_pixels = 4;

/// The plot, image or 3D view that a widget is or is a part of; null if there is none.
QWidget* pictureAround(QObject* object) {
  for (auto* widget = qobject_cast<QWidget*>(object); widget != nullptr && !widget->isWindow();
       widget = widget->parentWidget()) {
    if (qobject_cast<Plot*>(widget) != nullptr || qobject_cast<ImageView*>(widget) != nullptr ||
        qobject_cast<View3D*>(widget) != nullptr)
      return widget;
  }
  return nullptr;
}

bool holdsNothing(const QWidget* picture) {
  if (const auto* plot = qobject_cast<const Plot*>(picture)) return plot->empty();
  if (const auto* image = qobject_cast<const ImageView*>(picture)) return image->empty();
  return qobject_cast<const View3D*>(picture)->empty();
}

QImage copyOf(QWidget* picture) {
  if (auto* plot = qobject_cast<Plot*>(picture)) return plot->picture();
  if (const auto* image = qobject_cast<const ImageView*>(picture)) return image->annotated();
  return exportedPicture(qobject_cast<View3D*>(picture));
}

Exportable whatIsSaved(QWidget* picture) {
  const QString name = picture->accessibleName();
  if (auto* plot = qobject_cast<Plot*>(picture)) return exportableOf(name, plot);
  if (const auto* image = qobject_cast<const ImageView*>(picture)) return exportableOf(name, image);
  return exportableOf(name, qobject_cast<View3D*>(picture));
}

void showAllOf(QWidget* picture) {
  if (auto* plot = qobject_cast<Plot*>(picture)) plot->showAll();
  if (auto* image = qobject_cast<ImageView*>(picture)) image->fit();
  if (auto* view = qobject_cast<View3D*>(picture)) view->resetCamera();
}

void putOnClipboard(QWidget* picture) {
  if (!holdsNothing(picture)) QApplication::clipboard()->setImage(copyOf(picture));
}

void saveAsFile(QWidget* picture) {
  const Exportable item = whatIsSaved(picture);
  QStringList filters;
  for (const QString& format : item.formats) filters << QStringLiteral("%1 (*.%2)").arg(format.toUpper(), format);
  const QString kind = QStringLiteral("export");
  constexpr qsizetype longest = 60;
  QString proposed = fileNameOf(item.name.left(longest));
  if (proposed.isEmpty()) proposed = QStringLiteral("picture");
  QString chosen = filters.front();
  QString file =
      QFileDialog::getSaveFileName(picture, PictureHabits::tr("Save the picture"),
                                   QDir(lastFolder(kind)).filePath(proposed + QLatin1Char('.') + item.formats.front()),
                                   filters.join(QStringLiteral(";;")), &chosen);
  if (file.isEmpty()) return;
  const bool known = std::any_of(item.formats.begin(), item.formats.end(), [&](const QString& format) {
    return file.endsWith(QLatin1Char('.') + format, Qt::CaseInsensitive);
  });
  if (!known) file += QLatin1Char('.') + item.formats[std::max<qsizetype>(0, filters.indexOf(chosen))];
  rememberFolder(kind, file);
  try {
    item.write(file);
  } catch (const InputError& e) {
    QMessageBox::warning(picture, PictureHabits::tr("Save the picture"), coreSentence(e.what()));
  }
}

void openPictureMenu(QWidget* picture, const QPoint& at) {
  auto* menu = new QMenu(picture);
  menu->setObjectName(QStringLiteral("pictureMenu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  const auto add = [&](const char* name, const char* icon_name, const QString& text, auto what) {
    QAction* action = menu->addAction(icon(icon_name), text);
    action->setObjectName(QLatin1String(name));
    action->setEnabled(!holdsNothing(picture));
    QObject::connect(action, &QAction::triggered, picture, [picture, what] { what(picture); });
    return action;
  };
  add("copyPicture", "image", PictureHabits::tr("Copy picture"), putOnClipboard)->setShortcut(QKeySequence::Copy);
  add("savePicture", "export", PictureHabits::tr("Save picture as …"), saveAsFile);
  menu->addSeparator();
  add("showAll", "fit-window", PictureHabits::tr("Show all"), showAllOf);
  menu->popup(at);
}

}  // namespace

PictureHabits::PictureHabits(QObject* parent) : QObject(parent) {
  QCoreApplication::instance()->installEventFilter(this);
}

bool PictureHabits::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::ShortcutOverride:
    case QEvent::KeyPress: {
      if (!static_cast<QKeyEvent*>(event)->matches(QKeySequence::Copy)) break;
      QWidget* picture = pictureAround(watched);
      if (picture == nullptr) break;
      if (event->type() == QEvent::KeyPress) putOnClipboard(picture);
      event->accept();
      return true;
    }
    case QEvent::ContextMenu: {
      QWidget* picture = pictureAround(watched);
      if (picture == nullptr || picture->contextMenuPolicy() != Qt::DefaultContextMenu) break;
      const auto* wanted = static_cast<QContextMenuEvent*>(event);
      const bool may_pan = qobject_cast<View3D*>(picture) != nullptr && wanted->reason() == QContextMenuEvent::Mouse;
      if (!may_pan) openPictureMenu(picture, wanted->globalPos());
      return true;
    }
    case QEvent::MouseButtonPress:
    case QEvent::MouseMove:
    case QEvent::MouseButtonRelease: {
      auto* view = qobject_cast<View3D*>(watched);
      if (view == nullptr) break;
      const auto* mouse = static_cast<QMouseEvent*>(event);
      const QPoint place = mouse->globalPosition().toPoint();
      right_moved_ = right_moved_ || (place - right_pressed_at_).manhattanLength() > still_pixels;
      if (mouse->button() != Qt::RightButton) break;
      if (event->type() == QEvent::MouseButtonPress) {
        right_pressed_at_ = place;
        right_moved_ = false;
      } else if (!right_moved_) {
        openPictureMenu(view, place);
      }
      break;
    }
    default:
      break;
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace spindrift::gui
