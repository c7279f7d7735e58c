#include "knot_utm/contact/contact_point.hpp"

#include <gtest/gtest.h>

namespace knot_utm {
namespace {

constexpr double kRadius = 3e-3;

/// Two crossed strands that a prediction has drawn apart, where the last step had them pressed together.
ContactPoint drawn_apart() {
  ContactPoint out;
  out.c[1] = 1.0;
  out.c[4] = -1.0;
  out.n = Vec3::UnitZ();
  out.d = 2.011 * kRadius;
  out.x = out.d * out.n;
  out.overlap = 2.0 * kRadius - out.d;
  out.weight = kRadius;
  out.db = kRadius * Vec3::UnitX();
  out.inverse_g = 1.0 / out.db.squaredNorm();
  out.slip = 1e-6 * Vec3::UnitY();
  return out;
}

TEST(ContactModel, FrictionOfADrawnApartContactThatIsExpectedToPressHoldsIt) {
  const NormalLaw normal{1e6, 0.02 * kRadius};
  Friction friction;
  friction.coefficient = 0.5;
  friction.presliding = 1e-5;
  ContactPoint contact = drawn_apart();
  contact.estimate = 100.0;
  evaluate_force(normal, friction, friction.presliding, contact);
  EXPECT_EQ(contact.pressure, 0.0);
  ContactModel model;
  linearise(normal, friction, friction.presliding, true, contact, model);
  EXPECT_LT(model.pressure, 0.0) << "the tangent at the estimate, so far out";
  // Across both strands: what holds is mu w p/xi_s, what turns with n is w p/d.
  const Vec3 across = model.still.topRows<3>() * Vec3::UnitY();
  const double hold = friction.coefficient * contact.weight * contact.estimate / friction.presliding;
  EXPECT_NEAR(across.y(), hold, 0.02 * hold);
  linearise(normal, friction, friction.presliding, false, contact, model);
  EXPECT_LT(model.still(1, 1), 0.0) << "the tangent's pressure drives it on";
}

TEST(ContactModel, WithoutAnEstimateThePressureThatTurnsIsThatOfTheTangent) {
  ContactPoint contact = drawn_apart();
  EXPECT_EQ(contact.expected(7.0), 7.0);
  contact.estimate = 100.0;
  EXPECT_EQ(contact.expected(7.0), 100.0);
}

}  // namespace
}  // namespace knot_utm
