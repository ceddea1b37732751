// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/connect/connections.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "core/connect/unit_conversion.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

nlohmann::json good() {
  return nlohmann::json::parse(R"({"format":"spindrift-connections","version":1,
    "sources":[{"name":"mill","kind":"mtconnect","url":"http://127.0.0.1:5000"}],
    "columns":[{"column":"T_spindle_degC","source":"mill","item":"T1","unit":"FAHRENHEIT","role":"spindle_housing"},
               {"column":"feed_x_mm_min","source":"mill","item":"Fx","dead_band":5},
               {"column":"coolant","source":"mill","item":"cool","values":{"ON":1,"OFF":0},"otherwise":0}],
    "interval_s":0.5,"longest_s":30})");
}

TEST(Connections, AreReadWithTheDefaultsOfEachColumn) {
  const TempFolder folder;
  const Connections read = Connections::read(folder.write("c.json", good().dump()));
  ASSERT_EQ(read.sources.size(), 1U);
  ASSERT_EQ(read.columns.size(), 3U);
  EXPECT_EQ(read.columns[0].reduction, Reduction::Mean);
  EXPECT_EQ(read.columns[1].reduction, Reduction::MeanAbsolute);
  EXPECT_EQ(read.columns[2].reduction, Reduction::Last);
  EXPECT_EQ(read.columns[2].item, 2U);
  EXPECT_EQ(read.columns[2].values.at("ON"), 1.0);
  EXPECT_EQ(read.itemsOf(0), (std::vector<std::string>{"T1", "Fx", "cool"}));
  EXPECT_EQ(read.interval_s, 0.5);
}

struct Fault {
  const char* pointer;
  nlohmann::json value;
  std::vector<std::string> parts;
};

TEST(Connections, EveryFaultIsOneSentenceWithItsPlace) {
  const TempFolder folder;
  const std::vector<Fault> faults{
      {"/format", "other", {"$.format", "spindrift-connections"}},
      {"/sources", nlohmann::json::array(), {"$.sources", "at least one source"}},
      {"/sources/0/kind", "opcua", {"$.sources[0].kind", "opcua", "mtconnect", "mqtt"}},
      {"/sources/0/url", "ftp://x", {"$.sources[0].url", "ftp://x", "http://"}},
      {"/sources/0/url", "http://me:word@x", {"$.sources[0].url", "password_env"}},
      {"/sources/0/password", "word", {"$.sources[0].password", "password_file"}},
      {"/sources/1", good()["sources"][0], {"$.sources[1].name", "mill", "no other source"}},
      {"/columns/0/source", "lathe", {"$.columns[0].source", "lathe", "mill"}},
      {"/columns/0/column", "time_s", {"$.columns[0].column", "time_s"}},
      {"/columns/0/column", "a,b", {"$.columns[0].column", "commas"}},
      {"/columns/1/column", "T_spindle_degC", {"$.columns[1].column", "mapped twice"}},
      {"/columns/0/unit", "MILLIMETER", {"$.columns[0].unit", "MILLIMETER", "degC"}},
      {"/columns/0/unit", "bananas", {"$.columns[0].unit", "bananas"}},
      {"/columns/0/role", "nose", {"$.columns[0].role", "nose"}},
      {"/columns/2/role", "room", {"$.columns[2].role", "T_<name>_degC"}},
      {"/columns/1/dead_band", -1, {"$.columns[1].dead_band", "-1"}},
      {"/columns/1/reduce", "median", {"$.columns[1].reduce", "median", "mean"}},
      {"/columns/2/values/ON", "yes", {"$.columns[2].values.ON", "a number"}},
      {"/interval_s", 0, {"$.interval_s", "greater than zero"}}};
  for (const Fault& fault : faults) {
    nlohmann::json spoilt = good();
    spoilt[nlohmann::json::json_pointer(fault.pointer)] = fault.value;
    const std::filesystem::path file = folder.write("c.json", spoilt.dump());
    const std::string said = refusal([&] { (void)Connections::read(file); });
    EXPECT_THAT(said, HasSubstr("c.json")) << fault.pointer;
    EXPECT_THAT(said, Not(HasSubstr("word@"))) << said;
    EXPECT_THAT(said, Not(HasSubstr("\n")));
    for (const std::string& part : fault.parts) EXPECT_THAT(said, HasSubstr(part)) << fault.pointer;
  }
}

