// SPDX-License-Identifier: GPL-3.0-or-later
// Files of CalculiX 2.20, made by tests/data/finite_elements/make.py, and what may be wrong with such files.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/finite_elements/fe_result.h"
#include "tests/support/outside_folder.h"
#include "tests/support/refusal.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal;

const std::filesystem::path reader_data = spindrift::testing::testData() / "finite_elements";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Frd, ReadsNodesTimesAndDisplacements) {
  const auto reader = openFeResult(reader_data / "frame.frd");
  const FeMesh mesh = reader->mesh();
  EXPECT_EQ(mesh.nodes.size(), 99u);
  const std::vector<FeState> states = reader->states({7, 13});
  ASSERT_EQ(states.size(), 4u);
  EXPECT_DOUBLE_EQ(states[0].time, 900.0);
  EXPECT_DOUBLE_EQ(states[3].time, 3600.0);
  for (const NodeId id : {7L, 13L}) {
    EXPECT_LT((states[0].displacement.at(id) - 1.1e-4 * mesh.nodes.at(id)).norm(), 1e-8);
    EXPECT_LT((states[1].displacement.at(id) - 2.2e-4 * mesh.nodes.at(id)).norm(), 1e-8);
  }
  EXPECT_EQ(states[0].displacement.size(), 2u);
}

TEST(Frd, AndDatTellTheSame) {
  const auto dat = openFeResult(reader_data / "frame.dat");
  const FeMesh printed = dat->mesh();
  ASSERT_TRUE(printed.sets.contains("OBSERVED"));
  EXPECT_TRUE(printed.nodes.empty());
  const std::set<NodeId> wanted(printed.sets.at("OBSERVED").begin(), printed.sets.at("OBSERVED").end());
  EXPECT_EQ(wanted.size(), 12u);
  const auto a = dat->states(wanted);
  const auto b = openFeResult(reader_data / "frame.frd")->states(wanted);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_DOUBLE_EQ(a[k].time, b[k].time);
    for (const NodeId id : wanted) {
      EXPECT_LT((a[k].displacement.at(id) - b[k].displacement.at(id)).norm(), 1e-6);
    }
  }
}

TEST(Frd, RefusesWhatIsCutOffDamagedOrBinary) {
  const testing::TempFolder folder;
  const std::string whole = readFile(reader_data / "frame.frd");
  const auto said = [&](const std::string& text) {
    return refusal([&] {
      const auto reader = openFrd(folder.write("r.frd", text));
      (void)reader->mesh();
      (void)reader->states({1, 2, 3});
    });
  };
  EXPECT_EQ(said(whole), "");
  const std::size_t second = whole.find("  100CL  102");
  EXPECT_THAT(said(whole.substr(0, second + 1500)), HasSubstr("ends in the block of displacements at 1800"));
  EXPECT_THAT(said(whole.substr(0, 2000)), HasSubstr("ends in its block of nodes"));
  EXPECT_THAT(said(replaced(whole, " -1         2 2", " -1         2 a")), HasSubstr("line "));
  const std::string head =
      whole.substr(whole.find("    2C"), whole.find('\n', whole.find("    2C")) - whole.find("    2C"));
  EXPECT_THAT(said(replaced(whole, head, head.substr(0, head.find_last_of('1')) + "2")), HasSubstr("binary"));
  EXPECT_THAT(said("nothing\n"), HasSubstr("no block of nodes"));
  EXPECT_THAT(said(""), HasSubstr("no block of nodes"));
  std::string cold = whole;
  for (std::size_t at = cold.find("DISP "); at != std::string::npos; at = cold.find("DISP "))
    cold.replace(at, 4, "FLUX");
  EXPECT_THAT(said(cold), HasSubstr("no displacements (DISP), only FLUX and NDTEMP"));
  EXPECT_THAT(refusal([&] { (void)openFrd(folder / "none.frd")->mesh(); }), HasSubstr("cannot be read"));
  EXPECT_THAT(refusal([&] { (void)openFeResult(folder / "a.odb"); }), HasSubstr("allowed: .frd, .dat, .vtu or .pvd"));
  EXPECT_THAT(refusal([&] { (void)openFeResult(folder / "a.vtu"); }), HasSubstr("spindrift-fe"));
}

TEST(Frd, ReadsTheShortFormat) {
  const testing::TempFolder folder;
  const auto file =
      folder.write("short.frd",
                   "    1C\n    2C                             2                                     0\n"
                   " -1    1 0.00000E+00 1.00000E+02-2.00000E+02\n -1   12 1.00000E+00 1.00000E+02 3.00000E+02\n -3\n"
                   "  100CL  101-5.00000E-01           2                     0    1           0\n"
                   " -4  DISP        4    1\n -5  D1          1    2    1    0\n"
                   " -1    1-1.00000E-03-2.00000E-03-3.00000E-03\n -1   12 0.00000E+00 0.00000E+00 0.00000E+00\n -3\n");
  const auto reader = openFrd(file);
  EXPECT_EQ(reader->mesh().nodes.at(1), Eigen::Vector3d(0, 100, -200));
  const auto states = reader->states({1});
  ASSERT_EQ(states.size(), 1u);
  EXPECT_DOUBLE_EQ(states[0].time, -0.5);
  EXPECT_EQ(states[0].displacement.at(1), Eigen::Vector3d(-1e-3, -2e-3, -3e-3));
}

