// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a whole campaign: what it tells of plan, captures, checks, standard tests and compensation.
#include "core/workflows/report_sections.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <regex>

#include "core/base/atomic_file.h"
#include "core/reporting/contact_sheet.h"
#include "core/workflows/log_campaign.h"
#include "core/workflows/report_workflow.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* machine_json =
    R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-(C)-t]","axes":[
{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,200]},{"name":"Z","travel_mm":[0,200]}]})";

class ReportSections : public ::testing::Test {
 protected:
  void SetUp() override {
    writeFileAtomically(folder_ / "campaign.json",
                        R"({"format":"spindrift-campaign","version":1,"name":"c","start_utc":"2026-01-31T08:00:00Z"})");
    writeFileAtomically(folder_ / "machine.json", machine_json);
  }
  /// The spindle runs from 0.5 h to 2.5 h of 3 h; Z grows by 30 um with a time constant of half an hour.
  void writeLog(double rpm) {
    std::string csv = "time_s,spindle_rpm,T_room_degC,Z_um\n";
    for (int i = 0; i <= 180; ++i) {
      const double t = 60.0 * i, on = std::clamp(t - 1800.0, 0.0, 7200.0);
      csv += fmt::format("{},{},{:.3f},{:.4f}\n", t, t >= 1800 && t <= 9000 ? rpm : 0.0, 20.0 + std::sin(t / 4000.0),
                         30.0 * (1.0 - std::exp(-on / 1800.0)));
    }
    writeFileAtomically(folder_ / "log.csv", csv);
  }
  std::string html(const ReportOptions& options = {}) {
    JobContext job;
    return htmlOf(reportOfCampaign(Campaign::read(folder_.path()), options, job));
  }
  testing::TempFolder folder_;
};

TEST_F(ReportSections, HasNoHeadingForWhatIsNotThere) {
  const std::string text = html();
  for (const char* heading : {"Captures", "Measurement plan", "State of the instrument", "Model over time", "ISO 230-3",
                              "Compensation", "Verification"})
    EXPECT_THAT(text, Not(HasSubstr(heading)));
}

TEST_F(ReportSections, GivesTheParametersOfTheStandardTestThatTheLogHolds) {
  writeLog(6000);
  const std::string spindle = html();
  EXPECT_THAT(spindle, HasSubstr("thermal distortion caused by the rotating spindle"));
  EXPECT_THAT(spindle, Not(HasSubstr("environmental temperature variation error")));
  // 30 um (1 - e^-2) after 60 min of running.
  std::smatch found;
  const std::string table = spindle.substr(spindle.find("Parameters of the rotating spindle test"));
  ASSERT_TRUE(std::regex_search(table, found, std::regex("Z</td><td[^>]*>([0-9.]+)")));
  EXPECT_NEAR(std::stod(found[1]), 30.0 * (1.0 - std::exp(-2.0)), 0.3);
  writeLog(0);
  EXPECT_THAT(html(), HasSubstr("environmental temperature variation error"));
  // A programme with many starts is no standard test.
  std::string csv = "time_s,spindle_rpm,T_room_degC,Z_um\n";
  for (int i = 0; i <= 180; ++i) csv += fmt::format("{},{},20,{}\n", 60 * i, i % 20 < 10 ? 6000 : 0, 0.1 * i);
  writeFileAtomically(folder_ / "log.csv", csv);
  EXPECT_THAT(html(), Not(HasSubstr("ISO 230-3")));
}

TEST_F(ReportSections, ShowsImagesAndSaysWhichCannotBeRead) {
  std::filesystem::create_directories(folder_ / "captures/images");
  cv::Mat image(200, 300, CV_8U);
  for (int r = 0; r < image.rows; ++r)
    for (int c = 0; c < image.cols; ++c) image.at<unsigned char>(r, c) = static_cast<unsigned char>((r + c) % 200);
  cv::imwrite((folder_ / "captures/images/a.png").string(), image);
  const std::string thumbnail = imageThumbnail(folder_ / "captures/images/a.png", 120);
  const cv::Mat read =
      cv::imdecode(std::vector<unsigned char>(thumbnail.begin(), thumbnail.end()), cv::IMREAD_GRAYSCALE);
  EXPECT_EQ(read.cols, 120);
  EXPECT_EQ(read.rows, 80);
  EXPECT_EQ(imageThumbnail(folder_ / "none.png"), "");
  const std::string sheet = svgOf(contactSheet({{thumbnail, "M0 <F1>", "a.png"}, {{}, "M0 F2", "b.png"}}));
  EXPECT_THAT(sheet, HasSubstr("data:image/jpeg;base64,"));
  EXPECT_THAT(sheet, HasSubstr("M0 &lt;F1&gt;"));
  EXPECT_THAT(sheet, HasSubstr("cannot be read"));
  // In its own shape also where preserveAspectRatio is not known: 120 x 80.
  std::smatch box;
  ASSERT_TRUE(std::regex_search(sheet, box, std::regex("<image [^>]*width=\"([0-9.]+)\" height=\"([0-9.]+)\"")));
  EXPECT_NEAR(std::stod(box[1]) / std::stod(box[2]), 1.5, 0.01);
}

