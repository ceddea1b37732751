// SPDX-License-Identifier: GPL-3.0-or-later
// Offsets between the clocks of logger and instruments: entered, or estimated from a motion that both saw; every result
// depends on them.
#pragma once

#include <QWidget>
#include <cstdint>
#include <functional>
#include <set>
#include <string>

#include "core/base/job_context.h"
#include "widgets/services/from_observations.h"

class QComboBox;
class QDoubleSpinBox;
class QPushButton;

namespace spindrift::gui {

class Callout;
class CampaignUndo;
class RowsModel;
class SessionModel;

class ClockPanel : public QWidget {
  Q_OBJECT
 public:
  using Work = std::function<std::function<void()>(JobContext&)>;
  /// `run` does work of the page in the background.
  ClockPanel(SessionModel& session, CampaignUndo& undo, std::function<void(const QString&, Work)> run,
             QWidget* parent = nullptr);
  void refresh();
  void estimate();
  [[nodiscard]] RowsModel* rows() const { return rows_; }
  [[nodiscard]] QDoubleSpinBox* offset() const { return offset_; }
  [[nodiscard]] QComboBox* source() const { return source_; }
  [[nodiscard]] Callout* message() const { return message_; }

 private:
  [[nodiscard]] QString chosenSource() const;  ///< as the session names it
  [[nodiscard]] static QString nameOf(const std::string& source);
  void fillSources();
  void change(const std::string& source, double offset_s, double sigma_s, const std::string& how);

  SessionModel& session_;
  CampaignUndo& undo_;
  std::function<void(const QString&, Work)> run_;
  bool filling_ = false;
  FromObservations<std::set<std::string>> instruments_;
  std::int64_t shown_visit_ = -1;  ///< SessionModel::visit of what `source_` offers
  QComboBox* source_;
  QDoubleSpinBox* offset_;
  QPushButton* estimate_;
  Callout* message_;
  RowsModel* rows_;
};

}  // namespace spindrift::gui
