// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/widgets/support/picture_compare.h"

#include <QList>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace spindrift::gui {
namespace {

constexpr double most_mean = 2.5;
constexpr double most_tile = 12.0;
constexpr int tile_px = 40;
constexpr double least_structure = 0.97;
constexpr double least_structure_of_tile = 0.75;
constexpr int blur_px = 2;  ///< to each side
constexpr std::size_t kept_colours = 128;

QImage small(const QImage& picture, int width) {
  QImage flat = picture;
  flat.setDevicePixelRatio(1.0);
  return flat.scaledToWidth(width, Qt::SmoothTransformation).convertToFormat(QImage::Format_RGB32);
}

using Channel = std::vector<double>;

/// Sums over one tile, of a pair of channels.
struct Tile {
  double difference = 0.0;
  double a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  int count = 0;

  [[nodiscard]] double structure() const {
    constexpr double c1 = (0.01 * 255) * (0.01 * 255);
    constexpr double c2 = (0.03 * 255) * (0.03 * 255);
    const double mean_a = a / count;
    const double mean_b = b / count;
    const double variance_a = aa / count - mean_a * mean_a;
    const double variance_b = bb / count - mean_b * mean_b;
    const double covariance = ab / count - mean_a * mean_b;
    return (2.0 * mean_a * mean_b + c1) * (2.0 * covariance + c2) /
           ((mean_a * mean_a + mean_b * mean_b + c1) * (variance_a + variance_b + c2));
  }
};

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
  return same_size && mean <= most_mean && worst_tile <= most_tile && structure >= least_structure &&
         worst_structure >= least_structure_of_tile;
}

QString PictureDifference::text() const {
  if (!same_size) return QStringLiteral("another size");
  return QStringLiteral(
             "mean difference %1 (at most %2), worst tile %3 (at most %4), structure %5 (at least %6), worst tile %7 "
             "(at least %8)")
      .arg(mean, 0, 'f', 2)
      .arg(most_mean)
      .arg(worst_tile, 0, 'f', 1)
      .arg(most_tile)
      .arg(structure, 0, 'f', 3)
      .arg(least_structure)
      .arg(worst_structure, 0, 'f', 2)
      .arg(least_structure_of_tile);
}

QImage asBaseline(const QImage& picture) {
  // A small window, such as a menu, is reduced as much as a large one.
  const int half = qRound(0.5 * picture.width() / picture.devicePixelRatio());
  const QImage reduced = small(picture, std::min(baseline_width, half));
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
  QImage now = small(picture, before.width());
  PictureDifference difference;
  // Rows of a small window, such as a menu, are whole pixels at every scale: its shape changes a little.
  constexpr double rounding = 0.03;
  difference.same_size = std::abs(before.height() - now.height()) <= 1.0 + rounding * before.height();
  if (difference.same_size && before.size() != now.size())
    now = now.scaled(before.size(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
  if (!difference.same_size) return difference;
  const int columns = (now.width() + tile_px - 1) / tile_px;
  const int rows = (now.height() + tile_px - 1) / tile_px;
  std::vector<Tile> tiles(static_cast<std::size_t>(columns * rows));
  constexpr std::array<int, 3> shifts{0, 8, 16};
  std::array<Channel, 3> all_a;
  std::array<Channel, 3> all_b;
  for (std::size_t c = 0; c < shifts.size(); ++c) {
    all_a[c] = blurred(before, shifts[c]);
    all_b[c] = blurred(now, shifts[c]);
  }
  for (int y = 0; y < now.height(); ++y) {
    for (int x = 0; x < now.width(); ++x) {
      const auto i = static_cast<std::size_t>(y * now.width() + x);
      Tile& tile = tiles[static_cast<std::size_t>(y / tile_px * columns + x / tile_px)];
      double a = 0.0;
      double b = 0.0;
      for (std::size_t c = 0; c < shifts.size(); ++c) {
        tile.difference += std::abs(all_a[c][i] - all_b[c][i]) / 3.0;
        a += all_a[c][i] / 3.0;
        b += all_b[c][i] / 3.0;
      }
      tile.a += a;
      tile.b += b;
      tile.aa += a * a;
      tile.bb += b * b;
      tile.ab += a * b;
      ++tile.count;
    }
  }
  double sum = 0.0;
  double structure = 0.0;
  int count = 0;
  for (const Tile& tile : tiles) {
    sum += tile.difference;
    count += tile.count;
    structure += tile.structure() / static_cast<double>(tiles.size());
    difference.worst_tile = std::max(difference.worst_tile, tile.difference / tile.count);
    difference.worst_structure = std::min(difference.worst_structure, tile.structure());
  }
  difference.mean = sum / count;
  difference.structure = structure;
  return difference;
}

}  // namespace spindrift::gui
