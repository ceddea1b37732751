// SPDX-License-Identifier: GPL-3.0-or-later
// Whole fiducial campaigns through rendered images: images -> displacements -> nine parameters, held against the truth.
//
//   fiducial_study [campaigns, default 20] [seed, default 1]
//   fiducial_study folder [images, default 1000]      time of a folder of images on 1, 2, ... threads
//
// Every campaign has its own fiducials, thermal state, light, repeatability and seed. Printed: rms error of X, Y, Z and
// of the nine parameters, error over stated uncertainty, and how often the truth lies in the 95 % interval.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/job_context.h"
#include "core/base/random.h"
#include "core/imaging/evaluate_fiducials.h"
#include "core/imaging/fiducial_images.h"
#include "core/imaging/image.h"
#include "core/imaging/pattern.h"
#include "core/machine/nine_parameter_model.h"
#include "core/math/distributions.h"
#include "core/math/statistics.h"
#include "core/simulation/virtual_fiducials.h"
#include "core/simulation/virtual_microscope.h"
#include "tests/support/temp_folder.h"

using namespace spindrift;

namespace {

struct Tally {
  double error2 = 0.0;
  double ratio2 = 0.0;
  std::size_t inside = 0;
  std::size_t count = 0;
  void add(double error, double sigma, double quantile) {
    error2 += error * error;
    ratio2 += error * error / (sigma * sigma);
    inside += std::abs(error) <= quantile * sigma ? 1 : 0;
    ++count;
  }
  void print(const std::string& name, const char* unit) const {
    const auto n = static_cast<double>(count);
    const RateInterval i = wilsonInterval(inside, count);
    fmt::print(
        "{:22} n {:4}  rms error {:7.3f} {:5} error/sigma {:4.2f}  in 95 % interval {:5.1f} % [{:.1f}, {:.1f}]\n", name,
        count, std::sqrt(error2 / n), unit, std::sqrt(ratio2 / n), 100.0 * static_cast<double>(inside) / n,
        100.0 * i.low, 100.0 * i.high);
  }
};

VirtualFiducialOptions drawOptions(Random& random, NineVector& truth) {
  VirtualFiducialOptions o;
  o.width_px = 1000;
  o.height_px = 700;
  o.pixel_length_um = random.uniform(1.6, 2.3);
  o.cor_px = {500 + random.uniform(-15, 15), 350 + random.uniform(-15, 15)};
  o.camera_turn_rad = random.uniform(-0.3, 0.3);
  o.k1_per_px2 = random.uniform(-3e-8, 3e-8);
  o.defocus_px_per_um = 0.020 / o.pixel_length_um;
  o.noise_level = random.uniform(1.0, 4.0);
  o.flicker = random.uniform(0.0, 0.02);
  o.axis_squareness_rad = random.uniform(-1e-4, 1e-4);
  o.steps_mm = {-0.1016, 0.0, 0.1016};
  truth << random.normal(0, 20), random.normal(0, 20), random.normal(0, 20), random.normal(0, 60), random.normal(0, 60),
      random.normal(0, 60), random.normal(0, 40), random.normal(0, 80), random.normal(0, 80);
  const std::array<Eigen::Vector2d, 5> corners{{{20, 15}, {280, 15}, {280, 115}, {20, 115}, {150, 65}}};
  VirtualState cold{"M0", 0.0, {}};
  VirtualState warm{"M1", 7200.0, {}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    VirtualFiducial f;
    f.id = fmt::format("F{}", i + 1);
    f.position_mm = corners[i] + Eigen::Vector2d(random.uniform(-10, 10), random.uniform(-10, 10));
    f.turn_rad = random.uniform(-0.05, 0.05);
    o.fiducials.push_back(f);
    const Eigen::Vector3d at(f.position_mm.x(), f.position_mm.y(), 0.0);
    cold.deviation_um.push_back(Eigen::Vector3d::Zero());
    warm.deviation_um.push_back({nineParameterRow(at, Component::EX).dot(truth),
                                 nineParameterRow(at, Component::EY).dot(truth),
                                 nineParameterRow(at, Component::EZ).dot(truth)});
  }
  o.states = {cold, warm};
  return o;
}

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_s(int whose) {
  rusage used{};
  ::getrusage(whose, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

/// A folder of images measured on one thread and on all, by the clock on the wall; where others use the machine too,
/// the part of the processor time that cannot be shared tells more.
void folderSpeed(int images) {
  const testing::TempFolder folder;
  FiducialCaptureList list;
  constexpr int scenes = 8;
  std::vector<GrayImage> rendered;
  for (int k = 0; k < scenes; ++k) {
    MicroscopeScene scene;
    scene.blur_sigma_px = 1.2;
    scene.noise_level = 2.0;
    scene.map = poseAt(scene.width_px, scene.height_px, 1.2 + 0.15 * k, 0.4 * k, {1400, 1400}, {960, 540});
    rendered.push_back(renderFiducial(standardPattern(), scene, static_cast<std::uint64_t>(k)));
  }
  for (int k = 0; k < images; ++k) {
    GrayImage image = rendered[static_cast<std::size_t>(k % scenes)];
    image.data()[0] = static_cast<std::uint8_t>(k);  // no two files of the same content
    image.data()[1] = static_cast<std::uint8_t>(k / 256);
    FiducialCapture c;
    c.image = fmt::format("{}.png", k);
    c.fiducial = "F1";
    c.state = fmt::format("M{}", k / scenes);
    folder.write(c.image, encodePng(image));
    list.captures.push_back(c);
  }
  const auto measure = [&](int threads) {
    ::setenv("SPINDRIFT_THREADS", fmt::format("{}", threads).c_str(), 1);
    const double own = processor_s(RUSAGE_THREAD), all = processor_s(RUSAGE_SELF), begin = wall_s();
    const FiducialImages result = measureFiducialImages(folder.path(), list, standardPattern(), JobContext());
    const double wall = wall_s() - begin;
    const double shared = (processor_s(RUSAGE_THREAD) - own) / (processor_s(RUSAGE_SELF) - all);
    fmt::print(
        "{} images on {} threads: {:.2f} s, {:.1f} ms of processor each, {} refused; {:.1f} % of the processor "
        "time on the first thread\n",
        images, threads, wall, 1e3 * (processor_s(RUSAGE_SELF) - all) / images, result.rejected.size(), 100.0 * shared);
    return std::pair(wall, shared);
  };
  const double one = measure(1).first;
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  fmt::print("speed-up on {} cores {:.2f}\n", cores, one / measure(cores).first);
  // With many threads the first has its share and all that only one can do.
  constexpr int many = 16;
  const double serial = std::max(0.0, (measure(many).second - 1.0 / many) / (1.0 - 1.0 / many));
  fmt::print("part that only one thread can do: {:.1f} %, so at most {:.2f} on {} cores\n", 100.0 * serial,
             1.0 / (serial + (1.0 - serial) / cores), cores);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "folder") == 0) {
    folderSpeed(argc > 2 ? std::atoi(argv[2]) : 1000);
    return 0;
  }
  const int campaigns = argc > 1 ? std::atoi(argv[1]) : 20;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  const double quantile = normalQuantile(0.975);
  std::map<std::string, Tally> displacement;
  Tally all;
  std::array<Tally, nine_parameter_count> each;
  JobContext job;
  for (int c = 0; c < campaigns; ++c) {
    Random random(seed * 1000003ULL + static_cast<std::uint64_t>(c));
    NineVector truth;
    const VirtualFiducialOptions options = drawOptions(random, truth);
    const testing::TempFolder folder;
    writeVirtualFiducialCampaign(folder / "campaign", standardPattern(), options, random.bits(), job);
    const InstrumentEvaluation evaluation = evaluateFiducials(Campaign::read(folder / "campaign"), job);
    for (const Observation& o : evaluation.observations.rows) {
      if (o.state != "M1") continue;
      const double expected = nineParameterRow(o.position_mm, o.component).dot(truth);
      displacement[std::string(toString(o.component))].add(o.value - expected, std::sqrt(2.0) * o.sigma, quantile);
    }
    const NineParameterFit fit = fitNineParameters(evaluation.observations, {});
    for (int i = 0; i < nine_parameter_count; ++i) {
      if (!fit.determined(i)) continue;
      const double error = fit.parameters(i) - truth(i);
      all.add(error, fit.standardUncertainty(i), quantile);
      each[static_cast<std::size_t>(i)].add(error, fit.standardUncertainty(i), quantile);
    }
  }
  fmt::print("{} campaigns of five fiducials in two states, {} images each\n", campaigns, 2 * 5 * 14);
  for (const auto& [name, tally] : displacement) tally.print("displacement " + name, "um");
  for (int i = 0; i < nine_parameter_count; ++i) {
    each[static_cast<std::size_t>(i)].print(std::string(nine_parameter_names[static_cast<std::size_t>(i)]),
                                            std::string(nineParameterUnit(i)).c_str());
  }
  all.print("all parameters", "");
  return 0;
}
