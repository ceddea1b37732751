// SPDX-License-Identifier: Apache-2.0
#include "core/probing/live_touches.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/probing/hole_cycle.h"
#include "core/probing/surface_heights.h"

namespace spindrift {
namespace {

/// Taken again within this distance, a touch shows what is there.
constexpr double confirmed_mm = 0.01;

/// Largest residual per touch after a displacement of the feature (mm), and which touches are about as large.
struct Disagreement {
  double spread_um = 0.0;
  std::vector<std::size_t> suspects;
};

Disagreement disagreementOf(const Eigen::MatrixXd& rows, const Eigen::VectorXd& changes_um) {
  Disagreement d;
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(rows);
  if (rows.rows() <= solver.rank()) return d;
  const Eigen::VectorXd residual = (changes_um - rows * solver.solve(changes_um)).cwiseAbs();
  d.spread_um = residual.maxCoeff();
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    if (residual(i) > 0.9 * d.spread_um) d.suspects.push_back(static_cast<std::size_t>(i));
  }
  return d;
}

}  // namespace

void LiveTouchOptions::validate() const {
  if (!(misplaced_mm > 0.0)) throw InputError("the largest distance from the nominal place must be positive (mm).");
  if (!(largest_change_um > 0.0)) throw InputError("the largest change since the first cycle must be positive (µm).");
  if (!(surface_um > 0.0))
    throw InputError("the largest distance from the plane of the surface must be positive (µm).");
  if (!(spread_um > 0.0)) throw InputError("the largest spread within a feature must be positive (µm).");
}

LiveTouches::LiveTouches(MachineDescription machine, const LiveTouchOptions& options)
    : machine_(std::move(machine)), options_(options) {
  options_.validate();
}

LiveTouches::Key LiveTouches::keyOf(const Touch& t) {
  return fmt::format("{}|{}|{}|{:g}|{}", t.artefact, t.feature, t.stylus, t.c_deg, t.touch);
}

std::string LiveTouches::placeKeyOf(const Touch& t) {
  return fmt::format("{}|{}|{}|{:g}", t.artefact, t.feature, t.stylus, t.c_deg);
}

std::string LiveTouches::featureKeyOf(const Touch& t) {
  return t.cycle + "|" + placeKeyOf(t);
}

void LiveTouches::settle(std::size_t index) {
  const LiveTouch& live = touches_[index];
  if (!live.replaced && (!live.given_out || !live.plausible)) {
    open_.insert(index);
  } else {
    open_.erase(index);
  }
}

void LiveTouches::reject(std::size_t index, std::string reason) {
  touches_[index].plausible = false;
  touches_[index].reason = std::move(reason);
  settle(index);
}

void LiveTouches::forgetFirst(const Touch& t) {
  if (first_.erase(keyOf(t)) > 0) --first_in_feature_[placeKeyOf(t)];
}

void LiveTouches::seed(const TouchList& list) {
  for (const Touch& t : list.touches) {
    if (!add(t)) continue;
    touches_.back().given_out = true;
    touches_.back().plausible = true;
    touches_.back().reason.clear();
    settle(touches_.size() - 1);
  }
}

std::optional<double> LiveTouches::distance(const Touch& t, const Artefact& artefact, const std::string& feature,
                                            double radius_mm) const {
  if (artefact.kind == "hole_bar") {
    const HoleBarSetup setup = HoleBarSetup::of(machine_, artefact);
    const Eigen::Vector3d& axis = setup.rotary_direction;
    const Eigen::Vector3d from = t.position_mm - setup.nominal_mm(HoleBarSetup::holeIndex(feature), t.c_deg);
    if (isSurfaceTouch(t, axis)) {
      // Beside the hole: somewhere near it, its height as of the bar.
      const double across = (from - axis * from.dot(axis)).norm();
      return std::max(std::abs(from.dot(axis) - radius_mm), std::max(0.0, across - 20.0));
    }
    const double reach = artefact.hole_diameter_mm ? 0.5 * *artefact.hole_diameter_mm - radius_mm
                                                   : from.dot(t.approach);  // along the approach nothing is known
    const Eigen::Vector3d off = from - reach * t.approach;
    return (off - axis * off.dot(axis)).norm();
  }
  const auto ball = std::find_if(artefact.balls.begin(), artefact.balls.end(),
                                 [&](const ArtefactBall& b) { return b.id == feature; });
  const auto known = first_ball_.find(artefact.id);
  if (ball == artefact.balls.end() || known == first_ball_.end()) return std::nullopt;
  const auto& median = known->second;
  const Eigen::Vector3d place(median[0].value(), median[1].value(), median[2].value());
  const Eigen::Vector3d expected = place + ball->certified_mm - (0.5 * ball->diameter_mm + radius_mm) * t.approach;
  return (t.position_mm - expected).norm();
}

