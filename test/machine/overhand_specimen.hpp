#pragma once

#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// An overhand in so much rod, its ends so far apart, with edges of this length [m].
inline SpecimenOptions overhand_specimen(double length, double end_to_end, double edge_length) {
  SpecimenOptions out;
  out.knot = knot_named("overhand");
  out.length = length;
  out.end_to_end = end_to_end;
  out.edge_length = edge_length;
  return out;
}

}  // namespace knot_utm
