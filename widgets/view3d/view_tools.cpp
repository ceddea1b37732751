// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/view_tools.h"

#include <QAction>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QMenu>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "widgets/theme/icons.h"
#include "widgets/theme/theme.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr int margin_px = 8;
constexpr int triad_px = 100;  ///< the axes at the bottom left
constexpr int least_height_px = 300;
constexpr int low_px = 200;
constexpr int slider_steps = 200;
constexpr int frame_px = 2;

QToolButton* makeToolButton(QWidget* parent, const char* icon_name, const QString& name) {
  auto* button = new QToolButton(parent);
  button->setIcon(icon(icon_name));
  button->setIconSize(QSize(sizes::icon, sizes::icon));
  button->setAccessibleName(name);
  button->setToolTip(name);
  return button;
}

}  // namespace

ViewTools::ViewTools(View3D* view) : QFrame(view), view_(view) {
  setRole(this, "card");
  setAccessibleName(tr("View"));
  line_ = new QBoxLayout(QBoxLayout::LeftToRight, this);
  line_->setContentsMargins(frame_px, frame_px, frame_px, frame_px);
  line_->setSpacing(0);
  const auto look = [this](const char* icon_name, const QString& text, const QString& key, StandardView direction) {
    connect(add(icon_name, text, key), &QAction::triggered, this, [this, direction] { view_->resetCamera(direction); });
  };
  look("view-front", tr("Front"), QStringLiteral("3"), StandardView::Front);
  look("view-top", tr("Top"), QStringLiteral("2"), StandardView::Top);
  look("view-right", tr("Right"), QStringLiteral("4"), StandardView::Right);
  look("cube", tr("Isometric"), QStringLiteral("1"), StandardView::Isometric);
  connect(add("fit-window", tr("Fit"), QStringLiteral("R")), &QAction::triggered, view_, &View3D::fit);
  perspective_ = add("perspective", tr("Perspective"), QStringLiteral("P"), true);
  connect(perspective_, &QAction::triggered, this, [this](bool on) { view_->setOrthographic(!on); });
  measure_ = add("ruler", tr("Measure a distance"), QStringLiteral("M"), true);
  connect(measure_, &QAction::triggered, view_, &View3D::setMeasuring);
  clip_ = add("section", tr("Clip plane"), QStringLiteral("C"), true);
  connect(clip_, &QAction::triggered, view_, &View3D::setClipping);
  for (QToolButton* button : buttons_) line_->addWidget(button);
  buttons_.front()->setFocusPolicy(Qt::TabFocus);

  menu_button_ = makeToolButton(view_, "cube", tr("View"));
  menu_button_->setAutoFillBackground(true);
  menu_button_->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(menu_button_);
  for (QAction* action : actions_) menu->addAction(action);
  menu_button_->setMenu(menu);

  clip_panel_ = new QFrame(view_);
  setRole(clip_panel_, "card");
  auto* line = new QHBoxLayout(clip_panel_);
  line->setContentsMargins(2, 2, 2, 2);
  clip_axis_ = makeToolButton(clip_panel_, "section", tr("Axis the clip plane stands across"));
  clip_axis_->setToolButtonStyle(Qt::ToolButtonTextOnly);
  clip_at_ = new QSlider(Qt::Horizontal, clip_panel_);
  clip_at_->setRange(0, slider_steps);
  clip_at_->setFixedWidth(160);
  clip_at_->setAccessibleName(tr("Place of the clip plane"));
  clip_side_ = makeToolButton(clip_panel_, "flip", tr("Keep the other side"));
  for (QWidget* part :
       {static_cast<QWidget*>(clip_axis_), static_cast<QWidget*>(clip_at_), static_cast<QWidget*>(clip_side_)})
    line->addWidget(part);
  connect(clip_at_, &QSlider::valueChanged, this, &ViewTools::sendClip);
  connect(clip_side_, &QToolButton::clicked, this, [this] {
    keep_low_ = !keep_low_;
    sendClip();
  });
  connect(clip_axis_, &QToolButton::clicked, this, [this] {
    axis_ = (axis_ + 1) % 3;
    const QSignalBlocker quiet(clip_at_);
    clip_at_->setValue(slider_steps / 2);
    setClipRange();
    sendClip();
  });
  hide();
  menu_button_->hide();
  clip_panel_->hide();
}

QAction* ViewTools::add(const char* icon_name, const QString& text, const QString& key, bool checkable) {
  auto* action = new QAction(icon(icon_name), text, this);
  action->setCheckable(checkable);
  action->setToolTip(tr("%1 (%2)").arg(text, key));
  actions_.push_back(action);
  QToolButton* button = makeToolButton(this, icon_name, text);
  button->setDefaultAction(action);
  button->setFocusPolicy(Qt::NoFocus);
  button->setProperty("arrowKeys", true);
  button->installEventFilter(this);
  buttons_.push_back(button);
  return action;
}

