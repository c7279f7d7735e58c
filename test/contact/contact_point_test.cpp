#include "knot_utm/contact/contact_point.hpp"

#include <gtest/gtest.h>

#include "contact/nodal_forces.hpp"

namespace knot_utm {
namespace {

constexpr double kRadius = 3e-3;
constexpr double kStep = 0.01;
constexpr ContactLinearisation expecting{Linearisation::kTangent, true};

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
  const MemoryFriction friction{0.5, 1e-5};
  const ContactLaws laws(normal, friction);
  std::vector<ContactPoint> contacts = {drawn_apart()};
  ContactPoint& contact = contacts[0];
  contact.prediction = 100.0;
  evaluate_forces(laws, kStep, contacts);
  EXPECT_EQ(contact.pressure, 0.0);
  std::vector<ContactModel> models;
  linearise(laws, kStep, expecting, contacts, models);
  EXPECT_LT(models[0].pressure, 0.0) << "the tangent at the prediction, so far out";
  // Across both strands: what holds is mu w p/xi_s, what turns with n is w p/d.
  const Vec3 across = to_vec3(models[0].still[1]);
  const double hold = friction.coefficient * contact.weight * contact.prediction / friction.presliding;
  EXPECT_NEAR(across.y(), hold, 0.02 * hold);
  linearise(laws, kStep, {}, contacts, models);
  EXPECT_LT(models[0].still[1][1], 0.0) << "the tangent's pressure drives it on";
}

TEST(ContactModel, EachContactHasItsOwnHoweverManyThereAre) {
  const NormalLaw normal{1e6, 0.02 * kRadius, 0.05 * kRadius};
  ContactLaws laws(normal, MemoryFriction{0.5, 1e-5});
  laws.of[1] = {NormalLaw{2e6, 0.02 * kRadius, 0.05 * kRadius}, MemoryFriction{0.3, 1e-5}};
  laws.of[2] = {NormalLaw{4e6, 0.02 * kRadius, 0.05 * kRadius}, MemoryFriction{0.1, 2e-5}};
  std::vector<ContactPoint> many;
  for (int i = 0; i < 11; ++i) {
    ContactPoint& contact = many.emplace_back(drawn_apart());
    contact.d -= 1e-3 * kRadius * (4 * i - 5);  // some are apart and take no part
    contact.x = contact.d * contact.n;
    contact.overlap = 2.0 * kRadius - contact.d;
    contact.begins = normal.begin();
    contact.pair = i / 2 % 3;
    contact.slip *= i;  // some stick, some slip
    contact.turn = 1e-7 * i * Vec3::UnitX();
    if (i % 3 == 0) contact.prediction = 10.0 * (i - 1);
  }
  std::vector<ContactModel> models;
  evaluate_forces(laws, kStep, many);
  linearise(laws, kStep, expecting, many, models);
  std::size_t n = 0;
  for (const ContactPoint& contact : many) {
    if (!contact.active()) continue;
    std::vector<ContactPoint> alone = {contact};
    std::vector<ContactModel> own;
    evaluate_forces(laws, kStep, alone);
    linearise(laws, kStep, expecting, alone, own);
    EXPECT_EQ(alone[0].force, contact.force);
    const PairLaws& pair = laws[contact.pair];
    EXPECT_EQ(contact.pressure, pair.normal.pressure(contact.overlap));
    EXPECT_LE(contact.mu, pair.friction.coefficient());
    // The overlap of an prediction is found to 1e-9 of the pressure, or better beside one that takes longer.
    const double rounding = 1e-8 * (own[0].slope * kRadius + std::abs(own[0].pressure));
    EXPECT_NEAR(own[0].pressure, models[n].pressure, rounding);
    EXPECT_NEAR(own[0].slope, models[n].slope, rounding / kRadius);
    EXPECT_NEAR((to_vec3(own[0].force) - to_vec3(models[n].force)).norm(), 0.0, contact.weight * rounding);
    EXPECT_NEAR((to_vec3(own[0].slide) - to_vec3(models[n].slide)).norm(), 0.0, 1e-8 * to_vec3(own[0].slide).norm());
    const Mat3 still = still_of(own[0]);
    EXPECT_NEAR((still - still_of(models[n])).norm(), 0.0, 1e-8 * still.norm());
    ++n;
  }
  EXPECT_GT(n, 4u);
  EXPECT_LT(n, many.size());
}

}  // namespace
}  // namespace knot_utm
