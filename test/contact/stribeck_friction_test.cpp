#include "knot_utm/contact/stribeck_friction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "knot_utm/contact/friction.hpp"

namespace knot_utm {
namespace {

constexpr double kMu = 0.5, kPresliding = 1e-6, kKinetic = 0.6, kLength = 1e-3, kPressure = 100.0;

/// A contact that is dragged along y, increment by increment.
class Dragged {
 public:
  explicit Dragged(const StribeckFriction& law) : law_(law) {}

  /// The traction behind the increment [N/m].
  double by(double way) {
    const FrictionInput<Vec3> in{
        kPressure, memory_.slip + way * Vec3::UnitY(), memory_.slip, Vec3::UnitX(), memory_.own, 0.1};
    const FrictionTraction<Vec3> t = law_.traction(in);
    memory_ = law_.remember(in, t.z);
    return kPressure * t.coefficient * t.z.y();
  }
  double slid() const { return memory_.own; }

 private:
  StribeckFriction law_;
  FrictionMemory memory_;
};

TEST(StribeckFriction, FallsFromStaticToKineticWithinItsSlipLength) {
  const StribeckFriction law{kMu, kPresliding, kKinetic, kLength};
  Dragged contact(law);
  constexpr double kStep = 1e-5;
  double largest = 0.0;
  for (int i = 1; i <= 800; ++i) {
    const double found = contact.by(kStep), way = i * kStep;
    // The spring has taken up to xi_s of the way; the cone is that of the slip at the increment's end, but for what the
    // cone lost within it.
    const double expected = kMu * kPressure * (kKinetic + (1.0 - kKinetic) * std::exp(-way / kLength));
    EXPECT_NEAR(found, expected, kMu * kPressure * 2.0 * kPresliding / kLength) << way;
    largest = std::max(largest, found);
  }
  EXPECT_GT(largest, 0.99 * kMu * kPressure);
  EXPECT_NEAR(contact.by(kStep), kKinetic * kMu * kPressure, 1e-3 * kMu * kPressure);
}

TEST(StribeckFriction, AContactThatSticksAgainIsBoundAnew) {
  Dragged contact({kMu, kPresliding, kKinetic, kLength});
  for (int i = 0; i < 100; ++i) contact.by(1e-4);
  EXPECT_NEAR(contact.slid(), 1e-2, 1e-5);
  contact.by(-0.3 * kPresliding);
  EXPECT_EQ(contact.slid(), 0.0);
  EXPECT_GT(contact.by(0.8 * kPresliding), 0.99 * kMu * kPressure);
}

TEST(StribeckFriction, WhoseKineticShareIsOneIsMemory) {
  const StribeckFriction law{kMu, kPresliding, 1.0, kLength};
  const MemoryFriction memory{kMu, kPresliding};
  for (const double size : {0.1, 0.99, 1.01, 20.0}) {
    const FrictionInput<Vec3> in{kPressure, size * kPresliding * Vec3(0.8, 0.6, 0.0), Vec3::Zero(), Vec3::UnitX(), 0.0,
                                 0.1};
    EXPECT_LT((law.traction(in).z - memory.traction(in).z).norm(), 1e-15);
    EXPECT_NEAR(law.traction(in).coefficient, kMu, 1e-15);
    EXPECT_LT((law.remember(in, law.traction(in).z).slip - memory.remember(in, memory.traction(in).z).slip).norm(),
              1e-15 * kPresliding);
  }
}

}  // namespace
}  // namespace knot_utm
