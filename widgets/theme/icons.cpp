// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/theme/icons.h"

#include <QAbstractButton>
#include <QApplication>
#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QPixmapCache>
#include <QSvgRenderer>
#include <optional>

#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

/// What an icon is drawn on.
enum class Ground { Surface, Accent };

class LineIconEngine : public QIconEngine {
 public:
  LineIconEngine(QString name, std::optional<QColor> colour, Ground ground = Ground::Surface)
      : name_(std::move(name)), colour_(std::move(colour)), ground_(ground) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override {
    const double ratio = painter->device() != nullptr ? painter->device()->devicePixelRatioF() : 1.0;
    const int size = std::min(rect.width(), rect.height());
    const QPixmap pixmap = iconPixmap(name_, colourFor(mode), size, ratio);
    painter->drawPixmap(rect.x() + (rect.width() - size) / 2, rect.y() + (rect.height() - size) / 2, pixmap);
  }

  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State) override {
    return iconPixmap(name_, colourFor(mode), std::min(size.width(), size.height()), 1.0);
  }

  QPixmap scaledPixmap(const QSize& size, QIcon::Mode mode, QIcon::State, qreal scale) override {
    // `size` is in device pixels here.
    return iconPixmap(name_, colourFor(mode),
                      static_cast<int>(std::lround(std::min(size.width(), size.height()) / scale)), scale);
  }

  [[nodiscard]] QIconEngine* clone() const override { return new LineIconEngine(name_, colour_, ground_); }
  QString iconName() override { return name_; }

 private:
  [[nodiscard]] QColor colourFor(QIcon::Mode mode) const {
    if (mode == QIcon::Disabled) return theme().text_disabled;
    return colour_.value_or(ground_ == Ground::Accent ? theme().accent_text : theme().text);
  }

  QString name_;
  std::optional<QColor> colour_;
  Ground ground_;
};

QByteArray iconText(const QString& name) {
  QFile file(QStringLiteral(":/icons/") + name + QStringLiteral(".svg"));
  if (!file.open(QIODevice::ReadOnly)) return {};
  return file.readAll();
}

}  // namespace

QPixmap iconPixmap(const QString& name, const QColor& colour, int size, double device_pixel_ratio) {
  const QString key =
      QStringLiteral("spindrift/%1/%2/%3/%4").arg(name, colour.name(QColor::HexArgb)).arg(size).arg(device_pixel_ratio);
  QPixmap pixmap;
  if (QPixmapCache::find(key, &pixmap)) return pixmap;
  QByteArray text = iconText(name);
  text.replace("currentColor", colour.name().toLatin1());
  const int pixels = std::max(1, static_cast<int>(std::lround(size * device_pixel_ratio)));
  pixmap = QPixmap(pixels, pixels);
  pixmap.fill(Qt::transparent);
  QSvgRenderer renderer(text);
  QPainter painter(&pixmap);
  painter.setOpacity(colour.alphaF());
  renderer.render(&painter, QRectF(0, 0, pixels, pixels));
  painter.end();
  pixmap.setDevicePixelRatio(device_pixel_ratio);
  QPixmapCache::insert(key, pixmap);
  return pixmap;
}

QIcon icon(const char* name) {
  return QIcon(new LineIconEngine(QString::fromLatin1(name), std::nullopt));
}

void drawIconOnAccent(QAbstractButton& button, bool on_accent) {
  const QString name = button.icon().name();
  if (name.isEmpty()) return;
  button.setIcon(QIcon(new LineIconEngine(name, std::nullopt, on_accent ? Ground::Accent : Ground::Surface)));
}

QIcon icon(const char* name, const QColor& colour) {
  return QIcon(new LineIconEngine(QString::fromLatin1(name), colour));
}

QIcon applicationIcon() {
  QIcon result;
  for (const int size : {16, 24, 32, 48, 64, 128, 256}) {
    result.addPixmap(iconPixmap(QStringLiteral("spindrift"), Qt::black, size, 1.0));
  }
  return result;
}

}  // namespace spindrift::gui
