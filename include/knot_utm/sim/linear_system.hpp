#pragma once

#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/step_account.hpp"

namespace knot_utm {

struct SectionTurns;
template <int D>
class StepMatrix;

/// The linear system of one iteration, -(df/dq) dq = f, to which every force term adds its stiffness at the trial
/// positions that it evaluated last. A term whose force is linearised elsewhere than at these positions also adds the
/// difference to the right-hand side.
template <int D>
struct LinearSystem {
  const StepStart& start;
  const Points& x;            ///< trial positions [m]
  StepMatrix<D>& matrix;      ///< -df/dq [N/m]; it has located the contacts between strands
  std::vector<Lanes>& right;  ///< f [N], and torques on spins [N m]
  ContactLinearisation how;
  const SectionTurns* spins;  ///< of the sections; only where friction acts at the surfaces
};

}  // namespace knot_utm
