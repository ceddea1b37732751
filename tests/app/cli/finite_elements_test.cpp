// SPDX-License-Identifier: GPL-3.0-or-later
// Results of finite elements as simulations: imported into simulation.csv, and straight from campaign.json.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/random.h"
#include "core/base/text.h"
#include "tests/app/cli/child_process.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path data = testData() / "finite_elements";

std::vector<std::string> import(const std::string& result, const std::filesystem::path& out,
                                const std::vector<std::string>& more) {
  std::vector<std::string> words{"simulation", "import", (data / result).string(), "--out", out.string()};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string predicted(const std::filesystem::path& table, const std::string& key) {
  for (const std::string& line : linesOf(table)) {
    if (line.starts_with(key + ",")) return line.substr(key.size() + 1);
  }
  return "none";
}

TEST(ImportFiniteElements, WritesToolMinusTable) {
  const TempFolder folder;
  const std::string mesh = (data / "mesh.inp").string();
  const auto out = folder / "simulation.csv";
  for (const char* result : {"frame.frd", "frame.dat"}) {
    std::filesystem::remove(out);
    const nlohmann::json json = jsonOf(
        import(result, out, {"--mesh", mesh, "--unit", "mm", "--tool", "P1=TOOL", "--table", "TABLE", "--first", "0"}));
    EXPECT_EQ(json["states"], 4);
    EXPECT_EQ(json["rows"], 15);
    EXPECT_EQ(json["plausible"], true);
    EXPECT_EQ(linesOf(out).front(), "time_s,point,component,predicted");
    EXPECT_EQ(predicted(out, "0,P1,EZ"), "0");
    EXPECT_NEAR(std::stod(predicted(out, "900,P1,EZ")), 33.0, 1e-2);
    EXPECT_NEAR(std::stod(predicted(out, "2700,P1,EY")), -30.0, 1e-2);
  }
  const nlohmann::json placed = jsonOf(import(
      "frame.frd", out, {"--mesh", mesh, "--unit", "mm", "--tool", "TOOL", "--table", "TABLE", "--each-table-node"}));
  EXPECT_EQ(placed["rows"], 72);
  EXPECT_EQ(linesOf(out).front(), "time_s,x_mm,y_mm,z_mm,component,predicted");
}

TEST(ImportFiniteElements, ReadsAMap) {
  const TempFolder folder;
  for (const char* file : {"frame.frd", "mesh.inp"}) std::filesystem::copy_file(data / file, folder / file);
  const auto map =
      folder.write("fe.json", R"({"format":"spindrift-finite-elements","version":1,"unit_of_displacement":"mm",
    "result":"frame.frd","mesh":"mesh.inp",
    "components":["EA"],"points":[{"point":"P1","tool":{"set":"TOOL"},"table":{"set":"TABLE"}}]})");
  const auto out = folder / "simulation.csv";
  EXPECT_EQ(jsonOf({"simulation", "import", "--map", map.string(), "--out", out.string()})["rows"], 4);
  EXPECT_LT(std::stod(predicted(out, "3600,P1,EA")), -20.0);
}

TEST(ImportFiniteElements, SaysWhatIsWrong) {
  const TempFolder folder;
  const auto out = folder / "s.csv";
  const std::string mesh = (data / "mesh.inp").string();
  expectBadInput(import("frame.frd", out, {"--mesh", mesh, "--tool", "P1=TOOL", "--table", "TABLE"}), {"--unit mm"});
  expectBadInput(import("frame.frd", out, {"--mesh", mesh, "--unit", "mm", "--tool", "P1=TIP", "--table", "TABLE"}),
                 {"no set of nodes \"TIP\"", "EDGE", "TOOL"});
  expectBadInput(import("frame.frd", out, {"--unit", "mm", "--tool", "TOOL", "--table", "TABLE"}), {"P1=NODES"});
  expectBadInput(import("frame.frd", out, {"--unit", "mm", "--tool", "P1=TOOL"}), {"--table"});
  expectBadInput(import("frame.frd", out, {"--unit", "mm", "--tool", "P1=near:1,2", "--table", "nodes:1"}),
                 {"near:x,y,z"});
  expectBadInput(import("none.frd", out, {"--unit", "mm", "--tool", "P1=nodes:1", "--table", "nodes:2"}), {"none.frd"});
  EXPECT_FALSE(std::filesystem::exists(out));
  // A wrong unit is no refusal, and is not passed over.
  const Outcome metres =
      runCli(import("frame.frd", out, {"--mesh", mesh, "--unit", "m", "--tool", "P1=TOOL", "--table", "TABLE"}));
  EXPECT_EQ(metres.status, 1);
  EXPECT_THAT(metres.error + metres.output, HasSubstr("is it in mm?"));
}

