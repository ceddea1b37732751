// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plots/plot.h"

#include <QEvent>
#include <QPainter>
#include <QSvgGenerator>
#include <QTimer>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/plots/marked_graph.h"
#include "widgets/plots/qcustomplot_header.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/light_colours.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

constexpr std::size_t most_smooth_points = 4000;
constexpr std::size_t most_points_for_legend = 2000;  ///< of a series, when the corner is chosen

QVector<double> toVector(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

constexpr int most_ticks = 6;
constexpr int tick_line = 26;     ///< px of an upright axis for one number
constexpr int tick_advance = 64;  ///< px of a lying axis for one number
constexpr int least_for_label = 24;
constexpr int least_width = 220;
constexpr int least_height = 150;
constexpr int around_axes = 84;  ///< ticks, margins and paddings above and below the axes

/// A title in two lines, the longer of which is as short as it can be; one where it has no blank.
QStringList inTwoLines(const QString& title, const QFontMetrics& metrics) {
  QStringList best{title};
  int least = std::numeric_limits<int>::max();
  for (qsizetype i = title.indexOf(QLatin1Char(' ')); i >= 0; i = title.indexOf(QLatin1Char(' '), i + 1)) {
    const QStringList lines{title.left(i), title.mid(i + 1)};
    const int width = std::max(metrics.horizontalAdvance(lines[0]), metrics.horizontalAdvance(lines[1]));
    if (width >= least) continue;
    least = width;
    best = lines;
  }
  return best;
}

/// The title of an axis within its length: in two lines where one is too long.
QString fitted(const QString& title, const QFontMetrics& metrics, int length) {
  if (length < least_for_label || metrics.horizontalAdvance(title) <= length) return title;
  QStringList lines = inTwoLines(title, metrics);
  for (QString& line : lines) line = metrics.elidedText(line, Qt::ElideRight, length);
  return lines.join(QLatin1Char('\n'));
}

/// Numbers on an axis, round in the units on screen, with a true minus sign.
class Ticker : public QCPAxisTicker {
 public:
  /// Of the quantity on the axis.
  void setUnit(const ShownUnit& unit) {
    unit_ = unit;
    setTickOrigin(unit_.stored(0.0));
  }

 protected:
  double getTickStep(const QCPRange& range) override {
    step_ = QCPAxisTicker::getTickStep(QCPRange(unit_.shown(range.lower), unit_.shown(range.upper)));
    return step_ / unit_.factor;
  }
  QString getTickLabel(double tick, const QLocale& locale, QChar format, int precision) override {
    const double shown = unit_.shown(tick);
    const bool zero = std::abs(shown) < std::max(1e-12, 1e-9 * step_);
    QString text = QCPAxisTicker::getTickLabel(zero ? 0.0 : shown, locale, format, precision);
    text.replace(QLatin1Char('-'), QChar(0x2212));
    return text;
  }

 private:
  ShownUnit unit_;
  double step_ = 0.0;
};

}  // namespace

TimeUnit timeUnit(double span_s) {
  if (span_s >= 3 * 3600) return {3600, QStringLiteral("h")};
  if (span_s >= 180) return {60, QStringLiteral("min")};
  return {1, QStringLiteral("s")};
}

Plot::Plot(QWidget* parent) : QWidget(parent), plot_(new QCustomPlot(this)) {
  plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  plot_->setAntialiasedElements(QCP::aeAll);
  plot_->installEventFilter(this);
  plot_->setMouseTracking(true);
  plot_->hide();
  setFocusPolicy(Qt::StrongFocus);
  for (QCPAxis* axis : {plot_->xAxis, plot_->yAxis}) {
    QSharedPointer<Ticker> ticker(new Ticker);
    ticker->setTickCount(most_ticks);
    axis->setTicker(ticker);
    axis->setNumberPrecision(6);
    axis->setNumberFormat(QStringLiteral("gb"));
  }
  plot_->axisRect()->insetLayout()->setInsetAlignment(0, Qt::AlignTop | Qt::AlignRight);
  plot_->axisRect()->setupFullAxesBox(false);
  connect(plot_->xAxis, qOverload<const QCPRange&>(&QCPAxis::rangeChanged), this, &Plot::placeNames);
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, [this] {
    rebuild();
    replotSoon();
  });
  connect(&UnitsNotifier::instance(), &UnitsNotifier::changed, this, [this] {
    nameForReaders();
    updateGeometry();
    rebuild();
    replotSoon();
  });
  restyle();
}

