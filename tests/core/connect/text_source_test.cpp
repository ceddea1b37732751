// SPDX-License-Identifier: GPL-3.0-or-later
// Over a pseudo terminal.
#include "core/connect/text_source.h"

#include <gmock/gmock.h>
#include <pty.h>
#include <unistd.h>

#include <string>

#include "core/base/atomic_file.h"
#include "core/probing/touch_stream.h"
#include "tests/core/connect/collected.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Terminal {
 public:
  Terminal() {
    char name[256];
    EXPECT_EQ(::openpty(&controller_, &terminal_, name, nullptr, nullptr), 0);
    name_ = name;
  }
  ~Terminal() {
    hangUp();
    ::close(terminal_);
  }
  void print(std::string_view text) {
    EXPECT_EQ(::write(controller_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void hangUp() {
    if (controller_ >= 0) ::close(controller_);
    controller_ = -1;
  }
  [[nodiscard]] std::string url() const { return "serial://" + name_; }

 private:
  int controller_ = -1;
  int terminal_ = -1;
  std::string name_;
};

LinePattern pattern(const std::string& text) {
  return LinePattern(JsonNode::parse(nlohmann::json(text).dump(), "connections.json"));
}

TEST(Text, LinesAreReadAsTheyComeInPieces) {
  Terminal terminal;
  TextSourceOptions options;
  options.url = terminal.url();
  options.lines = {pattern("T1={column} T2={bed}"), pattern("DOOR {door}")};
  options.decimal_comma = true;
  const auto source = makeTextSource(options);
  source->connect({});
  Collected sink;
  source->subscribe({"column", "bed", "door", "absent"}, sink, {});
  ASSERT_EQ(sink.notes.size(), 1U);
  EXPECT_THAT(sink.notes[0], HasSubstr("{absent}"));
  terminal.print("T1= 21,5 T2=+2");
  (void)pollUntil(
      *source, sink, [] { return false; }, 0.1);
  EXPECT_TRUE(sink.records.empty());
  terminal.print("2.\r\nrubbish\r\nDOOR open\nT1=err T2=23.25\n");
  ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.records.size() >= 5; }));
  EXPECT_EQ(sink.values(0).at(0), 21.5);
  EXPECT_THAT(sink.values(1), ElementsAre(22.0, 23.25));
  EXPECT_EQ(sink.records[2].text, "open");
  EXPECT_EQ(sink.records[3].quality, Quality::Text);
  terminal.hangUp();
  EXPECT_THROW((void)pollUntil(
                   *source, sink, [] { return false; }, 2.0),
               ConnectionError);
}

TEST(Text, PrintedTouchesGoLiveThroughTheTemplateForFiles) {
  const TempFolder folder;
  Terminal terminal;
  TextSourceOptions options;
  options.url = terminal.url();
  options.lines = {pattern("TOUCH {n}")};
  options.save = folder / "touches.txt";
  const auto source = makeTextSource(options);
  source->connect({});
  Collected sink;
  source->subscribe({"n"}, sink, {});
  const std::string line = "TOUCH 1 A1 X10.0 Y20.0 Z-5.0 I0 J0 K-1\r\n";
  terminal.print(line + line.substr(0, 10));
  ASSERT_TRUE(waitUntil([&] {
    source->poll(0.02, sink);
    return readFile(folder / "touches.txt").size() > 10;
  }));
  const JsonNode form = JsonNode::parse(
      R"({"format":"spindrift-printed-text","version":1,"touch_line":"TOUCH {touch} A{feature} X{x} Y{y} Z{z} I{nx} J{ny} K{nz}",
         "artefact":"bar","stylus":"p0","values":{"feature":{"1":"H1"}}})",
      "template.json");
  TouchStream touches("touches.txt", MachineDescription{}, form);
  const std::string begun = readFile(folder / "touches.txt");
  EXPECT_EQ(touches.update(begun).size(), 1U);
  terminal.print(line.substr(10));
  ASSERT_TRUE(waitUntil([&] {
    source->poll(0.02, sink);
    return readFile(folder / "touches.txt").size() > line.size() + 10;
  }));
  const std::vector<Touch> more = touches.update(readFile(folder / "touches.txt").substr(begun.size()));
  ASSERT_EQ(more.size(), 1U);
  EXPECT_EQ(more[0].feature, "H1");
}

}  // namespace
}  // namespace spindrift::testing
