#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/specimen/centreline.hpp"

namespace knot_utm {

struct Roller;

/// A knot as its file describes it (method/knot_file.hpp). All lengths are in radii h of the thickest rope; the load
/// axis is z. Each strand is a rope. Grips hold and pull its ends by their names.
struct KnotDrawing {
  struct Strand {
    std::array<std::string, 2> ends;  ///< the first and the last one
    std::vector<Vec3> points;         ///< that the strand goes through [h]
  };
  /// A cylinder or a ring (Roller) that is fixed to the machine's base, or to the upper grip and moves with it.
  struct Post {
    Vec3 through = Vec3::Zero();  ///< a point of its axis, or the middle of the ring [h]
    Vec3 along = Vec3::UnitY();   ///< direction of its axis, unit
    double radius = 0.0;          ///< of its section [h]
    double ring = 0.0;            ///< of the circle in the middle of a ring's section; 0: a cylinder [h]
    bool upper = false;           ///< of the upper grip
  };
  struct Pull {
    std::string end;        ///< name of an end, or, of a weight, of an end or a landmark
    double fraction = 1.0;  ///< of the pre-load F_p [-]
  };
  /// One of the points of a strand, with a name.
  struct Landmark {
    std::string name;
    std::size_t strand = 0, point = 0;
  };
  struct Reading {
    std::string name;
    KnotReading::Kind kind = KnotReading::Kind::kLoop;
    std::size_t first = 0, second = 0;  ///< numbers of its landmarks
  };

  std::string name;    ///< as a method gives it
  std::string title;   ///< what a report calls it
  std::string use;     ///< where it is used
  std::string source;  ///< who describes it
  std::vector<Strand> strands;
  std::vector<std::string> lower, upper;  ///< ends that the grips hold
  std::vector<Post> posts;                ///< the first post of a grip that holds no end stands for the grip
  std::vector<Pull> weights;              ///< that hang on free ends and landmarks once the knot is tied
  std::vector<std::vector<Pull>> tie;     ///< ends that are pulled together, in order: free ones and upper ones
  std::vector<Landmark> landmarks;
  std::vector<Reading> readings;  ///< at most PerKnot::kMost
  std::string text;               ///< canonical form of its shape and of how it is tied: equal for equal knots

  enum class End { kLower, kUpper, kFree };
  End held(const std::string& end) const;
  bool has_free_ends() const { return lower.size() + upper.size() < 2 * strands.size(); }
  const Post* post_of(bool upper) const;  ///< the post that stands for a grip; null if the grip holds an end
  Vec3 point_in_lower_grip() const;       ///< the outermost point of the first strand that the lower grip holds [h]
  double bottom() const;  ///< the lowest z of all points, or of the middle of the post that is the lower grip [h]
  double top() const;     ///< the highest z, likewise [h]
};

/// The dimensions with which a drawing is sketched.
struct SketchSize {
  double radius = 0.0;       ///< h, of the thickest strand [m]
  double end_to_end = 0.0;   ///< L, from the lower grip to the upper one [m]
  double tail = 0.0;         ///< straight length of each free end beyond its last point [m]
  double edge_length = 0.0;  ///< of the thickest strand, before refinement [m]
  double first = 1.0;        ///< radius and edge length of the first strand, over those of the thickest one
  double others = 1.0;       ///< the same of all other strands
  double refinement = 1.0;   ///< edges are shorter by this factor [-]
};

/// Sketches a drawing as a rod. Each strand is a centripetal Catmull-Rom curve through its points. A held end runs on
/// straight along z to its grip, and a free one straight on. The shape is smoothed along its arclength by a Gaussian of
/// standard deviation h. The lower grip is at z = 0, and the knot half-way between the grips. Ropes are joined to one
/// rod by cut edges.
///
/// Source of the curve: Yuksel, Schaefer, Keyser 2011, "Parameterization and applications of Catmull-Rom curves".
Centreline sketch(const KnotDrawing& drawing, const SketchSize& size);

/// A post of a drawing whose origin stands at `origin` [m].
Roller roller_of(const KnotDrawing::Post& post, double radius, const Vec3& origin);

/// The least L between the grips of such a drawing [m]; if posts stand for both grips, the only one that is allowed.
double least_end_to_end(const KnotDrawing& drawing, double radius);

/// z of the drawing's origin above the lower grip [m].
double height_of_origin(const KnotDrawing& drawing, const SketchSize& size);

}  // namespace knot_utm
