// SPDX-License-Identifier: Apache-2.0
#include "core/finite_elements/fe_result.h"

#include <algorithm>
#include <cctype>

#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {

void FeMesh::complete(const FeMesh& other) {
  for (const auto& [id, place] : other.nodes) nodes.emplace(id, place);
  for (const auto& [name, list] : other.sets) sets.emplace(name, list);
}

std::string setName(std::string_view name) {
  std::string out(trimmed(name));
  if (out.size() > 1 && out.front() == '"' && out.back() == '"') out = out.substr(1, out.size() - 2);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return out;
}

std::unique_ptr<FeResultReader> openFeResult(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".frd") return openFrd(file);
  if (ending == ".dat") return openDat(file);
  if (ending == ".vtu" || ending == ".pvd") {
    throw InputError({file, ""},
                     "is a VTK file, which the program spindrift-fe reads (spindrift-fe simulation import, the same "
                     "options, writes simulation.csv); allowed here: .frd or .dat.");
  }
  throw InputError({file, ""}, "is not a result of finite elements by its ending; allowed: .frd, .dat, .vtu or .pvd.");
}

}  // namespace spindrift
