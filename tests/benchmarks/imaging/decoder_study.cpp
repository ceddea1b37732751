// SPDX-License-Identifier: GPL-3.0-or-later
// Accuracy and speed of the decoder on rendered images; the time also as a ratio to OpenCV's in the same run.
//   decoder_study              accuracy over clean and hard images, then time beside OpenCV's marker detector
//   decoder_study [--marks] IMAGE ...    decodes files, one line each and one per mark
//   decoder_study --speed IMAGE ...      time of the first decoding of each file and of further ones, page faults of
//                                        the first, thresholding and components of the same file
// Options: --images N, --keep PREFIX (overlays), --speed (time only),
// --each (one line an image). Times are processor times of one thread.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <numbers>
#include <opencv2/aruco.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/imaging/decoder.h"
#include "core/simulation/virtual_microscope.h"
#include "tests/support/scene_truth.h"

namespace {

using namespace spindrift;

struct Tally {
  int images = 0, refused = 0;
  int in_view = 0, decoded = 0, wrong = 0;
  double error2 = 0.0, z2 = 0.0, worst = 0.0;
  long coordinates = 0;
  int circles_in_view = 0, circles = 0;
  double circle_error2 = 0.0, circle_z2 = 0.0;
  long circle_coordinates = 0;
  double pixel_length_z2 = 0.0, k1_z2 = 0.0;
  double milliseconds = 0.0;
};

MicroscopeScene randomScene(Random& random, bool hard) {
  MicroscopeScene scene;
  const double pixel = random.uniform(0.8, 2.5);
  const double tilt = random.uniform(-std::numbers::pi, std::numbers::pi);
  const Eigen::Vector2d at(random.uniform(300, 2500), random.uniform(300, 2500));
  scene.map =
      poseAt(scene.width_px, scene.height_px, pixel, tilt, at,
             {0.5 * scene.width_px + random.uniform(-100, 100), 0.5 * scene.height_px + random.uniform(-60, 60)},
             random.uniform(-3e-9, 3e-9));
  if (hard) {
    scene.blur_sigma_px = random.uniform(1.0, 3.0);
    scene.noise_level = random.uniform(3.0, 8.0);
    const double direction = random.uniform(0, 2.0 * std::numbers::pi);
    scene.gradient_x = 0.66 * std::cos(direction);
    scene.gradient_y = 0.66 * std::sin(direction);
    scene.vignetting = random.uniform(0, 0.2);
    scene.jpeg_quality = static_cast<int>(random.uniform(75, 96));
    scene.dust = 25;
    scene.scratches = 4;
    scene.screws = 1;
    scene.foreign_texts = 1;
    const SceneTruth truth = sceneTruth(standardPattern(), scene);
    for (const auto& mark : truth.ellipses) {
      if (random.uniform() < 0.1) scene.damaged_digits.emplace_back(mark.a, mark.b);
    }
  } else {
    scene.blur_sigma_px = random.uniform(0.7, 1.5);
    scene.noise_level = 1.0;
  }
  return scene;
}

bool each_image = false;

void addImage(Tally& tally, const MicroscopeScene& scene, std::uint64_t seed, const char* keep) {
  const FiducialPattern& pattern = standardPattern();
  const GrayImage image = renderFiducial(pattern, scene, seed);
  const DecodeResult result = decodeImage(image, standardPattern());
  const SceneTruth truth = sceneTruth(pattern, scene, 2.0);
  const SceneTruth any = sceneTruth(pattern, scene, -40.0);
  const Tally before = tally;
  ++tally.images;
  tally.milliseconds += result.elapsed_ms;
  tally.in_view += static_cast<int>(truth.ellipses.size());
  tally.circles_in_view += static_cast<int>(truth.circles.size());
  if (!result.usable()) {
    ++tally.refused;
    std::printf("  image %llu: %s (pixel %.2f um, blur %.1f px, noise %.1f)\n", static_cast<unsigned long long>(seed),
                result.message.c_str(), scene.map.pixel_length_um, scene.blur_sigma_px, scene.noise_level);
  }
  for (const auto& mark : truth.ellipses) tally.decoded += result.find(mark.a, mark.b) != nullptr;
  for (const Subpattern& s : result.subpatterns) {
    const auto found = std::find_if(any.ellipses.begin(), any.ellipses.end(),
                                    [&](const SceneTruth::Mark& m) { return m.a == s.row && m.b == s.column; });
    const double dx = found == any.ellipses.end() ? 1e3 : s.x_px - found->x_px;
    const double dy = found == any.ellipses.end() ? 1e3 : s.y_px - found->y_px;
    if (std::hypot(dx, dy) > 1.0) {
      ++tally.wrong;
      std::printf("  image %llu: ellipse %d,%d is off by %.2f px\n", static_cast<unsigned long long>(seed), s.row,
                  s.column, std::hypot(dx, dy));
      continue;
    }
    if (each_image && (dx * dx / s.covariance_px2(0, 0) + dy * dy / s.covariance_px2(1, 1)) > 18.0) {
      std::printf("  ellipse %d,%d off by %.4f %.4f, sigma %.4f\n", s.row, s.column, dx, dy, s.sigma_px);
    }
    tally.error2 += dx * dx + dy * dy;
    tally.worst = std::max({tally.worst, std::abs(dx), std::abs(dy)});
    tally.z2 += dx * dx / s.covariance_px2(0, 0) + dy * dy / s.covariance_px2(1, 1);
    tally.coordinates += 2;
  }
  for (const CircleMark& c : result.circles) {
    const auto found = std::find_if(any.circles.begin(), any.circles.end(),
                                    [&](const SceneTruth::Mark& m) { return m.a == c.i && m.b == c.j; });
    if (found == any.circles.end()) continue;
    const double e2 = std::pow(c.x_px - found->x_px, 2) + std::pow(c.y_px - found->y_px, 2);
    tally.circle_error2 += e2;
    tally.circle_z2 += e2 / (c.sigma_px * c.sigma_px);
    tally.circle_coordinates += 2;
    ++tally.circles;
  }
  if (result.usable()) {
    tally.pixel_length_z2 +=
        std::pow((result.map.pixel_length_um - scene.map.pixel_length_um) / result.pixel_length_sigma_um, 2);
    if (std::isfinite(result.k1_sigma_per_px2)) {
      tally.k1_z2 += std::pow((result.map.k1_per_px2 - scene.map.k1_per_px2) / result.k1_sigma_per_px2, 2);
    }
  }
  if (keep != nullptr) {
    writeFileAtomically(std::string(keep) + std::to_string(seed) + ".png",
                        encodePng(decodeOverlay(image, pattern, result)));
  }
  if (each_image) {
    std::printf("image %llu: pixel %.2f um, blur %.2f px, noise %.1f: rms %.4f px, error/sigma %.2f\n",
                static_cast<unsigned long long>(seed), scene.map.pixel_length_um, scene.blur_sigma_px,
                scene.noise_level, std::sqrt((tally.error2 - before.error2) / (tally.coordinates - before.coordinates)),
                std::sqrt((tally.z2 - before.z2) / static_cast<double>(tally.coordinates - before.coordinates)));
  }
}

void print(const char* name, const Tally& t) {
  std::printf(
      "%-6s %3d images (%d refused): ellipses %d of %d decoded (%.2f %%), wrong %d; centre rms %.4f px (worst %.3f), "
      "error/sigma rms %.2f; circles %d of %d, rms %.4f px, error/sigma %.2f; pixel length error/sigma %.2f, k1 %.2f; "
      "mean %.1f ms\n",
      name, t.images, t.refused, t.decoded, t.in_view, 100.0 * t.decoded / std::max(1, t.in_view), t.wrong,
      std::sqrt(t.error2 / std::max(1L, t.coordinates)), t.worst, std::sqrt(t.z2 / std::max(1L, t.coordinates)),
      t.circles, t.circles_in_view, std::sqrt(t.circle_error2 / std::max(1L, t.circle_coordinates)),
      std::sqrt(t.circle_z2 / std::max(1L, t.circle_coordinates)),
      std::sqrt(t.pixel_length_z2 / std::max(1, t.images - t.refused)),
      std::sqrt(t.k1_z2 / std::max(1, t.images - t.refused)), t.milliseconds / std::max(1, t.images));
}

template <typename Work>
double medianMilliseconds(int repeats, const Work& work) {
  std::vector<double> times;
  for (int k = 0; k < repeats; ++k) {
    const std::clock_t start = std::clock();
    work();
    times.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 4];
}

/// 28 markers on a 1920 x 1080 frame.
cv::Mat markerFrame(double noise) {
  cv::Mat frame(1080, 1920, CV_8UC1, cv::Scalar(200));
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
  for (int k = 0; k < 28; ++k) {
    cv::Mat marker;
    cv::aruco::drawMarker(dictionary, k, 150, marker, 1);
    marker.copyTo(frame(cv::Rect(60 + (k % 7) * 260, 50 + (k / 7) * 255, 150, 150)));
  }
  cv::GaussianBlur(frame, frame, cv::Size(0, 0), 1.0);
  Random random(5);
  for (int y = 0; y < frame.rows; ++y) {
    for (int x = 0; x < frame.cols; ++x) {
      frame.at<uchar>(y, x) = cv::saturate_cast<uchar>(frame.at<uchar>(y, x) + random.normal(0.0, noise));
    }
  }
  return frame;
}

/// Thresholding and connected components of an image by OpenCV, ms of the processor.
double componentsMilliseconds(const GrayImage& image) {
  const cv::Mat seen(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.data()));
  cv::Mat bright;
  cv::Mat labels;
  return medianMilliseconds(9, [&] {
    cv::adaptiveThreshold(seen, bright, 255, cv::ADAPTIVE_THRESH_MEAN_C, cv::THRESH_BINARY, 65, -12);
    cv::connectedComponents(bright, labels, 8, CV_32S);
  });
}

