// SPDX-License-Identifier: GPL-3.0-or-later
// Against the broker mosquitto, started on loopback in a temporary folder.
#include "core/connect/mqtt_source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>

#include "core/connect/sparkplug.pb.h"
#include "tests/core/connect/broker.h"
#include "tests/core/connect/collected.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

void run(const std::vector<std::string>& words) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::vector<char*> pointers;
    std::vector<std::string> copy = words;
    for (std::string& word : copy) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, 1);
    ::dup2(nowhere, 2);
    ::execvp(pointers[0], pointers.data());
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << words[0] << ' ' << words[1];
}

MqttOptions optionsFor(const Broker& broker) {
  MqttOptions options;
  options.url = broker.url();
  options.answer_s = 3.0;
  return options;
}

std::unique_ptr<Source> connected(const MqttOptions& options, const std::vector<std::string>& items, Collected& sink) {
  auto source = makeMqttSource(options);
  source->connect({});
  source->subscribe(items, sink, {});
  (void)pollUntil(
      *source, sink, [] { return false; }, 0.2);  // the broker knows of it
  return source;
}

std::string payload(std::uint64_t seq, const std::vector<std::pair<std::string, double>>& named,
                    const std::vector<std::pair<std::uint64_t, double>>& by_alias = {}, int birth_number = -1) {
  sparkplug::Payload out;
  out.set_timestamp(1769846400000);
  out.set_seq(seq);
  std::uint64_t alias = 1;
  for (const auto& [name, value] : named) {
    sparkplug::Metric& metric = *out.add_metrics();
    metric.set_name(name);
    metric.set_alias(alias++);
    metric.set_datatype(10);
    metric.set_double_value(value);
    metric.mutable_properties()->add_keys("engUnit");
    metric.mutable_properties()->add_values()->set_string_value("degC");
  }
  for (const auto& [each, value] : by_alias) {
    sparkplug::Metric& metric = *out.add_metrics();
    metric.set_alias(each);
    metric.set_double_value(value);
  }
  if (birth_number >= 0) {
    sparkplug::Metric& metric = *out.add_metrics();
    metric.set_name("bdSeq");
    metric.set_datatype(4);
    metric.set_long_value(static_cast<std::uint64_t>(birth_number));
  }
  return out.SerializeAsString();
}

TEST(Mqtt, PlainValuesAndJsonAreRead) {
  Broker broker;
  Publisher peer(broker);
  peer.publish("hall/temperature", "21.5", true);
  Collected sink;
  const auto source = connected(optionsFor(broker),
                                {"hall/temperature", "umati/mill#Monitoring.Spindle[1].Speed", "umati/mill#$.State",
                                 "lcnc/pins#spindle-speed", "a/+/b"},
                                sink);
  ASSERT_EQ(sink.notes.size(), 1U);
  EXPECT_THAT(sink.notes[0], HasSubstr("wildcards"));
  ASSERT_EQ(sink.records.size(), 1U);
  EXPECT_TRUE(sink.records[0].snapshot);
  peer.publish("hall/temperature", "warm");
  peer.publish("umati/mill", R"({"Monitoring":{"Spindle":[{"Speed":1},{"Speed":600.5}]},"State":"Executing"})");
  peer.publish("umati/mill", R"({"Monitoring":{"Spindle":[]},"State":null})");
  peer.publish("umati/mill", "{broken");
  peer.publish("lcnc/pins", R"({"spindle-speed": "1200", "coolant": true})");
  ASSERT_TRUE(pollUntil(*source, sink, [&] { return !sink.values(3).empty(); }));
  EXPECT_EQ(sink.records[1].text, "warm");
  EXPECT_THAT(sink.values(1), ElementsAre(600.5));
  ASSERT_EQ(sink.values(2).size(), 2U);
  EXPECT_THAT(sink.values(3), ElementsAre(1200.0));
  EXPECT_THAT(sink.notes.back(), HasSubstr("no JSON"));
}

