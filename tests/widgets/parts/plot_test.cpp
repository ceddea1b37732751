// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plots/plot.h"
#include "widgets/plots/surface_plot.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QFile>
#include <QFocusEvent>
#include <QImage>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QSignalSpy>
#include <cmath>

#include "core/base/csv.h"
#include "tests/support/temp_folder.h"
#include "widgets/image_view/image_view.h"
#include "widgets/plots/plot_grid.h"
#include "widgets/plots/qcustomplot_header.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

Series ramp() {
  Series s;
  s.name = QStringLiteral("EZ");
  for (int i = 0; i < 50; ++i) {
    s.x.push_back(i * 0.1);
    s.y.push_back(0.5 * i);
    s.sigma.push_back(0.4);
  }
  return s;
}

TEST(Plot, ExportsPngSvgPdfAndCsv) {
  const testing::TempFolder folder;
  Plot plot;
  plot.resize(500, 300);
  plot.setAxes(QStringLiteral("Time / h"), QStringLiteral("EZ / um"));
  Series measured = ramp();
  measured.style = SeriesStyle::Points;
  plot.setContent({ramp(), measured}, {{0, 2, QStringLiteral("train"), Tone::Accent}});
  for (const char* ending : {"png", "svg", "pdf", "csv"}) {
    const QString file = QString::fromStdString((folder / ("plot." + std::string(ending))).string());
    plot.exportTo(file);
    EXPECT_GT(QFile(file).size(), 400) << ending;
  }
  QFile svg(QString::fromStdString((folder / "plot.svg").string()));
  ASSERT_TRUE(svg.open(QIODevice::ReadOnly));
  EXPECT_TRUE(svg.readAll().contains("<svg"));
  EXPECT_EQ(plot.csv().count(QLatin1Char('\n')), 101);
}

TEST(Plot, IsReadAndMovedByKeyboardAlone) {
  Plot plot;
  plot.resize(500, 300);
  plot.setAxes(QStringLiteral("Time / h"), QStringLiteral("EZ / um"));
  Series measured = ramp();
  measured.y[1] = std::nan("");  // not drawn: no value to stop at
  Series model = ramp();
  model.name = QStringLiteral("model");
  model.sigma.clear();
  plot.setContent({measured, model});
  plot.show();
  const QString described = plot.accessibleDescription();
  QSignalSpy told(&plot, &Plot::hovered);
  QSignalSpy picked(&plot, &Plot::picked);
  const auto press = [&plot](int key, Qt::KeyboardModifiers with = Qt::NoModifier) {
    QKeyEvent event(QEvent::KeyPress, key, with);
    QCoreApplication::sendEvent(&plot, &event);
    return event.isAccepted();
  };
  const auto at = [](std::size_t series, std::size_t index) { return std::optional(std::pair{series, index}); };
  EXPECT_TRUE(plot.focusPolicy() & Qt::TabFocus);
  ASSERT_TRUE(press(Qt::Key_Right));
  EXPECT_EQ(plot.cursor(), at(0, 0));
  press(Qt::Key_Right);
  EXPECT_EQ(plot.cursor(), at(0, 2)) << "the next that is drawn";
  EXPECT_EQ(plot.accessibleDescription(), QStringLiteral("EZ, Time 0.2 h: 1.0 ± 0.4 µm"));
  EXPECT_EQ(told.back().at(0).toString(), plot.accessibleDescription());
  press(Qt::Key_Down);
  EXPECT_EQ(plot.cursor(), at(1, 2)) << "the other series, at the same place";
  EXPECT_EQ(told.back().at(0).toString(), QStringLiteral("model, Time 0.2 h: 1 µm"));
  press(Qt::Key_Down);
  EXPECT_EQ(plot.cursor(), at(1, 2)) << "there is no other";
  press(Qt::Key_Return);
  ASSERT_EQ(picked.size(), 1);
  EXPECT_EQ(picked.back().at(1).toInt(), 1);
  EXPECT_EQ(picked.back().at(2).toInt(), 2);
  press(Qt::Key_End);
  EXPECT_EQ(plot.cursor(), at(1, 49));
  press(Qt::Key_Home);
  EXPECT_EQ(plot.cursor(), at(1, 0));

  auto* axes = plot.findChild<QCustomPlot*>();
  const QCPRange all = axes->xAxis->range();
  press(Qt::Key_Plus);
  press(Qt::Key_Plus);
  EXPECT_LT(axes->xAxis->range().size(), 0.7 * all.size());
  const QCPRange zoomed = axes->xAxis->range();
  press(Qt::Key_Right, Qt::ShiftModifier);
  EXPECT_NEAR(axes->xAxis->range().lower, zoomed.lower + 0.1 * zoomed.size(), 1e-9);
  press(Qt::Key_End);
  EXPECT_TRUE(axes->xAxis->range().contains(4.9)) << "what the cursor stands at is in view";
  press(Qt::Key_0);
  EXPECT_NEAR(axes->xAxis->range().size(), all.size(), 1e-9);

  EXPECT_TRUE(press(Qt::Key_Escape));
  EXPECT_FALSE(plot.cursor().has_value());
  EXPECT_EQ(plot.accessibleDescription(), described);
  EXPECT_TRUE(told.back().at(0).toString().isEmpty());
  EXPECT_FALSE(press(Qt::Key_Escape)) << "for the window";
  EXPECT_FALSE(press(Qt::Key_Right, Qt::ControlModifier)) << "for the window";
  press(Qt::Key_Right);
  plot.setContent({ramp()});
  EXPECT_FALSE(plot.cursor().has_value()) << "what is new has no value at hand";
}

