#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace knot_utm {

struct KnotDrawing;

/// Reads a knot from its file, config/knots/NAME.yaml or one of the user's. All lengths are in radii of the rod, and
/// the load axis is z:
///
///     title: Reef knot
///     use: Where it is used, in a sentence.
///     source: Ashley 1204                    # who describes it
///     strands:                               # each is a rope, drawn through its points
///       - ends: [lower, lower_tail]          # names of its two ends
///         points: [[0, 0, -12], ...]
///     lower: [lower]                         # ends that the grips hold; at least one by `upper`
///     upper: [upper]
///     posts:                                 # fixed cylinders; the first is the lower grip where that holds no end
///       - {through: [0, 0, 0], along: [0, 1, 0], radius: 6}   # grip: upper moves with that grip, which holds no end
///       - {through: [0, 0, 0], along: [0, 0, 1], radius: 2, ring: 5}   # the round edge of a hole
///     tie:                                   # ends that are pulled together, in order, to which part of F_p: free
///       - {lower_tail: 1, upper_tail: 1}     # ones, and those of the upper grip; the lower grip stands still
///       - {upper: 1, upper_tail: 0.5}        # one that is pulled again has this part from then on
///     weights: {upper_tail: 0.1}             # on free ends or landmarks, once it is tied: parts of F_p, along -z
///
/// `name`: what a method calls it.
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
