// SPDX-License-Identifier: Apache-2.0
#include <cairo-pdf.h>
#include <fmt/format.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "core/reporting/cairo_page.h"
#include "core/reporting/report.h"

namespace spindrift {
namespace {

// A4 at 96 px an inch; margins of 18 mm at the sides.
constexpr double page_width = 794.0, page_height = 1123.0;
constexpr double side_margin = 68.0, top_margin = 76.0, bottom_margin = 84.0;
constexpr double text_width = page_width - 2.0 * side_margin;
constexpr double text_height = page_height - top_margin - bottom_margin;
constexpr double text_px = 12.0, small_px = 10.0, least_px = 7.0;
constexpr double cell_gap = 14.0, cell_padding = 4.0;

constexpr PictureColour text_ink = picture_ink;
constexpr PictureColour soft{82, 96, 109};
constexpr PictureColour line_colour{217, 222, 228};
constexpr PictureColour accent{11, 114, 133};
constexpr PictureColour pale{244, 246, 248};

constexpr std::size_t longest_unbroken_pdf_table = 24;
/// Letters of a cell in the first column that is never broken.
constexpr std::size_t longest_pdf_name = 24;

PictureColour calloutColour(CalloutKind kind) {
  switch (kind) {
    case CalloutKind::Good:
      return {43, 122, 61};
    case CalloutKind::Attention:
      return {154, 103, 0};
    case CalloutKind::Bad:
      return {180, 35, 24};
    case CalloutKind::Note:
      break;
  }
  return soft;
}

double heightOf(PangoLayout* layout) {
  int height = 0;
  pango_layout_get_size(layout, nullptr, &height);
  return static_cast<double>(height) / PANGO_SCALE;
}

double widthOf(PangoLayout* layout) {
  PangoRectangle box;
  pango_layout_get_extents(layout, nullptr, &box);
  return static_cast<double>(box.width) / PANGO_SCALE;
}

/// What is never broken: it is drawn with its upper left corner at the origin.
struct Piece {
  double height = 0.0;
  double above = 0.0;  ///< distance from what stands above; none at the top of a page
  bool with_next = false;
  std::function<void(cairo_t*)> draw;
  std::optional<std::size_t> header = std::nullopt;   ///< piece to be repeated where a page begins with this one
  std::optional<std::size_t> section = std::nullopt;  ///< that begins here
};

/// Sets the blocks of a report as pieces, one below the other.
class Setter {
 public:
  explicit Setter(cairo_t* cairo) : cairo_(cairo) {}

  std::vector<Piece> pieces;
  std::vector<ReportPdf::Section> sections;

  void head(const Report& report) {
    text(report.title(), 20.0, true, text_ink, 0.0, true);
    text(report.subtitle(), text_px, false, soft, 4.0, true);
    add(2.0, 8.0, false, [](cairo_t* c) {
      setColour(c, accent);
      cairo_rectangle(c, 0.0, 0.0, text_width, 2.0);
      cairo_fill(c);
    });
    above_ = 16.0;
  }

  void operator()(const HeadingBlock& b) {
    const bool section = b.level == 1;
    const std::size_t at = pieces.size();
    text(b.text, section ? 15.0 : text_px, true, text_ink, section ? 22.0 : 14.0, true);
    if (!section) return;
    pieces[at].section = sections.size();
    sections.push_back({b.text.plain(), 0});
  }

  void operator()(const TextBlock& b) { text(b.text, text_px, false, text_ink, 6.0, false); }

  void operator()(const CalloutBlock& b) {
    constexpr double bar = 4.0, inside = 12.0, padding = 8.0;
    const Layout words = layout(b.text, text_px, true, text_width - bar - 2.0 * inside);
    sideBySide({words}, {bar + inside}, {text_ink}, padding, 10.0, text_height,
               [colour = calloutColour(b.kind)](cairo_t* c, double height, bool) {
                 setColour(c, pale);
                 cairo_rectangle(c, 0.0, 0.0, text_width, height);
                 cairo_fill(c);
                 setColour(c, colour);
                 cairo_rectangle(c, 0.0, 0.0, bar, height);
                 cairo_fill(c);
               });
    above_ = 10.0;
  }

