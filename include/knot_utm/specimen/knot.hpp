#pragma once

#include <optional>
#include <string>
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

/// The face of a knot: what a specimen of this kind is made of, and everything that the program asks of one. A knot is
/// a pair of files in specimen/ and one line in knots.cpp. Nobody else asks which knot a specimen has.
class Knot {
 public:
  /// Which study tells the errors of its readings (machine/accuracy.hpp).
  enum class ErrorStudy { kNone, kStraight, kFisherman };

  virtual ~Knot() = default;

  /// What a method calls it.
  virtual const char* name() const = 0;
  /// The keys of `specimen` that it has, beside `knot` and `edge_length`.
  virtual std::vector<std::string> keys() const = 0;
  bool has(const std::string& key) const;

  /// A loop: two strands bear the load, rollers can hold it, and the two overhands in it can be tied and mounted.
  virtual bool loop() const { return false; }
  /// Never bends, so that nothing of it settles, twists or touches.
  virtual bool straight() const { return false; }
  /// Strands touch in it: its edges must not be longer than the rod is thick.
  virtual bool knotted() const { return true; }
  /// Whether a knot may come undone in it: a shape from a file may hold one, too.
  bool may_hold_a_knot() const { return !straight() && !on_posts(); }
  /// Fixed posts and dead loads bear its lower end (`supports`): the upper grip alone holds it.
  virtual bool on_posts() const { return false; }
  virtual ErrorStudy error_study() const { return ErrorStudy::kNone; }

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
  /// One post or more where it lies `on_posts`; else nothing.
  virtual Supports supports(const SpecimenOptions& specimen, const Material& material) const;
  /// What the lower and the upper grip hold of it where there are no rollers.
  virtual HeldNode held_below(const Centreline& centreline, bool clamped) const;
  virtual HeldNode held_above(const Centreline& centreline, bool clamped) const;

  /// Of its keys the change that keeps a knot which came undone, "a larger specimen.end_to_end"; empty: none.
  virtual std::string what_keeps_it() const { return ""; }
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
