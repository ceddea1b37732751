// SPDX-License-Identifier: GPL-3.0-or-later
// What is said when something is refused.
#pragma once

#include <string>

#include "core/base/error.h"

namespace spindrift::testing {

/// The sentence of the InputError that `work()` ends with; empty if it is none.
template <typename Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace spindrift::testing
