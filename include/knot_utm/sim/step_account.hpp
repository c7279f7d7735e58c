#pragma once

#include <Eigen/Geometry>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// Of the last accepted step. Contact has an energy from the first one on.
struct Energies {
  double stretching = 0.0, bending = 0.0, twisting = 0.0, contact = 0.0, kinetic = 0.0;  ///< [J]
  double elastic() const { return stretching + bending + twisting; }
  double total() const { return elastic() + contact + kinetic; }

  void state(Archive& archive) { archive(stretching, bending, twisting, contact, kinetic); }
};

struct ContactReading {
  int touching = 0;              ///< points of integration that carry force
  double normal_force = 0.0;     ///< sum of their normal forces [N]
  double largest_overlap = 0.0;  ///< between strands [m]
  /// Sum of (1 - eta) x x g, the couple of friction that the sections do not take (surface_contact.hpp): all of it
  /// where it acts on the centrelines, which are apart by x. Where the strands' surfaces meet there would be none; the
  /// grips feel it. [N m]
  Vec3 couple = Vec3::Zero();

  void state(Archive& archive) { archive(touching, normal_force, largest_overlap, couple); }
};

/// Where the work of the last accepted step went [J]; an identity of the step's equations, to rounding, in which each
/// term has a formula of its own:
///
///   boundary = change of Energies::total() + friction + drag + plastic + numerical + reweighting + residual
///
/// with dx = x - x_n the increment, E the elastic energies, F the forces of held nodes and rollers on the rod, and for
/// every contact its weight w, pressure p, slip s in the step, overlap D and energy e(D) per length:
///
///   boundary     sum 1/2 (F_n + F) . dx, and what slipping grips, forces and gravity do at the end of the step
///   friction     sum w mu p z . s, all that is done against friction: what the presliding spring of a contact at rest
///                could give back, less than mu p w xi_s/2 each, counts as lost until it does
///   drag         sum c lbar |dx|^2/dt
///   plastic      what bending dissipates by its law (bending_law.hpp)
///   numerical    that of the implicit Euler step, which takes all forces at its end:
///                  sum 1/2 m |v - v_n|^2 + E_n - E + dE/dx . dx + sum w [e(D_n) - e(D) - p n . s]
///                less 1/2 (F - F_n) . dx, by which it takes the work of the boundary for too much
///   reweighting  contact energy at the last step's end less sum w e(D_n): weights follow the shape between two steps,
///                feet come and go, and what is stored in them changes without a force; negative where it grows
///   residual     what Newton's method left unbalanced on free nodes, times their increments
///
/// A roller that is turned is part of the boundary, by its moment; one that is free has inertia as nodes have.
/// An edge's spin counts as the nodes' motion does, with its own inertia, drag, torques and the regularisation r_j
/// (frame_terms.hpp), whose part is numerical.
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

/// Sum of all that acted on the rod in the last accepted step: holders, grips, springs, rollers, forces and weight,
/// and, with the opposite sign, what its inertia and its drag take, those of spin among them. The force is what
/// Newton's method left unbalanced, and so is the moment, but for the couple of friction that sections do not take
/// (ContactReading::couple), which then is what is missing.
struct LoadSum {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 moment = Vec3::Zero();  ///< about the origin [N m]

  void add(const Vec3& place, const Vec3& f) {
    force += f;
    moment += place.cross(f);
  }
  void state(Archive& archive) { archive(force, moment); }
};

/// What the terms of a step enter their parts of an accepted step into.
struct StepAccount {
  Energies energies;
  Energies before;  ///< those of the step before
  ContactReading contact;
  StepWork work;
  LoadSum loads;
};

}  // namespace knot_utm
