#include "knot_utm/ros/urdf.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "knot_utm/machine/grip_bodies.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/record/program.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

const Vec3 kNoTurn = Vec3::Zero();
constexpr char kSteel[] = "steel", kPaint[] = "paint";  // materials
constexpr char kMaterials[] =
    "  <material name=\"steel\"><color rgba=\"0.62 0.64 0.68 1\"/></material>\n"
    "  <material name=\"paint\"><color rgba=\"0.30 0.32 0.36 1\"/></material>\n";

// In half the widths of the larger grip
constexpr double kHold = 2.5;   // from the middle of a grip to what holds it
constexpr double kCheek = 0.3;  // thickness of the two plates that hold a grip
constexpr double kCellRadius = 0.8, kCellHeight = 1.2;
constexpr double kBeam = 1.2;      // thickness of base and crosshead
constexpr double kColumn = 0.5;    // radius
constexpr double kToColumn = 6.0;  // from the load axis to the middle of a column

std::string text(const Vec3& v) {
  return format_number(v.x()) + " " + format_number(v.y()) + " " + format_number(v.z());
}

std::string visual(const std::string& shape, const Vec3& middle, const Vec3& turn, const char* material) {
  return "    <visual>\n      <origin xyz=\"" + text(middle) + "\" rpy=\"" + text(turn) + "\"/>\n      <geometry>" +
         shape + "</geometry>\n      <material name=\"" + material + "\"/>\n    </visual>\n";
}

std::string box(const Vec3& size, const Vec3& middle, const char* material) {
  return visual("<box size=\"" + text(size) + "\"/>", middle, kNoTurn, material);
}

std::string cylinder(double radius, double length, const Vec3& middle, const Vec3& turn, const char* material) {
  return visual("<cylinder radius=\"" + format_number(radius) + "\" length=\"" + format_number(length) + "\"/>", middle,
                turn, material);
}

std::string link(const char* name, const std::string& visuals) {
  if (visuals.empty()) return std::string("  <link name=\"") + name + "\"/>\n";
  return std::string("  <link name=\"") + name + "\">\n" + visuals + "  </link>\n";
}

std::string joint(const char* name, const char* type, const char* parent, const char* child, const Vec3& at,
                  const std::string& more = "") {
  return std::string("  <joint name=\"") + name + "\" type=\"" + type + "\">\n    <parent link=\"" + parent +
         "\"/>\n    <child link=\"" + child + "\"/>\n    <origin xyz=\"" + text(at) + "\" rpy=\"0 0 0\"/>\n" + more +
         "  </joint>\n";
}

/// How a cylinder, which stands along z, is turned to lie along an axis: about y, and then about z.
Vec3 turn_to(const Vec3& axis) {
  return {0.0, std::acos(std::clamp(axis.z(), -1.0, 1.0)), std::atan2(axis.y(), axis.x())};
}

std::string grip_visual(const GripBody& body, double radius) {
  if (body.cylinder_radius == 0.0) return box(2.0 * body.half_box(radius), body.from_grip, kSteel);
  return cylinder(body.cylinder_radius, 2.0 * body.half_length(radius), body.from_grip, turn_to(body.axis), kSteel);
}

/// The shapes of all links. Lengths are in m; `unit` is half the width of the larger grip.
class Shapes {
 public:
  Shapes(const Method& method, const Vec3& lower_grip)
      : bodies_(grip_bodies(method.specimen, method.machine, method.material)),
        radius_(thickest(method.material)),
        lower_grip_(lower_grip),
        end_to_end_(method.specimen.end_to_end),
        travel_(method.machine.travel) {
    for (const GripBody& body : bodies_) unit_ = std::max(unit_, body.half_box(radius_).maxCoeff());
  }

