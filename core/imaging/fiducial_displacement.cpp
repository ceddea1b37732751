// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/fiducial_displacement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/units.h"

namespace spindrift {
namespace {

/// Smallest difference of two spindle orientations that count as two.
constexpr double least_turn_rad = 0.2 * rad_per_deg;
/// Image and list disagree on the orientation of the spindle beyond this.
constexpr double orientation_tolerance_rad = 2.0 * rad_per_deg;

Eigen::Matrix2d turned(double angle_rad) {
  Eigen::Matrix2d R;
  R << std::cos(angle_rad), -std::sin(angle_rad), std::sin(angle_rad), std::cos(angle_rad);
  return R;
}

/// Rows of one fiducial in one state, by role.
struct Group {
  std::string fiducial;
  std::string state;
  std::vector<std::size_t> rotation;
  std::vector<std::size_t> x_axis;
  std::vector<std::size_t> y_axis;
  std::vector<std::size_t> focus;
  std::size_t listed_rotation = 0;
  std::size_t listed_focus = 0;

  [[nodiscard]] std::string name() const { return fmt::format("{} in state {}", fiducial, state); }
};

std::vector<Group> groupsOf(const FiducialCaptureList& list, const FiducialImages& images) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < list.captures.size(); ++i) {
    const FiducialCapture& c = list.captures[i];
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return g.fiducial == c.fiducial && g.state == c.state; });
    if (group == groups.end()) {
      group = groups.insert(groups.end(), Group{});
      group->fiducial = c.fiducial;
      group->state = c.state;
    }
    group->listed_rotation += c.role == CaptureRole::Rotation ? 1 : 0;
    group->listed_focus += c.role == CaptureRole::Focus ? 1 : 0;
    if (!images.images[i].usable) continue;
    switch (c.role) {
      case CaptureRole::Rotation:
        group->rotation.push_back(i);
        break;
      case CaptureRole::XAxis:
        group->x_axis.push_back(i);
        break;
      case CaptureRole::YAxis:
        group->y_axis.push_back(i);
        break;
      case CaptureRole::Focus:
        group->focus.push_back(i);
        break;
    }
  }
  return groups;
}

std::vector<AxisImage> axisImages(const FiducialCaptureList& list, const FiducialImages& images,
                                  const std::vector<std::size_t>& rows) {
  std::vector<AxisImage> result;
  for (const std::size_t i : rows) {
    const FiducialCapture& c = list.captures[i];
    result.push_back({images.images[i].pose, c.position_mm.head<2>(), c.spindle_deg});
  }
  return result;
}

std::size_t orientationCount(const FiducialImages& images, const std::vector<std::size_t>& rows) {
  std::vector<double> found;
  for (const std::size_t i : rows) {
    const double angle = images.images[i].pose.orientation_rad();
    if (std::none_of(found.begin(), found.end(),
                     [&](double other) { return std::abs(angleDifference(angle, other)) < least_turn_rad; })) {
      found.push_back(angle);
    }
  }
  return found.size();
}

/// psi of every fiducial that has any rotation or axis image.
void findDirections(const FiducialCaptureList& list, const FiducialImages& images, const std::vector<Group>& groups,
                    FiducialDisplacement& out) {
  for (const std::string& fiducial : list.fiducials()) {
    FiducialDirection direction;
    direction.fiducial = fiducial;
    double weights = 0.0;
    double sum = 0.0;
    double own = 0.0;
    for (const SetDirections& d : out.axes.sets) {
      if (d.fiducial != fiducial) continue;
      const double w = 1.0 / (d.psi_sigma_rad * d.psi_sigma_rad);
      if (weights == 0.0) own = d.psi_rad;
      sum += w * angleDifference(d.psi_rad, own);
      weights += w;
    }
    if (weights > 0.0 && !out.axes.pooled) {
      direction.psi_rad = own + sum / weights;
      direction.sigma_rad = 1.0 / std::sqrt(weights);
      out.directions.push_back(direction);
      continue;
    }
    // Through the camera: psi = orientation + spindle angle - phi, mean over all images.
    double reference = 0.0;
    std::vector<double> values;
    for (const Group& group : groups) {
      if (group.fiducial != fiducial) continue;
      for (const std::vector<std::size_t>* rows : {&group.rotation, &group.x_axis, &group.y_axis}) {
        for (const std::size_t i : *rows) {
          const double angle =
              images.images[i].pose.orientation_rad() + list.captures[i].spindle_deg * rad_per_deg - out.axes.phi_rad;
          if (values.empty()) reference = angle;
          values.push_back(angleDifference(angle, reference));
        }
      }
    }
    if (values.empty()) continue;
    std::vector<double> sorted = values;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double middle = sorted[sorted.size() / 2];
    double mean = 0.0;
    double scatter = 0.0;
    double count = 0.0;
    for (const double v : values) {
      if (std::abs(v - middle) > orientation_tolerance_rad) continue;
      mean += v;
      count += 1.0;
    }
    mean /= count;
    for (const double v : values) {
      if (std::abs(v - middle) <= orientation_tolerance_rad) scatter += (v - mean) * (v - mean);
    }
    direction.psi_rad = angleDifference(reference + mean, 0.0);
    const double orientation_variance = count > 1.5 ? scatter / (count - 1.0) / count : 1e-6;
    direction.sigma_rad = std::hypot(out.axes.phi_sigma_rad, std::sqrt(orientation_variance));
    direction.pooled = true;
    out.directions.push_back(direction);
  }
}

