// SPDX-License-Identifier: Apache-2.0
// For the precompiled headers only. The literal "..."_json is an inline function, so each file that reads json.hpp
// makes the whole parser, used or not: half a second of each file. Here the literal is declared, and its body becomes
// that of a template that nobody calls. Nothing in this tree uses the literal; nlohmann::json::parse says the same.
#pragma once

#define JSON_USE_GLOBAL_UDLS 0
#define _json(text, length) \
  _json(text, length);      \
  template <class Text>     \
  nlohmann::json unusedJsonLiteral(Text s, std::size_t n)
#include <nlohmann/json.hpp>
#undef _json

// The members stand in core/base/json_instance.cpp; elsewhere they are expanded in place or called.
extern template class nlohmann::basic_json<>;
