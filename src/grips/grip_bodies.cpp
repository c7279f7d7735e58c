#include "knot_utm/grips/grip_bodies.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "knot_utm/grips/grips.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

namespace {

constexpr int kPiecesOfRing = 24;

/// Of what a cylinder or a ring is drawn, without where it is fixed.
std::vector<GripBody> bodies_of(const Roller& post) {
  GripBody one;
  one.cylinder_radius = post.radius;
  one.axis = post.axis;
  if (post.ring == 0.0) return {one};
  std::vector<GripBody> ring;
  const Vec3 side = post.axis.unitOrthogonal(), other = post.axis.cross(side);
  one.piece = 2.0 * post.ring * std::tan(M_PI / kPiecesOfRing);
  for (int i = 0; i < kPiecesOfRing; ++i) {
    const double angle = 2.0 * M_PI * i / kPiecesOfRing;
    const Vec3 outwards = std::cos(angle) * side + std::sin(angle) * other;
    one.from_grip = post.ring * outwards;
    one.axis = post.axis.cross(outwards);
    ring.push_back(one);
  }
  return ring;
}

}  // namespace

Vec3 GripBody::half_box(double h) const {
  if (cylinder_radius == 0.0) return Vec3(3.0, 3.0, 2.0) * h;
  const Vec3 across = (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  return cylinder_radius * across + half_length(h) * axis.cwiseAbs();
}

std::vector<GripBody> grip_bodies(const SpecimenOptions& specimen, const MachineOptions& machine,
                                  const Material& material) {
  std::vector<GripBody> bodies(2);
  bodies[1].goes_up = true;
  if (rollers_hold(specimen, machine))
    for (GripBody& roller : bodies) roller.cylinder_radius = 0.5 * machine.roller_diameter;
  const Supports supports = knot_of(specimen).supports(specimen, material);
  const KnotDrawing* drawing = specimen.drawing.get();
  const bool held_below = drawing != nullptr && !drawing->lower.empty();
  for (const std::vector<Roller>* posts : {&supports.posts, &supports.pins})
    for (const Roller& one : *posts) {
      const bool goes_up = posts == &supports.pins;
      const bool beside_grip = held_below && !goes_up;  // the lower grip is where the rope is held
      Vec3 grip = posts->front().centre;
      if (beside_grip) grip << thickest(material) * drawing->held_below().head<2>(), 0.0;
      bool is_grip = &one == &posts->front() && !beside_grip;
      for (GripBody& body : bodies_of(one)) {
        body.goes_up = goes_up;
        body.from_grip += one.centre - grip;
        if (std::exchange(is_grip, false))
          bodies[goes_up ? 1 : 0] = body;
        else
          bodies.push_back(body);
      }
    }
  return bodies;
}

}  // namespace knot_utm
