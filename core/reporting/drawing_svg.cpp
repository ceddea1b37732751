// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/base/text.h"
#include "core/reporting/drawing.h"

namespace spindrift {
namespace {

std::string hex(PictureColour c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

/// A length without superfluous zeros: "12.5", "3".
std::string length(double value) {
  std::string text = fmt::format("{:.2f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string attributes(const Paint& paint) {
  std::string out = paint.fill ? fmt::format(" fill=\"{}\"", hex(*paint.fill)) : std::string(" fill=\"none\"");
  if (paint.stroke) {
    out += fmt::format(" stroke=\"{}\"", hex(*paint.stroke));
    if (paint.width != 1.0) out += fmt::format(" stroke-width=\"{:g}\"", paint.width);
    if (paint.round) out += " stroke-linecap=\"round\"";
  }
  if (paint.opacity < 1.0) out += fmt::format(" opacity=\"{:g}\"", paint.opacity);
  if (paint.crisp) out += " shape-rendering=\"crispEdges\"";
  return out;
}

struct SvgWriter {
  std::string out;

  void operator()(const Drawing::Rectangle& r) {
    out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}/>\n", length(r.x), length(r.y),
                       length(r.width), length(r.height), attributes(r.paint));
  }
  void operator()(const Drawing::Disc& d) {
    out += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>\n", length(d.x), length(d.y), length(d.radius),
                       attributes(d.paint));
  }
  void operator()(const Drawing::Path& p) {
    std::string data;
    for (const auto& stroke : p.strokes) {
      for (std::size_t i = 0; i < stroke.size(); ++i) {
        data += i == 0 ? 'M' : 'L';
        data += length(stroke[i][0]) + ' ' + length(stroke[i][1]);
      }
      if (p.closed) data += 'Z';
    }
    if (!data.empty()) out += fmt::format("<path d=\"{}\"{}/>\n", data, attributes(p.paint));
  }
  void operator()(const Drawing::Text& t) {
    out += fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{:g}\"", length(t.x), length(t.y), t.look.size);
    if (t.look.anchor != TextAnchor::Start)
      out += t.look.anchor == TextAnchor::Middle ? " text-anchor=\"middle\"" : " text-anchor=\"end\"";
    if (t.look.colour != picture_ink) out += fmt::format(" fill=\"{}\"", hex(t.look.colour));
    if (t.look.bold) out += " font-weight=\"600\"";
    if (t.look.upwards) out += fmt::format(" transform=\"rotate(-90 {} {})\"", length(t.x), length(t.y));
    if (t.look.halo) out += " stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\" stroke-linejoin=\"round\"";
    out += ">" + escapedXml(t.text) + "</text>\n";
  }
  void operator()(const Drawing::Picture& p) {
    out +=
        fmt::format("<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" xlink:href=\"data:image/jpeg;base64,{}\"/>\n",
                    length(p.x), length(p.y), length(p.width), length(p.height), base64(p.jpeg));
  }
  // A drawing inside cuts off by itself: no ids, which would be there twice in a report.
  void operator()(const Drawing::Window& w) {
    out += fmt::format("<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\">\n",
                       length(w.x), length(w.y), length(w.width), length(w.height));
  }
  void operator()(const Drawing::WindowEnd&) { out += "</svg>\n"; }
};

}  // namespace

std::string svgOf(const Drawing& drawing) {
  SvgWriter writer;
  writer.out = fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" )"
                           R"(viewBox="0 0 {0} {1}" width="{0}" height="{1}" )"
                           R"(font-family="Inter, 'DejaVu Sans', sans-serif" fill="{2}">)",
                           length(drawing.width()), length(drawing.height()), hex(picture_ink));
  for (const Drawing::Shape& shape : drawing.shapes()) std::visit(writer, shape);
  return writer.out + "</svg>\n";
}

}  // namespace spindrift
