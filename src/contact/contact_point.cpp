#include "knot_utm/contact/contact_point.hpp"

namespace knot_utm {

void evaluate_force(const NormalLaw& normal, const Friction& friction, double friction_scale, ContactPoint& contact) {
  contact.pressure = normal.pressure(contact.overlap);
  contact.slope = normal.slope(contact.overlap);
  contact.force = contact.n;
  if (friction.on()) {
    const Vec3 tangential = contact.slip - contact.n * contact.n.dot(contact.slip);
    contact.z = friction_direction(friction.law, tangential / friction_scale);
    contact.force -= friction.coefficient * contact.z;
  }
  contact.force *= contact.weight * contact.pressure;
}

void linearise(const Friction& friction, double friction_scale, const ContactPoint& contact,
               ContactStiffness& stiffness) {
  const Vec3& n = contact.n;
  const Mat3 normal_plane = Mat3::Identity() - n * n.transpose();
  const Vec3 du_s = contact.inverse_g * contact.db;  // du = du_s.S + du_r.R
  const Vec3 du_r = contact.inverse_g * contact.x;

  // dn = n_s S + n_r R; a roller's gap has no part along its axis.
  const Mat3 n_s =
      (normal_plane - contact.axis * contact.axis.transpose() - contact.db * du_s.transpose()) / contact.d;
  const Mat3 n_r = -contact.db * du_r.transpose() / contact.d;

  // dg = g_s S + g_r R, per weight.
  Mat3 g_s = contact.pressure * n_s - contact.slope * n * n.transpose();
  Mat3 g_r = contact.pressure * n_r;
  if (friction.on()) {
    const Vec3& r = contact.slip;
    const double along = n.dot(r);
    const Vec3 tangential = r - along * n;
    const FrictionDirection direction =
        friction_direction_and_slope(friction.law, tangential / friction_scale);
    const Mat3 scaled = (friction.coefficient * contact.pressure / friction_scale) * direction.slope;
    const Vec3 turned = contact.turn - n * n.dot(contact.turn);
    // d(P r) = -(n.r) dn - n (r.dn) + P (S - V du)
    Mat3 y_s = normal_plane - turned * du_s.transpose() - along * n_s;
    y_s.noalias() -= n * (r.transpose() * n_s);
    Mat3 y_r = -turned * du_r.transpose() - along * n_r;
    y_r.noalias() -= n * (r.transpose() * n_r);
    g_s.noalias() -= scaled * y_s;
    g_r.noalias() -= scaled * y_r;
    // dp = -p' n.S
    g_s.noalias() += (friction.coefficient * contact.slope) * direction.z * n.transpose();
  }
  g_s *= contact.weight;
  g_r *= contact.weight;

  // df_k = c_k dg - beta_k g du
  stiffness.cc.topRows<3>() = -g_s;
  stiffness.cb.topRows<3>() = -g_r;
  stiffness.bc.topRows<3>() = contact.force * du_s.transpose();
  stiffness.bb.topRows<3>() = contact.force * du_r.transpose();
  stiffness.cc.row(3).setZero();
  stiffness.cb.row(3).setZero();
  stiffness.bc.row(3).setZero();
  stiffness.bb.row(3).setZero();
}

}  // namespace knot_utm
