#pragma once

#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/verdict/known_errors.hpp"

namespace knot_utm {

/// A limit up to which a result is trusted. Warnings, the report's certificate, diagnostics of nodes and the pages take
/// it from here (`tensile_test --list-limits`).
struct TrustLimit {
  const char* name;
  const char* key;       ///< of result.yaml, that is held against the limit
  double limit;          ///< the most that is trusted
  const char* unit;      ///< "-": dimensionless
  const char* sentence;  ///< what a larger value means
};

inline constexpr TrustLimit kDeepContact{"deep_contact", "max_penetration", 0.05, "of the radius",
                                         "strands overlap by more than any shipped material does at its largest load"};
inline constexpr TrustLimit kDeepSoftContact{
    "deep_soft_contact", "max_penetration", 1.0, "of the radius",
    "a section that gives is flattened by more than its law, of rubber cylinders, describes"};
inline constexpr TrustLimit kEnergiesDiffer{"energies_differ", "energy_balance_error", 0.01, "-",
                                            "the residual of Newton's method also shows in the forces"};
inline constexpr TrustLimit kForcesDiffer{"forces_differ", "force_balance_error", 0.01, "-",
                                          "the specimen moves while it is pulled, and the two grips bear other forces"};
inline constexpr TrustLimit kPlateauUnsure{"plateau_unsure", "plateau_force_error", 0.2, "of the true plateau force",
                                           "a finer run may give another sliding force"};
inline constexpr TrustLimit kMuchDrag{"much_drag", "drag_share", 0.01, "-", "drag has a part in the force"};
inline constexpr TrustLimit kMuchInertia{"much_inertia", "inertia_share", 0.01, "-", "inertia has a part in the force"};

/// The one up to which a contact of this rod is right.
inline const TrustLimit& deepest(const RodMaterial& material) {
  return material.is_soft() ? kDeepSoftContact : kDeepContact;
}
inline double deepest_contact(const RodMaterial& material) { return deepest(material).limit; }

/// All of them as CSV with the columns name, key, limit, unit and sentence.
std::string trust_limits_csv();

/// A warning, one line, where the plateau force may be wrong by more than a tenth. Otherwise empty.
std::string accuracy_warning(const Results& results, const ReadingErrors& errors);

/// All warnings that a reader of the results should know, one line each, and those of them that the console has.
std::vector<std::string> printed_warnings(const Results& results, const RunFacts& facts);
std::vector<std::string> all_warnings(const Results& results, const RunFacts& facts);

/// Warnings that are known of a method before anything is simulated, one line each. Among them are questions about a
/// rod that is like no rod there is, far beyond threads, ropes, wires and gels: most likely a slip of a unit.
std::vector<std::string> foreseen_warnings(const Method& method);

/// Warnings about speeds of the method.
std::vector<std::string> speed_warnings(const Method& method);

/// The rod in numbers that a person can check: "36.4 g/m at a diameter of 6.35 mm, E = 2.32 GPa stretched, ...".
std::string rod_in_words(const Material& material);

/// Advice for a knot that came undone: which values of the method to change so that it stays tied, in one line.
std::string what_keeps_a_knot(const Method& method);

}  // namespace knot_utm
