// SPDX-License-Identifier: Apache-2.0
// Drawings and texts on a surface of Cairo: what the writers of pictures and of printed reports share. Nobody else
// includes this: the headers of Cairo and Pango stay in their files.
#pragma once

#include <cairo.h>
#include <pango/pango.h>

#include <memory>
#include <string>
#include <string_view>

#include "core/reporting/drawing.h"

namespace spindrift {

struct CairoDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, CairoDeleter>;
using Cairo = std::unique_ptr<cairo_t, CairoDeleter>;
using Layout = std::shared_ptr<PangoLayout>;

/// px of a layout are 96 an inch, points of a PDF 72.
inline constexpr double points_per_px = 0.75;

/// A PDF that is written into `bytes`, which has to live as long. Its one unit is a px, its page `width` x `height`.
[[nodiscard]] CairoSurface pdfSurface(std::string& bytes, double width_px, double height_px);
/// Ends a PDF. Throws InputError if Cairo could not write it.
void finish(const CairoSurface& surface);

void setColour(cairo_t* cairo, PictureColour colour, double opacity = 1.0);

/// A text of one font, in the font of the reports with figures of one width.
[[nodiscard]] Layout layoutOf(cairo_t* cairo, std::string_view text, double size_px, bool bold = false);

/// The shapes of a drawing, its upper left corner at the origin.
void drawOn(cairo_t* cairo, const Drawing& drawing);

}  // namespace spindrift
