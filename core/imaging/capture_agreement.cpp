// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/capture_agreement.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/base/printed_number.h"
#include "core/base/units.h"
#include "core/imaging/axis_directions.h"
#include "core/imaging/decoder.h"
#include "core/imaging/pattern.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

/// Commanded positions closer than this are one.
constexpr double same_position_mm = 1e-4;
constexpr double same_height_mm = 0.005;

bool ofOneSet(const SeenCapture& a, const SeenCapture& b) {
  return a.fiducial == b.fiducial && a.state == b.state;
}

std::string nameOf(const SeenCapture& c) {
  switch (c.role) {
    case CaptureRole::Rotation:
      return fmt::format("rotation {}", c.index);
    case CaptureRole::XAxis:
      return fmt::format("x_axis {}", c.index);
    case CaptureRole::YAxis:
      return fmt::format("y_axis {}", c.index);
    case CaptureRole::Focus:
      return fmt::format("focus {}", c.index);
  }
  return {};
}

/// One decimal at most, without minus zero.
std::string degrees(double value_deg) {
  return printedNumber(std::round(10.0 * value_deg) / 10.0, "g");
}

/// How far the spindle turned from `from` to `to`, as the images show it.
double turned_deg(const SeenCapture& from, const SeenCapture& to) {
  return -angleDifference(to.pose->orientation_rad(), from.pose->orientation_rad()) * deg_per_rad;
}

/// The pixel of the spindle's axis (undistorted, about the centre of the image) in a state, if its images tell.
std::optional<Eigen::Vector2d> axisPixel(const std::string& state, const std::vector<SeenCapture>& captures,
                                         const AgreementOptions& options) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < captures.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const SeenCapture& a = captures[i];
      const SeenCapture& b = captures[j];
      if (a.state != state || !ofOneSet(a, b) || !a.pose || !b.pose) continue;
      if ((a.position_mm - b.position_mm).head<2>().norm() > same_position_mm) continue;
      const double turn = turned_deg(a, b);
      // Images that do not show the commanded turn say nothing of the axis.
      const double off = std::remainder(turn - (b.spindle_deg - a.spindle_deg), 360.0);
      if (std::abs(turn) < 2.0 * options.turn_deg || std::abs(off) > options.turn_deg) continue;
      const Eigen::Matrix2d difference = a.pose->patternPerPixel() - b.pose->patternPerPixel();
      const Eigen::Vector2d q = difference.inverse() * (a.pose->patternPerPixel() * a.pose->origin_px -
                                                        b.pose->patternPerPixel() * b.pose->origin_px);
      x.push_back(q.x());
      y.push_back(q.y());
    }
  }
  if (x.empty()) return std::nullopt;
  return Eigen::Vector2d(median(x), median(y));
}

/// What two images of one set say about each other.
enum class Verdict { Unknown, Agree, Turn, Place };

struct Comparison {
  Verdict verdict = Verdict::Unknown;
  double shown_um = 0.0;
  double commanded_um = 0.0;
};

Comparison compare(const SeenCapture& a, const SeenCapture& b, const std::optional<Eigen::Vector2d>& axis_pixel,
                   const AgreementOptions& options) {
  Comparison c;
  if (!ofOneSet(a, b) || !a.pose || !b.pose) return c;
  const double turn = turned_deg(b, a);
  if (std::abs(std::remainder(turn - (a.spindle_deg - b.spindle_deg), 360.0)) > options.turn_deg) {
    c.verdict = Verdict::Turn;
    return c;
  }
  const bool one_orientation = std::abs(turn) < options.same_turn_deg;
  c.verdict = Verdict::Agree;
  if (!one_orientation && !axis_pixel) return c;
  const Eigen::Vector2d q = one_orientation ? Eigen::Vector2d(Eigen::Vector2d::Zero()) : *axis_pixel;
  c.shown_um = (a.pose->patternAt(q) - b.pose->patternAt(q)).norm();
  c.commanded_um = (a.position_mm - b.position_mm).head<2>().norm() * um_per_mm;
  // The camera need not look straight along the spindle: over a focus series the image wanders.
  const bool focus = a.role == CaptureRole::Focus || b.role == CaptureRole::Focus;
  const double allowed = one_orientation && !focus ? options.place_um : options.turned_place_um;
  if (std::abs(c.shown_um - c.commanded_um) > allowed) c.verdict = Verdict::Place;
  return c;
}

std::string sentenceOf(const SeenCapture& seen, const SeenCapture& other, const Comparison& c,
                       const AgreementOptions& options) {
  if (c.verdict == Verdict::Turn) {
    const double commanded = seen.spindle_deg - other.spindle_deg;
    const double shown = commanded + std::remainder(turned_deg(other, seen) - commanded, 360.0);
    return fmt::format("The image is turned by {}°, {} {}° (against {} of {} in {}).", degrees(shown),
                       options.commanded, degrees(commanded), nameOf(other), other.fiducial, other.state);
  }
  const std::string sentence =
      fmt::format("The pattern is shifted by {:.0f} µm, {} {:.0f} µm (against {} of {} in {})", c.shown_um,
                  options.commanded, c.commanded_um, nameOf(other), other.fiducial, other.state);
  return sentence + (c.commanded_um < 1.0 ? ": another fiducial, or not at its position." : ".");
}

