// SPDX-License-Identifier: Apache-2.0
// Small line and point plots for reports and the command line: quantity and unit at every axis, thin lines for what is
// predicted, points for what is measured, a band for its uncertainty.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/machine/component.h"
#include "core/reporting/drawing.h"

namespace spindrift {

/// How a series is drawn. Colours come from a fixed, colour-blind safe table by the index of the series, unless the
/// series brings its own. Both: points where measured, joined by a line with a band.
enum class SeriesStyle { Points, Line, Step, Both };
/// Shape of points, so that colour never carries a meaning alone.
enum class PlotMarker { Circle, Square, Triangle };

/// The convention of the program for what belongs to an axis: X red circles, Y green squares, Z blue triangles, for
/// displacements along and rotations about it.
struct AxisLook {
  std::string colour;  ///< "#b83227"
  PlotMarker marker = PlotMarker::Circle;
};
[[nodiscard]] AxisLook axisLook(int axis);
[[nodiscard]] AxisLook componentLook(Component component);

struct PlotSeries {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> sigma;  ///< empty, or one standard uncertainty each: a bar at points, a 2 sigma band at lines
  SeriesStyle style = SeriesStyle::Line;
  std::string colour = {};  ///< "#rrggbb"; empty: from the table
  PlotMarker marker = PlotMarker::Circle;

  void dress(const AxisLook& look) {
    colour = look.colour;
    marker = look.marker;
  }
};

/// A shaded range of x, such as training or held-out data.
struct PlotRange {
  double from = 0.0;
  double to = 0.0;
  std::string label;
};

struct PlotOptions {
  std::string title;
  std::string x_label;  ///< quantity / unit: "time / h"
  std::string y_label;
  int width_px = 640;
  int height_px = 280;
  std::vector<PlotRange> ranges;
  std::optional<double> y_from;  ///< fixed limits, else from the data
  std::optional<double> y_to;
  std::optional<double> x_from;
  std::optional<double> x_to;
  bool equal_scale = false;  ///< a millimetre is as long upwards as across
  bool compact = false;      ///< one of many small plots: legend beside the title, narrow margins
};

/// Non-finite values are left out and break a line. Without any point it says so in the plot.
[[nodiscard]] Drawing plotPicture(const std::vector<PlotSeries>& series, const PlotOptions& options);

/// Plots one under another, all as wide as the widest.
struct StackedPlot {
  std::vector<PlotSeries> series;
  PlotOptions options;
};
[[nodiscard]] Drawing plotStack(const std::vector<StackedPlot>& plots);

/// Round tick values (1, 2 or 5 times a power of ten) inside [from, to], about `wanted` of them.
[[nodiscard]] std::vector<double> roundTicks(double from, double to, int wanted = 6);

/// A tick value with the decimals that its step needs, true minus sign.
[[nodiscard]] std::string tickText(double value, double step);

}  // namespace spindrift
