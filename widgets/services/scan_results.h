// SPDX-License-Identifier: GPL-3.0-or-later
// The evaluation of the scans of the campaign at hand, in memory and shared by the pages of scanning: the detail behind
// the stored result, worked out again when a session is opened.
#pragma once

#include <QObject>
#include <map>
#include <memory>
#include <string>

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
  /// The last evaluation under a scan model, whether inputs have changed since or not; null if there is none.
  [[nodiscard]] std::shared_ptr<const ScanEvaluation> last(const std::string& scan_model);
  /// True if that evaluation is one of the inputs as they are now.
  [[nodiscard]] bool current(const std::string& scan_model);
  /// Keeps an evaluation of the inputs that `key` names; of inputs that are no more, nothing.
  void set(const std::string& key, const std::string& scan_model, std::shared_ptr<const ScanEvaluation> evaluation);
  /// Names the inputs as they are now.
  [[nodiscard]] std::string key() const;
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
  struct Evaluated {
    std::string key;
    std::shared_ptr<const ScanEvaluation> evaluation;
  };
  std::map<std::string, Evaluated> evaluations_;  ///< by scan model
};

}  // namespace spindrift::gui