  /// Line by line on pale ground; a line that is too long goes on below.
  void operator()(const CodeBlock& b) {
    constexpr double inside = 8.0;
    std::istringstream lines(b.text);
    bool first = true;
    for (std::string line; std::getline(lines, line); first = false) {
      const Layout words = layout(line.empty() ? std::string(" ") : line, small_px, false, text_width - 2.0 * inside);
      PangoFontDescription* font = pango_font_description_copy(pango_layout_get_font_description(words.get()));
      pango_font_description_set_family_static(font, "DejaVu Sans Mono, monospace");
      pango_layout_set_font_description(words.get(), font);
      pango_font_description_free(font);
      const double height = heightOf(words.get()) + 2.0;
      add(height, first ? 8.0 : 0.0, first, [=](cairo_t* c) {
        setColour(c, pale);
        cairo_rectangle(c, 0.0, 0.0, text_width, height + 0.5);
        cairo_fill(c);
        show(c, words, inside, 1.0, text_ink);
      });
    }
    above_ = 10.0;
  }

  void operator()(const FigureBlock& b) {
    const double scale = std::min({text_width / b.drawing.width(), 0.62 * text_height / b.drawing.height(), 1.0});
    const double picture = scale * b.drawing.height();
    const Layout caption = layout(b.caption, small_px, false, text_width);
    add(picture + 4.0 + heightOf(caption.get()), 8.0, false,
        [&drawing = b.drawing, caption, scale, picture](cairo_t* c) {
          cairo_save(c);
          cairo_scale(c, scale, scale);
          drawOn(c, drawing);
          cairo_restore(c);
          show(c, caption, 0.0, picture + 4.0, soft);
        });
    above_ = 10.0;
  }

  void operator()(const TableBlock& b) {
    if (b.rows.empty() && b.header.empty()) return;
    if (!b.caption.empty()) text(b.caption, small_px, false, soft, 10.0, true);
    const Columns columns = columnsOf(b);
    const bool whole = b.rows.size() <= longest_unbroken_pdf_table;
    std::optional<std::size_t> header;
    if (!b.header.empty()) {
      header = pieces.size();
      row(b, b.header, columns, true, text_height);
      pieces.back().with_next = true;
      // A header that fills half a page is not repeated.
      if (pieces.size() > *header + 1 || pieces.back().height > 0.5 * text_height) header = std::nullopt;
    }
    const double room = text_height - (header ? pieces[*header].height : 0.0);
    for (std::size_t i = 0; i < b.rows.size(); ++i) {
      const std::size_t first = pieces.size();
      row(b, b.rows[i], columns, false, room);
      for (std::size_t part = first; part < pieces.size(); ++part) pieces[part].header = header;
      pieces.back().with_next = i + 1 < b.rows.size() && (whole || i == 0 || i + 2 == b.rows.size());
    }
    above_ = 14.0;
  }

  /// Where people sign.
  void signatures(const Report& report) {
    (*this)(HeadingBlock{1, report.word("Signatures")});
    for (const char* who : {"Measured by", "Checked by"}) {
      constexpr double height = 62.0;
      add(height, 6.0, true, [this, who = report.word(who), &report](cairo_t* c) {
        double x = 0.0;
        for (const auto& [name, part] :
             {std::pair{who, 0.42}, {report.word("Date"), 0.18}, {report.word("Signature"), 0.40}}) {
          show(c, layout(name, small_px, true, part * text_width), x, 0.0, soft);
          x += part * text_width;
        }
        rule(c, height - 4.0, line_colour, 1.0);
      });
    }
    pieces.back().with_next = false;
  }

 private:
  void add(double height, double above, bool with_next, std::function<void(cairo_t*)> draw) {
    const double gap = pieces.empty() ? 0.0 : std::max(above, std::exchange(above_, 0.0));
    pieces.push_back({height, gap, with_next, std::move(draw)});
  }

  [[nodiscard]] Layout layout(const ReportText& words, double px, bool bold, double width) const {
    Layout made = layoutOf(cairo_, words.plain(), px, bold);
    PangoAttrList* attributes = pango_layout_get_attributes(made.get());
    unsigned from = 0;
    for (const ReportText::Run& run : words.runs) {
      const unsigned to = from + static_cast<unsigned>(run.text.size());
      if (run.small) {
        for (PangoAttribute* attribute :
             {pango_attr_size_new_absolute(static_cast<int>(std::max(least_px, px - 3.0) * PANGO_SCALE)),
              pango_attr_weight_new(PANGO_WEIGHT_NORMAL),
              pango_attr_foreground_new(soft.red * 257, soft.green * 257, soft.blue * 257)}) {
          attribute->start_index = from;
          attribute->end_index = to;
          pango_attr_list_insert(attributes, attribute);
        }
      }
      from = to;
    }
    if (width > 0.0) {
      pango_layout_set_width(made.get(), static_cast<int>(width * PANGO_SCALE));
      pango_layout_set_wrap(made.get(), PANGO_WRAP_WORD_CHAR);
    }
    return made;
  }

