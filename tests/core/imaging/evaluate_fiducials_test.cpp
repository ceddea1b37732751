// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/imaging/evaluate_fiducials.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/imaging/artwork.h"
#include "core/machine/nine_parameter_model.h"
#include "core/simulation/virtual_microscope.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> sentencesOf(const InstrumentEvaluation& evaluation) {
  std::vector<std::string> sentences;
  for (const EvaluationWarning& w : evaluation.warnings) sentences.push_back(w.sentence);
  return sentences;
}

constexpr int width = 720;
constexpr int height = 480;

const std::vector<std::pair<std::string, Eigen::Vector3d>>& fiducials() {
  static const std::vector<std::pair<std::string, Eigen::Vector3d>> list{
      {"F1", {20, 15, 0}}, {"F2", {280, 15, 0}}, {"F3", {150, 115, 0}}};
  return list;
}

NineVector truthParameters() {
  NineVector p;
  p << -28, 25, 6, 40, 25, 50, 20, 100, -80;
  return p;
}

/// A campaign rendered from the conventions of FORMATS.md: the tool stands at commanded + deviation relative to the
/// table, the camera turns with the spindle, the shots flicker.
void renderCampaign(const std::filesystem::path& folder, double noise_um,
                    const FiducialPattern& pattern = standardPattern()) {
  std::filesystem::create_directories(folder / "captures/images");
  std::ofstream(folder / "campaign.json")
      << R"({"format":"spindrift-campaign","version":1,"name":"rendered","start_utc":"2026-01-31T08:00:00Z"})";
  std::ofstream machine(folder / "machine.json");
  machine
      << R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-(C)-t]","axes":[)"
      << R"({"name":"X","travel_mm":[0,300],"resolution_um":5.08},{"name":"Y","travel_mm":[0,130],"resolution_um":5.08},)"
      << R"({"name":"Z","travel_mm":[0,150],"resolution_um":5.08}],"points":[)";
  for (const auto& [id, p] : fiducials()) {
    machine << fmt::format(R"({}{{"id":"{}","kind":"fiducial","x_mm":{},"y_mm":{},"z_mm":{}}})", id == "F1" ? "" : ",",
                           id, p.x(), p.y(), p.z());
  }
  machine << "]}";
  machine.close();
  std::ofstream list(folder / "captures/fiducials.csv");
  list << "time_s,state,fiducial,role,index,x_mm,y_mm,z_mm,spindle_deg,image\n";
  Random random(7);
  const std::map<std::string, double> psi{{"F1", 0.03}, {"F2", -0.02}, {"F3", 0.05}};
  const Eigen::Vector2d centre_px(365.0, 250.0);
  double time = 0.0;
  std::uint64_t seed = 1;
  for (const std::string state : {"M0", "M1"}) {
    time = state == "M0" ? 0.0 : 7200.0;
    for (const auto& [id, nominal] : fiducials()) {
      Eigen::Vector3d d = Eigen::Vector3d::Zero();
      if (state == "M1") {
        for (int k = 0; k < 3; ++k) d[k] = nineParameterRow(nominal, all_components[k]).dot(truthParameters());
      }
      const auto shoot = [&, id = id, nominal = nominal](const std::string& role, int index,
                                                         const Eigen::Vector3d& offset_mm, double spindle_deg) {
        MicroscopeScene scene;
        scene.width_px = width;
        scene.height_px = height;
        const double p = psi.at(id);
        const Eigen::Vector2d tool(offset_mm.x() * um_per_mm + d.x() + random.normal(0, noise_um),
                                   offset_mm.y() * um_per_mm + d.y() + random.normal(0, noise_um));
        // Where the spindle's axis meets the fiducial, in FCF; and how FCF lies in the camera.
        const double middle = 4.0 * pattern.pitch_um;
        const Eigen::Vector2d place(middle + std::cos(p) * tool.x() + std::sin(p) * tool.y(),
                                    middle - std::sin(p) * tool.x() + std::cos(p) * tool.y());
        const double orientation = p - 0.11 - spindle_deg * rad_per_deg;
        scene.map = poseAt(width, height, 2.4 * pattern.pitch_um / 350.0, -orientation, place, centre_px);
        scene.blur_sigma_px = 0.8;
        scene.defocus_px_per_um = 0.012;
        scene.defocus_um = offset_mm.z() * um_per_mm + d.z() + 12.0 + random.normal(0, noise_um);
        scene.illumination_gain = random.uniform(0.94, 1.06);
        scene.jpeg_quality = 95;
        const std::string name = fmt::format("captures/images/{}_{}_{}_{}.jpg", state, id, role, index);
        writeFileAtomically(folder / name, encodeJpeg(renderFiducial(pattern, scene, seed++), 95));
        list << fmt::format("{},{},{},{},{},{},{},{},{},{}\n", time, state, id, role, index,
                            nominal.x() + offset_mm.x(), nominal.y() + offset_mm.y(), nominal.z() + offset_mm.z(),
                            spindle_deg, name);
        time += 5.0;
      };
      for (int i = 0; i < 3; ++i) shoot("rotation", i, {0, 0, 0}, -8.0 + 8.0 * i);
      if (state == "M0") {
        for (int i = -1; i <= 1; ++i) shoot("x_axis", i + 1, {0.1016 * i, 0, 0}, 0.0);
        for (int i = -1; i <= 1; ++i) shoot("y_axis", i + 1, {0, 0.1016 * i, 0}, 0.0);
      }
      for (int i = -2; i <= 2; ++i) shoot("focus", i + 2, {0, 0, 0.127 * i}, 0.0);
    }
  }
}