TEST(SurfacePlotTest, IsReadByKeyboardAlone) {
  SurfacePlot plot;
  plot.resize(640, 480);
  ViewSurface surface;
  surface.x = {150, 550, 1350};
  surface.y = {0, 30, 90};
  surface.x_title = QStringLiteral("Position / mm");
  surface.y_title = QStringLiteral("Time / min");
  surface.value_title = QStringLiteral("EXY / um");
  surface.value = {std::nan(""), 1, 0, 4, -6, 8, 9, std::nan(""), -12};
  surface.sigma = {0, 0.5, 0.5, 2, 2, 2, 2, 2, 2};
  plot.setData(surface, ColourScale::symmetric(12, QStringLiteral("EXY"), QStringLiteral("um")));
  plot.show();
  const QString described = plot.accessibleDescription();
  QSignalSpy told(&plot, &View3D::hovered);
  EXPECT_TRUE(plot.focusPolicy() & Qt::TabFocus);
  const QImage without = plot.grab().toImage();
  const auto press = [&plot](int key, Qt::KeyboardModifiers with = Qt::NoModifier) {
    QKeyEvent event(QEvent::KeyPress, key, with);
    QCoreApplication::sendEvent(&plot, &event);
    return event.isAccepted();
  };
  press(Qt::Key_N);
  EXPECT_EQ(plot.cursor(), surface.index(1, 0)) << "the first with a value";
  press(Qt::Key_N, Qt::ShiftModifier);
  EXPECT_EQ(plot.cursor(), surface.index(1, 1));
  EXPECT_EQ(plot.accessibleDescription().toStdString(), "Position 550 mm, Time 30 min: −6.0 ± 2.0 µm");
  EXPECT_EQ(told.back().at(0).toString(), plot.accessibleDescription());
  EXPECT_NE(plot.grab().toImage(), without) << "a ring";
  press(Qt::Key_N, Qt::ShiftModifier);
  EXPECT_EQ(plot.cursor(), surface.index(1, 1)) << "the next row has no value here";
  press(Qt::Key_B);
  press(Qt::Key_N, Qt::ShiftModifier);
  press(Qt::Key_N);
  EXPECT_EQ(plot.cursor(), surface.index(2, 2)) << "past the node without a value";
  if (qEnvironmentVariableIsSet("SPINDRIFT_KEEP_PICTURES"))
    plot.grab().save(qEnvironmentVariable("SPINDRIFT_KEEP_PICTURES") + QStringLiteral("/surface_cursor.png"));
  EXPECT_TRUE(press(Qt::Key_Left)) << "turns, as in every view";
  EXPECT_EQ(plot.cursor(), surface.index(2, 2));
  EXPECT_TRUE(press(Qt::Key_Escape));
  EXPECT_FALSE(plot.cursor().has_value());
  EXPECT_EQ(plot.accessibleDescription(), described);
  EXPECT_TRUE(told.back().at(0).toString().isEmpty());
  QFocusEvent by_tab(QEvent::FocusIn, Qt::TabFocusReason);
  QCoreApplication::sendEvent(&plot, &by_tab);
  EXPECT_TRUE(plot.cursor().has_value()) << "whoever comes by keyboard sees where the keys work";
  plot.setData(surface, ColourScale::symmetric(12, QStringLiteral("EXY"), QStringLiteral("um")));
  EXPECT_FALSE(plot.cursor().has_value()) << "what is new has no node at hand";
}

