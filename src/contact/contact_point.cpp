#include "knot_utm/contact/contact_point.hpp"

#include <algorithm>

namespace knot_utm {

void evaluate_force(const Friction& friction, double friction_scale, ContactPoint& contact) {
  contact.force = contact.n;
  if (friction.on()) {
    const Vec3 tangential = contact.slip - contact.n * contact.n.dot(contact.slip);
    contact.z = friction_direction(friction.law, tangential / friction_scale);
    contact.force -= friction.coefficient * contact.z;
  }
  contact.force *= contact.weight * contact.pressure;
}

void evaluate_force(const NormalLaw& normal, const Friction& friction, double friction_scale, ContactPoint& contact) {
  contact.pressure = normal.pressure(contact.overlap);
  evaluate_force(friction, friction_scale, contact);
}

void linearise(const NormalLaw& normal, const Friction& friction, double friction_scale, const ContactPoint& contact,
               ContactModel& model) {
  // A contact that is new and deep: the depth where the rod stiffens is a better guess than a wall.
  const double tangent_at =
      contact.estimate > 0.0 ? normal.overlap_at(contact.estimate) : std::min(contact.overlap, normal.stiffening);
  model.slope = normal.slope(tangent_at);
  model.pressure = normal.pressure(tangent_at) + model.slope * (contact.overlap - tangent_at);
  model.du_s = contact.inverse_g * contact.db;
  model.du_r = contact.inverse_g * contact.x;

  const Vec3& n = contact.n;
  const Vec3& axis = contact.axis;
  const double p = contact.weight * model.pressure, slope = contact.weight * model.slope;
  const Vec3 n_u = contact.db / -contact.d;  // dn/du
  // With N = dn/dS = (P - axis axis^T)/d, P = 1 - n n^T (a roller's gap has no part along its axis), and dp/dS = -p' n,
  //   dg/dS = p N - p' (n - mu z) n^T - s C Y,   s = mu p/scale,
  //   Y = d(P r)/dS = P - (n.r) N - n (N r)^T.
  // z and u being tangential, C P = across P + along u u^T and C n = across n: all of it is multiples of the identity,
  // u u^T and columns times n^T, axis^T and (N r)^T.
  double on_identity = p / contact.d, on_u = 0.0, on_pulled = 0.0;
  Vec3 axis_column = -on_identity * axis;
  Vec3 pressing = slope * n;  // p' (n - mu z)
  Vec3 u = Vec3::Zero(), pulled = Vec3::Zero();
  model.force = n;
  model.slide = p * n_u;
  if (friction.on()) {
    model.force -= friction.coefficient * contact.z;
    const Vec3& r = contact.slip;
    const double away = n.dot(r), left = 1.0 - away / contact.d;
    const Vec3 tangential = r - away * n;
    const FrictionDirection direction =
        linearised_direction(friction.law, friction.secant, tangential / friction_scale);
    const double s = friction.coefficient * p / friction_scale;
    pressing -= (friction.coefficient * slope) * direction.z;
    on_identity -= s * direction.across * left;
    on_u = -s * direction.along * left;
    on_pulled = s * direction.across / contact.d;
    axis_column -= (s * away / contact.d) * direction.slope_times(axis);
    u = direction.u;
    pulled = tangential - axis * axis.dot(r);
    const Vec3 turned = contact.turn - n * n.dot(contact.turn);
    model.slide += s * direction.slope_times(turned + away * n_u + n * r.dot(n_u));
  }
  model.force *= p;
  for (int j = 0; j < 3; ++j) {
    Vec3 column =
        (on_pulled * pulled[j] - on_identity * n[j]) * n + (on_u * u[j]) * u + axis[j] * axis_column - n[j] * pressing;
    column[j] += on_identity;
    model.still.col(j).head<3>() = -column;
  }
  model.still.row(3).setZero();
}

}  // namespace knot_utm
