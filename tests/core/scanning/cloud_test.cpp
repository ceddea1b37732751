// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scanning/cloud.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/random.h"
#include "core/scanning/cloud_file.h"
#include "core/scanning/lzf.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

PointCloud scan(int profiles, int points, double noise_mm, Random& random) {
  PointCloud cloud;
  for (int k = 0; k < profiles; ++k)
    for (int i = 0; i < points; ++i) {
      const double x = 0.0125 * i - 3.0;
      const double y = 0.15 * k + 1e-4 * (k % 3);
      cloud.points_mm.emplace_back(x, y, std::sin(0.6 * x) + 2.5 * std::sin(y / 6.0) + noise_mm * random.normal());
    }
  findProfiles(cloud);
  return cloud;
}

std::string complaint(const std::filesystem::path& file) {
  try {
    static_cast<void>(readCloud(file));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Lzf, GivesBackWhatWentIn) {
  Random random(1);
  for (const std::size_t size : {0U, 1U, 2U, 3U, 31U, 33U, 1000U, 70000U}) {
    std::string data(size, '\0');
    for (std::size_t i = 0; i < size; ++i) data[i] = static_cast<char>(i % 300 < 150 ? random.index(256) : (i % 7));
    const std::string packed = lzfPack(data);
    std::string back(size, 'x');
    ASSERT_TRUE(lzfUnpack(packed, back));
    EXPECT_EQ(back, data);
    if (size > 3) {
      std::string shorter(size - 1, 'x');
      EXPECT_FALSE(lzfUnpack(packed, shorter));
      std::string cut(size, 'x');
      EXPECT_FALSE(lzfUnpack(std::string_view(packed).substr(0, packed.size() - 1), cut));
    }
  }
}

TEST(CloudFile, SizesAreCheckedBeforeAnythingIsAllocated) {
  const testing::TempFolder folder;
  const auto header = [](const std::string& points) {
    return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + points + "\nHEIGHT 1\nPOINTS " +
           points + "\nDATA ";
  };
  // 300 bytes that claim 4 GB; the sizes agree with each other.
  std::string bomb = header("357913941") + "binary_compressed\n";
  const std::uint32_t packed = 100, full = 12U * 357913941U;
  bomb.append(reinterpret_cast<const char*>(&packed), 4);
  bomb.append(reinterpret_cast<const char*>(&full), 4);
  bomb.append(100, '\xff');
  EXPECT_NE(complaint(folder.write("bomb.pcd", bomb)).find("cannot unpack to the 4294967292 bytes"), std::string::npos)
      << complaint(folder / "bomb.pcd");
  EXPECT_NE(complaint(folder.write("binary.pcd", header("399999999") + "binary\nabc")).find("truncated"),
            std::string::npos);
  EXPECT_NE(complaint(folder.write("ascii.pcd", header("399999999") + "ascii\n1 2 3\n")).find("truncated"),
            std::string::npos);
  const std::string properties = "property float x\nproperty float y\nproperty float z\nend_header\n";
  for (const std::string format : {"ascii", "binary_little_endian"}) {
    const std::string head = "ply\nformat " + format + " 1.0\nelement vertex ";
    EXPECT_NE(complaint(folder.write("large.ply", head + "399999999\n" + properties + "1 2 3\n")).find("truncated"),
              std::string::npos);
    EXPECT_NE(complaint(folder.write("huge.ply", head + "18446744073709551615\n" + properties)).find("allowed"),
              std::string::npos);
  }
}

TEST(CloudFile, EveryFormatGivesBackPointsAndProfiles) {
  const testing::TempFolder folder;
  Random random(2);
  const PointCloud cloud = scan(20, 60, 1e-3, random);
  ASSERT_EQ(cloud.profileCount(), 20U);
  struct Case {
    const char* name;
    CloudEncoding encoding;
    bool single;
  };
  for (const Case& c :
       {Case{"a.pcd", CloudEncoding::Ascii, true}, Case{"b.pcd", CloudEncoding::Binary, true},
        Case{"c.pcd", CloudEncoding::BinaryCompressed, true}, Case{"d.pcd", CloudEncoding::BinaryCompressed, false},
        Case{"e.ply", CloudEncoding::Ascii, false}, Case{"f.ply", CloudEncoding::Binary, true},
        Case{"g.ply", CloudEncoding::Binary, false}, Case{"h.csv", CloudEncoding::Ascii, false}}) {
    writeCloud(cloud, folder / c.name, c.encoding, c.single);
    const PointCloud back = readCloud(folder / c.name);
    ASSERT_EQ(back.size(), cloud.size()) << c.name;
    EXPECT_EQ(back.profile_start, cloud.profile_start) << c.name;
    double worst = 0.0;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      worst = std::max(worst, (back.points_mm[i] - cloud.points_mm[i]).cwiseAbs().maxCoeff());
    EXPECT_LE(worst, c.single ? 1e-6 : 0.0) << c.name;
  }
}

TEST(CloudFile, KeepsRowsOfAnOrganisedFileAndDropsMissingPoints) {
  const testing::TempFolder folder;
  std::string text =
      "VERSION 0.7\nFIELDS intensity x y z\nSIZE 4 4 4 4\nTYPE U F F F\nCOUNT 1 1 1 1\nWIDTH 4\nHEIGHT 5\nPOINTS "
      "20\nDATA ascii\n";
  for (int k = 0; k < 5; ++k)
    for (int i = 0; i < 4; ++i)
      text += i == k ? "7 nan nan nan\n" : "7 " + std::to_string(i) + " " + std::to_string(k) + " 0.5\r\n";
  const PointCloud cloud = readCloud(folder.write("organised.pcd", text));
  EXPECT_EQ(cloud.size(), 16U);
  EXPECT_EQ(cloud.profile_start, (std::vector<std::size_t>{0, 3, 6, 9, 12, 16}));
}

TEST(CloudFile, SaysWhatIsWrong) {
  const testing::TempFolder folder;
  Random random(3);
  const PointCloud cloud = scan(20, 60, 0.0, random);
  writeCloud(cloud, folder / "good.pcd");
  writeCloud(cloud, folder / "good.ply");
  writeCloud(cloud, folder / "packed.pcd", CloudEncoding::BinaryCompressed);
  const std::string good = readFile(folder / "good.pcd");
  EXPECT_NE(complaint(folder.write("cut.pcd", good.substr(0, good.size() - 100))).find("truncated"), std::string::npos);
  EXPECT_NE(complaint(folder.write("head.pcd", good.substr(0, 60))).find("header"), std::string::npos);
  std::string lying = good;
  lying.replace(lying.find("POINTS 1200"), 11, "POINTS 9999");
  EXPECT_NE(complaint(folder.write("lying.pcd", lying)).find("WIDTH 1200"), std::string::npos);
  const std::string ply = readFile(folder / "good.ply");
  EXPECT_NE(complaint(folder.write("cut.ply", ply.substr(0, ply.size() - 1))).find("truncated"), std::string::npos);
  const std::string packed = readFile(folder / "packed.pcd");
  EXPECT_NE(complaint(folder.write("cut2.pcd", packed.substr(0, packed.size() / 2))).find("truncated"),
            std::string::npos);
  std::string damaged = packed;
  for (std::size_t i = packed.size() - 200; i < packed.size(); ++i) damaged[i] = static_cast<char>(0xff);
  EXPECT_NE(complaint(folder.write("damaged.pcd", damaged)).find("damaged"), std::string::npos);
  EXPECT_NE(complaint(folder.write("empty.pcd", "")).find("empty"), std::string::npos);
  EXPECT_NE(complaint(folder.write("zero.csv", "x_mm,y_mm,z_mm\n")).find("no points"), std::string::npos);
  EXPECT_NE(complaint(folder.write("nan.csv", "x_mm,y_mm,z_mm\nnan,nan,nan\nnan,nan,nan\n")).find("NaN"),
            std::string::npos);
  EXPECT_NE(complaint(folder.write("column.csv", "x_mm,y_mm\n1,2\n")).find("z_mm"), std::string::npos);
  EXPECT_NE(complaint(folder.write("word.csv", "x_mm,y_mm,z_mm\n1,2,three\n")).find("line 2"), std::string::npos);
  EXPECT_NE(complaint(folder.write("what.xyz", "1 2 3\n")).find(".pcd"), std::string::npos);
  EXPECT_NE(complaint(folder / "missing.pcd"), "");
  PointCloud um = cloud;
  for (auto& p : um.points_mm) p *= 1000.0;
  writeCloud(um, folder / "um.pcd");
  EXPECT_NE(complaint(folder / "um.pcd").find("um"), std::string::npos);
  PointCloud mixed = cloud;
  for (auto& p : mixed.points_mm) p.z() *= 1000.0;
  writeCloud(mixed, folder / "mixed.pcd");
  EXPECT_NE(complaint(folder / "mixed.pcd").find("heights"), std::string::npos);
}

TEST(CloudFilter, DropsEdgesAndOutliersAndKeepsTheRest) {
  Random random(4);
  PointCloud cloud = scan(60, 400, 0.5e-3, random);
  CloudMask bad(cloud.size(), 0);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (random.uniform() < 0.003) {
      cloud.points_mm[i].z() += random.uniform() < 0.5 ? -0.4 : 0.15;
      bad[i] = 1;
    }
  const CloudFilterResult result = filterCloud(cloud);
  std::size_t kept_bad = 0, dropped_good = 0, kept = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::size_t k = i % 400;
    const std::size_t row = i / 400;
    const bool edge = k < 22 || k > 377 || row < 3 || row > 56;
    if (k < 19 || k > 380 || row < 1 || row > 58) {
      EXPECT_EQ(result.keep[i], 0);
    }
    if (edge) continue;
    kept += result.keep[i];
    if (bad[i] != 0)
      kept_bad += result.keep[i];
    else
      dropped_good += result.keep[i] == 0 ? 1U : 0U;
  }
  EXPECT_EQ(kept_bad, 0U);
  EXPECT_LT(dropped_good, 20U);
  EXPECT_GT(kept, 18000U);
  const PointCloud rest = masked(cloud, result.keep);
  EXPECT_EQ(rest.profileCount(), 56U);
}

TEST(Cloud, UnorderedPointsHaveNoProfiles) {
  Random random(5);
  PointCloud cloud = scan(30, 50, 0.0, random);
  for (std::size_t i = cloud.size() - 1; i > 0; --i)
    std::swap(cloud.points_mm[i], cloud.points_mm[random.index(i + 1)]);
  findProfiles(cloud);
  EXPECT_EQ(cloud.profileCount(), 0U);
  EXPECT_GT(cloudSpacing(cloud).along_profile_mm, 0.01);
}

}  // namespace
}  // namespace spindrift
