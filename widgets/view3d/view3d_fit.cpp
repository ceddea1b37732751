// SPDX-License-Identifier: GPL-3.0-or-later
// How the 3D view fits what it shows into its pane: as large as it gets, beside colour bar, notes, numbers and buttons.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "widgets/theme/fonts.h"
#include "widgets/view3d/overlay.h"
#include "widgets/view3d/scene.h"
#include "widgets/view3d/view3d.h"
#include "widgets/view3d/view_tools.h"

namespace spindrift::gui {
namespace {

/// Around what is shown, so that it does not touch the edge.
constexpr double air_px = 12;
/// The travels of the machine stand beside it.
constexpr double motion_label_px = 26;
/// Numbers and titles of the axes of a surface.
constexpr double surface_axis_px = 56;
/// Of the height at most this is left to the notes.
constexpr double most_for_notes = 0.35;
/// By so much at most a map gets smaller for the axes in the corner.
constexpr double most_for_axes = 1.12;
/// Panes narrower than this are too small for a colour bar with a place of its own.
constexpr int narrow_px = 200;
constexpr int least_for_bar_below_px = 220;

}  // namespace

QMarginsF View3D::marginsFor(const QSize& size, const Arrangement& arrangement) const {
  const double air = bodies_ && machine_visible_ ? motion_label_px : air_px;
  QMarginsF margins(air, air, air, air);
  if (surface_) {
    const double below = std::min(surface_axis_px, 0.18 * size.height());
    margins = QMarginsF(surface_axis_px, 2 * air, surface_axis_px, below);
  }
  if (showsScale() && size.width() > narrow_px) {
    if (arrangement.bar_below) {
      margins.setBottom(margins.bottom() + colourBarHeight());
    } else {
      margins.setRight(std::max(margins.right(), colourBarWidth(*scale_)));
    }
  }
  return margins;
}

QRectF View3D::placeOfNotes(const QSize& size, const Arrangement& arrangement) const {
  const double bar = showsScale() && !arrangement.bar_below ? colourBarWidth(*scale_) : 0.0;
  const double room = size.width() - 48 - bar;
  return notesPanel(wrappedNotes(notes(size), room, size.height()), room);
}

Camera View3D::cameraFor(const QSize& size, const Arrangement& arrangement) const {
  const auto box = *extent();
  const QSizeF pane(size);
  const QMarginsF margins = marginsFor(size, arrangement);
  Camera camera = camera_;
  camera.fit(box.first, box.second, pane, margins);
  // The numbers along the table have their room where they stand, and only there.
  QMarginsF labels;
  for (int pass = 0; pass < 2 && bodies_ && !machine_visible_; ++pass) {
    const QRectF seen = camera.frame(box.first, box.second, pane);
    QRectF with_labels = seen;
    for (const OverlayText& text : tableScale(camera, pane, *bodies_)) with_labels |= text.box;
    labels = QMarginsF(seen.left() - with_labels.left(), seen.top() - with_labels.top(),
                       with_labels.right() - seen.right(), with_labels.bottom() - seen.bottom());
    camera.fit(box.first, box.second, pane, margins + labels);
  }
  // Notes and buttons move it only where they would cover it.
  const QRectF notes_panel = placeOfNotes(size, arrangement);
  QMarginsF taken = margins + labels;
  QRectF seen = camera.frame(box.first, box.second, pane).marginsAdded(labels);
  const auto fitBesideNotes = [&] {
    if (seen.intersects(notes_panel)) {
      const double below = std::min(notes_panel.bottom(), most_for_notes * pane.height()) + sizes::half_step;
      taken.setTop(std::max(taken.top(), below + labels.top()));
      camera.fit(box.first, box.second, pane, taken);
    }
    seen = camera.frame(box.first, box.second, pane).marginsAdded(labels);
  };
  fitBesideNotes();
  const QMarginsF tools = fitting_for_picture_ ? QMarginsF() : tools_->margins(arrangement.tools_in_column);
  const bool move_the_bar = showsScale() && (arrangement.bar_below || tools.right() > 0.0);
  if (!tools.isNull() && (move_the_bar || seen.intersects(tools_->place(arrangement.tools_in_column)))) {
    taken += tools;
    camera.fit(box.first, box.second, pane, taken);
    seen = camera.frame(box.first, box.second, pane).marginsAdded(labels);
    fitBesideNotes();  // from which the buttons may have pushed it
  }
  // A map stands beside the axes in the corner, or above them, where that costs it little.
  const QRectF axes = triadPlace(QRectF(QPointF(0, 0), pane), camera);
  if (bodies_ && !machine_visible_ && !surface_ && seen.intersects(axes)) {
    std::optional<Camera> clear;
    for (const bool beside : {true, false}) {
      QMarginsF more = taken;
      if (beside) {
        more.setLeft(std::max(more.left(), axes.right() + labels.left()));
      } else {
        more.setBottom(std::max(more.bottom(), pane.height() - axes.top() + labels.bottom()));
      }
      Camera moved = camera;
      moved.fit(box.first, box.second, pane, more);
      if (camera.frame(box.first, box.second, pane).marginsAdded(labels).intersects(notes_panel) !=
          moved.frame(box.first, box.second, pane).marginsAdded(labels).intersects(notes_panel))
        continue;
      if (!clear || moved.half_height_mm < clear->half_height_mm) clear = moved;
    }
    if (clear && clear->half_height_mm < most_for_axes * camera.half_height_mm) camera = *clear;
  }
  return camera;
}

void View3D::fitCamera(const QSize& size) {
  const auto box = scene_->bounds();
  // A view that joins others which show the same machine looks as these do.
  for (const QPointer<View3D>& other : linked_) {
    if (other == nullptr || !other->fitted_ || !other->isVisible() || other->scene_ == nullptr || !box) continue;
    const auto theirs = other->scene_->bounds();
    if (!theirs || other->camera_.vertical != camera_.vertical) continue;
    if ((theirs->first - box->first).norm() + (theirs->second - box->second).norm() > 1.0) continue;
    // Where nobody has turned it, it is of another size as long as the layout has not come to it.
    if (other->camera_ == other->automatic_ && other->automatic_for_ != size) continue;
    automatic_ = camera_ = other->camera_;
    automatic_for_ = other->automatic_for_;
    arrangement_ = other->arrangement_;
    fitted_beside_ = placeOfNotes(size, arrangement_);
    fitted_ = true;
    return;
  }
  if (!extent()) return;
  // Of the arrangements that the pane has room for, the one that shows most.
  std::vector<Arrangement> arrangements{{}};
  if (showsScale() && size.height() >= least_for_bar_below_px) arrangements.push_back({true, false});
  if (!fitting_for_picture_ && tools_->columnFits()) arrangements.push_back({false, true});
  std::vector<Camera> cameras;
  for (const Arrangement& arrangement : arrangements) cameras.push_back(cameraFor(size, arrangement));
  std::size_t best = 0;
  for (std::size_t i = 1; i < cameras.size(); ++i)
    if (cameras[i].half_height_mm < 0.97 * cameras[best].half_height_mm) best = i;
  camera_ = cameras[best];
  arrangement_ = arrangements[best];
  automatic_ = camera_;
  automatic_for_ = size;
  fitted_beside_ = placeOfNotes(size, arrangement_);
  fitted_ = true;
  if (!fitting_for_picture_) tools_->arrangeSoon();
  // Linked views that nobody has turned yet look at the same.
  for (const QPointer<View3D>& other : linked_) {
    if (other == nullptr || other->fitted_) continue;
    other->setCamera(camera_);
    other->automatic_ = camera_;
    other->automatic_for_ = size;
    other->arrangement_ = arrangement_;
  }
}

}  // namespace spindrift::gui
