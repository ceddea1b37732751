// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/theme/fonts.h"

#include <QFile>
#include <QFontDatabase>
#include <QStringList>
#include <QtEndian>
#include <cstring>

#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

constexpr auto folder = "/usr/share/fonts/opentype/inter/";

struct TableRange {
  qsizetype offset = 0;
  qsizetype length = 0;
};

/// Where a table of an OpenType file stands; length 0 if it is not there.
TableRange findTable(const QByteArray& font, const char* tag) {
  if (font.size() < 12) return {};
  const auto count = qFromBigEndian<quint16>(font.constData() + 4);
  for (int i = 0; i < count; ++i) {
    const qsizetype record = 12 + 16 * static_cast<qsizetype>(i);
    if (record + 16 > font.size()) return {};
    if (std::memcmp(font.constData() + record, tag, 4) != 0) continue;
    const TableRange range{static_cast<qsizetype>(qFromBigEndian<quint32>(font.constData() + record + 8)),
                           static_cast<qsizetype>(qFromBigEndian<quint32>(font.constData() + record + 12))};
    return range.offset + range.length <= font.size() ? range : TableRange{};
  }
  return {};
}

QString loadFamily() {
  constexpr auto family = "Spdrf";
  bool loaded = false;
  for (const char* file : {"Inter-Regular.otf", "Inter-Medium.otf", "Inter-SemiBold.otf", "Inter-Bold.otf"}) {
    QFile input(QString::fromLatin1(folder) + QString::fromLatin1(file));
    if (!input.open(QIODevice::ReadOnly)) continue;
    const QByteArray font = withTabularFigures(input.readAll(), family);
    if (font.isEmpty()) continue;
    loaded = QFontDatabase::addApplicationFontFromData(font) >= 0 || loaded;
  }
  if (loaded && QFontDatabase::families().contains(QString::fromLatin1(family))) return QString::fromLatin1(family);
  if (QFontDatabase::families().contains(QStringLiteral("Inter"))) return QStringLiteral("Inter");
  return {};
}

}  // namespace

QByteArray withTabularFigures(QByteArray font, const QByteArray& family) {
  if (family.size() != 5) return {};
  const TableRange gsub = findTable(font, "GSUB");
  const TableRange name = findTable(font, "name");
  if (gsub.length < 10 || name.length == 0) return {};
  const qsizetype list = gsub.offset + qFromBigEndian<quint16>(font.constData() + gsub.offset + 6);
  if (list + 2 > font.size()) return {};
  const auto count = qFromBigEndian<quint16>(font.constData() + list);
  bool found = false;
  for (int i = 0; i < count; ++i) {
    const qsizetype record = list + 2 + 6 * static_cast<qsizetype>(i);
    if (record + 6 > font.size()) return {};
    if (std::memcmp(font.constData() + record, "tnum", 4) == 0) {
      // "clig" (contextual ligatures) is on by default in every text engine and not used by this family.
      std::memcpy(font.data() + record, "clig", 4);
      found = true;
    }
  }
  if (!found) return {};
  const char utf16[] = {0, 'I', 0, 'n', 0, 't', 0, 'e', 0, 'r'};
  for (qsizetype i = name.offset; i + 10 <= name.offset + name.length; ++i) {
    if (std::memcmp(font.constData() + i, utf16, 10) != 0) continue;
    for (int k = 0; k < 5; ++k) font[i + 2 * k + 1] = family[k];
  }
  return font;
}

QFont bodyFont() {
  static const QString family = loadFamily();
  QFont font;
  if (!family.isEmpty()) font.setFamily(family);
  font.setStyleHint(QFont::SansSerif);
  font.setPixelSize(sizes::font_body);
  return font;
}

QFont textFont(int pixel_size, QFont::Weight weight) {
  QFont font = bodyFont();
  font.setPixelSize(pixel_size);
  font.setWeight(weight);
  return font;
}

QFont printFont(int pixel_size, QFont::Weight weight) {
  QFont font = textFont(pixel_size, weight);
  if (QFontDatabase::families().contains(QStringLiteral("Inter"))) font.setFamilies({QStringLiteral("Inter")});
  // Contextual forms (a colon between figures) are replaced glyphs, too.
  font.setStyleStrategy(QFont::PreferNoShaping);
  return font;
}

}  // namespace spindrift::gui
