#pragma once

#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// The force on the upper grip beyond that which reads zero [N]: what ends, turns and leads by a load. The cell's own
/// errors are in its readings only, so that how often it is read moves no test.
inline double balanced_load(const Sample& sample) { return sample.force_upper - sample.balance_offset; }

/// Moves the crosshead by the load. It knows no more than a testing machine does: loads and displacements so far.
///
/// Following a course of the load:
///
///   v = (F_wanted - F)/(k T), |v| <= v_max,    k <- max(dF/dx, k/2)
///
/// with F the load now, F_wanted that of the next command, T a command's period, and k the specimen's stiffness by the
/// last command that moved. It rises with the specimen's at once and falls by halves, so that what turns stiff is not
/// run past and what turns soft is caught up with. Before anything has moved it creeps at a hundredth of v_max.
///
/// Meeting a load: v_max, but no further than the slope of the last command says that the load is.
class LoadControl {
 public:
  /// Nothing is known of the stiffness.
  void begin() { *this = LoadControl(); }

  /// Speed of the crosshead until the next command, outwards positive [m/s].
  double following(const Sample& now, double wanted_load, double period, double fastest);

  /// Speed, as a size, towards a load [m/s]. `creeps`: as long as no slope is known.
  double meeting(const Sample& now, double wanted_load, double period, double fastest, bool creeps);

  /// In a new zero of the load [N].
  void shift(double load) { last_load_ -= load; }

  void state(Archive& archive) {
    archive(knows_last_, last_load_, last_displacement_, knows_slope_, slope_, stiffness_);
  }

 private:
  void learn(const Sample& now, double way_that_counts);

  bool knows_last_ = false, knows_slope_ = false;
  double last_load_ = 0.0, last_displacement_ = 0.0;
  double slope_ = 0.0;      // dF/dx of the last command that moved [N/m]
  double stiffness_ = 0.0;  // k [N/m]
};

}  // namespace knot_utm
