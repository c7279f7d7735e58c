// Stretching laws in a rod: a bar that is pulled far bears what its law says, and the balance of energy closes.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "knot_utm/sim/saved_step.hpp"
#include "rod/own_laws.hpp"
#include "sim/balance.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr int kEdges = 12;

/// A straight bar of rubber, both of whose ends are held.
struct Bar {
  Material material = braided_rope();
  RodProperties rod;
  StepSettings settings;
  RodState state;
  Boundary held;

  explicit Bar(const StretchingLaws& law) {
    rod = make_rod(material, Eigen::VectorXd::Constant(kEdges, material.radius));
    set_law(rod, law);
    settings = closed_form_settings(material);
    settings.drag = 50.0;
    state = straight_state(rod);
    held.fixed_nodes = {{0, state.position.col(0)}, {kEdges, state.position.col(kEdges)}};
  }

  const Boundary& at_strain(double strain) {
    held.fixed_nodes[1].position = state.position.col(0) + (1.0 + strain) * rod.length() * Vec3::UnitX();
    return held;
  }
};

/// Pulled by 30 % in a second, and held until all of it is at rest.
struct Pulled {
  static constexpr double kStrain = 0.3;
  Bar bar;
  Balance balance;

  explicit Pulled(const StretchingLaws& law)
      : bar(law), balance(TimeStep::make(bar.rod, bar.state, bar.settings), bar.settings, 0.02) {
    balance.run(1.0, [&](double to) -> const Boundary& { return bar.at_strain(kStrain * std::min(to, 1.0)); });
    balance.run(3.0, [&](double) -> const Boundary& { return bar.at_strain(kStrain); });
  }
  double k_s() const { return bar.material.stretching_stiffness; }
};

TEST(StretchingLaw, ABarPulledByAThirdBearsWhatItsLawSays) {
  for (const StretchingLaws& law : {StretchingLaws(LinearStretching()), StretchingLaws(NeoHookeanStretching())}) {
    const Pulled pulled(law);
    const double lambda = 1.0 + Pulled::kStrain, k_s = pulled.k_s(), length = pulled.bar.rod.length();
    const bool linear = std::holds_alternative<LinearStretching>(law);
    const double tension = linear ? k_s * Pulled::kStrain : k_s / 3.0 * (lambda - 1.0 / (lambda * lambda));
    const double energy = linear ? 0.5 * k_s * Pulled::kStrain * Pulled::kStrain * length
                                 : k_s / 6.0 * (lambda * lambda + 2.0 / lambda - 3.0) * length;
    const TimeStep& stepper = pulled.balance.stepper();
    EXPECT_NEAR(stepper.readings().reaction(kEdges).x(), tension, 1e-6 * tension);
    EXPECT_LT((stepper.tension().array() - tension).abs().maxCoeff(), 1e-6 * tension);
    EXPECT_NEAR(stepper.readings().energies().stretching, energy, 1e-6 * energy);
    EXPECT_LT(std::abs(pulled.balance.gap()), pulled.balance.rounding());
  }
}

TEST(StretchingLaw, IsSavedWithItsRod) {
  Bar bar((NeoHookeanStretching()));
  const std::unique_ptr<TimeStep> stepper = TimeStep::make(bar.rod, bar.state, bar.settings);
  const Boundary& boundary = bar.at_strain(0.01);
  SavedStep loaded = load_step(save_step(*stepper, boundary, 0.0, 0.01), "bar");
  EXPECT_TRUE(std::holds_alternative<NeoHookeanStretching>(loaded.stepper->rod().laws->stretching));
  ASSERT_TRUE(loaded.try_again().accepted());
  ASSERT_TRUE(stepper->step(boundary, 0.01).accepted());
  EXPECT_EQ(loaded.stepper->readings().reaction(kEdges), stepper->readings().reaction(kEdges));
}

TEST(StretchingLaw, AMaterialGivesItToItsRod) {
  Material material = braided_rope();
  material.stretching.law = static_cast<knot_utm::StretchingLaw>(1);
  EXPECT_TRUE(
      std::holds_alternative<NeoHookeanStretching>(make_rod(material, Eigen::Vector3d::Ones()).laws->stretching));
}

}  // namespace
}  // namespace knot_utm