void LiveTouches::judgePlace(LiveTouch& live) {
  const Touch& t = live.touch;
  const auto reject = [&](std::string reason) {
    live.plausible = false;
    live.reason = std::move(reason);
  };
  const Artefact* artefact = machine_.findArtefact(t.artefact);
  if (artefact == nullptr) {
    return reject(fmt::format("artefact \"{}\" is not in the machine file; allowed: {}", t.artefact,
                              allowedIds(machine_.artefacts)));
  }
  const Stylus* stylus = machine_.findStylus(t.stylus);
  if (stylus == nullptr) {
    return reject(fmt::format("stylus \"{}\" is not in the machine file, so its radius is unknown; allowed: {}",
                              t.stylus, allowedIds(machine_.styli)));
  }
  const std::vector<std::string> names = featureNames(*artefact);
  if (std::find(names.begin(), names.end(), t.feature) == names.end()) {
    return reject(
        fmt::format("feature \"{}\" is not on {}; allowed: {}", t.feature, t.artefact, joinedList(names, "or")));
  }
  const auto [last, fresh] = last_time_.try_emplace(t.artefact, t.time_s);
  if (!fresh && t.time_s <= last->second) {
    return reject(fmt::format("its time {} s does not come after {} s of the touch before", t.time_s, last->second));
  }
  last->second = t.time_s;
  const std::optional<double> off = distance(t, *artefact, t.feature, stylus->radius_mm);
  if (off) live.from_nominal_mm = *off;
  if (off && *off > options_.misplaced_mm) {
    for (const std::string& other : names) {
      const auto there = distance(t, *artefact, other, stylus->radius_mm);
      if (other != t.feature && there && *there <= options_.misplaced_mm) {
        return reject(fmt::format("it lies where {} should be, not {}: wrong feature", other, t.feature));
      }
    }
    Touch in_mm = t;
    in_mm.position_mm *= mm_per_inch;
    const auto scaled = distance(in_mm, *artefact, t.feature, stylus->radius_mm);
    if (scaled && *scaled <= mm_per_inch * options_.misplaced_mm) {
      return reject("its position looks like inches; allowed: millimetres");
    }
    return reject(fmt::format("it triggered {:.3g} mm from where {} should be touched", *off, t.feature));
  }
  if (artefact->kind == "balls") {
    for (const ArtefactBall& ball : artefact->balls) {
      if (ball.id != t.feature) continue;
      const Eigen::Vector3d first =
          t.position_mm + (0.5 * ball.diameter_mm + stylus->radius_mm) * t.approach - ball.certified_mm;
      for (std::size_t k = 0; k < 3; ++k) first_ball_[artefact->id][k].add(first(static_cast<Eigen::Index>(k)));
    }
  }
}

void LiveTouches::judgeChange(LiveTouch& live) {
  const auto first = first_.find(keyOf(live.touch));
  if (live.touch.cycle == first_cycle_ || first == first_.end()) return;
  live.change_um = live.touch.approach.dot(live.touch.position_mm - first->second.position_mm) * um_per_mm;
  if (live.plausible && std::abs(live.change_um) > options_.largest_change_um) {
    live.plausible = false;
    live.reason =
        fmt::format("it moved by {:.0f} µm since {}, more than thermal drift explains", live.change_um, first_cycle_);
  }
}

