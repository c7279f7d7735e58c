#pragma once

#include <Eigen/Core>
#include <optional>

namespace knot_utm {

enum class FrictionLaw { kMemory, kSmoothed };
enum class ContactLaw { kSmooth, kEdge };
enum class TwistMode { kAuto, kOn, kOff };
enum class Accuracy { kDraft, kNormal, kFine };

/// The `physics` section of a method. Values left unset follow from `accuracy`.
struct PhysicsOptions {
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< g [m/s^2]
  FrictionLaw friction_law = FrictionLaw::kMemory;    ///< friction.law: memory | smoothed
  double slip_tolerance = 1e-3;                       ///< friction.slip_tolerance v_s [m/s], `smoothed` only
  ContactLaw contact_law = ContactLaw::kSmooth;       ///< contact.law: smooth | edge
  TwistMode twist = TwistMode::kAuto;                 ///< twist: auto (where the scene can twist) | on | off
  Accuracy accuracy = Accuracy::kNormal;              ///< accuracy: draft | normal | fine
  std::optional<double> drag;  ///< viscous drag per length of rod [N s/m^2]; unset: what brings it to rest (scales.hpp)
  std::optional<double> inertia;            ///< mass that is accelerated, over the rod's own [-]; unset: see scales.hpp
  std::optional<double> contact_tolerance;  ///< contact.tolerance delta [fraction of radius]
  std::optional<double>
      presliding;  ///< friction.presliding, slip at which memory friction saturates [fraction of radius]
  std::optional<double> max_step;  ///< longest time step [s]
  std::optional<double> residual;  ///< tolerance of Newton's residual [k_b/h^2]
};

}  // namespace knot_utm
