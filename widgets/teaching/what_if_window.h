// SPDX-License-Identifier: GPL-3.0-or-later
// "What if": a slider for every error parameter and every effect of a machine; machine, part, probing points and
// artefacts follow while it moves. No result comes of it; the values are kept as a draft.
#pragma once

#include <QDialog>
#include <memory>
#include <vector>

#include "core/workflows/what_if.h"
#include "widgets/commands/draft.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QSlider;
class QTabWidget;
class QVBoxLayout;

namespace spindrift::gui {

class Callout;
class QuantityBox;
class RowsModel;
class View3D;

/// The milled part with its deviations exaggerated.
class TestPartView : public QWidget {
  Q_OBJECT
 public:
  explicit TestPartView(QWidget* parent = nullptr);
  void show(const TestPart* part, std::vector<Eigen::Vector3d> deviation_um, const QString& why_none);
  [[nodiscard]] QSize sizeHint() const override { return {380, 360}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {240, 220}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  const TestPart* part_ = nullptr;
  std::vector<Eigen::Vector3d> deviation_um_;
  QString why_none_;
};

class WhatIfWindow : public QDialog {
  Q_OBJECT
 public:
  /// `draft` is what it begins with and where its values are kept; values of parameters that this machine does not have
  /// stay there.
  explicit WhatIfWindow(const MachineDescription& machine, WindowDraft draft = {}, QWidget* parent = nullptr);

  /// As the user does with slider or box. Throws InputError for a parameter that there is not.
  void set(const std::string& id, double value);
  void reset();
  /// Shows the rows whose symbol, title or driver holds this text.
  void filter(const QString& text);
  [[nodiscard]] const WindowDraft& draft() const { return draft_; }
  [[nodiscard]] const WhatIf& model() const { return what_if_; }
  [[nodiscard]] QSlider* slider(const std::string& id) const;
  [[nodiscard]] QuantityBox* box(const std::string& id) const;
  [[nodiscard]] RowsModel* partRows() const { return part_rows_; }
  [[nodiscard]] RowsModel* pointRows() const { return point_rows_; }
  [[nodiscard]] RowsModel* artefactRows() const { return artefact_rows_; }
  [[nodiscard]] QTabWidget* tabs() const { return tabs_; }
  [[nodiscard]] View3D* machineView() const { return view_; }
  [[nodiscard]] int visibleSliders() const;

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct Control {
    QWidget* row = nullptr;
    QLabel* heading = nullptr;  ///< of its group
    QSlider* slider = nullptr;
    QuantityBox* box = nullptr;
    QLabel* note = nullptr;  ///< of an effect: what its driver does
    QString text;            ///< searched by filter()
  };
  QWidget* makeControls();
  void addControl(std::size_t parameter, QLabel* heading, QVBoxLayout* column);
  void changed(std::size_t parameter, double value);
  void put(std::size_t parameter, double value);
  void keep();
  void showKept();
  void refresh();
  void refreshTable(const WhatIfAnswer& answer);
  void refreshMachine(const WhatIfAnswer& answer);

  WhatIf what_if_;
  std::vector<Control> controls_;
  bool filling_ = false;
  WindowDraft draft_;
  nlohmann::json kept_;  ///< what is in it: a value for each parameter that is not zero
  QLineEdit* search_;
  View3D* view_;
  TestPartView* part_view_;
  QTabWidget* tabs_;
  RowsModel* part_rows_;
  RowsModel* point_rows_;
  RowsModel* artefact_rows_;
  QComboBox* artefact_;
  QLabel* artefact_note_;
};

}  // namespace spindrift::gui
