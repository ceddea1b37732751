// SPDX-License-Identifier: GPL-3.0-or-later
// Captures that arrive in a watched folder in every way they may: half-written, renamed, out of order, twice, bad.
#include "core/workflows/incoming.h"
#include "core/workflows/capture_check.h"
#include "core/workflows/capture_intake.h"
#include "core/workflows/folder_watch.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <functional>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/base/units.h"
#include "core/imaging/artwork.h"
#include "core/imaging/fiducial_captures.h"
#include "core/imaging/image.h"
#include "core/scanning/scan_evaluation.h"
#include "core/session/session.h"
#include "core/simulation/virtual_microscope.h"
#include "tests/core/probing/probing_machines.h"
#include "tests/support/arrival_costs.h"
#include "tests/support/child_process.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

/// Of a camera that is turned with the spindle by `turned_deg` and moved along X by `moved_um`.
std::string imageBytes(std::uint64_t seed, double blur_px = 1.0, double mark_level = 200.0, double turned_deg = 0.0,
                       double moved_um = 0.0, const FiducialPattern& pattern = standardPattern()) {
  MicroscopeScene scene;
  scene.width_px = 640;
  scene.height_px = 480;
  scene.map = poseAt(640, 480, 2.0, 0.1 + turned_deg * rad_per_deg, {moved_um, 0}, {319.5, 239.5});
  scene.blur_sigma_px = blur_px;
  scene.mark_level = mark_level;
  return encodePng(renderFiducial(pattern, scene, seed));
}

constexpr const char* machine_text =
    R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-(C)-t]",
"axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,200]},{"name":"Z","travel_mm":[0,150]}],
"points":[{"id":"F1","kind":"fiducial","x_mm":20,"y_mm":30,"z_mm":0},{"id":"F2","kind":"fiducial","x_mm":250,"y_mm":30,
"z_mm":0},{"id":"A1","kind":"surface","x_mm":0,"y_mm":50,"z_mm":0}]})";

/// A watched folder, a session and a clock that the test turns.
class Incoming : public ::testing::Test {
 protected:
  Incoming() : Incoming(machine_text) {}
  explicit Incoming(const std::string& machine)
      : session_(Session::create(folder_ / "session")),
        id_(session_.newCampaign("cell", "2026-01-31T08:00:00Z", machine)),
        incoming_(folder_ / "watched", {1.0, true}, 4.0) {
    std::filesystem::create_directories(folder_ / "watched");
  }
  void plan(PlannedKind kind, int states = 2) {
    PlanOptions options;
    options.kind = kind;
    options.states = states;
    storePlan(session_, id_, makePlan(campaign().machine, options));
  }
  [[nodiscard]] Campaign campaign() const { return Campaign::read(session_.campaign(id_).folder); }
  void put(const std::string& name, const std::string& bytes) {
    std::filesystem::create_directories((folder_ / "watched" / name).parent_path());
    folder_.write("watched/" + name, bytes);
  }
  /// Looks and examines until nothing is left to do, `seconds` on the clock.
  void pass(double seconds) {
    for (const double end = now_ + seconds; now_ < end; now_ += 0.5) {
      (void)incoming_.look(now_);
      while (const auto task = incoming_.next()) {
        ExaminedFile examined = examineArrival(task->file.file, task->name, task->file.written_ns,
                                               *intake_.context(campaign(), storedPlan(session_, id_)));
        ExaminedFile kept = examined;
        const IncomingItem& item = incoming_.finish(*task, std::move(examined), now_);
        if (item.state == IncomingState::Waiting) continue;
        recordArrival(session_, id_, kept);
        kept.item = item;
        intake_.show(item);
        intake_.remember(kept);
      }
    }
  }
  [[nodiscard]] IncomingItem item(const std::string& name) const {
    for (const IncomingItem& i : incoming_.items()) {
      if (i.name == name) return i;
    }
    ADD_FAILURE() << name << " is not in the list";
    return {};
  }
  [[nodiscard]] std::vector<FiducialCapture> images() const {
    const auto file = campaign().captureList("fiducials.csv");
    return file ? readFiducialCaptures(*file).captures : std::vector<FiducialCapture>();
  }