/// How many other images of the set speak against one, and one of them as witness.
struct Vote {
  int against = 0;
  int voters = 0;
  const SeenCapture* witness = nullptr;
  Comparison comparison;

  [[nodiscard]] bool lost() const { return 2 * against > voters; }
};

Vote voteOn(const SeenCapture& seen, const std::vector<const SeenCapture*>& others,
            const std::optional<Eigen::Vector2d>& axis_pixel, const AgreementOptions& options) {
  Vote vote;
  for (const SeenCapture* other : others) {
    const Comparison c = compare(seen, *other, axis_pixel, options);
    if (c.verdict == Verdict::Unknown) continue;
    ++vote.voters;
    if (c.verdict == Verdict::Agree) continue;
    ++vote.against;
    // A turn says more than a shift, which may follow from it.
    if (vote.witness != nullptr && (vote.comparison.verdict == Verdict::Turn || c.verdict == Verdict::Place)) continue;
    vote.witness = other;
    vote.comparison = c;
  }
  return vote;
}

std::string sharpnessContradiction(const SeenCapture& seen, const std::vector<const SeenCapture*>& others,
                                   const AgreementOptions& options) {
  if (seen.role != CaptureRole::Focus || !(seen.sharpness > 0.0)) return {};
  const SeenCapture* below = nullptr;
  const SeenCapture* above = nullptr;
  for (const SeenCapture* other : others) {
    if (!ofOneSet(seen, *other) || !(options.least_sharpness * other->sharpness > seen.sharpness)) continue;
    const double higher = other->position_mm.z() - seen.position_mm.z();
    if (std::abs(higher) < same_height_mm) {
      return fmt::format(
          "The image is out of focus for its height of {:g} mm: sharpness {:.3f}, {} of {} in {} has "
          "{:.3f} there.",
          seen.position_mm.z(), seen.sharpness, nameOf(*other), other->fiducial, other->state, other->sharpness);
    }
    const SeenCapture*& side = higher > 0.0 ? above : below;
    if (side == nullptr || other->sharpness > side->sharpness) side = other;
  }
  if (below == nullptr || above == nullptr) return {};
  return fmt::format(
      "The image is out of focus for its height of {:g} mm: sharpness {:.3f}, below it at {:g} mm {:.3f} "
      "and above it at {:g} mm {:.3f}.",
      seen.position_mm.z(), seen.sharpness, below->position_mm.z(), below->sharpness, above->position_mm.z(),
      above->sharpness);
}

}  // namespace

std::optional<ImagePose> poseOf(const DecodeResult& decoded, const FiducialPattern& pattern) {
  if (!decoded.usable()) return std::nullopt;
  ImagePose pose = fitImagePose(markPositions(decoded, pattern), {decoded.map.centre_x_px, decoded.map.centre_y_px},
                                decoded.map.k1_per_px2, decoded.map.mirrored);
  if (pose.status != FitStatus::Converged) return std::nullopt;
  return pose;
}

std::string contradictionOf(const SeenCapture& seen, const std::vector<SeenCapture>& others,
                            const AgreementOptions& options) {
  std::vector<const SeenCapture*> set;
  for (const SeenCapture& other : others) {
    if (ofOneSet(seen, other)) set.push_back(&other);
  }
  const Vote vote = voteOn(seen, set, axisPixel(seen.state, others, options), options);
  if (vote.lost()) return sentenceOf(seen, *vote.witness, vote.comparison, options);
  return sharpnessContradiction(seen, set, options);
}

std::vector<std::string> contradictionsOf(const std::vector<SeenCapture>& captures, const AgreementOptions& options) {
  std::vector<std::string> sentences(captures.size());
  std::vector<bool> settled(captures.size(), false);
  for (std::size_t first = 0; first < captures.size(); ++first) {
    if (settled[first]) continue;
    const std::optional<Eigen::Vector2d> axis_pixel = axisPixel(captures[first].state, captures, options);
    std::vector<std::size_t> set;
    for (std::size_t i = first; i < captures.size(); ++i) {
      if (!ofOneSet(captures[first], captures[i])) continue;
      settled[i] = true;
      set.push_back(i);
    }
    const auto othersOf = [&](std::size_t i) {
      std::vector<const SeenCapture*> others;
      for (const std::size_t k : set) {
        if (k != i) others.push_back(&captures[k]);
      }
      return others;
    };
    for (;;) {
      std::size_t worst = captures.size();
      Vote most;
      for (const std::size_t i : set) {
        const Vote vote = voteOn(captures[i], othersOf(i), axis_pixel, options);
        if (vote.against > 0 && 2 * vote.against >= vote.voters && vote.against >= most.against) {
          worst = i;
          most = vote;
        }
      }
      if (worst == captures.size()) break;
      sentences[worst] = sentenceOf(captures[worst], *most.witness, most.comparison, options);
      std::erase(set, worst);
    }
    for (const std::size_t i : set) {
      if (sentences[i].empty()) sentences[i] = sharpnessContradiction(captures[i], othersOf(i), options);
    }
  }
  return sentences;
}

}  // namespace spindrift
