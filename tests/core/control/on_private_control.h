// SPDX-License-Identifier: GPL-3.0-or-later
// For tests that start a control of their own, where nothing else sees it.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/control/private_control.h"

namespace spindrift::testing {

/// Tests on a private control, which isolated() gives to what it runs; skipped where none can be had.
class OnPrivateControl : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = whyNoPrivateControl(); !why.empty()) GTEST_SKIP() << why;
  }
};

}  // namespace spindrift::testing