void LiveTouches::judgeFeature(std::size_t last) {
  const Touch t = touches_[last].touch;
  std::vector<std::size_t> group;
  for (const std::size_t i : features_[featureKeyOf(t)]) {
    if (!touches_[i].replaced && touches_[i].plausible) group.push_back(i);
  }
  const bool first = t.cycle == first_cycle_;
  Disagreement d;
  if (first) {
    const Artefact& artefact = *machine_.findArtefact(t.artefact);
    const double radius = machine_.findStylus(t.stylus)->radius_mm;
    FeatureOptions options;
    options.tolerate_one_bad_touch = false;
    if (artefact.kind == "hole_bar") options.axis = HoleBarSetup::of(machine_, artefact).rotary_direction;
    // The smallest number that says something about form: a circle needs four, a sphere five.
    const bool hole = artefact.kind == "hole_bar";
    TouchList list;
    std::vector<std::size_t> indices;
    for (const std::size_t i : group) {
      if (hole && isSurfaceTouch(touches_[i].touch, options.axis)) continue;
      indices.push_back(list.touches.size());
      list.touches.push_back(touches_[i].touch);
    }
    if (indices.size() < (hole ? 4U : 5U)) return;
    const ProbedFeature fit =
        fitFeature(list, indices, hole ? FeatureKind::Hole : FeatureKind::Sphere, radius, options);
    if (fit.status != FitStatus::Converged) return;
    d.spread_um = fit.form_mm * um_per_mm;
    for (std::size_t i = 0; i < group.size(); ++i) d.suspects.push_back(i);
  } else {
    std::vector<std::size_t> compared;
    const int expected = first_in_feature_[placeKeyOf(t)];
    for (const std::size_t i : group) {
      if (std::isfinite(touches_[i].change_um)) compared.push_back(i);
    }
    if (static_cast<int>(compared.size()) < expected || compared.size() < 3) return;
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(compared.size()), 3);
    Eigen::VectorXd changes(rows.rows());
    for (std::size_t i = 0; i < compared.size(); ++i) {
      rows.row(static_cast<Eigen::Index>(i)) = touches_[compared[i]].touch.approach.transpose();
      changes(static_cast<Eigen::Index>(i)) = touches_[compared[i]].change_um;
    }
    d = disagreementOf(rows, changes);
    group = compared;
  }
  for (const std::size_t i : group) touches_[i].feature_spread_um = d.spread_um;
  if (d.spread_um <= options_.spread_um) return;
  std::vector<std::string> numbers;
  for (const std::size_t s : d.suspects) numbers.push_back(std::to_string(touches_[group[s]].touch.touch));
  for (const std::size_t s : d.suspects) {
    reject(group[s], numbers.size() > 1
                         ? fmt::format("they disagree by {:.0f} µm", first ? d.spread_um : 2.0 * d.spread_um)
                         : fmt::format("it disagrees with the others by {:.0f} µm", d.spread_um));
    if (first) forgetFirst(touches_[group[s]].touch);
  }
}

void LiveTouches::judgeSurface(const Touch& last) {
  const Artefact* artefact = machine_.findArtefact(last.artefact);
  if (artefact == nullptr || artefact->kind != "hole_bar") return;
  const HoleBarSetup setup = HoleBarSetup::of(machine_, *artefact);
  if (!isSurfaceTouch(last, setup.rotary_direction)) return;
  const bool first = last.cycle == first_cycle_;
  std::vector<std::size_t>& together = surfaces_[{last.cycle, last.artefact, last.stylus}];
  together.push_back(touches_.size() - 1);
  std::vector<std::size_t> of;
  std::vector<PlacedHeight> heights;
  for (const std::size_t i : together) {
    const LiveTouch& live = touches_[i];
    const Touch& t = live.touch;
    if (live.replaced || !live.plausible) continue;
    if (!first && !std::isfinite(live.change_um)) continue;
    of.push_back(i);
    heights.push_back(
        {t.position_mm, t.c_deg, first ? setup.rotary_direction.dot(t.position_mm) * um_per_mm : -live.change_um});
  }
  SurfaceOptions options;
  options.floor_um = first ? options_.surface_um : options_.spread_um;
  const std::vector<SurfaceVerdict> verdicts =
      judgeSurfaceHeights(heights, setup.centre_mm, setup.rotary_direction, options);
  for (std::size_t k = 0; k < of.size(); ++k) {
    LiveTouch& live = touches_[of[k]];
    live.surface_judged = live.surface_judged || verdicts[k].judged;
    // What is in the campaign already is judged by the check of all touches.
    if (!verdicts[k].suspect || live.given_out || live.confirmed) continue;
    reject(of[k], fmt::format("its height deviates by {:.0f} µm from the {} other surface touches", verdicts[k].off_um,
                              verdicts[k].others));
    if (first) forgetFirst(live.touch);
  }
}

/// A surface touch whose cycle goes on and that cannot be compared yet.
bool LiveTouches::waitsForOthers(const LiveTouch& live) const {
  if (live.surface_judged || live.touch.cycle != touches_.back().touch.cycle) return false;
  const Artefact* artefact = machine_.findArtefact(live.touch.artefact);
  return artefact != nullptr && artefact->kind == "hole_bar" &&
         isSurfaceTouch(live.touch, HoleBarSetup::of(machine_, *artefact).rotary_direction);
}

