#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/tying/rest_watch.hpp"

namespace knot_utm {

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
