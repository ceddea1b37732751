// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/observation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* header = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";

TEST(Observation, ReadsBackExactlyWhatItWrites) {
  const testing::TempFolder folder;
  ObservationSet set;
  for (int i = 0; i < 4; ++i) {
    Observation o;
    o.time_s = 0.1 * i;
    o.state = i < 2 ? "M0" : "M1";
    o.point = i % 2 == 0 ? "F1" : "F,2";
    o.position_mm = {1.0 / 3.0, 2.0, -3.0};
    o.component = i % 2 == 0 ? Component::EZ : Component::EC;
    o.value = -1.0 / 7.0 * i;
    o.sigma = 0.123456789012345;
    o.use = i == 3 ? ObservationUse::Holdout : ObservationUse::Fit;
    o.approach = {1.0, 0.0, -1.0};
    o.tool_offset_mm = {0.0, 50.0, -20.0};
    set.rows.push_back(o);
  }
  const double variance = set.rows[0].sigma * set.rows[0].sigma;
  set.setCovariances({{0, 2, 0.25 * variance}, {1, 3, -0.125 * variance}});
  set.write(folder / "o.csv");
  const ObservationSet back = ObservationSet::read(folder / "o.csv");
  ASSERT_EQ(back.rows.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(back.rows[i].value, set.rows[i].value);
    EXPECT_EQ(back.rows[i].point, set.rows[i].point);
    EXPECT_EQ(back.rows[i].position_mm, set.rows[i].position_mm);
    EXPECT_EQ(back.rows[i].component, set.rows[i].component);
    EXPECT_EQ(back.rows[i].use, set.rows[i].use);
    EXPECT_EQ(back.rows[i].approach, set.rows[i].approach);
    EXPECT_EQ(back.rows[i].tool_offset_mm, set.rows[i].tool_offset_mm);
  }
  EXPECT_EQ(back.rows[0].sigma, set.rows[0].sigma);
  EXPECT_NEAR(back.shared.covariance(0, 2), 0.25 * variance, 1e-14 * variance);
  EXPECT_NEAR(back.shared.covariance(3, 1), -0.125 * variance, 1e-14 * variance);
  EXPECT_EQ(back.shared.covariance(0, 1), 0.0);
  EXPECT_THAT(back.states(), ElementsAre("M0", "M1"));
  EXPECT_THAT(back.points(), ElementsAre("F1", "F,2"));
}

TEST(Observation, ForgetsACovarianceThatIsNoLongerTrue) {
  const testing::TempFolder folder;
  ObservationSet set;
  Observation o;
  o.point = "F1";
  o.sigma = 1.0;
  set.rows = {o, o};
  set.rows[1].time_s = 60.0;
  set.setCovariances({{0, 1, 0.5}});
  set.write(folder / "o.csv");
  EXPECT_TRUE(std::filesystem::exists(folder / "o.cov.csv"));
  set.shared.clear();
  set.write(folder / "o.csv");
  EXPECT_FALSE(std::filesystem::exists(folder / "o.cov.csv"));
}

/// Four rows of one point with these covariances in the file, read.
ObservationSet readWith(const testing::TempFolder& folder, const std::string& covariances) {
  std::string rows = header;
  for (int k = 0; k < 4; ++k)
    rows += std::to_string(60 * k) + ",M" + std::to_string(k) + ",F1,1,2,3,0,EX,1,0.5,m,fit\n";
  folder.write("c.cov.csv", "row,column,covariance\n" + covariances);
  return ObservationSet::read(folder.write("c.csv", rows));
}

std::vector<CovarianceEntry> writtenAgain(const testing::TempFolder& folder, const ObservationSet& set) {
  set.write(folder / "again.csv");
  std::vector<CovarianceEntry> entries;
  std::istringstream lines(readFile(folder / "again.cov.csv"));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    CovarianceEntry e;
    char comma = 0;
    fields >> e.row >> comma >> e.column >> comma >> e.covariance;
    entries.push_back(e);
  }
  return entries;
}

TEST(Observation, CovariancesOfAFileComeBackAsTheyWere) {
  const testing::TempFolder folder;
  // Also such that are none together (-0.2 of 0.25 in a triangle): what was stated is kept.
  for (const double c : {0.1, 1.0 / 7.0, -0.03, -0.2}) {
    const ObservationSet set = readWith(folder, fmt::format("1,2,{}\n2,1,{}\n3,2,{}\n1,3,{}\n", c, c, c, c));
    const std::vector<CovarianceEntry> entries = writtenAgain(folder, set);
    ASSERT_EQ(entries.size(), 3U) << c;
    for (const CovarianceEntry& e : entries) EXPECT_NEAR(e.covariance, c, 1e-12 * std::abs(c));
    EXPECT_EQ(entries[0].row, 1U);
    EXPECT_EQ(entries[2].column, 3U);
    for (const Observation& o : set.rows) EXPECT_EQ(o.sigma, 0.5);
  }
}

