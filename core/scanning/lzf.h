// SPDX-License-Identifier: Apache-2.0
// LZF, the compression inside binary_compressed PCD files: literal runs of up to 32 bytes and back references of up to
// 264 bytes within the last 8 KiB.
#pragma once

#include <string>
#include <string_view>

namespace spindrift {

/// Fills `out` (already of the unpacked size). False if the stream is damaged or does not give exactly that size.
[[nodiscard]] bool lzfUnpack(std::string_view packed, std::string& out);
/// Never fails; grows incompressible data by 1/32.
[[nodiscard]] std::string lzfPack(std::string_view data);

}  // namespace spindrift
