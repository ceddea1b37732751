// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/picture_canvas.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

std::string hex(PictureColour c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

class SvgCanvas final : public PictureCanvas {
 public:
  SvgCanvas(int width, int height) {
    out_ = fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" )"
                       R"(font-family="Inter, Helvetica, Arial, sans-serif" fill="#1f2933">)"
                       "\n"
                       R"(<rect width="{0}" height="{1}" fill="#ffffff"/>)"
                       "\n",
                       width, height);
  }
  void rectangle(double x, double y, double width, double height, PictureColour fill) override {
    out_ += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
        "shape-rendering=\"crispEdges\"/>\n",
        x, y, width, height, hex(fill));
  }
  void line(double x1, double y1, double x2, double y2, PictureColour colour, double width) override {
    out_ += fmt::format(
        "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" "
        "stroke-width=\"{:.2f}\" stroke-linecap=\"round\"/>\n",
        x1, y1, x2, y2, hex(colour), width);
  }
  void disc(double x, double y, double radius, PictureColour fill, PictureColour border) override {
    out_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\" stroke=\"{}\"/>\n", x, y, radius,
                        hex(fill), hex(border));
  }
  void text(double x, double y, std::string_view text, double size, TextAnchor anchor, bool bold, bool upwards,
            bool halo) override {
    const char* where = anchor == TextAnchor::Start ? "start" : anchor == TextAnchor::Middle ? "middle" : "end";
    out_ += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:g}\" text-anchor=\"{}\"", x, y, size, where);
    if (bold) out_ += " font-weight=\"600\"";
    if (upwards) out_ += fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", x, y);
    if (halo) out_ += " stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\" stroke-linejoin=\"round\"";
    out_ += ">" + escapedXml(text) + "</text>\n";
  }
  std::string finish() override { return out_ + "</svg>\n"; }

 private:
  std::string out_;
};

/// OpenCV's fonts know ASCII only.
std::string ascii(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto starts = [&](std::string_view s) { return text.substr(i, s.size()) == s; };
    if (starts("\u2212")) {
      out += '-';
      i += 3;
    } else if (starts("\u00b1")) {
      out += "+/-";
      i += 2;
    } else if (static_cast<unsigned char>(text[i]) < 0x80) {
      out += text[i++];
    } else {
      out += '?';
      ++i;
      while (i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U) ++i;
    }
  }
  return out;
}

class PngCanvas final : public PictureCanvas {
 public:
  PngCanvas(int width, int height, double scale)
      : scale_(scale),
        image_(static_cast<int>(std::lround(height * scale)), static_cast<int>(std::lround(width * scale)), CV_8UC3,
               cv::Scalar::all(255)) {}
  void rectangle(double x, double y, double width, double height, PictureColour fill) override {
    const cv::Point from(pixel(x), pixel(y));
    const cv::Point to(pixel(x + width) - 1, pixel(y + height) - 1);
    if (to.x < from.x || to.y < from.y) return;
    cv::rectangle(image_, from, to, scalar(fill), cv::FILLED);
  }
  void line(double x1, double y1, double x2, double y2, PictureColour colour, double width) override {
    cv::line(image_, fixed(x1, y1), fixed(x2, y2), scalar(colour), thickness(width), cv::LINE_AA, fraction_bits);
  }
  void disc(double x, double y, double radius, PictureColour fill, PictureColour border) override {
    const int r = static_cast<int>(std::lround(radius * scale_ * (1 << fraction_bits)));
    cv::circle(image_, fixed(x, y), r, scalar(fill), cv::FILLED, cv::LINE_AA, fraction_bits);
    cv::circle(image_, fixed(x, y), r, scalar(border), thickness(1.0), cv::LINE_AA, fraction_bits);
  }
  void text(double x, double y, std::string_view text, double size, TextAnchor anchor, bool bold, bool upwards,
            bool halo) override {
    const std::string plain = ascii(text);
    constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
    constexpr double capital_height = 0.72;  // of the size of the type
    const int strength = thickness(bold ? 1.1 : 0.7);
    const double font_scale =
        cv::getFontScaleFromHeight(font, static_cast<int>(std::lround(capital_height * size * scale_)), strength);
    int base = 0;
    const cv::Size box = cv::getTextSize(plain, font, font_scale, strength, &base);
    const double length = box.width;
    const double shift = anchor == TextAnchor::Start ? 0.0 : anchor == TextAnchor::Middle ? 0.5 * length : length;
    const cv::Scalar ink(0x33, 0x29, 0x1f);
    if (!upwards) {
      const cv::Point at(static_cast<int>(std::lround(x * scale_ - shift)), pixel(y));
      if (halo) {
        cv::putText(image_, plain, at, font, font_scale, cv::Scalar::all(255), strength + thickness(2.5), cv::LINE_AA);
      }
      cv::putText(image_, plain, at, font, font_scale, ink, strength, cv::LINE_AA);
      return;
    }
    cv::Mat flat(box.height + 2 * base + 4, box.width + 4, CV_8UC3, cv::Scalar::all(255));
    cv::putText(flat, plain, {2, box.height + base}, font, font_scale, ink, strength, cv::LINE_AA);
    cv::Mat turned;
    cv::rotate(flat, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
    const int left = pixel(x) - box.height - base;
    const int top = static_cast<int>(std::lround(y * scale_ + shift)) - turned.rows;
    const cv::Rect target(left, top, turned.cols, turned.rows);
    const cv::Rect inside = target & cv::Rect(0, 0, image_.cols, image_.rows);
    if (inside.empty()) return;
    turned(cv::Rect(inside.x - target.x, inside.y - target.y, inside.width, inside.height)).copyTo(image_(inside));
  }
  std::string finish() override {
    std::vector<unsigned char> bytes;
    const bool done = cv::imencode(".png", image_, bytes);
    SPINDRIFT_ASSERT(done, "a picture can be encoded as PNG");
    return {bytes.begin(), bytes.end()};
  }

 private:
  static constexpr int fraction_bits = 4;
  [[nodiscard]] int pixel(double v) const { return static_cast<int>(std::lround(v * scale_)); }
  [[nodiscard]] int thickness(double v) const { return std::max(1, static_cast<int>(std::lround(v * scale_))); }
  [[nodiscard]] cv::Point fixed(double x, double y) const {
    return {static_cast<int>(std::lround(x * scale_ * (1 << fraction_bits))),
            static_cast<int>(std::lround(y * scale_ * (1 << fraction_bits)))};
  }
  [[nodiscard]] static cv::Scalar scalar(PictureColour c) { return {double(c.blue), double(c.green), double(c.red)}; }

  double scale_;
  cv::Mat image_;
};

}  // namespace

std::unique_ptr<PictureCanvas> makeSvgCanvas(int width, int height) {
  return std::make_unique<SvgCanvas>(width, height);
}
std::unique_ptr<PictureCanvas> makePngCanvas(int width, int height, double scale) {
  return std::make_unique<PngCanvas>(width, height, scale);
}

}  // namespace spindrift
