// SPDX-License-Identifier: GPL-3.0-or-later
// A check of the measurement against the resolution of the axes: jogs of one fiducial, or the same positions measured
// again in the cold state (core/imaging/jog_validation.h). Instruction, button, verdict, table.
#pragma once

#include <QWidget>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/imaging/jog_validation.h"
#include "widgets/models/rows_model.h"
#include "widgets/services/from_observations.h"

class QPushButton;

namespace spindrift::gui {

class Callout;
class SessionModel;

class ResolutionCheckPanel : public QWidget {
  Q_OBJECT
 public:
  /// `task`: "check-jogs" or "check-repeatability"; `check` runs it.
  ResolutionCheckPanel(SessionModel& session, const QString& instruction, const QString& button, std::string task,
                       std::function<void()> check, QWidget* parent = nullptr);
  /// Shows what the session holds.
  void refresh();
  [[nodiscard]] QPushButton* button() const { return button_; }
  [[nodiscard]] Callout* verdict() const { return verdict_; }
  [[nodiscard]] RowsModel* rows() const { return rows_; }

 private:
  SessionModel& session_;
  std::string task_;
  QPushButton* button_;
  Callout* verdict_;
  RowsModel* rows_;
  FromObservations<std::size_t> states_;  ///< how many there are
};

/// The stored result of such a task, its verdict in the callout; nothing where there is none. Of an outdated one the
/// callout says what has changed.
std::optional<ResolutionCheck> showResolutionCheck(const SessionModel& session, const std::string& task,
                                                   Callout& verdict);

}  // namespace spindrift::gui
