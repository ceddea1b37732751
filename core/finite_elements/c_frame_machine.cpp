// SPDX-License-Identifier: Apache-2.0
#include "core/finite_elements/c_frame_machine.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <iterator>
#include <set>
#include <span>

#include "core/base/error.h"
#include "core/base/units.h"

namespace spindrift {
namespace {

constexpr const char* iron = "IRON";
constexpr const char* steel = "STEEL";
/// Half the distance of the points that give the turn of the table's top.
constexpr double top_arm_mm = 55.0;

std::vector<Brick> bricksOf(const CFrameDimensions& d) {
  std::vector<Brick> out;
  // Symmetric about x = 0.
  const auto add = [&](const char* part, const char* material, double half_x, double y0, double y1, double z0,
                       double z1) {
    out.push_back({part, material, {-half_x, y0, z0}, {half_x, y1, z1}});
  };
  const double table_z = -d.table_thickness_mm;
  const double bed_z = table_z - d.saddle_height_mm;
  const double floor_z = bed_z - d.bed_height_mm;
  const double column_rear = d.column_front_mm + d.column_depth_mm;
  const double front_bearing_top = d.head_bottom_mm + d.front_bearing_mm;
  const double rear_bearing_bottom = d.head_top_mm - d.rear_bearing_mm;
  add("BED", iron, d.bed_half_width_mm, -d.bed_front_mm, d.bedRear_mm(), floor_z, bed_z);
  add("BED", "", d.bed_half_width_mm - d.bed_wall_mm, -d.bed_front_mm + d.bed_wall_mm, d.bedRear_mm() - d.bed_wall_mm,
      floor_z + d.bed_wall_mm, bed_z - d.bed_wall_mm);
  add("SADDLE", iron, d.bed_half_width_mm - d.bed_wall_mm, -d.table_half_width_mm, d.table_half_width_mm, bed_z,
      table_z);
  add("TABLE", iron, d.table_half_length_mm, -d.table_half_width_mm, d.table_half_width_mm, table_z, 0.0);
  add("COLUMN", iron, d.column_half_width_mm, d.column_front_mm, column_rear, bed_z, d.column_top_mm);
  add("COLUMN", "", d.column_half_width_mm - d.column_wall_mm, d.column_front_mm + d.column_wall_mm,
      column_rear - d.column_wall_mm, bed_z, d.column_top_mm - d.column_wall_mm);
  add("HEAD", iron, d.head_half_width_mm, -d.head_front_mm, d.column_front_mm, d.head_bottom_mm, d.head_top_mm);
  add("HEAD", "", d.spindle_half_width_mm, d.head_duct_front_mm, d.head_duct_rear_mm, front_bearing_top,
      rear_bearing_bottom);
  const double s = d.spindle_half_width_mm;
  add("SPINDLE", steel, s, -s, s, d.nose_mm, d.head_top_mm);
  add("BEARING", steel, s, -s, s, d.head_bottom_mm, front_bearing_top);
  add("BEARING", steel, s, -s, s, rear_bearing_bottom, d.head_top_mm);
  add("MOTOR", iron, s, -s, s, d.head_top_mm, d.head_top_mm + d.motor_height_mm);
  return out;
}

/// Planes that no brick has: through the heated spindle, which needs two cells, and at the edge of the coolant.
BrickMesh::Planes furtherPlanes(const CFrameDimensions& d) {
  const double wet_y = d.table_half_width_mm - d.table_rim_mm;
  return {std::vector<double>{0.0}, {-wet_y, wet_y}, {}};
}

/// A number that is linear in the displacements of nodes.
using Form = std::map<std::pair<std::size_t, int>, double>;
/// A vector of such numbers along x, y, z.
using Form3 = std::array<Form, 3>;

void addTo(Form& sum, double factor, const Form& term) {
  if (factor == 0.0) return;
  for (const auto& [key, weight] : term) sum[key] += factor * weight;
}

/// Displacement and small turn of a part that moves as a rigid body, at a place.
struct FormMotion {
  Form3 shift;
  Form3 turn;
  Eigen::Vector3d place_mm = Eigen::Vector3d::Zero();

