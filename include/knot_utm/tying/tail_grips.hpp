#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/scene.hpp"

namespace knot_utm {

struct RodMaterial;

/// How a sketched shape settles before it is tied: under a strong drag that fades. Otherwise the elastic energy of the
/// shape, which is an artefact of the sketch, would throw the strands about.
class Settling {
 public:
  static constexpr double kTime = 0.3;   ///< [s]
  static constexpr double kWave = 17.0;  ///< waves of this length relax in about a tenth of it [h]

  explicit Settling(const RodMaterial& material);

  /// `passed`: time since it began [s].
  static bool over(double passed) { return passed >= kTime; }
  double drag(double passed) const {
    const double left = std::clamp(1.0 - passed / kTime, 0.0, 1.0);
    return drag_ * left * left;
  }

 private:
  double drag_;  // [N s/m^2]
};

/// Waits for a specimen to come to rest: all nodes slower than `speed` for the time `duration`. If rest does not come
/// within `patience`, as where a knot creeps open, waiting ends, and `not_equilibrated` says so.
class RestWatch {
 public:
  struct Options {
    double speed = 0.0;      ///< [m/s]
    double duration = 0.3;   ///< [s]
    double patience = 60.0;  ///< [s]
  };
  explicit RestWatch(const Options& options) : options_(options) {}

  /// Counts the time at rest anew.
  void begin() { rested_ = 0.0; }
  /// Follows an accepted step of length `dt` [s].
  void follow(const Points& velocity, double dt);
  /// Whether everything is at rest, or `patience` is over at `time`. Waiting began at `begin` [s], with the event that
  /// `since` names for the message.
  bool waited(double time, double begin, const char* since);

  double patience() const { return options_.patience; }
  /// Message about what had not come to rest; empty: nothing.
  const std::string& not_equilibrated() const { return not_equilibrated_; }
  void forget() { not_equilibrated_.clear(); }

  void state(Archive& archive) { archive(rested_, fastest_, not_equilibrated_); }

 private:
  Options options_;
  double rested_ = 0.0, fastest_ = 0.0;  // [s], [m/s]
  std::string not_equilibrated_;
};

/// Grips that tie a knot: each pulls an end along its direction by a prescribed motion, and slips at its load. The tied
/// knot then depends on neither drag, time step nor speed.
class TailGrips {
 public:
  /// Replaces a grip that pulls at this node already.
  void add(int node, const Vec3& direction, double stiffness, double slip_force);
  void clear() { grips_.clear(); }
  bool empty() const { return grips_.empty(); }
  /// Places all grips at their nodes, so that none pulls yet.
  void begin_at(const Points& position);
  /// Places the grip at a node so that it pulls with this force, or with the force at which it slips if that is less.
  void begin_with(int node, double force, const Points& position);

  /// Adds the grips to the boundary of a step in which they move by `travel` [m].
  void add_to(Boundary& boundary, double travel) const;
  /// Follows an accepted step in which they moved by `travel`: those that pull with more than their load slip.
  void move(const Points& position, double travel);

  /// A pull is over once all grips slip at the same time and everything is at rest. If one sticks again after that
  /// time, it is waited for at most as long as for rest.
  void begin_pull() { reached_ = -1.0; }
  bool pull_is_over(const Points& position, double time, RestWatch& rest);
  /// A pull in which not all grips have slipped may go on for this time, and at least for this travel.
  struct Patience {
    double time = 90.0;     ///< [s]
    double travel = 300.0;  ///< [h]
  };
  /// Message about a pull that has gone on for longer; empty: it has not, or all have slipped.
  std::string lost_patience(const Patience& patience, const Points& position, double elapsed,
                            double travel_in_radii) const;

  std::size_t size() const { return grips_.size(); }
  double force(std::size_t grip, const Points& position) const;  ///< [N]
  double force_at(int node, const Points& position) const;       ///< 0 where no grip pulls [N]
  bool all_slip(const Points& position) const;
  const SlippingGrip& grip(std::size_t i) const { return grips_[i]; }

  /// Saves or loads their places and the state of the pull; the same grips must have been added before.
  void state(Archive& archive);

 private:
  std::vector<SlippingGrip>::iterator at(int node);

  std::vector<SlippingGrip> grips_;
  double reached_ = -1.0;  // time at which all slipped at once first; < 0: not yet [s]
};

}  // namespace knot_utm
