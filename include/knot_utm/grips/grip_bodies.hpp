#pragma once

#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/specimen/machine_options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

struct Material;

/// A body that holds or bears the specimen, for pictures: a cylinder for a roller, a post or a piece of a ring, a block
/// for a clamp or another holder of a node.
struct GripBody {
  bool goes_up = false;           ///< moves with the upper grip; else it stands still
  Vec3 from_grip = Vec3::Zero();  ///< of its middle, from the middle of the upper grip, or of the lower one [m]
  double cylinder_radius = 0.0;   ///< 0: a block [m]
  Vec3 axis = Vec3::UnitY();      ///< of a cylinder
  Vec3 half_box(double h) const;  ///< half the edges of its bounding box beside a rod of radius h [m]
  double piece = 0.0;             ///< length of a cylinder that is a piece of a ring; 0: of another one [m]
  /// Half the length with which a cylinder is drawn [m].
  double half_length(double h) const { return piece > 0.0 ? 0.5 * piece : 6.0 * h; }
};

/// The lower grip first, then the upper one, then posts other than those that are grips, and the other pieces of rings.
std::vector<GripBody> grip_bodies(const SpecimenOptions& specimen, const MachineOptions& machine,
                                  const Material& material);

}  // namespace knot_utm
