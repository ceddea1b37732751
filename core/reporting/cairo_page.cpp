// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/cairo_page.h"

#include <cairo-pdf.h>
#include <fmt/format.h>
#include <pango/pangocairo.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/error.h"
#include "core/imaging/image_files.h"

namespace spindrift {
namespace {

constexpr const char* font_family = "Inter, DejaVu Sans, sans-serif";

cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

/// A JPEG as a surface; in a PDF its own bytes are kept. Null if it cannot be read.
CairoSurface pictureSurface(const std::string& jpeg) {
  const cv::Mat bytes(1, static_cast<int>(jpeg.size()), CV_8UC1, const_cast<char*>(jpeg.data()));
  const cv::Mat seen = imageFiles().decode(bytes, cv::IMREAD_COLOR);
  if (seen.empty()) return nullptr;
  CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, seen.cols, seen.rows));
  cairo_surface_flush(surface.get());
  cv::Mat pixels(seen.rows, seen.cols, CV_8UC4, cairo_image_surface_get_data(surface.get()),
                 static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get())));
  cv::cvtColor(seen, pixels, cv::COLOR_BGR2BGRA);
  cairo_surface_mark_dirty(surface.get());
  auto kept = std::make_unique<std::string>(jpeg);
  const auto* data = reinterpret_cast<const unsigned char*>(kept->data());
  const auto size = static_cast<unsigned long>(kept->size());
  if (cairo_surface_set_mime_data(
          surface.get(), CAIRO_MIME_TYPE_JPEG, data, size, [](void* text) { delete static_cast<std::string*>(text); },
          kept.get()) == CAIRO_STATUS_SUCCESS) {
    (void)kept.release();  // the surface's from here on
  }
  return surface;
}

struct Painter {
  cairo_t* cairo;

  /// The present path.
  void paint(const Paint& p) const {
    cairo_set_antialias(cairo, p.crisp ? CAIRO_ANTIALIAS_NONE : CAIRO_ANTIALIAS_DEFAULT);
    if (p.fill) {
      setColour(cairo, *p.fill, p.opacity);
      cairo_fill_preserve(cairo);
    }
    if (p.stroke) {
      setColour(cairo, *p.stroke, p.opacity);
      cairo_set_line_width(cairo, p.width);
      cairo_set_line_cap(cairo, p.round ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
      cairo_stroke_preserve(cairo);
    }
    cairo_new_path(cairo);
  }
  void operator()(const Drawing::Rectangle& r) const {
    cairo_rectangle(cairo, r.x, r.y, r.width, r.height);
    paint(r.paint);
  }
  void operator()(const Drawing::Disc& d) const {
    cairo_arc(cairo, d.x, d.y, d.radius, 0.0, 2.0 * std::numbers::pi);
    paint(d.paint);
  }
  void operator()(const Drawing::Path& p) const {
    for (const auto& stroke : p.strokes) {
      for (std::size_t i = 0; i < stroke.size(); ++i) {
        i == 0 ? cairo_move_to(cairo, stroke[i][0], stroke[i][1]) : cairo_line_to(cairo, stroke[i][0], stroke[i][1]);
      }
      if (p.closed) cairo_close_path(cairo);
    }
    paint(p.paint);
  }
  void operator()(const Drawing::Text& t) const {
    const Layout layout = layoutOf(cairo, t.text, t.look.size, t.look.bold);
    int width = 0;
    pango_layout_get_size(layout.get(), &width, nullptr);
    const double part = t.look.anchor == TextAnchor::Start ? 0.0 : t.look.anchor == TextAnchor::Middle ? 0.5 : 1.0;
    cairo_save(cairo);
    cairo_translate(cairo, t.x, t.y);
    if (t.look.upwards) cairo_rotate(cairo, -0.5 * std::numbers::pi);
    cairo_move_to(cairo, -part * width / PANGO_SCALE,
                  -static_cast<double>(pango_layout_get_baseline(layout.get())) / PANGO_SCALE);
    if (t.look.halo) {
      pango_cairo_layout_path(cairo, layout.get());
      paint({.stroke = PictureColour{255, 255, 255}, .width = 3.0, .round = true});
      cairo_move_to(cairo, -part * width / PANGO_SCALE,
                    -static_cast<double>(pango_layout_get_baseline(layout.get())) / PANGO_SCALE);
    }
    setColour(cairo, t.look.colour);
    pango_cairo_show_layout(cairo, layout.get());
    cairo_restore(cairo);
    cairo_new_path(cairo);
  }
  void operator()(const Drawing::Picture& p) const {
    const CairoSurface surface = pictureSurface(p.jpeg);
    if (surface == nullptr) return;
    cairo_save(cairo);
    cairo_translate(cairo, p.x, p.y);
    cairo_scale(cairo, p.width / cairo_image_surface_get_width(surface.get()),
                p.height / cairo_image_surface_get_height(surface.get()));
    cairo_set_source_surface(cairo, surface.get(), 0.0, 0.0);
    cairo_paint(cairo);
    cairo_restore(cairo);
  }
  void operator()(const Drawing::Window& w) const {
    cairo_save(cairo);
    cairo_rectangle(cairo, w.x, w.y, w.width, w.height);
    cairo_clip(cairo);
  }
  void operator()(const Drawing::WindowEnd&) const { cairo_restore(cairo); }
};

}  // namespace

