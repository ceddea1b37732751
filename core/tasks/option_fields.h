// SPDX-License-Identifier: Apache-2.0
// How options are kept as JSON, declared once for each struct: the name and the member of every field.
//
//   struct CycleChoice {
//     bool second_axis = false;
//     double growth_um_per_m = 0.0;
//     template <class Options, class Visitor>
//     static void fields(Options& o, const Visitor& visit) {
//       visit("second_axis", o.second_axis);
//       visit("growth_um_per_m", o.growth_um_per_m);
//     }
//   };
//
// Writing puts down every field, those that were not chosen with their default, so that a result says all it was made
// with; an optional or an object without a value is left out. Reading takes a field that is not there, or that holds
// another kind of value than it may (a session can be damaged, or written by another), for one that was not chosen. So
// options of earlier versions, which wrote less, are equal to those that they stood for.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/workflows/thermal_workflow.h"

namespace spindrift {

template <class Options>
[[nodiscard]] nlohmann::json optionsJson(const Options& options);
template <class Options>
[[nodiscard]] Options optionsFrom(const nlohmann::json& json);

namespace option_fields {

inline nlohmann::json json(const std::string& value) {
  return value;
}
inline nlohmann::json json(bool value) {
  return value;
}
inline nlohmann::json json(int value) {
  return value;
}
inline nlohmann::json json(double value) {
  return value;
}
inline nlohmann::json json(const std::vector<std::string>& value) {
  return value;
}
inline nlohmann::json json(const TimeRange& value) {
  return {value.from_s, value.to_s};
}
inline nlohmann::json json(const Eigen::Vector3d& value) {
  return {value.x(), value.y(), value.z()};
}
template <class T>
requires std::is_enum_v<T> nlohmann::json json(T value) {
  return static_cast<int>(value);
}
template <class T>
requires std::is_class_v<T> && requires(T& t) {
  T::fields(t, [](const char*, auto&) {});
}
nlohmann::json json(const T& value) {
  return optionsJson(value);
}

inline bool isNumber(const nlohmann::json& json) {
  return json.is_number() && std::isfinite(json.get<double>());
}
/// False: another kind of value; `value` is as it was.
inline bool take(const nlohmann::json& json, std::string& value) {
  if (json.is_string()) value = json.get<std::string>();
  return json.is_string();
}
inline bool take(const nlohmann::json& json, bool& value) {
  if (json.is_boolean()) value = json.get<bool>();
  return json.is_boolean();
}
inline bool take(const nlohmann::json& json, int& value) {
  if (!json.is_number_integer()) return false;
  const auto number = json.get<std::int64_t>();
  if (number < std::numeric_limits<int>::min() || number > std::numeric_limits<int>::max()) return false;
  value = static_cast<int>(number);
  return true;
}
inline bool take(const nlohmann::json& json, double& value) {
  if (isNumber(json)) value = json.get<double>();
  return isNumber(json);
}
inline bool take(const nlohmann::json& json, std::vector<std::string>& value) {
  if (!json.is_array()) return false;
  for (const nlohmann::json& item : json)
    if (!item.is_string()) return false;
  value = json.get<std::vector<std::string>>();
  return true;
}
inline bool take(const nlohmann::json& json, TimeRange& value) {
  if (!json.is_array() || json.size() != 2 || !isNumber(json[0]) || !isNumber(json[1])) return false;
  value = {json[0].get<double>(), json[1].get<double>()};
  return true;
}
inline bool take(const nlohmann::json& json, Eigen::Vector3d& value) {
  if (!json.is_array() || json.size() != 3 || !isNumber(json[0]) || !isNumber(json[1]) || !isNumber(json[2]))
    return false;
  value = {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
  return true;
}
inline bool take(const nlohmann::json& json, nlohmann::json& value) {
  if (json.is_object()) value = json;
  return json.is_object();
}
/// Enumerations that end with `last` are kept as numbers.
template <class T>
requires std::is_enum_v<T>
bool take(const nlohmann::json& json, T& value) {
  int number = 0;
  if (!take(json, number) || number < 0 || number > static_cast<int>(lastOf(T()))) return false;
  value = static_cast<T>(number);
  return true;
}
template <class T>
requires std::is_class_v<T> && requires(T& t) {
  T::fields(t, [](const char*, auto&) {});
}
bool take(const nlohmann::json& json, T& value) {
  value = optionsFrom<T>(json);
  return true;
}

class Writer {
 public:
  explicit Writer(nlohmann::json& out) : out_(out) {}
  template <class T>
  void operator()(const char* name, const T& value) const {
    out_[name] = json(value);
  }
  void operator()(const char* name, const nlohmann::json& value) const {
    if (!value.is_null()) out_[name] = value;
  }
  template <class T>
  void operator()(const char* name, const std::optional<T>& value) const {
    if (value) out_[name] = json(*value);
  }
  /// Kept by its name.
  template <class T, std::size_t n>
  void operator()(const char* name, const T& value, const std::array<std::string_view, n>& names) const {
    out_[name] = names[static_cast<std::size_t>(value)];
  }

 private:
  nlohmann::json& out_;
};

class Reader {
 public:
  explicit Reader(const nlohmann::json& in) : in_(in) {}
  template <class T>
  void operator()(const char* name, T& value) const {
    if (const auto found = in_.find(name); found != in_.end()) (void)take(*found, value);
  }
  template <class T>
  void operator()(const char* name, std::optional<T>& value) const {
    T taken{};
    if (const auto found = in_.find(name); found != in_.end() && take(*found, taken)) value = std::move(taken);
  }
  template <class T, std::size_t n>
  void operator()(const char* name, T& value, const std::array<std::string_view, n>& names) const {
    std::string text;
    (*this)(name, text);
    for (std::size_t i = 0; i < n; ++i)
      if (names[i] == text) value = static_cast<T>(i);
  }

 private:
  const nlohmann::json& in_;
};

}  // namespace option_fields

template <class Options>
nlohmann::json optionsJson(const Options& options) {
  nlohmann::json out = nlohmann::json::object();
  Options::fields(options, option_fields::Writer(out));
  return out;
}

template <class Options>
Options optionsFrom(const nlohmann::json& json) {
  Options options;
  if (json.is_object()) Options::fields(options, option_fields::Reader(json));
  return options;
}

}  // namespace spindrift