Plot::~Plot() = default;

void Plot::setAxes(const QString& x_title, const QString& y_title) {
  x_title_ = printedTitle(x_title);
  y_title_ = printedTitle(y_title);
  nameForReaders();
  updateGeometry();
  replotSoon();
}

void Plot::setTitlesShown(bool x, bool y) {
  x_title_shown_ = x;
  y_title_shown_ = y;
  updateGeometry();
  replotSoon();
}

QSize Plot::minimumSizeHint() const {
  const QFontMetrics metrics(plot_->yAxis->labelFont());
  int title = 0;
  for (const QString& line : inTwoLines(axisTitles()[1], metrics))
    title = std::max(title, metrics.horizontalAdvance(line));
  // Below stand the numbers and the title of the other axis, above a line of the legend.
  const bool legend =
      legend_ && std::count_if(series_.begin(), series_.end(), [](const Series& s) { return s.legend; }) > 1;
  const int lines = 2 + (legend ? 1 : 0);
  return {least_width, std::max(least_height, title + lines * metrics.lineSpacing() + around_axes)};
}

QStringList Plot::drawnTitles() const {
  return {plot_->xAxis->label(), plot_->yAxis->label()};
}

QStringList Plot::axisTitles() const {
  return {x_title_shown_ ? shownTitle(x_title_) : QString(), y_title_shown_ ? shownTitle(y_title_) : QString()};
}

/// What a screen reader says, unless the page has given a name of its own.
void Plot::nameForReaders() {
  if (!accessibleName().isEmpty() && accessibleName() != own_name_) return;
  QStringList names;
  for (const Series& s : series_) {
    if (s.legend && !s.name.isEmpty()) names << s.name;
  }
  own_name_ = series_.empty() || y_title_.isEmpty() ? empty_title_
                                                    : tr("%1 over %2").arg(shownTitle(y_title_), shownTitle(x_title_));
  setAccessibleName(own_name_);
  setAccessibleDescription(names.join(QStringLiteral(", ")));
}

/// Titles and numbers of the axes for the room that they have.
void Plot::fitAxes() {
  // From the same beginning, whatever the size was before.
  const QStringList titles = axisTitles();
  for (QCPAxis* axis : {plot_->xAxis, plot_->yAxis}) {
    const bool lying = axis == plot_->xAxis;
    const auto ticker = axis->ticker().staticCast<Ticker>();
    ticker->setTickCount(most_ticks);
    ticker->setUnit(unitOfTitle(lying ? x_title_ : y_title_));
    axis->setLabel(titles[lying ? 0 : 1]);
  }
  layOut();
  const QRect axes = plot_->axisRect()->rect();
  plot_->yAxis->setLabel(fitted(titles[1], QFontMetrics(plot_->yAxis->labelFont()), axes.height()));
  plot_->xAxis->setLabel(fitted(titles[0], QFontMetrics(plot_->xAxis->labelFont()), axes.width()));
  plot_->yAxis->ticker()->setTickCount(std::clamp(axes.height() / tick_line, 2, most_ticks));
  plot_->xAxis->ticker()->setTickCount(std::clamp(axes.width() / tick_advance, 2, most_ticks));
}

void Plot::setContent(std::vector<Series> series, std::vector<Span> spans) {
  series_ = std::move(series);
  spans_ = std::move(spans);
  marks_.clear();
  if (cursor_) setAccessibleDescription(described_);
  cursor_.reset();
  rebuild();
  nameForReaders();
  updateGeometry();  // a legend takes a line
  showAll();
}

void Plot::addMark(double x, const QString& name, Tone tone) {
  marks_.push_back({x, name, tone, nullptr});
  drawMark(marks_.back());
  replotSoon();
}