/// A campaign at three points of the frame, its simulation straight from the result; sigma 0.5 um.
std::filesystem::path writeCampaign(const TempFolder& folder, double until_s) {
  const auto campaign = folder / "campaign";
  std::filesystem::create_directories(campaign);
  for (const char* file : {"frame.frd", "mesh.inp"}) std::filesystem::copy(data / file, campaign / file);
  writeText(
      campaign / "campaign.json",
      R"({"format":"spindrift-campaign","version":1,"name":"c","start_utc":"2026-01-31T08:00:00Z","simulation":"fe.json"})");
  writeText(campaign / "fe.json",
            R"({"format":"spindrift-finite-elements","version":1,"unit_of_displacement":"mm","result":"frame.frd",
            "mesh":"mesh.inp","first_state_s":0,"points":[{"point":"P1","tool":{"set":"TOOL"},"table":{"set":"TABLE"}}]})");
  writeText(campaign / "machine.json",
            R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",
            "axes":[{"name":"X","travel_mm":[0,400]},{"name":"Y","travel_mm":[0,400]},{"name":"Z","travel_mm":[0,400]}],
            "temperature_sensors":[{"name":"T_1_degC","role":"room"}],
            "points":[{"id":"P1","x_mm":100,"y_mm":150,"z_mm":100}]})");
  std::string log = "time_s,T_1_degC,T_Tisch_degC\n";
  for (int t = 0; t <= 7200; t += 300) log += fmt::format("{},{},{}\n", t, 20.0 + 1e-4 * t, 20.0 + 2e-4 * t);
  writeText(campaign / "log.csv", log);
  Random random(11);
  std::string rows = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";
  // EZ as simulated: 33 um at 900 s, 66 at 1800 s, 0 at 2700 s, linear between.
  const auto ez = [](double t) { return t <= 1800.0 ? 66.0 * t / 1800.0 : 66.0 * (2700.0 - t) / 900.0; };
  int state = 0;
  for (double t = 0.0; t <= until_s; t += 90.0) {
    rows += fmt::format("{},M{},P1,100,150,100,0,EZ,{},0.5,touch,fit\n", t, state++, ez(t) + random.normal(0.0, 0.5));
  }
  writeText(campaign / "observations.csv", rows);
  return campaign;
}

TEST(DiscrepancyOnFiniteElements, ComparesTheResultItself) {
  const TempFolder folder;
  const auto campaign = writeCampaign(folder, 2700.0);
  const nlohmann::json json = jsonOf({"discrepancy", campaign.string()});
  EXPECT_EQ(json["unmatched_observations"], 0);
  EXPECT_EQ(json["verdict"], "none");
  EXPECT_NEAR(json["gap"]["rms_before_um"].get<double>(), 0.5, 0.2);
  EXPECT_EQ(json["sensor_roles"]["T_1_degC"]["role"], "room");
  EXPECT_EQ(json["sensor_roles"]["T_1_degC"]["from"], "machine.json");
  EXPECT_EQ(json["sensor_roles"]["T_Tisch_degC"]["role"], "table");
  EXPECT_EQ(json["sensor_roles"]["T_Tisch_degC"]["from"], "name");
  EXPECT_THAT(runCli({"discrepancy", campaign.string()}).output, HasSubstr("T_Tisch_degC table"));
}