  /// Displacement of what is carried rigidly, at another place.
  [[nodiscard]] Form3 at(const Eigen::Vector3d& other_mm) const {
    Form3 out = shift;
    addTurn(out, 1.0, other_mm - place_mm);
    return out;
  }
  /// out += factor * turn x lever.
  void addTurn(Form3& out, double factor, const Eigen::Vector3d& lever_mm) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3;
      const std::size_t b = (k + 2) % 3;
      addTo(out[k], factor * lever_mm[static_cast<Eigen::Index>(b)], turn[a]);
      addTo(out[k], -factor * lever_mm[static_cast<Eigen::Index>(a)], turn[b]);
    }
  }
};

void addTo(Form3& sum, double factor, const Form3& term) {
  for (std::size_t k = 0; k < 3; ++k) addTo(sum[k], factor, term[k]);
}

Form3 displacementAt(const BrickMesh& mesh, const Eigen::Vector3d& place_mm) {
  Form3 out;
  for (const auto& [node, weight] : mesh.weightsAt(place_mm)) {
    for (int k = 0; k < 3; ++k) out[static_cast<std::size_t>(k)][{node, k}] = weight;
  }
  return out;
}

/// Rigid motion that fits the displacements of some places best: shift of their mean, turn = I^-1 sum r x u with the
/// inertia I = sum |r|^2 - r r'. The places must not lie on one line.
FormMotion rigidMotion(const BrickMesh& mesh, std::span<const Eigen::Vector3d> places_mm) {
  FormMotion out;
  const double share = 1.0 / static_cast<double>(places_mm.size());
  for (const Eigen::Vector3d& place : places_mm) out.place_mm += share * place;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Form3 moment;
  for (const Eigen::Vector3d& place : places_mm) {
    const Eigen::Vector3d r = place - out.place_mm;
    inertia += r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose();
    const Form3 u = displacementAt(mesh, place);
    addTo(out.shift, share, u);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3;
      const std::size_t b = (k + 2) % 3;
      addTo(moment[k], r[static_cast<Eigen::Index>(a)], u[b]);
      addTo(moment[k], -r[static_cast<Eigen::Index>(b)], u[a]);
    }
  }
  const Eigen::Matrix3d inverse = inertia.inverse();
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      addTo(out.turn[static_cast<std::size_t>(i)], inverse(i, j), moment[static_cast<std::size_t>(j)]);
    }
  }
  return out;
}

/// The four corners of a rectangle in a plane of constant z.
std::array<Eigen::Vector3d, 4> level(double half_x, double half_y, double z) {
  return {Eigen::Vector3d(-half_x, -half_y, z), {half_x, -half_y, z}, {half_x, half_y, z}, {-half_x, half_y, z}};
}

/// "1, 2, 3,\n4" with twelve to a line.
void appendList(std::string& text, const std::vector<std::size_t>& ids_from_0) {
  for (std::size_t i = 0; i < ids_from_0.size(); ++i) {
    text += fmt::format("{}{}", ids_from_0[i] + 1, i + 1 == ids_from_0.size() ? "\n" : i % 12 == 11 ? ",\n" : ", ");
  }
}

}  // namespace

const std::vector<CFramePoint>& cFramePoints() {
  static const std::vector<CFramePoint> points{
      {"F1", {60.0, 60.0, 20.0}, true},     {"F2", {540.0, 60.0, 20.0}},         {"F3", {540.0, 340.0, 20.0}},
      {"F4", {60.0, 340.0, 20.0}},          {"F5", {300.0, 200.0, 20.0}, true},  {"F6", {120.0, 90.0, 320.0}},
      {"F7", {480.0, 90.0, 320.0}},         {"F8", {480.0, 310.0, 320.0}, true}, {"F9", {120.0, 310.0, 320.0}},
      {"F10", {300.0, 200.0, 320.0}, true},
  };
  return points;
}

