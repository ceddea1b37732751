// SPDX-License-Identifier: GPL-3.0-or-later
// The tools with which parts of a scan are masked and taken back. Every stroke is a change that can be undone and
// is kept in the session with its reason; results that used the scan turn outdated.
#pragma once

#include <QWidget>

#include "core/scanning/painted_mask.h"
#include "widgets/models/session_model.h"

class QComboBox;
class QDoubleSpinBox;
class QPushButton;

namespace spindrift::gui {

class CampaignUndo;
class CloudPainter;
class Segments;
class View3D;

class ScanMaskBar : public QWidget {
  Q_OBJECT
 public:
  ScanMaskBar(View3D* view, SessionModel& session, CampaignUndo& undo, QWidget* parent = nullptr);
  /// The scan that is shown, as the list names it; empty: none.
  void setCloud(const QString& cloud);
  /// Item and reason of the mask of the scan; empty if nothing was painted.
  [[nodiscard]] std::pair<QString, QString> mask() const;
  /// The same for any scan.
  [[nodiscard]] static std::pair<QString, QString> maskOf(const SessionModel& session, const QString& cloud);
  [[nodiscard]] Segments* tools() const { return tools_; }
  [[nodiscard]] Segments* effect() const { return effect_; }
  [[nodiscard]] QComboBox* reason() const { return reason_; }
  [[nodiscard]] QPushButton* clearButton() const { return clear_; }
  [[nodiscard]] CloudPainter* painter() const { return painter_; }

 Q_SIGNALS:
  /// Restoring needs to see what is masked.
  void restoring();

 private:
  void add(const MaskStroke& stroke);
  void push(const MaskStrokes& strokes, const QString& text);
  void refresh();

  SessionModel& session_;
  CampaignUndo& undo_;
  QString cloud_;
  CloudPainter* painter_;
  Segments* tools_;
  Segments* effect_;
  QDoubleSpinBox* radius_;
  QComboBox* reason_;
  QPushButton* clear_;
  QWidget* detail_;  ///< reason and taking back, while something is painted
};

}  // namespace spindrift::gui