TEST_F(ReportSections, WhatIsGoneWhenTheReportIsWrittenIsSaidInItsPlace) {
  std::filesystem::create_directories(folder_ / "captures/images");
  cv::imwrite((folder_ / "captures/images/a.png").string(), cv::Mat(60, 80, CV_8U, cv::Scalar(128)));
  const std::string columns = "time_s,state,fiducial,role,index,x_mm,y_mm,z_mm,spindle_deg,image\n";
  writeFileAtomically(folder_ / "captures/fiducials.csv", columns +
                                                              "0,M0,F1,focus,0,1,2,3,0,captures/images/a.png\n"
                                                              "1,M0,F2,focus,0,1,2,3,0,captures/images/b.png\n");
  ReportOptions options;
  options.evaluated = CampaignEvaluation();
  std::string text = html(options);
  EXPECT_THAT(text, HasSubstr("The first image of every fiducial and state"));
  EXPECT_THAT(text, HasSubstr("1 of 2 pictures left out, because missing or not readable: captures/images/b.png."));
  std::filesystem::remove(folder_ / "captures/images/a.png");
  text = html(options);
  EXPECT_THAT(text, HasSubstr("2 of 2 pictures left out, because missing or not readable: captures/images/a.png and "
                              "captures/images/b.png."));
  EXPECT_THAT(text, Not(HasSubstr("The first image of"))) << "no empty frames";
}

TEST_F(ReportSections, CloudsAreSeenFromAboveWithHolesLeftWhite) {
  std::vector<float> xyz, height;
  for (int x = 0; x < 200; ++x)
    for (int y = 0; y < 100; ++y) {
      if (x > 80 && x < 120) continue;  // a hand in the scan
      xyz.insert(xyz.end(), {static_cast<float>(x), static_cast<float>(y), 0.0F});
      height.push_back(static_cast<float>(x));
    }
  const std::string jpeg = cloudThumbnail(xyz, height, 0.0, 199.0, 200);
  const cv::Mat picture = cv::imdecode(std::vector<unsigned char>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR);
  ASSERT_EQ(picture.cols, 200);
  ASSERT_EQ(picture.rows, 100);
  const auto at = [&](int x) { return picture.at<cv::Vec3b>(50, x); };
  EXPECT_GT(at(100)[0], 240) << "the gap is white";
  EXPECT_GT(at(100)[2], 240);
  EXPECT_LT(at(10)[1], 90) << "low: the dark end of the map";
  EXPECT_GT(at(190)[1], 200) << "high: the bright end";
  EXPECT_EQ(cloudThumbnail({}, {}, 0, 1), "");
}

