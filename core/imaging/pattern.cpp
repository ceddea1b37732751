// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"

namespace spindrift {

extern const char* const standard_pattern_json;

namespace {

/// A list of two whole numbers.
std::array<int, 2> integerPair(const JsonNode& node) {
  const std::vector<JsonNode> items = node.items();
  if (items.size() != 2) node.reject("a list of two whole numbers, first and last");
  return {items[0].integer(), items[1].integer()};
}

PatternStroke strokeOf(const JsonNode& node) {
  PatternStroke stroke;
  for (const JsonNode& point : node.items()) {
    const std::vector<double> xy = point.numbers();
    if (xy.size() != 2) point.reject("a list of two numbers, x and y in µm");
    stroke.emplace_back(xy[0], xy[1]);
  }
  if (stroke.empty()) node.reject("a list of at least one point");
  return stroke;
}

FiducialPattern patternOf(const JsonNode& root, const std::filesystem::path& name) {
  root.requireFormat("spindrift-fiducial-pattern", 1);
  if (root.has("unit")) (void)root.at("unit").oneOf({"um"});
  FiducialPattern pattern;
  const auto rows = integerPair(root.at("rows"));
  const auto columns = integerPair(root.at("columns"));
  pattern.first_row = rows[0];
  pattern.last_row = rows[1];
  pattern.first_column = columns[0];
  pattern.last_column = columns[1];
  pattern.pitch_um = root.at("pitch").positiveNumber();
  const JsonNode ellipse = root.at("ellipse");
  pattern.semi_axis_x_um = ellipse.at("semi_axis_x").positiveNumber();
  pattern.semi_axis_y_um = ellipse.at("semi_axis_y").positiveNumber();
  pattern.ellipse_line_width_um = ellipse.at("line_width").positiveNumber();
  const JsonNode circle = root.at("circle");
  pattern.circle_radius_um = circle.at("radius").positiveNumber();
  pattern.circle_offset_x_um = circle.at("offset_x").number();
  pattern.circle_offset_y_um = circle.at("offset_y").number();
  // In the file the range of circles is half open: [-1, 9] means -1 ... 8.
  const auto circle_columns = integerPair(circle.at("columns"));
  const auto circle_rows = integerPair(circle.at("rows"));
  if (circle_columns[1] <= circle_columns[0]) circle.at("columns").reject("first index, last index + 1");
  if (circle_rows[1] <= circle_rows[0]) circle.at("rows").reject("first index, last index + 1");
  pattern.first_circle_column = circle_columns[0];
  pattern.last_circle_column = circle_columns[1] - 1;
  pattern.first_circle_row = circle_rows[0];
  pattern.last_circle_row = circle_rows[1] - 1;
  const JsonNode digits = root.at("digits");
  pattern.digit_offset_x_um = digits.at("offset_x").positiveNumber();
  pattern.digit_offset_y_um = digits.at("offset_y").positiveNumber();
  pattern.digit_line_width_um = digits.at("line_width").positiveNumber();
  const JsonNode strokes = digits.at("strokes");
  for (int digit = 0; digit < 10; ++digit) {
    for (const JsonNode& stroke : strokes.at(std::to_string(digit)).items()) {
      pattern.digits[digit].push_back(strokeOf(stroke));
    }
  }
  pattern.validate(name);
  return pattern;
}

}  // namespace

void FiducialPattern::validate(const std::filesystem::path& name) const {
  const auto require = [&](bool holds, const char* path, const std::string& sentence) {
    if (!holds) throw InputError({name, path}, sentence);
  };
  const auto numbers = [&](int first, int last, const char* path) {
    require(first >= 10 && last <= 99 && first <= last, path,
            fmt::format("the numbers run from {} to {}; first <= last and two digits each (10 ... 99) are needed.",
                        first, last));
  };
  numbers(first_row, last_row, "$.rows");
  numbers(first_column, last_column, "$.columns");
  const auto positive = [&](double value, const char* path) {
    require(std::isfinite(value) && value > 0.0, path,
            fmt::format("{} is not allowed; a length in µm greater than zero is needed.", value));
  };
  positive(pitch_um, "$.pitch");
  positive(semi_axis_x_um, "$.ellipse.semi_axis_x");
  positive(semi_axis_y_um, "$.ellipse.semi_axis_y");
  positive(ellipse_line_width_um, "$.ellipse.line_width");
  positive(circle_radius_um, "$.circle.radius");
  positive(digit_offset_x_um, "$.digits.offset_x");
  positive(digit_offset_y_um, "$.digits.offset_y");
  positive(digit_line_width_um, "$.digits.line_width");
  const double half_line = 0.5 * ellipse_line_width_um;
  require(std::max(semi_axis_x_um, semi_axis_y_um) + half_line < 0.5 * pitch_um, "$.ellipse",
          fmt::format("neighbouring ellipses touch: semi-axis plus half the line is {} µm, half the pitch {} µm.",
                      std::max(semi_axis_x_um, semi_axis_y_um) + half_line, 0.5 * pitch_um));
  require(std::min(semi_axis_x_um, semi_axis_y_um) > 2.0 * ellipse_line_width_um, "$.ellipse.line_width",
          "the line is wider than half a semi-axis; a thinner one is needed.");
  require(std::abs(semi_axis_x_um - semi_axis_y_um) > 0.05 * semi_axis_x_um, "$.ellipse",
          "the semi-axes differ by less than 5 %; the direction of the ellipse could not be seen.");
  // The circles stand between the ellipses: nearest ellipse centre in units of the axes, grown by circle and line.
  const double dx = circle_offset_x_um - pitch_um * std::round(circle_offset_x_um / pitch_um);
  const double dy = circle_offset_y_um - pitch_um * std::round(circle_offset_y_um / pitch_um);
  const double grow = half_line + circle_radius_um;
  require(std::hypot(dx / (semi_axis_x_um + grow), dy / (semi_axis_y_um + grow)) > 1.0, "$.circle",
          fmt::format("a circle of radius {} µm at ({}, {}) µm from an ellipse's centre touches the ellipse.",
                      circle_radius_um, dx, dy));
  require(2.0 * circle_radius_um < pitch_um, "$.circle.radius", "neighbouring circles touch.");
  for (int digit = 0; digit < 10; ++digit) {
    require(!digits[digit].empty(), "$.digits.strokes", fmt::format("digit {} has no strokes.", digit));
    for (const PatternStroke& stroke : digits[digit]) {
      for (const Eigen::Vector2d& p : stroke) {
        require(p.allFinite(), "$.digits.strokes", fmt::format("digit {} has a point that is not a number.", digit));
        const double x = digit_offset_x_um + std::abs(p.x()) + 0.5 * digit_line_width_um;
        const double y = digit_offset_y_um + std::abs(p.y()) + 0.5 * digit_line_width_um;
        require(std::hypot(x / (semi_axis_x_um - half_line), y / (semi_axis_y_um - half_line)) < 1.0,
                "$.digits.strokes", fmt::format("digit {} leaves its ellipse at ({}, {}) µm.", digit, p.x(), p.y()));
        require(std::abs(p.x()) + 0.5 * digit_line_width_um < digit_offset_x_um &&
                    std::abs(p.y()) + 0.5 * digit_line_width_um < digit_offset_y_um,
                "$.digits.strokes",
                fmt::format("digit {} touches its neighbour digit at ({}, {}) µm.", digit, p.x(), p.y()));
      }
    }
  }
}

const FiducialPattern& standardPattern() {
  static const FiducialPattern pattern = parsePattern(standard_pattern_json, "pattern.json");
  return pattern;
}

FiducialPattern readPattern(const std::filesystem::path& file) {
  return patternOf(JsonNode::read(file), file);
}

FiducialPattern parsePattern(std::string_view json, const std::filesystem::path& name) {
  return patternOf(JsonNode::parse(json, name), name);
}

std::string patternJson(const FiducialPattern& p) {
  nlohmann::ordered_json strokes = nlohmann::ordered_json::object();
  for (int digit = 0; digit < 10; ++digit) {
    auto& list = strokes[std::to_string(digit)] = nlohmann::ordered_json::array();
    for (const PatternStroke& stroke : p.digits[digit]) {
      nlohmann::ordered_json points = nlohmann::ordered_json::array();
      for (const Eigen::Vector2d& point : stroke) points.push_back({point.x(), point.y()});
      list.push_back(points);
    }
  }
  nlohmann::ordered_json json = {
      {"format", "spindrift-fiducial-pattern"},
      {"version", 1},
      {"unit", "um"},
      {"rows", {p.first_row, p.last_row}},
      {"columns", {p.first_column, p.last_column}},
      {"pitch", p.pitch_um},
      {"ellipse",
       {{"semi_axis_x", p.semi_axis_x_um}, {"semi_axis_y", p.semi_axis_y_um}, {"line_width", p.ellipse_line_width_um}}},
      {"circle",
       {{"radius", p.circle_radius_um},
        {"offset_x", p.circle_offset_x_um},
        {"offset_y", p.circle_offset_y_um},
        {"columns", {p.first_circle_column, p.last_circle_column + 1}},
        {"rows", {p.first_circle_row, p.last_circle_row + 1}},
        {"note",
         fmt::format("filled; centre of circle (i,j) at ({}+{} i, {}+{} j); columns and rows: first index, last "
                     "index + 1",
                     p.circle_offset_x_um, p.pitch_um, p.circle_offset_y_um, p.pitch_um)}}},
      {"digits",
       {{"offset_x", p.digit_offset_x_um},
        {"offset_y", p.digit_offset_y_um},
        {"line_width", p.digit_line_width_um},
        {"note",
         "row tens upper left, row units upper right, column tens lower left, column units lower right; up = +Y "
         "(increasing row), so rows increase upwards when the pattern is seen from above"},
        {"strokes", strokes}}}};
  return json.dump(1) + "\n";
}

}  // namespace spindrift
