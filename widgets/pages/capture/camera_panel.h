// SPDX-License-Identifier: GPL-3.0-or-later
// A camera live: picture with what is decoded on top, sharpness over time, and a button that takes the picture.
#pragma once

#include <QTimer>
#include <QWidget>
#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "core/connect/genicam_camera.h"
#include "core/imaging/capture_verdict.h"
#include "widgets/pages/page.h"

class QLineEdit;

namespace spindrift::gui {

class ImageView;
class IncomingService;
class NumberTile;
class Plot;

class CameraPanel : public QWidget {
  Q_OBJECT
 public:
  explicit CameraPanel(PageContext context, QWidget* parent = nullptr);
  ~CameraPanel() override;
  /// Opens a device number, a file or an address; the state says what is wrong with it.
  void open(const QString& source);
  void close();
  /// Hands the picture shown to the capture: checked and taken over as a file is.
  void take();
  [[nodiscard]] bool running() const { return reader_.joinable() && !ended_; }
  [[nodiscard]] int frames() const { return shown_frames_; }
  [[nodiscard]] const CaptureVerdict& verdict() const { return verdict_; }
  [[nodiscard]] Callout* state() const { return state_; }
  [[nodiscard]] Plot* sharpness() const { return plot_; }
  [[nodiscard]] ImageView* view() const { return view_; }

 Q_SIGNALS:
  void frameShown();

 protected:
  void hideEvent(QHideEvent* event) override;

 private:
  struct Frame {
    std::shared_ptr<const GrayImage> image;
    CaptureVerdict verdict;
  };
  [[nodiscard]] GenicamSettings settingsOf(const std::string& source) const;
  void readFrames(std::stop_token stop, const std::string& source, const GenicamSettings& settings);
  void showLatest();

  PageContext context_;
  std::shared_ptr<const FiducialPattern> pattern_;  ///< of the campaign, when the camera was opened
  IncomingService& service_;
  QLineEdit* source_;
  QPushButton* open_;
  QPushButton* take_;
  Callout* state_;
  ImageView* view_;
  NumberTile* sharp_;
  NumberTile* best_;
  NumberTile* decoded_;
  Plot* plot_;
  QTimer poll_;
  std::deque<double> history_;
  double peak_ = 0.0;
  int shown_frames_ = 0;
  std::shared_ptr<const GrayImage> image_;
  CaptureVerdict verdict_;
  std::mutex mutex_;
  std::optional<Frame> latest_;  ///< guarded
  QString failure_;              ///< guarded
  std::atomic<bool> ended_ = false;
  std::jthread reader_;
};

}  // namespace spindrift::gui