/// Rendered once, copied for tests that damage it.
class RenderedCampaign : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempFolder>();
    renderCampaign(folder_->path() / "campaign", 0.2);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static InstrumentEvaluation evaluate(const std::filesystem::path& campaign) {
    JobContext job;
    return evaluateFiducials(Campaign::read(campaign), job);
  }
  std::filesystem::path copy() {
    const auto target = own_.path() / "campaign";
    std::filesystem::copy(folder_->path() / "campaign", target, std::filesystem::copy_options::recursive);
    return target;
  }
  static std::string reasonOf(const InstrumentEvaluation& e, std::string_view capture) {
    for (const RejectedCapture& r : e.rejected) {
      if (r.capture.find(capture) != std::string::npos) return r.reason;
    }
    return "";
  }

  static std::unique_ptr<testing::TempFolder> folder_;
  testing::TempFolder own_;
};
std::unique_ptr<testing::TempFolder> RenderedCampaign::folder_;

TEST(EvaluateFiducials, TakesThePatternOfTheCampaign) {
  const testing::TempFolder folder;
  const FiducialPattern own = makePattern({.pitch_um = 455.0});
  renderCampaign(folder / "campaign", 0.2, own);
  folder.write("campaign/pattern.json", patternJson(own));
  EXPECT_EQ(campaignPattern(folder / "campaign")->pitch_um, 455.0);
  EXPECT_EQ(campaignPattern(folder.path()).get(), &standardPattern());
  JobContext job;
  const InstrumentEvaluation e = evaluateFiducials(Campaign::read(folder / "campaign"), job);
  EXPECT_TRUE(e.good_enough);
  ASSERT_EQ(e.observations.rows.size(), 18u);
  for (const Observation& o : e.observations.rows) {
    if (o.state == "M0") continue;
    const double truth = nineParameterRow(o.position_mm, o.component).dot(truthParameters());
    EXPECT_NEAR(o.value, truth, o.component == Component::EZ ? 2.5 : 1.2) << o.point << toString(o.component);
  }
  folder.write("campaign/pattern.json", "{}");
  EXPECT_THROW((void)evaluateFiducials(Campaign::read(folder / "campaign"), job), InputError);
}