  /// As a crash between the row of a list and the journal leaves it.
  void forgetJournal() {
    sqlite3* handle = nullptr;
    ASSERT_EQ(sqlite3_open((folder_ / "session/session.sqlite").c_str(), &handle), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(handle, "delete from arrival", nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(handle);
  }

  testing::TempFolder folder_;
  Session session_;
  std::int64_t id_;
  IncomingFolder incoming_;
  CaptureIntake intake_;
  double now_ = 0.0;
};

TEST_F(Incoming, AGoodImageIsAcceptedAndLiesInTheCampaign) {
  plan(PlannedKind::Image);
  put("IMG_0001.png", imageBytes(1));
  pass(3.0);
  const IncomingItem i = item("IMG_0001.png");
  EXPECT_EQ(i.state, IncomingState::Accepted) << i.sentence;
  EXPECT_EQ(i.plan_item, "M0_F1_rotation_0");
  ASSERT_EQ(images().size(), 1U);
  EXPECT_EQ(images()[0].fiducial, "F1");
  EXPECT_EQ(readFile(campaign().path(images()[0].image)), imageBytes(1));
}

TEST_F(Incoming, HalfWrittenIsWaitedForAndTakenWhenItIsComplete) {
  plan(PlannedKind::Image);
  const std::string bytes = imageBytes(2);
  put("a.png", bytes.substr(0, bytes.size() / 3));
  pass(0.5);
  EXPECT_EQ(item("a.png").state, IncomingState::Waiting);
  pass(2.0);  // it stands still for a while, as over a slow network
  EXPECT_EQ(item("a.png").state, IncomingState::Waiting) << item("a.png").sentence;
  EXPECT_NE(item("a.png").sentence.find("waiting for the rest"), std::string::npos);
  EXPECT_TRUE(images().empty());
  put("a.png", bytes);
  pass(3.0);
  EXPECT_EQ(item("a.png").state, IncomingState::Accepted) << item("a.png").sentence;
  EXPECT_EQ(images().size(), 1U);
}

TEST_F(Incoming, WhatStaysCutShortIsAskedForAgainAndKept) {
  plan(PlannedKind::Image);
  const std::string bytes = imageBytes(3);
  put("a.png", bytes.substr(0, bytes.size() / 2));
  pass(10.0);
  EXPECT_EQ(item("a.png").state, IncomingState::Retake);
  EXPECT_NE(item("a.png").sentence.find("a.png"), std::string::npos);
  EXPECT_EQ(readFile(campaign().path(item("a.png").stored)).size(), bytes.size() / 2);
}

TEST_F(Incoming, WorkingNamesAreLeftAloneUntilTheyAreRenamed) {
  plan(PlannedKind::Image);
  put("a.png.part", imageBytes(4).substr(0, 100));
  put(".a.png.swp", "x");
  pass(3.0);
  EXPECT_TRUE(incoming_.items().empty());
  put("a.png.part", imageBytes(4));
  std::filesystem::rename(folder_ / "watched/a.png.part", folder_ / "watched/a.png");
  pass(3.0);
  EXPECT_EQ(item("a.png").state, IncomingState::Accepted);
  // Renamed afterwards, and copied beside: the same content.
  std::filesystem::rename(folder_ / "watched/a.png", folder_ / "watched/b.png");
  put("day2/c.png", imageBytes(4));
  pass(3.0);
  EXPECT_EQ(item("b.png").state, IncomingState::Twice);
  EXPECT_NE(item("b.png").sentence.find("a.png"), std::string::npos);
  EXPECT_EQ(item("day2/c.png").state, IncomingState::Twice);
  EXPECT_EQ(images().size(), 1U);
  // Renamed before it was complete.
  put("d.png", imageBytes(5).substr(0, 50));
  pass(0.5);
  std::filesystem::rename(folder_ / "watched/d.png", folder_ / "watched/e.png");
  pass(0.5);
  EXPECT_EQ(item("d.png").state, IncomingState::Ignored);
}

TEST_F(Incoming, OutOfOrderFindsItsPlaceByNameAndByTime) {
  plan(PlannedKind::Image);
  const auto old = std::filesystem::file_time_type::clock::now() - std::chrono::minutes(20);
  put("m0_f1_x_axis_2.png", imageBytes(6));
  put("cam_M0_F1_rotation_1_.png", imageBytes(7, 1.0, 200.0, 90.0));
  pass(3.0);
  put("M0_F1_rotation_0.png", imageBytes(8));
  std::filesystem::last_write_time(folder_ / "watched/M0_F1_rotation_0.png", old);
  pass(3.0);
  const std::vector<FiducialCapture> list = images();  // the reader refuses a time that runs backwards
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0].role, CaptureRole::Rotation);
  EXPECT_EQ(list[0].index, 0);
  EXPECT_LT(list[0].time_s, list[1].time_s);
  // Again under the same name: what is there stays.
  put("again/M0_F1_rotation_0.png", imageBytes(9));
  pass(3.0);
  EXPECT_EQ(item("again/M0_F1_rotation_0.png").state, IncomingState::Twice);
  EXPECT_NE(item("again/M0_F1_rotation_0.png").sentence.find("there already"), std::string::npos);
  EXPECT_EQ(images().size(), 3U);
}

TEST_F(Incoming, BadImagesAreAskedForAgainInOneSentence) {
  plan(PlannedKind::Image);
  put("M0_F1_rotation_0.png", imageBytes(10, 9.0));
  put("M0_F1_rotation_1.png", encodePng(GrayImage(640, 480, 255)));
  put("M0_F1_rotation_2.png", encodePng(GrayImage(640, 480, 12)));
  put("notes.docx", "dear diary");
  pass(3.0);
  EXPECT_EQ(item("M0_F1_rotation_0.png").state, IncomingState::Retake) << item("M0_F1_rotation_0.png").sentence;
  EXPECT_EQ(item("M0_F1_rotation_1.png").state, IncomingState::Retake);
  EXPECT_NE(item("M0_F1_rotation_1.png").sentence.find("overexposed"), std::string::npos);
  EXPECT_NE(item("M0_F1_rotation_2.png").sentence.find("contrast"), std::string::npos);
  EXPECT_EQ(item("notes.docx").state, IncomingState::Ignored);
  EXPECT_TRUE(images().empty());
  // A blurred image belongs into a focus series, and a good one is taken the second time.
  put("M0_F1_focus_0.png", imageBytes(11, 4.0));
  put("second/M0_F1_rotation_0.png", imageBytes(12));
  pass(3.0);
  EXPECT_EQ(item("M0_F1_focus_0.png").state, IncomingState::Accepted) << item("M0_F1_focus_0.png").sentence;
  EXPECT_EQ(item("second/M0_F1_rotation_0.png").state, IncomingState::Accepted);
  EXPECT_EQ(images().size(), 2U);
}

