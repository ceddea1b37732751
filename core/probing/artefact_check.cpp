// SPDX-License-Identifier: Apache-2.0
#include "core/probing/artefact_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "core/machine/artefact_ranges.h"

namespace spindrift {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

std::string shown(const nlohmann::json& value) {
  if (value.is_string()) return value.get<std::string>().empty() ? "nothing" : "\"" + value.get<std::string>() + "\"";
  return value.is_null() ? "nothing" : value.dump();
}

/// Collects findings of one object.
class Checker {
 public:
  explicit Checker(const nlohmann::json& object) : object_(object) {}
  std::vector<ArtefactFinding> findings;

  void add(const std::string& key, int row, int column, std::string sentence, bool wrong = true) {
    findings.push_back({key, row, column, wrong, std::move(sentence)});
  }

  /// A number within [low, high]; empty if it is none or not allowed.
  std::optional<double> number(const nlohmann::json& value, const std::string& what, const std::string& key, int row,
                               int column, double low, double high, const char* unit) {
    const bool good = value.is_number() && std::isfinite(value.get<double>());
    if (good && value.get<double>() >= low && value.get<double>() <= high) return value.get<double>();
    std::string allowed = "a number in";
    if (low > -unlimited && high < unlimited) {
      allowed = fmt::format("{:g} to {:g}", low, high);
    } else if (low == 0.0) {
      allowed = "zero or a number above, in";
    }
    add(key, row, column, fmt::format("{} is {}; allowed: {} {}.", what, shown(value), allowed, unit));
    return std::nullopt;
  }
  std::optional<double> optional(const char* key, const std::string& what, double low, double high, const char* unit) {
    if (!object_.contains(key) || object_.at(key).is_null()) return std::nullopt;
    return number(object_.at(key), what, key, -1, -1, low, high, unit);
  }
  std::optional<std::array<double, 3>> vector(const nlohmann::json& value, const std::string& what,
                                              const std::string& key, int row, int first_column) {
    if (!value.is_array() || value.size() != 3) {
      add(key, row, first_column, fmt::format("{} is {}; allowed: three numbers in mm.", what, shown(value)));
      return std::nullopt;
    }
    std::array<double, 3> v{};
    bool all = true;
    for (int k = 0; k < 3; ++k) {
      const auto n = number(value[static_cast<std::size_t>(k)], fmt::format("{}, {}", what, "xyz"[k]), key, row,
                            first_column + k, -unlimited, unlimited, "mm");
      all = all && n.has_value();
      v[static_cast<std::size_t>(k)] = n.value_or(0.0);
    }
    return all ? std::optional(v) : std::nullopt;
  }
  void name(const nlohmann::json& value, const std::string& what, const std::string& key, int row, int column,
            std::set<std::string>& taken) {
    if (!value.is_string() || value.get<std::string>().empty()) {
      add(key, row, column, fmt::format("{} has no name; allowed: letters and digits, such as B1.", what));
    } else if (!taken.insert(value.get<std::string>()).second) {
      add(key, row, column, fmt::format("duplicate name {}; allowed: every name once.", shown(value)));
    }
  }

 private:
  const nlohmann::json& object_;
};

void checkHoles(const nlohmann::json& artefact, const nlohmann::json& styli, Checker& check) {
  std::vector<std::optional<double>> positions;
  const nlohmann::json list = artefact.value("nominal_positions_mm", nlohmann::json::array());
  if (!list.is_array() || list.empty()) {
    check.add("nominal_positions_mm", -1, -1,
              "The bar has no holes; allowed: one or more, three to separate its errors.");
    return;
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    positions.push_back(check.number(list[i], fmt::format("The position of H{}", i + 1), "nominal_positions_mm",
                                     static_cast<int>(i), 0, -unlimited, unlimited, "mm"));
  }
  const auto diameter = check.optional("hole_diameter_mm", "The diameter of the holes", 1e-3, 1000.0, "mm");
  double longest = 0.0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!positions[i] || !positions[j]) continue;
      const double distance = std::abs(*positions[i] - *positions[j]);
      longest = std::max(longest, distance);
      if (distance <= diameter.value_or(0.0)) {
        check.add("nominal_positions_mm", static_cast<int>(i), 0,
                  fmt::format("H{} at {:g} mm runs into H{} at {:g} mm; allowed: holes more than a diameter apart.",
                              i + 1, *positions[i], j + 1, *positions[j]));
        break;
      }
    }
  }
  if (positions.size() > 1 && longest > 0.0 && longest < 25.0) {
    check.add("nominal_positions_mm", -1, -1,
              fmt::format("The bar is only {:.3g} mm long. Are these inches? Allowed are millimetres.", longest),
              false);
  }
  const std::string reference = artefact.value("reference_hole", "H1");
  bool known = false;
  for (std::size_t i = 0; i < list.size(); ++i) known = known || reference == fmt::format("H{}", i + 1);
  if (!known) {
    check.add("reference_hole", -1, -1,
              fmt::format("The reference hole is \"{}\"; allowed: H1 to H{}.", reference, list.size()));
  }
  (void)check.vector(artefact.value("reference_in_table_mm", nlohmann::json()), "The place of the reference hole",
                     "reference_in_table_mm", -1, 0);
  if (artefact.contains("direction_at_c0")) {
    const auto v = check.vector(artefact.at("direction_at_c0"), "The direction of the bar", "direction_at_c0", -1, 0);
    if (v && std::hypot((*v)[0], (*v)[1], (*v)[2]) < 1e-9) {
      check.add("direction_at_c0", -1, 0, "The direction of the bar is (0, 0, 0); allowed: a vector along the bar.");
    }
  }
  if (!diameter) return;
  for (const nlohmann::json& stylus : styli) {
    const nlohmann::json radius = stylus.value("radius_mm", nlohmann::json());
    if (radius.is_number() && 2.0 * radius.get<double>() >= *diameter) {
      check.add("hole_diameter_mm", -1, -1,
                fmt::format("The ball of stylus {} ({:g} mm) does not enter a hole of {:g} mm.",
                            stylus.value("id", std::string("?")), 2.0 * radius.get<double>(), *diameter));
    }
  }
}

