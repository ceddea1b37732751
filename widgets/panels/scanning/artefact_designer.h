// SPDX-License-Identifier: GPL-3.0-or-later
// The artefact designer: a free-form surface for the laser profiler before it is made. What each of the six errors can
// be known to under either scan model, which directions are weak, where the surface is too steep, and the body as STL.
// The form is kept as a draft.
#pragma once

#include <QDialog>
#include <QTimer>
#include <filesystem>
#include <map>
#include <string>

#include "core/scanning/artefact_design.h"
#include "widgets/commands/draft.h"

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;

namespace spindrift::gui {

class Callout;
class RowsModel;
class Segments;
class View3D;

class ArtefactDesigner : public QDialog {
  Q_OBJECT
 public:
  /// `draft` is what it begins with and where the form is kept.
  explicit ArtefactDesigner(WindowDraft draft = {}, QWidget* parent = nullptr);
  /// One of the surfaces offered; 0 is the paper's.
  void chooseSurface(int index);
  /// A number of the form by its name ("steepest slope").
  [[nodiscard]] QDoubleSpinBox* number(const std::string& name) const { return numbers_.at(name); }
  [[nodiscard]] const WindowDraft& draft() const { return draft_; }
  [[nodiscard]] const ArtefactSurface& surface() const { return surface_; }
  [[nodiscard]] RowsModel* sigmas() const { return sigmas_; }
  [[nodiscard]] RowsModel* weak() const { return weak_; }
  [[nodiscard]] Callout* verdict() const { return verdict_; }
  [[nodiscard]] View3D* view() const { return view_; }
  [[nodiscard]] Segments* colouring() const { return colouring_; }
  /// Works the design out now instead of a moment after the last change.
  void recompute();
  void writeStl(const std::filesystem::path& file);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void addNumber(QFormLayout* form, const std::string& name, const QString& label, const QString& unit, double low,
                 double high, double step, double value, int decimals);
  /// Puts the numbers of one of the surfaces into the form.
  void fillForm(int index);
  void keep();
  void showKept();
  void takeNumbers();
  void showDesigns(const ArtefactDesign& rigid, const ArtefactDesign& push_broom);
  void showSurface();
  void askForStl();

  WindowDraft draft_;
  ArtefactSurface surface_;
  std::map<std::string, QDoubleSpinBox*> numbers_;
  QComboBox* kind_;
  QTimer timer_;
  RowsModel* sigmas_;
  RowsModel* weak_;
  Callout* verdict_;
  View3D* view_;
  Segments* colouring_;
  bool filling_ = false;
};

}  // namespace spindrift::gui