void Plot::drawMark(Mark& mark) {
  const Theme& t = theme();
  auto* line = new QCPItemStraightLine(plot_);
  line->point1->setCoords(mark.x, 0);
  line->point2->setCoords(mark.x, 1);
  line->setPen(QPen(t.tone(mark.tone), 1.2, Qt::DashLine));
  mark.label = new QCPItemText(plot_);
  mark.label->setText(mark.name);
  mark.label->setFont(textFont(sizes::font_secondary));
  mark.label->setColor(t.tone(mark.tone));
  mark.label->setPadding(QMargins(6, 2, 6, 2));
  mark.label->position->setTypeX(QCPItemPosition::ptPlotCoords);
  mark.label->position->setTypeY(QCPItemPosition::ptAxisRectRatio);
}

/// Each name beside its line, on the side with more room, in the uppermost row in which it lies on no other name.
void Plot::placeMarks() {
  if (marks_.empty()) return;
  const QRectF axes = plot_->axisRect()->rect();
  if (axes.width() < 1 || axes.height() < 1) return;
  const QFontMetrics metrics(textFont(sizes::font_secondary));
  const double row_height = metrics.height() + 4;
  const auto rows = static_cast<std::size_t>(std::max(1.0, std::floor(axes.height() / row_height)));
  std::vector<Mark*> by_place;
  for (Mark& mark : marks_) {
    mark.area = {};
    const bool shown = mark.label != nullptr && plot_->xAxis->range().contains(mark.x);
    if (mark.label != nullptr) mark.label->setVisible(shown);
    if (shown) by_place.push_back(&mark);
  }
  std::stable_sort(by_place.begin(), by_place.end(), [](const Mark* a, const Mark* b) { return a->x < b->x; });
  std::vector<std::vector<QRectF>> taken(rows);
  for (Mark* mark : by_place) {
    const double pixel = plot_->xAxis->coordToPixel(mark->x);
    const double width = metrics.horizontalAdvance(mark->name) + 12;
    const bool right_half = pixel > axes.center().x();
    const double left = right_half ? pixel - width : pixel;
    std::size_t row = 0;
    const auto area = [&] {
      return QRectF(left, axes.top() + static_cast<double>(row) * row_height, width, row_height);
    };
    const auto meets = [&](const QRectF& other) { return other.intersects(area()); };
    while (row + 1 < rows && std::any_of(taken[row].begin(), taken[row].end(), meets)) ++row;
    mark->area = area();
    taken[row].push_back(mark->area);
    mark->label->setPositionAlignment((right_half ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignTop);
    mark->label->position->setCoords(mark->x, (mark->area.top() - axes.top()) / axes.height());
  }
}

/// Each name at the left edge of its span, or as far left of it as it needs to be whole, above the names that stand
/// there.
void Plot::placeSpanNames() {
  span_name_areas_.clear();
  const QRectF axes = plot_->axisRect()->rect();
  if (axes.width() < 1 || axes.height() < 1) return;
  constexpr double lowest = 0.985;  // of the height
  const QFontMetrics metrics(textFont(sizes::font_secondary));
  const double row_height = metrics.height() + 4;
  for (std::size_t i = 0; i < span_names_.size(); ++i) {
    const double from = plot_->xAxis->coordToPixel(spans_[i].from);
    const double to = plot_->xAxis->coordToPixel(spans_[i].to);
    const bool shown = !spans_[i].name.isEmpty() && from < axes.right() && to > axes.left();
    span_names_[i]->setVisible(shown);
    if (!shown) continue;
    const double width = metrics.horizontalAdvance(spans_[i].name) + 12;
    const double left = std::max(axes.left(), std::min(from, axes.right() - width));
    QRectF area(left, axes.top() + lowest * axes.height() - row_height, width, row_height);
    const auto meets = [&](const QRectF& other) { return other.intersects(area); };
    while (area.top() > axes.top() && std::any_of(span_name_areas_.begin(), span_name_areas_.end(), meets))
      area.translate(0, -row_height);
    span_names_[i]->position->setCoords(plot_->xAxis->pixelToCoord(left), (area.bottom() - axes.top()) / axes.height());
    span_name_areas_.push_back(area);
  }
}

void Plot::placeNames() {
  placeMarks();
  placeSpanNames();
}

std::vector<QRectF> Plot::markAreas() const {
  std::vector<QRectF> areas;
  for (const Mark& mark : marks_) {
    if (!mark.area.isEmpty()) areas.push_back(mark.area);
  }
  return areas;
}

void Plot::setEmptyText(const QString& title, const QString& how) {
  empty_title_ = title;
  empty_how_ = how;
  nameForReaders();
  update();
}

void Plot::setLegendVisible(bool visible) {
  legend_ = visible;
  rebuild();
  replotSoon();
}

void Plot::restyle() {
  const Theme& t = theme();
  plot_->setBackground(QBrush(t.surface));
  plot_->axisRect()->setBackground(QBrush(t.surface));
  const QFont small = textFont(sizes::font_secondary);
  for (QCPAxis* axis : {plot_->xAxis, plot_->yAxis, plot_->xAxis2, plot_->yAxis2}) {
    axis->setBasePen(QPen(t.border_strong, 1));
    axis->setTickPen(QPen(t.border_strong, 1));
    axis->setSubTickPen(Qt::NoPen);
    axis->setTickLabelColor(t.text_secondary);
    axis->setLabelColor(t.text);
    axis->setTickLabelFont(small);
    axis->setLabelFont(small);
    axis->setTickLengthIn(0);
    axis->setTickLengthOut(4);
    axis->setLabelPadding(6);
    axis->setTickLabels(axis == plot_->xAxis || axis == plot_->yAxis);
  }
  for (QCPAxis* axis : {plot_->xAxis2, plot_->yAxis2}) axis->setVisible(false);
  for (QCPAxis* axis : {plot_->xAxis, plot_->yAxis}) {
    axis->grid()->setPen(QPen(mixed(t.surface, t.grid, 0.6), 1, Qt::SolidLine));
    axis->grid()->setZeroLinePen(QPen(t.border_strong, 1));
  }
  plot_->legend->setFont(small);
  plot_->legend->setTextColor(t.text);
  QColor back = t.surface;
  back.setAlphaF(0.88F);
  plot_->legend->setBrush(back);
  plot_->legend->setBorderPen(QPen(t.border, 1));
}

void Plot::rebuild() {
  plot_->clearPlottables();
  plot_->clearItems();
  for (Mark& mark : marks_) mark.label = nullptr;
  span_names_.clear();
  moment_line_ = nullptr;
  cursor_ring_ = nullptr;
  restyle();
  const Theme& t = theme();
  int named = 0;
  for (const Span& span : spans_) {
    auto* area = new QCPItemRect(plot_);
    area->setLayer(QStringLiteral("background"));
    area->topLeft->setTypeX(QCPItemPosition::ptPlotCoords);
    area->topLeft->setTypeY(QCPItemPosition::ptAxisRectRatio);
    area->bottomRight->setTypeX(QCPItemPosition::ptPlotCoords);
    area->bottomRight->setTypeY(QCPItemPosition::ptAxisRectRatio);
    area->topLeft->setCoords(span.from, 0);
    area->bottomRight->setCoords(span.to, 1);
    area->setPen(Qt::NoPen);
    QColor fill = t.toneSoft(span.tone);
    fill.setAlphaF(0.75F);
    area->setBrush(fill);
    auto* text = new QCPItemText(plot_);
    text->setText(span.name);
    text->setFont(textFont(sizes::font_secondary));
    text->setColor(t.tone(span.tone));
    text->setPositionAlignment(Qt::AlignLeft | Qt::AlignBottom);
    text->position->setTypeX(QCPItemPosition::ptPlotCoords);
    text->position->setTypeY(QCPItemPosition::ptAxisRectRatio);
    text->position->setCoords(span.from, 0.985);
    text->setPadding(QMargins(6, 2, 6, 2));
    span_names_.push_back(text);
  }
  for (const Series& s : series_) {
    const QColor colour = t.series[static_cast<std::size_t>(s.colour) % t.series.size()];
    const QVector<double> x = toVector(s.x);
    const QVector<double> y = toVector(s.y);
    const bool line = s.style != SeriesStyle::Points;
    const bool with_sigma = s.sigma.size() == s.y.size() && !s.sigma.empty();
    if (line && with_sigma) {
      QVector<double> low, high;
      for (std::size_t i = 0; i < s.y.size(); ++i) {
        low << s.y[i] - s.sigma_factor * s.sigma[i];
        high << s.y[i] + s.sigma_factor * s.sigma[i];
      }
      QCPGraph* bottom = plot_->addGraph();
      bottom->setData(x, low, true);
      bottom->setPen(Qt::NoPen);
      bottom->removeFromLegend();
      QCPGraph* top = plot_->addGraph();
      top->setData(x, high, true);
      top->setPen(Qt::NoPen);
      top->removeFromLegend();
      QColor fill = colour;
      fill.setAlphaF(0.18F);
      top->setBrush(fill);
      top->setChannelFillGraph(bottom);
    }
    auto* graph = new MarkedGraph(plot_->xAxis, plot_->yAxis);
    graph->setData(x, y);
    graph->setName(onScreen(s.name));
    graph->setAdaptiveSampling(true);
    switch (s.style) {
      case SeriesStyle::Points:
        graph->setLineStyle(QCPGraph::lsNone);
        break;
      case SeriesStyle::Steps:
        graph->setLineStyle(QCPGraph::lsStepLeft);
        break;
      default:
        graph->setLineStyle(QCPGraph::lsLine);
    }
    // Smooth lines of so many corners take ten times as long and look the same.
    const bool dense = s.x.size() > most_smooth_points;
    graph->setAntialiased(!dense);
    graph->setPen(QPen(colour, dense ? 1.0 : 1.5, s.style == SeriesStyle::Dashed ? Qt::DashLine : Qt::SolidLine));
    if (s.style == SeriesStyle::Points || s.style == SeriesStyle::LinePoints) {
      graph->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(colour, 1.2),
                                             QBrush(mixed(colour, t.surface, 0.35)), s.x.size() > 400 ? 3 : 6));
    }
    if (!line && with_sigma) {
      auto* bars = new QCPErrorBars(plot_->xAxis, plot_->yAxis);
      bars->setDataPlottable(graph);
      bars->setPen(QPen(colour, 1));
      bars->setWhiskerWidth(5);
      QVector<double> half;
      for (const double v : s.sigma) half << s.sigma_factor * v;
      bars->setData(half);
      bars->removeFromLegend();
    }
    if (!s.legend || s.name.isEmpty()) {
      graph->removeFromLegend();
    } else {
      ++named;
    }
  }
  for (Mark& mark : marks_) drawMark(mark);
  placeMoment();
  placeCursor();
  plot_->legend->setVisible(legend_ && named > 1);
  if (series_.empty()) plot_->hide();
  update();
}

