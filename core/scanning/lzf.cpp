// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/lzf.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace spindrift {

bool lzfUnpack(std::string_view packed, std::string& out) {
  std::size_t i = 0;
  std::size_t o = 0;
  const std::size_t size = out.size();
  while (i < packed.size()) {
    const unsigned control = static_cast<unsigned char>(packed[i++]);
    if (control < 32U) {
      const std::size_t run = control + 1U;
      if (run > packed.size() - i || run > size - o) return false;
      std::memcpy(out.data() + o, packed.data() + i, run);
      i += run;
      o += run;
      continue;
    }
    std::size_t length = control >> 5U;
    if (length == 7U) {
      if (i >= packed.size()) return false;
      length += static_cast<unsigned char>(packed[i++]);
    }
    length += 2U;
    if (i >= packed.size()) return false;
    const std::size_t distance = ((control & 31U) << 8U) + static_cast<unsigned char>(packed[i++]) + 1U;
    if (distance > o || length > size - o) return false;
    for (std::size_t k = 0; k < length; ++k, ++o) out[o] = out[o - distance];
  }
  return o == size;
}

std::string lzfPack(std::string_view data) {
  constexpr std::size_t most_literal = 32, most_match = 264, most_distance = 8192;
  std::string out;
  out.reserve(data.size() + data.size() / 32 + 16);
  std::array<std::size_t, 1U << 14U> last{};  // position + 1 of the last place with this hash
  std::size_t literal_from = 0;
  const auto flush = [&](std::size_t to) {
    while (literal_from < to) {
      const std::size_t run = std::min(most_literal, to - literal_from);
      out += static_cast<char>(run - 1);
      out.append(data.substr(literal_from, run));
      literal_from += run;
    }
  };
  std::size_t i = 0;
  while (i + 3 <= data.size()) {
    const auto byte = [&](std::size_t k) { return static_cast<std::uint32_t>(static_cast<unsigned char>(data[k])); };
    const std::uint32_t key = (byte(i) << 16U) | (byte(i + 1) << 8U) | byte(i + 2);
    std::size_t& slot = last[(key * 2654435761U) >> 18U];
    const std::size_t candidate = slot;
    slot = i + 1;
    if (candidate == 0 || i - (candidate - 1) > most_distance || data.compare(candidate - 1, 3, data, i, 3) != 0) {
      ++i;
      continue;
    }
    const std::size_t from = candidate - 1;
    std::size_t length = 3;
    while (length < most_match && i + length < data.size() && data[from + length] == data[i + length]) ++length;
    flush(i);
    const std::size_t distance = i - from - 1;
    const std::size_t code = length - 2;
    if (code < 7) {
      out += static_cast<char>((code << 5U) | (distance >> 8U));
    } else {
      out += static_cast<char>((7U << 5U) | (distance >> 8U));
      out += static_cast<char>(code - 7);
    }
    out += static_cast<char>(distance & 255U);
    i += length;
    literal_from = i;
  }
  flush(data.size());
  return out;
}

}  // namespace spindrift
