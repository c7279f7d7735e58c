#include "knot_utm/machine/grip_bodies.hpp"

#include "knot_utm/machine/grips.hpp"
#include "knot_utm/specimen/knot.hpp"

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
  const std::vector<Roller> posts = knot_of(specimen).supports(specimen, material).posts;
  for (std::size_t i = 0; i < posts.size(); ++i) {
    GripBody post;
    post.from_grip = posts[i].centre - posts.front().centre;
    post.cylinder_radius = posts[i].radius;
    post.axis = posts[i].axis;
    if (i == 0)
      bodies.front() = post;
    else
      bodies.push_back(post);
  }
  return bodies;
}

}  // namespace knot_utm