void Plot::setMoment(const std::optional<double>& x) {
  if (moment_ == x) return;
  moment_ = x;
  placeMoment();
  replotSoon();
}

void Plot::placeMoment() {
  if (!moment_ || series_.empty()) {
    if (moment_line_ != nullptr) plot_->removeItem(moment_line_);
    moment_line_ = nullptr;
    return;
  }
  if (moment_line_ == nullptr) {
    moment_line_ = new QCPItemStraightLine(plot_);
    moment_line_->setPen(QPen(theme().tone(Tone::Accent), 1.5));
  }
  moment_line_->point1->setCoords(*moment_, 0);
  moment_line_->point2->setCoords(*moment_, 1);
}

/// Once, when the event loop is reached: a page that is being filled changes its plots several times.
void Plot::replotSoon() {
  stale_ = true;
  QTimer::singleShot(0, this, [this] {
    if (isVisible()) drawIfStale();
  });
}

/// Lays out first and draws once. QCustomPlot draws whenever it gets a size, and a layout tries several: it gets its
/// size here, and is shown only then.
void Plot::drawIfStale() {
  if (!stale_ || series_.empty()) return;
  stale_ = false;
  const QRect area(QPoint(0, 0), size().expandedTo({1, 1}));
  plot_->setViewport(area);
  layOut();
  placeNames();
  placeLegend();
  fitAxes();  // a legend above the axes moves them
  layOut();
  placeNames();
  const bool resized = plot_->geometry() != area;
  plot_->setGeometry(area);
  plot_->show();
  const bool drawn = resized && plot_->isVisible();
  if (!drawn) plot_->replot(QCustomPlot::rpQueuedRefresh);
}

