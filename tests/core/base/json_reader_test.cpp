// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/json_reader.h"

#include <gmock/gmock.h>

#include <limits>

namespace spindrift {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string jsonComplaint(const std::string& text, const std::function<void(const JsonNode&)>& use = {}) {
  try {
    const JsonNode node = JsonNode::parse(text, "machine.json");
    if (use) use(node);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(JsonReader, NamesThePathAndTheValue) {
  EXPECT_THAT(jsonComplaint(R"({"axes":[{"name":"X"},{"name":5}]})",
                            [](const JsonNode& n) { (void)n.at("axes").items()[1].at("name").string(); }),
              AllOf(HasSubstr("machine.json, $.axes[1].name"), HasSubstr("5"), HasSubstr("allowed: a text")));
  EXPECT_THAT(jsonComplaint("{}", [](const JsonNode& n) { (void)n.at("chain"); }),
              HasSubstr("key \"chain\" is missing"));
  EXPECT_THAT(jsonComplaint(R"({"v":[1,2]})", [](const JsonNode& n) { (void)n.at("v").vector3(); }),
              HasSubstr("three numbers"));
  EXPECT_THAT(jsonComplaint(R"({"n":1.5})", [](const JsonNode& n) { (void)n.at("n").integer(); }),
              HasSubstr("whole number"));
  EXPECT_THAT(jsonComplaint(R"({"n":-1})", [](const JsonNode& n) { (void)n.at("n").positiveNumber(); }),
              HasSubstr("-1"));
}

TEST(JsonReader, PointsAtTheLineOfASyntaxError) {
  EXPECT_THAT(jsonComplaint("{\n \"a\": 1,\n \"b\": NaN\n}"), HasSubstr("line 3"));
  EXPECT_THAT(jsonComplaint("{\"a\": 1"), HasSubstr("not valid JSON"));
}

TEST(JsonReader, RefusesBytesThatAreNoUtf8AndSaysWhere) {
  for (const std::string bad : {"\xe4", "\xc3", "\xed\xa0\x80", "\xff"})
    for (const std::string& text : {"{\n\"a\": \"" + bad + "\"}", "{\n\"" + bad + "\": 1}", "{\n" + bad + "}"})
      EXPECT_THAT(jsonComplaint(text),
                  AllOf(HasSubstr("line 2"), HasSubstr("not valid JSON"), HasSubstr("is not UTF-8")));
  EXPECT_THAT(jsonComplaint("{\"name\": \"m\xfchle\"}"), HasSubstr("the byte 0xFC is not UTF-8 (Latin-1, perhaps)"));
}

TEST(JsonReader, RefusesADuplicateKeyAtAnyDepth) {
  EXPECT_THAT(jsonComplaint(R"({"a":1,"a":2})"), HasSubstr("\"a\" appears twice"));
  EXPECT_THAT(jsonComplaint(R"({"x":{"b":1},"y":{"b":1,"b":3}})"), HasSubstr("\"b\" appears twice"));
  EXPECT_THAT(jsonComplaint(R"({"axes":[{"name":"X"},{"name":"Y","name":"Z"}]})"), HasSubstr("$.axes[1].name"));
  EXPECT_THAT(jsonComplaint(R"({"a":[1,{"b":1e999}]})"),
              ::testing::AllOf(HasSubstr("$.a[1].b"), HasSubstr("too large")));
  EXPECT_EQ(jsonComplaint(R"({"x":{"b":1},"y":{"b":1}})"), "no complaint");
}

TEST(JsonReader, ChecksFormatAndVersion) {
  const auto check = [](const JsonNode& n) { n.requireFormat("spindrift-machine", 1); };
  EXPECT_EQ(jsonComplaint(R"({"format":"spindrift-machine","version":1,"more":true})", check), "no complaint");
  EXPECT_THAT(jsonComplaint(R"({"format":"other","version":1})", check), HasSubstr("\"other\" is not allowed"));
  EXPECT_THAT(jsonComplaint(R"({"format":"spindrift-machine","version":2})", check), HasSubstr("newer program"));
  EXPECT_THAT(jsonComplaint(R"({"format":"spindrift-machine"})", check), HasSubstr("\"version\" is missing"));
}

TEST(JsonReader, NumberThatDoesNotExistIsNull) {
  EXPECT_TRUE(jsonNumber(std::numeric_limits<double>::quiet_NaN()).is_null());
  EXPECT_TRUE(jsonNumber(std::optional<double>()).is_null());
  EXPECT_EQ(jsonNumber(0.1).dump(), "0.1");
}

}  // namespace
}  // namespace spindrift