/// A title in two lines and fewer numbers where there is less room.
TEST(Plot, AxesSayAsMuchAsTheyHaveRoomFor) {
  Plot plot;
  plot.setAxes(QStringLiteral("Time / h"), QStringLiteral("Deviation of the point F1 / um"));
  plot.setContent({ramp()});
  plot.show();
  const auto shown = [&plot](const QSize& size) {
    plot.resize(size);
    plot.grab();
    auto* inner = plot.findChild<QCustomPlot*>();
    return std::pair(inner->yAxis->label(), inner->yAxis->tickVector().size());
  };
  const auto high = shown({500, 400});
  EXPECT_EQ(high.first, QStringLiteral("Deviation of the point F1 / µm"));
  const auto low = shown({500, 170});
  EXPECT_EQ(low.first.count(QLatin1Char('\n')), 1) << low.first.toStdString();
  EXPECT_LT(low.second, high.second);
  const QFontMetrics metrics(plot.findChild<QCustomPlot*>()->yAxis->labelFont());
  for (const QString& line : low.first.split(QLatin1Char('\n')))
    EXPECT_LE(metrics.horizontalAdvance(line), plot.findChild<QCustomPlot*>()->axisRect()->height());
  EXPECT_EQ(plot.accessibleName(), QStringLiteral("Deviation of the point F1 / µm over Time / h"));
}

TEST(Plot, NamesOfSeriesAreTextInTheTable) {
  Plot plot;
  Series series = ramp();
  series.name = QStringLiteral("=1+1,\"x\"");
  plot.setContent({series});
  const CsvTable table = CsvTable::parse(plot.csv().toStdString(), "plot.csv");
  EXPECT_EQ(table.text(0, table.column("series")), "=1+1,\"x\"");
}

TEST(Plot, ShowsSomethingAndEmptyStateSaysHow) {
  Plot plot;
  plot.resize(500, 300);
  plot.setEmptyText(QStringLiteral("Curves"), QStringLiteral("Evaluate to see them."));
  const QImage empty = plot.grab().toImage();
  plot.setContent({ramp()});
  const QImage full = plot.grab().toImage();
  EXPECT_NE(empty, full);
}

