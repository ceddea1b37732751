// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/theme/colour_map.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"

#include <algorithm>
#include <cmath>

namespace spindrift::gui {
namespace {

// Moreland's construction: interpolation in Msh (polar CIELAB) from blue over an unsaturated middle to red.
struct Msh {
  double m, s, h;
};

double toLinear(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
double fromLinear(double v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

constexpr double white_x = 0.95047;
constexpr double white_z = 1.08883;

Msh mshFromRgb(double r8, double g8, double b8) {
  const double r = toLinear(r8 / 255);
  const double g = toLinear(g8 / 255);
  const double b = toLinear(b8 / 255);
  const double x = 0.4124564 * r + 0.3575761 * g + 0.1804375 * b;
  const double y = 0.2126729 * r + 0.7151522 * g + 0.0721750 * b;
  const double z = 0.0193339 * r + 0.1191920 * g + 0.9503041 * b;
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double fy = f(y);
  const double lightness = 116 * fy - 16;
  const double a = 500 * (f(x / white_x) - fy);
  const double bb = 200 * (fy - f(z / white_z));
  const double m = std::sqrt(lightness * lightness + a * a + bb * bb);
  return {m, m > 1e-9 ? std::acos(lightness / m) : 0.0, std::atan2(bb, a)};
}

QRgb rgbFromMsh(const Msh& c) {
  const double lightness = c.m * std::cos(c.s);
  const double a = c.m * std::sin(c.s) * std::cos(c.h);
  const double b = c.m * std::sin(c.s) * std::sin(c.h);
  const double fy = (lightness + 16) / 116;
  const auto inverse = [](double t) { return t > 0.206893 ? t * t * t : (t - 16.0 / 116.0) / 7.787; };
  const double y = inverse(fy);
  const double x = white_x * inverse(fy + a / 500);
  const double z = white_z * inverse(fy - b / 200);
  const double red = 3.2404542 * x - 1.5371385 * y - 0.4985314 * z;
  const double green = -0.9692660 * x + 1.8760108 * y + 0.0415560 * z;
  const double blue = 0.0556434 * x - 0.2040259 * y + 1.0572252 * z;
  const auto byte = [](double v) {
    return static_cast<int>(std::lround(255 * std::clamp(fromLinear(std::max(0.0, v)), 0.0, 1.0)));
  };
  return qRgb(byte(red), byte(green), byte(blue));
}

double adjustedHue(const Msh& saturated, double unsaturated_m) {
  if (saturated.m >= unsaturated_m) return saturated.h;
  const double spin = saturated.s * std::sqrt(unsaturated_m * unsaturated_m - saturated.m * saturated.m) /
                      (saturated.m * std::sin(saturated.s));
  return saturated.h > -1.0471975512 ? saturated.h + spin : saturated.h - spin;
}

std::array<QRgb, 256> makeDiverging() {
  const Msh cool = mshFromRgb(59, 76, 192);
  const Msh warm = mshFromRgb(180, 4, 38);
  const double middle_m = std::max({cool.m, warm.m, 88.0});
  std::array<QRgb, 256> table{};
  for (int i = 0; i < 256; ++i) {
    const double t = i / 255.0;
    const Msh& end = t < 0.5 ? cool : warm;
    const double u = t < 0.5 ? 2 * t : 2 * (1 - t);  // 0 at the end, 1 in the middle
    const double hue = end.h + (adjustedHue(end, middle_m) - end.h) * u;
    table[static_cast<std::size_t>(i)] = rgbFromMsh({end.m + (middle_m - end.m) * u, end.s * (1 - u), hue});
  }
  return table;
}

std::array<QRgb, 256> makeSequential() {
  constexpr std::array<std::array<int, 3>, 11> points{{{68, 1, 84},
                                                       {72, 36, 117},
                                                       {65, 68, 135},
                                                       {53, 95, 141},
                                                       {42, 120, 142},
                                                       {33, 145, 140},
                                                       {34, 168, 132},
                                                       {68, 191, 112},
                                                       {122, 209, 81},
                                                       {189, 223, 38},
                                                       {253, 231, 37}}};
  std::array<QRgb, 256> table{};
  for (int i = 0; i < 256; ++i) {
    const double t = i / 255.0 * (points.size() - 1);
    const auto k = std::min(static_cast<std::size_t>(t), points.size() - 2);
    const double u = t - static_cast<double>(k);
    const auto mix = [&](std::size_t c) {
      return static_cast<int>(std::lround(points[k][c] + u * (points[k + 1][c] - points[k][c])));
    };
    table[static_cast<std::size_t>(i)] = qRgb(mix(0), mix(1), mix(2));
  }
  return table;
}

double roundedUp(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0}) {
    if (value <= step * power * (1 + 1e-9)) return step * power;
  }
  return 10 * power;
}

}  // namespace

const std::array<QRgb, 256>& colourTable(ColourMap map) {
  static const std::array<QRgb, 256> diverging = makeDiverging();
  static const std::array<QRgb, 256> sequential = makeSequential();
  return map == ColourMap::Diverging ? diverging : sequential;
}

ColourScale ColourScale::symmetric(double largest, QString title, QString unit) {
  const double limit = roundedUp(largest);
  return {ColourMap::Diverging, -limit, limit, std::move(title), std::move(unit)};
}

ColourScale ColourScale::magnitude(double largest, QString title, QString unit) {
  return {ColourMap::Sequential, 0.0, roundedUp(largest), std::move(title), std::move(unit)};
}

QRgb ColourScale::rgb(double value) const {
  const double t = (value - low) / (high - low);
  if (!std::isfinite(t)) return qRgb(128, 128, 128);
  return colourTable(map)[static_cast<std::size_t>(std::lround(255 * std::clamp(t, 0.0, 1.0)))];
}

std::vector<double> ColourScale::ticks() const {
  const ShownUnit shown = shownUnit(unit);
  std::vector<double> values = roundTicks(shown.shown(low), shown.shown(high), 6);
  for (double& v : values) v = shown.stored(v);
  return values;
}

QString ColourScale::text(double value, double step) const {
  const ShownUnit shown = shownUnit(unit);
  return tickText(shown.shown(value), shown.factor * step);
}

std::vector<double> roundTicks(double low, double high, int wanted) {
  std::vector<double> best;
  if (!(high > low) || wanted < 2) return best;
  const double raw = (high - low) / (wanted - 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0, 10.0}) {
    const double step = factor * power;
    std::vector<double> ticks;
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
      ticks.push_back(k == 0 ? 0.0 : k * step);
    }
    const auto distance = [wanted](std::size_t n) { return std::abs(static_cast<int>(n) - wanted); };
    if (best.empty() || distance(ticks.size()) < distance(best.size())) best = ticks;
  }
  return best;
}

QString tickText(double value, double step) {
  int decimals = 0;
  double scaled = std::abs(step);
  while (decimals < 6 && std::abs(scaled - std::round(scaled)) > 1e-6 * std::max(1.0, scaled)) {
    scaled *= 10;
    ++decimals;
  }
  return decimalText(value, 'f', decimals);
}

}  // namespace spindrift::gui