CFrameMachine::CFrameMachine(const CFrameDimensions& dimensions, double largest_cell_mm)
    : dimensions_(dimensions), mesh_(bricksOf(dimensions), furtherPlanes(dimensions), largest_cell_mm) {
  groupFaces();
  observe();
}

void CFrameMachine::groupFaces() {
  const double wet_y = dimensions_.table_half_width_mm - dimensions_.table_rim_mm;
  for (const BrickFace& face : mesh_.freeFaces()) {
    const std::string& part = mesh_.partOf(face.element);
    const Eigen::Vector3d centre = mesh_.centreOf(face);
    std::string name = part + (face.in_cavity ? "_IN" : "");
    if (part == "TABLE" && face.side == 2 && std::abs(centre.x()) < dimensions_.column_half_width_mm &&
        std::abs(centre.y()) < wet_y) {
      name = "WET";
    } else if (part == "COLUMN" && face.side == 3 && !face.in_cavity && centre.z() > 0.0) {
      name = "SUN";
    }
    CFrameFaces& group = faces_[fmt::format("{}_{}", name, face.side)];
    group.side = face.side;
    group.in_cavity = face.in_cavity;
    group.elements.push_back(face.element);
  }
}

std::vector<std::size_t> CFrameMachine::elementsOf(const std::string& part) const {
  std::vector<std::size_t> out;
  for (std::size_t e = 0; e < mesh_.elements().size(); ++e) {
    if (mesh_.partOf(e) == part) out.push_back(e);
  }
  return out;
}

void CFrameMachine::observe() {
  const CFrameDimensions& d = dimensions_;
  const double table_z = -d.table_thickness_mm;
  const double bed_z = table_z - d.saddle_height_mm;
  const double wet_y = d.table_half_width_mm - d.table_rim_mm;
  const FormMotion saddle = rigidMotion(mesh_, level(d.column_half_width_mm, wet_y, table_z));
  const FormMotion bed = rigidMotion(mesh_, level(d.guide_half_width_mm, wet_y, bed_z));
  const auto carriage = [&](double height_mm) {
    const double x = d.guide_half_width_mm;
    const double y = d.column_front_mm;
    const double low = height_mm - d.carriage_half_length_mm;
    const double high = height_mm + d.carriage_half_length_mm;
    return rigidMotion(mesh_, std::array<Eigen::Vector3d, 4>{{{-x, y, low}, {x, y, low}, {x, y, high}, {-x, y, high}}});
  };
  // The spindle turns as its nose and the end of its front bearing do, and stands where its nose stands.
  std::vector<Eigen::Vector3d> around;
  for (const double z : {d.nose_mm, d.head_bottom_mm + d.front_bearing_mm}) {
    for (const Eigen::Vector3d& place : level(d.spindle_half_width_mm, d.spindle_half_width_mm, z)) {
      around.push_back(place);
    }
  }
  FormMotion spindle = rigidMotion(mesh_, around);
  spindle.place_mm = {0.0, 0.0, d.nose_mm};
  spindle.shift = displacementAt(mesh_, spindle.place_mm);
  // What the head adds to the motion of its carriage, wherever that stands.
  const Eigen::Vector3d tip{0.0, 0.0, d.tip_mm()};
  const FormMotion as_meshed = carriage(d.carriage_mm());
  Form3 head_shift = spindle.at(tip);
  addTo(head_shift, -1.0, as_meshed.at(tip));
  Form3 head_turn = spindle.turn;
  addTo(head_turn, -1.0, as_meshed.turn);

  for (const CFramePoint& point : cFramePoints()) {
    const double x = point.position_mm.x() - 0.5 * c_frame_travel_mm[0];
    const double y = point.position_mm.y() - 0.5 * c_frame_travel_mm[1];
    const double z = point.position_mm.z();
    const FormMotion slide = carriage(d.carriage_mm() + z - d.tip_mm());
    Form3 shift = slide.at({0.0, 0.0, z});
    addTo(shift, 1.0, head_shift);
    const std::array<Eigen::Vector3d, 4> cross{
        {{x - top_arm_mm, y, 0.0}, {x + top_arm_mm, y, 0.0}, {x, y - top_arm_mm, 0.0}, {x, y + top_arm_mm, 0.0}}};
    const FormMotion top = rigidMotion(mesh_, cross);
    addTo(shift, -1.0, displacementAt(mesh_, {x, y, 0.0}));
    top.addTurn(shift, -1.0, {0.0, 0.0, z});
    // The table has gone the other way to bring the point under the tool.
    saddle.addTurn(shift, -1.0, {-x, 0.0, 0.0});
    bed.addTurn(shift, -1.0, {0.0, -y, 0.0});
    for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
      observed_.push_back({point.id, c, shift[static_cast<std::size_t>(axisIndex(c))]});
    }
    if (!point.rotations) continue;
    for (const Component c : {Component::EA, Component::EB}) {
      const auto axis = static_cast<std::size_t>(axisIndex(c));
      Form turn;  // rad per mm, given as urad per um
      addTo(turn, um_per_mm, slide.turn[axis]);
      addTo(turn, um_per_mm, head_turn[axis]);
      addTo(turn, -um_per_mm, top.turn[axis]);
      observed_.push_back({point.id, c, std::move(turn)});
    }
  }
  for (CFrameObserved& row : observed_) {
    std::erase_if(row.weights, [](const auto& entry) { return std::abs(entry.second) < 1e-10; });
  }
}

