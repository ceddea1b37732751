// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/discrepancy/study_cells.h"

namespace spindrift::study {
namespace {

std::vector<Cell> makeCells() {
  std::vector<Cell> list;
  const auto add = [&](const char* name, Row row, StudyKind kind, double strength, int share, int short_count,
                       const StudyConditions& conditions = {}, double ar1 = 0.0) {
    list.push_back({name, row, kind, strength, ar1, conditions, share, short_count});
  };
  add("clean, one, 0.8", Row::Clean08, StudyKind::One, 0.8, 4, 0);
  add("clean, one, 1.5", Row::Clean15, StudyKind::One, 1.5, 4, 0);
  add("clean, one, 4", Row::CleanStrong, StudyKind::One, 4.0, 5, 4);
  add("clean, one, 8", Row::CleanStrong, StudyKind::One, 8.0, 5, 0);
  const auto alone = [&](const char* name, int short_count, const auto& set) {
    StudyConditions c;
    set(c);
    add(name, Row::OneCondition, StudyKind::One, 6.0, 4, short_count, c);
  };
  alone("sigma", 2, [](StudyConditions& c) { c.sigma = true; });
  alone("tails", 2, [](StudyConditions& c) { c.tails = true; });
  alone("common shift", 2, [](StudyConditions& c) { c.common = true; });
  alone("drift", 2, [](StudyConditions& c) { c.drift = true; });
  alone("warm start", 2, [](StudyConditions& c) { c.warm_start = true; });
  alone("base off 8 %", 2, [](StudyConditions& c) { c.base_error = 0.08; });
  alone("base off 30 %", 2, [](StudyConditions& c) { c.one_base_error = 0.3; });
  alone("clock", 2, [](StudyConditions& c) { c.clock = true; });
  alone("coarse sensors", 2, [](StudyConditions& c) { c.coarse_sensors = true; });
  alone("slow sensors", 2, [](StudyConditions& c) { c.slow_sensors = true; });
  alone("gaps", 2, [](StudyConditions& c) { c.gaps = true; });
  alone("uneven", 2, [](StudyConditions& c) { c.uneven = true; });
  const StudyConditions together = StudyConditions::together();
  add("one, together", Row::OneTogether, StudyKind::One, 6.0, 8, 8, together);
  add("three, clean", Row::Three, StudyKind::Three, 5.0, 5, 3);
  add("three, together", Row::Three, StudyKind::Three, 5.0, 5, 3, together);
  add("nothing, clean", Row::Nothing, StudyKind::Nothing, 1.0, 4, 2);
  add("nothing, together", Row::Nothing, StudyKind::Nothing, 1.0, 6, 5, together);
  StudyConditions drifting;
  drifting.drift = true;
  add("nothing, drift", Row::Nothing, StudyKind::Nothing, 1.0, 4, 2, drifting);
  add("outside, clean", Row::Outside, StudyKind::Outside, 5.0, 4, 2);
  add("outside, together", Row::Outside, StudyKind::Outside, 5.0, 4, 2, together);
  add("slow noise, one, 4", Row::SlowNoise, StudyKind::One, 4.0, 4, 0, {}, 0.9);
  add("two, 4", Row::Two, StudyKind::Two, 4.0, 5, 4);
  add("confounded log, 5", Row::Confounded, StudyKind::Confounded, 5.0, 3, 0);
  return list;
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> list{{Row::OneCondition, "one effect at 6, each condition alone", 0.95, 0.0, 0.02},
                                        {Row::OneTogether, "one effect at 6, conditions together", 0.88, 0.0, 0.04},
                                        {Row::Three, "three effects, clean and together", 0.75, 0.90, 0.04},
                                        {Row::Nothing, "nothing hidden, clean and together", 0.93, 0.0, 0.03},
                                        {Row::Outside, "outside the catalogue, nothing named", 0.93, 0.0, 1.0},
                                        {Row::CleanStrong, "clean, one effect at 4-8", 0.995, 0.0, 0.01},
                                        {Row::Clean15, "clean, one effect at 1.5", 0.90, 0.0, 0.02},
                                        {Row::Clean08, "clean, one effect at 0.8", 0.68, 0.0, 0.03},
                                        {Row::SlowNoise, "slow noise, one effect at 4", 0.95, 0.0, 0.03},
                                        {Row::Two, "clean, two effects at 4", 0.92, 0.0, 0.02},
                                        {Row::Confounded, "confounded log", 0.95, 0.0, 0.02}};
  return list;
}

const std::vector<Cell>& cells() {
  static const std::vector<Cell> list = makeCells();
  return list;
}

}  // namespace spindrift::study