  std::string base() const {
    const double top = -kHold * unit_, beam = top - 0.5 * kBeam * unit_;
    // As far up as the crosshead goes.
    const double height = end_to_end_ + travel_ + (kHold + kCellHeight + kBeam) * unit_ - top;
    std::string out = box(beam_size(), lower_grip_ + Vec3(0.0, 0.0, beam), kPaint);
    for (const double side : {-1.0, 1.0})
      out += cylinder(kColumn * unit_, height, lower_grip_ + Vec3(side * kToColumn * unit_, 0.0, top + 0.5 * height),
                      kNoTurn, kSteel);
    return out;
  }

  std::string crosshead() const {
    return box(beam_size(), Vec3(0.0, 0.0, (kHold + kCellHeight + 0.5 * kBeam) * unit_), kPaint);
  }

  std::string load_cell() const {
    return cylinder(kCellRadius * unit_, kCellHeight * unit_, Vec3(0.0, 0.0, (kHold + 0.5 * kCellHeight) * unit_),
                    kNoTurn, kPaint);
  }

  /// A grip and the plates on both sides that hold it.
  std::string grip(bool upper) const {
    std::string out;
    for (const GripBody& body : bodies_)
      if (body.goes_up == upper) out += grip_visual(body, radius_);
    const Vec3 half = bodies_[upper ? 1 : 0].half_box(radius_);
    const double direction = upper ? 1.0 : -1.0, thick = kCheek * unit_;
    for (const double side : {-1.0, 1.0})
      out += box({half.x(), thick, kHold * unit_},
                 {0.0, side * (half.y() + 0.5 * thick), direction * 0.5 * kHold * unit_}, kSteel);
    // What joins them, against the base or the load cell.
    return out + box({half.x(), 2.0 * (half.y() + thick), thick}, {0.0, 0.0, direction * (kHold * unit_ - 0.5 * thick)},
                     kSteel);
  }

 private:
  Vec3 beam_size() const { return Vec3(2.0 * (kToColumn + 2.0 * kColumn), 4.0, kBeam) * unit_; }

  std::vector<GripBody> bodies_;
  double radius_;
  Vec3 lower_grip_;
  double end_to_end_, travel_;
  double unit_ = 0.0;
};

}  // namespace

std::string machine_urdf(const Method& method, const Vec3& lower_grip, const Vec3& upper_grip) {
  const Shapes shapes(method, lower_grip);
  const MachineOptions& machine = method.machine;
  const std::string moves = "    <axis xyz=\"0 0 1\"/>\n    <limit lower=\"" + format_number(-machine.travel) +
                            "\" upper=\"" + format_number(machine.travel) + "\" velocity=\"" +
                            format_number(kFastestCrosshead) + "\" effort=\"" +
                            format_number(machine.load_cell.capacity) + "\"/>\n";
  const Vec3 crosshead = lower_grip + Vec3(0.0, 0.0, method.specimen.end_to_end);
  return std::string("<?xml version=\"1.0\"?>\n<robot name=\"knot_utm\">\n") + kMaterials +
         link(names::kWorldFrame, "") + link(names::kBaseFrame, shapes.base()) +
         link(names::kLowerGripFrame, shapes.grip(false)) + link(names::kCrossheadFrame, shapes.crosshead()) +
         link(names::kUpperGripFrame, shapes.grip(true)) + link(names::kLoadCellFrame, shapes.load_cell()) +
         joint("base", "fixed", names::kWorldFrame, names::kBaseFrame, Vec3::Zero()) +
         joint("lower_grip", "fixed", names::kBaseFrame, names::kLowerGripFrame, lower_grip) +
         joint(names::kCrossheadJoint, "prismatic", names::kBaseFrame, names::kCrossheadFrame, crosshead, moves) +
         joint("upper_grip", "fixed", names::kCrossheadFrame, names::kUpperGripFrame, upper_grip - crosshead) +
         joint("load_cell", "fixed", names::kUpperGripFrame, names::kLoadCellFrame, Vec3::Zero()) + "</robot>\n";
}

}  // namespace knot_utm
