// SPDX-License-Identifier: GPL-3.0-or-later
// Every reader of files that come from elsewhere, as a function of bytes: what libFuzzer calls with bytes of its own
// (fuzz_main.cpp) and the normal test suite with the seeds in tests/fuzz/corpus (tests/core/readers).
//
// Whatever the bytes are, a reader either takes them or throws InputError with one sentence of valid UTF-8. Any other
// exception, and every report of a sanitizer, is a fault.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace spindrift::testing {

struct Reader {
  const char* name;  ///< of its folder in tests/fuzz/corpus
  void (*read)(std::string_view bytes);
};

[[nodiscard]] std::span<const Reader> machineReaders();
[[nodiscard]] std::span<const Reader> imagingReaders();
[[nodiscard]] std::span<const Reader> probingReaders();
[[nodiscard]] std::span<const Reader> scanningReaders();
[[nodiscard]] std::span<const Reader> thermalReaders();
[[nodiscard]] std::span<const Reader> finiteElementReaders();
[[nodiscard]] std::span<const Reader> simulatorReaders();
[[nodiscard]] std::span<const Reader> sessionReaders();
[[nodiscard]] std::span<const Reader> plantReaders();
/// What needs most of core to be read: a libFuzzer program of its own.
[[nodiscard]] std::span<const Reader> wholeCoreReaders();

/// Runs the reader. Returns its sentence, empty if it took the bytes; throws std::logic_error if the sentence is none
/// (empty, several lines, no UTF-8), and lets every other exception pass.
std::string sentenceOf(const Reader& reader, std::string_view bytes);

/// A file with this content in a folder of this process, in memory where the system has such a place; removed at its
/// end.
[[nodiscard]] std::filesystem::path scratchFile(const std::string& name, std::string_view bytes);

/// A small machine with all that machine.json may hold.
[[nodiscard]] std::string smallMachine();

}  // namespace spindrift::testing