const FiducialDirection* directionOf(const FiducialDisplacement& d, const std::string& fiducial) {
  for (const FiducialDirection& direction : d.directions) {
    if (direction.fiducial == fiducial) return &direction;
  }
  return nullptr;
}

void warnOfOrientations(const FiducialCaptureList& list, const FiducialImages& images, const Group& group,
                        FiducialDisplacement& out) {
  if (group.rotation.size() < 2) return;
  const std::size_t first = group.rotation.front();
  const double reference = images.images[first].pose.orientation_rad() + list.captures[first].spindle_deg * rad_per_deg;
  for (const std::size_t i : group.rotation) {
    const double angle = images.images[i].pose.orientation_rad() + list.captures[i].spindle_deg * rad_per_deg;
    const double difference = angleDifference(angle, reference);
    if (std::abs(difference) <= orientation_tolerance_rad) continue;
    out.warnings.push_back(fmt::format(
        "{}: the images say that the spindle turned {:.1f}° further than spindle_deg says between {} and {}.",
        group.name(), printed(-difference * deg_per_rad), list.captures[first].image, list.captures[i].image));
    return;
  }
}

RotationSet rotationSet(const FiducialCaptureList& list, const FiducialImages& images, const Group& group,
                        const Eigen::Vector2d& commanded_mm, double psi_rad) {
  RotationSet set;
  set.fiducial = group.fiducial;
  set.state = group.state;
  for (const std::size_t i : group.rotation) {
    RotationImage image;
    image.pose = images.images[i].pose;
    image.offset_um = turned(-psi_rad) * (list.captures[i].position_mm.head<2>() - commanded_mm) * um_per_mm;
    image.spindle_deg = list.captures[i].spindle_deg;
    image.marks = images.images[i].marks;
    set.images.push_back(std::move(image));
  }
  return set;
}

/// The first state in which any fiducial has what `has` asks for; empty if none has.
template <typename Has>
std::string referenceState(const std::vector<std::string>& states, const FiducialDisplacement& d, const Has& has) {
  for (const std::string& state : states) {
    for (const FiducialState& s : d.states) {
      if (s.state == state && has(s)) return state;
    }
  }
  return {};
}

/// xy_um and z_um of every state, relative to the same fiducial in the reference state; none without it.
void findDisplacements(const std::vector<std::string>& states, FiducialDisplacement& out) {
  const std::string xy_state = referenceState(states, out, [](const FiducialState& s) { return s.centre.has_value(); });
  const std::string z_state =
      referenceState(states, out, [](const FiducialState& s) { return s.focus_set.has_value(); });
  for (FiducialState& s : out.states) {
    s.reference = s.state == xy_state || s.state == z_state;
    for (std::size_t k = 0; k < out.states.size(); ++k) {
      if (out.states[k].fiducial != s.fiducial) continue;
      if (s.centre && out.states[k].state == xy_state && out.states[k].centre) s.xy_reference = k;
      if (s.focus_set && out.states[k].state == z_state && out.states[k].focus_set) s.z_reference = k;
    }
    if (s.xy_reference) {
      const FiducialState& reference = out.states[*s.xy_reference];
      const Eigen::Vector2d moved = out.centres.sets[*s.centre].place_um - out.centres.sets[*reference.centre].place_um;
      s.xy_um =
          turned(directionOf(out, s.fiducial)->psi_rad) * moved - (s.commanded_mm - reference.commanded_mm) * um_per_mm;
    }
    if (s.z_reference) {
      const std::size_t reference = *out.states[*s.z_reference].focus_set;
      s.z_um = -(out.focus.peaks[*s.focus_set].peak_um - out.focus.peaks[reference].peak_um);
    }
  }
  const std::vector<std::string>& all = states;
  for (const auto& [what, state] : {std::pair{"position in the plane", &xy_state}, std::pair{"height", &z_state}}) {
    if (all.empty() || state->empty() || *state == all.front()) continue;
    out.warnings.push_back(
        fmt::format("No fiducial has a {} in {}: its change is relative to {}.", what, all.front(), *state));
  }
}

