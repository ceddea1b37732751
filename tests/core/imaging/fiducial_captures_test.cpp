// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/imaging/fiducial_captures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

constexpr std::string_view header = "time_s,state,fiducial,role,index,x_mm,y_mm,z_mm,spindle_deg,image\n";

std::string errorOf(const std::string& content) {
  const testing::TempFolder folder;
  const auto file = folder.write("fiducials.csv", content);
  try {
    (void)readFiducialCaptures(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FiducialCaptures, ReadsARow) {
  const testing::TempFolder folder;
  const auto file = folder.write("fiducials.csv", std::string(header) +
                                                      "10,M0,F1,focus,3,20.5,15,0.127,-8,captures/images/a.jpg\n"
                                                      "12,M1,F1,x_axis,0,20,15,0,0,captures/images/b.jpg\n");
  const FiducialCaptureList list = readFiducialCaptures(file);
  ASSERT_EQ(list.captures.size(), 2u);
  EXPECT_EQ(list.captures[0].role, CaptureRole::Focus);
  EXPECT_EQ(list.captures[0].index, 3);
  EXPECT_EQ(list.captures[0].position_mm, Eigen::Vector3d(20.5, 15, 0.127));
  EXPECT_EQ(list.captures[0].spindle_deg, -8.0);
  EXPECT_EQ(list.states(), (std::vector<std::string>{"M0", "M1"}));
}

TEST(FiducialCaptures, RefusesWithPlaceAndValue) {
  EXPECT_THAT(errorOf("time_s,state,fiducial,role,index,x_mm,y_mm,z_mm,image\n0,M0,F1,rotation,0,1,2,3,a.jpg\n"),
              HasSubstr("spindle_deg"));
  EXPECT_THAT(errorOf(std::string(header) + "0,M0,F1,spin,0,1,2,3,0,a.jpg\n"), HasSubstr("role \"spin\" is not known"));
  EXPECT_THAT(errorOf(std::string(header) + "0,M0,F1,rotation,0,20,5,15,0,0,-8,a.jpg\n"), HasSubstr("line 2"));
  EXPECT_THAT(errorOf(std::string(header) + "0,M0,F1,rotation,0,\"20,5\",15,0,-8,a.jpg\n"), HasSubstr("20,5"));
  EXPECT_THAT(errorOf(std::string(header) + "5,M0,F1,rotation,0,1,2,3,0,a.jpg\n4,M0,F1,rotation,1,1,2,3,0,b.jpg\n"),
              HasSubstr("runs backwards from 5 s to 4 s"));
  EXPECT_THAT(errorOf(std::string(header) + "5,M0,F1,rotation,0,1,2,3,0,a.jpg\n5,M0,F1,rotation,0,1,2,3,0,b.jpg\n"),
              HasSubstr("line 3: duplicate rotation 0 of fiducial F1 in state M0, first in line 2; allowed"));
  EXPECT_THAT(errorOf(std::string(header)), HasSubstr("lists no image"));
}

TEST(FiducialCaptures, ImagesStayInTheFolderOfTheCampaign) {
  for (const std::string image : {"/etc/passwd", "../a.jpg", "captures/../../a.jpg", ".."})
    EXPECT_THAT(errorOf(std::string(header) + "5,M0,F1,rotation,0,1,2,3,0," + image + "\n"),
                ::testing::AllOf(HasSubstr("line 2, column image: \"" + image + "\""), HasSubstr("allowed")));
}

TEST(FiducialCaptures, TimeRunsPerFiducial) {
  EXPECT_EQ(errorOf(std::string(header) + "5,M0,F1,rotation,0,1,2,3,0,a.jpg\n4,M0,F2,rotation,0,1,2,3,0,b.jpg\n"), "");
}

}  // namespace
}  // namespace spindrift
