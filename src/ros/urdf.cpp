#include "knot_utm/ros/urdf.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/grips/grips.hpp"
#include "knot_utm/program/program.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

std::string text(const Vec3& v) {
  return format_number(v.x()) + " " + format_number(v.y()) + " " + format_number(v.z());
}

/// How a cylinder, which stands along z, is turned to lie along an axis: about y, and then about z.
Vec3 turn_to(const Vec3& axis) {
  return {0.0, std::acos(std::clamp(axis.z(), -1.0, 1.0)), std::atan2(axis.y(), axis.x())};
}

std::string visual(const GripBody& body, double radius) {
  const bool box = body.cylinder_radius == 0.0;
  const std::string shape = box ? "<box size=\"" + text(2.0 * body.half_box(radius)) + "\"/>"
                                : "<cylinder radius=\"" + format_number(body.cylinder_radius) + "\" length=\"" +
                                      format_number(2.0 * body.half_length(radius)) + "\"/>";
  return "    <visual>\n      <origin xyz=\"" + text(body.from_grip) + "\" rpy=\"" +
         text(box ? Vec3(Vec3::Zero()) : turn_to(body.axis)) + "\"/>\n      <geometry>" + shape +
         "</geometry>\n    </visual>\n";
}

std::string link(const char* name, const std::string& visuals = "") {
  return std::string("  <link name=\"") + name + "\">\n" + visuals + "  </link>\n";
}

std::string joint(const char* name, const char* type, const char* parent, const char* child, const Vec3& at,
                  const std::string& more = "") {
  return std::string("  <joint name=\"") + name + "\" type=\"" + type + "\">\n    <parent link=\"" + parent +
         "\"/>\n    <child link=\"" + child + "\"/>\n    <origin xyz=\"" + text(at) + "\" rpy=\"0 0 0\"/>\n" + more +
         "  </joint>\n";
}

}  // namespace

std::string machine_urdf(const Method& method, const Vec3& lower_grip, const Vec3& upper_grip) {
  const MachineOptions& machine = method.machine;
  std::string lower, upper;
  for (const GripBody& body : grip_bodies(method.specimen, machine, method.material))
    (body.goes_up ? upper : lower) += visual(body, thickest(method.material));
  const std::string moves = "    <axis xyz=\"0 0 1\"/>\n    <limit lower=\"" + format_number(-machine.travel) +
                            "\" upper=\"" + format_number(machine.travel) + "\" velocity=\"" +
                            format_number(kFastestCrosshead) + "\" effort=\"" +
                            format_number(machine.load_cell.capacity) + "\"/>\n";
  const Vec3 crosshead = lower_grip + Vec3(0.0, 0.0, method.specimen.end_to_end);
  return "<?xml version=\"1.0\"?>\n<robot name=\"knot_utm\">\n" + link(names::kWorldFrame) + link(names::kBaseFrame) +
         link(names::kLowerGripFrame, lower) + link(names::kCrossheadFrame) + link(names::kUpperGripFrame, upper) +
         link(names::kLoadCellFrame) + joint("base", "fixed", names::kWorldFrame, names::kBaseFrame, Vec3::Zero()) +
         joint("lower_grip", "fixed", names::kBaseFrame, names::kLowerGripFrame, lower_grip) +
         joint(names::kCrossheadJoint, "prismatic", names::kBaseFrame, names::kCrossheadFrame, crosshead, moves) +
         joint("upper_grip", "fixed", names::kCrossheadFrame, names::kUpperGripFrame, upper_grip - crosshead) +
         joint("load_cell", "fixed", names::kUpperGripFrame, names::kLoadCellFrame, Vec3::Zero()) + "</robot>\n";
}

}  // namespace knot_utm
