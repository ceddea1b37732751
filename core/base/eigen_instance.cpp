// SPDX-License-Identifier: Apache-2.0
// Decompositions of dynamic matrices, once for all: resources/precompiled/eigen.h says that they are here.
#define SPINDRIFT_EIGEN_ELSEWHERE
#include "resources/precompiled/eigen.h"
