// SPDX-License-Identifier: Apache-2.0
// Text that came from elsewhere: what it may do to the program, and what the program may say of it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace spindrift {

/// Index of the first byte that is no UTF-8 (overlong forms, surrogates and what lies above U+10FFFF are none); npos if
/// there is none.
[[nodiscard]] std::size_t firstInvalidUtf8(std::string_view text) noexcept;

/// The text as part of a sentence: bytes that are no UTF-8 and characters that turn the direction of a text become
/// U+FFFD, line breaks and other control characters blanks.
[[nodiscard]] std::string printable(std::string_view text);

/// A name of a file, whatever its bytes, as UTF-8: bytes that are none are written as "\xE4", and the backslash of a
/// name that says "\x" by itself as "\x5C", so that no two names become one. Any other name is itself.
[[nodiscard]] std::string nameAsText(std::string_view name);

/// The first `bytes` bytes or up to three less, so that no character is cut in two.
[[nodiscard]] std::string_view beginning(std::string_view text, std::size_t bytes) noexcept;

/// How deep lists and objects of JSON stand in each other; what writes or compares a document calls itself as often.
[[nodiscard]] std::size_t deepestJson(std::string_view json) noexcept;
inline constexpr std::size_t most_levels_of_json = 500;

}  // namespace spindrift
