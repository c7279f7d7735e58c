#pragma once

#include <vector>

#include "knot_utm/machine/grip_bodies.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/ros/knot_places.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {

/// The camera of config/knot_utm.rviz. Its viewing direction is constant in a frame of /tf. The frame moves so that the
/// subject fills the picture, whatever the specimen and wherever the crosshead is.
struct Camera {
  static constexpr double kYaw = 1.74;            ///< nearly along y, across the rollers [rad]
  static constexpr double kPitch = 0.12;          ///< a little downwards [rad]
  static constexpr double kFieldOfView = 0.7854;  ///< vertical, as rviz has it [rad]
  /// width over height of the narrowest picture that still shows the whole subject
  static constexpr double kNarrowest = 0.7;
  static constexpr double kFilled = 0.9;  ///< largest fraction of the picture that is filled

  static Vec3 forwards();
  static Vec3 right();
  static Vec3 up();

  /// The place of a point in the picture of a camera at `eye`. The first two components are the distances to the right
  /// and upwards from the centre, in halves of the picture's height (the upper edge is at 1). The third is the distance
  /// ahead of the camera [m].
  static Vec3 project(const Vec3& eye, const Vec3& point);

  /// The nearest camera position from which a whole box is visible.
  static Vec3 eye_for(const Box& box);
};

/// A point that is viewed, and the position of the camera.
struct Look {
  Vec3 at = Vec3::Zero(), from = Vec3::Zero();  ///< [m]
};

struct Looks {
  Look machine, knots, lower_knot, upper_knot;
};

/// Chooses the views of a test. The view of the machine contains everything that was
/// visible since the specimen was made, released or mounted; from mounting on the camera only moves away. The views of
/// the knots follow them with a delay.
class Views {
 public:
  /// `cuts`: edges between one rope and the next.
  Views(const SpecimenOptions& specimen, const MachineOptions& machine, const Material& material,
        const std::vector<int>& cuts = {})
      : bodies_(grip_bodies(specimen, machine, material)), radius_(thickest(material)), cuts_(cuts) {}

  Looks look(const Points& points, const Vec3& lower_grip, const Vec3& upper_grip, const Sample& sample);

 private:
  std::vector<GripBody> bodies_;
  double radius_;  ///< of the thickest rope [m]
  std::vector<int> cuts_;
  bool seen_ = false;
  Phase phase_ = Phase::kIdle;
  Box all_{Vec3::Zero(), Vec3::Zero()};
  Looks last_;
};

}  // namespace knot_utm
