#include "knot_utm/machine/grip_bodies.hpp"

#include "knot_utm/machine/grips.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

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
      GripBody post;
      post.goes_up = posts == &supports.pins;
      const bool beside = held_below && !post.goes_up;  // the lower grip is where the rope is held
      Vec3 grip = posts->front().centre;
      if (beside) grip << thickest(material) * drawing->held_below().head<2>(), 0.0;
      post.from_grip = one.centre - grip;
      post.cylinder_radius = one.radius;
      post.axis = one.axis;
      if (&one == &posts->front() && !beside)
        bodies[post.goes_up ? 1 : 0] = post;
      else
        bodies.push_back(post);
    }
  return bodies;
}

}  // namespace knot_utm
