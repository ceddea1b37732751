// SPDX-License-Identifier: Apache-2.0
// Parts of the program that are loaded when they are first used. Libraries of others that most runs do without (files
// of images, clouds) bring a hundred more: finding all their names takes longer than what many a command does.
#pragma once

namespace spindrift {

/// What the shared object `file` of this installation exports as `symbol`; the same place every time. Thread-safe.
/// InputError where it is not there or cannot be loaded.
[[nodiscard]] const void* moduleSymbol(const char* file, const char* symbol);

}  // namespace spindrift
