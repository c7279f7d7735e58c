#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace knot_utm {

struct KnotDrawing;

/// Reads a knot from its file, config/knots/NAME.yaml or one of the user's, whose keys are in doc/knots.md and, all at
/// work, in examples/knot_of_your_own.yaml. All lengths are in radii of the rod, and the load axis is z. `name`: what a
/// method calls it. Throws InvalidInput.
std::shared_ptr<const KnotDrawing> read_knot_file(const std::filesystem::path& file, const std::string& name);

/// What is shown of a knot before anything pulls it.
struct KnotSheet {
  std::string name;   ///< of its file or as a method calls it
  std::string facts;  ///< a line each: title, use, strands, held, pulled, crossings, type, distance, bend
  std::string shape;  ///< JSON, of which python/knot_utm/knot_picture.py makes a picture
};

/// Of a knot that comes with the package or of a user's file, in the rod of the default material. Its free ends and the
/// strands to the grips are cut short. `option`: what names the knot, for messages.
KnotSheet knot_sheet(const std::string& knot, const std::string& option);

}  // namespace knot_utm
