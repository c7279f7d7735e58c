#pragma once

namespace knot_utm {

struct Sample;

/// Moves the crosshead by the load. It uses only what a testing machine knows: the loads and displacements so far.
///
/// Following a course of the load:
///
///   v = (F_wanted - F)/(k T), |v| <= v_max,    k <- max(dF/dx, k/2)
///
/// with F the present load, F_wanted that of the next command, T the period of commands, and k [N/m] the specimen's
/// stiffness from the last command that moved, dF/dx. k rises at once and falls at most by half, so that the load does
/// not overshoot where the specimen becomes stiff, and catches up where it becomes soft. Before anything has moved the
/// speed is a hundredth of v_max.
///
/// Meeting a load: v_max, but no further than to where the load lies by the slope of the last command.
class LoadControl {
 public:
  /// Begins without knowledge of the stiffness.
  void begin() { *this = LoadControl(); }

  /// Speed of the crosshead until the next command, outwards positive [m/s].
  double following(const Sample& now, double wanted_load, double period, double fastest);

  /// Magnitude of the speed towards a load [m/s]. `creeps`: slowly as long as no slope is known.
  double meeting(const Sample& now, double wanted_load, double period, double fastest, bool creeps);

  /// Takes account of a new zero of the load [N].
  void shift(double load) { last_load_ -= load; }

 private:
  void learn(const Sample& now, double counting_distance);

  bool knows_last_ = false, knows_slope_ = false;
  double last_load_ = 0.0, last_displacement_ = 0.0;
  double slope_ = 0.0;      // dF/dx of the last command that moved [N/m]
  double stiffness_ = 0.0;  // k [N/m]
};

}  // namespace knot_utm
