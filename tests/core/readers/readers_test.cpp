// SPDX-License-Identifier: GPL-3.0-or-later
// Readers and what they make of good files, of files that once broke them, and of either with bytes changed.
#include "tests/fuzz/readers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "tests/support/source_folder.h"

namespace spindrift::testing {
namespace {

std::vector<Reader> allReaders() {
  std::vector<Reader> all;
  for (const auto& list :
       {machineReaders(), imagingReaders(), probingReaders(), scanningReaders(), thermalReaders(),
        finiteElementReaders(), simulatorReaders(), sessionReaders(), plantReaders(), wholeCoreReaders()})
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

std::vector<std::filesystem::path> seedsOf(const Reader& reader) {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path folder = sourceFolder() / "tests/fuzz/corpus" / reader.name;
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// One to four changes: a byte, a piece taken out, a piece doubled, the end cut off, a number or letters put in.
std::string changed(std::string bytes, Random& random) {
  constexpr std::array<std::string_view, 14> pieces{
      "-1",  "1e999", "nan",       "99999999999999999999",    "\xE4", "\"",        ",", "\n",
      "../", "[[[[",  "{\"a\":{}", std::string_view("\0", 1), "0",    "4294967295"};
  for (std::uint64_t n = 1 + random.index(4); n > 0 && !bytes.empty(); --n) {
    const std::size_t at = random.index(bytes.size());
    const std::size_t length = std::min<std::size_t>(1 + random.index(16), bytes.size() - at);
    switch (random.index(5)) {
      case 0:
        bytes[at] = static_cast<char>(random.index(256));
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 3:
        if (random.index(4) == 0) bytes.resize(at);
        break;
      default:
        bytes.replace(at, random.index(2) * length, pieces[random.index(pieces.size())]);
    }
  }
  return bytes;
}

class Readers : public ::testing::TestWithParam<Reader> {};

std::string nameOf(const ::testing::TestParamInfo<Reader>& info) {
  return info.param.name;
}

TEST_P(Readers, TakeWhatIsGood) {
  const std::vector<std::filesystem::path> seeds = seedsOf(GetParam());
  std::size_t good = 0;
  for (const std::filesystem::path& seed : seeds) {
    if (!seed.filename().string().starts_with("good")) continue;
    ++good;
    EXPECT_EQ(sentenceOf(GetParam(), readFile(seed)), "") << seed.filename();
  }
  EXPECT_GT(good, 0U) << "at least one seed that is taken";
}

TEST_P(Readers, SayOneSentenceAboutTheRest) {
  Random random(19);
  for (const std::filesystem::path& seed : seedsOf(GetParam())) {
    const std::string bytes = readFile(seed);
    EXPECT_NO_THROW((void)sentenceOf(GetParam(), bytes)) << seed.filename();
    if (bytes.size() > 20'000) continue;
    for (int i = 0; i < 100; ++i) {
      const std::string other = changed(bytes, random);
      try {
        (void)sentenceOf(GetParam(), other);
      } catch (const std::exception& fault) {
        ADD_FAILURE() << seed.filename() << ", change " << i << ": " << fault.what() << "\n" << other;
        break;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Readers, ::testing::ValuesIn(allReaders()), nameOf);

}  // namespace
}  // namespace spindrift::testing
