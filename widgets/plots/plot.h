// SPDX-License-Identifier: GPL-3.0-or-later
// A plot in the program's manner: axes with quantity / unit, thin lines, points where measured, lines where predicted,
// bands for uncertainty, shaded spans. Drag pans, wheel zooms, double-click shows everything. By keyboard:
// left, right, Home and End move a cursor from value to value, up and down to the next series, shift and arrows pan,
// plus and minus zoom, 0 shows everything, Return picks the value, Escape takes the cursor away. QCustomPlot inside.
#pragma once

#include <QImage>
#include <QPointF>
#include <QRectF>
#include <QString>
#include <QStringList>
#include <QWidget>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "widgets/theme/theme.h"

class QCPItemStraightLine;
class QCPItemTracer;
class QCPItemText;
class QCustomPlot;

namespace spindrift::gui {

enum class SeriesStyle {
  Points,      ///< measured
  Line,        ///< predicted, or a dense signal
  LinePoints,  ///< measured, in order
  Dashed,      ///< a rival, a limit
  Steps,       ///< a state that holds until the next value
};

struct Series {
  QString name;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> sigma;  ///< empty, or one a point: bars for Points, a band for lines
  SeriesStyle style = SeriesStyle::LinePoints;
  int colour = 0;           ///< index into Theme::series
  double sigma_factor = 2;  ///< the band or bar is value +- this many sigma
  bool legend = true;
};

/// A shaded part of the x axis: training, test, warm-up.
struct Span {
  double from = 0;
  double to = 0;
  QString name;
  Tone tone = Tone::Accent;
};

class Plot : public QWidget {
  Q_OBJECT
 public:
  explicit Plot(QWidget* parent = nullptr);
  ~Plot() override;

  /// Units of the titles are printed as people write them: "EX / um" becomes "EX / µm". Titles and values have the
  /// units of files; axes and what stands under the cursor those that the user wants.
  void setAxes(const QString& x_title, const QString& y_title);
  /// Plots beside each other need the titles of their common axes once: units and names stay those of the titles.
  void setTitlesShown(bool x, bool y);
  /// Of x and y, as they are drawn; empty: not shown.
  [[nodiscard]] QStringList axisTitles() const;
  /// The same in the lines that they have room for.
  [[nodiscard]] QStringList drawnTitles() const;
  /// Replaces all series, spans and marks, and shows everything.
  void setContent(std::vector<Series> series, std::vector<Span> spans = {});
  /// A vertical line with a name at x.
  void addMark(double x, const QString& name, Tone tone = Tone::Neutral);
  void setEmptyText(const QString& title, const QString& how);
  void showAll();
  /// Always shows y = 0 and at least +- this much.
  void setLeastRange(double y) { least_range_ = y; }
  void setLegendVisible(bool visible);
  /// The edges of the spans can be dragged; `spanMoved` tells where one stands when it is let go.
  void setSpansMovable(bool movable) { spans_movable_ = movable; }
  [[nodiscard]] const std::vector<Span>& spans() const { return spans_; }
  /// Horizontal place of a value, pixels of this widget.
  [[nodiscard]] double pixelOfX(double x);
  [[nodiscard]] QPointF pixelOf(double x, double y);
  /// A vertical line that marks what is shown elsewhere; moves without drawing the curves anew. Empty: none.
  void setMoment(const std::optional<double>& x);
  [[nodiscard]] const std::optional<double>& moment() const { return moment_; }
  /// The value at which the cursor of the keyboard stands: its series and its place in it.
  [[nodiscard]] const std::optional<std::pair<std::size_t, std::size_t>>& cursor() const { return cursor_; }
  /// Fixes what showAll() shows of the y axis, so that plots side by side can be compared; empty: from the data.
  void setRange(const std::optional<std::pair<double, double>>& y) { fixed_range_ = y; }

