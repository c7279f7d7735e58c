#pragma once

#include <string>

namespace knot_utm {

/// Where a step that was not accepted was hardest: the node whose residual was the largest, or, where Newton's method
/// converged, that moved the furthest; and the deepest contact that it has a part in.
struct StepDiagnosis {
  int node = -1;            ///< -1: none
  double arclength = 0.0;   ///< of the node, at rest [m]
  double residual = 0.0;    ///< of the node, as Newton's method measures it: less by what its edges' tension eases [N]
  double motion = 0.0;      ///< of the node in this step [m]
  bool in_contact = false;  ///< what follows means something
  int roller = -1;          ///< that it touches; -1: a strand
  double contact_arclengths[2] = {};  ///< of the two strands; on a roller the first only [m]
  double overlap = 0.0;               ///< [m]
  bool slides = false;                ///< friction is saturated there

  /// One line.
  std::string text() const;
};

}  // namespace knot_utm
