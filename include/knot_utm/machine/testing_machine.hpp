#pragma once

#include <memory>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/contact_force.hpp"
#include "knot_utm/sim/options.hpp"
#include "knot_utm/specimen/machine_options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

class Archive;
struct Centreline;
struct Command;
struct Material;
struct RodProperties;
struct RodState;
struct Sample;

/// The specimen on the machine: rod, grips, rollers, tying rig, frame and load cell, stepped by commands.
/// The same class serves tests without and with ROS; the same commands give the same bits.
///
/// Frame: z up and along the load axis, the lower grip's roller (or node, or clamp) near z = 0.
class TestingMachine {
 public:
  /// The specimen begins in its sketched shape, not tied. Throws InvalidInput where it does not fit the machine.
  TestingMachine(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                 const PhysicsOptions& physics);
  ~TestingMachine();
  TestingMachine(TestingMachine&&) noexcept;
  TestingMachine& operator=(TestingMachine&&) noexcept;

  /// Steps to `command.time` and reads everything there. After a sample with status kFailed or kBroken the machine
  /// stays at the last accepted step, and every later command gets the same answer.
  Sample respond(const Command& command);

  /// One sample for every accepted time step of the last command, the last of them what `respond` returned.
  const std::vector<Sample>& substeps() const;

  const Centreline& drawn() const;  ///< the specimen before the test
  const RodProperties& rod() const;
  const RodState& state() const;
  Vec3 lower_grip() const;      ///< centre of roller, node or clamp [m]
  Vec3 upper_grip() const;      ///< [m]
  double time() const;          ///< reached by the simulation [s]
  double longest_step() const;  ///< longest time step of the chosen accuracy [s]: the longest command period

  /// Tension of each edge after the last accepted step, pull positive [N]. NaN once the rod has parted.
  Eigen::VectorXd tension() const;

  /// Forces between the strands after the last accepted step, for pictures. Empty before the first step, after a
  /// failure, and once the rod has parted.
  std::vector<ContactForce> contact_forces() const;

  /// Force per length with which strands and rollers press on the rod, at each node after the last accepted step, for
  /// pictures: the sum of normal forces there over the node's Voronoi length [N/m]. Empty where `contact_forces` is.
  Eigen::VectorXd contact_load() const;

  /// Saves or loads the state after the last command, without `substeps`. A machine that was constructed in the same
  /// way and has loaded it answers all further commands with the same bits.
  void state(Archive& archive);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace knot_utm
