// SPDX-License-Identifier: Apache-2.0
// JSON from users: every value is asked for with its type, every complaint names the file, the JSON path, the value
// found and what is allowed. A duplicate key is an error. Unknown keys are ignored.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace spindrift {

/// A value in a JSON document together with where it stands. Copies are cheap and keep the document alive.
class JsonNode {
 public:
  /// Throws InputError: unreadable, not JSON (with line and column), duplicate key.
  [[nodiscard]] static JsonNode read(const std::filesystem::path& file);
  [[nodiscard]] static JsonNode parse(std::string_view text, const std::filesystem::path& name);

  [[nodiscard]] const nlohmann::json& value() const noexcept { return *value_; }
  /// Where this value stands, for an error of the caller's own.
  [[nodiscard]] SourcePlace place() const;

  /// True if the key is there and is not null.
  [[nodiscard]] bool has(std::string_view key) const;
  /// Member of an object; throws InputError if this is no object or the key is missing.
  [[nodiscard]] JsonNode at(std::string_view key) const;
  [[nodiscard]] std::optional<JsonNode> find(std::string_view key) const;
  /// Elements of a list.
  [[nodiscard]] std::vector<JsonNode> items() const;
  /// Members of an object in the order of the keys.
  [[nodiscard]] std::vector<std::pair<std::string, JsonNode>> members() const;

  [[nodiscard]] double number() const;
  [[nodiscard]] double positiveNumber() const;
  [[nodiscard]] double nonNegativeNumber() const;
  [[nodiscard]] int integer() const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string string() const;
  /// Text that must not be empty.
  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::vector<double> numbers() const;
  /// A list of three numbers.
  [[nodiscard]] Eigen::Vector3d vector3() const;
  /// One of the given words.
  [[nodiscard]] std::string oneOf(const std::vector<std::string>& allowed) const;

  [[nodiscard]] double numberOr(std::string_view key, double otherwise) const;
  [[nodiscard]] std::string stringOr(std::string_view key, std::string_view otherwise) const;
  [[nodiscard]] bool booleanOr(std::string_view key, bool otherwise) const;

  /// Checks `"format"` and `"version"`: throws InputError for another format or a version newer than `newest_version`.
  void requireFormat(std::string_view format, int newest_version) const;

  /// Throws InputError: "<found> is not allowed; allowed: <allowed>."
  [[noreturn]] void reject(std::string_view allowed) const;

 private:
  JsonNode(std::shared_ptr<const nlohmann::json> document, std::shared_ptr<const std::filesystem::path> file,
           const nlohmann::json* value, std::string path)
      : document_(std::move(document)), file_(std::move(file)), value_(value), path_(std::move(path)) {}
  [[nodiscard]] JsonNode child(const nlohmann::json& value, std::string path) const;

  std::shared_ptr<const nlohmann::json> document_;
  std::shared_ptr<const std::filesystem::path> file_;
  const nlohmann::json* value_;
  std::string path_;
};

/// A double for JSON output: null where it does not exist (NaN, infinite).
[[nodiscard]] nlohmann::json jsonNumber(double value);
[[nodiscard]] nlohmann::json jsonNumber(const std::optional<double>& value);

}  // namespace spindrift
