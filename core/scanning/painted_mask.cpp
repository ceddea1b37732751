// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/painted_mask.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

constexpr std::string_view prefix = "mask/";
constexpr std::array<std::string_view, 3> shape_names{"brush", "rectangle", "lasso"};

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) noexcept {
  const Eigen::Vector2d along = b - a;
  const double length = along.squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

std::string number(double mm) {
  std::string text = fmt::format("{:.3f}", mm);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::vector<std::string_view> words(std::string_view text, char separator) {
  std::vector<std::string_view> out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const std::string_view word = text.substr(0, end);
    if (word.find_first_not_of(' ') != std::string_view::npos) out.push_back(word);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

MaskStroke strokeFrom(std::string_view text) {
  const auto reject = [&](std::string_view allowed) -> MaskStroke {
    throw InputError(fmt::format("Mask: found '{}'; allowed: {}.", text, allowed));
  };
  const std::vector<std::string_view> parts = words(text, ' ');
  if (parts.size() < 3 || (parts[0] != "erase" && parts[0] != "restore"))
    return reject("erase or restore, then brush, rectangle or lasso, then places x,y in mm");
  MaskStroke stroke;
  stroke.erase = parts[0] == "erase";
  const auto shape = std::find(shape_names.begin(), shape_names.end(), parts[1]);
  if (shape == shape_names.end()) return reject("brush, rectangle or lasso");
  stroke.shape = static_cast<StrokeShape>(shape - shape_names.begin());
  std::size_t next = 2;
  if (stroke.shape == StrokeShape::Brush) {
    if (!parseNumber(std::string(parts[next++]), stroke.radius_mm) || !(stroke.radius_mm > 0.0))
      return reject("a radius above 0 mm after brush");
  }
  for (; next < parts.size(); ++next) {
    const std::vector<std::string_view> xy = words(parts[next], ',');
    Eigen::Vector2d place;
    if (xy.size() != 2 || !parseNumber(std::string(xy[0]), place.x()) || !parseNumber(std::string(xy[1]), place.y()))
      return reject("places as x,y in mm");
    stroke.points_mm.push_back(place);
  }
  const std::size_t least = stroke.shape == StrokeShape::Brush ? 1 : stroke.shape == StrokeShape::Rectangle ? 2 : 3;
  if (stroke.points_mm.size() < least || (stroke.shape == StrokeShape::Rectangle && stroke.points_mm.size() > 2))
    return reject("one place or more for a brush, two for a rectangle, three or more for a lasso");
  return stroke;
}

}  // namespace

bool MaskStroke::covers(const Eigen::Vector2d& p) const noexcept {
  if (points_mm.empty()) return false;
  switch (shape) {
    case StrokeShape::Rectangle: {
      const Eigen::Vector2d low = points_mm.front().cwiseMin(points_mm.back());
      const Eigen::Vector2d high = points_mm.front().cwiseMax(points_mm.back());
      return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
    }
    case StrokeShape::Brush: {
      if ((p - points_mm.front()).norm() <= radius_mm) return true;
      for (std::size_t i = 1; i < points_mm.size(); ++i)
        if (distanceToSegment(p, points_mm[i - 1], points_mm[i]) <= radius_mm) return true;
      return false;
    }
    case StrokeShape::Lasso: {
      bool inside = false;
      for (std::size_t i = 0, j = points_mm.size() - 1; i < points_mm.size(); j = i++) {
        const Eigen::Vector2d &a = points_mm[i], &b = points_mm[j];
        if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
          inside = !inside;
      }
      return inside;
    }
  }
  return false;
}

std::string toText(const MaskStrokes& strokes) {
  std::string text;
  for (const MaskStroke& s : strokes) {
    if (!text.empty()) text += "; ";
    text += fmt::format("{} {}", s.erase ? "erase" : "restore", shape_names[static_cast<std::size_t>(s.shape)]);
    if (s.shape == StrokeShape::Brush) text += " " + number(s.radius_mm);
    for (const Eigen::Vector2d& p : s.points_mm) text += fmt::format(" {},{}", number(p.x()), number(p.y()));
  }
  return text;
}

MaskStrokes maskStrokesFromText(std::string_view text) {
  MaskStrokes strokes;
  for (const std::string_view part : words(text, ';')) strokes.push_back(strokeFrom(part));
  return strokes;
}

std::string maskItem(const std::string& cloud, const MaskStrokes& strokes) {
  return std::string(prefix) + cloud + ": " + toText(strokes);
}

bool isMaskItem(std::string_view item) noexcept {
  return item.starts_with(prefix);
}

std::map<std::string, MaskStrokes> masksOf(const std::set<std::string>& items) {
  std::map<std::string, MaskStrokes> masks;
  for (const std::string& item : items) {
    if (!isMaskItem(item)) continue;
    const std::size_t colon = item.rfind(": ");
    if (colon == std::string::npos)
      throw InputError(fmt::format("Mask: found '{}'; allowed: mask/<cloud>: <strokes>.", item));
    MaskStrokes strokes = maskStrokesFromText(std::string_view(item).substr(colon + 2));
    MaskStrokes& own = masks[item.substr(prefix.size(), colon - prefix.size())];
    own.insert(own.end(), strokes.begin(), strokes.end());
  }
  return masks;
}

CloudMask paintedMask(const PointCloud& cloud, const MaskStrokes& strokes) {
  CloudMask keep(cloud.size(), 1);
  for (const MaskStroke& stroke : strokes) {
    if (stroke.points_mm.empty()) continue;
    Eigen::Vector2d low = stroke.points_mm.front(), high = low;
    for (const Eigen::Vector2d& p : stroke.points_mm) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    low.array() -= stroke.radius_mm;
    high.array() += stroke.radius_mm;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector2d p = cloud.points_mm[i].head<2>();
      if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) continue;
      if (stroke.covers(p)) keep[i] = stroke.erase ? 0 : 1;
    }
  }
  return keep;
}

}  // namespace spindrift
