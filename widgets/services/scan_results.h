// SPDX-License-Identifier: GPL-3.0-or-later
// The list of scans of the campaign at hand, in memory and shared by the pages of scanning.
#pragma once

#include <QObject>
#include <string>
#include <vector>

#include "core/scanning/scan_evaluation.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

class ScanResults : public QObject {
  Q_OBJECT
 public:
  /// The one that belongs to the session.
  [[nodiscard]] static ScanResults& of(SessionModel& session);
  /// The scans of the list; empty with a sentence in `failure` if it cannot be read.
  [[nodiscard]] const std::vector<ScanCapture>& captures();
  [[nodiscard]] const QString& failure() const { return failure_; }
  /// The scan model of machine.json: "rigid" or "push_broom".
  [[nodiscard]] std::string modelOfMachine() const;

 private:
  explicit ScanResults(SessionModel& session);
  void follow();

  SessionModel& session_;
  std::string folder_;
  int generation_ = 0;
  bool read_ = false;
  std::vector<ScanCapture> captures_;
  QString failure_;
};

}  // namespace spindrift::gui
