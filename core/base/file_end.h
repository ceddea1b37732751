// SPDX-License-Identifier: Apache-2.0
// The ends of files that grow: read and written without the rest of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace spindrift {

/// The bytes of a file from `from` up to `to`, or to its end. Throws InputError if it cannot be read.
[[nodiscard]] std::string readPart(const std::filesystem::path& file, std::uint64_t from, std::uint64_t to);

/// Writes `text` from byte `from` of a file on, ends the file there and flushes it. A crash leaves any part of that; an
/// error (disk full) puts back what stood there. Throws InputError.
void replaceEnd(const std::filesystem::path& file, std::uint64_t from, std::string_view text);

}  // namespace spindrift
