// SPDX-License-Identifier: Apache-2.0
#include "core/base/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/text.h"
#include "core/base/untrusted_text.h"

namespace spindrift {
namespace {

SourcePlace placeOfByte(std::string_view text, std::size_t byte, const std::filesystem::path& name) {
  std::size_t line = 1;
  std::size_t column = 1;
  for (std::size_t i = 0; i + 1 < byte && i < text.size(); ++i) {
    ++column;
    if (text[i] == '\n') {
      ++line;
      column = 1;
    }
  }
  return SourcePlace::atLine(name, line, fmt::format("column {}", column));
}

std::string shortDump(const nlohmann::json& value) {
  if (value.is_object()) return "an object";
  std::string text = value.dump();
  if (text.size() > 60) text = std::string(beginning(text, 57)) + "...";
  return text;
}

/// Where a parser is: the objects and lists that are open, and what of them it reads.
class OpenLevels {
 public:
  using Event = nlohmann::json::parse_event_t;
  /// False: a key that its object has already.
  bool take(Event event, const nlohmann::json& parsed) {
    if (event == Event::object_start || event == Event::array_start) levels_.push_back({event == Event::array_start});
    if (event == Event::key) {
      levels_.back().key = parsed.get<std::string>();
      return levels_.back().keys.insert(levels_.back().key).second;
    }
    if (event == Event::object_end || event == Event::array_end) levels_.pop_back();
    if (event != Event::object_start && event != Event::array_start && !levels_.empty()) ++levels_.back().index;
    return true;
  }
  [[nodiscard]] std::string path() const {
    std::string path = "$";
    for (const Level& level : levels_)
      path += level.list ? fmt::format("[{}]", level.index) : level.key.empty() ? "" : "." + level.key;
    return path;
  }

