// SPDX-License-Identifier: GPL-3.0-or-later
// Precompiled for tests.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