long pageFaults() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return use.ru_minflt;
}

/// What the first decoding of an image costs beside further ones; the first line is the first of the process.
void speedOf(const char* file) {
  const GrayImage image = readImage(file);
  DecodeResult result;
  const long faults = pageFaults();
  const std::clock_t start = std::clock();
  result = decodeImage(image, standardPattern());
  const double first = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const long first_faults = pageFaults() - faults;
  const double again = medianMilliseconds(9, [&] { result = decodeImage(image, standardPattern()); });
  std::printf(
      "%s: first %.2f ms (%ld page faults), again %.2f ms (%zu ellipses, %zu circles%s); thresholding and components "
      "%.2f ms\n",
      file, first, first_faults, again, result.subpatterns.size(), result.circles.size(),
      result.usable() ? "" : ", refused", componentsMilliseconds(image));
}

void speed() {
  cv::setNumThreads(1);
  const cv::Mat frame = markerFrame(0.0);  // without noise, which makes the marker detector slower
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
  const auto parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  for (const double pixel : {0.8, 1.2314, 1.6, 2.5}) {
    for (const bool hard : {false, true}) {
      Random random(77);
      MicroscopeScene scene = randomScene(random, hard);
      scene.map = poseAt(1920, 1080, pixel, 0.3, {1400, 1400}, {960, 540});
      scene.damaged_digits.clear();
      const GrayImage image = renderFiducial(standardPattern(), scene, 3);
      DecodeResult result;
      std::vector<double> ratios;
      std::vector<double> over_components;
      double own = 0.0;
      double aruco = 0.0;
      double components = 0.0;
      for (int round = 0; round < 5; ++round) {
        aruco = medianMilliseconds(9, [&] { cv::aruco::detectMarkers(frame, dictionary, corners, ids, parameters); });
        own = medianMilliseconds(9, [&] { result = decodeImage(image, standardPattern()); });
        components = componentsMilliseconds(image);
        ratios.push_back(own / aruco);
        over_components.push_back(own / components);
      }
      std::sort(ratios.begin(), ratios.end());
      std::sort(over_components.begin(), over_components.end());
      std::printf(
          "time, pixel %.2f um %s: decode %.2f ms (%zu ellipses, %zu circles), ArUco %.2f ms (%zu markers), ratio "
          "%.2f; adaptive threshold and components of the same image %.2f ms, ratio %.2f\n",
          pixel, hard ? "hard " : "clean", own, result.subpatterns.size(), result.circles.size(), aruco, ids.size(),
          ratios[ratios.size() / 2], components, over_components[over_components.size() / 2]);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  int images = 40;
  const char* keep = nullptr;
  bool files = false;
  bool only_speed = false;
  bool marks = false;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--images") == 0 && k + 1 < argc) {
      images = std::atoi(argv[++k]);
    } else if (std::strcmp(argv[k], "--keep") == 0 && k + 1 < argc) {
      keep = argv[++k];
    } else if (std::strcmp(argv[k], "--speed") == 0) {
      only_speed = true;
    } else if (std::strcmp(argv[k], "--each") == 0) {
      each_image = true;
    } else if (std::strcmp(argv[k], "--marks") == 0) {
      marks = true;
    } else {
      files = true;
      if (only_speed) {
        speedOf(argv[k]);
        continue;
      }
      const GrayImage image = readImage(argv[k]);
      const DecodeResult r = decodeImage(image, standardPattern());
      int doubtful = 0;
      double sigma = 0.0;
      for (const Subpattern& s : r.subpatterns) {
        doubtful += s.from_neighbours;
        sigma += s.sigma_px / static_cast<double>(r.subpatterns.size());
      }
      std::printf(
          "%s: %s; pixel %.5f +- %.5f um, tilt %.5f, k1 %.3g +- %.2g, blur %.2f px, noise %.1f, contrast %.0f, sigma "
          "%.4f px, map rms %.4f px chi2/dof %.2f, %d by neighbours, %.1f ms\n",
          argv[k], r.message.c_str(), r.map.pixel_length_um, r.pixel_length_sigma_um, r.map.tilt_rad, r.map.k1_per_px2,
          r.k1_sigma_per_px2, r.exposure.blur_sigma_px, r.exposure.noise_level, r.exposure.contrast, sigma,
          r.map_rms_px, r.map_chi2_per_dof, doubtful, r.elapsed_ms);
      if (marks) {
        for (const Subpattern& m : r.subpatterns) {
          std::printf("ellipse,%d,%d,%.4f,%.4f,%.4f,%.4f,%.4f,%.3f,%.3f\n", m.row, m.column, m.x_px, m.y_px, m.sigma_px,
                      m.residual_x_px, m.residual_y_px, m.score, m.digit_confidence);
        }
        for (const CircleMark& c : r.circles) {
          const Eigen::Vector2d at = r.map.imageOf(standardPattern().circleCentre(c.i, c.j));
          std::printf("circle,%d,%d,%.4f,%.4f,%.4f,%.4f,%.4f,%.3f,\n", c.i, c.j, c.x_px, c.y_px, c.sigma_px,
                      c.x_px - at.x(), c.y_px - at.y(), c.score);
        }
      }
      if (keep != nullptr) {
        writeFileAtomically(std::string(keep) + std::to_string(k) + ".png",
                            encodePng(decodeOverlay(image, standardPattern(), r)));
      }
    }
  }
  if (files) return 0;
  if (!only_speed) {
    for (const bool hard : {false, true}) {
      Tally tally;
      Random random(hard ? 2 : 1);
      for (int k = 0; k < images; ++k) {
        const MicroscopeScene scene = randomScene(random, hard);
        addImage(tally, scene, static_cast<std::uint64_t>(k + (hard ? 1000 : 0)), k < 3 ? keep : nullptr);
      }
      print(hard ? "hard" : "clean", tally);
    }
  }
  speed();
  return 0;
}
