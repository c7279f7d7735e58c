#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/half_turn.hpp"

namespace knot_utm {

/// Where the parts of one overhand knot lie, as arclengths along the rod from its first node [m].
struct KnotLandmarks {
  double tail_end;        ///< the free end: 0 or the rod's length
  double tail_exit;       ///< where the tail leaves the knot, level with the outermost point of the coil
  double coil_middle;     ///< middle of the coil, on the knot's own strand
  double standing_begin;  ///< own strand, before the coil (5 h before the middle of a single winding)
  double threaded;        ///< the other strand, where it passes the middle of the coil
  int windings = 1;       ///< of its coil
  double longer = 0.0;  ///< length by which the coil exceeds that of a single winding, to either side of its middle [m]
  double runs_out = 0.0;  ///< distance that it may run outwards, as it tightens, beyond that of a single winding [m]
};

/// The loop as it is sketched and tied: two straight sides and two half circles, with the same length of rod as on the
/// rollers. Knots that need longer straight strands than the rollers would leave get them by narrower half circles.
struct SketchedLoop {
  double end_to_end = 0.0;  ///< distance of the half circles' centres [m]
  double radius = 0.0;      ///< of the half circles [m]
  double far_begin = 0.0;   ///< arclengths between which its far side is straight [m]
  double far_end = 0.0;
};

/// A node in a grip other than a roller, at which the specimen's length begins or ends, and its neighbour, which a
/// clamp holds as well.
struct HeldNode {
  int node = 0, next = 0;
  int edge() const { return node < next ? node : next; }  ///< between the two
};

/// An end by which a knot is tied: a free one, or one that the upper grip holds.
struct PulledEnd {
  int node = 0;
  Vec3 direction;         ///< unit
  double fraction = 1.0;  ///< of the pre-load F_p [-]
  int held_next = -1;     ///< of a held end, its neighbour (HeldNode::next); -1: it is free

  bool held() const { return held_next >= 0; }
};

/// A weight on the rod, which pulls along -z once the knot is tied.
struct HungWeight {
  int node = 0;
  double fraction = 1.0;  ///< of the pre-load F_p [-]
};

/// A length of the knot that its file asks for, between the nodes of two landmarks (specimen/knot_readings.hpp).
struct KnotReading {
  enum class Kind {
    kLoop,      ///< the rod around the first landmark that touches no strand [m]
    kBetween,   ///< the rod between the loops around both of them [m]
    kDistance,  ///< straight distance between the landmarks [m]
  };
  Kind kind = Kind::kLoop;
  int first = 0, second = 0;  ///< nodes; of a loop both are the same
};

/// A specimen's centreline before the test: an open polyline, and the places of its parts. Edges may be shorter in its
/// knots. Frame: z up and along the load axis. Arclengths are those of the polyline.
struct Centreline {
  Points points;  ///< nodes in order along the rod [m]
  /// The knots of a loop, for the rig that ties them: [0] the lower one at the rod's first end, [1] the upper one at
  /// its last.
  std::vector<KnotLandmarks> knots;
  double upper_apex = 0.0;  ///< of a loop: arclength of the top of the loop, on the upper roller [m]
  double lower_apex = 0.0;  ///< of a loop: arclength of the bottom of the loop [m]
  SketchedLoop loop;

  std::vector<int> cuts;                            ///< edges between one rope and the next (RodProperties::cuts)
  std::vector<HeldNode> held_lower, held_upper;     ///< ends of ropes in the grips; both empty: the rod's ends
  std::vector<int> free_ends;                       ///< nodes at the free ends of ropes, in order along the rod
  std::vector<std::vector<PulledEnd>> pull_groups;  ///< ends that are pulled together to tie the knot, in order
  std::vector<HungWeight> weights;
  std::vector<KnotReading> readings;  ///< of a knot from a file, in the order of the file

  /// That maps it onto itself, if one half of it may be solved for both (StepSettings::half_turn).
  std::optional<HalfTurn> half_turn;

  double length() const;                     ///< [m]
  int nearest_node(double arclength) const;  ///< to an arclength [m]
  /// Of the coil of each knot; 1 if no knot is known.
  int windings() const { return knots.empty() ? 1 : knots.front().windings; }
};

/// The strand that a coil holds runs on outwards from the middle of the sketched coil. At the first of these distances,
/// 8 h beyond the end of the knot, a clamp can hold it, and it stays straight for the second one behind the clamp [h].
inline constexpr double kThreadedBeyondKnot = 18.0, kStraightBeyondClamp = 3.0;

/// The sum of both distances [m]; `runs_out` as in KnotLandmarks.
inline double straight_strand(double radius, double runs_out = 0.0) {
  return (kThreadedBeyondKnot + kStraightBeyondClamp) * radius + runs_out;
}

/// A straight rod along z from the origin.
Centreline straight(double length, double radius, double edge_length);

/// Any polyline [m], resampled. Messages call the shape `name`. Edges are shorter by the factor `refinement` [-] from
/// the first to the last place where the rod comes near itself, or everywhere if it never does. Throws InvalidInput
/// (specimen.file, specimen.edge_length).
Centreline from_points(const Points& points, double radius, double edge_length,
                       const std::string& name = "the centreline", double refinement = 1.0);

/// Points of a CSV of x,y,z [m], one column a point. Up to two leading rows that are not numbers (names and units, as
/// final_shape.csv has them), empty rows and rows that begin with # are passed over.
/// Throws InvalidInput (key "specimen.file") where the file cannot be read, a row is not three numbers from -1000 to
/// 1000 m, two neighbours coincide, there are fewer than four points, or more rows than TextRows allows.
Points read_centreline(const std::string& file);
/// The same from a stream; `file` is its name in messages.
Points read_centreline(std::istream& in, const std::string& file);

/// Throws InvalidInput for `key` where strands of a rod of the given radius overlap, or where it runs through itself.
/// Strands overlap where two places that are further apart along the rod than 3 pi/2 radii are nearer to each other
/// than a diameter. Places nearer along the rod cannot touch unless the rod is bent more sharply than its own radius.
/// The message names both places by their arclengths; where the `origin` of a drawing is given [m], it names one place
/// in the drawing's coordinates, in radii. `radii`: of the ropes if they differ; `radius` is then that of the thickest
/// one.
void check_no_overlap(const Centreline& centreline, double radius, const char* key, const std::string& value,
                      const std::vector<double>& radii = {}, const Vec3* origin = nullptr);

struct RodProperties;
struct RodState;
struct SpecimenOptions;

/// Curves a rod at rest by the natural curvature kappa_0 that its specimen has from its reel or packet (doc/model.md,
/// section 2). In frames that are transported in parallel along the sketched centreline
///
///     kappabar_i = kappa_0 lbar_i (cos alpha, sin alpha),
///
/// alpha being the angle at the first edge of the side to which the rod curves: the x axis of the drawing, as far as it
/// is normal to the edge, or the y axis if the edge runs along x. Without a natural curvature nothing changes.
void give_rest_shape(const SpecimenOptions& specimen, const RodProperties& rod, RodState* state);

}  // namespace knot_utm
