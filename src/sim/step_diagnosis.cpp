#include "knot_utm/sim/step_diagnosis.hpp"

#include <sstream>

namespace knot_utm {

std::string StepDiagnosis::text() const {
  if (node < 0) return "no node stands out";
  std::ostringstream out;
  out << "the residual is largest at node " << node << ", " << arclength << " m along the rod: " << residual
      << " N; the node moved " << motion << " m and touches ";
  if (!in_contact) return out.str() + "nothing";
  if (roller >= 0) {
    out << "roller " << roller;
  } else {
    out << "another strand, " << contact_arclengths[0] << " m along the rod at " << contact_arclengths[1] << " m";
  }
  out << ", with an overlap of " << overlap << " m, " << (slides ? "sliding" : "sticking");
  return out.str();
}

}  // namespace knot_utm
