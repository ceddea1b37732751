// SPDX-License-Identifier: GPL-3.0-or-later
// Machines, cycles and campaigns for the tests of probing.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/probing/evaluate_touches.h"
#include "core/simulation/virtual_probe.h"
#include "tests/core/probing/probe_deviations.h"

namespace spindrift::probing_test {

inline MachineDescription machineFrom(const std::string& json) {
  return MachineDescription::parse(JsonNode::parse(json, "machine.json"), "machine.json");
}

inline std::string holeMachineText() {
  return R"({"format":"spindrift-machine","version":1,"name":"five axes","chain":"V [w-C2'-A'-X'-b-Y-Z-C1-t]",
"axes":[{"name":"X","travel_mm":[0,520]},{"name":"Y","travel_mm":[0,450]},{"name":"Z","travel_mm":[-60,400]}],
"rotary":[{"name":"C2","centre_mm":[251,203,-4]}],
"artefacts":[{"id":"bar","kind":"hole_bar","nominal_positions_mm":[0,37,101,150,199,262,318],"reference_hole":"H1",
"reference_in_table_mm":[-143,17,0],"hole_diameter_mm":12,"direction_at_c0":[1,0,0]}],
"styli":[{"id":"p0","radius_mm":1.5,"offset_mm":[0,0,-60]}]})";
}

inline std::string ballMachineText() {
  return R"({"format":"spindrift-machine","version":1,"name":"horizontal","chain":"H [w-Z'-b-X-Y-(C)-t]",
"axes":[{"name":"X","travel_mm":[0,500],"drive":{"fixed_bearing_mm":-20}},{"name":"Y","travel_mm":[0,500],
"drive":{"fixed_bearing_mm":510}},{"name":"Z","travel_mm":[0,500],"drive":{"fixed_bearing_mm":0}}],
"artefacts":[{"id":"balls","kind":"balls","balls":[{"id":"B1","diameter_mm":25,"certified_mm":[0,0,0]},
{"id":"B2","diameter_mm":25,"certified_mm":[240,30,70]},{"id":"B3","diameter_mm":25,"certified_mm":[30,260,150]},
{"id":"B4","diameter_mm":25,"certified_mm":[270,275,230]}],"certificate_uncertainty_um":0.4}],
"styli":[{"id":"p0","radius_mm":2.5,"offset_mm":[0,0,-50]},{"id":"p1","radius_mm":2.5,"offset_mm":[0,50,-20]},
{"id":"p2","radius_mm":2.5,"offset_mm":[50,0,-20]}]})";
}

/// Random parameters of a warm machine; the first cycle gets zeros.
inline std::vector<double> randomParameters(bool holes, Random& random) {
  std::vector<double> p;
  for (int i = 0; i < (holes ? 9 : 12); ++i) p.push_back(random.uniform(-25.0, 25.0));
  return p;
}

struct VirtualRun {
  TouchList list;
  std::vector<std::vector<double>> truth;  ///< per cycle
};

inline VirtualRun runCycles(const MachineDescription& machine, int cycles, const VirtualProbeOptions& options,
                            std::uint64_t seed, std::function<std::vector<double>(int, Random&)> parameters = {}) {
  const Artefact& artefact = machine.artefacts.front();
  const bool holes = artefact.kind == "hole_bar";
  Random random(seed);
  VirtualRun run;
  for (int k = 0; k < cycles; ++k) {
    std::vector<double> p(holes ? 9 : 12, 0.0);
    if (parameters) {
      p = parameters(k, random);
    } else if (k > 0) {
      p = randomParameters(holes, random);
    }
    const std::string name = "M" + std::to_string(k);
    const std::vector<Touch> touches =
        holes
            ? probeHoleBar(machine, artefact, name, 600.0 * k, holeBarDeviation(machine, artefact, p), options, random)
            : probeBalls(machine, artefact, name, 600.0 * k, ballDeviation(machine, p), options, random);
    run.list.touches.insert(run.list.touches.end(), touches.begin(), touches.end());
    run.truth.push_back(p);
  }
  return run;
}

inline void removeTouches(TouchList& list, const std::function<bool(const Touch&)>& which) {
  std::erase_if(list.touches, which);
}

}  // namespace spindrift::probing_test