std::vector<std::size_t> CFrameMachine::observedNodes() const {
  std::set<std::size_t> nodes;
  for (const CFrameObserved& row : observed_) {
    for (const auto& [key, weight] : row.weights) nodes.insert(key.first);
  }
  return {nodes.begin(), nodes.end()};
}

std::array<std::size_t, 3> CFrameMachine::feet() const {
  const CFrameDimensions& d = dimensions_;
  const double x = d.bed_half_width_mm;
  const double z = -d.table_thickness_mm - d.saddle_height_mm - d.bed_height_mm;
  const auto corner = [&](double cx, double cy) {
    const auto weights = mesh_.weightsAt({cx, cy, z});
    SPINDRIFT_ASSERT(weights.size() == 1, "a corner of the bed is a node");
    return weights.front().first;
  };
  return {corner(-x, -d.bed_front_mm), corner(x, -d.bed_front_mm), corner(-x, d.bedRear_mm())};
}

std::string CFrameMachine::meshText() const {
  std::string text =
      "** C-frame machining centre, mm, frame of the mesh: axes of the machine, origin on top of the "
      "table under the spindle\n*NODE, NSET=ALL\n";
  for (std::size_t i = 0; i < mesh_.nodes_mm().size(); ++i) {
    const Eigen::Vector3d& p = mesh_.nodes_mm()[i];
    text += fmt::format("{}, {:.10g}, {:.10g}, {:.10g}\n", i + 1, p.x(), p.y(), p.z());
  }
  for (const char* material : {iron, steel}) {
    text += fmt::format("*ELEMENT, TYPE=C3D8, ELSET={}\n", material);
    for (std::size_t e = 0; e < mesh_.elements().size(); ++e) {
      const BrickElement& element = mesh_.elements()[e];
      if (mesh_.bricks()[element.brick].material != material) continue;
      text += fmt::format("{}", e + 1);
      for (const std::size_t node : element.nodes) text += fmt::format(", {}", node + 1);
      text += '\n';
    }
  }
  for (const auto& [name, group] : faces_) {
    text += fmt::format("*ELSET, ELSET={}\n", name);
    appendList(text, group.elements);
  }
  for (const char* part : {"BEARING", "MOTOR"}) {
    text += fmt::format("*ELSET, ELSET={}\n", part);
    appendList(text, elementsOf(part));
  }
  text += "*NSET, NSET=OBSERVED\n";
  appendList(text, observedNodes());
  return text;
}

}  // namespace spindrift
