// SPDX-License-Identifier: GPL-3.0-or-later
// Simulators in folders for temporary files, with a program whose answer is a known formula.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/simulator/simulator.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {

template <typename Work>
std::string failure(const Work& work) {
  try {
    work();
  } catch (const SimulatorFailed& error) {
    return error.what();
  }
  return "";
}

/// One sentence: it ends with a full stop and has no other one before a capital.
inline void expectOneSentence(const std::string& text) {
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(text.back(), '.') << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  for (std::size_t i = 0; i + 2 < text.size(); ++i) {
    const bool ends = text[i] == '.' && text[i + 1] == ' ' && text[i + 2] >= 'A' && text[i + 2] <= 'Z';
    EXPECT_FALSE(ends) << text;
  }
}

inline nlohmann::json parameter(const std::string& name, double value, double min, double max) {
  return {{"name", name}, {"value", value}, {"unit", "1"},        {"standard_uncertainty", 0.1},
          {"min", min},   {"max", max},     {"what", "a number"}, {"effects", nlohmann::json::array()}};
}

/// Cache and runs of this test stand in its own folder.
class SimulatorTest : public ::testing::Test {
 protected:
  SimulatorTest() {
    std::filesystem::create_directories(temp / "runs");
    setVariable("SPINDRIFT_CACHE", temp / "cache");
    setVariable("TMPDIR", temp / "runs");
  }
  ~SimulatorTest() override {
    unsetenv("SPINDRIFT_CACHE");
    unsetenv("TMPDIR");
  }
  static void setVariable(const char* name, const std::filesystem::path& value) { setenv(name, value.c_str(), 1); }

  /// Folders of runs that are still there.
  [[nodiscard]] std::size_t foldersLeft() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(temp / "runs")) count += entry.exists() ? 1 : 0;
    return count;
  }

  TempFolder temp;
};

inline Observation observation(const std::string& point, Component component, double time_s) {
  Observation o;
  o.point = point;
  o.component = component;
  o.time_s = time_s;
  o.sigma = 1.0;
  return o;
}

}  // namespace spindrift::testing
