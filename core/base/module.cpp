// SPDX-License-Identifier: Apache-2.0
#include "core/base/module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "core/base/error.h"

namespace spindrift {

const void* moduleSymbol(const char* file, const char* symbol) {
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  const fs::path beside = program.parent_path() / SPINDRIFT_MODULE_FOLDER / file;
  // A program that was copied elsewhere: where the system looks for libraries.
  const std::string name = fs::exists(beside, none) ? beside.string() : file;
  void* const module = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL);
  const void* const found = module != nullptr ? dlsym(module, symbol) : nullptr;
  if (found != nullptr) return found;
  const char* const reason = dlerror();
  throw InputError(fmt::format("A part of this installation cannot be loaded ({}); install Spindrift again.",
                               reason != nullptr ? reason : file));
}

}  // namespace spindrift
