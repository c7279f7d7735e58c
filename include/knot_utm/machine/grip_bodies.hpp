#pragma once

#include <vector>

#include "knot_utm/machine/options.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// What holds or bears the specimen, as a picture shows it: a cylinder, as rollers and posts are, or a block in place
/// of a clamp or of whatever holds a node.
struct GripBody {
  bool goes_up = false;           ///< with the upper grip; else it stands
  Vec3 from_grip = Vec3::Zero();  ///< of its middle, from the middle of the upper grip, or of the lower one [m]
  double cylinder_radius = 0.0;   ///< 0: a block [m]
  Vec3 axis = Vec3::UnitY();      ///< of a cylinder
  Vec3 half_box(double h) const;  ///< half of the edges of the box around it, in a picture of a rod of radius h [m]
  double half_length(double h) const { return 6.0 * h; }  ///< that a cylinder is drawn with [m]
};

/// The lower grip first, then the upper one, then posts beside that which stands for the lower grip.
std::vector<GripBody> grip_bodies(const SpecimenOptions& specimen, const MachineOptions& machine,
                                  const Material& material);

}  // namespace knot_utm