std::string numberWord(std::size_t n) {
  constexpr std::array<const char*, 6> words{"none", "one", "two", "three", "four", "five"};
  return n < words.size() ? words[n] : fmt::format("{}", n);
}

/// "F1 has only two of the three rotation images it needs in M0".
std::string lackOf(const std::string& fiducial, const std::string& state, bool height, const std::vector<Group>& groups,
                   const FiducialImages& images) {
  const auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const Group& g) { return g.fiducial == fiducial && g.state == state; });
  const std::size_t needed = height ? 5 : 3;
  std::size_t there = 0;
  if (group != groups.end()) there = height ? group->focus.size() : orientationCount(images, group->rotation);
  if (there >= needed)
    return fmt::format("{} has no {} in {}", fiducial, height ? "height" : "position in the plane", state);
  const char* const kind = height ? "focus" : "rotation";
  return there > 0
             ? fmt::format("{} has only {} of the {} {} images it needs in {}", fiducial, numberWord(there),
                           numberWord(needed), kind, state)
             : fmt::format("{} has none of the {} {} images it needs in {}", fiducial, numberWord(needed), kind, state);
}

/// What a fiducial lacks in a state, and what follows: without the reference nothing, else only that state.
void warnOfMissing(const FiducialCaptureList& list, const std::vector<Group>& groups, const FiducialImages& images,
                   FiducialDisplacement& out) {
  const std::vector<std::string> states = list.states();
  for (const std::string& fiducial : list.fiducials()) {
    for (const bool height : {false, true}) {
      const auto measured = [&](const FiducialState& s) {
        return height ? s.focus_set.has_value() : s.centre.has_value();
      };
      const std::string reference = referenceState(states, out, measured);
      if (reference.empty()) continue;  // of no fiducial at all; said elsewhere
      std::vector<std::string> there, missing;
      for (const std::string& state : states) {
        const bool has = std::any_of(out.states.begin(), out.states.end(), [&](const FiducialState& s) {
          return s.fiducial == fiducial && s.state == state && measured(s);
        });
        if (state != reference) (has ? there : missing).push_back(state);
        if (state == reference && !has) missing.insert(missing.begin(), state);
      }
      if (missing.empty()) continue;
      const char* axes = height ? "Z" : "X and Y";
      if (missing.front() == reference && !there.empty()) {
        out.warnings.push_back(fmt::format("{}: it has no deviation in {} in {}.",
                                           lackOf(fiducial, reference, height, groups, images), axes,
                                           joinedList(there)));
        missing.erase(missing.begin());
      }
      for (const std::string& state : missing) {
        if (state == reference) continue;  // nowhere measured: nothing is lost by it
        out.warnings.push_back(
            fmt::format("{}: it has no deviation in {} there.", lackOf(fiducial, state, height, groups, images), axes));
      }
    }
  }
}

/// A row of the result together with what it is made of.
struct Row {
  Observation observation;
  std::size_t state = 0;      ///< index in states
  std::size_t reference = 0;  ///< index in states
};

/// Rows of the result in order of time; sigma is still open.
std::vector<Row> rowsOf(const FiducialDisplacement& out) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < out.states.size(); ++i) {
    const FiducialState& s = out.states[i];
    for (const Component component : {Component::EX, Component::EY, Component::EZ}) {
      const bool z = component == Component::EZ;
      if (z ? !s.z_um.has_value() : !s.xy_um.has_value()) continue;
      Row row;
      row.state = i;
      row.reference = z ? *s.z_reference : *s.xy_reference;
      row.observation.time_s = s.time_s;
      row.observation.state = s.state;
      row.observation.point = s.fiducial;
      row.observation.position_mm = s.position_mm;
      row.observation.component = component;
      row.observation.value = z ? *s.z_um : (*s.xy_um)(component == Component::EX ? 0 : 1);
      row.observation.instrument = "microscope";
      rows.push_back(row);
    }
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.observation.time_s < b.observation.time_s; });
  return rows;
}

