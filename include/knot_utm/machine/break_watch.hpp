#pragma once

#include <string>

#include "knot_utm/machine/fracture.hpp"
#include "knot_utm/numeric/archive.hpp"

namespace knot_utm {

/// Judges time steps of a rod that can part. A step should end where the rod parts, and no rod parts in a step that
/// takes it to a multiple of its strength: such a step is too long, or wrong. It is refused, so that it is tried again
/// at half its length; a run whose shortest step is refused is given up.
class BreakWatch {
 public:
  /// `shortest`: steps are no shorter than this for a break that is near [s].
  explicit BreakWatch(double shortest) : shortest_(shortest) {}

  /// Of a step that leads from one exposure to another in the time dt [s]. Empty: it is accepted, or why it is not.
  std::string refuse(const Exposure& from, const Exposure& to, double dt) const;

  /// After an accepted step: whether the rod has parted. Where it has not, `next` is how long the next step may be.
  bool parts(const Exposure& now, double dt);
  double next() const { return next_; }  ///< [s]

  void state(Archive& archive) { archive(before_); }

 private:
  double shortest_;
  double before_ = 0.0;  ///< fraction of the exposure after the last step
  double next_ = 0.0;
};

/// What a rod cannot do: part by tension while its grips are pressed together, by a `force` < 0 [N]. Empty, or what is
/// wrong.
std::string not_by_tension(const Exposure& parted, double force);

}  // namespace knot_utm
