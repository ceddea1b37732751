// SPDX-License-Identifier: Apache-2.0
// The name of a content: two inputs with the same SHA-256 (FIPS 180-4) are the same input.
#pragma once

#include <string>
#include <string_view>

namespace spindrift {

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view content);

}  // namespace spindrift
