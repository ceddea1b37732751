// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/artwork.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

namespace spindrift {
namespace {

/// Text of DXF entities, mm.
class DxfWriter {
 public:
  explicit DxfWriter(std::string& text) : text_(text) {}

  void polyline(const char* layer, const std::vector<Eigen::Vector2d>& points_um, double width_um, bool closed) {
    begin(layer, width_um, closed);
    for (const Eigen::Vector2d& p : points_um) vertex(layer, p, 0.0);
    text_ += fmt::format("0\nSEQEND\n8\n{}\n", layer);
  }

  /// A filled disc: a closed polyline of two half circles of half the radius, as wide as the radius.
  void disc(const char* layer, const Eigen::Vector2d& centre_um, double radius_um) {
    begin(layer, radius_um, true);
    vertex(layer, centre_um - Eigen::Vector2d(0.5 * radius_um, 0.0), 1.0);
    vertex(layer, centre_um + Eigen::Vector2d(0.5 * radius_um, 0.0), 1.0);
    text_ += fmt::format("0\nSEQEND\n8\n{}\n", layer);
  }

 private:
  void begin(const char* layer, double width_um, bool closed) {
    const double width = width_um * mm_per_um;
    text_ += fmt::format("0\nPOLYLINE\n8\n{}\n66\n1\n10\n0.0\n20\n0.0\n30\n0.0\n70\n{}\n40\n{:.7f}\n41\n{:.7f}\n",
                         layer, closed ? 1 : 0, width, width);
  }
  void vertex(const char* layer, const Eigen::Vector2d& p_um, double bulge) {
    text_ += fmt::format("0\nVERTEX\n8\n{}\n10\n{:.7f}\n20\n{:.7f}\n30\n0.0\n", layer, p_um.x() * mm_per_um,
                         p_um.y() * mm_per_um);
    if (bulge != 0.0) text_ += fmt::format("42\n{:.1f}\n", bulge);
  }
  std::string& text_;
};

/// True at the ends of a stroke and where it turns by more than 20 degrees.
bool needsRound(const PatternStroke& stroke, std::size_t k) {
  if (k == 0 || k + 1 == stroke.size()) return true;
  const Eigen::Vector2d a = (stroke[k] - stroke[k - 1]).normalized();
  const Eigen::Vector2d b = (stroke[k + 1] - stroke[k]).normalized();
  return a.dot(b) < std::cos(20.0 * rad_per_deg);
}

}  // namespace

FiducialPattern makePattern(const ArtworkOptions& options) {
  if (options.rows < 1 || options.columns < 1) {
    throw InputError(fmt::format("{} rows and {} columns are not allowed; at least one of each is needed.",
                                 options.rows, options.columns));
  }
  if (!(options.pitch_um >= 20.0 && options.pitch_um <= 1e5)) {
    throw InputError(fmt::format("a pitch of {} µm is not allowed; 20 ... 100000 µm are.", options.pitch_um));
  }
  FiducialPattern pattern = standardPattern();
  const double scale = options.pitch_um / pattern.pitch_um;
  pattern.first_row = options.first_row;
  pattern.last_row = options.first_row + options.rows - 1;
  pattern.first_column = options.first_column;
  pattern.last_column = options.first_column + options.columns - 1;
  pattern.first_circle_column = -1;
  pattern.last_circle_column = options.columns - 1;
  pattern.first_circle_row = -1;
  pattern.last_circle_row = options.rows - 1;
  for (double* length :
       {&pattern.pitch_um, &pattern.semi_axis_x_um, &pattern.semi_axis_y_um, &pattern.ellipse_line_width_um,
        &pattern.circle_radius_um, &pattern.circle_offset_x_um, &pattern.circle_offset_y_um, &pattern.digit_offset_x_um,
        &pattern.digit_offset_y_um, &pattern.digit_line_width_um}) {
    *length *= scale;
  }
  for (auto& digit : pattern.digits) {
    for (PatternStroke& stroke : digit) {
      for (Eigen::Vector2d& p : stroke) p *= scale;
    }
  }
  pattern.validate();
  return pattern;
}

std::string artworkSvg(const FiducialPattern& pattern) {
  const double margin = 0.5 * pattern.pitch_um + 3.0 * pattern.circle_radius_um;
  const double left = -margin;
  const double bottom = -margin;
  const double width = (pattern.columnCount() - 1) * pattern.pitch_um + 2.0 * margin;
  const double height = (pattern.rowCount() - 1) * pattern.pitch_um + 2.0 * margin;
  std::string text;
  text += fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}mm\" "
      "height=\"{}mm\" viewBox=\"{} {} {} {}\">\n<title>Fiducial, rows {} to {}, columns {} to {}, pitch {} "
      "um; user unit um</title>\n<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"black\"/>\n<g "
      "transform=\"scale(1,-1)\" stroke=\"white\" fill=\"none\" stroke-linecap=\"round\" "
      "stroke-linejoin=\"round\">\n",
      exactNumber(width * mm_per_um), exactNumber(height * mm_per_um), exactNumber(left), exactNumber(-bottom - height),
      exactNumber(width), exactNumber(height), pattern.first_row, pattern.last_row, pattern.first_column,
      pattern.last_column, exactNumber(pattern.pitch_um), exactNumber(left), exactNumber(-bottom - height),
      exactNumber(width), exactNumber(height));
  for (int j = pattern.first_circle_row; j <= pattern.last_circle_row; ++j) {
    for (int i = pattern.first_circle_column; i <= pattern.last_circle_column; ++i) {
      const Eigen::Vector2d c = pattern.circleCentre(i, j);
      text += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"white\" stroke=\"none\"/>\n", exactNumber(c.x()),
                          exactNumber(c.y()), exactNumber(pattern.circle_radius_um));
    }
  }
  for (int row = pattern.first_row; row <= pattern.last_row; ++row) {
    for (int column = pattern.first_column; column <= pattern.last_column; ++column) {
      const Eigen::Vector2d e = pattern.ellipseCentre(row, column);
      text += fmt::format("<ellipse cx=\"{}\" cy=\"{}\" rx=\"{}\" ry=\"{}\" stroke-width=\"{}\"/>\n",
                          exactNumber(e.x()), exactNumber(e.y()), exactNumber(pattern.semi_axis_x_um),
                          exactNumber(pattern.semi_axis_y_um), exactNumber(pattern.ellipse_line_width_um));
      const auto digits = FiducialPattern::digitsOf(row, column);
      for (int k = 0; k < 4; ++k) {
        const Eigen::Vector2d d = e + pattern.digitCentre(k);
        for (const PatternStroke& stroke : pattern.digits[digits[k]]) {
          text += fmt::format("<polyline stroke-width=\"{}\" points=\"", exactNumber(pattern.digit_line_width_um));
          for (const Eigen::Vector2d& p : stroke) text += fmt::format("{:.4f},{:.4f} ", d.x() + p.x(), d.y() + p.y());
          text += "\"/>\n";
        }
      }
    }
  }
  text += "</g>\n</svg>\n";
  return text;
}