  static void show(cairo_t* c, const Layout& words, double x, double y, PictureColour colour) {
    setColour(c, colour);
    cairo_move_to(c, x, y);
    pango_cairo_show_layout(c, words.get());
  }

  static void rule(cairo_t* c, double y, PictureColour colour, double width) {
    setColour(c, colour);
    cairo_set_line_width(c, width);
    cairo_move_to(c, 0.0, y);
    cairo_line_to(c, text_width, y);
    cairo_stroke(c);
  }

  /// Line by line, so that a long text may go on on the next page: two lines at least stay together.
  void text(const ReportText& words, double px, bool bold, PictureColour colour, double above, bool with_next) {
    const Layout set = layout(words, px, bold, text_width);
    const std::vector<Line> lines = linesOf(set.get());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const bool together = with_next || i == 0 || i + 2 == lines.size();
      add(lines[i].bottom - lines[i].top, i == 0 ? above : 0.0, i + 1 < lines.size() ? together : with_next,
          [set, line = lines[i].line, base = lines[i].base - lines[i].top, colour](cairo_t* c) {
            setColour(c, colour);
            cairo_move_to(c, 0.0, base);
            pango_cairo_show_layout_line(c, line);
          });
    }
    above_ = 4.0;
  }

  struct Columns {
    double px = small_px;  ///< of the type
    std::vector<double> widths;
    double gap = cell_gap;
  };

  /// The size of the type and the widths of the columns: as wide as their content; where that does not fit, columns of
  /// words are broken first, then the type gets smaller.
  [[nodiscard]] Columns columnsOf(const TableBlock& b) const {
    if (b.isFacts()) return {small_px + 1.0, {0.32 * text_width - cell_gap, 0.68 * text_width}};
    const std::size_t columns = b.header.size();
    double px = columns > 7 ? small_px - 1.0 : columns > 5 ? small_px : small_px + 1.0;
    const double gap = std::min(cell_gap, 0.3 * text_width / static_cast<double>(columns));
    const double room = text_width - gap * static_cast<double>(columns - 1);
    for (;; px -= 1.0) {
      std::vector<double> least(columns, 0.0), wanted(columns, 0.0);
      const auto weigh = [&](const ReportRow& cells, bool head) {
        for (std::size_t i = 0; i < columns; ++i) {
          const Layout set = layout(cells[i], px, head, 0.0);
          const double width = std::ceil(widthOf(set.get())) + 1.0;
          wanted[i] = std::max(wanted[i], width);
          const bool breakable = head || (i > 0 ? b.of_words[i] : cells[i].plain().size() > longest_pdf_name);
          least[i] = std::max(least[i], breakable ? longestWord(cells[i], px, head) : width);
        }
      };
      weigh(b.header, true);
      for (const ReportRow& cells : b.rows) weigh(cells, false);
      const double narrow = std::accumulate(least.begin(), least.end(), 0.0);
      const double wide = std::accumulate(wanted.begin(), wanted.end(), 0.0);
      if (narrow > room && px > least_px) continue;
      if (narrow > room) {
        for (double& width : least) width *= room / narrow;
        return {px, least, gap};
      }
      // Between the least and the wanted widths, or beyond the wanted ones in proportion.
      const double part = wide > narrow ? std::min(1.0, (room - narrow) / (wide - narrow)) : 1.0;
      for (std::size_t i = 0; i < columns; ++i)
        least[i] = wide <= room ? wanted[i] * room / wide : least[i] + part * (wanted[i] - least[i]);
      return {px, least, gap};
    }
  }

  [[nodiscard]] double longestWord(const ReportText& words, double px, bool bold) const {
    const Layout set = layout(words, px, bold, 1.0);
    pango_layout_set_wrap(set.get(), PANGO_WRAP_WORD);
    return std::ceil(widthOf(set.get())) + 1.0;
  }