void Plot::showEvent(QShowEvent*) {
  if (stale_) replotSoon();
}

void Plot::showAll() {
  double x_low = std::numeric_limits<double>::max();
  double x_high = -x_low;
  double y_low = x_low;
  double y_high = -x_low;
  for (const Series& s : series_) {
    const bool with_sigma = s.sigma.size() == s.y.size();
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (!std::isfinite(s.y[i])) continue;
      const double half = with_sigma && std::isfinite(s.sigma[i]) ? s.sigma_factor * s.sigma[i] : 0.0;
      x_low = std::min(x_low, s.x[i]);
      x_high = std::max(x_high, s.x[i]);
      y_low = std::min(y_low, s.y[i] - half);
      y_high = std::max(y_high, s.y[i] + half);
    }
  }
  if (x_low > x_high) return;
  if (least_range_ > 0) {
    y_low = std::min(y_low, -least_range_);
    y_high = std::max(y_high, least_range_);
  }
  if (fixed_range_) std::tie(y_low, y_high) = *fixed_range_;
  const double dx = x_high > x_low ? 0.03 * (x_high - x_low) : 0.5;
  const double dy = std::max(y_high - y_low, 1e-9) * 0.08;
  plot_->xAxis->setRange(x_low - dx, x_high + dx);
  plot_->yAxis->setRange(y_low - dy, y_high + dy);
  replotSoon();
}

