#pragma once

#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/frame_terms.hpp"
#include "knot_utm/sim/roller_turns.hpp"
#include "knot_utm/sim/solved_step.hpp"
#include "knot_utm/sim/step_matrix.hpp"

namespace knot_utm {

/// The unknowns that the boundary prescribes: positions of fixed nodes, and angles of fixed material frames (known to
/// FrameTerms). Their rows in the linear system state that they do not change.
class HeldUnknowns {
 public:
  explicit HeldUnknowns(std::size_t nodes) : held_(nodes, 0) {}

  /// Moves the held nodes of a prediction to their prescribed positions.
  void begin(const StepStart& start, Points& x) {
    std::fill(held_.begin(), held_.end(), 0);
    for (const FixedNode& fixed : start.boundary.fixed_nodes) {
      held_[static_cast<std::size_t>(fixed.node)] = 1;
      x.col(fixed.node) = fixed.position;
    }
  }

  bool holds(int node) const { return held_[static_cast<std::size_t>(node)] != 0; }
  const std::vector<char>& nodes() const { return held_; }

  void prescribe(StepMatrix<3>& matrix, RollerTurns& turns, std::vector<Lanes>& right) const {
    for (int node = 0; node < count(); ++node) {
      if (!holds(node)) continue;
      matrix.values().set_identity_row(node);
      right[static_cast<std::size_t>(node)] = Lanes{0.0, 0.0, 0.0, 0.0};
      turns.hold(node, Lanes{0.0, 0.0, 0.0, 0.0});
    }
  }

  void prescribe(const FrameTerms& frames, StepMatrix<4>& matrix, RollerTurns& turns, std::vector<Lanes>& right) const {
    for (int node = 0; node < count(); ++node) {
      const double moves = holds(node) ? 0.0 : 1.0, spins = frames.held(node) ? 0.0 : 1.0;
      if (moves == 1.0 && spins == 1.0) continue;
      const Lanes keep = {moves, moves, moves, spins};
      matrix.values().set_identity_row(node, keep);
      right[static_cast<std::size_t>(node)] *= keep;
      turns.hold(node, keep);
      // A held angle does not change, so the spin equals the rotation by parallel transport alone.
      if (spins == 0.0 && node + 1 < count())
        add_to_row(3, frames.lean(node), matrix.band(node, 0, 0), matrix.band(node, 0, 1));
    }
  }

 private:
  int count() const { return static_cast<int>(held_.size()); }

  /// Adds the row `times` . (x_i - x_{i+1}) to the blocks (i, i) and (i, i+1).
  static void add_to_row(int row, const Vec3& times, Block<4>& own, Block<4>& next) {
    for (int j = 0; j < 3; ++j) {
      own.at(row, j) += times[j];
      next.at(row, j) -= times[j];
    }
  }

  std::vector<char> held_;
};

}  // namespace knot_utm
