#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace knot_utm {

/// Number of a knot in the registry (knot.hpp); the first one, fisherman, is the default.
enum class KnotKind : std::size_t {};
enum class Handedness { kSame, kOpposite };
struct KnotDrawing;

/// The `specimen` section of a method.
struct SpecimenOptions {
  KnotKind knot{};
  std::shared_ptr<const KnotDrawing> drawing;  ///< of a knot that a file describes
  Handedness handedness = Handedness::kSame;   ///< fisherman
  int turns = 1;                               ///< overhand: how often the end goes through (1 to 4)
  std::string file;                            ///< knot: file, CSV of x,y,z [m]
  double knot_distance = 0.15;                 ///< e [m], fisherman
  double end_to_end = 0.25;                    ///< L [m]
  double length = 1.0;                         ///< straight and overhand: rod length [m]
  double tail = 0.03;                          ///< free tails [m]
  std::optional<double> preload;               ///< F_p [N]; unset (auto): material's tying_preload, else 4 k_b/h^2
  double wrap = 3.141592653589793;             ///< capstan: angle by which the rod lies around the post [rad]
  double post_diameter = 0.0381;               ///< capstan [m]
  std::optional<double> tail_load;             ///< capstan: T1 [N]; unset: auto
  double natural_curvature = 0.0;              ///< kappa_0 (centreline.hpp) [1/m]
  double edge_length = 0.0032;                 ///< discretisation [m]
  std::optional<double> refinement;            ///< edges between and within knots are shorter by this; unset: auto
  /// Not a key: the program ties it. e is then that of the tied knots, and the knots are sketched closer.
  bool to_be_tied = false;
};

}  // namespace knot_utm
