// SPDX-License-Identifier: GPL-3.0-or-later
// The touches of the campaign at hand and their evaluation, in memory and shared by the pages of probing. What is
// stored in the session is the result with its provenance; this is the detail behind it, worked out again when a
// session is opened (some 0.1 s).
#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <string>

#include "core/probing/evaluate_touches.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

class TouchResults : public QObject {
  Q_OBJECT
 public:
  /// The one that belongs to the session.
  [[nodiscard]] static TouchResults& of(SessionModel& session);

  /// Touches as they stand in the list; null (and a sentence) if the list cannot be read.
  [[nodiscard]] std::shared_ptr<const TouchList> touches();
  [[nodiscard]] const QString& failure() const { return failure_; }
  /// The last evaluation of this campaign, whether inputs have changed since or not; null if there is none in memory.
  [[nodiscard]] std::shared_ptr<const TouchEvaluation> last();
  /// True if the last evaluation is that of the inputs as they are now.
  [[nodiscard]] bool current();
  /// Keeps an evaluation of the inputs that `key` names; of inputs that are no more, nothing.
  void set(const std::string& key, std::shared_ptr<const TouchEvaluation> evaluation);
  /// Names the inputs as they are now: campaign, exclusions, machine.
  [[nodiscard]] std::string key() const;

 private:
  explicit TouchResults(SessionModel& session);
  void follow();  ///< forgets what belongs to another campaign

  SessionModel& session_;
  std::int64_t campaign_ = -1;
  std::string folder_;
  int generation_ = 0;
  std::shared_ptr<const TouchList> touches_;
  QString failure_;
  std::string evaluated_key_;
  std::shared_ptr<const TouchEvaluation> evaluation_;
};

/// The artefact of the machine that the touches are on, else its first; null if it has none.
[[nodiscard]] const Artefact* artefactOf(const Campaign& campaign, const TouchList* touches);

}  // namespace spindrift::gui