TEST(Observation, AVarianceOfTheFileReplacesSigma) {
  const testing::TempFolder folder;
  const ObservationSet set = readWith(folder, "2,2,4\n2,3,0.5\n");
  EXPECT_EQ(set.rows[1].sigma, 2.0);
  EXPECT_EQ(set.rows[2].sigma, 0.5);
  EXPECT_NEAR(set.shared.covariance(1, 2), 0.5, 1e-15);
  try {
    (void)readWith(folder, "2,2,0\n");
    FAIL() << "no variance is zero";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("variance 0 of row 2 is not allowed"));
  }
}

TEST(Observation, CovariancesThatCannotBeAreRefusedWithTheirPlace) {
  const testing::TempFolder folder;
  const auto refusal = [&](const std::string& covariances) {
    try {
      (void)readWith(folder, covariances);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal("1,3,0.1\n1,2,1.5\n"),
              HasSubstr("covariance 1.5 of rows 1 and 2 is not allowed; allowed: -0.25 to 0.25"));
  EXPECT_THAT(refusal("1,2,0.1\n2,1,-0.1\n"), HasSubstr("entry 1 gives 0.1; allowed: one value for a pair"));
  // A larger variance further down makes room for it; a pair may be given twice as one value.
  EXPECT_EQ(refusal("1,2,0.6\n2,1,0.6\n1,1,1\n2,2,1\n"), "");
}

TEST(Observation, SetsAreAppendedWithWhatTheyShare) {
  const testing::TempFolder folder;
  const ObservationSet one = readWith(folder, "1,2,0.1\n");
  ObservationSet both = one;
  both.append(one);
  ASSERT_EQ(both.rows.size(), 8U);
  EXPECT_NEAR(both.shared.covariance(4, 5), 0.1, 1e-15);
  EXPECT_EQ(both.shared.covariance(0, 4), 0.0);
}

TEST(Observation, BadRowsAreNamed) {
  const testing::TempFolder folder;
  const auto complaint = [&](const std::string& rows) -> std::string {
    try {
      (void)ObservationSet::read(folder.write("observations.csv", header + rows));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(complaint("0,M0,F1,1,2,3,0,EX,1,0.5,microscope,\n"), "accepted");
  EXPECT_THAT(complaint("0,M0,F1,1,2,3,0,EQ,1,0.5,m,fit\n"), HasSubstr("line 2, column component: component \"EQ\""));
  EXPECT_THAT(complaint("0,M0,F1,1,2,3,0,EX,1,0,m,fit\n"), HasSubstr("sigma 0 is not allowed"));
  EXPECT_THAT(complaint("0,M0,F1,1,2,3,0,EX,1,-1,m,fit\n"), HasSubstr("sigma -1"));
  EXPECT_THAT(complaint("0,M0,F1,1,2,3,0,EX,inf,1,m,fit\n"), HasSubstr("\"inf\" is not a number"));
  EXPECT_THAT(complaint("0,M0,F1,1,2,3,0,EX,1e300,1,m,fit\n"), HasSubstr("allowed: deviations up to 100000 µm"));
  EXPECT_THAT(complaint("0,M0,F1,1,2,3,0,EX,1,1,m,maybe\n"), HasSubstr("\"maybe\""));
  EXPECT_THAT(complaint("5,M0,F1,1,2,3,0,EX,1,1,m,fit\n4,M1,F1,1,2,3,0,EX,1,1,m,fit\n"), HasSubstr("runs backwards"));
  EXPECT_EQ(complaint("5,M0,F1,1,2,3,0,EX,1,1,m,fit\n4,M0,F2,1,2,3,0,EX,1,1,m,fit\n"), "accepted");
  EXPECT_THAT(complaint("5,M0,F1,1,2,3,0,EX,1,1,m,fit\n5,M0,F1,1,2,3,0,EX,2,1,m,fit\n"),
              HasSubstr("duplicate EX of point F1"));
  folder.write("observations.cov.csv", "row,column,covariance\n1,2,0.5\n");
  EXPECT_THAT(complaint("0,M0,F1,1,2,3,0,EX,1,1,m,fit\n"), HasSubstr("allowed: 1 to 1"));
}

}  // namespace
}  // namespace spindrift