/// Of one centre coordinate or focus peak: what it does not share with others, um.
double ownSigma(const FiducialDisplacement& out, const FiducialState& s, Component component) {
  return component == Component::EZ ? out.focus.peaks[*s.focus_set].own_sigma_um
                                    : out.centres.sets[*s.centre].own_place_sigma_um;
}

/// A matrix of causes without what is own: at most a few columns are left.
Eigen::MatrixXd commonRoot(const Eigen::MatrixXd& covariance, const Eigen::VectorXd& own_sigma) {
  if (covariance.size() == 0) return Eigen::MatrixXd::Zero(covariance.rows(), 0);
  constexpr double rounding = 1e-10;
  const Eigen::MatrixXd common = covariance - Eigen::MatrixXd(own_sigma.cwiseAbs2().asDiagonal());
  return covarianceRoot(common, rounding * covariance.diagonal().maxCoeff());
}

using Factors = std::vector<SharedNoise::Factor>;

/// What the places or heights share through the centres and the shape of the curves: d = T s for XY, d = U p for Z.
void addCommonCauses(const FiducialDisplacement& out, const std::vector<Row>& rows, SharedNoise& shared) {
  Eigen::VectorXd own_place(out.centres.covariance.rows());
  for (Eigen::Index k = 0; k < own_place.size(); ++k)
    own_place(k) = out.centres.sets[static_cast<std::size_t>(k / 2)].own_place_sigma_um;
  Eigen::VectorXd own_peak(out.focus.covariance.rows());
  for (Eigen::Index k = 0; k < own_peak.size(); ++k) {
    const FocusPeak& peak = out.focus.peaks[static_cast<std::size_t>(k)];
    own_peak(k) = peak.status == FitStatus::Converged ? peak.own_sigma_um : 0.0;
  }
  const Eigen::MatrixXd places = commonRoot(out.centres.covariance, own_place);
  const Eigen::MatrixXd peaks = commonRoot(out.focus.covariance, own_peak);
  Factors of_places(static_cast<std::size_t>(places.cols()));
  Factors of_peaks(static_cast<std::size_t>(peaks.cols()));
  const auto add = [](Factors& factors, std::size_t row, const Eigen::RowVectorXd& loads) {
    for (Eigen::Index q = 0; q < loads.size(); ++q) factors[static_cast<std::size_t>(q)].push_back({row, loads(q)});
  };
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Row& row = rows[r];
    if (row.reference == row.state) continue;
    const FiducialState& s = out.states[row.state];
    const FiducialState& reference = out.states[row.reference];
    if (row.observation.component == Component::EZ) {
      add(of_peaks, r,
          peaks.row(static_cast<Eigen::Index>(*reference.focus_set)) -
              peaks.row(static_cast<Eigen::Index>(*s.focus_set)));
    } else {
      const Eigen::RowVector2d turn =
          turned(directionOf(out, s.fiducial)->psi_rad).row(row.observation.component == Component::EX ? 0 : 1);
      add(of_places, r,
          turn * (places.middleRows(2 * static_cast<Eigen::Index>(*s.centre), 2) -
                  places.middleRows(2 * static_cast<Eigen::Index>(*reference.centre), 2)));
    }
  }
  for (Factors* factors : {&of_places, &of_peaks})
    for (SharedNoise::Factor& factor : *factors) shared.addFactor(std::move(factor));
}

/// Directions: of each fiducial, and that of the camera, which those that go through it share.
void addDirections(const FiducialDisplacement& out, const std::vector<Row>& rows, SharedNoise& shared) {
  SharedNoise::Factor camera;
  std::map<std::string, SharedNoise::Factor> own;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Row& row = rows[r];
    if (row.reference == row.state || row.observation.component == Component::EZ) continue;
    const FiducialState& s = out.states[row.state];
    const FiducialState& reference = out.states[row.reference];
    const Eigen::Vector2d moved = *s.xy_um + (s.commanded_mm - reference.commanded_mm) * um_per_mm;
    const double per_psi = row.observation.component == Component::EX ? -moved.y() : moved.x();
    const FiducialDirection& direction = *directionOf(out, s.fiducial);
    double variance = direction.sigma_rad * direction.sigma_rad;
    if (direction.pooled) {
      camera.push_back({r, per_psi * out.axes.phi_sigma_rad});
      variance -= out.axes.phi_sigma_rad * out.axes.phi_sigma_rad;
    }
    own[s.fiducial].push_back({r, per_psi * std::sqrt(std::max(0.0, variance))});
  }
  shared.addFactor(std::move(camera));
  for (auto& [fiducial, factor] : own) shared.addFactor(std::move(factor));
}

