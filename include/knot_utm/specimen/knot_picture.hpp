#pragma once

#include <array>
#include <string>
#include <vector>

#include "knot_utm/contact/roller_contact.hpp"
#include "knot_utm/specimen/centreline.hpp"

namespace knot_utm {

/// What a picture of a knot shows.
struct PicturedKnot {
  std::string title;
  const Centreline& centreline;
  double radius = 0.0;                           ///< of the rod [m]
  std::vector<Roller> posts;                     ///< fixed
  std::vector<std::array<std::string, 2>> ends;  ///< names of the first and the last end of each rope
};

/// A picture as SVG, of two views: from the front and from the side (knot_facts.hpp). Each rope is a line of its
/// thickness and of a colour of its own, with a gap in what lies behind it; posts are grey.
std::string knot_svg(const PicturedKnot& knot);

}  // namespace knot_utm