CairoSurface pdfSurface(std::string& bytes, double width_px, double height_px) {
  return CairoSurface(
      cairo_pdf_surface_create_for_stream(append, &bytes, points_per_px * width_px, points_per_px * height_px));
}

void finish(const CairoSurface& surface) {
  cairo_surface_finish(surface.get());
  if (const cairo_status_t status = cairo_surface_status(surface.get()); status != CAIRO_STATUS_SUCCESS)
    throw InputError(fmt::format("the picture could not be drawn: {}.", cairo_status_to_string(status)));
}

void setColour(cairo_t* cairo, PictureColour c, double opacity) {
  cairo_set_source_rgba(cairo, c.red / 255.0, c.green / 255.0, c.blue / 255.0, opacity);
}

Layout layoutOf(cairo_t* cairo, std::string_view text, double size_px, bool bold) {
  Layout layout(pango_cairo_create_layout(cairo), [](PangoLayout* l) { g_object_unref(l); });
  PangoFontDescription* font = pango_font_description_new();
  pango_font_description_set_family_static(font, font_family);
  pango_font_description_set_absolute_size(font, size_px * PANGO_SCALE);
  if (bold) pango_font_description_set_weight(font, PANGO_WEIGHT_SEMIBOLD);
  pango_layout_set_font_description(layout.get(), font);
  pango_font_description_free(font);
  PangoAttrList* attributes = pango_attr_list_new();
  pango_attr_list_insert(attributes, pango_attr_font_features_new("tnum=1"));
  pango_layout_set_attributes(layout.get(), attributes);
  pango_attr_list_unref(attributes);
  pango_layout_set_text(layout.get(), text.data(), static_cast<int>(text.size()));
  return layout;
}

void drawOn(cairo_t* cairo, const Drawing& drawing) {
  for (const Drawing::Shape& shape : drawing.shapes()) std::visit(Painter{cairo}, shape);
}

std::string pngOf(const Drawing& drawing, double scale) {
  if (!(scale >= 0.5 && scale <= 8.0))
    throw InputError(fmt::format("a PNG scale of {} is not possible; allowed: 0.5 to 8.", scale));
  const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                        static_cast<int>(std::lround(drawing.width() * scale)),
                                                        static_cast<int>(std::lround(drawing.height() * scale))));
  const Cairo cairo(cairo_create(surface.get()));
  cairo_scale(cairo.get(), scale, scale);
  drawOn(cairo.get(), drawing);
  std::string bytes;
  if (cairo_surface_write_to_png_stream(surface.get(), append, &bytes) != CAIRO_STATUS_SUCCESS || bytes.empty())
    throw InputError(fmt::format("a picture of {:g} x {:g} px cannot be drawn.", drawing.width(), drawing.height()));
  return bytes;
}

std::string pdfOf(const Drawing& drawing) {
  std::string bytes;
  const CairoSurface surface = pdfSurface(bytes, drawing.width(), drawing.height());
  {
    const Cairo cairo(cairo_create(surface.get()));
    cairo_scale(cairo.get(), points_per_px, points_per_px);
    drawOn(cairo.get(), drawing);
  }
  finish(surface);
  return bytes;
}

}  // namespace spindrift
