// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/widgets/support/picture_compare.h"

#include <QList>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace spindrift::gui {
namespace {

constexpr double most_mean = 2.5;
constexpr double most_tile = 12.0;
constexpr int tile_px = 40;
constexpr int blur_px = 2;  ///< to each side
constexpr std::size_t kept_colours = 128;

QImage small(const QImage& picture) {
  QImage flat = picture;
  flat.setDevicePixelRatio(1.0);
  return flat.scaledToWidth(baseline_width, Qt::SmoothTransformation).convertToFormat(QImage::Format_RGB32);
}

using Channel = std::vector<double>;

/// One channel, the mean of its neighbourhood.
Channel blurred(const QImage& picture, int shift) {
  const int width = picture.width();
  const int height = picture.height();
  // Sums of everything above and to the left.
  std::vector<double> sums(static_cast<std::size_t>((width + 1) * (height + 1)), 0.0);
  const auto sum = [&](int x, int y) -> double& { return sums[static_cast<std::size_t>(y * (width + 1) + x)]; };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int value = static_cast<int>(picture.pixel(x, y) >> shift) & 0xff;
      sum(x + 1, y + 1) = value + sum(x, y + 1) + sum(x + 1, y) - sum(x, y);
    }
  }
  Channel out(static_cast<std::size_t>(width * height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int left = std::max(0, x - blur_px);
      const int right = std::min(width, x + blur_px + 1);
      const int top = std::max(0, y - blur_px);
      const int bottom = std::min(height, y + blur_px + 1);
      out[static_cast<std::size_t>(y * width + x)] =
          (sum(right, bottom) - sum(left, bottom) - sum(right, top) + sum(left, top)) /
          static_cast<double>((right - left) * (bottom - top));
    }
  }
  return out;
}

}  // namespace

bool PictureDifference::alike() const {
  return same_size && mean <= most_mean && worst_tile <= most_tile;
}

QString PictureDifference::text() const {
  if (!same_size) return QStringLiteral("another size");
  return QStringLiteral("mean difference %1 (allowed %2), worst tile %3 (allowed %4)")
      .arg(mean, 0, 'f', 2)
      .arg(most_mean)
      .arg(worst_tile, 0, 'f', 1)
      .arg(most_tile);
}

QImage asBaseline(const QImage& picture) {
  const QImage reduced = small(picture);
  // Colours that differ in their lowest three bits share a place, which has the most frequent of them.
  std::map<QRgb, std::map<QRgb, int>> places;
  for (int y = 0; y < reduced.height(); ++y) {
    for (int x = 0; x < reduced.width(); ++x) {
      const QRgb colour = reduced.pixel(x, y);
      ++places[colour & 0xfff8f8f8][colour];
    }
  }
  struct Place {
    QRgb colour = 0;
    int count = 0;
  };
  std::vector<Place> frequent;
  for (const auto& [key, colours] : places) {
    Place place;
    int most = 0;
    for (const auto& [colour, count] : colours) {
      place.count += count;
      if (count > most) place.colour = colour;
      most = std::max(most, count);
    }
    frequent.push_back(place);
  }
  std::stable_sort(frequent.begin(), frequent.end(), [](const Place& a, const Place& b) { return a.count > b.count; });
  if (frequent.size() > kept_colours) frequent.resize(kept_colours);
  QList<QRgb> table;
  for (const Place& place : frequent) table << place.colour;
  return reduced.convertToFormat(QImage::Format_Indexed8, table, Qt::ThresholdDither | Qt::AvoidDither);
}

PictureDifference comparePictures(const QImage& baseline, const QImage& picture) {
  const QImage before = baseline.convertToFormat(QImage::Format_RGB32);
  const QImage now = small(picture);
  PictureDifference difference;
  difference.same_size = before.size() == now.size();
  if (!difference.same_size) return difference;
  const int columns = (now.width() + tile_px - 1) / tile_px;
  const int rows = (now.height() + tile_px - 1) / tile_px;
  struct Tile {
    double sum = 0.0;
    int count = 0;
  };
  std::vector<Tile> tiles(static_cast<std::size_t>(columns * rows));
  for (const int shift : {0, 8, 16}) {
    const Channel a = blurred(before, shift);
    const Channel b = blurred(now, shift);
    for (int y = 0; y < now.height(); ++y) {
      for (int x = 0; x < now.width(); ++x) {
        const auto i = static_cast<std::size_t>(y * now.width() + x);
        Tile& tile = tiles[static_cast<std::size_t>(y / tile_px * columns + x / tile_px)];
        tile.sum += std::abs(a[i] - b[i]);
        ++tile.count;
      }
    }
  }
  double sum = 0.0;
  int count = 0;
  for (const Tile& tile : tiles) {
    sum += tile.sum;
    count += tile.count;
    difference.worst_tile = std::max(difference.worst_tile, tile.sum / tile.count);
  }
  difference.mean = sum / count;
  return difference;
}

}  // namespace spindrift::gui
