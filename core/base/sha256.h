// SPDX-License-Identifier: Apache-2.0
// The name of a content: two inputs with the same SHA-256 (FIPS 180-4) are the same input.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace spindrift {

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view content);
/// The same of a file, which is never held whole. Throws InputError if it cannot be read.
[[nodiscard]] std::string sha256OfFile(const std::filesystem::path& file);

}  // namespace spindrift
