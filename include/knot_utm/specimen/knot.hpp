#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "knot_utm/rod/material.hpp"
#include "knot_utm/sim/scene.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// What of the machine and the accuracy a centreline is laid for.
struct Mounting {
  bool rollers = false;          ///< two of them hold a loop; else nodes are held
  bool clamps = false;           ///< hold two nodes each, and the material frame of the edge between them
  double roller_diameter = 0.0;  ///< [m]
  double refinement = 1.0;       ///< edges in and between its knots are shorter by this factor [-]
};

/// What a grip other than a roller holds: the node from which the specimen's length counts, and the node next to it,
/// which a clamp holds as well.
struct HeldNode {
  int node = 0, next = 0;
  int edge() const { return node < next ? node : next; }  ///< between the two
};

/// What bears a specimen beside its grips, and stays as it is throughout a test.
struct Supports {
  std::vector<Roller> posts;     ///< fixed to the machine's base; the first one stands for the lower grip
  std::vector<NodeForce> loads;  ///< dead loads
};

/// Which study tells the errors of a knot's readings (machine/accuracy.hpp).
enum class ErrorStudy { kNone, kStraight, kFisherman };

/// What a knot is, whatever its keys say.
struct KnotDescription {
  const char* name = "";          ///< what a method calls it
  std::vector<std::string> keys;  ///< of `specimen`, that it has beside `knot` and `edge_length`
  /// How many knots are in it, and numbers in each list of a sample (PerKnot). Where there is one, strands touch: its
  /// edges must not be longer than the rod is thick, and its type is followed (KnotWatch).
  int knots = 0;
  /// Two strands bear the load, and rollers can hold it. It has two knots, each of which is tied into an end of the rod
  /// around the other strand: what is read between two knots is read of it.
  bool loop = false;
  double drawn_coil = 0.0;  ///< of a loop: radius of its coils' centreline before they are tied [h]
  bool any_shape = false;   ///< its shape is the user's own: any knot may be in it, and is followed
  bool straight = false;    ///< it never bends, so that nothing of it settles, twists or touches
  ErrorStudy error_study = ErrorStudy::kNone;

  bool may_hold_a_knot() const { return knots > 0 || any_shape; }
};

/// The face of a knot: what a specimen of this kind is made of, and everything that the program asks of one. A knot is
/// a pair of files in specimen/ and one line in knots.cpp. Nobody else asks which knot a specimen has.
class Knot {
 public:
  virtual ~Knot() = default;

  const KnotDescription& about() const { return about_; }
  bool has(const std::string& key) const;

  /// What `auto` stands for with a rod of radius h [m]. Keys that it does not have keep their plain value, so that they
  /// may stand in a method with it.
  virtual SpecimenOptions defaults(double h) const = 0;
  /// The same where some keys are `known`: where two must go together and one is set, the other makes room for it.
  virtual void suit(const SpecimenOptions& known, double roller_diameter, double h, SpecimenOptions& out) const;
  /// Of rollers that hold it [m].
  virtual std::optional<double> roller_diameter(double h) const;
  /// Extension of a pull whose `until.extension` is `auto` [m].
  virtual double pull(const SpecimenOptions& specimen, double h) const = 0;

  /// Throws InvalidInput where its keys do not go together.
  virtual void check(const SpecimenOptions& specimen, double h) const = 0;

  /// As it stands in the machine before anything moves, the lower grip at the origin, pulled along +z. Throws
  /// InvalidInput where it does not fit.
  virtual Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                                const Mounting& mounting) const = 0;
  /// Nothing where the grips hold both its ends. Where fixed posts bear its lower end, the upper grip alone holds it.
  virtual Supports supports(const SpecimenOptions& specimen, const Material& material) const;
  /// What the lower and the upper grip hold of it where there are no rollers.
  virtual HeldNode held_below(const Centreline& centreline, bool clamped) const;
  virtual HeldNode held_above(const Centreline& centreline, bool clamped) const;

  /// Of its keys the change that keeps a knot which came undone, "a larger specimen.end_to_end"; empty: none.
  virtual std::string what_keeps_it() const { return ""; }

 protected:
  explicit Knot(KnotDescription about) : about_(std::move(about)) {}

 private:
  KnotDescription about_;
};

/// All knots there are, in the order in which messages name them; the first is the default.
const std::vector<const Knot*>& knots();
const Knot& knot_of(KnotKind kind);
inline const Knot& knot_of(const SpecimenOptions& specimen) { return knot_of(specimen.knot); }
/// Throws InvalidInput ("specimen.knot") where no knot has this name.
KnotKind knot_named(const std::string& name);
std::vector<const char*> knot_names();
/// The knots that have a key of `specimen`, or that are loops, as a message lists them: "fisherman or overhand".
std::string knots_with(const std::string& key);
std::string loops();

/// F_p on each overhand of a loop [N]: what the specimen says, else what is usual for its material.
double tying_load(const SpecimenOptions& specimen, const Material& material);

}  // namespace knot_utm
