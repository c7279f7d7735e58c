#pragma once

#include <cstddef>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/scene.hpp"

namespace knot_utm {

/// Grips that tie a knot: each pulls a free end along its direction, and slips at its load. An end is so pulled by
/// displacement against a grip that slips, and what comes out depends on neither drag, step nor speed.
class TailGrips {
 public:
  void add(int node, const Vec3& direction, double stiffness, double slip_force);
  void clear() { grips_.clear(); }
  bool empty() const { return grips_.empty(); }
  /// From grip `first` on none pulls yet, wherever its node is.
  void begin_at(const Points& position, std::size_t first = 0);

  /// Adds the grips to a step in which they move on by `way` [m].
  void add_to(Boundary& boundary, double way) const;
  /// Follows an accepted step in which they moved on by `way`: those that pull beyond their load slip.
  void move(const Points& position, double way);

  std::size_t size() const { return grips_.size(); }
  double force(std::size_t grip, const Points& position) const;  ///< [N]
  bool all_slip(const Points& position) const;
  const SlippingGrip& grip(std::size_t i) const { return grips_[i]; }

  /// Saves or loads their places; the grips are those that were added.
  void state(Archive& archive);

 private:
  std::vector<SlippingGrip> grips_;
};

}  // namespace knot_utm
