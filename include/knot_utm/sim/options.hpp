#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "knot_utm/contact/friction_options.hpp"

namespace knot_utm {

enum class TwistMode { kAuto, kOn, kOff };
enum class FrictionAt { kSurface, kCentreline };
enum class Symmetry { kAuto, kOff };
enum class Accuracy { kDraft, kNormal, kFine };
/// What the friction between ropes of two materials is of their coefficients: the smaller one, the mean, the product
/// (as in Bullet), or its root, the geometric mean (as in Jolt and Box2D).
enum class PairRule { kSmaller, kMean, kProduct, kRootOfProduct };
inline constexpr std::array kPairRules{"smaller", "mean", "product", "root_of_product"};

/// The `physics` section of a method. Values left unset follow from `accuracy`.
struct PhysicsOptions {
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< g [m/s^2]
  FrictionOptions friction;                           ///< friction.law and the keys of that law
  FrictionAt friction_at = FrictionAt::kSurface;      ///< friction.at: surface | centreline
  PairRule pair_rule = PairRule::kSmaller;            ///< friction.pair: smaller | mean | product | root_of_product
  std::optional<double> pair_friction;                ///< friction.pair as a number, which goes before the rule [-]
  TwistMode twist = TwistMode::kAuto;                 ///< twist: auto (where the scene can twist) | on | off
  Symmetry symmetry = Symmetry::kAuto;    ///< symmetry: auto (one half is solved where it stands for both) | off
  Accuracy accuracy = Accuracy::kNormal;  ///< accuracy: draft | normal | fine
  std::optional<double> drag;  ///< viscous drag per length of rod [N s/m^2]; unset: what brings it to rest (scales.hpp)
  std::optional<double> inertia;            ///< mass that is accelerated, over the rod's own [-]; unset: see scales.hpp
  std::optional<double> contact_tolerance;  ///< contact.tolerance delta [fraction of radius]
  std::optional<double> max_step;           ///< longest time step [s]
  std::optional<double> residual;           ///< tolerance of Newton's residual [k_b/h^2]
};

}  // namespace knot_utm