/// Own noise of the reference of every series, and what stands in the rows of the reference itself: see the header.
/// Returns the rows of a reference that nothing was compared with.
std::vector<std::size_t> addReferences(const FiducialDisplacement& out, const std::vector<Row>& rows,
                                       SharedNoise& shared) {
  std::map<std::pair<std::string, Component>, std::vector<std::size_t>> series;
  for (std::size_t r = 0; r < rows.size(); ++r)
    series[{rows[r].observation.point, rows[r].observation.component}].push_back(r);
  std::vector<std::size_t> alone;
  for (const auto& [key, members] : series) {
    const Row& first = rows[members.front()];
    const double own = ownSigma(out, out.states[first.reference], key.second);
    if (members.size() == 1 && first.reference == first.state) {
      alone.push_back(members.front());
      continue;
    }
    SharedNoise::Factor reference;
    SharedNoise::Factor level;
    for (const std::size_t r : members) {
      const bool is_reference = rows[r].reference == rows[r].state;
      reference.push_back({r, is_reference ? 0.5 * own : -0.5 * own});
      level.push_back({r, std::sqrt(0.75) * own});
    }
    shared.addFactor(std::move(reference));
    shared.addFactor(std::move(level));
  }
  std::sort(alone.begin(), alone.end());
  return alone;
}

}  // namespace

void makeFiducialObservations(FiducialDisplacement& out) {
  std::vector<Row> rows = rowsOf(out);
  SharedNoise& shared = out.observations.shared;
  shared.clear();
  out.observations.rows.clear();
  addCommonCauses(out, rows, shared);
  addDirections(out, rows, shared);
  const std::vector<std::size_t> alone = addReferences(out, rows, shared);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    Observation& o = rows[r].observation;
    FiducialState& s = out.states[rows[r].state];
    double own = 0.0;
    if (std::binary_search(alone.begin(), alone.end(), r)) {
      own = o.component == Component::EZ ? out.focus.peaks[*s.focus_set].sigma_um
                                         : out.centres.sets[*s.centre].place_sigma_um;
    } else if (rows[r].reference != rows[r].state) {
      own = ownSigma(out, s, o.component);
    }
    o.sigma = std::sqrt(own * own + shared.variance(r));
    if (o.component == Component::EZ) {
      s.z_sigma_um = o.sigma;
    } else {
      s.xy_sigma_um(o.component == Component::EX ? 0 : 1) = o.sigma;
    }
    out.observations.rows.push_back(o);
  }
}

namespace {

/// Takes displacements that no machine has out of the states and makes the observations anew.
void leaveOutImplausible(FiducialDisplacement& out) {
  out.implausible = implausibleReadings(out.observations);
  if (out.implausible.empty()) return;
  for (const ImplausibleReading& reading : out.implausible) {
    for (const std::size_t row : reading.rows) {
      const Observation& o = out.observations.rows[row];
      for (FiducialState& s : out.states) {
        if (s.fiducial != o.point || s.state != o.state) continue;
        if (o.component == Component::EZ) {
          s.z_um.reset();
        } else {
          s.xy_um.reset();
        }
      }
    }
  }
  makeFiducialObservations(out);
}

}  // namespace