TEST(Plot, TellsTheValueUnderTheCursorWithItsUncertainty) {
  Plot plot;
  plot.setAxes(QStringLiteral("Time / h"), QStringLiteral("EX / µm"));
  Series series;
  series.name = QStringLiteral("F1");
  series.x = {0.0, 1.0, 2.0};
  series.y = {0.0, 12.43, 20.0};
  series.sigma = {0.3, 0.3, 0.3};
  plot.setContent({series});
  plot.resize(600, 400);
  plot.show();
  QCoreApplication::processEvents();
  auto* canvas = plot.findChild<QCustomPlot*>();
  ASSERT_NE(canvas, nullptr);
  QSignalSpy hovered(&plot, &Plot::hovered);
  const auto moveTo = [&](const QPointF& place) {
    QMouseEvent move(QEvent::MouseMove, place, canvas->mapToGlobal(place), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QCoreApplication::sendEvent(canvas, &move);
    return hovered.back()[0].toString().toStdString();
  };
  EXPECT_EQ(moveTo(plot.pixelOf(1.0, 12.43) + QPointF(3, -3)), "F1, Time 1 h: 12.4 ± 0.3 µm");
  EXPECT_EQ(moveTo(plot.pixelOf(1.5, 2.0)).rfind("Time = 1.5 h,  EX = 2 µm", 0), 0U) << "between the values: the place";
}

TEST(PlotGrid, EveryPanelHasTheUnitsOfThePreferences) {
  PlotGrid grid;
  grid.setAxes(QStringLiteral("Position / mm"), QStringLiteral("EX / um"));
  std::vector<Series> all;
  for (int i = 0; i < 4; ++i) {
    Series s;
    s.name = QStringLiteral("A%1").arg(i + 1);
    s.x = {0.0, 254.0, 508.0};
    s.y = {0.0, 12.7, 25.4};
    all.push_back(s);
  }
  grid.setContent(all);
  grid.resize(900, 700);
  grid.show();
  setShownUnits({true, true, true});
  QCoreApplication::processEvents();
  ASSERT_EQ(grid.panels().size(), 4U);
  for (Plot* panel : grid.panels()) {
    auto* canvas = panel->findChild<QCustomPlot*>();
    QSignalSpy hovered(panel, &Plot::hovered);
    const QPointF place = panel->pixelOf(254.0, 12.7);
    QMouseEvent move(QEvent::MouseMove, place, canvas->mapToGlobal(place), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QCoreApplication::sendEvent(canvas, &move);
    ASSERT_FALSE(hovered.empty());
    EXPECT_TRUE(hovered.back()[0].toString().endsWith(QStringLiteral("Position 10 in: 500 µin")))
        << hovered.back()[0].toString().toStdString();
    EXPECT_EQ(canvas->yAxis->ticker()->tickOrigin(), 0.0);
    canvas->replot();
    double largest = 0.0;
    for (const QString& label : canvas->yAxis->tickVectorLabels()) largest = std::max(largest, label.toDouble());
    EXPECT_GE(largest, 500.0) << "numbers of the axis are µin";
  }
  setShownUnits({});
}

TEST(Plot, HasTheUnitsOfThePreferencesAndIsExportedInThoseOfFiles) {
  const testing::TempFolder folder;
  Plot plot;
  plot.setAxes(QStringLiteral("Time / h"), QStringLiteral("EX / um"));
  Series series;
  series.name = QStringLiteral("F1 at 254 mm");
  series.x = {0.0, 1.0, 2.0};
  series.y = {0.0, 12.70, 25.4};
  series.sigma = {0.254, 0.254, 0.254};
  plot.setContent({series});
  plot.resize(600, 400);
  plot.show();
  const auto svg = [&] {
    const QString file = QString::fromStdString((folder / "plot.svg").string());
    plot.exportTo(file);
    QFile read(file);
    return read.open(QIODevice::ReadOnly) ? read.readAll() : QByteArray();
  };
  QCoreApplication::processEvents();
  const QByteArray in_files = svg();
  ASSERT_FALSE(in_files.isEmpty());
  auto* canvas = plot.findChild<QCustomPlot*>();
  setShownUnits({true, false, false});
  for (int i = 0; i < 3; ++i) {  // exporting leaves the window as it is
    QCoreApplication::processEvents();
    plot.grab();
    EXPECT_EQ(canvas->yAxis->label(), QStringLiteral("EX / µin"));
    for (const double v : canvas->yAxis->tickVector()) {
      const double shown = v / 0.0254;
      EXPECT_NEAR(shown, 100.0 * std::round(shown / 100.0), 1e-6);
    }
    EXPECT_TRUE(canvas->yAxis->tickVectorLabels().contains(QStringLiteral("1000")))
        << canvas->yAxis->tickVectorLabels().join(QLatin1Char(' ')).toStdString();
    EXPECT_EQ(svg(), in_files);
  }
  QSignalSpy hovered(&plot, &Plot::hovered);
  const QPointF place = plot.pixelOf(1.0, 12.70);
  QMouseEvent move(QEvent::MouseMove, place, canvas->mapToGlobal(place), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QCoreApplication::sendEvent(canvas, &move);
  EXPECT_EQ(hovered.back()[0].toString().toStdString(), "F1 at 10.00 in, Time 1 h: 500 ± 10 µin");
  setShownUnits({});
}

TEST(Plot, ManyCurvesInAnyWindowAreDrawn) {
  // Curves through every corner: the legend has to leave the axes and to wrap, differently in every width.
  std::vector<Series> curves;
  for (int k = 0; k < 7; ++k) {
    Series s;
    s.name = QStringLiteral("sensor number %1").arg(k);
    s.colour = k;
    for (int i = 0; i <= 200; ++i) {
      s.x.push_back(i);
      s.y.push_back(std::sin(0.9 * i + k) * (1 + k));
    }
    curves.push_back(s);
  }
  Plot plot;
  plot.show();
  QImage before;
  for (const int width : {900, 420, 300, 640, 120, 900}) {
    plot.resize(width, 320);
    plot.setContent(curves);
    const QImage now = plot.grab().toImage();
    EXPECT_EQ(now.width(), width);
    if (width != 900) continue;
    if (!before.isNull()) {
      EXPECT_EQ(now, before) << "the way there does not matter";
    }
    before = now;
  }
}

TEST(Plot, NamesOfMarksLieOnNoOther) {
  Plot plot;
  plot.show();
  for (const int width : {300, 700, 1400}) {
    plot.resize(width, 300);
    plot.setContent({ramp()});
    for (const double x : {2.0, 2.05, 2.1, 2.15, 4.7, 4.75, 4.8}) {
      plot.addMark(x, QStringLiteral("spindle changed at %1").arg(x));
    }
    (void)plot.grab();
    const std::vector<QRectF> areas = plot.markAreas();
    ASSERT_EQ(areas.size(), 7U) << width;
    for (std::size_t i = 0; i < areas.size(); ++i) {
      EXPECT_TRUE(QRectF(plot.rect()).contains(areas[i])) << width << ", " << i;
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_FALSE(areas[i].intersects(areas[k])) << width << ", " << i << ", " << k;
    }
  }
}

TEST(Plot, NamesOfSpansAreWholeAndLieOnNoOther) {
  Plot plot;
  plot.show();
  for (const int width : {250, 300, 700}) {
    plot.resize(width, 300);
    const Series line = ramp();
    const double last = line.x.back();
    plot.setContent({line}, {{0.5 * last, 0.88 * last, QStringLiteral("Training"), Tone::Accent},
                             {0.9 * last, last, QStringLiteral("Validierungsdaten"), Tone::Good}});
    (void)plot.grab();
    const std::vector<QRectF>& areas = plot.spanNameAreas();
    ASSERT_EQ(areas.size(), 2U) << width;
    for (const QRectF& area : areas) EXPECT_TRUE(QRectF(plot.rect()).contains(area)) << width;
    EXPECT_FALSE(areas[0].intersects(areas[1])) << width;
  }
}

TEST(Plot, TimeIsShownInPeoplesUnits) {
  EXPECT_EQ(timeUnit(86400).name, QStringLiteral("h"));
  EXPECT_EQ(timeUnit(1800).name, QStringLiteral("min"));
  EXPECT_EQ(timeUnit(60).name, QStringLiteral("s"));
}

TEST(ImageView, DrawsMarksOnTheImage) {
  ImageView view;
  view.resize(400, 300);
  QImage image(800, 600, QImage::Format_Grayscale8);
  image.fill(20);
  view.setImage(image);
  const QImage plain = view.grab().toImage();
  ImageMark mark;
  mark.centre_px = {400, 300};
  mark.radius_x_px = 150;
  mark.radius_y_px = 118;
  mark.label = QStringLiteral("14 15");
  view.setMarks({mark});
  const QImage marked = view.grab().toImage();
  EXPECT_NE(plain, marked);
  // The outline passes through (400 + 150, 300) of the image.
  const QColor c = view.annotated().pixelColor(550, 300);
  EXPECT_GT(c.green(), c.red());
  view.setMarksVisible(false);
  EXPECT_EQ(view.grab().toImage(), plain);
}

}  // namespace
}  // namespace spindrift::gui