bool LiveTouches::add(const Touch& given) {
  Touch touch = given;
  touch.c_deg = angles_.placeOf(given.c_deg);
  const std::string id = touch.cycle + "|" + keyOf(touch);
  const auto before = index_.find(id);
  if (before != index_.end()) {
    LiveTouch& old = touches_[before->second];
    if (old.touch.position_mm == touch.position_mm && old.touch.time_s == touch.time_s) return false;
  }
  LiveTouch live;
  live.touch = touch;
  if (first_cycle_.empty()) first_cycle_ = touch.cycle;
  judgePlace(live);
  judgeChange(live);
  if (before != index_.end()) {
    LiveTouch& old = touches_[before->second];
    if (old.plausible) {
      if (live.plausible) {
        live.reason = fmt::format("touch {} of {} is there already; the first one is kept", touch.touch, touch.feature);
      }
      live.plausible = false;
      live.replaced = true;  // nothing to take again
    } else {
      old.replaced = true;
      settle(before->second);
      live.confirmed = old.surface_judged && (old.touch.position_mm - touch.position_mm).norm() < confirmed_mm;
    }
  }
  const bool first = touch.cycle == first_cycle_;
  if (first && live.plausible) {
    const Key key = keyOf(touch);
    if (first_keys_.insert(key).second) first_order_.push_back(key);
    if (first_.insert_or_assign(key, touch).second) ++first_in_feature_[placeKeyOf(touch)];
  }
  const bool kept_old = live.replaced;
  touches_.push_back(live);
  settle(touches_.size() - 1);
  features_[featureKeyOf(touch)].push_back(touches_.size() - 1);
  cycles_[touch.cycle].push_back(touches_.size() - 1);
  if (!kept_old) index_[id] = touches_.size() - 1;
  if (live.plausible) judgeFeature(touches_.size() - 1);
  judgeSurface(touch);
  return true;
}

LiveProgress LiveTouches::progress() const {
  LiveProgress progress;
  if (touches_.empty()) return progress;
  const Touch& last = touches_.back().touch;
  progress.cycle = last.cycle;
  progress.feature = last.feature;
  progress.stylus = last.stylus;
  progress.c_deg = last.c_deg;
  std::set<Key> there;
  for (const std::size_t i : cycles_.at(last.cycle)) {
    const LiveTouch& live = touches_[i];
    if (!live.plausible || live.replaced) continue;
    ++progress.done;
    there.insert(keyOf(live.touch));
  }
  if (last.cycle == first_cycle_) {
    progress.expected = planned_;
    return progress;
  }
  progress.expected = static_cast<int>(first_order_.size());
  for (const Key& key : first_order_) {
    if (there.contains(key)) continue;
    const auto found = first_.find(key);
    if (found == first_.end()) continue;
    const Touch& t = found->second;
    progress.next = fmt::format("{}, touch {}", t.feature, t.touch);
    if (machine_.styli.size() > 1) progress.next += fmt::format(" with {}", t.stylus);
    if (t.c_deg != 0.0 || last.c_deg != 0.0) progress.next += fmt::format(" at {:g}°", printed(t.c_deg));
    break;
  }
  return progress;
}

std::vector<std::string> LiveTouches::retakes() const {
  // Touches of one feature with one reason are one sentence.
  std::vector<std::pair<const LiveTouch*, std::vector<std::string>>> groups;
  std::map<std::pair<std::string, std::string>, std::size_t> known;  ///< feature and reason -> its group
  for (const std::size_t i : open_) {
    const LiveTouch& live = touches_[i];
    if (live.plausible) continue;
    const auto [group, fresh] = known.try_emplace({featureKeyOf(live.touch), live.reason}, groups.size());
    if (fresh) groups.push_back({&live, {}});
    groups[group->second].second.push_back(std::to_string(live.touch.touch));
  }
  std::vector<std::string> sentences;
  for (const auto& [live, numbers] : groups) {
    const Touch& t = live->touch;
    std::string where = fmt::format("{}, {}", t.cycle, t.feature);
    if (machine_.styli.size() > 1) where += " with " + t.stylus;
    if (t.c_deg != 0.0) where += fmt::format(" at {:g}°", printed(t.c_deg));
    sentences.push_back(fmt::format("Touch {} again, touch{} {}: {}.", where, numbers.size() > 1 ? "es" : "",
                                    joinedList(numbers), live->reason));
  }
  return sentences;
}

std::vector<Touch> LiveTouches::takeFinished(bool all) {
  std::vector<Touch> finished;
  if (touches_.empty()) return finished;
  const std::string open = featureKeyOf(touches_.back().touch);
  const std::vector<std::size_t> waiting(open_.begin(), open_.end());
  for (const std::size_t i : waiting) {
    LiveTouch& live = touches_[i];
    if (live.given_out || !live.plausible) continue;
    if (!all && (featureKeyOf(live.touch) == open || waitsForOthers(live))) continue;
    live.given_out = true;
    settle(i);
    finished.push_back(live.touch);
  }
  std::stable_sort(finished.begin(), finished.end(),
                   [](const Touch& a, const Touch& b) { return a.time_s < b.time_s; });
  return finished;
}

}  // namespace spindrift
