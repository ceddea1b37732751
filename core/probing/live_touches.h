// SPDX-License-Identifier: Apache-2.0
// Judges every touch while the operator still stands at the machine: the right feature, where it should be, in line
// with the first cycle, and in agreement with the other touches of its feature.
//
//   place    distance from where the touch should trigger: hole wall c + (D/2 - r) n, surface height r above the bar,
//            ball c - (D/2 + r) n with the first ball where the touches so far put it; over `misplaced_mm`: another
//            feature is named if it fits
//   change   along the approach since the same touch of the first cycle, over `largest_change_um`: not warming
//   spread   when all touches of a feature are there: what a displacement of the feature leaves of the changes (first
//            cycle: what a circle or sphere leaves of the positions); over `spread_um` the touches that disagree are
//            named, and the feature is to be touched again
//   surface  surface touches of a hole bar against those of all other holes and table angles of the cycle
//            (surface_heights.h): their heights in the first cycle, beyond `surface_um`, later their changes, beyond
//            `spread_um`. They are given out when that is known. Taken again with the same height, it is the bar.
// A touch that was asked for again replaces the implausible one with the same number.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "core/math/running_median.h"
#include "core/probing/feature.h"
#include "core/probing/touch.h"

namespace spindrift {

struct LiveTouchOptions {
  double misplaced_mm = 1.0;
  double largest_change_um = 400.0;
  double spread_um = 15.0;
  double surface_um = 30.0;  ///< a surface touch off the plane of the others, first cycle
  /// Throws InputError.
  void validate() const;
};

struct LiveTouch {
  Touch touch;
  bool plausible = true;
  std::string reason;                                                   ///< why not, one sentence
  double from_nominal_mm = std::numeric_limits<double>::quiet_NaN();    ///< NaN: nothing to compare with
  double change_um = std::numeric_limits<double>::quiet_NaN();          ///< along the approach, since the first cycle
  double feature_spread_um = std::numeric_limits<double>::quiet_NaN();  ///< NaN until the feature is complete
  bool replaced = false;                                                ///< by a touch that was taken again
  bool given_out = false;                                               ///< by takeFinished()
  bool surface_judged = false;  ///< a surface touch: enough others are there to compare it with
  bool confirmed = false;       ///< a surface touch that was taken again with the same height
};

struct LiveProgress {
  std::string cycle, feature, stylus;
  double c_deg = 0.0;
  int done = 0;      ///< touches of the cycle that are plausible
  int expected = 0;  ///< as in the first cycle; 0: not known yet
  std::string next;  ///< "H4, touch 2 at 90 deg", empty if not known
};

class LiveTouches {
 public:
  explicit LiveTouches(MachineDescription machine, const LiveTouchOptions& options = {});

  /// Touches that are in the campaign already: known, plausible, not given out again.
  void seed(const TouchList& list);
  /// Number of touches in the first cycle, if a plan says so.
  void expect(int touches) { planned_ = touches; }
  /// Judges a touch; false if it is known already (the file was read again).
  bool add(const Touch& given);

  [[nodiscard]] const std::vector<LiveTouch>& touches() const { return touches_; }
  /// Indices of touches that are not settled: not given out yet, or to be taken again.
  [[nodiscard]] const std::set<std::size_t>& open() const { return open_; }
  [[nodiscard]] LiveProgress progress() const;
  /// What to touch again, one sentence each; empty if nothing is.
  [[nodiscard]] std::vector<std::string> retakes() const;
  /// Plausible touches whose feature is finished (another one has begun, or `all`) and that were not given out before,
  /// in order of time: ready for the campaign.
  [[nodiscard]] std::vector<Touch> takeFinished(bool all);

 private:
  using Key = std::string;
  [[nodiscard]] static Key keyOf(const Touch& t);                 ///< within a cycle
  [[nodiscard]] static std::string placeKeyOf(const Touch& t);    ///< artefact, feature, stylus, angle
  [[nodiscard]] static std::string featureKeyOf(const Touch& t);  ///< the same with the cycle
  void forgetFirst(const Touch& t);
  /// What follows from the flags of a touch, which have changed.
  void settle(std::size_t index);
  void reject(std::size_t index, std::string reason);
  void judgePlace(LiveTouch& live);
  void judgeChange(LiveTouch& live);
  void judgeFeature(std::size_t last);
  void judgeSurface(const Touch& last);
  [[nodiscard]] bool waitsForOthers(const LiveTouch& live) const;
  [[nodiscard]] std::optional<double> distance(const Touch& t, const Artefact& artefact, const std::string& feature,
                                               double radius_mm) const;

  MachineDescription machine_;
  LiveTouchOptions options_;
  std::vector<LiveTouch> touches_;
  std::map<std::string, std::size_t> index_;                  ///< cycle and key -> last touch with it
  std::map<std::string, std::vector<std::size_t>> features_;  ///< feature key -> its touches
  std::map<std::string, std::vector<std::size_t>> cycles_;    ///< cycle -> its touches
  std::map<std::tuple<std::string, std::string, std::string>, std::vector<std::size_t>>
      surfaces_;  ///< cycle, artefact, stylus -> surface touches of a bar
  std::set<std::size_t> open_;
  std::vector<Key> first_order_;                 ///< of the first cycle
  std::set<Key> first_keys_;                     ///< the same, to look up
  std::map<Key, Touch> first_;                   ///< its plausible touches
  std::map<std::string, int> first_in_feature_;  ///< feature key without cycle -> how many of `first_`
  std::string first_cycle_;
  std::map<std::string, std::array<RunningMedian, 3>> first_ball_;  ///< artefact -> where touches put the first ball
  std::map<std::string, double> last_time_;                         ///< per artefact
  int planned_ = 0;
  TableAngles angles_;
};

}  // namespace spindrift
