// SPDX-License-Identifier: Apache-2.0
// Changes of single values in a JSON text: everything else stays as its author wrote it, blanks, order and digits.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace spindrift {

/// Keys, and digits for elements of lists: {"programme", "segments", "3", "spindle_rpm"}.
using JsonPath = std::vector<std::string>;

struct JsonEdit {
  JsonPath path;
  std::optional<nlohmann::json> value;  ///< nothing: the key is taken out
};

/// Sets the value, with the objects on its way where they are missing, or takes it out (nothing happens where it is
/// not). An element of a list must be there.
void applyEdit(nlohmann::json& document, const JsonEdit& edit);

/// The same in the text of a valid document. Numbers that change are the shortest that read back to the same value.
[[nodiscard]] std::string editedJson(const std::string& text, const std::vector<JsonEdit>& edits);

/// `entry` as last element of the list `key` of the document, which is made where it is missing.
[[nodiscard]] std::string appendedJson(const std::string& text, const std::string& key, const nlohmann::json& entry);

}  // namespace spindrift