/// Lays out axes and legend without drawing the curves.
void Plot::layOut() {
  for (const auto phase : {QCPLayoutElement::upPreparation, QCPLayoutElement::upMargins, QCPLayoutElement::upLayout}) {
    plot_->plotLayout()->update(phase);
  }
}

/// Into the corner that neither data nor names of marks meet; where there is none, into a line above the axes.
void Plot::placeLegend() {
  QCPLegend* legend = plot_->legend;
  if (!legend->visible() || plot_->viewport().width() < 60 || plot_->viewport().height() < 60) return;
  QCPLayoutGrid* outer = plot_->plotLayout();
  QCPLayoutInset* inset = plot_->axisRect()->insetLayout();
  const auto move_inside = [&](Qt::Alignment corner) {
    if (legend->layout() != inset) {
      outer->take(legend);
      outer->simplify();
      legend->setWrap(0);  // before the order: that is what arranges the items again
      legend->setFillOrder(QCPLegend::foRowsFirst);
      inset->addElement(legend, corner);
    }
    inset->setInsetAlignment(0, corner);
  };
  legend->setBorderPen(QPen(theme().border, 1));
  move_inside(Qt::AlignTop | Qt::AlignRight);
  layOut();
  const QRectF axes = plot_->axisRect()->rect();
  const QSizeF size = QSizeF(legend->outerRect().size()) + QSizeF(16, 16);
  struct Corner {
    Qt::Alignment alignment;
    QRectF area;
    int hits = 0;
  };
  std::array<Corner, 4> corners{
      {{Qt::AlignTop | Qt::AlignRight, {axes.right() - size.width(), axes.top(), size.width(), size.height()}},
       {Qt::AlignTop | Qt::AlignLeft, {axes.left(), axes.top(), size.width(), size.height()}},
       {Qt::AlignBottom | Qt::AlignRight,
        {axes.right() - size.width(), axes.bottom() - size.height(), size.width(), size.height()}},
       {Qt::AlignBottom | Qt::AlignLeft, {axes.left(), axes.bottom() - size.height(), size.width(), size.height()}}}};
  for (const Series& s : series_) {
    QPointF before;
    const std::size_t stride = 1 + s.x.size() / most_points_for_legend;
    for (std::size_t i = 0; i < s.x.size(); i += stride) {
      if (!std::isfinite(s.y[i])) continue;
      const QPointF now(plot_->xAxis->coordToPixel(s.x[i]), plot_->yAxis->coordToPixel(s.y[i]));
      const int steps = i > 0 && s.style != SeriesStyle::Points
                            ? std::clamp(static_cast<int>(QLineF(before, now).length() / 12), 1, 100)
                            : 1;
      for (int k = 1; k <= steps; ++k) {
        const QPointF p = steps == 1 ? now : before + (now - before) * (static_cast<double>(k) / steps);
        for (Corner& corner : corners) corner.hits += corner.area.contains(p) ? 1 : 0;
      }
      if (i < s.sigma.size() && std::isfinite(s.sigma[i])) {
        const double half = s.sigma_factor * s.sigma[i];
        for (const double end : {-1.0, -0.5, 0.5, 1.0}) {
          const QPointF p(now.x(), plot_->yAxis->coordToPixel(s.y[i] + end * half));
          for (Corner& corner : corners) corner.hits += corner.area.contains(p) ? 1 : 0;
        }
      }
      before = now;
    }
  }
  for (const std::vector<QRectF>& names : {markAreas(), span_name_areas_}) {
    for (const QRectF& name : names)
      for (Corner& corner : corners) corner.hits += corner.area.intersects(name) ? 1 : 0;
  }
  const auto best = std::min_element(corners.begin(), corners.end(),
                                     [](const Corner& a, const Corner& b) { return a.hits < b.hits; });
  const bool fits = size.height() < 0.7 * axes.height() && size.width() < 0.6 * axes.width();
  if (best->hits == 0 && fits) {
    move_inside(best->alignment);
  } else {
    int widest = 1;
    for (int i = 0; i < legend->itemCount(); ++i) {
      // Cells of a wrapped legend may be empty.
      if (QCPAbstractLegendItem* item = legend->item(i)) {
        widest = std::max(widest, item->minimumOuterSizeHint().width() + legend->columnSpacing());
      }
    }
    inset->take(legend);
    legend->setBorderPen(Qt::NoPen);
    outer->insertRow(0);
    outer->addElement(0, 0, legend);
    outer->setRowStretchFactor(0, 0.001);
    legend->setWrap(std::max(1, (plot_->viewport().width() - 24) / widest));
    legend->setFillOrder(QCPLegend::foColumnsFirst);
    layOut();
  }
}

