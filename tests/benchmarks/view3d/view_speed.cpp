// SPDX-License-Identifier: GPL-3.0-or-later
// How fast the 3D view draws with the rendering at hand (software where there is no graphics card): a heat map of
// 200 x 200 nodes with eight measured points, and a cloud of ten million points. First picture = from handing over the
// data to a complete picture in a window of 1280 x 800; redraw = one turn of the camera until it is painted. Median of
// the redraws, in ms of wall clock.
//
//   view_speed [cloud points in millions, default 10]
#include <QApplication>
#include <QElapsedTimer>
#include <QImage>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "core/machine/machine_description.h"
#include "widgets/theme/theme.h"
#include "widgets/view3d/view3d.h"

using namespace spindrift;
using namespace spindrift::gui;

namespace {

double milliseconds(const QElapsedTimer& timer) {
  return static_cast<double>(timer.nsecsElapsed()) * 1e-6;
}

void paint(View3D& view, QImage& into) {
  view.render(&into);
}

double medianRedraw(View3D& view, QImage& into, int turns) {
  std::vector<double> times;
  for (int i = 0; i < turns; ++i) {
    Camera camera = view.camera();
    camera.turn(std::numbers::pi / 90.0, 0.0);
    QElapsedTimer timer;
    timer.start();
    view.setCamera(camera);
    paint(view, into);
    times.push_back(milliseconds(timer));
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

std::shared_ptr<Field> field200() {
  auto field = std::make_shared<Field>();
  field->grid = {0, 300, 0, 130, 0, 200, 200};
  field->component = Component::EX;
  for (int iy = 0; iy < 200; ++iy) {
    for (int ix = 0; ix < 200; ++ix) {
      const double x = field->grid.x_mm(ix);
      const double y = field->grid.y_mm(iy);
      field->value.push_back((x - 150) * 0.1 + 3.0 * std::sin(y / 20.0));
      field->sigma.push_back(0.8);
      field->extrapolated.push_back(x < 20 || x > 280);
    }
  }
  return field;
}

void heatMap(const MachineDescription& machine) {
  View3D view;
  view.resize(1280, 800);
  view.show();
  QImage picture(1280, 800, QImage::Format_RGB32);
  QElapsedTimer timer;
  timer.start();
  view.setMachine(machine);
  view.setColourScale(ColourScale::symmetric(18, QStringLiteral("EX"), QStringLiteral("um")));
  view.setField(field200());
  std::vector<ViewPoint> points;
  for (int i = 0; i < 8; ++i) {
    ViewPoint p;
    p.id = p.label = QStringLiteral("F%1").arg(i + 1);
    p.position_mm = {20.0 + 37 * i, i % 2 == 0 ? 20.0 : 110.0, 0};
    p.value = 1.0 * i;
    points.push_back(p);
  }
  view.setPoints(points);
  paint(view, picture);
  const double first = milliseconds(timer);
  std::printf("heat map 200 x 200, 8 points: first picture %.0f ms (at most 500), redraw %.1f ms (at most 50)\n", first,
              medianRedraw(view, picture, 30));
}

void cloud(double millions) {
  const auto count = static_cast<std::size_t>(millions * 1e6);
  auto positions = std::make_shared<std::vector<float>>(3 * count);
  auto scalar = std::make_shared<std::vector<float>>(count);
  const auto columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 11.0 * static_cast<double>(i % columns) / static_cast<double>(columns);
    const double y = 41.0 * static_cast<double>(i / columns) / static_cast<double>(columns);
    const double z = std::sin(0.6 * x) + 2.5 * std::sin(y / 6.0);
    (*positions)[3 * i] = static_cast<float>(x);
    (*positions)[3 * i + 1] = static_cast<float>(y);
    (*positions)[3 * i + 2] = static_cast<float>(z);
    (*scalar)[i] = static_cast<float>(z);
  }
  View3D view;
  view.resize(1280, 800);
  view.show();
  QImage picture(1280, 800, QImage::Format_RGB32);
  ViewCloud content;
  content.xyz_mm = positions;
  content.scalar = scalar;
  QElapsedTimer timer;
  timer.start();
  view.setColourScale(ColourScale::symmetric(3.5, QStringLiteral("z"), QStringLiteral("mm")));
  view.setCloud(content);
  paint(view, picture);
  const double first = milliseconds(timer);
  double longest = 0.0;
  QElapsedTimer step;
  while (view.refining() && milliseconds(timer) < 60000) {
    step.start();
    QApplication::processEvents(QEventLoop::AllEvents, 10);
    longest = std::max(longest, milliseconds(step));
  }
  const double complete = milliseconds(timer);
  (void)medianRedraw(view, picture, 30);  // how much there is time for is found while it moves
  const double moving = medianRedraw(view, picture, 60);
  constexpr double budget_ms = 1000.0 / 30.0;
  std::printf(
      "cloud %.1f million points: first picture %.0f ms (at most 2000), complete %.0f ms, window blocked at most %.0f "
      "ms meanwhile (at most 100), moving %.1f frames/s (at least 30): %.2f of the time for a picture\n",
      millions, first, complete, longest, 1000.0 / moving, moving / budget_ms);
}

}  // namespace

int main(int argc, char** argv) {
  if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM") && qEnvironmentVariableIsEmpty("DISPLAY")) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
  }
  QApplication application(argc, argv);
  applyTheme(application, ThemeKind::Light);
  heatMap(MachineDescription::parse(
      JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-(C)-t]",
        "axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,130]},{"name":"Z","travel_mm":[0,150]}]})",
                      "machine.json"),
      "machine.json"));
  cloud(argc > 1 ? std::atof(argv[1]) : 10.0);
  return 0;
}