TEST_F(Incoming, ImagesThatContradictThePlanAreAskedForAgain) {
  plan(PlannedKind::Image);
  put("M0_F1_rotation_0.png", imageBytes(20));
  pass(3.0);
  ASSERT_EQ(item("M0_F1_rotation_0.png").state, IncomingState::Accepted);
  put("M0_F1_rotation_1.png", imageBytes(21, 1.0, 200.0, 8.0));
  pass(3.0);
  EXPECT_EQ(item("M0_F1_rotation_1.png").state, IncomingState::Retake);
  EXPECT_NE(item("M0_F1_rotation_1.png").sentence.find("turned by 8°, the plan says 90°"), std::string::npos)
      << item("M0_F1_rotation_1.png").sentence;
  // A session opened again knows what it has seen, also without its journal.
  forgetJournal();
  intake_ = CaptureIntake();
  put("again/M0_F1_rotation_1.png", imageBytes(22, 1.0, 200.0, -90.0));
  pass(3.0);
  EXPECT_EQ(item("again/M0_F1_rotation_1.png").state, IncomingState::Retake);
  put("third/M0_F1_rotation_1.png", imageBytes(23, 1.0, 200.0, 90.0));
  pass(3.0);
  EXPECT_EQ(item("third/M0_F1_rotation_1.png").state, IncomingState::Accepted)
      << item("third/M0_F1_rotation_1.png").sentence;
  // Along X: the first one is believed, the second one did not move, the third one did.
  put("M0_F1_x_axis_2.png", imageBytes(24));
  pass(3.0);
  put("M0_F1_x_axis_3.png", imageBytes(25));
  put("M0_F1_x_axis_4.png", imageBytes(26, 1.0, 200.0, 0.0, 254.0));
  pass(3.0);
  EXPECT_EQ(item("M0_F1_x_axis_3.png").state, IncomingState::Retake) << item("M0_F1_x_axis_3.png").sentence;
  EXPECT_NE(item("M0_F1_x_axis_3.png").sentence.find("the plan says 127 µm"), std::string::npos);
  EXPECT_EQ(item("M0_F1_x_axis_4.png").state, IncomingState::Accepted) << item("M0_F1_x_axis_4.png").sentence;
  EXPECT_EQ(images().size(), 4U);
  // Another fiducial, where only its place tells.
  put("M0_F1_y_axis_2.png", imageBytes(27, 1.0, 200.0, 0.0, -180.0));
  pass(3.0);
  EXPECT_EQ(item("M0_F1_y_axis_2.png").state, IncomingState::Retake);
  EXPECT_NE(item("M0_F1_y_axis_2.png").sentence.find("another fiducial"), std::string::npos);
  // The check of all captures says the same of a list that was filled by other means.
  const Campaign now = campaign();
  std::string list = readFile(now.path("captures/fiducials.csv"));
  const std::size_t at = list.find(",90,", list.find("rotation,1"));
  ASSERT_NE(at, std::string::npos) << list;
  writeFileAtomically(now.path("captures/fiducials.csv"), list.replace(at, 4, ",180,"));
  JobContext job;
  const std::vector<CheckedCapture> checked = checkFiducialCaptures(campaign(), job);
  std::size_t bad = 0;
  for (const CheckedCapture& c : checked) {
    if (c.good) continue;
    ++bad;
    EXPECT_NE(c.image.find("rotation_1"), std::string::npos) << c.image;
    EXPECT_NE(c.sentence.find("Take again: The image is turned by 90°, the list says 180°"), std::string::npos)
        << c.sentence;
  }
  EXPECT_EQ(bad, 1U);
}

TEST_F(Incoming, ImagesOfTheCampaignsOwnPatternAreTakenAndNoOthers) {
  const FiducialPattern own =
      makePattern({.rows = 7, .columns = 7, .first_row = 31, .first_column = 51, .pitch_um = 455.0});
  writeFileAtomically(campaign().path("pattern.json"), patternJson(own));
  plan(PlannedKind::Image);
  put("a.png", imageBytes(1));
  pass(3.0);
  EXPECT_EQ(item("a.png").state, IncomingState::Retake) << item("a.png").sentence;
  put("b.png", imageBytes(2, 1.0, 200.0, 0.0, 0.0, own));
  pass(3.0);
  EXPECT_EQ(item("b.png").state, IncomingState::Accepted) << item("b.png").sentence;
  // From a camera, turned as the plan says and not.
  const IncomingContext context(campaign(), storedPlan(session_, id_), incomingJournal(session_, id_), false);
  const auto taken = [&](const std::string& bytes) { return examineImage(bytes, "camera 1", 0, context).item; };
  EXPECT_EQ(taken(imageBytes(3, 1.0, 200.0, 90.0, 0.0, own)).state, IncomingState::Accepted);
  EXPECT_EQ(taken(imageBytes(4, 1.0, 200.0, 20.0, 0.0, own)).state, IncomingState::Retake);
  EXPECT_EQ(taken(imageBytes(5, 1.0, 200.0, 90.0)).state, IncomingState::Retake);
  // The check of the list reads them with the same pattern.
  JobContext job;
  const std::vector<CheckedCapture> checked = checkFiducialCaptures(campaign(), job);
  ASSERT_EQ(checked.size(), 1U);
  EXPECT_TRUE(checked[0].good) << checked[0].sentence;
}

TEST_F(Incoming, ReopenedSessionsKnowWhatArrived) {
  plan(PlannedKind::Image);
  put("a.png", imageBytes(13));
  pass(3.0);
  ASSERT_EQ(images().size(), 1U);
  incoming_ = IncomingFolder(folder_ / "watched", {1.0, true}, 4.0);
  pass(3.0);
  EXPECT_EQ(item("a.png").state, IncomingState::Twice);
  EXPECT_EQ(images().size(), 1U);
  // A crash between the row and the journal: the row is not added twice.
  forgetJournal();
  incoming_ = IncomingFolder(folder_ / "watched", {1.0, true}, 4.0);
  pass(3.0);
  EXPECT_EQ(item("a.png").state, IncomingState::Twice);
  EXPECT_EQ(images().size(), 1U);
}

