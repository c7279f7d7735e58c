#pragma once

#include <vector>

#include "knot_utm/machine/grip_bodies.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/ros/knot_places.hpp"

namespace knot_utm {

/// The camera of config/knot_utm.rviz. It stands in a frame of /tf and looks in a direction that never changes; the
/// frame moves, so that what is to be seen fills the picture whatever the specimen and wherever the crosshead is.
struct Camera {
  static constexpr double kYaw = 1.74;            ///< nearly along y, across the rollers [rad]
  static constexpr double kPitch = 0.12;          ///< a little downwards [rad]
  static constexpr double kFieldOfView = 0.7854;  ///< vertical, as rviz has it [rad]
  static constexpr double kNarrowest = 0.7;       ///< width over height of a picture that still shows all
  static constexpr double kFilled = 0.9;          ///< fraction of the picture that is filled, at most

  static Vec3 forwards();
  static Vec3 right();
  static Vec3 up();

  /// Where a point is seen from `eye`: to the right and up from the middle, in halves of the height of the picture
  /// (its upper edge is at 1), and how far ahead of the eye [m].
  static Vec3 project(const Vec3& eye, const Vec3& point);

  /// The nearest place from which all of a box is seen in such a picture.
  static Vec3 eye_for(const Box& box);
};

/// What is looked at, and from where.
struct Look {
  Vec3 at, from;  ///< [m]
};

struct Looks {
  Look machine, knots, lower_knot, upper_knot;
};

/// The looks at one test after the other. That at the machine holds all that was to be seen since the specimen was
/// made, let go or mounted: from mounting on it only ever moves away. Those at the knots follow them a little slower
/// than the knots move.
class Views {
 public:
  Views(const SpecimenOptions& specimen, const MachineOptions& machine, const Material& material)
      : bodies_(grip_bodies(specimen, machine, material)), radius_(material.radius) {}

  void begin() { seen_ = false; }  ///< a new specimen

  Looks look(const Points& points, const Vec3& lower_grip, const Vec3& upper_grip, const Sample& sample);

 private:
  std::vector<GripBody> bodies_;
  double radius_;  ///< of the rod [m]
  bool seen_ = false;
  Phase phase_ = Phase::kIdle;
  Box all_{Vec3::Zero(), Vec3::Zero()};
  Looks last_;
};

}  // namespace knot_utm
