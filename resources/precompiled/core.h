// SPDX-License-Identifier: Apache-2.0
// Precompiled for core, the command line and benchmarks; part of what is precompiled for the rest.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "resources/precompiled/eigen.h"
#include "resources/precompiled/json.h"
