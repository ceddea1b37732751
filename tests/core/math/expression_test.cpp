// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/expression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <thread>

#include "core/base/error.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> names{"x", "y"};

double valueOf(const std::string& text, double x, double y) {
  const std::array<double, 2> at{x, y};
  return Expression(text, names)(at);
}

std::string refusalOf(const std::string& text) {
  try {
    (void)Expression(text, names);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Expression, HasTheValueOfItsFormula) {
  EXPECT_DOUBLE_EQ(valueOf("x*sin(y*_pi/180)", 3.0, 30.0), 1.5);
  EXPECT_DOUBLE_EQ(valueOf("-x^2 + (y >= 1 ? 2.5 : 1)", 3.0, 1.0), -6.5);
  EXPECT_DOUBLE_EQ(valueOf("x == 3 && y != 3 ? 1 : 0", 3.0, 1.0), 1.0);
  EXPECT_TRUE(std::isinf(valueOf("1/x", 0.0, 0.0)));
  EXPECT_TRUE(Expression("2*x", names).uses("x"));
  EXPECT_FALSE(Expression("2*x", names).uses("y"));
}

TEST(Expression, SaysWhatIsWrong) {
  EXPECT_THAT(refusalOf("x + speed"), HasSubstr("\"speed\" at character 5"));
  EXPECT_THAT(refusalOf("x + speed"), HasSubstr("allowed: x and y"));
  EXPECT_THAT(refusalOf("sin(x"), HasSubstr("cannot be read"));
  EXPECT_THAT(refusalOf("2 x *"), HasSubstr("cannot be read"));
  EXPECT_THAT(refusalOf("x,y"), HasSubstr("has 2 values"));
  EXPECT_THAT(refusalOf("x=2"), HasSubstr("assigns"));
  EXPECT_THAT(refusalOf("  "), HasSubstr("empty"));
}

TEST(Expression, IsEvaluatedByManyThreadsAtOnce) {
  const Expression formula("sin(x)*y + x", names);
  std::vector<std::thread> threads;
  std::array<int, 4> wrong{};
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 20000; ++i) {
        const std::array<double, 2> at{0.001 * i + static_cast<double>(t), static_cast<double>(t)};
        if (formula(at) != std::sin(at[0]) * at[1] + at[0]) ++wrong[t];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const int count : wrong) EXPECT_EQ(count, 0);
}

}  // namespace
}  // namespace spindrift
