#pragma once

#include "knot_utm/machine/sample.hpp"

namespace knot_utm {

/// Moves the crosshead so that the load follows a set course. It knows no more than a testing machine does: loads and
/// displacements of the samples so far.
///
///   v = (F_wanted - F)/(k T), |v| <= v_max,    k <- max(dF/dx, k/2)
///
/// with F the load now, F_wanted that of the next command, T a command's period, and k the specimen's stiffness by the
/// last command that moved. It rises with the specimen's at once and falls by halves, so that what turns stiff is not
/// run past and what turns soft is caught up with. Before anything has moved it creeps at a hundredth of v_max.
class LoadControl {
 public:
  /// Speed of the crosshead until the next command, outwards positive [m/s].
  double speed(const Sample& now, double wanted_load, double period, double fastest);

  /// A new step knows nothing of the stiffness.
  void begin() { *this = LoadControl(); }

  void state(Archive& archive) { archive(knows_last_, last_load_, last_displacement_, stiffness_); }

 private:
  void learn(const Sample& now);

  bool knows_last_ = false;
  double last_load_ = 0.0, last_displacement_ = 0.0;
  double stiffness_ = 0.0;  // k [N/m]; 0: unknown
};

}  // namespace knot_utm