TEST(DiscrepancyOnFiniteElements, CountsWhatLiesBeyondIt) {
  const TempFolder folder;
  // 81 observations to 7200 s, of which the result reaches 41.
  const auto campaign = writeCampaign(folder, 7200.0);
  const nlohmann::json json = jsonOf({"discrepancy", campaign.string()});
  EXPECT_EQ(json["unmatched_observations"], 40);
  EXPECT_THAT(json["warnings"].dump(), HasSubstr("40 lie before or after the rows of fe.json (0 s to 3600 s)"));
  edit(campaign / "fe.json", "\"first_state_s\":0", "\"first_state_s\":0,\"state_interval_s\":600");
  expectBadInput({"discrepancy", campaign.string()}, {"only 27 of 81", "at least half", "0 s to 2400 s"});
  edit(campaign / "fe.json", "\"set\":\"TOOL\"", "\"set\":\"TIP\"");
  expectBadInput({"discrepancy", campaign.string()}, {"fe.json", "no set of nodes \"TIP\""});
}

#ifdef SPINDRIFT_FE
TEST(ImportFiniteElements, ReadsVtkInTheProgramBesideIt) {
  const TempFolder folder;
  const auto from_vtk = folder / "vtk.csv";
  const auto from_frd = folder / "frd.csv";
  const std::vector<std::string> more{"--mesh",       (data / "mesh.inp").string(),
                                      "--unit",       "mm",
                                      "--tool",       "P1=TOOL",
                                      "--table",      "TABLE",
                                      "--components", "EX,EY,EZ,EA"};
  const nlohmann::json json = jsonOf(import("frame.pvd", from_vtk, more));
  EXPECT_EQ(json["states"], 4);
  (void)jsonOf(import("frame.frd", from_frd, more));
  const auto a = linesOf(from_vtk);
  const auto b = linesOf(from_frd);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.size(), 17u);
  for (std::size_t i = 1; i < a.size(); ++i) {
    EXPECT_EQ(a[i].substr(0, a[i].rfind(',')), b[i].substr(0, b[i].rfind(',')));
    EXPECT_NEAR(std::stod(a[i].substr(a[i].rfind(',') + 1)), std::stod(b[i].substr(b[i].rfind(',') + 1)), 1e-6);
  }
  // A set of the grid itself, and one state alone.
  const nlohmann::json one = jsonOf(import(
      "frame_2.vtu", from_vtk, {"--unit", "mm", "--tool", "P1=TOOL", "--table", "nodes:1", "--components", "EZ"}));
  EXPECT_EQ(one["states"], 1);
  EXPECT_NEAR(std::stod(predicted(from_vtk, "0,P1,EZ")), 88.0, 1e-2);
}

TEST(ImportFiniteElements, SaysWhatIsWrongWithVtk) {
  const TempFolder folder;
  const auto out = (folder / "s.csv").string();
  const std::vector<std::string> rest{"--unit", "mm", "--tool", "P1=nodes:13", "--table", "nodes:7", "--out", out};
  const auto said = [&](const std::filesystem::path& file, std::vector<std::string> more,
                        const std::vector<std::string>& parts) {
    std::vector<std::string> words{"simulation", "import", file.string()};
    words.insert(words.end(), rest.begin(), rest.end());
    words.insert(words.end(), more.begin(), more.end());
    expectBadInput(words, parts);
  };
  said(data / "frame_1.vtu", {"--displacement", "V"}, {"no point array \"V\"", "U", "TOOL"});
  said(folder / "none.vtu", {}, {"none.vtu"});
  const std::string whole = textOf(data / "frame_1.vtu");
  said(folder.write("cut.vtu", whole.substr(0, whole.size() / 2)), {}, {"cut.vtu"});
  said(folder.write("text.vtu", "not XML"), {}, {"text.vtu"});
  said(folder.write("a.pvd", "<VTKFile><Collection><DataSet file=\"a.vtu\"/></Collection></VTKFile>"), {},
       {"DataSet 1"});
  said(folder.write("b.pvd", "<VTKFile></VTKFile>"), {}, {"Collection"});
  said(folder.write("c.pvd", "<VTKFile><Collection><DataSet timestep=\"1\" file=\"no.vtu\"/></Collection></VTKFile>"),
       {}, {"no.vtu"});
}
#endif

}  // namespace
}  // namespace spindrift::testing
