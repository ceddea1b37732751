// SPDX-License-Identifier: GPL-3.0-or-later
// The list of touches of the campaign at hand, in memory and shared by the pages of probing. It is read in the
// background: a million touches take seconds.
#pragma once

#include <QObject>
#include <memory>
#include <string>

#include "core/probing/evaluate_touches.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

class JobRunner;

class TouchResults : public QObject {
  Q_OBJECT
 public:
  /// The one that belongs to the session.
  [[nodiscard]] static TouchResults& of(SessionModel& session, JobRunner& jobs);

  /// Touches to be shown: as they stand in the list, or stood in it before those came that are being read now. Null
  /// while they are read for the first time, which this begins (`read` tells the end), and if the list cannot be read.
  [[nodiscard]] std::shared_ptr<const TouchList> touches();
  /// Touches to be worked on: as they stand in the list. Null while that is being read: then the work reads it.
  [[nodiscard]] std::shared_ptr<const TouchList> asListed();
  [[nodiscard]] bool reading() const { return reading_; }
  /// Why there are none, in a sentence: they are being read, cannot be read, or there is no list.
  [[nodiscard]] QString whyNone() const;

 Q_SIGNALS:
  void read();

 private:
  TouchResults(SessionModel& session, JobRunner& jobs);
  void follow();  ///< forgets what belongs to another campaign
  void begin(const std::filesystem::path& file);

  SessionModel& session_;
  JobRunner& jobs_;
  std::int64_t campaign_ = -1;
  std::string folder_;
  int generation_ = 0;
  bool listed_ = false;  ///< touches_ is the list of this generation
  bool reading_ = false;
  int asked_ = 0;  ///< times that it was begun to be read
  std::shared_ptr<const TouchList> touches_;
  QString failure_;
};

/// The artefact of the machine that the touches are on, else its first; null if it has none.
[[nodiscard]] const Artefact* artefactOf(const Campaign& campaign, const TouchList* touches);

}  // namespace spindrift::gui