TEST_F(Incoming, AVanishedFolderIsASentenceAndCapturingGoesOn) {
  plan(PlannedKind::Image);
  std::filesystem::rename(folder_ / "watched", folder_ / "away");
  pass(1.0);
  EXPECT_NE(incoming_.problem().find("watched"), std::string::npos);
  std::filesystem::rename(folder_ / "away", folder_ / "watched");
  put("a.png", imageBytes(14));
  pass(3.0);
  EXPECT_TRUE(incoming_.problem().empty());
  EXPECT_EQ(item("a.png").state, IncomingState::Accepted);
}

TEST_F(Incoming, AVanishedCampaignIsNotMadeAnewAndNothingIsLost) {
  plan(PlannedKind::Image);
  const Campaign before = campaign();
  const auto context = intake_.context(before, storedPlan(session_, id_));
  const std::string touches = "time_s,cycle,artefact,feature,touch,x_mm,y_mm,z_mm,nx,ny,nz\n";
  put("a.png", imageBytes(14));
  put("touches.csv", touches);
  std::filesystem::rename(folder_ / "session", folder_ / "away");  // a disk that was pulled out
  const auto refused = [&](const std::function<ExaminedFile()>& examine) {
    try {
      (void)examine();
      ADD_FAILURE() << "it was stored nowhere";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("is not there any more"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(before.folder.string()), std::string::npos) << e.what();
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "session"));
  };
  for (const char* name : {"a.png", "touches.csv"})
    refused([&] { return examineArrival(folder_ / "watched" / name, name, 0, *context); });
  refused([&] { return examineImage(imageBytes(15), "picture 1", 0, *context); });
  // The mount point of a disk stays behind as an empty folder.
  std::filesystem::create_directories(before.folder);
  EXPECT_THROW((void)examineArrival(folder_ / "watched/a.png", "a.png", 0, *context), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(before.folder));
  std::filesystem::remove_all(folder_ / "session");

  (void)incoming_.look(now_);
  (void)incoming_.look(now_ += 2.0);
  for (int time = 0; time < 3; ++time) {  // as often as it takes
    int put_off = 0;
    while (const auto task = incoming_.next()) {
      ExaminedFile not_stored;
      not_stored.item.name = task->name;
      not_stored.item.sentence = "the folder is gone.";
      const IncomingItem& item = incoming_.finish(*task, not_stored, now_);
      EXPECT_EQ(item.state, IncomingState::Waiting);
      EXPECT_EQ(item.sentence, "the folder is gone.");
      ++put_off;
    }
    EXPECT_EQ(put_off, 2) << time;
    EXPECT_FALSE(incoming_.idle());
    (void)incoming_.look(now_ += 5.0);
  }
  std::filesystem::rename(folder_ / "away", folder_ / "session");
  pass(1.0);
  EXPECT_EQ(item("a.png").state, IncomingState::Accepted) << item("a.png").sentence;
  EXPECT_EQ(images().size(), 1U);
}

TEST_F(Incoming, ScansAreCompleteOrTakenAgain) {
  plan(PlannedKind::Scan, 3);
  const auto cloud = [](int profiles, double lift) {
    std::string text = "x_mm,y_mm,z_mm\n";
    for (int j = 0; j < profiles; ++j) {
      for (int i = 0; i < 40; ++i) {
        text += std::to_string(0.1 * i) + "," + std::to_string(0.1 * j) + "," +
                std::to_string(lift + 0.01 * i + 0.02 * std::sin(0.3 * j)) + "\n";
      }
    }
    return text;
  };
  put("s0.csv", cloud(60, 0.0));
  pass(3.0);
  EXPECT_EQ(item("s0.csv").state, IncomingState::Accepted) << item("s0.csv").sentence;
  put("s1.csv", cloud(30, 0.1));
  pass(8.0);
  EXPECT_EQ(item("s1.csv").state, IncomingState::Retake) << item("s1.csv").sentence;
  EXPECT_NE(item("s1.csv").sentence.find("50 %"), std::string::npos) << item("s1.csv").sentence;
  put("s1_again.csv", cloud(60, 0.1));
  pass(3.0);
  EXPECT_EQ(item("s1_again.csv").plan_item, "M1_A1");
  EXPECT_EQ(readScanList(campaign()).size(), 2U);
}

TEST_F(Incoming, TwoFilesAreTheSameOnlyIfAllOfTheirHashAgrees) {
  plan(PlannedKind::Image);
  IncomingItem before;
  before.name = "other.png";
  before.kind = IncomingKind::Image;
  const auto file = folder_.write("a.png", "no image");
  const auto examined = [&](const std::vector<IncomingItem>& journal) {
    const IncomingContext context(campaign(), storedPlan(session_, id_), journal, false);
    return examineArrival(file, "a.png", 0, context).item;
  };
  const IncomingItem first = examined({});
  EXPECT_EQ(first.hash.size(), 64U);
  before.hash = first.hash;
  EXPECT_EQ(examined({before}).state, IncomingState::Twice);
  // Eight digits, as the names of the copies carry them, are alike in one of 65,000 files.
  before.hash.replace(8, before.hash.size() - 8, before.hash.size() - 8, '0');
  EXPECT_NE(examined({before}).state, IncomingState::Twice);
}

TEST_F(Incoming, ACopyIsNeverTakenForAnother) {
  plan(PlannedKind::Image);
  const auto file = folder_.write("a.png", "no image");
  const auto examined = [&] {
    const IncomingContext context(campaign(), storedPlan(session_, id_), {}, false);
    return examineArrival(file, "a.png", 0, context).item;
  };
  const std::filesystem::path stored = campaign().folder / examined().stored;
  writeFileAtomically(stored, "on image");  // of the same length
  EXPECT_EQ(readFile(campaign().folder / examined().stored), "no image");
}