  void row(const TableBlock& b, const ReportRow& cells, const Columns& columns, bool head, double room) {
    std::vector<Layout> set;
    std::vector<double> left;
    std::vector<PictureColour> colours;
    double x = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      set.push_back(layout(cells[i], columns.px, head, columns.widths[i]));
      if (i > 0 && !b.of_words[i]) pango_layout_set_alignment(set.back().get(), PANGO_ALIGN_RIGHT);
      left.push_back(x);
      colours.push_back(b.isFacts() && i == 0 ? soft : text_ink);
      x += columns.widths[i] + columns.gap;
    }
    sideBySide(set, left, colours, cell_padding, 0.0, room, [head](cairo_t* c, double height, bool last) {
      if (last) rule(c, height, head ? soft : line_colour, head ? 1.0 : 0.6);
    });
  }

  struct Line {
    PangoLayoutLine* line = nullptr;  ///< of its layout
    double x = 0.0, base = 0.0, top = 0.0, bottom = 0.0;
  };
  static std::vector<Line> linesOf(PangoLayout* set) {
    std::vector<Line> lines;
    PangoLayoutIter* at = pango_layout_get_iter(set);
    do {
      int top = 0, bottom = 0;
      PangoRectangle box;
      pango_layout_iter_get_line_yrange(at, &top, &bottom);
      pango_layout_iter_get_line_extents(at, nullptr, &box);
      constexpr double unit = 1.0 / PANGO_SCALE;
      lines.push_back({pango_layout_iter_get_line_readonly(at), unit * box.x, unit * pango_layout_iter_get_baseline(at),
                       unit * top, unit * bottom});
    } while (pango_layout_iter_next_line(at) != 0);
    pango_layout_iter_free(at);
    return lines;
  }

  /// Texts side by side with `padding` above and below: one piece, or as many as are needed where that is higher than
  /// `room`. `around` draws what stands behind and beneath: the height of a piece, and whether it is the last.
  void sideBySide(const std::vector<Layout>& set, const std::vector<double>& left,
                  const std::vector<PictureColour>& colours, double padding, double above, double room,
                  const std::function<void(cairo_t*, double, bool)>& around) {
    std::vector<std::vector<Line>> rest;
    for (const Layout& one : set) rest.push_back(linesOf(one.get()));
    for (bool more = true; more; above = 0.0) {
      more = false;
      double height = 0.0;
      std::vector<std::vector<Line>> part(set.size());
      for (std::size_t i = 0; i < set.size(); ++i) {
        std::size_t count = 0;
        const double top = rest[i].empty() ? 0.0 : rest[i].front().top;
        while (count < rest[i].size() && (count == 0 || rest[i][count].bottom - top <= room - 2.0 * padding)) ++count;
        part[i].assign(rest[i].begin(), rest[i].begin() + static_cast<std::ptrdiff_t>(count));
        for (Line& line : part[i]) {
          line.base += padding - top;
          height = std::max(height, line.bottom - top);
        }
        rest[i].erase(rest[i].begin(), rest[i].begin() + static_cast<std::ptrdiff_t>(count));
        more = more || !rest[i].empty();
      }
      height += 2.0 * padding;
      // The lines are those of the layouts, which have to live as long.
      add(height, above, false, [set, part = std::move(part), left, colours, around, height, last = !more](cairo_t* c) {
        around(c, height, last);
        for (std::size_t i = 0; i < part.size(); ++i) {
          setColour(c, colours[i]);
          for (const Line& line : part[i]) {
            cairo_move_to(c, left[i] + line.x, line.base);
            pango_cairo_show_layout_line(c, line.line);
          }
        }
      });
    }
  }

  cairo_t* cairo_;
  double above_ = 0.0;  ///< least distance to what comes next
};

struct Place {
  std::size_t piece = 0;
  double y = 0.0;
};

