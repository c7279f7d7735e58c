#pragma once

#include <memory>
#include <string>
#include <vector>

#include "knot_utm/machine/options.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/contact_force.hpp"
#include "knot_utm/sim/options.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// The specimen on the machine: rod, grips, rollers, tying rig, frame and load cell, stepped by commands.
/// The same bench answers a test program headless and under ROS; the same commands give the same bits.
///
/// Frame: z up and along the load axis, the lower grip's roller (or node, or clamp) near z = 0.
class TestingMachine {
 public:
  /// Ties nothing yet: the specimen in its starting shape. Throws InvalidInput where it does not fit the machine.
  TestingMachine(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                 const PhysicsOptions& physics);
  ~TestingMachine();
  TestingMachine(TestingMachine&&) noexcept;
  TestingMachine& operator=(TestingMachine&&) noexcept;

  /// Steps the physics to `command.time` and reads everything there. A sample of status kFailed leaves the bench
  /// at the last good step, and every later command gets the same answer.
  Sample respond(const Command& command);

  /// Once it has failed: the time step that could not be made, a file of saved_step.hpp; else empty.
  const std::string& failed_step() const;

  /// One sample for every accepted time step of the last command, the last of them what `respond` returned.
  const std::vector<Sample>& substeps() const;

  const RodProperties& rod() const;
  const RodState& state() const;
  Vec3 lower_grip() const;      ///< centre of roller, node or clamp [m]
  Vec3 upper_grip() const;      ///< [m]
  double time() const;          ///< that the physics has come to [s]
  double longest_step() const;  ///< longest time step of the chosen accuracy [s]: the longest command period

  /// Force in the rod at each edge, tension positive [N], as the last accepted step left it.
  Eigen::VectorXd tension() const;

  /// Between the strands, as the last accepted step left them; none where the physics has failed, the rod has parted,
  /// or before the first step. For pictures: nothing is computed before it is asked for.
  std::vector<ContactForce> contact_forces() const;

  /// That after the last command. Loaded into a bench made in the same way it answers all further commands to the same
  /// bits; `substeps` are not part of it.
  void state(Archive& archive);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace knot_utm
