// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/effect_picture.h"

#include <QPainter>
#include <array>
#include <utility>

#include "core/base/atomic_file.h"
#include "widgets/common/drawing_painter.h"
#include "widgets/common/words.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/theme/colour_map.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

QString unitOfShape(const EffectShape& shape) {
  return shape.rotations ? QStringLiteral("urad") : QStringLiteral("um");
}

}  // namespace

EffectPicture::EffectPicture(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setAccessibleName(tr("Shape of the effect on the machine"));
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, [this] { update(); });
}

void EffectPicture::clear(const QString& why) {
  work_.forget();
  shape_.reset();
  why_ = why;
  setAccessibleDescription(why);
  update();
}

void EffectPicture::show(const Effect& effect, const MachineDescription& machine, std::size_t gain) {
  if (effect.shape.empty()) return clear(tr("This effect has no shape of its own."));
  work_.ask([this, effect, volume = EffectVolume::of(machine),
             column = gain < effect.shape.size() ? gain : 0]() -> std::function<void()> {
    return [this, shape = effectShape(effect, volume, column)] { take(shape); };
  });
}

void EffectPicture::take(std::optional<EffectShape> shape) {
  if (!shape) return clear(tr("The shape is zero, or has no value, everywhere in the working volume."));
  shape_ = std::make_shared<const EffectShape>(*std::move(shape));
  setAccessibleDescription(tr("Largest deviation for a gain of 1 %1: %2")
                               .arg(gainUnitText(shape_->gain_unit), sizeText(shape_->largest, unitOfShape(*shape_))));
  update();
}

EffectDrawingOptions EffectPicture::worded() const {
  EffectDrawingOptions options;
  const std::array<QString, 3> names{tr("Top"), tr("Front"), tr("Side")};
  for (std::size_t i = 0; i < names.size(); ++i)
    options.titles[i] =
        tr("%1, colour %2").arg(names[i], componentName(shape_->colouredIn(shape_->views[i]))).toStdString();
  const QString size = sizeText(shape_->largest, unitOfShape(*shape_)).replace(QLatin1Char(' '), QChar(QChar::Nbsp));
  options.legend =
      onScreen((shape_->rotations ? tr("Rotation of the tool for a gain of 1 %1, as vectors: at most %2.")
                                  : tr("Deviation of the tool for a gain of 1 %1, drawn exaggerated: at most %2."))
                   .arg(gainUnitText(shape_->gain_unit), size))
          .toStdString();
  const ShownUnit unit = shownUnit(unitOfShape(*shape_));
  const double limit = shape_->limit();
  for (std::size_t i = 0; i < options.numbers.size(); ++i) {
    const double value = (static_cast<double>(i) - 1.0) * limit;
    options.numbers[i] =
        (unit.converted() ? decimalText(unit.shown(value), 'g', 3) : tickText(value, limit)).toStdString();
  }
  options.unit = unit.name.toStdString();
  return options;
}

void EffectPicture::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Theme& t = theme();
  if (shape_ == nullptr) {
    painter.setPen(t.text_secondary);
    painter.setFont(textFont(sizes::font_body));
    painter.drawText(rect().adjusted(16, 8, -16, -8), Qt::AlignCenter | Qt::TextWordWrap, why_);
    return;
  }
  EffectDrawingOptions options = worded();
  options.width_px = width();
  options.height_px = height();
  options.ground = pictureColour(t.surface);
  options.ink = pictureColour(t.text);
  options.soft = pictureColour(t.text_secondary);
  options.axes = {pictureColour(t.axis_x), pictureColour(t.axis_y), pictureColour(t.axis_z)};
  paintDrawing(painter, effectDrawing(*shape_, options));
}

void EffectPicture::exportTo(const QString& file) const {
  EffectDrawingOptions options = worded();
  options.width_px = 960;
  options.height_px = 400;
  const Drawing drawing = effectDrawing(*shape_, options);
  writeFileAtomically(file.toStdString(), file.endsWith(QLatin1String(".svg"))   ? svgOf(drawing)
                                          : file.endsWith(QLatin1String(".pdf")) ? pdfOf(drawing)
                                                                                 : pngOf(drawing));
}

}  // namespace spindrift::gui