TEST_F(Incoming, NamesThatAreNoUtf8AreTakenInAndToldApart) {
  plan(PlannedKind::Image);
  // Latin-1, what stands for it, and a path of it.
  put("Pr\xFC"
      "fling.png",
      imageBytes(30));
  put("Pr\\xFC"
      "fling.png",
      imageBytes(31, 1.0, 200.0, 90.0));
  put("Tag\xE4/notes.docx", "dear diary");
  pass(3.0);
  EXPECT_EQ(item("Pr\\xFC"
                 "fling.png")
                .state,
            IncomingState::Accepted)
      << item(
             "Pr\\xFC"
             "fling.png")
             .sentence;
  EXPECT_EQ(item("Pr\\x5CxFC"
                 "fling.png")
                .state,
            IncomingState::Accepted);
  EXPECT_EQ(item("Tag\\xE4/notes.docx").state, IncomingState::Ignored);
  EXPECT_EQ(images().size(), 2U);
  EXPECT_EQ(incomingJournal(session_, id_).size(), 3U);
  session_.setSetting("note", "a sentence with \xE4");
  EXPECT_EQ(session_.setting("note"), nlohmann::json("a sentence with \xEF\xBF\xBD"));
}

TEST_F(Incoming, ListsOfTouchesAreReadFromWhereTheyEnded) {
  const std::string header = std::string(TouchFeed::header()) + "\n";
  const auto row = [](int i) { return fmt::format("{},M0,bar,H1,p0,0,{},1,2,3,1,0,0\n", 10 + i, i); };
  const auto context = [&] { return intake_.context(campaign(), {}); };
  const auto read = [&] { return examineArrival(folder_ / "watched/t.csv", "t.csv", 0, *context()); };
  intake_.expectTouches(campaign(), std::nullopt);
  put("t.csv", header + row(0));
  ExaminedFile examined = read();
  EXPECT_EQ(examined.text, header + row(0));
  EXPECT_EQ(intake_.takeTouches(examined), 1U);
  std::ofstream(folder_ / "watched/t.csv", std::ios::app) << row(1);
  examined = read();
  EXPECT_EQ(examined.text, row(1));
  EXPECT_EQ(examined.item.hash, sha256(header + row(0) + row(1)));
  EXPECT_EQ(readFile(campaign().path(examined.item.stored)), header + row(0) + row(1));
  // What was read and not taken in is read again; the copy is whole.
  examined = read();
  EXPECT_EQ(examined.text, row(1));
  EXPECT_EQ(readFile(campaign().path(examined.item.stored)), header + row(0) + row(1));
  EXPECT_EQ(intake_.takeTouches(examined), 1U);
  EXPECT_EQ(intake_.takeTouches(examined), 0U) << "taken in twice";
  // Another file of that name, and one that became shorter.
  folder_.write("other.csv", header + row(0) + row(1) + row(2));
  std::filesystem::rename(folder_ / "other.csv", folder_ / "watched/t.csv");
  examined = read();
  EXPECT_EQ(examined.from, 0U);
  EXPECT_EQ(intake_.takeTouches(examined), 1U) << "two are known";
  put("t.csv", header);
  examined = read();
  EXPECT_EQ(examined.from, 0U);
  EXPECT_EQ(examined.text, header);
  // The same name in two folders: two copies.
  put("a/t.csv", header + row(5));
  put("b/t.csv", header + row(6));
  const ExaminedFile a = examineArrival(folder_ / "watched/a/t.csv", "a/t.csv", 0, *context());
  const ExaminedFile b = examineArrival(folder_ / "watched/b/t.csv", "b/t.csv", 0, *context());
  EXPECT_NE(a.item.stored, b.item.stored);
  EXPECT_EQ(readFile(campaign().path(a.item.stored)), header + row(5));
}

TEST(FolderWatchTest, AmongManyFilesOneThatIsWrittenAgainIsNoticed) {
  const testing::FolderWithoutDisk folder;
  std::filesystem::create_directories(folder.path() / "day");
  const auto file = [&](int i) {
    return folder.path() / (i % 2 == 0 ? "day" : "") / ("f" + std::to_string(i) + ".png");
  };
  for (int i = 0; i < 2500; ++i) std::ofstream(file(i)) << "x";
  FolderWatch watch(folder.path(), {1.0, true});
  EXPECT_EQ(watch.look(0.0).size(), 2500U);
  EXPECT_EQ(watch.unsettled(), 2500U);
  EXPECT_EQ(watch.look(2.0).size(), 2500U);
  EXPECT_EQ(watch.unsettled(), 0U);
  for (double now_s = 3.0; now_s < 7.0; ++now_s) EXPECT_TRUE(watch.look(now_s).empty());
  std::ofstream(file(1234)) << "longer";
  std::size_t told = 0;
  for (double now_s = 10.0; now_s < 13.0; ++now_s) {
    for (const WatchedFile& changed : watch.look(now_s)) {
      EXPECT_EQ(changed.file, file(1234));
      ++told;
    }
  }
  EXPECT_GE(told, 1U) << "after as many looks as there are thousands";
  std::filesystem::remove(file(7));
  std::ofstream(file(9)) << "longest";
  std::filesystem::remove(file(1234));
  for (double now_s = 20.0; now_s < 30.0; now_s += 2.0) (void)watch.look(now_s);
  EXPECT_EQ(watch.look(30.0).size() + watch.unsettled(), 0U);
}

