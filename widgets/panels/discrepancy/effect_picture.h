// SPDX-License-Identifier: GPL-3.0-or-later
// The shape of an effect on the machine (core/reporting/effect_drawing.h), in the look and the language of the window.
// It is worked out beside the window.
#pragma once

#include <QWidget>
#include <memory>

#include "core/reporting/effect_drawing.h"
#include "widgets/jobs/latest_work.h"

namespace spindrift::gui {

class EffectPicture : public QWidget {
  Q_OBJECT
 public:
  explicit EffectPicture(QWidget* parent = nullptr);
  /// `gain`: which column of its shape; what is out of range shows the first.
  void show(const Effect& effect, const MachineDescription& machine, std::size_t gain = 0);
  /// Nothing; `why` stands in its place.
  void clear(const QString& why);
  [[nodiscard]] bool empty() const { return shape_ == nullptr; }
  [[nodiscard]] const EffectShape* shape() const { return shape_.get(); }
  [[nodiscard]] bool busy() const { return work_.busy(); }
  /// PNG, SVG or PDF by its ending, on white; throws InputError.
  void exportTo(const QString& file) const;

  [[nodiscard]] QSize sizeHint() const override { return {600, 260}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {360, 200}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void take(std::optional<EffectShape> shape);
  /// With the words of the window.
  [[nodiscard]] EffectDrawingOptions worded() const;

  std::shared_ptr<const EffectShape> shape_;
  QString why_;
  LatestWork work_;
};

}  // namespace spindrift::gui
