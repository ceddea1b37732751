// SPDX-License-Identifier: Apache-2.0
// Reading and writing whole files so that a crash never leaves half of one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace spindrift {

/// Whole content of a file. Throws InputError with the reason if it cannot be read.
[[nodiscard]] std::string readFile(const std::filesystem::path& file);
/// The same; a file of more than `at_most` bytes is refused before anything of it is read (a pipe or a device: as soon
/// as it has given more).
[[nodiscard]] std::string readFile(const std::filesystem::path& file, std::size_t at_most);

/// Writes to a temporary file in the same folder, flushes it to the disk and renames it over `file`: afterwards the
/// file has either its old or its new content. Missing parent folders are made. Throws InputError (disk full, read-only
/// ...).
void writeFileAtomically(const std::filesystem::path& file, std::string_view content);

}  // namespace spindrift
