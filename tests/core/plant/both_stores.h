// SPDX-License-Identifier: GPL-3.0-or-later
// One test over both databases: SQLite in a file, PostgreSQL on a server of its own.
#pragma once

#include <gmock/gmock.h>

#include <string>

#include "core/plant/plant_store.h"
#include "tests/core/plant/temporary_postgres.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {

class OnBothStores : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!onServer()) return;
    if (const std::string why = TemporaryPostgres::missing(); !why.empty()) GTEST_SKIP() << why;
    database_ = TemporaryPostgres::shared().freshDatabase();
  }
  [[nodiscard]] bool onServer() const { return std::string(GetParam()) == "postgresql"; }
  [[nodiscard]] std::string text(const std::string& role = "owner") const {
    return onServer() ? TemporaryPostgres::shared().address(database_, role) : (folder_ / "plant.sqlite").string();
  }
  [[nodiscard]] PlantAddress address(const std::string& role = "owner") const {
    return PlantAddress::parse(text(role));
  }
  /// With the rights of a role: those of the server, or those that the program asks for.
  [[nodiscard]] PlantStore open(PlantRole role) const {
    const char* names[] = {"reader_one", "writer_one", "owner"};
    return PlantStore::open(address(names[static_cast<int>(role)]), {.as = role});
  }
  [[nodiscard]] PlantStore make() const { return PlantStore::make(address()); }
  /// Any statement, behind the program's back.
  void sql(const std::string& statement) const {
    if (onServer())
      TemporaryPostgres::shared().sql(database_, "set search_path = plant; " + statement);
    else
      shell("sqlite3 " + text() + " \"" + statement + "\"");
  }

  TempFolder folder_;
  std::string database_;
};

/// 2026-01-01T00:00:00Z plus days.
inline double onDay(double days) {
  return 1'767'225'600.0 + 86'400.0 * days;
}

inline PlantCampaign weeklyCampaign(const std::string& machine, int week, double value = 1.0, double sigma = 0.1) {
  PlantCampaign c;
  c.machine = machine;
  c.description = {{"name", machine}};
  c.name = "week " + std::to_string(week);
  c.start_s = onDay(7.0 * week - 365.0);
  c.fingerprint = machine + "/" + std::to_string(week);
  c.program_version = SPINDRIFT_VERSION;
  c.publisher = "anna@bench";
  c.captures = {{"bench:/sessions/a/captures/" + std::to_string(week) + ".jpg", std::string(64, 'a')}};
  PlantResult r;
  r.kind = "fit";
  r.program_version = SPINDRIFT_VERSION;
  r.created_utc = "2026-01-31T08:00:00Z";
  r.inputs_fingerprint = c.fingerprint;
  r.verdict = "converged";
  r.parameters = {{"M1", "EZ_um", value, sigma}, {"M1", "EA_urad", 2.0 * value, sigma}};
  r.covariance = {{"order", {"EZ_um", "EA_urad"}}, {"matrix", {{0.01, 0.001}, {0.001, 0.01}}}};
  c.results.push_back(r);
  return c;
}

inline std::string storeName(const ::testing::TestParamInfo<const char*>& info) {
  return info.param;
}

}  // namespace spindrift::testing