TEST_F(RenderedCampaign, DeviationHasTheSignAndSizeOfTheTruth) {
  const InstrumentEvaluation e = evaluate(folder_->path() / "campaign");
  EXPECT_TRUE(e.rejected.empty()) << e.rejected.front().capture << ": " << e.rejected.front().reason;
  EXPECT_TRUE(e.good_enough);
  ASSERT_EQ(e.observations.rows.size(), 18u);
  double chi2 = 0.0;
  for (const Observation& o : e.observations.rows) {
    if (o.state == "M0") {
      EXPECT_EQ(o.value, 0.0);
      EXPECT_GT(o.sigma, 0.0);
      continue;
    }
    const double truth = nineParameterRow(o.position_mm, o.component).dot(truthParameters());
    EXPECT_NEAR(o.value, truth, o.component == Component::EZ ? 2.0 : 1.0) << o.point << toString(o.component);
    EXPECT_LT(o.sigma, 1.2);
    chi2 += std::pow((o.value - truth) / o.sigma, 2) / 9.0;
  }
  EXPECT_LT(chi2, 3.0);
  // The change between states, with the covariance that was written, has the sigma of the row.
  const NineParameterFit fit = fitNineParameters(e.observations, {.state = "M1", .points = {}});
  ASSERT_EQ(fit.status, FitStatus::Converged) << fit.message;
  for (const NineParameterResidual& r : fit.residuals) {
    for (const Observation& o : e.observations.rows) {
      if (o.state == "M1" && o.point == r.point && o.component == r.component) {
        EXPECT_NEAR(r.sigma_um, o.sigma, 1e-9);
      }
    }
  }
  for (int i = 0; i < nine_parameter_count; ++i) {
    EXPECT_LT(std::abs(fit.parameters(i) - truthParameters()(i)), 4.0 * fit.standardUncertainty(i)) << i;
  }
  ASSERT_EQ(e.details["fiducials"].size(), 3u);
  const auto& first = e.details["fiducials"][0]["states"][0];
  EXPECT_NEAR(first["centre_of_rotation"]["x_px"]["value"].get<double>(), 365.0, 2.0);
  EXPECT_TRUE(first["axis_directions"].is_object());
  EXPECT_NEAR(e.details["fiducials"][0]["fcf_in_machine_rad"]["value"].get<double>(), 0.03, 0.005);
  // The mean of what every fiducial tells in every state, weighted with what it knows.
  double weights = 0.0, sum = 0.0;
  for (const auto& fiducial : e.details["fiducials"]) {
    for (const auto& state : fiducial["states"]) {
      if (state["axis_directions"].is_null()) continue;
      const nlohmann::json& one = state["axis_directions"]["orthogonality_urad"];
      const double weight = std::pow(one["standard_uncertainty"].get<double>(), -2);
      weights += weight;
      sum += weight * one["value"].get<double>();
    }
  }
  EXPECT_NEAR(e.details["orthogonality_urad"]["value"].get<double>(), sum / weights, 1e-6);
  EXPECT_NEAR(e.details["orthogonality_urad"]["standard_uncertainty"].get<double>(), 1.0 / std::sqrt(weights), 1e-6);
}

TEST_F(RenderedCampaign, BadCapturesAreNamedAndTheRestIsEvaluated) {
  const auto campaign = copy();
  const auto images = campaign / "captures/images";
  std::filesystem::remove(images / "M1_F1_focus_2.jpg");
  std::ofstream(images / "M0_F1_x_axis_0.jpg", std::ios::binary) << "this is no image";
  const std::string whole = readFile(images / "M0_F2_y_axis_0.jpg");
  std::ofstream(images / "M0_F2_y_axis_0.jpg", std::ios::binary) << whole.substr(0, whole.size() / 2);
  std::filesystem::copy_file(images / "M1_F2_rotation_0.jpg", images / "M1_F2_rotation_1.jpg",
                             std::filesystem::copy_options::overwrite_existing);
  writeFileAtomically(images / "M0_F3_x_axis_1.jpg", encodeJpeg(GrayImage(640, 480, 60), 90));
  writeFileAtomically(images / "M0_F3_y_axis_1.jpg", encodeJpeg(GrayImage(width, height, 0), 90));
  const InstrumentEvaluation e = evaluate(campaign);
  EXPECT_THAT(reasonOf(e, "M1_F1_focus_2"), HasSubstr("not there"));
  EXPECT_FALSE(reasonOf(e, "M0_F1_x_axis_0").empty());
  EXPECT_FALSE(reasonOf(e, "M0_F2_y_axis_0").empty());
  EXPECT_THAT(reasonOf(e, "M1_F2_rotation_1"), HasSubstr("the same as"));
  EXPECT_THAT(reasonOf(e, "M0_F3_x_axis_1"), HasSubstr("640 x 480"));
  EXPECT_FALSE(reasonOf(e, "M0_F3_y_axis_1").empty());
  EXPECT_THAT(reasonOf(e, "focus of F1 in state M1"), HasSubstr("at least 5"));
  EXPECT_THAT(reasonOf(e, "rotation of F2 in state M1"), HasSubstr("at least 3"));
  EXPECT_TRUE(e.good_enough);
  // F3 is whole, F1 has its plane, F2 its height.
  std::map<std::string, int> rows;
  for (const Observation& o : e.observations.rows) {
    if (o.state == "M1") ++rows[o.point];
  }
  EXPECT_EQ(rows["F1"], 2);
  EXPECT_EQ(rows["F2"], 1);
  EXPECT_EQ(rows["F3"], 3);
}