TEST_F(ReportSections, TellsPlanChecksCompensationAndVerification) {
  ReportOptions options;
  options.stored.warm_statement = {{"settled", true}, {"by", "operator"}};
  options.stored.repeatability = {{"passed", false}, {"reason", "EX returns within 4 µm only."}};
  options.stored.plan = nlohmann::json::parse(
      R"({"format":"spindrift-plan","version":1,"states":[{"name":"M0","due_s":0,"what":"cold"}],
          "items":[{"id":"M0_bar","kind":"cycle","state":"M0","due_s":0,"artefact":"bar"}]})");
  options.stored.compensation = nlohmann::json::parse(
      R"({"model":"Nine-parameter model of state M1 against state M0","reference":"state M0","state":"M1","time_s":3600,
          "rms_before_um":12.3,"rms_after_um":0.4,"standard_uncertainty_um":0.3,"largest_correction_um":20.5,
          "limitation":null,"warnings":[],"points":[{"point":"F1","position_mm":[0,0,0],"measured_um":[-10.0,null,2.0],
          "correction_um":[10.5,0.2,-2.0],"standard_uncertainty_um":[0.3,0.3,0.3],"remains_um":[0.5,null,0.0],
          "used":true}],"files":[{"name":"compensation_grid.csv","title":"t","convention":"added to the command"}]})");
  options.stored.verification = nlohmann::json::parse(
      R"({"verdict":"not met","reason":"EX is left with 7.0 µm; the goal is 5 µm.","goal_um":5,"goal_urad":null,
          "criterion":"largest","notes":["nothing proves it"],"points":[],"components":[{"component":"EX","unit":"um",
          "values":8,"before":{"rms":10,"rms_standard_uncertainty":0.2,"largest":20,"largest_standard_uncertainty":0.4},
          "after":{"rms":3,"rms_standard_uncertainty":0.2,"largest":7,"largest_standard_uncertainty":0.4},
          "verdict":"not met"}]})");
  const std::string text = html(options);
  EXPECT_THAT(text, HasSubstr("stated by the operator, not measured"));
  EXPECT_THAT(text, HasSubstr("EX returns within 4 µm only."));
  EXPECT_THAT(text, HasSubstr("Not captured: 1 of 1 planned item."));
  EXPECT_THAT(text, HasSubstr("12.30 µm"));
  EXPECT_THAT(text, HasSubstr("10.5 ± 0.3"));
  EXPECT_THAT(text, HasSubstr("added to the command"));
  EXPECT_THAT(text, HasSubstr("EX is left with 7.0 µm; the goal is 5 µm."));
  EXPECT_THAT(text, HasSubstr("class=\"verdict bad\""));
}

TEST_F(ReportSections, WhatDoesNotHoldAnyMoreIsSaidToBeOutdated) {
  ReportOptions options;
  options.stored.jogs = {{"passed", true}, {"reason", "EX returns within 0.2 µm."}};
  options.stored.verification = nlohmann::json::parse(
      R"({"verdict":"met","reason":"EX is left with 1.0 µm; the goal is 5 µm.","goal_um":5,"goal_urad":null,
          "criterion":"largest","components":[],"notes":[]})");
  EXPECT_THAT(html(options), Not(HasSubstr("outdated")));
  options.stored.changed = {{"verify", "1 exclusion more"}, {"check-jogs", "the machine"}};
  const std::string text = html(options);
  EXPECT_THAT(text, HasSubstr("Outdated. Changed since the calculation: 1 exclusion more."));
  EXPECT_THAT(text, HasSubstr("outdated: EX is left with 1.0 µm")) << "also on the first page";
  EXPECT_THAT(text, HasSubstr("outdated, changed since: the machine. EX returns within 0.2 µm."));
}

TEST_F(ReportSections, ASkippedWarmUpIsSaid) {
  writeFileAtomically(folder_ / "observations.csv",
                      "time_s,state,point,x_mm,y_mm,z_mm,component,value,sigma,instrument\n"
                      "0,M0,F1,0,0,0,EX,0,0.5,microscope\n3600,M1,F1,0,0,0,EX,4,0.5,microscope\n");
  const std::string sentence = "a drift of the instrument would appear in every deviation as a motion of the machine";
  EXPECT_THAT(html(), HasSubstr(sentence));
  ReportOptions options;
  options.stored.jogs = {{"passed", true}, {"reason", "EX returns within 0.2 µm."}};
  EXPECT_THAT(html(options), HasSubstr(sentence)) << "another check is not the warm-up";
  options.stored.warm_up = {{"status", "degenerate"}, {"settled", false}, {"reason", "Point F1 was measured twice."}};
  EXPECT_THAT(html(options), HasSubstr(sentence)) << "nothing was seen";
  EXPECT_THAT(html(options), HasSubstr("not decided"));
  options.stored.warm_up = {{"status", "converged"},
                            {"settled", false},
                            {"reason", "Not settled: EX drifts."},
                            {"cause", "unknown"},
                            {"cause_reason", "Nobody logged what the machine did."}};
  EXPECT_THAT(html(options), HasSubstr("Warm-up: Nobody logged what the machine did."));
  EXPECT_THAT(html(options), HasSubstr("Not settled: EX drifts."));
  options.stored.warm_up = nullptr;
  options.stored.warm_statement = {{"settled", true}, {"by", "operator"}};
  EXPECT_THAT(html(options), Not(HasSubstr(sentence)));
}

