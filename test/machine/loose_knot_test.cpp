// A knot so loose that its force is far below the k_b/h^2 in which the residual is told.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "knot_utm/machine/testing_machine.hpp"
#include "machine/overhand_specimen.hpp"

namespace knot_utm {
namespace {

/// A stiff thin rod; k_b/h^2 is 96 N.
Material wire() {
  Material out;
  out.name = "wire";
  out.radius = 8.7e-4;
  out.density = 1300.0;
  out.stretching_stiffness = 2.6e6;
  out.bending_stiffness = 7.2e-5;
  out.twisting_stiffness = 4.8e-5;
  out.friction_coefficient = 0.55;
  return out;
}

/// [N], pulled at two nodes for six seconds, after two of rest.
double force_of_overhand(const PhysicsOptions& physics) {
  MachineOptions machine;
  machine.grips = GripKind::kNodes;
  TestingMachine bench(overhand_specimen(0.25, 0.065, 1.44e-3), wire(), machine, physics);
  constexpr double kRest = 2.0, kPull = 6.0, kSpeed = 2e-3, kInterval = 0.5;
  Command command;
  double force = 0.0;
  for (int k = 0; k * kInterval <= kRest + kPull; ++k) {
    command.sequence = static_cast<std::uint64_t>(k);
    command.time = kInterval * k;
    command.phase = command.time > kRest ? Phase::kPull : Phase::kHold;
    command.displacement = std::max(0.0, kSpeed * (command.time - kRest));
    const Sample sample = bench.respond(command);
    EXPECT_NE(sample.status, BenchStatus::kFailed);
    force = sample.force_upper;
  }
  return force;
}

/// At a thousandth of the load for each node, some in one direction and some in the other, about sqrt(176) of them add
/// up.
TEST(LooseKnot, ForceIsNotLostInTheResidual) {
  PhysicsOptions usual, exact;
  usual.accuracy = exact.accuracy = Accuracy::kDraft;
  usual.contact_scheme = exact.contact_scheme = ContactScheme::kEdge;
  exact.residual = 1e-7;
  const double force = force_of_overhand(exact);
  EXPECT_GT(force, 0.1);
  EXPECT_NEAR(force_of_overhand(usual), force, std::sqrt(176.0) * 1e-3 * force);
}

}  // namespace
}  // namespace knot_utm