void checkBalls(const nlohmann::json& artefact, Checker& check) {
  const nlohmann::json list = artefact.value("balls", nlohmann::json::array());
  if (!list.is_array() || list.empty()) {
    check.add("balls", -1, -1, "The artefact has no balls; allowed: one or more, four to separate its errors.");
    return;
  }
  std::set<std::string> names;
  std::vector<std::optional<std::array<double, 3>>> centres;
  std::vector<double> diameters;
  double largest = 0.0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const nlohmann::json& ball = list[i];
    const int row = static_cast<int>(i);
    const std::string what = fmt::format("Ball {}", i + 1);
    check.name(ball.value("id", nlohmann::json()), what, "balls", row, 0, names);
    diameters.push_back(check
                            .number(ball.value("diameter_mm", nlohmann::json()), "The diameter of " + what, "balls",
                                    row, 1, 1e-3, 1000.0, "mm")
                            .value_or(0.0));
    centres.push_back(check.vector(ball.value("certified_mm", nlohmann::json()), "The calibrated position of " + what,
                                   "balls", row, 2));
    if (!centres.back()) continue;
    if (i == 0 && std::hypot((*centres[0])[0], (*centres[0])[1], (*centres[0])[2]) > 1e-9) {
      check.add("balls", row, 2, "The first ball is the origin of the certificate; allowed: 0, 0, 0.");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (!centres[j]) continue;
      const double distance = std::hypot((*centres[i])[0] - (*centres[j])[0], (*centres[i])[1] - (*centres[j])[1],
                                         (*centres[i])[2] - (*centres[j])[2]);
      largest = std::max(largest, distance);
      if (distance < 0.5 * (diameters[i] + diameters[j])) {
        check.add(
            "balls", row, 2,
            fmt::format("Balls {} and {} are {:.4g} mm apart and run into each other; allowed: more than {:g} mm.",
                        j + 1, i + 1, distance, 0.5 * (diameters[i] + diameters[j])));
        break;
      }
    }
  }
}

}  // namespace

std::vector<ArtefactFinding> checkArtefact(const nlohmann::json& artefact, const nlohmann::json& styli) {
  Checker check(artefact);
  std::set<std::string> alone;
  check.name(artefact.value("id", nlohmann::json()), "The artefact", "id", -1, -1, alone);
  if (artefact.value("kind", "") == "hole_bar") {
    checkHoles(artefact, styli, check);
  } else {
    checkBalls(artefact, check);
  }
  const auto expansion =
      check.optional("expansion_um_per_m_K", "The expansion coefficient", artefact_expansion_range_um_per_m_K[0],
                     artefact_expansion_range_um_per_m_K[1], "um/(m·K)");
  if (expansion && *expansion != 0.0 && std::abs(*expansion) < 0.05) {
    check.add(
        "expansion_um_per_m_K", -1, -1,
        fmt::format("An expansion of {:g} µm/(m·K) is below that of any glass ceramic. Steel has 11.5, Invar 1.2.",
                    *expansion),
        false);
  }
  (void)check.optional("temperature_degC", "The temperature of the artefact", artefact_temperature_range_degC[0],
                       artefact_temperature_range_degC[1], "degC");
  const auto certificate =
      check.optional("certificate_uncertainty_um", "The uncertainty of the certificate", 0.0, unlimited, "um");
  if (certificate && *certificate > 50.0) {
    check.add("certificate_uncertainty_um", -1, -1,
              fmt::format("A certificate uncertainty of {:g} µm is implausibly large; check the unit.", *certificate),
              false);
  }
  return check.findings;
}

std::vector<ArtefactFinding> checkStyli(const nlohmann::json& styli) {
  std::vector<ArtefactFinding> all;
  std::set<std::string> names;
  for (std::size_t i = 0; i < styli.size(); ++i) {
    Checker check(styli[i]);
    const int row = static_cast<int>(i);
    const std::string what = fmt::format("Stylus {}", i + 1);
    check.name(styli[i].value("id", nlohmann::json()), what, "styli", row, 0, names);
    (void)check.number(styli[i].value("radius_mm", nlohmann::json()), "The radius of " + what, "styli", row, 1, 1e-3,
                       100.0, "mm");
    (void)check.vector(styli[i].value("offset_mm", nlohmann::json()), "The offset of " + what, "styli", row, 2);
    all.insert(all.end(), check.findings.begin(), check.findings.end());
  }
  return all;
}

}  // namespace spindrift
