// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer programs: fuzz_readers --reader=NAME [libFuzzer's options] FOLDER..., and fuzz_whole_core of the readers
// that need most of core.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

#include "tests/fuzz/readers.h"

namespace {

using spindrift::testing::Reader;

const Reader* chosen = nullptr;

const Reader* find(std::string_view name) {
  using namespace spindrift::testing;
#ifdef SPINDRIFT_WHOLE_CORE
  for (const auto& list : {wholeCoreReaders()}) {
#else
  for (const auto& list : {machineReaders(), imagingReaders(), probingReaders(), scanningReaders(), thermalReaders(),
                           finiteElementReaders(), simulatorReaders(), sessionReaders(), plantReaders()}) {
#endif
    for (const Reader& reader : list) {
      if (name.empty()) std::fprintf(stderr, "%s\n", reader.name);
      if (name == reader.name) return &reader;
    }
  }
  return nullptr;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  constexpr std::string_view option = "--reader=";
  for (int i = 1; i < *count; ++i) {
    const std::string_view argument = (*arguments)[i];
    if (argument.starts_with(option)) chosen = find(argument.substr(option.size()));
  }
  if (chosen == nullptr) {
    std::fprintf(stderr, "--reader=NAME is missing or not known; allowed:\n");
    (void)find("");
    std::exit(2);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    (void)spindrift::testing::sentenceOf(*chosen, {reinterpret_cast<const char*>(data), size});
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s: %s\n", chosen->name, fault.what());
    std::abort();
  }
  return 0;
}
