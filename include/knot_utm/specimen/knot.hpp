#pragma once

#include <optional>
#include <string>
#include <vector>

#include "knot_utm/sim/scene.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

struct Material;

/// The properties of the machine and of the accuracy on which a centreline depends.
struct Mounting {
  bool rollers = false;          ///< two of them hold a loop; else nodes are held
  bool clamps = false;           ///< hold two nodes each, and the material frame of the edge between them
  double roller_diameter = 0.0;  ///< [m]
  double refinement = 1.0;       ///< edges in and between its knots are shorter by this factor [-]
};

/// Bodies and loads that bear a specimen besides its grips, the same throughout a test.
struct Supports {
  std::vector<Roller> posts;     ///< fixed to the machine's base; the first one may stand for the lower grip
  std::vector<Roller> pins;      ///< fixed to the upper grip, for which the first one stands
  std::vector<NodeForce> loads;  ///< dead loads
};

/// The study from which the errors of a knot's readings are known (settings/accuracy.hpp).
enum class ErrorStudy { kNone, kStraight, kFisherman, kSketchedKnot };

/// Properties of a knot that do not depend on its keys.
struct KnotDescription {
  const char* name = "";          ///< what a method calls it
  const char* title = "";         ///< what a report calls it
  std::vector<std::string> keys;  ///< its keys in `specimen` besides those of all knots, in the order of a report
  /// Number of knots, and of the values in each list of a sample (PerKnot). With one or more, strands touch: edges must
  /// then not be longer than the rod's diameter, and the type of the knot is followed (KnotWatch).
  int knots = 0;
  /// Two strands bear the load, and rollers can hold it. It has two knots, each tied into an end of the rod around the
  /// other strand, so that it has the readings between two knots.
  bool loop = false;
  double sketched_coil = 0.0;  ///< of a loop: radius of its coils' centreline before they are tied [h]
  bool any_shape = false;      ///< the user gives its shape, which may contain any knot; the type is followed
  bool tied_by_ends = false;   ///< of a knot from a file: tied by pulling at its ends
  bool straight = false;       ///< it never bends, so that it does not settle, twist or touch itself
  ErrorStudy error_study = ErrorStudy::kNone;

  bool can_be_tied() const { return loop || tied_by_ends; }
  bool may_hold_a_knot() const { return knots > 0 || any_shape; }
};

/// The interface of a knot: how a specimen of this kind is sketched, held and pulled. A knot is a file in src/specimen
/// and named in knots.cpp. No other code distinguishes knots.
class Knot {
 public:
  virtual ~Knot() = default;

  const KnotDescription& about() const { return about_; }
  /// Whether it takes a key: one of its own, or one that all knots have (`knot`, `edge_length`).
  bool has(const std::string& key) const;

  /// The values of `auto` for a rod of radius h [m]. Keys that the knot does not have keep their plain values, so that
  /// they may stand in its method.
  virtual SpecimenOptions defaults(double h) const = 0;
  /// Adapts defaults in `out` to keys that are set, whose values are in `known`, where two keys must agree.
  virtual void suit(const SpecimenOptions& /*known*/, double /*roller_diameter*/, double /*h*/,
                    SpecimenOptions& /*out*/) const {}
  /// Default diameter of rollers that hold it [m]; empty: none do.
  virtual std::optional<double> roller_diameter(double /*h*/) const { return {}; }
  /// Extension of a pull whose `until.extension` is `auto` [m].
  virtual double pull(const SpecimenOptions& specimen, double h) const = 0;

  /// Extension beyond which its rod would leave what supports it [m]; empty: none.
  virtual std::optional<double> longest_pull(const SpecimenOptions& /*specimen*/, double /*h*/) const { return {}; }

  /// Throws InvalidInput where its keys do not go together.
  virtual void check(const SpecimenOptions& specimen, double h) const = 0;

  /// The centreline in the machine before anything moves. The lower grip is at the origin; the upper one will pull
  /// along +z. Throws InvalidInput where it does not fit.
  virtual Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                                const Mounting& mounting) const = 0;
  /// Empty where the grips hold its ends alone.
  virtual Supports supports(const SpecimenOptions& /*specimen*/, const Material& /*material*/) const { return {}; }
  /// The nodes that the lower and the upper grip hold where there are no rollers.
  virtual std::vector<HeldNode> held_lower(const Centreline& centreline, bool clamped) const;
  virtual std::vector<HeldNode> held_upper(const Centreline& centreline, bool clamped) const;

 protected:
  KnotDescription about_;  ///< set by the constructor of a knot
};

/// All knots there are, in the order in which messages name them; the first is the default.
const std::vector<const Knot*>& knots();
const Knot& knot_of(KnotKind kind);
inline const Knot& knot_of(const SpecimenOptions& specimen) { return knot_of(specimen.knot); }
/// Whether the type of its knot is followed (KnotWatch): of one rod with both ends held, or of a loop. To close any
/// other rod into a knot, one would have to decide how its free ends lie.
bool type_is_followed(const SpecimenOptions& specimen);
/// Whether one rope runs from grip to grip with one knot in it. The rope of a shape from a file may have several.
bool one_knot_in_line(const SpecimenOptions& specimen);
/// Number of strands that bear the load side by side: two of a loop, else as many ends as each grip holds.
int bearing_strands(const SpecimenOptions& specimen);
/// Throws InvalidInput ("specimen.knot") where no knot has this name.
KnotKind knot_named(const std::string& name);
/// What a method may call a knot, in the order of the registry: one that has a drawing by its name.
std::vector<std::string> knot_names(const KnotDrawing* drawing);
/// The knots that have a key of `specimen`, that are loops, or that a program can tie, as a message lists them:
/// "fisherman or overhand".
std::string knots_with(const std::string& key);
std::string loops();
std::string knots_that_can_be_tied();

/// F_p on each overhand of a loop [N]: that of the specimen, else default_preload of its material.
double tying_load(const SpecimenOptions& specimen, const Material& material);

/// Sum of the weights that hang on a knot from a file [N].
double hung_weight(const SpecimenOptions& specimen, const Material& material);

/// T1 of a capstan [N]; `specimen.tail_load: auto` is k_b/h^2, but at most k_s/100.
double tail_load(const SpecimenOptions& specimen, const Material& material);

}  // namespace knot_utm
