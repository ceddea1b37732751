// SPDX-License-Identifier: Apache-2.0
// What a batch does: one kind of work on many campaigns, or for many seeds. Each item is worked out on its own and has
// one answer (JSON); the same plan gives the same answers wherever and in whatever order its items are worked out.
//
//   {"format":"spindrift-batch","version":1,"name":"monthly","work":"discrepancy","campaigns":["a","b",..],"options":{}}
//   {"format":"spindrift-batch","version":1,"name":"study","work":"hidden_effect","seeds":[1,1000],"options":{"kind":
//    "one","strength":4}}
//
// work         items       options
// evaluate     campaigns   "scan_model"
// fit          campaigns   "state", "points"
// identify     campaigns   "output", "inputs":[..], "train":"FROM:TO", "test":"FROM:TO"
// discrepancy  campaigns   "max_effects", "accept", "reject"
// simulate     seeds       "scenario", "out" (folder; each seed makes a campaign seed-N in it, for later items)
// hidden_effect seeds      "kind":"one"|"two"|"three"|"nothing"|"outside"|"confounded", "strength"
// command      either      "run":["program","{seed}" or "{campaign}",..]: JSON on its standard output is the answer
//
// Also: "chunk" (items that are claimed at once, 1), "item_time_limit_s" (3600), "retries" (2), "lease_s" (30).
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace spindrift {

struct BatchPlan {
  std::string name;
  std::string work;
  std::vector<std::filesystem::path> campaigns;  ///< absolute
  std::uint64_t first_seed = 0;
  std::int64_t seeds = 0;
  nlohmann::json options = nlohmann::json::object();  ///< paths in it are absolute
  std::int64_t chunk = 1;
  double item_time_limit_s = 3600.0;
  int retries = 2;
  double lease_s = 30.0;

  /// Throws InputError. Relative paths are those beside the file.
  [[nodiscard]] static BatchPlan read(const std::filesystem::path& file);
  /// As json() wrote it.
  [[nodiscard]] static BatchPlan parse(const std::string& text, const std::string& what);
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::int64_t items() const;
  /// "seed 17" or the campaign's folder.
  [[nodiscard]] std::string itemName(std::int64_t item) const;
  /// Throws InputError if a file of the plan is not on this computer: then another one may work on it, this one not.
  void requireFiles() const;
};

}  // namespace spindrift
