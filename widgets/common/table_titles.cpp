// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/table_titles.h"

#include <QHash>
#include <QPainter>
#include <algorithm>
#include <utility>

#include "widgets/theme/fonts.h"
#include "widgets/theme/icons.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

constexpr int padding = 6;
constexpr int mark = 12;
constexpr int before_mark = 4;

QFont titleFont() {
  return textFont(sizes::font_secondary, QFont::DemiBold);
}

/// A title as it is laid out, of one line or, if narrow, of the two that are least wide.
struct LaidTitle {
  QString text;
  QSize size;
};

/// Tables ask for their titles with every change of their rows and sizes: each is measured once for a font.
const LaidTitle& laid(QString text, bool narrow) {
  static QFont measured;
  static QHash<std::pair<QString, bool>, LaidTitle> titles;
  const QFont font = titleFont();
  if (font != measured) {
    titles.clear();
    measured = font;
  }
  const std::pair key(text, narrow);
  if (const auto known = titles.constFind(key); known != titles.constEnd()) return *known;
  const QFontMetrics metrics(font);
  if (narrow && !text.contains(QLatin1Char('\n'))) {
    qsizetype best = -1;
    int least = metrics.horizontalAdvance(text);
    for (qsizetype at = text.indexOf(QLatin1Char(' ')); at >= 0; at = text.indexOf(QLatin1Char(' '), at + 1)) {
      if (at >= 1 && text[at - 1] == QLatin1Char('/')) continue;  // "/ µm" stays together
      const int width = std::max(metrics.horizontalAdvance(text.left(at)), metrics.horizontalAdvance(text.mid(at + 1)));
      if (width >= least) continue;
      least = width;
      best = at;
    }
    if (best >= 0) text[best] = QLatin1Char('\n');
  }
  return *titles.insert(key, {text, metrics.size(0, text)});
}

}  // namespace

TableTitles::TableTitles(QWidget* parent) : QHeaderView(Qt::Horizontal, parent) {
  setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  setSectionResizeMode(QHeaderView::ResizeToContents);
  setDefaultSectionSize(minimumSectionSize());  // below it Qt would never shrink a last column that stretches
  setStretchLastSection(true);
  setHighlightSections(false);
}

void TableTitles::fit(int width_px, int last_px) {
  auto* table = qobject_cast<QAbstractItemView*>(parentWidget());
  const bool narrow = table != nullptr && width_px > table->viewport()->width();
  if (narrow != narrow_) {
    narrow_ = narrow;
    if (count() > 0) headerDataChanged(orientation(), 0, count() - 1);  // the height anew
    resizeSections();
    updateGeometry();
    table->updateGeometry();  // a second line takes its height
  }
  const int last = count() - 1;
  if (last < 0 || last_px <= 0 || !stretchLastSection()) return;
  const int least = std::max(last_px, titleWidth(last, narrow_));
  if (sectionSize(last) < least) resizeSection(last, least);
}

QString TableTitles::title(int section) const {
  return model() == nullptr ? QString() : model()->headerData(section, Qt::Horizontal).toString();
}

bool TableTitles::ordered(int section) const {
  return isSortIndicatorShown() && sortIndicatorSection() == section;
}

int TableTitles::titleWidth(int section, bool narrow) const {
  return laid(title(section), narrow).size.width() + 2 * padding + (ordered(section) ? before_mark + mark : 0);
}

QSize TableTitles::sectionSizeFromContents(int section) const {
  return {titleWidth(section, narrow_), laid(title(section), narrow_).size.height() + 2 * padding + 1};
}

void TableTitles::paintSection(QPainter* painter, const QRect& place, int section) const {
  painter->save();
  painter->fillRect(place, theme().surface);
  painter->fillRect(QRect(place.left(), place.bottom(), place.width(), 1), theme().border);
  QRect room = place.adjusted(padding, 0, -padding, -1);
  if (ordered(section)) {
    const QRect at(room.right() + 1 - mark, room.center().y() - mark / 2 + 1, mark, mark);
    icon(sortIndicatorOrder() == Qt::AscendingOrder ? "chevron-up" : "chevron-down").paint(painter, at);
    room.setRight(at.left() - before_mark - 1);
  }
  const QVariant own =
      model() == nullptr ? QVariant() : model()->headerData(section, Qt::Horizontal, Qt::TextAlignmentRole);
  const Qt::Alignment alignment = own.isValid() ? Qt::Alignment(own.toInt()) : defaultAlignment();
  painter->setFont(titleFont());
  painter->setPen(theme().text_secondary);
  const QFontMetrics metrics(titleFont());
  QStringList lines = laid(title(section), narrow_).text.split(QLatin1Char('\n'));
  for (QString& line : lines) line = metrics.elidedText(line, Qt::ElideRight, room.width());
  painter->drawText(room, static_cast<int>(alignment), lines.join(QLatin1Char('\n')));
  painter->restore();
}

}  // namespace spindrift::gui