TEST(Connections, SecretsComeFromTheEnvironmentOrFromAFileOfTheUserOnly) {
  const TempFolder folder;
  nlohmann::json json = good();
  json["sources"][0] = {{"name", "mill"}, {"kind", "mqtt"}, {"url", "mqtts://broker"}, {"user", "me"}};
  json["sources"][0]["password_env"] = "SPINDRIFT_TEST_WORD";
  const auto said = [&] { return refusal([&] { (void)Connections::read(folder.write("c.json", json.dump())); }); };
  ::unsetenv("SPINDRIFT_TEST_WORD");
  EXPECT_THAT(said(), AllOf(HasSubstr("$.sources[0].password_env"), HasSubstr("is set in the environment")));
  ::setenv("SPINDRIFT_TEST_WORD", "very-secret", 1);
  EXPECT_EQ(said(), "");
  json["sources"][0].erase("password_env");
  const std::filesystem::path word = folder.write("word", "very-secret\n");
  json["sources"][0]["password_file"] = word.string();
  std::filesystem::permissions(word, std::filesystem::perms(0644));
  EXPECT_THAT(said(), AllOf(HasSubstr("$.sources[0].password_file"), HasSubstr("chmod 600"), Not(HasSubstr("very"))));
  std::filesystem::permissions(word, std::filesystem::perms(0600));
  EXPECT_EQ(said(), "");
}

TEST(Connections, APasswordInPlaceOfTheNameOfItsVariableIsRefusedUnseen) {
  nlohmann::json json = good();
  json["sources"][0] = {{"name", "mill"}, {"kind", "mqtt"}, {"url", "mqtts://broker"}, {"user", "me"}};
  const auto said = [&](const std::string& name) {
    json["sources"][0]["password_env"] = name;
    return refusal([&] { (void)Connections::parse(JsonNode::parse(json.dump(), "c.json")); });
  };
  for (const char* word : {"s3cret!", "correct horse", "hunter2", "9LIVES", "pass-word", "gehe\xc3\xafm"})
    EXPECT_THAT(said(word), AllOf(HasSubstr("$.sources[0].password_env"), HasSubstr("HALL_PASSWORD"),
                                  HasSubstr("password itself"), Not(HasSubstr(word))));
  ::unsetenv("SPINDRIFT_test_word");
  EXPECT_EQ(said("HALL_PASSWORD"), "");  // need not be set where connections are put together
  EXPECT_NE(said("SPINDRIFT_test_word"), "");
  ::setenv("SPINDRIFT_test_word", "x", 1);
  EXPECT_EQ(said("SPINDRIFT_test_word"), "");
  ::unsetenv("SPINDRIFT_test_word");
}

TEST(Connections, RegistersAndLinesAreCheckedWhenTheFileIsRead) {
  const TempFolder folder;
  nlohmann::json json = good();
  json["sources"][0] = {{"name", "mill"}, {"kind", "modbus"}, {"url", "modbus://127.0.0.1"}};
  json["columns"] = {{{"column", "T_a_degC"}, {"source", "mill"}, {"item", "input:3:float64"}}};
  const auto said = [&] { return refusal([&] { (void)Connections::read(folder.write("c.json", json.dump())); }); };
  EXPECT_THAT(said(), AllOf(HasSubstr("$.columns[0].item"), HasSubstr("input:3:float64"), HasSubstr("float32")));
  json["columns"][0]["item"] = "input:3:float32:cdab";
  EXPECT_EQ(said(), "");
  json["sources"][0] = {{"name", "mill"}, {"kind", "text"}, {"url", "serial:///dev/ttyS0"}};
  EXPECT_THAT(said(), HasSubstr("line"));
  json["sources"][0]["line"] = "T={a";
  EXPECT_THAT(said(), AllOf(HasSubstr("$.sources[0].line"), HasSubstr("every {")));
  json["sources"][0]["line"] = {"T={a}", "U={b}"};
  EXPECT_EQ(said(), "");
}