bool ViewTools::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    const bool back = key == Qt::Key_Left || key == Qt::Key_Up;
    if (back || key == Qt::Key_Right || key == Qt::Key_Down) {
      moveFocus(back ? -1 : 1);
      return true;
    }
  }
  return QFrame::eventFilter(watched, event);
}

void ViewTools::moveFocus(int step) {
  const auto now = std::find_if(buttons_.begin(), buttons_.end(),
                                [](const QToolButton* b) { return b->focusPolicy() == Qt::TabFocus; });
  const auto count = static_cast<std::ptrdiff_t>(buttons_.size());
  QToolButton* next = buttons_[static_cast<std::size_t>(((now - buttons_.begin()) + step + count) % count)];
  next->setFocusPolicy(Qt::TabFocus);
  next->setFocus(Qt::TabFocusReason);
  (*now)->setFocusPolicy(Qt::NoFocus);
}

QSize ViewTools::openSize(bool in_column) const {
  const int length = static_cast<int>(buttons_.size()) * sizes::control_height + 2 * frame_px;
  const int width = sizes::control_height + 2 * frame_px;
  return in_column ? QSize(width, length) : QSize(length, width);
}

bool ViewTools::isOpen() const {
  return view_->width() >= openSize(false).width() + triad_px + margin_px && view_->height() >= least_height_px;
}

bool ViewTools::columnFits() const {
  return isOpen() && view_->height() >= openSize(true).height() + 2 * margin_px;
}

QRectF ViewTools::place(bool in_column) const {
  const QSizeF size = isOpen() ? QSizeF(openSize(in_column)) : QSizeF(sizes::control_height, sizes::control_height);
  return {QPointF(view_->width() - size.width() - margin_px, view_->height() - size.height() - margin_px), size};
}

QMarginsF ViewTools::margins(bool in_column) const {
  if (view_->empty()) return {};
  const QRectF taken = place(in_column);
  // Beside a low picture, below others.
  if (in_column || taken.top() < low_px) return {0, 0, view_->width() - taken.left(), 0};
  return {0, 0, 0, view_->height() - taken.top()};
}

void ViewTools::arrangeSoon() {
  QMetaObject::invokeMethod(this, &ViewTools::arrange, Qt::QueuedConnection);
}

void ViewTools::arrange() {
  const bool shown = !view_->empty() && view_->failure().isEmpty();
  const bool in_column = view_->arrangement().tools_in_column && columnFits();
  setVisible(shown && isOpen());
  menu_button_->setVisible(shown && !isOpen());
  line_->setDirection(in_column ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
  QWidget* here = isOpen() ? static_cast<QWidget*>(this) : menu_button_;
  here->setGeometry(place(in_column).toRect());
  here->raise();
  clip_panel_->setVisible(shown && view_->clip().has_value());
  clip_panel_->adjustSize();
  const int right = in_column ? here->x() - 4 : view_->width() - margin_px;
  const int bottom = in_column ? view_->height() - margin_px : here->y() - 4;
  clip_panel_->move(std::max(0, right - clip_panel_->width()), bottom - clip_panel_->height());
  clip_panel_->raise();
}

void ViewTools::refresh() {
  perspective_->setChecked(!view_->camera().orthographic);
  measure_->setChecked(view_->measuring());
  const bool clipped = view_->clip().has_value();
  clip_->setChecked(clipped);
  if (clipped) {
    axis_ = view_->clip()->axis;
    keep_low_ = view_->clip()->keep_low;
    setClipRange();
    const QSignalBlocker quiet(clip_at_);
    const double share = (view_->clip()->offset_mm - clip_low_mm_) / (clip_high_mm_ - clip_low_mm_);
    clip_at_->setValue(static_cast<int>(std::lround(share * slider_steps)));
    clip_axis_->setText(QString(QLatin1Char("XYZ"[axis_])));
  }
  arrange();
}

void ViewTools::setClipRange() {
  const auto box = view_->extent();
  if (!box) return;
  clip_low_mm_ = box->first[axis_];
  clip_high_mm_ = std::max(box->second[axis_], clip_low_mm_ + 1e-6);
}

void ViewTools::sendClip() {
  view_->setClip(
      ClipPlane{axis_, clip_low_mm_ + (clip_high_mm_ - clip_low_mm_) * clip_at_->value() / slider_steps, keep_low_});
}

}  // namespace spindrift::gui