TEST(Dat, TakesTablesOfOneTimeTogetherAndPassesOthersOver) {
  const testing::TempFolder folder;
  const auto file = folder.write("r.dat",
                                 "\n displacements (vx,vy,vz) for set A and time  0.1000000E+01\n\n"
                                 "         1  1.0E-03  0.0E+00  0.0E+00\n"
                                 "\n temperatures for set A and time  0.1000000E+01\n\n         1  2.0E+01\n"
                                 "\n displacements (vx,vy,vz) for set b and time  0.1000000E+01\n\n"
                                 "         2  2.0E-03  0.0E+00 -1.0E-03\n"
                                 "\n displacements (vx,vy,vz) for set A and time  0.2000000E+01\n\n"
                                 "         1  3.0E-03  0.0E+00  0.0E+00\n");
  const auto reader = openDat(file);
  EXPECT_THAT(reader->mesh().sets.at("B"), ElementsAre(2));
  const auto states = reader->states({1, 2});
  ASSERT_EQ(states.size(), 2u);
  EXPECT_DOUBLE_EQ(states[0].displacement.at(2).z(), -1e-3);
  EXPECT_DOUBLE_EQ(states[1].displacement.at(1).x(), 3e-3);
  EXPECT_FALSE(states[1].displacement.contains(2));
  const auto said = [&](const std::string& text) {
    return refusal([&] { (void)openDat(folder.write("bad.dat", text))->states({1}); });
  };
  EXPECT_THAT(said(" displacements (vx,vy,vz) for set A and time  0.1E+01\n\n  1  1.0E-03  0.0E+00\n"),
              HasSubstr("line 3"));
  EXPECT_THAT(said(" displacements (vx,vy,vz) for set A and time  soon\n"), HasSubstr("no time"));
  EXPECT_THAT(said(" forces for set A and time  0.1E+01\n"), HasSubstr("no displacements"));
}

TEST(AbaqusMesh, ReadsNodesSetsRangesAndIncludes) {
  const FeMesh mesh = readAbaqusMesh(reader_data / "mesh.inp");
  EXPECT_EQ(mesh.nodes.size(), 99u);
  EXPECT_EQ(mesh.sets.at("ALL").size(), 99u);
  EXPECT_EQ(mesh.sets.at("TOOL").size(), 6u);
  EXPECT_EQ(mesh.sets.at("FIRST_TEN").size(), 10u);
  EXPECT_EQ(mesh.sets.at("BOTH").size(), 9u);
  const testing::TempFolder folder;
  folder.write("inner.inp", "*node, nset = Tip\n1, 0, 0, 5\r\n 2 , 1e2\n");
  const FeMesh outer = readAbaqusMesh(folder.write(
      "outer.inp", "*Heading\n title, with 1\n*Include, Input=inner.inp\n** note\n*NSET,NSET=two\n1,2,\n"));
  EXPECT_EQ(outer.nodes.at(2), Eigen::Vector3d(100, 0, 0));
  EXPECT_THAT(outer.sets.at("TIP"), ElementsAre(1, 2));
  EXPECT_THAT(outer.sets.at("TWO"), ElementsAre(1, 2));
  const auto said = [&](const std::string& text) {
    return refusal([&] { (void)readAbaqusMesh(folder.write("bad.inp", text)); });
  };
  EXPECT_THAT(said("*NODE\n1, 0, x, 0\n"), HasSubstr("line 2"));
  EXPECT_THAT(said("*NSET, NSET=A\n1, NONE\n"), HasSubstr("names of sets that stand above"));
  EXPECT_THAT(said("*NSET, NSET=A, GENERATE\n9, 1, 1\n"), HasSubstr("first, last, step"));
  EXPECT_THAT(said("*NSET\n1, 2\n"), HasSubstr("names no set"));
  EXPECT_THAT(said("*INCLUDE, INPUT=none.inp\n"), HasSubstr("none.inp"));
  EXPECT_THAT(said("*INCLUDE, INPUT=bad.inp\n"), HasSubstr("at most 8 files"));
}

TEST(AbaqusMesh, IncludesFilesOfItsFolder) {
  const testing::OutsideFolder outside("nodes.inp", "*NODE\n1, 0, 0, 5\n");
  for (const std::string& name : outside.names()) {
    const std::filesystem::path mesh = outside.write("mesh.inp", "*HEADING\n*INCLUDE, INPUT=" + name + "\n");
    EXPECT_THAT(refusal([&] { (void)readAbaqusMesh(mesh); }),
                AllOf(HasSubstr("mesh.inp, line 2"), HasSubstr("inside the folder")))
        << name;
  }
}

}  // namespace
}  // namespace spindrift
