// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/common/probing_scene.h"

#include <array>
#include <cmath>

#include "core/base/error.h"

namespace spindrift::gui {
namespace {

bool isHoleBar(const Artefact& artefact) {
  return artefact.kind == "hole_bar";
}

ViewShape rod(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius, Tone tone = Tone::Neutral) {
  return {ShapeKind::Rod, {a, b}, radius, tone};
}

}  // namespace

std::optional<Eigen::Vector3d> firstBallPosition(const Artefact& artefact, const TouchList* touches,
                                                 const TouchEvaluation* evaluation) {
  if (artefact.balls.empty()) return std::nullopt;
  const std::string& first = artefact.balls.front().id;
  if (evaluation != nullptr) {
    for (const BallCycleResult& r : evaluation->ball_cycles) {
      for (const ProbedFeature& f : r.features) {
        if (r.artefact == artefact.id && f.feature == first && f.status == FitStatus::Converged) return f.centre_mm;
      }
    }
  }
  if (touches == nullptr) return std::nullopt;
  // Opposite touches lie on either side of the centre: good enough for a picture.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const Touch& t : touches->touches) {
    if (t.artefact != artefact.id || t.feature != first) continue;
    sum += t.position_mm + 0.5 * artefact.balls.front().diameter_mm * t.approach;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

void addArtefact(std::vector<ViewShape>& shapes, const MachineDescription& machine, const Artefact& artefact,
                 const Eigen::Vector3d& first_ball_mm, double c_deg) {
  if (!isHoleBar(artefact)) {
    double lowest = 1e300;
    for (const ArtefactBall& ball : artefact.balls) {
      lowest = std::min(lowest, (first_ball_mm + ball.certified_mm).z() - 0.5 * ball.diameter_mm);
    }
    for (const ArtefactBall& ball : artefact.balls) {
      const Eigen::Vector3d centre = first_ball_mm + ball.certified_mm;
      shapes.push_back({ShapeKind::Sphere, {centre}, 0.5 * ball.diameter_mm, Tone::Neutral});
      const Eigen::Vector3d foot(centre.x(), centre.y(), lowest - 15.0);
      shapes.push_back(rod(foot, centre, 0.16 * ball.diameter_mm));
    }
    return;
  }
  const HoleBarSetup setup = HoleBarSetup::of(machine, artefact);
  const double radius = 0.5 * artefact.hole_diameter_mm.value_or(10.0);
  const Eigen::Vector3d down = -6.0 * setup.rotary_direction;
  const int count = static_cast<int>(setup.along_mm.size());
  for (int h = 0; h < count; ++h) {
    const Eigen::Vector3d top = setup.nominal_mm(h, c_deg);
    shapes.push_back(rod(top + down, top, radius));
  }
  // The outline of the bar around its holes.
  const Eigen::Vector3d along = (setup.nominal_mm(count - 1, c_deg) - setup.nominal_mm(0, c_deg)).normalized();
  const Eigen::Vector3d side = setup.rotary_direction.cross(along);
  const Eigen::Vector3d a = setup.nominal_mm(0, c_deg) - 3.0 * radius * along;
  const Eigen::Vector3d b = setup.nominal_mm(count - 1, c_deg) + 3.0 * radius * along;
  const double half = 2.2 * radius;
  shapes.push_back({ShapeKind::Path,
                    {a - half * side, b - half * side, b + half * side, a + half * side, a - half * side},
                    1.0,
                    Tone::Neutral});
}

std::vector<ViewPoint> featureLabels(const MachineDescription& machine, const Artefact& artefact,
                                     const Eigen::Vector3d& first_ball_mm, double c_deg) {
  std::vector<ViewPoint> points;
  const auto add = [&](const std::string& id, const Eigen::Vector3d& at) {
    ViewPoint point;
    point.id = point.label = QString::fromStdString(id);
    point.position_mm = at;
    point.mark = false;
    points.push_back(std::move(point));
  };
  if (isHoleBar(artefact)) {
    const HoleBarSetup setup = HoleBarSetup::of(machine, artefact);
    const std::vector<std::string> names = featureNames(artefact);
    for (std::size_t h = 0; h < names.size(); ++h) add(names[h], setup.nominal_mm(static_cast<int>(h), c_deg));
  } else {
    for (const ArtefactBall& ball : artefact.balls) add(ball.id, first_ball_mm + ball.certified_mm);
  }
  return points;
}

void addStyli(std::vector<ViewShape>& shapes, const MachineDescription& machine, const std::string& stylus,
              const Eigen::Vector3d& tip_mm) {
  const Stylus* touching = machine.findStylus(stylus);
  if (touching == nullptr) return;
  const Eigen::Vector3d reference = tip_mm - touching->offset_mm;
  Eigen::Vector3d joint = reference;
  // The shafts of a star meet where the shaft of the longest stylus passes the others.
  if (machine.styli.size() > 1) joint.z() += -0.4 * std::abs(machine.styli.front().offset_mm.z());
  for (const Stylus& s : machine.styli) {
    const Eigen::Vector3d tip = reference + s.offset_mm;
    const bool own = s.id == stylus;
    shapes.push_back({ShapeKind::Sphere, {tip}, s.radius_mm, own ? Tone::Accent : Tone::Neutral});
    shapes.push_back(rod(joint, tip, 0.45 * s.radius_mm, own ? Tone::Accent : Tone::Neutral));
  }
  shapes.push_back(rod(joint, reference, machine.styli.front().radius_mm));
  shapes.push_back(rod(reference, reference + Eigen::Vector3d(0, 0, 40), 12.0));
}

void addTravel(std::vector<ViewShape>& shapes, const MachineDescription& machine) {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const LinearAxis* axis = machine.findAxis(std::string(1, "XYZ"[k]));
    if (axis == nullptr) return;
    low(k) = std::min(axis->travel_mm[0], axis->travel_mm[1]);
    high(k) = std::max(axis->travel_mm[0], axis->travel_mm[1]);
  }
  const auto corner = [&](int i) {
    return Eigen::Vector3d((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                           (i & 4) != 0 ? high.z() : low.z());
  };
  for (const std::array<int, 5>& loop : {std::array<int, 5>{0, 1, 3, 2, 0}, std::array<int, 5>{4, 5, 7, 6, 4}}) {
    ViewShape path{ShapeKind::Path, {}, 1.0, Tone::Neutral};
    for (const int i : loop) path.points_mm.push_back(corner(i));
    shapes.push_back(std::move(path));
  }
  for (const int i : {0, 1, 2, 3}) shapes.push_back({ShapeKind::Path, {corner(i), corner(i + 4)}, 1.0, Tone::Neutral});
}

void addPath(std::vector<ViewShape>& shapes, const CyclePlan& plan, double c_deg) {
  std::optional<Eigen::Vector3d> last;
  ViewShape part{ShapeKind::Path, {}, 1.0, Tone::Neutral};
  bool measuring = false;
  const auto flush = [&] {
    if (part.points_mm.size() > 1) shapes.push_back(part);
    part.points_mm.clear();
  };
  for (const PlannedMove& move : plan.moves) {
    if (std::abs(move.c_deg - c_deg) > 1e-6) {
      flush();
      last.reset();
      continue;
    }
    const bool now = move.kind == MoveKind::Touch || move.kind == MoveKind::Retract;
    if (now != measuring) flush();
    measuring = now;
    part.tone = now ? Tone::Accent : Tone::Neutral;
    if (part.points_mm.empty() && last) part.points_mm.push_back(*last);
    part.points_mm.push_back(move.tip_mm);
    last = move.tip_mm;
  }
  flush();
}

Tone toneOf(TouchState state) {
  switch (state) {
    case TouchState::Used:
      return Tone::Good;
    case TouchState::LeftOut:
      return Tone::Bad;
    case TouchState::Missing:
      return Tone::Attention;
    case TouchState::Excluded:
      return Tone::Neutral;
  }
  return Tone::Neutral;
}

void addTouches(std::vector<ViewShape>& shapes, const std::vector<TouchVerdict>& verdicts, double c_deg) {
  for (const TouchVerdict& v : verdicts) {
    if (std::abs(v.touch.c_deg - c_deg) > 1e-6) continue;
    shapes.push_back(
        {ShapeKind::Sphere, {v.touch.position_mm}, v.state == TouchState::Used ? 1.2 : 2.4, toneOf(v.state)});
  }
}

}  // namespace spindrift::gui
