// SPDX-License-Identifier: Apache-2.0
// The members of nlohmann::json, once for all: resources/precompiled/json.h says that they are here.
#include <nlohmann/json.hpp>

template class nlohmann::basic_json<>;