TEST(ArrivalCosts, ACaptureCostsTheSameAfterThousands) {
  const testing::FolderWithoutDisk many_folder;
  const testing::FolderWithoutDisk few_folder;
  testing::ArrivingCaptures many(many_folder.path(), 6000);
  testing::ArrivingCaptures few(few_folder.path(), 6000);
  EXPECT_LT(testing::growthBeside(many, few, 5000, 50, 19), 1.5);
}

TEST(ArrivalCosts, ATouchCostsTheSameAfterThousands) {
  const testing::FolderWithoutDisk many_folder;
  const testing::FolderWithoutDisk few_folder;
  testing::ArrivingTouches many(many_folder.path());
  testing::ArrivingTouches few(few_folder.path());
  EXPECT_LT(testing::growthBeside(many, few, 20000, 100, 19), 1.5);
}

TEST(PlanTally, CountsAsTheListsDo) {
  using namespace probing_test;
  testing::TempFolder folder;
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 3, {}, 45);
  PlanOptions options;
  options.kind = PlannedKind::Cycle;
  const PlanIndex plan(makePlan(m, options));
  Session session = Session::create(folder / "session");
  const std::int64_t id = session.newCampaign("holes", "2026-01-31T08:00:00Z", holeMachineText());
  const std::filesystem::path place = session.campaign(id).folder;
  PlanTally tally(plan, Campaign::read(place));
  TouchList list;
  for (const Touch& t : run.list.touches) {
    list.touches.push_back(t);
    tally.add(t);
    if (list.touches.size() % 40 != 0 && list.touches.size() % (run.list.touches.size() / 3) > 2) continue;
    writeFileAtomically(place / "captures/touches.csv", list.csv());
    const PlanCaptures whole = planCaptures(plan.plan(), Campaign::read(place));
    EXPECT_EQ(tally.captures().done, whole.done) << list.touches.size();
    EXPECT_EQ(tally.captures().begun, whole.begun) << list.touches.size();
  }
  EXPECT_EQ(tally.captures().done.size(), 3U);
}

TEST_F(Incoming, WithoutAPlanNothingIsLost) {
  put("a.png", imageBytes(15));
  pass(3.0);
  EXPECT_EQ(item("a.png").state, IncomingState::Ignored);
  EXPECT_NE(item("a.png").sentence.find("plan"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(campaign().path(item("a.png").stored)));
}

TEST_F(Incoming, AnEmptyFileIsToldAndNobodyWaitsForIt) {
  put("a.jpg", "");
  put("a.csv", "");
  pass(3.0);
  EXPECT_TRUE(incoming_.idle());
  EXPECT_EQ(item("a.jpg").state, IncomingState::Waiting);
  EXPECT_NE(item("a.jpg").sentence.find("It is empty"), std::string::npos);
  // When something is written after all, it is taken.
  put("a.jpg", imageBytes(1));
  pass(3.0);
  EXPECT_NE(item("a.jpg").state, IncomingState::Waiting) << item("a.jpg").sentence;
}

TEST(TouchFeedTest, ALastLineWithoutItsEndCountsWhenNothingMoreComes) {
  using namespace probing_test;
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 1, {}, 42);
  std::string text = run.list.csv();
  text.pop_back();
  TouchFeed feed(m, nullptr);
  EXPECT_EQ(feed.update("touches.csv", text, true, 0.0), run.list.touches.size() - 1);
  EXPECT_EQ(feed.finish(), 1U);
  EXPECT_EQ(feed.finish(), 0U);
  EXPECT_EQ(feed.takeFinished(true).size(), run.list.touches.size());
  // A list with the wrong separator: no touch, and it is said once.
  for (char& c : text)
    if (c == ',') c = ';';
  TouchFeed other(m, nullptr);
  EXPECT_EQ(other.update("semicolons.csv", text + "\n", true, 0.0), 0U);
  ASSERT_EQ(other.problems().size(), 1U);
  EXPECT_NE(other.problems()[0].find("semicolons"), std::string::npos) << other.problems()[0];
}

TEST(TouchFeedTest, TouchesOfAGrowingFileReachTheCampaignFeatureByFeature) {
  using namespace probing_test;
  testing::TempFolder folder;
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 2, {}, 41);
  Session session = Session::create(folder / "session");
  const std::int64_t id = session.newCampaign("holes", "2026-01-31T08:00:00Z", holeMachineText());
  const std::string text = run.list.csv();
  TouchFeed feed(m, nullptr);
  std::size_t before_end = 0;
  const auto store = [&](bool all) {
    session.addCaptureRows(id, "touches.csv", TouchFeed::header(), TouchFeed::rowsOf(feed.takeFinished(all)));
  };
  for (std::size_t at = 0; at < text.size(); at += 400) {
    before_end = feed.live().touches().size();
    feed.update("touches.csv", std::string_view(text).substr(at, 400), at == 0, 0.0);
    store(false);
  }
  store(true);
  EXPECT_GT(before_end, run.list.touches.size() - 6);
  const Campaign campaign = Campaign::read(session.campaign(id).folder);
  const TouchList there = TouchList::read(*campaign.captureList("touches.csv"));
  EXPECT_EQ(there.touches.size(), run.list.touches.size());
  // A second start with the same file brings nothing twice.
  TouchFeed second(m, &there);
  EXPECT_EQ(second.update("touches.csv", text, true, 0.0), 0U);
  EXPECT_TRUE(second.takeFinished(true).empty());
}