  /// By the ending: .png, .svg, .pdf (and .csv for the numbers). Throws InputError.
  void exportTo(const QString& file);
  /// What exportTo() writes as .png.
  [[nodiscard]] QImage picture();
  [[nodiscard]] QString csv() const;
  [[nodiscard]] bool empty() const { return series_.empty(); }
  /// Where the names of the marks in view stand, pixels of this widget.
  [[nodiscard]] std::vector<QRectF> markAreas() const;
  /// The same of the names of spans.
  [[nodiscard]] const std::vector<QRectF>& spanNameAreas() const { return span_name_areas_; }
  [[nodiscard]] const std::vector<Series>& series() const { return series_; }

  [[nodiscard]] QSize sizeHint() const override { return {480, 280}; }
  /// High enough for the title of the upright axis in two lines.
  [[nodiscard]] QSize minimumSizeHint() const override;

 Q_SIGNALS:
  /// What is under the cursor of the mouse or of the keyboard: a value with its uncertainty, else the place on the
  /// axes; empty: the cursor has left.
  void hovered(const QString& text);
  void spanMoved(int index, double from, double to);
  /// The user clicked a value, within 12 pixels: its place on the x axis and in its series.
  void picked(double x, int series, int index);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  /// Calls `draw` with the size of a picture for a file, in light colours and the units of files.
  void drawForFile(const std::function<void(const QSize& size)>& draw);
  void rebuild();
  void restyle();
  void placeLegend();
  void replotSoon();
  void drawIfStale();

  QCustomPlot* plot_;
  QString x_title_, y_title_;
  bool x_title_shown_ = true, y_title_shown_ = true;
  QString empty_title_, empty_how_;
  QString own_name_;  ///< for screen readers, while the page gives none
  std::vector<Series> series_;
  std::vector<Span> spans_;
  struct Mark {
    double x;
    QString name;
    Tone tone;
    QCPItemText* label = nullptr;  ///< of the plot
    QRectF area = {};              ///< of the label, empty while out of view
  };
  std::vector<Mark> marks_;
  /// The edge of a span at a place of the plot: span and whether it is the left one.
  [[nodiscard]] std::optional<std::pair<std::size_t, bool>> spanEdgeAt(double pixel_x) const;
  bool dragSpan(QEvent* event);
  void pickValue(QEvent* event);
  /// Series and index of the value next to a place of the plot, within reach of the cursor.
  [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> valueAt(const QPointF& place) const;
  [[nodiscard]] QString textAt(const QPointF& place) const;
  [[nodiscard]] QString textOf(std::size_t series, std::size_t index) const;
  bool onKey(const QKeyEvent& event);
  /// The values of a series that are drawn, in order of x.
  [[nodiscard]] std::vector<std::size_t> valuesOf(std::size_t series) const;
  void beginCursor();
  void moveAlong(int key);
  void moveToSeries(int by);
  void setCursorAt(const std::optional<std::pair<std::size_t, std::size_t>>& value);
  void placeCursor();
  void placeMoment();
  void drawMark(Mark& mark);
  void placeMarks();
  void placeSpanNames();
  void placeNames();
  void layOut();
  void fitAxes();
  void nameForReaders();

  std::vector<QCPItemText*> span_names_;  ///< of each span
  std::vector<QRectF> span_name_areas_;   ///< of those in view
  bool spans_movable_ = false;
  std::optional<std::pair<std::size_t, bool>> dragged_edge_;
  std::optional<double> moment_;
  QCPItemStraightLine* moment_line_ = nullptr;
  std::optional<std::pair<std::size_t, std::size_t>> cursor_;
  QCPItemTracer* cursor_ring_ = nullptr;
  QString described_;  ///< what the plot is called by while no value is
  QPointF pressed_at_;
  double least_range_ = 0;
  std::optional<std::pair<double, double>> fixed_range_;
  bool legend_ = true;
  bool stale_ = true;  ///< what is shown is older than what was set
};

/// Seconds as people read them on an axis: factor and unit ("h", "min" or "s") for a span of time.
struct TimeUnit {
  double seconds = 1;
  QString name;
};
[[nodiscard]] TimeUnit timeUnit(double span_s);

}  // namespace spindrift::gui
