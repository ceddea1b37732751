// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/words.h"

#include "core/base/unit_text.h"

namespace spindrift::gui {

QString sentenceStart(QString text) {
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

QString unitText(std::string_view unit) {
  return QString::fromStdString(printedUnit(unit));
}

}  // namespace spindrift::gui
