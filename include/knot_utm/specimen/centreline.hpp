#pragma once

#include <vector>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// Where the parts of one overhand knot lie, as arclengths along the rod from its first node [m].
struct KnotLandmarks {
  double tail_end;        ///< the free end: 0 or the rod's length
  double tail_exit;       ///< where the tail leaves the knot, the outermost point of the coil being level with it
  double coil_middle;     ///< middle of the coil, on the knot's own strand
  double standing_begin;  ///< own strand, 5 h before the knot's middle, where the standing part begins
  double threaded;        ///< the other strand, where it passes the middle of the coil
};

/// A specimen's centreline at rest: an open polyline of equal edges, and where its parts lie.
/// Frame: z up and along the load axis. Arclengths are those of the polyline.
struct Centreline {
  Points points;                     ///< nodes in order along the rod, all edges of equal length [m]
  bool closed_by_tails = false;      ///< the test's knot is that of the loop closed by joining the two tails
  bool closed = false;               ///< the last node lies on the first
  std::vector<KnotLandmarks> knots;  ///< fisherman: [0] lower knot at the rod's first end, [1] upper at its last
  double upper_apex = 0.0;           ///< fisherman: arclength of the top of the loop, on the upper roller [m]
  double lower_apex = 0.0;           ///< fisherman: arclength of the bottom of the loop [m]

  double edge_length() const;  ///< of every edge [m]
  double length() const;       ///< [m]
};

/// The fisherman's loop: one open rod laid once around two rollers, each end tied by an overhand knot around the
/// other strand.
///
/// Rollers lie along y, centres at the origin and at (0, 0, end_to_end); the loop lies in the x-z plane, its straight
/// side at x < 0, the knots at x > 0, `knot_distance` apart along z and symmetric about z = end_to_end/2. In
/// cylindrical coordinates about the knots' axis, each knot's standing part runs outwards at radius a, turns by a half
/// circle to radius R, coils by 450 degrees over an axial length 4 h back over itself, turns in to radius b and leaves
/// as a tail inside its own coil, outwards. The threaded strand runs through the coil at radius a opposite the
/// standing part. With a = (2 - sqrt 3) R and b = R - 2 a the standing part, the threaded strand, the tail and the
/// coil are equally far apart, 2 a. The whole is smoothed along arclength by a Gaussian of standard deviation h.
///
/// Same-handed: the two knots are images of each other under a half turn about an axis normal to the load axis.
/// Opposite-handed: the lower knot is the mirror image of that.
struct FishermanShape {
  double radius = 3.175e-3;        ///< h, of the rod [m]
  double knot_distance = 0.1;      ///< e, distance of the middles of the two coils [m]
  double end_to_end = 0.25;        ///< L, distance of the rollers' centres [m]
  double roller_radius = 0.01905;  ///< [m]
  double tail = 0.03;              ///< free tail beyond the outermost point of the coil [m]
  Handedness handedness = Handedness::kSame;
  double looseness = 4.7;       ///< R/h, radius of the coil over that of the rod (3.9 to 8)
  double edge_length = 0.0032;  ///< wanted; the nearest that divides the rod evenly is taken [m]
};

/// Throws InvalidInput (specimen.*, machine.roller_diameter) where the shape does not fit on the machine or overlaps.
Centreline fisherman_loop(const FishermanShape& shape);

/// An open overhand knot whose end goes `turns` times through the loop, in a rod along z, its ends at the origin and
/// at (0, 0, end_to_end): the (2, 2 turns + 1) torus knot once its ends are joined outside.
///
/// Two strands wind around each other by (2 turns + 1) half turns over a braid of length 2 pi 12^(1/4) sqrt(h R) a
/// full turn (Jawed, Dieleman, Audoly, Reis 2015), and a loop with two half circles of radius R joins its ends. R
/// follows from the excess length, length - end_to_end: the larger, the looser.
struct OverhandShape {
  double radius = 3.175e-3;     ///< h [m]
  int turns = 1;                ///< 1 to 4
  double length = 1.0;          ///< of the rod [m]
  double end_to_end = 0.7;      ///< distance of the rod's ends [m]
  double edge_length = 0.0032;  ///< wanted [m]
};

/// Throws InvalidInput (specimen.*) where the excess length is too short for the knot or too long for the rod.
Centreline overhand(const OverhandShape& shape);

/// A straight rod along z from the origin.
Centreline straight(double length, double radius, double edge_length);

/// Any polyline [m], resampled. Closed: the last point joins the first, and the last node lies on the first.
/// Throws InvalidInput (specimen.file, specimen.edge_length).
Centreline from_points(const Points& points, bool closed, double radius, double edge_length);

/// Resamples a polyline into the whole number of equal chords nearest to `edge_length`; first and last point stay.
/// `position` (optional) gets the arclength on `points` of every node.
Points resample_evenly(const Points& points, double edge_length, std::vector<double>* position = nullptr);

/// Smallest distance between any two places of a polyline that lie at least `exclusion` apart along it [m]; infinity
/// where there are none. Closed: its last point lies on its first, and "along it" is the shorter way round.
double smallest_distance(const Points& points, double exclusion, bool closed = false);

/// Throws InvalidInput for `key` where strands of a rod of the given radius overlap: two places further apart along
/// the rod than 3 pi/2 radii (any nearer ones cannot touch unless the rod is bent more sharply than its own radius)
/// nearer to each other than a diameter.
void check_no_overlap(const Centreline& centreline, double radius, const char* key, const std::string& value);

}  // namespace knot_utm
