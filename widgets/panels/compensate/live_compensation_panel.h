// SPDX-License-Identifier: GPL-3.0-or-later
// The compensator while data come: its prediction beside what is measured, over the last hour.
#pragma once

#include <QElapsedTimer>
#include <QWidget>
#include <cstdint>
#include <memory>
#include <string>

namespace spindrift {
class LiveCompensation;
}

namespace spindrift::gui {

class Callout;
class ConnectionsService;
class NumberTile;
class Plot;
class SessionModel;

class LiveCompensationPanel : public QWidget {
  Q_OBJECT
 public:
  explicit LiveCompensationPanel(SessionModel& session, QWidget* parent = nullptr);
  ~LiveCompensationPanel() override;
  void refresh();
  [[nodiscard]] Plot* plot() const { return plot_; }
  [[nodiscard]] Callout* state() const { return state_; }
  [[nodiscard]] NumberTile* prediction() const { return prediction_; }
  [[nodiscard]] NumberTile* measurement() const { return measurement_; }

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  /// The compensator of the model that is stored now; null, and a sentence, if there is none.
  LiveCompensation* compensator();
  void showValues();

  SessionModel& session_;
  ConnectionsService& service_;
  std::unique_ptr<LiveCompensation> compensator_;
  std::int64_t model_ = 0;
  std::int64_t visit_ = -1;
  std::string problem_;  ///< why the model cannot be run
  bool good_enough_ = true;
  QElapsedTimer since_shown_;
  Callout* state_;
  NumberTile* prediction_;
  NumberTile* measurement_;
  NumberTile* remainder_;
  Plot* plot_;
};

}  // namespace spindrift::gui