TEST(Mqtt, ListingShowsTopicsPathsAndBirths) {
  Broker broker;
  Publisher peer(broker);
  peer.publish("hall/temperature", "21.5", true);
  peer.publish("umati/mill", R"({"a":{"b":[1,2]}})", true);
  peer.publish("spBv1.0/G/NBIRTH/N", payload(0, {{"T/spindle", 30.0}}), true);
  peer.publish("deep", std::string(300'000, '['), true);
  const auto source = makeMqttSource(optionsFor(broker));
  source->connect({});
  std::vector<std::string> found;
  for (const DataItem& item : source->list(0.5, {})) found.push_back(item.address + " " + item.unit);
  EXPECT_THAT(found, ElementsAre("deep ", "hall/temperature ", "spBv1.0/G/N#T/spindle degC", "umati/mill#a.b[0] ",
                                 "umati/mill#a.b[1] "));
}

TEST(Mqtt, SparkplugBirthsDataGapsAndDeaths) {
  Broker broker;
  Publisher peer(broker);
  peer.listen("spBv1.0/G/NCMD/N");
  Collected sink;
  const auto source = connected(optionsFor(broker), {"spBv1.0/G/N#T", "spBv1.0/G/N/D#V"}, sink);
  peer.spin();
  ASSERT_EQ(peer.heard.size(), 1U);  // a birth is asked for
  const auto publish = [&](const std::string& kind, const std::string& text) {
    peer.publish("spBv1.0/G/" + kind, text);
    (void)pollUntil(
        *source, sink, [] { return false; }, 0.1);
  };
  publish("NDATA/N", payload(9, {}, {{1, 5.0}}));
  EXPECT_TRUE(sink.records.empty());  // an alias is nothing before the birth
  publish("NBIRTH/N", payload(0, {{"T", 20.0}}, {}, 3));
  publish("DBIRTH/N/D", payload(1, {{"", 0.0}, {"V", 1.0}}));
  publish("NDATA/N", payload(2, {}, {{1, 21.0}}));
  publish("DDATA/N/D", payload(3, {}, {{2, 2.0}}));
  EXPECT_EQ(sink.values(1), (std::vector<double>{1.0, 2.0}));
  EXPECT_THAT(sink.item_units, ElementsAre("degC", "degC"));  // as the births state them
  EXPECT_THAT(sink.missings, ::testing::IsEmpty());
  publish("NDATA/N", payload(5, {}, {{1, 99.0}}));  // 4 is missing
  ASSERT_EQ(sink.missings.size(), 1U);
  EXPECT_THAT(sink.missings[0], HasSubstr("message 5 came in place of 4"));
  publish("NDATA/N", payload(6, {}, {{1, 99.0}}));
  EXPECT_THAT(sink.values(0), Not(::testing::Contains(99.0)));
  publish("NBIRTH/N", payload(0, {{"T", 22.0}}, {}, 4));
  EXPECT_EQ(sink.values(0).back(), 22.0);
  const std::size_t before = sink.records.size();
  publish("NDEATH/N", payload(0, {}, {}, 3));  // of the connection before
  EXPECT_EQ(sink.records.size(), before);
  publish("NDEATH/N", payload(0, {}, {}, 4));
  EXPECT_EQ(sink.records.back().quality, Quality::Unavailable);
  EXPECT_EQ(sink.records.size(), before + 2);
  for (int i = 1; i <= 300; ++i) {  // seq begins anew after 255
    if (i == 1) publish("NBIRTH/N", payload(0, {{"T", 0.0}}, {}, 5));
    peer.publish("spBv1.0/G/NDATA/N", payload(static_cast<std::uint64_t>(i) % 256, {}, {{1, static_cast<double>(i)}}));
    source->poll(0.0, sink);  // or the broker would take it for dead
  }
  ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.values(0).back() == 300.0; }));
  EXPECT_EQ(sink.missings.size(), 1U);
}

TEST(Mqtt, AClientWithANameMissesNothingWhileItIsAway) {
  Broker broker;
  Publisher peer(broker);
  for (const std::string name : {"spindrift-test", ""}) {
    MqttOptions options = optionsFor(broker);
    options.client_id = name;
    Collected sink;
    const auto source = connected(options, {"n"}, sink);
    peer.publish("n", "1");
    ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.records.size() == 1; }));
    source->close();
    for (int i = 2; i <= 20; ++i) peer.publish("n", std::to_string(i));
    source->connect({});
    source->subscribe({"n"}, sink, {});
    (void)pollUntil(
        *source, sink, [&] { return sink.records.size() == 20; }, 0.5);
    EXPECT_EQ(sink.records.size(), name.empty() ? 1U : 20U);
    EXPECT_EQ(sink.missings.size(), name.empty() ? 1U : 0U);
  }
}

TEST(Mqtt, ABrokerThatIsKilledIsFoundAgainAndTheWillIsDone) {
  Broker broker;
  Collected sink;
  MqttOptions options = optionsFor(broker);
  options.will_topic = "spindrift/state";
  options.will_text = "gone";
  auto source = connected(options, {"n"}, sink);
  broker.stop();
  EXPECT_THROW((void)pollUntil(
                   *source, sink, [] { return false; }, 3.0),
               ConnectionError);
  EXPECT_THROW(source->connect({}), ConnectionError);
  broker.start();
  source->connect({});
  source->subscribe({"n"}, sink, {});
  (void)pollUntil(
      *source, sink, [] { return false; }, 0.2);
  Publisher peer(broker);
  peer.publish("n", "7");
  EXPECT_TRUE(pollUntil(*source, sink, [&] { return !sink.values().empty() && sink.values().back() == 7.0; }));
  peer.listen("spindrift/state");
  // A client that dies: its process ends without a word.
  const pid_t child = ::fork();
  if (child == 0) {
    Collected inside;
    const auto dying = connected(options, {"n"}, inside);
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(waitUntil([&] { return peer.spin(), !peer.heard.empty(); }));
  EXPECT_EQ(peer.heard.at(0), "spindrift/state");
}

TEST(Mqtt, UserAndTls) {
  const TempFolder keys;
  const std::string key = (keys / "key.pem").string(), certificate = (keys / "cert.pem").string();
  run({"openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", key, "-out", certificate, "-days", "2",
       "-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost,IP:127.0.0.1"});
  const std::string words = (keys / "words").string();
  run({"mosquitto_passwd", "-c", "-b", words, "me", "right-word"});
  Broker broker(fmt::format("cafile {0}\ncertfile {0}\nkeyfile {1}\npassword_file {2}\n", certificate, key, words));
  MqttOptions options;
  options.url = fmt::format("mqtts://localhost:{}", broker.port());
  options.user = "me";
  options.password = "wrong-word";
  options.ca_file = certificate;
  options.answer_s = 3.0;
  try {
    makeMqttSource(options)->connect({});
    FAIL() << "a wrong password was taken";
  } catch (const ConnectionError& error) {
    EXPECT_THAT(error.what(), HasSubstr("refuses"));
    EXPECT_THAT(error.what(), Not(HasSubstr("word")));
  }
  options.password = "right-word";
  makeMqttSource(options)->connect({});
  options.ca_file.clear();  // a certificate that nobody vouches for
  EXPECT_THROW(makeMqttSource(options)->connect({}), ConnectionError);
}

}  // namespace
}  // namespace spindrift::testing
