// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/base/sha256.h"