TEST_F(ReportSections, OfALogAloneTellsConditionsStandardTestModelAndCompensation) {
  const auto log = folder_ / "spindle test.csv";
  writeLog(6000);
  std::filesystem::rename(folder_ / "log.csv", log);
  writeLogCampaign(log, folder_ / "campaign");
  const Campaign campaign = Campaign::read(folder_ / "campaign");
  EXPECT_TRUE(canReport(campaign, false));
  EXPECT_FALSE(canReport(Campaign::read(folder_.path()), false)) << "neither log nor observations";
  EXPECT_TRUE(canReport(Campaign::read(folder_.path()), true));
  ReportOptions options;
  options.stored.thermal = {{"inputs", {"spindle_rpm"}},
                            {"train", {{"rmse", 0.5}}},
                            {"test", {{"rmse", 0.7}, {"fit_percent", 88.0}, {"p2p", 2.5}}},
                            {"model", {{"outputs", {{{"name", "Z_um"}, {"unit", "um"}}}}}},
                            {"good_enough", true}};
  options.stored.log_compensation = {{"cycle_s", 60},
                                     {"steps", 181},
                                     {"holding_steps", 0},
                                     {"fallback_steps", 0},
                                     {"warnings", {"The model of Z_um was called not good enough"}},
                                     {"outputs",
                                      {{{"name", "Z_um"},
                                        {"rms_before", 9.5},
                                        {"rms_after", 1.25},
                                        {"reduction_percent", 87.0},
                                        {"largest_compensation", 30.0}}}}};
  JobContext job;
  const std::string text = htmlOf(reportOfCampaign(campaign, options, job));
  for (const char* part :
       {"of a log alone", "Operating conditions", "spindle speed, up to 6000 rpm", "Displacements of the log",
        "thermal distortion caused by the rotating spindle", "Model over time", "Output: Z. Inputs: spindle speed",
        "Compensation over the log", "Z\u00a0/\u00a0µm", "was called not good enough", "better than plain models"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_THAT(text, Not(HasSubstr("Linear axes"))) << "nobody described the machine";
  EXPECT_THAT(text, Not(HasSubstr("1970")));
}

TEST_F(ReportSections, TellsTheModelThatWasFittedInPlaceOfTheUsualOne) {
  std::string touches = "time_s,cycle,artefact,feature,stylus,c_deg,touch,x_mm,y_mm,z_mm,nx,ny,nz\n";
  for (int k = 0; k < 2; ++k)
    for (const char* bar : {"bar", "other"})
      touches += fmt::format("{},C{},{},H1,p0,0,1,1,2,3,1,0,0\n", 600 * k, k, bar);
  writeFileAtomically(folder_ / "captures/touches.csv", touches);
  const auto cycle = [](const char* name, const char* artefact, double value) -> nlohmann::json {
    return {{"cycle", name},
            {"artefact", artefact},
            {"time_s", name[1] == '0' ? 0 : 600},
            {"parameters", {{"EXX_um_per_m", {{"value", value}, {"standard_uncertainty", value == 0.0 ? 0.0 : 0.5}}}}}};
  };
  InstrumentEvaluation probe;
  probe.instrument = "touch_probe";
  probe.details = {{"cycles", {cycle("C0", "bar", 0), cycle("C1", "bar", 12.4), cycle("C1", "other", 33.8)}},
                   {"artefacts", {{{"artefact", "bar"}}, {{"artefact", "other"}}}}};
  ReportOptions options;
  options.evaluated.emplace();
  options.evaluated->instruments = {probe};
  EXPECT_THAT(html(options), HasSubstr("12.4 ± 0.5"));
  options.stored.fit = {
      {"artefact", "bar"}, {"status", "converged"}, {"cycles", {cycle("C0", "bar", 0), cycle("C1", "bar", 27.6)}}};
  const std::string told = html(options);
  EXPECT_THAT(told, HasSubstr("27.6 ± 0.5")) << "as the step Model shows it";
  EXPECT_THAT(told, Not(HasSubstr("12.4 ± 0.5")));
  EXPECT_THAT(told, HasSubstr("33.8 ± 0.5")) << "the other artefact has no model of its own";
}

TEST_F(ReportSections, EquipmentIsNamedWithItsSerialNumberAndCalibration) {
  std::string machine = machine_json;
  machine.pop_back();
  writeFileAtomically(
      folder_ / "machine.json",
      machine + R"(,"serial_number":"M-7","styli":[{"id":"p0","radius_mm":2,"offset_mm":[0,0,-50],"serial":"S-12",
"calibrated":"2026-01-10"}],"axes_note":"x"})");
  const std::string text = html();
  EXPECT_THAT(text, HasSubstr("Measuring equipment"));
  EXPECT_THAT(text, HasSubstr("S-12"));
  EXPECT_THAT(text, HasSubstr("2026-01-10"));
  EXPECT_THAT(text, HasSubstr("M-7"));
}

}  // namespace
}  // namespace spindrift