TEST_F(RenderedCampaign, SwappedLabelsAreToldAndTheRestIsEvaluated) {
  const auto campaign = copy();
  const auto list = campaign / "captures/fiducials.csv";
  std::istringstream lines(readFile(list));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    for (const auto& [from, to] : {std::pair(",M1,F1,", ",M1,F2,"), {",M1,F2,", ",M1,F1,"}}) {
      if (const auto at = line.find(from); at != std::string::npos) {
        line.replace(at, std::string_view(from).size(), to);
        break;
      }
    }
    text += line + "\n";
  }
  writeFileAtomically(list, text);
  const InstrumentEvaluation e = evaluate(campaign);
  EXPECT_FALSE(e.good_enough);
  EXPECT_THAT(reasonOf(e, "F1 and F2 in state M1"),
              HasSubstr("The labels of F1 and F2 are swapped in state M1 or in M0: each lies 260.0 mm away"));
  EXPECT_THAT(sentencesOf(e), ::testing::Contains(HasSubstr("are swapped in state M1")));
  EXPECT_EQ(e.summary.find("260"), std::string::npos) << e.summary;
  std::map<std::string, int> rows;
  for (const Observation& o : e.observations.rows) {
    EXPECT_LT(std::abs(o.value), 1000.0);
    if (o.state == "M1") ++rows[o.point];
  }
  EXPECT_EQ(rows["F1"], 0);
  EXPECT_EQ(rows["F2"], 0);
  EXPECT_EQ(rows["F3"], 3);
}

TEST_F(RenderedCampaign, AFiducialMissingInAStateIsSaid) {
  const auto campaign = copy();
  std::string kept;
  std::istringstream lines(readFile(campaign / "captures/fiducials.csv"));
  for (std::string line; std::getline(lines, line);) {
    if (line.find(",M0,F2,") == std::string::npos) kept += line + "\n";
  }
  std::ofstream(campaign / "captures/fiducials.csv") << kept;
  const InstrumentEvaluation e = evaluate(campaign);
  EXPECT_THAT(sentencesOf(e),
              ::testing::Contains(HasSubstr("F2 has none of the three rotation images it needs in M0")));
  EXPECT_EQ(e.observations.rows.size(), 12u) << "F2 has no reference, so no deviation";
}

TEST_F(RenderedCampaign, WithoutItsReferenceAPointHasNoDeviation) {
  Campaign campaign = Campaign::read(copy());
  campaign.excluded_captures.insert("captures/images/M0_F1_rotation_1.jpg");
  JobContext job;
  const InstrumentEvaluation e = evaluateFiducials(campaign, job);
  // Zero relative to M1 itself would stand beside the others as if it were relative to M0, where it is -28 um.
  for (const Observation& o : e.observations.rows) {
    EXPECT_FALSE(o.point == "F1" && o.component != Component::EZ) << o.state << " " << o.value;
  }
  const nlohmann::json& states = e.details["fiducials"][0]["states"];
  EXPECT_TRUE(states[1]["EX_um"].is_null());
  EXPECT_FALSE(states[1]["EZ_um"].is_null());
  EXPECT_THAT(sentencesOf(e),
              ::testing::Contains("F1 has only two of the three rotation images it needs in M0: it has no "
                                  "deviation in X and Y in M1."));
  EXPECT_EQ(e.observations.rows.size(), 14u);
  EXPECT_EQ(e.observations.rows.front().state, "M0");
}

}  // namespace
}  // namespace spindrift
