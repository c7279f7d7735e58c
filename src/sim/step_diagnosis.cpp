#include "knot_utm/sim/step_diagnosis.hpp"

#include <sstream>

namespace knot_utm {

std::string StepDiagnosis::text() const {
  if (node < 0) return "nowhere in particular";
  std::ostringstream out;
  out << "worst at node " << node << ", " << arclength << " m along the rod (residual " << residual << " N, moved "
      << motion << " m)";
  if (!in_contact) return out.str() + ", which touches nothing";
  out << ", which touches ";
  if (roller >= 0) {
    out << "roller " << roller;
  } else {
    out << "a strand: " << contact_arclengths[0] << " m at " << contact_arclengths[1] << " m";
  }
  out << ", overlap " << overlap << " m, " << (slides ? "sliding" : "sticking");
  return out.str();
}

}  // namespace knot_utm
