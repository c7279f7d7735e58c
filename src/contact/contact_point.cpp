#include "knot_utm/contact/contact_point.hpp"

#include <algorithm>

#include "knot_utm/solver/block.hpp"

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

void linearise(const NormalLaw& normal, const Friction& friction, double friction_scale, bool expects,
               const ContactPoint& contact, ContactModel& model) {
  // A contact that is new and deep: the depth where the rod stiffens is a better guess than a wall.
  const double tangent_at =
      contact.estimate > 0.0 ? normal.overlap_at(contact.estimate) : std::min(contact.overlap, normal.stiffening);
  model.slope = normal.slope(tangent_at);
  model.pressure = normal.pressure(tangent_at) + model.slope * (contact.overlap - tangent_at);
  model.du_s = contact.inverse_g * contact.db;
  model.du_r = contact.inverse_g * contact.x;

  const Lanes n = to_lanes(contact.n), db = to_lanes(contact.db), axis = to_lanes(contact.axis);
  const double over_d = 1.0 / contact.d;
  const double p = contact.weight * (expects ? contact.expected(model.pressure) : model.pressure);
  const double slope = contact.weight * model.slope;
  const Lanes n_u = -over_d * db;  // dn/du
  // With N = dn/dS = (P - axis axis^T)/d, P = 1 - n n^T (a roller's gap has no part along its axis), and dp/dS = -p' n,
  //   dg/dS = p N - p' (n - mu z) n^T - s C Y,   s = mu p/scale,   p that turns,
  //   Y = d(P r)/dS = P - (n.r) N - n (N r)^T.
  // z and u being tangential, C P = across P + along u u^T and C n = across n: all of it is multiples of the identity,
  // u u^T and columns times n^T, axis^T and (N r)^T.
  double on_identity = p * over_d, on_u = 0.0, on_pulled = 0.0;
  Lanes axis_column = -on_identity * axis;
  Lanes pressing = slope * n;  // p' (n - mu z)
  Lanes u = {}, pulled = {}, force = n, slide = p * n_u;
  if (friction.on()) {
    const Lanes r = to_lanes(contact.slip), turn = to_lanes(contact.turn);
    const double away = dot(n, r), left = 1.0 - away * over_d, over_scale = 1.0 / friction_scale;
    const Lanes tangential = r - away * n;
    const FrictionDirection direction =
        linearised_direction(friction.law, friction.secant, to_vec3(over_scale * tangential));
    const Lanes z = to_lanes(direction.z);
    u = to_lanes(direction.u);
    const double s = friction.coefficient * p * over_scale;
    const double across = s * direction.across, along = s * direction.along;
    const auto slope_times = [&](const Lanes& v) { return across * v + (along * dot(u, v)) * u; };  // s C v
    force -= friction.coefficient * z;
    pressing -= (friction.coefficient * slope) * z;
    on_identity -= across * left;
    on_u = -along * left;
    on_pulled = across * over_d;
    pulled = tangential;
    if (contact.on_roller()) {
      axis_column -= (away * over_d) * slope_times(axis);
      pulled -= dot(axis, r) * axis;
    }
    slide += slope_times(turn - dot(n, turn) * n + away * n_u + dot(r, n_u) * n);
  }
  model.force = contact.weight * model.pressure * to_vec3(force);
  model.slide = to_vec3(slide);
  constexpr Lanes kAxis[3] = {{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}};
  for (int j = 0; j < 3; ++j) {
    Lanes column = n[j] * pressing - (on_pulled * pulled[j] - on_identity * n[j]) * n - (on_u * u[j]) * u;
    column -= axis[j] * axis_column + on_identity * kAxis[j];
    std::copy_n(reinterpret_cast<const double*>(&column), 4, model.still.data() + 4 * j);
  }
}

}  // namespace knot_utm
