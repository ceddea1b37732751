// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/atomic_file.h"

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/base/sha256.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(AtomicFile, ReadsBackWhatItWroteAndLeavesNothingElse) {
  const testing::TempFolder folder;
  std::string content(300000, 'a');
  content[5] = '\0';
  writeFileAtomically(folder / "new/deep/file.bin", content);
  EXPECT_EQ(readFile(folder / "new/deep/file.bin"), content);
  writeFileAtomically(folder / "new/deep/file.bin", "short");
  EXPECT_EQ(readFile(folder / "new/deep/file.bin"), "short");
  EXPECT_EQ(entries(folder / "new/deep"), 1U);
}

TEST(Sha256, OfAFileIsThatOfItsContent) {
  const testing::TempFolder folder;
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-4
  for (const std::size_t size : {0, 3, 65536, 300001}) {
    std::string content(size, 'a');
    if (size > 5) content[5] = '\0';
    EXPECT_EQ(sha256OfFile(folder.write("file.bin", content)), sha256(content)) << size;
  }
  EXPECT_THROW((void)sha256OfFile(folder / "missing"), InputError);
}

TEST(AtomicFile, FailureNamesTheFileAndKeepsTheOldContent) {
  const testing::TempFolder folder;
  folder.write("target/inside", "x");  // a folder cannot be replaced by a file
  try {
    writeFileAtomically(folder / "target", "y");
    FAIL() << "must throw";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("target"));
  }
  EXPECT_EQ(readFile(folder / "target/inside"), "x");
  EXPECT_EQ(entries(folder.path()), 1U);
  EXPECT_THROW((void)readFile(folder / "missing"), InputError);
}

TEST(AtomicFile, FullDeviceIsAnErrorNotALoss) {
  if (!std::filesystem::exists("/dev/full")) return;
  EXPECT_THROW(writeFileAtomically("/dev/full", std::string(100000, 'x')), InputError);
}

TEST(ReadFile, WhatIsLargerThanAllowedIsRefusedUnread) {
  const testing::TempFolder folder;
  const std::filesystem::path file = folder.write("file.bin", "12345678");
  EXPECT_EQ(readFile(file, 8), "12345678");
  const std::string said = testing::refusal([&] { (void)readFile(file, 7); });
  EXPECT_THAT(said, AllOf(HasSubstr("file.bin"), HasSubstr("8 bytes"), HasSubstr("at most 7 ")));
  std::filesystem::resize_file(file, 1'000'000'000'000);  // without a byte of them on the disk
  EXPECT_THAT(testing::refusal([&] { (void)readFile(file, 1000); }), HasSubstr("1000000000000 bytes"));
  // What does not say how long it is.
  EXPECT_THAT(testing::refusal([&] { (void)readFile("/dev/zero", 1'000'000); }), HasSubstr("at most 1000000."));
}

}  // namespace
}  // namespace spindrift