/// Which pieces stand on which page and where.
std::vector<std::vector<Place>> pagesOf(const std::vector<Piece>& pieces) {
  std::vector<std::vector<Place>> pages(1);
  double y = 0.0;
  const auto newPage = [&](std::size_t first) {
    pages.emplace_back();
    y = 0.0;
    if (!pieces[first].header) return;
    pages.back().push_back({*pieces[first].header, 0.0});
    y = pieces[*pieces[first].header].height;
  };
  for (std::size_t i = 0; i < pieces.size();) {
    std::size_t end = i;
    double together = 0.0;
    do {
      together += pieces[end].height + (end > i ? pieces[end].above : 0.0);
    } while (pieces[end++].with_next && end < pieces.size());
    const bool begun = !pages.back().empty();
    if (begun && y + pieces[i].above + together > text_height && together <= text_height) newPage(i);
    for (; i < end; ++i) {
      double above = pages.back().empty() ? 0.0 : pieces[i].above;
      if (!pages.back().empty() && y + above + pieces[i].height > text_height) {
        newPage(i);
        above = 0.0;
      }
      pages.back().push_back({i, y + above});
      y += above + pieces[i].height;
    }
  }
  return pages;
}

/// What stands on every page beside its text: the title from the second on, the number of the page.
void drawMargins(cairo_t* cairo, const Report& report, std::size_t page, std::size_t pages) {
  const auto line = [&](std::string_view left, const std::string& right, double y) {
    for (const bool end : {false, true}) {
      const Layout words = layoutOf(cairo, end ? std::string_view(right) : left, small_px);
      pango_layout_set_width(words.get(), static_cast<int>((end ? 160.0 : text_width - 170.0) * PANGO_SCALE));
      pango_layout_set_ellipsize(words.get(), PANGO_ELLIPSIZE_END);
      if (end) pango_layout_set_alignment(words.get(), PANGO_ALIGN_RIGHT);
      setColour(cairo, soft);
      cairo_move_to(cairo, side_margin + (end ? text_width - 160.0 : 0.0), y);
      pango_cairo_show_layout(cairo, words.get());
    }
  };
  const auto rule = [&](double y) {
    setColour(cairo, line_colour);
    cairo_set_line_width(cairo, 1.0);
    cairo_move_to(cairo, side_margin, y);
    cairo_line_to(cairo, page_width - side_margin, y);
    cairo_stroke(cairo);
  };
  if (page > 0) {
    line(report.title(), "Spindrift " SPINDRIFT_VERSION, 40.0);
    rule(60.0);
  }
  rule(page_height - 56.0);
  line(report.subtitle(), report.word(fmt::format("Page {} of {}", page + 1, pages)), page_height - 48.0);
}

}  // namespace

ReportPdf pdfOf(const Report& report, const JobContext& job) {
  ReportPdf out;
  const CairoSurface surface = pdfSurface(out.bytes, page_width, page_height);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, report.title().c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, "Spindrift " SPINDRIFT_VERSION);
  // What nobody signs is no record: the manual of a version has the same bytes whenever it is written.
  if (!report.isSigned()) cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  {
    const Cairo cairo(cairo_create(surface.get()));
    cairo_t* c = cairo.get();
    cairo_scale(c, points_per_px, points_per_px);
    Setter setter(c);
    setter.head(report);
    for (const ReportBlock& block : report.blocks()) {
      job.throwIfCancelled();
      std::visit(setter, block);
    }
    if (report.isSigned()) setter.signatures(report);
    const auto pages = pagesOf(setter.pieces);
    for (std::size_t page = 0; page < pages.size(); ++page) {
      job.report(static_cast<double>(page) / static_cast<double>(pages.size()), "pages");
      job.throwIfCancelled();
      drawMargins(c, report, page, pages.size());
      for (const Place& place : pages[page]) {
        const Piece& piece = setter.pieces[place.piece];
        cairo_save(c);
        cairo_translate(c, side_margin, top_margin + place.y);
        piece.draw(c);
        cairo_restore(c);
        if (!piece.section) continue;
        ReportPdf::Section& section = setter.sections[*piece.section];
        section.page = static_cast<int>(page);
        cairo_pdf_surface_add_outline(surface.get(), CAIRO_PDF_OUTLINE_ROOT, section.title.c_str(),
                                      fmt::format("page={} pos=[{:.1f} {:.1f}]", page + 1, side_margin * points_per_px,
                                                  (top_margin + place.y) * points_per_px)
                                          .c_str(),
                                      CAIRO_PDF_OUTLINE_FLAG_OPEN);
      }
      cairo_show_page(c);
    }
    out.pages = static_cast<int>(pages.size());
    out.sections = std::move(setter.sections);
  }
  finish(surface);
  return out;
}

}  // namespace spindrift
