// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/module.h"

#include <gmock/gmock.h>

#include "core/base/error.h"

namespace spindrift {
namespace {

using ::testing::AllOf, ::testing::HasSubstr;

std::string refusalOf(const char* file, const char* symbol) {
  try {
    (void)moduleSymbol(file, symbol);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Module, OneThatIsNotThereIsSaid) {
  EXPECT_THAT(refusalOf("spindrift-no-such-part.so", "any"),
              AllOf(HasSubstr("spindrift-no-such-part.so"), HasSubstr("install Spindrift again.")));
}

TEST(Module, OneOfAnotherVersionIsSaid) {
  EXPECT_THAT(refusalOf("libm.so.6", "spindrift_image_files"), HasSubstr("spindrift_image_files"));
}

TEST(Module, GivesTheSamePlaceEveryTime) {
  const void* const first = moduleSymbol("libm.so.6", "cos");
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(moduleSymbol("libm.so.6", "cos"), first);
}

}  // namespace
}  // namespace spindrift