TEST(Connections, UnitsBecomeThoseOfTheColumn) {
  const auto at = [](const char* column, const char* unit, double value) {
    const auto c = conversionInto(column, unit);
    return c ? c->scale * value + c->offset : -1e9;
  };
  EXPECT_NEAR(at("T_a_degC", "FAHRENHEIT", 212.0), 100.0, 1e-9);
  EXPECT_NEAR(at("T_a_degC", "KELVIN", 300.0), 26.85, 1e-9);
  EXPECT_NEAR(at("feed_x_mm_min", "MILLIMETER/SECOND", 2.0), 120.0, 1e-9);
  EXPECT_NEAR(at("pos_x_mm", "MILLIMETER_3D", 2.0), 2.0, 1e-9);
  EXPECT_NEAR(at("probe_um", "inch", 1e-3), 25.4, 1e-9);
  EXPECT_NEAR(at("tilt_urad", "DEGREE", 1.0), 17453.2925, 1e-3);
  EXPECT_NEAR(at("speed_c_rpm", "REVOLUTION/SECOND", 2.0), 120.0, 1e-9);
  EXPECT_NEAR(at("T_a_degF", "CELSIUS", 100.0), 212.0, 1e-9);
  EXPECT_NEAR(at("T_head_K", "CELSIUS", 25.0), 298.15, 1e-9);
  EXPECT_NEAR(at("probe_nm", "MICROMETER", 0.3), 300.0, 1e-9);
  EXPECT_NEAR(at("tilt_mrad", "urad", 300.0), 0.3, 1e-9);
  EXPECT_NEAR(at("feed_x_m_min", "MILLIMETER/MINUTE", 300.0), 0.3, 1e-9);
  EXPECT_EQ(at("whatever", "CELSIUS", 3.0), 3.0);
  EXPECT_EQ(at("pos_x_mm", "CELSIUS", 3.0), -1e9);
  EXPECT_NEAR(at("pos_x_mm", "MICRON", 250.0), 0.25, 1e-12);
  EXPECT_NEAR(at("feed_x_mm_min", "FEET/MINUTE", 2.0), 609.6, 1e-9);
  EXPECT_NEAR(at("T_a_degC", "DEGREE_FAHRENHEIT", 212.0), 100.0, 1e-9);
  // A unit that is stated and not known is none; of a column without a unit any will do.
  EXPECT_EQ(at("pos_x_mm", "CUBIT", 3.0), -1e9);
  EXPECT_EQ(at("coolant", "CUBIT", 3.0), 3.0);
  EXPECT_EQ(at("pos_x_mm", "", 3.0), 3.0);
  EXPECT_EQ(unitOfColumn("feed_x_mm_min"), "mm_min");
  EXPECT_EQ(unitOfColumn("T_room_degC"), "degC");
  EXPECT_EQ(unitOfColumn("coolant"), "");
}

TEST(Connections, AnAddressTellsItsKind) {
  EXPECT_EQ(sourceForAddress("http://127.0.0.1:5000").kind, "mtconnect");
  EXPECT_THAT(refusal([] { (void)sourceForAddress("ftp://x"); }), AllOf(HasSubstr("ftp://x"), HasSubstr("http://")));
  EXPECT_THAT(refusal([] { (void)sourceForAddress("http://a:secret@x"); }),
              AllOf(HasSubstr("password"), Not(HasSubstr("secret@"))));
}

}  // namespace
}  // namespace spindrift::testing
