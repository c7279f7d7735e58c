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
  // A contact that is new and deep: half the tolerance is a better guess than a wall.
  const double tangent_at =
      contact.estimate > 0.0 ? normal.overlap_at(contact.estimate) : std::min(contact.overlap, 0.5 * normal.tolerance);
  model.slope = normal.slope(tangent_at);
  model.pressure = normal.pressure(tangent_at) + model.slope * (contact.overlap - tangent_at);
  const Vec3& n = contact.n;
  const Mat3 normal_plane = Mat3::Identity() - n * n.transpose();
  const Vec3 du_s = contact.inverse_g * contact.db;  // du = du_s.S + du_r.R
  const Vec3 du_r = contact.inverse_g * contact.x;

  // dn = n_s S + n_r R; a roller's gap has no part along its axis.
  const Mat3 n_s = (normal_plane - contact.axis * contact.axis.transpose() - contact.db * du_s.transpose()) / contact.d;
  const Mat3 n_r = -contact.db * du_r.transpose() / contact.d;

  // dg = g_s S + g_r R, per weight.
  Mat3 g_s = model.pressure * n_s - model.slope * n * n.transpose();
  Mat3 g_r = model.pressure * n_r;
  model.force = n;
  if (friction.on()) {
    model.force -= friction.coefficient * contact.z;
    const Vec3& r = contact.slip;
    const double along = n.dot(r);
    const Vec3 tangential = r - along * n;
    const FrictionDirection direction = friction_direction_and_slope(friction.law, tangential / friction_scale);
    const Mat3 scaled = (friction.coefficient * model.pressure / friction_scale) * direction.slope;
    const Vec3 turned = contact.turn - n * n.dot(contact.turn);
    // d(P r) = -(n.r) dn - n (r.dn) + P (S - V du)
    Mat3 y_s = normal_plane - turned * du_s.transpose() - along * n_s;
    y_s.noalias() -= n * (r.transpose() * n_s);
    Mat3 y_r = -turned * du_r.transpose() - along * n_r;
    y_r.noalias() -= n * (r.transpose() * n_r);
    g_s.noalias() -= scaled * y_s;
    g_r.noalias() -= scaled * y_r;
    // dp = -p' n.S
    g_s.noalias() += (friction.coefficient * model.slope) * direction.z * n.transpose();
  }
  model.force *= contact.weight * model.pressure;
  g_s *= contact.weight;
  g_r *= contact.weight;

  // df_k = c_k dg - beta_k g du
  model.cc.topRows<3>() = -g_s;
  model.cb.topRows<3>() = -g_r;
  model.bc.topRows<3>() = model.force * du_s.transpose();
  model.bb.topRows<3>() = model.force * du_r.transpose();
  model.cc.row(3).setZero();
  model.cb.row(3).setZero();
  model.bc.row(3).setZero();
  model.bb.row(3).setZero();
}

}  // namespace knot_utm
