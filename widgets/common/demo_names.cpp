// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/demo_names.h"

#include <QCoreApplication>
#include <algorithm>
#include <array>

namespace spindrift::gui {
namespace {

/// "name" of the scenarios in resources/scenarios that become a demo, and of their machines.
constexpr std::array demo_names{
    QT_TRANSLATE_NOOP("DemoNames", "coded fiducials, cold and after two hours of cutting"),
    QT_TRANSLATE_NOOP("DemoNames", "hole bar, warm-up and cool-down"),
    QT_TRANSLATE_NOOP("DemoNames", "ball artefact, spindle at 2500 rpm"),
    QT_TRANSLATE_NOOP("DemoNames", "free-form artefacts under a laser profiler along the crossbeam"),
    QT_TRANSLATE_NOOP("DemoNames", "vertical machining centre, simulation with a gap"),
    QT_TRANSLATE_NOOP("DemoNames", "fiducials of the user's own artwork: 7 x 7 ellipses on a pitch of 455 µm"),
    QT_TRANSLATE_NOOP("DemoNames", "three-axis mill"),
    QT_TRANSLATE_NOOP("DemoNames", "five-axis machining centre"),
    QT_TRANSLATE_NOOP("DemoNames", "horizontal machining centre"),
    QT_TRANSLATE_NOOP("DemoNames", "gantry milling machine"),
    QT_TRANSLATE_NOOP("DemoNames", "vertical machining centre"),
};

}  // namespace

QString shownName(const std::string& name) {
  const bool of_demo = std::any_of(demo_names.begin(), demo_names.end(), [&](const char* one) { return name == one; });
  return of_demo ? QCoreApplication::translate("DemoNames", name.c_str()) : QString::fromStdString(name);
}

std::string keptName(const QString& typed, const std::string& kept) {
  return typed == shownName(kept) ? kept : typed.toStdString();
}

}  // namespace spindrift::gui