TEST(MeasurementPlan, ComesBackFromJsonAndCountsDown) {
  const MachineDescription m = probing_test::machineFrom(machine_text);
  PlanOptions options;
  options.states = 2;
  const MeasurementPlan plan = makePlan(m, options);
  EXPECT_EQ(plan.items.size(), 2U * 2U * (4U + 5U + 5U + 5U));
  const MeasurementPlan back = MeasurementPlan::parse(JsonNode::parse(plan.json().dump(), "plan.json"));
  EXPECT_EQ(back.json(), plan.json());
  const PlanIndex index(plan);
  EXPECT_EQ(index.ofName("x_M1_F2_FOCUS_3.png")->id, "M1_F2_focus_3");
  EXPECT_EQ(index.ofName("M1_F2_focus_33.png"), nullptr);
  PlanProgress progress = progressOf(plan, {}, 10.0);
  EXPECT_NE(progress.sentence.find("Now M0: F1, rotation 0"), std::string::npos) << progress.sentence;
  std::set<std::string> done;
  for (const PlannedItem& i : plan.items) {
    if (i.state == "M0") done.insert(i.id);
  }
  progress = progressOf(plan, done, 1700.0);
  EXPECT_DOUBLE_EQ(progress.countdown_s, 100.0);
  EXPECT_NE(progress.sentence.find("M1 begins in 1:40 min"), std::string::npos) << progress.sentence;
  for (const PlannedItem& i : plan.items) done.insert(i.id);
  EXPECT_NE(progressOf(plan, done, 0.0).sentence.find("All 76"), std::string::npos);
}

TEST(MeasurementPlan, ACycleIsCapturedWhenItsTouchesAreThere) {
  using namespace probing_test;
  testing::TempFolder folder;
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 2, {}, 42);
  PlanOptions options;
  options.kind = PlannedKind::Cycle;
  options.states = 3;
  const MeasurementPlan plan = makePlan(m, options);
  const std::size_t per_cycle = run.list.touches.size() / 2;
  EXPECT_EQ(plan.items.front().touches, static_cast<int>(per_cycle));
  Session session = Session::create(folder / "session");
  const std::int64_t id = session.newCampaign("holes", "2026-01-31T08:00:00Z", holeMachineText());
  const auto after = [&](std::size_t touches) {
    TouchList list;
    list.touches.assign(run.list.touches.begin(), run.list.touches.begin() + static_cast<std::ptrdiff_t>(touches));
    writeFileAtomically(session.campaign(id).folder / "captures/touches.csv", list.csv());
    return planCaptures(plan, Campaign::read(session.campaign(id).folder));
  };
  PlanCaptures captures = after(9);
  EXPECT_TRUE(captures.done.empty());
  PlanProgress progress = progressOf(plan, captures.done, 20.0, captures.begun);
  EXPECT_NE(progress.sentence.find("Now M0"), std::string::npos) << progress.sentence;
  EXPECT_NE(progress.sentence.find("(9 of 60 touches are there)"), std::string::npos) << progress.sentence;
  captures = after(per_cycle);
  EXPECT_EQ(captures.done.size(), 1U);
  progress = progressOf(plan, captures.done, 60.0, captures.begun);
  EXPECT_NE(progress.sentence.find("M1 begins in 29:00 min"), std::string::npos) << progress.sentence;
  // M1 arrives early.
  captures = after(per_cycle + 10);
  EXPECT_EQ(captures.done.size(), 1U);
  progress = progressOf(plan, captures.done, 60.0, captures.begun);
  EXPECT_NE(progress.sentence.find("Now M1"), std::string::npos) << progress.sentence;
  EXPECT_LE(progress.countdown_s, 0.0);
  EXPECT_EQ(after(2 * per_cycle).done.size(), 2U);
  // One touch of M0 is missing when M1 runs: M0 stays open, and M1 is what is to be done.
  TouchList shorter;
  shorter.touches.assign(run.list.touches.begin() + 1,
                         run.list.touches.begin() + static_cast<std::ptrdiff_t>(per_cycle + 10));
  writeFileAtomically(session.campaign(id).folder / "captures/touches.csv", shorter.csv());
  captures = planCaptures(plan, Campaign::read(session.campaign(id).folder));
  EXPECT_TRUE(captures.done.empty());
  EXPECT_EQ(captures.begun.size(), 2U);
  progress = progressOf(plan, captures.done, 60.0, captures.begun);
  EXPECT_NE(progress.sentence.find("Now M1"), std::string::npos) << progress.sentence;
  // A plan that does not know the number: the first cycle is complete when the next one begins.
  MeasurementPlan unknown = plan;
  for (PlannedItem& item : unknown.items) item.touches = 0;
  (void)after(9);
  EXPECT_TRUE(capturedItems(unknown, Campaign::read(session.campaign(id).folder)).empty());
  (void)after(per_cycle + 5);
  EXPECT_EQ(capturedItems(unknown, Campaign::read(session.campaign(id).folder)).size(), 1U);
  EXPECT_EQ(MeasurementPlan::parse(JsonNode::parse(plan.json().dump(), "plan.json")).json(), plan.json());
  // Balls too, wherever they stand.
  EXPECT_GT(makePlan(machineFrom(ballMachineText()), options).items.front().touches, 40);
}

TEST(CaptureIntakeTest, CountsOfTouchesAddUp) {
  using namespace probing_test;
  testing::TempFolder folder;
  const MachineDescription m = machineFrom(holeMachineText());
  const VirtualRun run = runCycles(m, 2, {}, 44);
  Session session = Session::create(folder / "session");
  const std::int64_t id = session.newCampaign("holes", "2026-01-31T08:00:00Z", holeMachineText());
  CaptureIntake intake;
  intake.expectTouches(Campaign::read(session.campaign(id).folder), std::nullopt);
  TouchList list;
  list.touches.assign(run.list.touches.begin(), run.list.touches.begin() + 74);
  ExaminedFile file;
  file.item.name = "touches.csv";
  file.text = list.csv();
  EXPECT_EQ(intake.takeTouches(file), 74U);
  const std::size_t rows = intake.takeFinished(false).size();
  EXPECT_EQ(intake.touchSentence(),
            "74 touches so far; " + std::to_string(74 - rows) + " are taken over when their feature is complete.");
  list.touches.resize(1);
  CaptureIntake one;
  one.expectTouches(Campaign::read(session.campaign(id).folder), std::nullopt);
  file.text = list.csv();
  EXPECT_EQ(one.takeTouches(file), 1U);
  EXPECT_EQ(one.touchSentence(), "1 touch so far; 1 is taken over when its feature is complete.");
}

