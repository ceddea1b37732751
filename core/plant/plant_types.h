// SPDX-License-Identifier: Apache-2.0
// What a plant store keeps of many machines over years. Raw captures stay in the sessions: the store has their address
// and SHA-256. Times are UTC seconds since 1970; parameters carry their unit in the name (um, urad, um/m) as
// everywhere.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace spindrift {

/// Each may do what those before it may. Reader: look. Writer: publish, enter events, work on batches. Owner: make the
/// store and bring its schema to a newer version, start batches.
enum class PlantRole { Reader, Writer, Owner };
[[nodiscard]] std::string_view toString(PlantRole role) noexcept;

/// One value of a result, in a thermal state or cycle.
struct PlantParameter {
  std::string state;
  std::string name;
  double value = 0.0;
  double standard_uncertainty = 0.0;
};

/// A file that a result was made from.
struct PlantCapture {
  std::string address;  ///< host and path of the session's file
  std::string sha256;
};

struct PlantResult {
  std::string kind;  ///< as in the session: "fit", "evaluate", "discrepancy", "verify", ...
  std::string program_version;
  std::string created_utc;
  std::string inputs_fingerprint;
  nlohmann::json options = nlohmann::json::object();
  std::string verdict;  ///< empty where the kind has none
  std::vector<PlantParameter> parameters;
  nlohmann::json covariance;  ///< {"order":[names],"matrix":[[..]]}; null: none
  nlohmann::json model;       ///< null: none
  /// Name of the content: the same result, published by anybody at any time, has the same key.
  [[nodiscard]] std::string key() const;
};

/// A campaign as it is published.
struct PlantCampaign {
  std::string machine;
  nlohmann::json description = nlohmann::json::object();  ///< machine.json
  std::string name;
  double start_s = 0.0;
  std::string fingerprint;  ///< of its files: the same campaign from two people is one campaign
  std::string program_version;
  std::string publisher;
  std::vector<PlantCapture> captures;
  std::vector<PlantResult> results;

  [[nodiscard]] nlohmann::json json() const;
  /// Throws InputError.
  [[nodiscard]] static PlantCampaign parse(const nlohmann::json& json, const std::string& what);
};

/// What publishing did: new in the store, or there already; of these, results that hold again in the place of later
/// ones.
struct PublishCount {
  std::size_t campaigns_new = 0;
  std::size_t campaigns_there = 0;
  std::size_t results_new = 0;
  std::size_t results_there = 0;
  std::size_t results_again = 0;
  PublishCount& operator+=(const PublishCount& other);
};

/// Something that was done to a machine or happened to it.
struct MachineEvent {
  std::string machine;
  double time_s = 0.0;
  std::string kind;  ///< one of eventKinds()
  std::string note;
  std::string author;
};
/// "spindle_changed", "re_levelled", "crash", "repair", "moved": the machine is another one afterwards, models and
/// control limits begin anew. "note": nothing of the kind.
[[nodiscard]] const std::vector<std::string>& eventKinds();
[[nodiscard]] bool changesMachine(const std::string& event_kind);
/// As people write it: "spindle changed", "re-levelled".
[[nodiscard]] std::string eventWords(const std::string& event_kind);

/// A machine with the state it was last seen in.
struct PlantMachine {
  std::int64_t id = 0;
  std::string name;
  std::size_t campaigns = 0;
  double first_s = 0.0;  ///< start of its first campaign; 0 without any
  double last_s = 0.0;
  std::string last_verdict;  ///< of the last campaign's newest result that has one
  double every_days = 0.0;   ///< how often it is to be measured; 0: not said
};

/// A campaign in a list.
struct PlantListing {
  std::int64_t id = 0;
  std::string machine;
  std::string name;
  double start_s = 0.0;
  std::string program_version;
  std::string publisher;
  std::string fingerprint;
  std::string verdict;
  int results = 0;
};

/// One point of a trend.
struct TrendPoint {
  std::int64_t campaign = 0;
  std::string campaign_name;
  double time_s = 0.0;  ///< start of the campaign
  double value = 0.0;
  double standard_uncertainty = 0.0;
};

/// A parameter that a machine has values of.
struct TrendName {
  std::string kind;
  std::string name;
  std::size_t values = 0;
};

/// The newest model of a machine.
struct PlantModel {
  std::string campaign_name;
  double time_s = 0.0;
  std::string kind;
  nlohmann::json model;
};

}  // namespace spindrift
