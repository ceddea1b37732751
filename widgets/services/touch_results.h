// SPDX-License-Identifier: GPL-3.0-or-later
// The list of touches of the campaign at hand, in memory and shared by the pages of probing.
#pragma once

#include <QObject>
#include <memory>
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

 private:
  explicit TouchResults(SessionModel& session);
  void follow();  ///< forgets what belongs to another campaign

  SessionModel& session_;
  std::int64_t campaign_ = -1;
  std::string folder_;
  int generation_ = 0;
  std::shared_ptr<const TouchList> touches_;
  QString failure_;
};

/// The artefact of the machine that the touches are on, else its first; null if it has none.
[[nodiscard]] const Artefact* artefactOf(const Campaign& campaign, const TouchList* touches);

}  // namespace spindrift::gui
