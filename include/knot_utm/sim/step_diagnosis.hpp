#pragma once

#include <string>

namespace knot_utm {

/// Where the solution of a step that was not accepted failed: the node with the largest residual or, where Newton's
/// method converged, the one that moved the furthest; and the deepest contact of that node.
struct StepDiagnosis {
  int node = -1;                      ///< -1: none
  double arclength = 0.0;             ///< of the node, at rest [m]
  double residual = 0.0;              ///< of the node, divided by its tolerance scaling (scene.hpp) [N]
  double motion = 0.0;                ///< of the node in this step [m]
  bool in_contact = false;            ///< the members below are valid
  int roller = -1;                    ///< that it touches; -1: a strand
  double contact_arclengths[2] = {};  ///< of the two strands; on a roller the first only [m]
  double overlap = 0.0;               ///< [m]
  bool slides = false;                ///< friction is saturated there

  /// One line.
  std::string text() const;
};

}  // namespace knot_utm
