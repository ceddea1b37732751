// SPDX-License-Identifier: GPL-3.0-or-later
// How many fits a second one core makes; asked for: 100,000 spheres through five touches. Counts allocations as well.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/shape_fit.h"

namespace {
long allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}

int main() {
  using namespace spindrift;
  Random random(1);
  const Eigen::Vector3d directions[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  std::vector<std::array<Eigen::Vector3d, 5>> spheres(1000);
  std::vector<std::array<Eigen::Vector2d, 4>> circles(1000);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Eigen::Vector3d centre(random.uniform(0, 500), random.uniform(0, 500), random.uniform(0, 500));
    for (int k = 0; k < 5; ++k) spheres[i][k] = centre + (15.2 + random.normal(0, 0.0005)) * directions[k];
    for (int k = 0; k < 4; ++k) {
      circles[i][k] = centre.head<2>() + (3.0 + random.normal(0, 0.0005)) * directions[k].head<2>();
    }
  }
  ShapeFitOptions options;
  options.sigma_mm = 0.0005;
  ShapeFitOptions robust = options;
  robust.tolerate_one_bad_point = true;
  ShapeFitOptions known = options;
  known.known_radius_mm = 15.2;
  const auto run = [&](const char* name, const auto& body) {
    const int repeats = 100;
    long usable = 0;
    const long before = allocations;
    const auto start = std::chrono::steady_clock::now();
    for (int r = 0; r < repeats; ++r) {
      for (std::size_t i = 0; i < spheres.size(); ++i) usable += body(i) ? 1 : 0;
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double fits = static_cast<double>(repeats) * static_cast<double>(spheres.size());
    std::printf("%-38s %10.0f fits/s, %6.2f us each, usable %.4f, allocations per fit %.3f\n", name, fits / seconds,
                1e6 * seconds / fits, static_cast<double>(usable) / fits,
                static_cast<double>(allocations - before) / fits);
  };
  run("sphere, 5 touches, free radius", [&](std::size_t i) { return fitSphere(spheres[i], options).usable(); });
  run("sphere, 5 touches, known radius", [&](std::size_t i) { return fitSphere(spheres[i], known).usable(); });
  run("sphere, 5 touches, tolerant", [&](std::size_t i) { return fitSphere(spheres[i], robust).usable(); });
  run("circle, 4 touches, free radius", [&](std::size_t i) { return fitCircle(circles[i], options).usable(); });
  return 0;
}
