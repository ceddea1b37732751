// SPDX-License-Identifier: GPL-3.0-or-later
// A check of the measurement against the resolution of the axes: jogs of one fiducial, or the same positions measured
// again in the cold state (core/imaging/jog_validation.h). Instruction, button, verdict, table.
#pragma once

#include <QWidget>

#include "core/imaging/jog_validation.h"

class QPushButton;

namespace spindrift::gui {

class Callout;
class RowsModel;
class SessionModel;

class ResolutionCheckPanel : public QWidget {
  Q_OBJECT
 public:
  /// `part`: limit as a part of the axis resolution. `kind`: name of the result in the session.
  ResolutionCheckPanel(SessionModel& session, const QString& instruction, const QString& button, double part,
                       std::string kind, QWidget* parent = nullptr);
  void refresh();
  void check();
  [[nodiscard]] QPushButton* button() const { return button_; }
  [[nodiscard]] Callout* verdict() const { return verdict_; }
  [[nodiscard]] RowsModel* rows() const { return rows_; }

 private:
  void show(const ResolutionCheck& check);

  SessionModel& session_;
  double part_;
  std::string kind_;
  QPushButton* button_;
  Callout* verdict_;
  RowsModel* rows_;
};

}  // namespace spindrift::gui
