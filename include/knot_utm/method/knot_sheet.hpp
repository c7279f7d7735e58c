#pragma once

#include <string>

namespace knot_utm {

/// What is shown of a knot before anything pulls it.
struct KnotSheet {
  std::string name;   ///< of its file or as a method calls it
  std::string facts;  ///< a line each: title, use, strands, held, pulled, crossings, type, distance, bend
  std::string shape;  ///< JSON, of which python/knot_utm/knot_picture.py makes a picture
};

/// Of a knot that comes with the package or of a user's file, in the rod of the default material. Its free ends and the
/// strands to the grips are cut short. `option`: what names the knot, for messages. Throws InvalidInput where there is
/// no such knot, or where it cannot be drawn.
KnotSheet knot_sheet(const std::string& knot, const std::string& option);

}  // namespace knot_utm