TEST(MeasurementPlan, MistakesAreOneSentence) {
  const MachineDescription m = probing_test::machineFrom(probing_test::holeMachineText());
  EXPECT_THROW((void)makePlan(m, {}), InputError);  // no fiducials on it
  const auto failure = [](const std::string& text) {
    try {
      (void)MeasurementPlan::parse(JsonNode::parse(text, "plan.json"));
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string head = R"({"format":"spindrift-plan","version":1,"states":[{"name":"M0","due_s":0}],"items":[)";
  const std::string scan = R"({"id":"a","kind":"scan","state":"M0","due_s":0,"artefact":"A1","y_mm":5})";
  EXPECT_EQ(failure(head + scan + "]}"), "");
  EXPECT_NE(failure(head + scan + "," + scan + "]}").find("items[1].id"), std::string::npos);
  EXPECT_NE(failure(head + R"({"id":"a","kind":"walk","state":"M0","due_s":0}]})").find("walk"), std::string::npos);
  EXPECT_NE(failure(head + R"({"id":"a","kind":"cycle","state":"M7","due_s":0,"artefact":"A1"}]})").find("M7"),
            std::string::npos);
}

TEST(CaptureIntakeTest, KnowsTheFolderOfTheSessionFromItsNeighbours) {
  const testing::TempFolder folder;
  for (const char* name : {"session/campaigns/1", "session2", "watched"})
    std::filesystem::create_directories(folder / name);
  std::filesystem::create_directory_symlink(folder / "session/campaigns", folder / "link");
  EXPECT_TRUE(CaptureIntake::liesInside(folder / "session", folder / "session"));
  EXPECT_TRUE(CaptureIntake::liesInside(folder / "session/campaigns/1", folder / "session"));
  EXPECT_TRUE(CaptureIntake::liesInside(folder / "link/1", folder / "session"));
  EXPECT_FALSE(CaptureIntake::liesInside(folder / "session2", folder / "session")) << "begins with the same letters";
  EXPECT_FALSE(CaptureIntake::liesInside(folder / "watched", folder / "session"));
}

TEST(CaptureIntakeTest, RetakesVanishWhenTheyHaveBeenTakenAgain) {
  IncomingItem blurred{.name = "a.png", .state = IncomingState::Retake, .sentence = "blurred.", .plan_item = "M0_F1"};
  CaptureIntake intake({blurred});
  IncomingItem stray{.name = "b.png", .state = IncomingState::Retake, .sentence = "dark."};
  intake.show(stray);
  ASSERT_EQ(intake.retakes({}).size(), 2U);
  EXPECT_EQ(intake.retakes({})[0].what, "M0_F1");
  EXPECT_EQ(intake.retakes({})[1].what, "b.png") << "a file that belongs to no item of the plan";
  ASSERT_EQ(intake.retakes({"M0_F1"}).size(), 1U);
  stray.state = IncomingState::Ignored;
  intake.show(stray);
  EXPECT_EQ(intake.items().size(), 2U) << "the same file has one line";
  EXPECT_TRUE(intake.retakes({"M0_F1"}).empty());
  EXPECT_TRUE(intake.takeFinished(true).empty()) << "no touches are expected";
  EXPECT_EQ(intake.touchCount(), 0U);
}

/// A grey image of which the header is there and all pixels are zero.
std::string largeImage() {
  return "P5\n9000 11000\n255\n" + std::string(99'000'000, '\0');
}

TEST_F(Incoming, AnImageThatTheMemoryCannotHoldCostsItselfAndNotTheCheck) {
  plan(PlannedKind::Image);
  put("a.png", imageBytes(1));
  pass(3.0);
  put("b.png", imageBytes(2, 1.0, 200.0, 90.0));
  pass(3.0);
  const std::vector<FiducialCapture> there = images();
  ASSERT_EQ(there.size(), 2U);
  writeFileAtomically(campaign().path(there[0].image), largeImage());
  const Campaign now = campaign();
  const std::string answer = testing::inChildProcess([&] {
    if (!testing::limitMemory(240'000'000)) return std::string("no limit");
    std::string text;
    JobContext job;
    for (const CheckedCapture& c : checkFiducialCaptures(now, job)) text += c.good ? "good; " : c.sentence + "; ";
    return text;
  });
  if (answer == "no limit") GTEST_SKIP() << "the sanitizer takes more address space than any limit";
  EXPECT_EQ(answer, "There is not enough memory to read it.; good; ");
}

TEST_F(Incoming, APictureThatTheMemoryCannotHoldIsOneSentence) {
  plan(PlannedKind::Image);
  const std::string large = largeImage();
  const IncomingContext context(campaign(), storedPlan(session_, id_), {}, false);
  const std::string answer = testing::inChildProcess([&] {
    if (!testing::limitMemory(120'000'000)) return std::string("no limit");
    const ExaminedFile examined = examineImage(large, "camera 1", 0, context);
    return toString(examined.item.state) + ": " + examined.item.sentence;
  });
  if (answer == "no limit") GTEST_SKIP() << "the sanitizer takes more address space than any limit";
  EXPECT_EQ(answer, "take again: There is not enough memory to read it.");
}

}  // namespace
}  // namespace spindrift
