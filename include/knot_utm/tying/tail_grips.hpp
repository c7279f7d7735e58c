#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/specimen/scales.hpp"

namespace knot_utm {

/// How a sketched shape settles before it is tied: under a strong drag that fades. The energy of the sketched shape is
/// an artefact of the sketch and would otherwise throw the strands about.
class Settling {
 public:
  static constexpr double kTime = 0.3;   ///< [s]
  static constexpr double kWave = 17.0;  ///< waves of this length relax in about a tenth of it [h]

  explicit Settling(const RodMaterial& material) : drag_(settling_drag(material, kWave * material.radius, kTime)) {}

  /// So long after it began [s].
  static bool over(double passed) { return passed >= kTime; }
  double drag(double passed) const {
    const double left = std::clamp(1.0 - passed / kTime, 0.0, 1.0);
    return drag_ * left * left;
  }

 private:
  double drag_;  // [N s/m^2]
};

/// Waits for a specimen to come to rest: every node slower than a speed, for a while. Where rest does not come in time,
/// as where a knot creeps open, it is waited for no longer, and `not_equilibrated` says so.
class RestWatch {
 public:
  struct Options {
    double speed = 0.0;      ///< every node slower than this ... [m/s]
    double duration = 0.3;   ///< ... for this long: at rest [s]
    double patience = 60.0;  ///< without rest for this long it is waited for no longer [s]
  };
  explicit RestWatch(const Options& options) : options_(options) {}

  /// From now on it has not rested yet.
  void begin() { rested_ = 0.0; }
  /// Follows an accepted step of length `dt` [s].
  void follow(const Points& velocity, double dt);
  /// Whether everything is at rest, or rest has been waited for long enough by `time`, since `begin` [s], when what
  /// `since` says happened.
  bool waited(double time, double begin, const char* since);

  double patience() const { return options_.patience; }
  /// What had not come to rest; empty: nothing.
  const std::string& not_equilibrated() const { return not_equilibrated_; }
  void forget() { not_equilibrated_.clear(); }

  void state(Archive& archive) { archive(rested_, fastest_, not_equilibrated_); }

 private:
  Options options_;
  double rested_ = 0.0, fastest_ = 0.0;  // [s], [m/s]
  std::string not_equilibrated_;
};

/// Grips that tie a knot: each pulls an end along its direction, and slips at its load. An end is so pulled by
/// displacement against a grip that slips, and what comes out depends on neither drag, step nor speed.
class TailGrips {
 public:
  /// A grip that pulls at this node already is replaced.
  void add(int node, const Vec3& direction, double stiffness, double slip_force);
  void clear() { grips_.clear(); }
  bool empty() const { return grips_.empty(); }
  /// None pulls yet, wherever its node is.
  void begin_at(const Points& position);
  /// The grip at a node pulls with this force, or with that at which it slips.
  void begin_with(int node, double force, const Points& position);

  /// Adds the grips to a step in which they move on by `way` [m].
  void add_to(Boundary& boundary, double way) const;
  /// Follows an accepted step in which they moved on by `way`: those that pull beyond their load slip.
  void move(const Points& position, double way);

  /// A pull is over once all of them have slipped since it began, and everything is at rest. One that sticks again is
  /// waited for no longer than for rest.
  void begin_pull() { reached_ = -1.0; }
  bool pull_is_over(const Points& position, double time, RestWatch& rest);
  /// For how long a pull may go on before all of them have slipped.
  struct Patience {
    double time = 90.0;  ///< [s] ...
    double way = 300.0;  ///< ... and so far [h]
  };
  /// What is said of a pull that has gone on for longer; empty: it has not, or all have slipped.
  std::string lost_patience(const Patience& patience, const Points& position, double elapsed,
                            double way_in_radii) const;

  std::size_t size() const { return grips_.size(); }
  double force(std::size_t grip, const Points& position) const;  ///< [N]
  double force_at(int node, const Points& position) const;       ///< 0 where no grip pulls [N]
  bool all_slip(const Points& position) const;
  const SlippingGrip& grip(std::size_t i) const { return grips_[i]; }

  /// Saves or loads their places and how far the pull is; the grips are those that were added.
  void state(Archive& archive);

 private:
  std::vector<SlippingGrip>::iterator at(int node);

  std::vector<SlippingGrip> grips_;
  double reached_ = -1.0;  // when all had first slipped; < 0: not yet [s]
};

}  // namespace knot_utm
