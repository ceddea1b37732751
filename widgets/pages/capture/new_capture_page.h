// SPDX-License-Identifier: GPL-3.0-or-later
// Step Capture of a new measurement: choose the instrument, make the plan, watch the folder or open the camera. With
// the first capture the page of the instrument takes its place, and capturing goes on.
#pragma once

#include "widgets/pages/page.h"

class QTabWidget;

namespace spindrift::gui {

class ArrivingPanel;
class CameraPanel;
class Segments;

class NewCapturePage : public Page {
  Q_OBJECT
 public:
  explicit NewCapturePage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] ArrivingPanel* arriving() const { return arriving_; }
  [[nodiscard]] CameraPanel* camera() const { return camera_; }
  void setInstrument(Instrument instrument);

 private:
  QTabWidget* tabs_;
  Segments* instrument_;
  ArrivingPanel* arriving_;
  CameraPanel* camera_;
};

}  // namespace spindrift::gui
