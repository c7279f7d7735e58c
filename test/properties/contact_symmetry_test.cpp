// Contact laws, and what strands that touch exert on one another.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "contact/nodal_forces.hpp"
#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/rod/rod.hpp"
#include "properties/random.hpp"

namespace knot_utm::properties {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

NormalLaw law_of(const Units& units) { return {1e7 * units.stress(), 5e-5 * units.length, 4e-5 * units.length}; }

TEST(ContactLawSymmetry, HasNoUnitOfItsOwn) {
  rc::detail::checkGTest([] {
    const Units units = random_powers_of_two();
    const NormalLaw law = law_of({1, 1, 1}), other = law_of(units);
    const double overlap = random_between(-1e-4, 3e-4);
    RC_ASSERT(other.pressure(units.length * overlap) == units.force / units.length * law.pressure(overlap));
    RC_ASSERT(other.slope(units.length * overlap) == units.stress() * law.slope(overlap));
    RC_ASSERT(other.energy(units.length * overlap) == units.force * law.energy(overlap));
  });
}

TEST(ContactLawSymmetry, PressureRisesAndCanBeTurnedRound) {
  rc::detail::checkGTest([] {
    const NormalLaw law = law_of({1, 1, 1});
    const double high = random_between(1e-5, 3e-4), low = high - random_between(1e-6, 3e-4);
    RC_ASSERT(law.pressure(low) >= 0.0 && law.pressure(high) > law.pressure(low));
    RC_ASSERT(law.energy(low) >= 0.0 && law.energy(high) > law.energy(low));
    const double pressure = law.pressure(high);
    // The root is found to 1e-9 of the pressure.
    near(std::abs(law.pressure(law.overlap_at(pressure)) - pressure), 2e-9 * pressure, "pressure at its overlap");
  });
}

/// Contacts of a random scene after it has moved by a little, from rest or with friction.
struct Touching {
  Scene scene;
  Points position;
  std::vector<ContactPoint> contacts;

  double presliding = 0.0;

  explicit Touching(double friction) {
    const std::vector<int> numbers = random_numbers(RandomScene::kNumbers);
    scene = RandomScene(numbers, false).scene();
    presliding = 0.02 * scene.rod.material.radius;
    scene.settings.friction = MemoryFriction{friction, presliding};
    position = scene.state.position + scene.dt * scene.state.velocity;
    const StepSettings& s = scene.settings;
    SmoothContact contact(scene.rod, s.pressure_law, s.friction, s.candidate_margin);
    contact.begin(position);
    contact.evaluate(position, scene.state.position, scene.dt);
    contacts = contact.contacts();
  }
  Points forces() const { return unflat(nodal_forces(contacts, scene.rod.nodes())); }
  /// The sum of all that rounding takes off the forces' shares of the nodes.
  double force_error() const {
    double sum = 0.0;
    for (const ContactPoint& contact : contacts) sum += contact.force.norm();
    return 16.0 * kEpsilon * sum;
  }
  Vec3 moment() const {
    const Points force = forces();
    Vec3 sum = Vec3::Zero();
    for (Eigen::Index i = 0; i < force.cols(); ++i) sum += Vec3(position.col(i)).cross(Vec3(force.col(i)));
    return sum;
  }
};

TEST(ContactSymmetry, ForcesAddUpToNothing) {
  rc::detail::checkGTest([] {
    const Touching touching(random_between(0.0, 0.6));
    near(touching.forces().rowwise().sum().norm(), touching.force_error(), "force");
  });
}

/// Normal forces act along the line between their two points.
TEST(ContactSymmetry, MomentsAddUpToNothingWithoutFriction) {
  rc::detail::checkGTest([] {
    const Touching touching(0.0);
    const double far = touching.position.colwise().norm().maxCoeff();
    near(touching.moment().norm(), 4.0 * touching.force_error() * far, "moment");
  });
}

/// Friction acts on the centrelines too, a diameter apart, and no moment about the strands makes up for that.
TEST(ContactSymmetry, FrictionLeavesTheMomentOfItsArms) {
  rc::detail::checkGTest([] {
    const Touching touching(0.5);
    Vec3 arms = Vec3::Zero();
    for (const ContactPoint& contact : touching.contacts) arms += contact.x.cross(contact.force);
    const double far = touching.position.colwise().norm().maxCoeff();
    near((touching.moment() - arms).norm(), 4.0 * touching.force_error() * far, "moment");
  });
}

TEST(ContactSymmetry, FrictionIsTangentialAndAtMostMuTimesThePressure) {
  rc::detail::checkGTest([] {
    const double mu = random_between(0.1, 0.6);
    const Touching touching(mu);
    for (const ContactPoint& contact : touching.contacts) {
      const double normal = contact.weight * contact.pressure;
      const Vec3 tangential = contact.force - normal * contact.n;
      near(tangential.norm(), mu * normal * (1.0 + 8.0 * kEpsilon), "friction");
      near(std::abs(tangential.dot(contact.n)),
           16.0 * kEpsilon * normal * (1.0 + contact.slip.norm() / touching.presliding), "along the normal");
    }
  });
}

}  // namespace
}  // namespace knot_utm::properties
