// SPDX-License-Identifier: Apache-2.0
// The plant store: machines with their history, campaigns with provenance, results, over years. SQLite (a file) or
// PostgreSQL (a server), the same tables and the same behaviour.
//
// Publishing is idempotent: a campaign is known by its machine and the fingerprint of its files, a result by its
// content; publishing again, by anybody, adds nothing. All times that order things are the server's where there is one.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/plant/plant_address.h"
#include "core/plant/plant_types.h"

namespace spindrift {

class PlantConnection;

struct PlantOpening {
  /// The most that is asked for: nothing is written as a reader, whatever the server would allow.
  PlantRole as = PlantRole::Owner;
  /// This computer's clock; tests put another one in.
  std::function<double()> clock;
};

/// Not thread-safe: one thread uses it; each thread opens its own.
class PlantStore {
 public:
  /// Makes the store's tables, or brings those of an older version to this program's. Throws InputError: no right to.
  [[nodiscard]] static PlantStore make(const PlantAddress& address, const PlantOpening& opening = {});
  /// Throws InputError (PlantUnreachable where the same may succeed later): not there, no store, a schema newer or
  /// older than this program's.
  [[nodiscard]] static PlantStore open(const PlantAddress& address, const PlantOpening& opening = {});
  /// `open`; a file of SQLite that is not there, or is of an older version, is made and migrated.
  [[nodiscard]] static PlantStore openOrMake(const PlantAddress& address, const PlantOpening& opening = {});
  PlantStore(PlantStore&&) noexcept;
  PlantStore& operator=(PlantStore&&) noexcept;
  ~PlantStore();

  [[nodiscard]] PlantRole role() const { return role_; }
  [[nodiscard]] std::string address() const;
  /// This computer's clock minus the server's (SQLite: minus the newest time in the store, where that lies ahead), s.
  [[nodiscard]] double clockOffset() const { return clock_offset_s_; }
  /// What a user should know about this connection, such as a clock that is wrong; one sentence each.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  // Writing ---------------------------------------------------------------------------------------------------------
  /// All of them or none. Throws InputError: a campaign that starts after the store's clock (by more than five
  /// minutes), not a writer, read-only.
  PublishCount publish(std::span<const PlantCampaign> campaigns);
  /// Entering the same event twice is one event. Throws InputError: no such machine, no such kind.
  void addEvent(const MachineEvent& event);
  /// How often a machine is to be measured, days; 0: not said.
  void setInterval(const std::string& machine, double every_days);

  // Reading ---------------------------------------------------------------------------------------------------------
  [[nodiscard]] std::vector<PlantMachine> machines();
  /// Throws InputError with what there is.
  [[nodiscard]] PlantMachine machine(const std::string& name);
  /// In order of machine and time; of one machine if it is named.
  [[nodiscard]] std::vector<PlantListing> campaigns(const std::string& machine = {});
  /// When the campaigns of each machine started, in order.
  [[nodiscard]] std::map<std::string, std::vector<double>> starts();
  [[nodiscard]] std::vector<MachineEvent> events(const std::string& machine);
  [[nodiscard]] std::vector<TrendName> trendNames(const std::string& machine);
  /// One value a campaign, of its newest result of the kind; with several states the last one, or `state`.
  [[nodiscard]] std::vector<TrendPoint> trend(const std::string& machine, const std::string& kind,
                                              const std::string& name, const std::string& state = {});
  [[nodiscard]] std::optional<PlantModel> newestModel(const std::string& machine);
  /// A campaign with all that is stored of it, as it was published.
  [[nodiscard]] PlantCampaign campaign(std::int64_t id);

  /// For the batches of this folder.
  [[nodiscard]] PlantConnection& connection() { return *connection_; }
  /// Throws InputError if this role is less.
  void require(PlantRole needed, std::string_view what) const;

 private:
  class Publishing;
  PlantStore(std::unique_ptr<PlantConnection> connection, const PlantOpening& opening);
  void checkVersion();
  void findRole(PlantRole at_most);
  void checkClock(const PlantOpening& opening);
  [[nodiscard]] std::int64_t machineId(const std::string& name);

  std::unique_ptr<PlantConnection> connection_;
  PlantRole role_ = PlantRole::Reader;
  double clock_offset_s_ = 0.0;
  std::vector<std::string> warnings_;
};

}  // namespace spindrift