FiducialDisplacement findFiducialDisplacement(const FiducialCaptureList& list, const FiducialImages& images,
                                              const MachineDescription& machine) {
  FiducialDisplacement out;
  const std::vector<Group> groups = groupsOf(list, images);
  std::vector<AxisSet> axis_sets;
  for (const Group& group : groups) {
    if (group.x_axis.size() < 2 && group.y_axis.size() < 2) continue;
    axis_sets.push_back(
        {group.fiducial, group.state, axisImages(list, images, group.x_axis), axisImages(list, images, group.y_axis)});
  }
  out.axes = fitAxisDirections(axis_sets);
  if (out.axes.status == FitStatus::Rejected) throw InputError({list.file, ""}, out.axes.message);
  const bool oriented = out.axes.status == FitStatus::Converged;
  if (oriented) {
    findDirections(list, images, groups, out);
    if (!out.axes.pooled) {
      out.warnings.push_back(
          fmt::format("The direction of the camera differs between fiducials or states ({}): "
                      "each fiducial is turned by its own axis images.",
                      pValueText(out.axes.p_value)));
    }
  } else {
    out.warnings.emplace_back(
        "No images along X or Y could be used: displacements in the plane cannot be turned into "
        "the machine's axes and are left out.");
  }

  std::vector<RotationSet> rotation_sets;
  for (const Group& group : groups) {
    FiducialState s;
    s.fiducial = group.fiducial;
    s.state = group.state;
    double time = 0.0;
    double count = 0.0;
    Eigen::Vector3d commanded = Eigen::Vector3d::Zero();
    for (const std::vector<std::size_t>* rows : {&group.rotation, &group.focus}) {
      for (const std::size_t i : *rows) {
        time += list.captures[i].time_s;
        count += 1.0;
      }
    }
    if (count > 0.0) s.time_s = time / count;
    for (const std::size_t i : group.rotation) {
      commanded += list.captures[i].position_mm / static_cast<double>(group.rotation.size());
    }
    if (group.rotation.empty()) {
      for (const std::size_t i : group.focus) {
        commanded += list.captures[i].position_mm / static_cast<double>(group.focus.size());
      }
    }
    s.commanded_mm = commanded.head<2>();
    s.position_mm = commanded;
    if (const MachinePoint* point = machine.findPoint(group.fiducial)) s.position_mm = point->position_mm;
    for (std::size_t k = 0; k < out.axes.sets.size(); ++k) {
      if (out.axes.sets[k].fiducial == group.fiducial && out.axes.sets[k].state == group.state) s.directions = k;
    }
    const FiducialDirection* direction = directionOf(out, group.fiducial);
    if (group.listed_rotation > 0) {
      const std::size_t orientations = orientationCount(images, group.rotation);
      if (orientations < 3) {
        out.rejected.push_back(
            {fmt::format("rotation of {}", group.name()),
             fmt::format("{} of {} images show {} different spindle orientation{}; at least 3 are needed for the "
                         "centre of rotation.",
                         group.rotation.size(), group.listed_rotation, orientations, orientations == 1 ? "" : "s")});
      } else if (direction != nullptr) {
        warnOfOrientations(list, images, group, out);
        s.centre = rotation_sets.size();
        rotation_sets.push_back(rotationSet(list, images, group, s.commanded_mm, direction->psi_rad));
      }
    }
    if (group.listed_focus > 0) {
      FocusSet set;
      set.name = group.name();
      for (const std::size_t i : group.focus) {
        set.height_mm.push_back(list.captures[i].position_mm.z());
        set.normalised.push_back(images.images[i].focus.normalised);
      }
      s.focus_set = out.focus_sets.size();
      out.focus_sets.push_back(std::move(set));
    }
    out.states.push_back(std::move(s));
  }
  if (!rotation_sets.empty()) {
    out.centres = fitCentreOfRotation(rotation_sets);
    if (out.centres.status != FitStatus::Converged) {
      out.warnings.push_back(fmt::format("The centre of rotation cannot be found: {}.", out.centres.message));
      for (FiducialState& s : out.states) s.centre.reset();
    } else if (out.centres.pooling != CentrePooling::All) {
      out.warnings.push_back(fmt::format(
          "The centre of rotation is not the same everywhere ({}): {} is used. The microscope has "
          "moved in the spindle or had not settled.",
          pValueText(std::min(out.centres.p_value_all, out.centres.p_value_per_state)), toString(out.centres.pooling)));
    }
  }
  out.focus = fitFocus(out.focus_sets);
  for (FiducialState& s : out.states) {
    if (!s.focus_set) continue;
    const FocusPeak& peak = out.focus.peaks[*s.focus_set];
    if (peak.status == FitStatus::Converged) continue;
    out.rejected.push_back({fmt::format("focus of {} in state {}", s.fiducial, s.state),
                            peak.message.empty() ? out.focus.message + "." : peak.message});
    s.focus_set.reset();
  }
  findDisplacements(list.states(), out);
  warnOfMissing(list, groups, images, out);
  makeFiducialObservations(out);
  leaveOutImplausible(out);
  return out;
}

}  // namespace spindrift