void Plot::paintEvent(QPaintEvent*) {
  drawIfStale();
  QPainter painter(this);
  painter.fillRect(rect(), theme().surface);
  if (series_.empty()) drawEmptyText(painter, rect(), empty_title_, empty_how_);
}

void Plot::resizeEvent(QResizeEvent*) {
  replotSoon();
}

QString Plot::csv() const {
  QString text = QStringLiteral("series,x,y,sigma\n");
  for (const Series& s : series_) {
    const QString name = QString::fromStdString(csvField(s.name.toStdString()));
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      text += name + QLatin1Char(',') + QString::fromStdString(exactNumber(s.x[i])) + QLatin1Char(',') +
              QString::fromStdString(exactNumber(s.y[i])) + QLatin1Char(',') +
              (i < s.sigma.size() ? QString::fromStdString(exactNumber(s.sigma[i])) : QString()) + QLatin1Char('\n');
    }
  }
  return text;
}

void Plot::drawForFile(const std::function<void(const QSize& size)>& draw) {
  const LightColours light;
  const bool other_units = shownUnits() != UnitChoice{};
  const FileUnits units;
  if (other_units) {
    rebuild();
    stale_ = true;
  }
  drawIfStale();
  if (cursor_ring_ != nullptr) cursor_ring_->setVisible(false);
  draw(size().expandedTo({640, 400}));
  if (cursor_ring_ != nullptr) cursor_ring_->setVisible(true);
  if (other_units) {
    QTimer::singleShot(0, this, [this] {
      rebuild();
      replotSoon();
    });
  }
}

QImage Plot::picture() {
  QImage drawn;
  drawForFile(
      [&](const QSize& size) { drawn = plot_->toPixmap(size.width(), size.height(), picture_ratio).toImage(); });
  return drawn;
}

void Plot::exportTo(const QString& file) {
  const QString lower = file.toLower();
  if (lower.endsWith(QLatin1String(".csv"))) {
    writeFileAtomically(file.toStdString(), csv().toStdString());
    return;
  }
  bool written = false;
  drawForFile([&](const QSize& size) {
    if (lower.endsWith(QLatin1String(".svg"))) {
      QSvgGenerator generator;
      generator.setFileName(file);
      generator.setSize(size);
      generator.setViewBox(QRect({0, 0}, size));
      QCPPainter painter;
      if (!painter.begin(&generator)) return;
      painter.setMode(QCPPainter::pmVectorized);
      plot_->toPainter(&painter, size.width(), size.height());
      painter.end();
      written = true;
    } else if (lower.endsWith(QLatin1String(".pdf"))) {
      written = plot_->savePdf(file, size.width(), size.height());
    } else {
      written = plot_->savePng(file, size.width(), size.height(), picture_ratio);
    }
  });
  if (!written) throw InputError({file.toStdString(), ""}, "the picture could not be written.");
}

}  // namespace spindrift::gui