std::string artworkDxf(const FiducialPattern& pattern) {
  std::string text =
      "999\nFiducial artwork, mm, seen from above, marks bright on "
      "dark\n0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n0\n"
      "ENDSEC\n0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n3\n";
  for (const char* layer : {"ELLIPSES", "DIGITS", "CIRCLES"}) {
    text += fmt::format("0\nLAYER\n2\n{}\n70\n0\n62\n7\n6\nCONTINUOUS\n", layer);
  }
  text += "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
  DxfWriter dxf(text);
  for (int j = pattern.first_circle_row; j <= pattern.last_circle_row; ++j) {
    for (int i = pattern.first_circle_column; i <= pattern.last_circle_column; ++i) {
      dxf.disc("CIRCLES", pattern.circleCentre(i, j), pattern.circle_radius_um);
    }
  }
  for (int row = pattern.first_row; row <= pattern.last_row; ++row) {
    for (int column = pattern.first_column; column <= pattern.last_column; ++column) {
      const Eigen::Vector2d e = pattern.ellipseCentre(row, column);
      std::vector<Eigen::Vector2d> outline;
      for (int k = 0; k < 180; ++k) {
        const double t = 2.0 * std::numbers::pi * k / 180;
        outline.emplace_back(e.x() + pattern.semi_axis_x_um * std::cos(t),
                             e.y() + pattern.semi_axis_y_um * std::sin(t));
      }
      dxf.polyline("ELLIPSES", outline, pattern.ellipse_line_width_um, true);
      const auto digits = FiducialPattern::digitsOf(row, column);
      for (int k = 0; k < 4; ++k) {
        const Eigen::Vector2d d = e + pattern.digitCentre(k);
        for (const PatternStroke& stroke : pattern.digits[digits[k]]) {
          std::vector<Eigen::Vector2d> points;
          for (const Eigen::Vector2d& p : stroke) points.push_back(d + p);
          if (points.size() > 1) dxf.polyline("DIGITS", points, pattern.digit_line_width_um, false);
          for (std::size_t n = 0; n < stroke.size(); ++n) {
            if (needsRound(stroke, n)) dxf.disc("DIGITS", points[n], 0.5 * pattern.digit_line_width_um);
          }
        }
      }
    }
  }
  text += "0\nENDSEC\n0\nEOF\n";
  return text;
}

}  // namespace spindrift