 private:
  struct Level {
    bool list = false;
    std::set<std::string> keys = {};
    std::string key = {};
    std::size_t index = 0;
  };
  std::vector<Level> levels_;
};

/// Bytes of a file that is read as JSON.
constexpr std::size_t largest_json_file = 500'000'000;

}  // namespace

JsonNode JsonNode::read(const std::filesystem::path& file) {
  return parse(readFile(file, largest_json_file), file);
}

JsonNode JsonNode::parse(std::string_view text, const std::filesystem::path& name) {
  if (deepestJson(text) > most_levels_of_json) {
    throw InputError({name, ""}, fmt::format("holds lists or objects more than {} deep in each other; allowed: at most "
                                             "that.",
                                             most_levels_of_json));
  }
  OpenLevels levels;
  const auto watch = [&](int, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
    if (!levels.take(event, parsed)) {
      throw InputError(
          {name, levels.path()},
          fmt::format("key \"{}\" appears twice in one object; allowed: each key once.", parsed.get<std::string>()));
    }
    return true;
  };
  try {
    auto document = std::make_shared<const nlohmann::json>(nlohmann::json::parse(text, watch));
    const nlohmann::json* root = document.get();
    return {std::move(document), std::make_shared<const std::filesystem::path>(name), root, "$"};
  } catch (const nlohmann::json::parse_error& error) {
    if (const std::size_t bad = firstInvalidUtf8(text); bad < error.byte) {
      throw InputError(
          placeOfByte(text, bad + 1, name),
          fmt::format("is not valid JSON here: the byte 0x{:02X} is not UTF-8 (Latin-1, perhaps); allowed: "
                      "JSON in UTF-8.",
                      static_cast<unsigned>(static_cast<unsigned char>(text[bad]))));
    }
    throw InputError(placeOfByte(text, error.byte, name), "is not valid JSON here; allowed: JSON (RFC 8259), no NaN.");
  } catch (const nlohmann::json::out_of_range&) {
    throw InputError({name, levels.path()}, "is a number too large for any computer; allowed: finite numbers.");
  } catch (const nlohmann::json::exception& error) {
    throw InputError({name, levels.path()}, fmt::format("is not valid JSON ({}).", error.what()));
  }
}

JsonNode JsonNode::child(const nlohmann::json& value, std::string path) const {
  return {document_, file_, &value, std::move(path)};
}

SourcePlace JsonNode::place() const {
  return {*file_, path_};
}

void JsonNode::reject(std::string_view allowed) const {
  throw InputError(place(), fmt::format("{} is not allowed; allowed: {}.", shortDump(*value_), allowed));
}

bool JsonNode::has(std::string_view key) const {
  if (!value_->is_object()) return false;
  const auto found = value_->find(std::string(key));
  return found != value_->end() && !found->is_null();
}

JsonNode JsonNode::at(std::string_view key) const {
  if (!value_->is_object()) reject("an object");
  const auto found = value_->find(std::string(key));
  if (found == value_->end()) throw InputError(place(), fmt::format("key \"{}\" is missing.", key));
  return child(*found, fmt::format("{}.{}", path_, key));
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  return at(key);
}

std::vector<JsonNode> JsonNode::items() const {
  if (!value_->is_array()) reject("a list");
  std::vector<JsonNode> nodes;
  for (std::size_t i = 0; i < value_->size(); ++i)
    nodes.push_back(child((*value_)[i], fmt::format("{}[{}]", path_, i)));
  return nodes;
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
  if (!value_->is_object()) reject("an object");
  std::vector<std::pair<std::string, JsonNode>> nodes;
  for (const auto& [key, member] : value_->items()) nodes.emplace_back(key, child(member, path_ + "." + key));
  return nodes;
}

double JsonNode::number() const {
  if (!value_->is_number()) reject("a number");
  const double number = value_->get<double>();
  if (!std::isfinite(number)) reject("a finite number");
  return number;
}

double JsonNode::positiveNumber() const {
  const double value = number();
  if (!(value > 0.0)) reject("a number greater than zero");
  return value;
}

double JsonNode::nonNegativeNumber() const {
  const double value = number();
  if (!(value >= 0.0)) reject("a number that is not negative");
  return value;
}

int JsonNode::integer() const {
  const double value = number();
  if (value != std::floor(value) || std::abs(value) > 2e9) reject("a whole number");
  return static_cast<int>(value);
}

bool JsonNode::boolean() const {
  if (!value_->is_boolean()) reject("true or false");
  return value_->get<bool>();
}

std::string JsonNode::string() const {
  if (!value_->is_string()) reject("a text");
  return value_->get<std::string>();
}

std::string JsonNode::name() const {
  std::string text = string();
  if (trimmed(text).empty()) reject("a text that is not empty");
  return text;
}

std::vector<double> JsonNode::numbers() const {
  std::vector<double> values;
  for (const JsonNode& node : items()) values.push_back(node.number());
  return values;
}

Eigen::Vector3d JsonNode::vector3() const {
  if (!value_->is_array() || value_->size() != 3) reject("a list of three numbers");
  const std::vector<double> v = numbers();
  return {v[0], v[1], v[2]};
}

std::string JsonNode::oneOf(const std::vector<std::string>& allowed) const {
  std::string text = string();
  if (std::find(allowed.begin(), allowed.end(), text) == allowed.end()) reject(joinedList(allowed, "or"));
  return text;
}

double JsonNode::numberOr(std::string_view key, double otherwise) const {
  const auto node = find(key);
  return node ? node->number() : otherwise;
}

std::string JsonNode::stringOr(std::string_view key, std::string_view otherwise) const {
  const auto node = find(key);
  return node ? node->string() : std::string(otherwise);
}

bool JsonNode::booleanOr(std::string_view key, bool otherwise) const {
  const auto node = find(key);
  return node ? node->boolean() : otherwise;
}

void JsonNode::requireFormat(std::string_view format, int newest_version) const {
  const JsonNode found = at("format");
  if (found.string() != format) found.reject(fmt::format("\"{}\"", format));
  const JsonNode version = at("version");
  const int number = version.integer();
  if (number < 1 || number > newest_version) {
    version.reject(fmt::format("a version from 1 to {} (a newer file needs a newer program)", newest_version));
  }
}

nlohmann::json jsonNumber(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json jsonNumber(const std::optional<double>& value) {
  return value ? jsonNumber(*value) : nlohmann::json(nullptr);
}

}  // namespace spindrift
