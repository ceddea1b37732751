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

// Exported with x and y swapped the evaluation ended with "no images along X or Y could be used" and status 0.
TEST(FiducialCaptures, ImagesAlongXMoveAlongX) {
  const std::string rows =
      "0,M0,F1,x_axis,0,20,15,0,0,a.jpg\n1,M0,F1,x_axis,1,20.5,15.001,0,0,b.jpg\n"
      "2,M0,F1,y_axis,0,20,15,0,0,c.jpg\n3,M0,F1,y_axis,1,20,15.5,0,0,d.jpg\n";
  EXPECT_EQ(errorOf(std::string(header) + rows), "");
  EXPECT_THAT(
      errorOf(std::string(header) + "0,M0,F1,x_axis,0,15,20,0,0,a.jpg\n1,M0,F1,x_axis,1,15.001,20.5,0,0,b.jpg\n"),
      HasSubstr("line 3: the images x_axis of F1 in state M0 move by 0.5 mm along Y and by 0.001 mm along X; allowed: "
                "a movement along X (are two columns or the roles swapped?)."));
  EXPECT_THAT(errorOf(std::string(header) + "0,M0,F1,y_axis,0,15,20,0,0,a.jpg\n1,M0,F1,y_axis,1,15.5,20,0,0,b.jpg\n"),
              HasSubstr("y_axis of F1 in state M0 move by 0.5 mm along X and by 0 mm along Y"));
  // A list that still arrives, and images that do not move yet, are no mistake.
  EXPECT_EQ(errorOf(std::string(header) + "0,M0,F1,x_axis,0,15,20,0,0,a.jpg\n"), "");
  EXPECT_EQ(errorOf(std::string(header) + "0,M0,F1,x_axis,0,15,20,0,0,a.jpg\n1,M0,F1,x_axis,1,15,20,0,0,b.jpg\n"), "");
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
