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
#include "widgets/panels/page_context.h"

class QLineEdit;
class QPushButton;

namespace spindrift::gui {

class Callout;
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
  [[nodiscard]] bool running() const { return reading_ != nullptr && !reading_->ended; }
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
  /// One camera from opening to closing, with the thread that reads it and knows nothing else of the panel.
  struct Reading {
    std::shared_ptr<const FiducialPattern> pattern;  ///< of the campaign, when the camera was opened
    std::mutex mutex;
    std::optional<Frame> latest;  ///< guarded
    QString failure;              ///< guarded
    std::atomic<bool> ended = false;
    std::jthread thread;  ///< last: joined before the rest goes

    void read(std::stop_token stop, const std::string& source, const GenicamSettings& settings);
  };
  [[nodiscard]] GenicamSettings settingsOf(const std::string& source) const;
  void showLatest();

  PageContext context_;
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
  std::unique_ptr<Reading> reading_;
  /// The one before, which may be waiting for a picture still: the next one to be opened waits for it.
  std::unique_ptr<Reading> closing_;
};

}  // namespace spindrift::gui
