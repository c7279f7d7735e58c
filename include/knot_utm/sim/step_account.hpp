#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

struct Boundary;
struct RodState;

/// The start and the boundary of one time step. All of it stays unchanged until the step has ended.
struct StepStart {
  const RodState& state;     ///< x_n, v_n and the frames
  const Boundary& boundary;  ///< as it stands at the end of the step
  double dt;                 ///< [s]
  /// Where half of a rod is solved, inertia and drag are those relative to the middle between the grips: how far it
  /// moves in this step, and its velocity in the last one. Else zero.
  Vec3 middle_moves = Vec3::Zero();     ///< [m]
  Vec3 middle_velocity = Vec3::Zero();  ///< [m/s]
};

/// A step whose equations are solved, before the state is advanced.
struct SolvedStep : StepStart {
  const Points& end;        ///< x [m]
  const Points& increment;  ///< x - x_n [m]
  /// Sum of all forces except those of holders [N], and of torques about an edge's tangent [N m]. On free unknowns it
  /// is the imbalance that Newton's method left, on held ones the negative force of the holder.
  const std::vector<Lanes>& force;
  const std::vector<char>& held;  ///< which nodes are
};

/// Energies after the last accepted step. That of contact is known from the first step on.
struct Energies {
  double stretching = 0.0, bending = 0.0, twisting = 0.0, contact = 0.0, kinetic = 0.0;  ///< [J]
  double elastic() const { return stretching + bending + twisting; }
  double total() const { return elastic() + contact + kinetic; }

  void state(Archive& archive) { archive(stretching, bending, twisting, contact, kinetic); }
};

struct ContactReading {
  int touching = 0;              ///< integration points that carry force
  double normal_force = 0.0;     ///< sum of their normal forces [N]
  double largest_overlap = 0.0;  ///< between strands [m]
  /// Sum of (1 - eta) x x g [N m]: the part of friction's couple that the sections do not transmit
  /// (surface_contact.hpp). It is the whole couple where friction acts on the centrelines, which are apart by x. If
  /// friction acted where the surfaces meet, there would be none; here the grips bear it.
  Vec3 couple = Vec3::Zero();

  void state(Archive& archive) { archive(touching, normal_force, largest_overlap, couple); }
};

/// Where the work of the last accepted step went [J]. The sum follows from the step's equations and closes to rounding;
/// each term has a formula of its own:
///
///   boundary = change of Energies::total() + friction + drag + plastic + numerical + reweighting + residual
///
/// with dx = x - x_n the increment, E the elastic energies, F the forces of held nodes and rollers on the rod, and for
/// every contact its weight w, pressure p, slip s in the step, overlap D and energy e(D) per length:
///
///   boundary     sum 1/2 (F_n + F) . dx, and what slipping grips, forces and gravity do at the end of the step
///   friction     sum w mu p z . u, all work against friction, u the slip of the surfaces, and the work against
///                resistance to rolling. The energy of a presliding spring, less than mu p w xi_s/2 each, counts as
///                lost until it is given back
///   drag         sum c lbar |dx|^2/dt
///   plastic      what bending and stretching dissipate by their laws (bending_law.hpp, stretching_law.hpp)
///   numerical    that of the implicit Euler step, which takes all forces at its end:
///                  sum 1/2 m |v - v_n|^2 + E_n - E + dE/dx . dx + sum w [e(D_n) - e(D) - p n . s]
///                less 1/2 (F - F_n) . dx, by which forces at the end overestimate the work of the boundary
///   reweighting  contact energy at the last step's end less sum w e(D_n). Between two steps weights follow the shape
///                and feet come and go, which changes the stored energy without work; negative where it grows
///   residual     the imbalance that Newton's method left on free nodes, times their increments
///
/// The spin of an edge counts as the motion of a node does, with its own inertia, drag and torques. The work of the
/// regularisation r_j (frame_terms.hpp) is numerical.
struct StepWork {
  double boundary = 0.0;
  double friction = 0.0;
  double drag = 0.0;
  double plastic = 0.0;
  double numerical = 0.0;
  double reweighting = 0.0;
  double residual = 0.0;

  StepWork& operator+=(const StepWork& other) {
    boundary += other.boundary;
    friction += other.friction;
    drag += other.drag;
    plastic += other.plastic;
    numerical += other.numerical;
    reweighting += other.reweighting;
    residual += other.residual;
    return *this;
  }

  void state(Archive& archive) { archive(boundary, friction, drag, plastic, numerical, reweighting, residual); }
};

/// Sum of all loads on the rod in the last accepted step: holders, grips, springs, rollers, forces, weight, inertia and
/// drag, including those of spin. The force is the imbalance that Newton's method left. So is the moment, except for
/// the part of friction's couple that sections do not transmit (ContactReading::couple).
struct LoadSum {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 moment = Vec3::Zero();  ///< about the origin [N m]

  void add(const Vec3& place, const Vec3& f) {
    force += f;
    moment += place.cross(f);
  }
  void state(Archive& archive) { archive(force, moment); }
};

/// The account into which the terms of an accepted step enter their parts.
struct StepAccount {
  Energies energies;
  Energies before;  ///< those of the step before
  ContactReading contact;
  StepWork work;
  LoadSum loads;
};

}  // namespace knot_utm
