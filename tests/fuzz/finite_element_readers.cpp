// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include "core/finite_elements/fe_deviation.h"
#include "core/finite_elements/fe_map.h"
#include "core/finite_elements/fe_result.h"
#include "tests/fuzz/readers.h"

namespace spindrift::testing {
namespace {

void result(const FeResultReader& reader) {
  const FeMesh mesh = reader.mesh();
  std::set<NodeId> wanted;
  for (const auto& [id, place] : mesh.nodes) wanted.insert(id);
  for (const auto& [name, nodes] : mesh.sets) wanted.insert(nodes.begin(), nodes.end());
  (void)reader.states(wanted);
}

void frd(std::string_view bytes) {
  result(*openFeResult(scratchFile("result.frd", bytes)));
}
void dat(std::string_view bytes) {
  result(*openFeResult(scratchFile("result.dat", bytes)));
}
void mesh(std::string_view bytes) {
  (void)readAbaqusMesh(scratchFile("mesh/mesh.inp", bytes));
}
void map(std::string_view bytes) {
  FeMap::read(scratchFile("map.json", bytes)).validate();
}

/// The weights of nodes, of a result that has nodes 1 to 3.
void observe(std::string_view bytes) {
  FeMap map;
  map.result = scratchFile("observe/result.dat",
                           "\n displacements (vx,vy,vz) for set ALL and time  0.1000000E+01\n\n"
                           "         1  1.0E-03 0.0E+00 0.0E+00\n         2  0.0E+00 1.0E-03 0.0E+00\n"
                           "         3  0.0E+00 0.0E+00 1.0E-03\n");
  map.observe = scratchFile("observe/observe.csv", bytes);
  map.unit_of_displacement = "mm";
  JobContext job;
  (void)feDeviation(map, openFeResult, job);
}

constexpr Reader readers[] = {{"frd", frd}, {"dat", dat}, {"mesh", mesh}, {"fe_map", map}, {"fe_observe", observe}};

}  // namespace

std::span<const Reader> finiteElementReaders() {
  return readers;
}

}  // namespace spindrift::testing
