#pragma once

#include <memory>
#include <string>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/sim/scene.hpp"

namespace knot_utm {

struct Centreline;
class Grips;
struct Material;
struct Sample;
struct SpecimenOptions;
class TimeStep;

/// Ties a specimen on the machine, and holds it until the grips do. There is one class for loops and one for knots that
/// are tied by their ends; by default, a member does nothing.
class Tying {
 public:
  virtual ~Tying() = default;

  /// Places of the crosshead and the upper grip at a time.
  struct Place {
    double time;          ///< [s]
    double displacement;  ///< of the crosshead [m]
    double grip;          ///< of the upper grip [m]
  };

  /// To be called before the first command of a step of the program.
  virtual void enter(const Command& command, const Place& now) = 0;
  /// To be called before a time step, also before one that is tried again: makes the changes that it is to solve.
  virtual void prepare(const Place& /*now*/) {}
  /// To be called after an accepted time step of length `dt` [s].
  virtual void follow(Phase phase, const Place& now, double dt) = 0;
  /// To be called after a command: lets go of what the program no longer holds.
  virtual void leave(Phase /*phase*/, const Place& /*now*/) {}

  /// Adds its clamps, grips and forces to the boundary of a step between two times [s], or puts them in place of those
  /// of the machine's grips.
  virtual void hold(Boundary& boundary, double from, double to) const = 0;
  /// Drag beside that of the method, in a step until this time [N s/m^2].
  virtual double extra_drag(double /*to*/) const { return 0.0; }

  /// Fraction of the time for putting a loop on the rollers that is left.
  virtual double left_to_put_on(double /*time*/) const { return 0.0; }
  /// Fraction of its weight that the specimen has at a time.
  virtual double weight_borne(double /*time*/) const { return 1.0; }
  /// Length of the strands from the upper grip to what holds them below, as mounted [m].
  virtual double held_length(double from, double to) const = 0;
  /// Velocity of the crosshead while it takes up the slack of mounting, at most `speed` [m/s].
  virtual double mounting_velocity(double /*speed*/) const { return 0.0; }

  /// Whether a phase that ends by itself has ended.
  virtual bool done(Phase phase) const = 0;
  /// Why the specimen cannot be tied or mounted; empty: it can.
  virtual const std::string& gave_up() const = 0;
  virtual const std::string& not_equilibrated() const = 0;

  /// For KnotWatch: the standing nodes of a loop's knots.
  virtual std::vector<int> standing_nodes() const { return {}; }
  /// Reads its knots into the fields of a sample.
  virtual void read(Sample& /*sample*/) const {}

  virtual void state(Archive& archive) = 0;
};

/// Null if the specimen is not tied. `creep_speed`: speed with which nodes of a rod at rest may creep
/// under its friction [m/s]. `stepper` and `grips` must outlive it.
std::unique_ptr<Tying> make_tying(const SpecimenOptions& specimen, const Material& material,
                                  const Centreline& centreline, double creep_speed, TimeStep& stepper, Grips& grips);

}  // namespace knot_utm
