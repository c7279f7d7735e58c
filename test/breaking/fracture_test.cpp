#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/breaking/break_watch.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "machine/overhand_specimen.hpp"
#include "program/programs.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

using programs::pull;

constexpr double kLength = 0.25;  // [m]

struct Pulled {
  TestingMachine bench;
  ProgramRunner program;
  std::vector<Sample> samples;
};

Pulled run(const SpecimenOptions& specimen, const Material& material, const PhysicsOptions& physics,
           const Program& steps) {
  MachineOptions machine;
  machine.grips = GripKind::kClamps;
  TestingMachine bench(specimen, material, machine, physics);
  const double period = bench.longest_step();
  Pulled out{std::move(bench), ProgramRunner(steps, machine.load_cell.sampling_rate, period, {}), {}};
  run_test(out.bench, out.program, [&](const Command&, const Sample&) {
    out.samples.insert(out.samples.end(), out.bench.substeps().begin(), out.bench.substeps().end());
  });
  return out;
}

Pulled straight_run(Accuracy accuracy, double breaking_force) {
  SpecimenOptions specimen;
  specimen.knot = knot_named("straight");
  specimen.length = kLength;
  specimen.edge_length = 0.005;
  Material material = nylon();
  material.breaking_force = breaking_force;
  PhysicsOptions physics;
  physics.accuracy = accuracy;
  physics.inertia = 1.0;
  return run(specimen, material, physics, {pull(0.02)});
}

const Sample& at_break(const Pulled& run) {
  for (const Sample& sample : run.samples)
    if (sample.status == BenchStatus::kBroken) return sample;
  return run.samples.back();
}

/// Of a brittle rod the tension rises in the first steps from nothing to a multiple of what it bears.
TEST(Fracture, AStraightRodPartsAtItsBreakingForceWhateverTheStep) {
  const double stiffness = nylon().stretching_stiffness / kLength;
  for (const auto& [accuracy, breaking] : {std::pair{Accuracy::kDraft, 2000.0},
                                           {Accuracy::kFine, 2000.0},
                                           {Accuracy::kDraft, 5.0},
                                           {Accuracy::kDraft, 200.0}}) {
    const Pulled test = straight_run(accuracy, breaking);
    EXPECT_EQ(test.program.ended_by(), EndedBy::kBreak);
    EXPECT_THAT(test.program.reason(), testing::HasSubstr("the rod parted"));
    const Sample& parted = at_break(test);
    // The step that parts it may be as long as the shortest that is taken for it, a thousandth of the longest.
    const double overshoot = stiffness * 0.0033 * 1e-3 * test.bench.longest_step();
    const double other = (breaking < 1000.0 ? 1e-3 : 1e-5) * breaking;  // drag and inertia, as between the grips
    EXPECT_GE(parted.force_upper, breaking < 1000.0 ? breaking - other : breaking * (1.0 - 1e-9));
    EXPECT_LE(parted.force_upper, breaking + overshoot + other);
    EXPECT_GT(parted.extension, 0.0);
    if (breaking < 1000.0) continue;
    EXPECT_NEAR(parted.extension, breaking / stiffness, (overshoot + other) / stiffness);
    EXPECT_GT(parted.break_arclength, 0.0);
  }
}

TEST(Fracture, TheTestEndsWhereTheRodParts) {
  const Pulled test = straight_run(Accuracy::kNormal, 500.0);  // [N]
  EXPECT_EQ(&at_break(test), &test.samples.back());
  EXPECT_TRUE(test.bench.tension().array().isNaN().all());  // results.md says that none is known
  const Results results = analyse(test.samples, test.samples, test.program.ended_by(), false);
  EXPECT_LT(*results.energy_balance_error, 1e-9);  // an identity of the steps, that which parts included
  EXPECT_EQ(results.failure_mode, "fracture");
  EXPECT_EQ(results.break_place, BreakPlace::kGrip);  // where all edges bear the same, the first one does
  EXPECT_EQ(*results.break_arclength, at_break(test).break_arclength);
}

TEST(Fracture, OfAnOverhandEndsTheTestAndChangesNothingBefore) {
  PhysicsOptions physics;
  physics.accuracy = Accuracy::kDraft;
  physics.twist = TwistMode::kOn;
  HoldStep settle;
  settle.duration = 1.0;
  const SpecimenOptions specimen = overhand_specimen(0.4, 0.15, 0.006);
  const Program steps = {settle, pull(0.025)};
  const Pulled whole = run(specimen, pink_vps(), physics, steps);
  ASSERT_EQ(whole.program.ended_by(), EndedBy::kExtension) << whole.program.reason();
  double largest = 0.0;
  for (const Sample& sample : whole.samples) largest = std::max(largest, sample.force_upper);

  Material weak = pink_vps();
  weak.breaking_force = 0.8 * largest;
  const Pulled broken = run(specimen, weak, physics, steps);
  EXPECT_EQ(broken.program.ended_by(), EndedBy::kBreak) << broken.program.reason();
  EXPECT_LT(at_break(broken).extension, 0.025);
  EXPECT_TRUE(broken.bench.state().position.allFinite());
  const Results results = analyse(broken.samples, broken.samples, broken.program.ended_by(), false);
  EXPECT_LT(*results.energy_balance_error, 1e-3);  // as that of the whole overhand: the residual of loose knots
}

/// Parts at a strain of 0.2 where it is straight.
Material bent(double share) {
  Material out = nylon();
  out.breaking_force = 0.2 * out.stretching_stiffness;
  out.breaking.law = static_cast<BreakingLaw>(1);
  out.breaking.set("bending_share", share);
  return out;
}

/// A polygon that turns by phi at every node has the curvature of an arc of radius R whose length at phi is an edge's.
TEST(Fracture, StrainOfTheOutermostFibreIsThatOfTensionAndOfItsShareOfBending) {
  constexpr double kTurn = 0.1, kRadius = 0.05, kStretch = 1.02;
  const double edge = kRadius * kTurn;
  for (const double share : {0.0, 0.3, 1.0}) {
    const Material material = bent(share);
    const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(20, edge / kStretch));
    Points position = Points::Zero(3, 21);
    for (int i = 0; i < 20; ++i)
      position.col(i + 1) = position.col(i) + edge * Vec3(std::cos(kTurn * i), std::sin(kTurn * i), 0.0);
    // kappa is over the length at rest.
    const double strain = (kStretch - 1.0) + share * material.radius * kStretch / kRadius;
    const Exposure found = RopeStrengths(material, rod).most_exposed(rod, position);
    EXPECT_NEAR(found.fraction, strain / 0.2, 1e-12);
    EXPECT_NEAR(found.value, strain, 1e-12);
    EXPECT_EQ(found.limit, BreakLimit::kStrain);
  }
  EXPECT_TRUE(can_part(bent(0.3)));
  EXPECT_FALSE(can_part(nylon()));
  EXPECT_TRUE(parts_by_bending(bent(0.3)));
  EXPECT_FALSE(parts_by_bending(nylon()));
}

Points along_z(const std::vector<double>& edges) {
  Points out = Points::Zero(3, static_cast<Eigen::Index>(edges.size()) + 1);
  for (std::size_t j = 0; j < edges.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    out.col(i + 1) = out.col(i) + Vec3(0.0, 0.0, edges[j]);
  }
  return out;
}

TEST(Fracture, ByTensionItIsTheEdgeWithTheLargestOne) {
  Material material = nylon();
  material.breaking_force = 100.0;
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(4, 0.01));
  Points position = along_z({0.01, 0.01, 0.01001, 0.01});
  const double tension = material.stretching_stiffness * 1e-3;
  const Exposure found = RopeStrengths(material, rod).most_exposed(rod, position);
  EXPECT_EQ(found.edge, 2);
  EXPECT_NEAR(found.fraction, tension / 100.0, 1e-9);
  EXPECT_EQ(found.limit, BreakLimit::kForce);
  EXPECT_NEAR(found.value, tension, 1e-7);
  position.row(2) *= 0.9;
  EXPECT_EQ(RopeStrengths(material, rod).most_exposed(rod, position).edge, -1) << "nothing is under tension";
}

/// A strand that lies around a frictionless post of radius R, with its centreline at R + h, parts at
/// T = k_s (eps_b - b h/(R + h)). The strand is light and limp, so that its bend is that of the post.
TEST(Fracture, AStrandAroundAPostPartsByTheBendOfThePost) {
  constexpr double kPost = 0.04, kTension = 400.0, kShare = 0.1;  // diameter [m], [N]
  Material material = nylon();
  const double h = material.radius, bend = kShare * h / (0.5 * kPost + h);
  SpecimenOptions specimen;
  specimen.knot = knot_named("capstan");
  const SpecimenOptions known = knot_of(specimen).defaults(h);
  specimen = known;
  specimen.knot = knot_named("capstan");
  specimen.wrap = M_PI;
  specimen.post_diameter = kPost;
  specimen.tail_load = kTension;
  knot_of(specimen).suit(SpecimenOptions(specimen), 0.0, h, specimen);
  HoldStep settle;
  settle.duration = 2.0;
  for (const double edge : {h, 0.5 * h}) {
    specimen.edge_length = edge;
    const Pulled held = run(specimen, material, PhysicsOptions(), {settle});
    Material weak = bent(kShare);
    weak.breaking_force = weak.stretching_stiffness * bend + kTension;
    const Exposure found =
        RopeStrengths(weak, held.bench.rod()).most_exposed(held.bench.rod(), held.bench.state().position);
    EXPECT_NEAR(found.fraction, 1.0, 0.02) << edge / h;
  }
}

/// Of an arc of radius R under the tension T, pressed from inside by p = T/R, a straight strand squeezed between two by
/// as much on either side, and one that is pulled: fraction = T/F_b + c h p/F_b.
TEST(Fracture, CrushingCountsOnceWhetherTheOtherSideIsHeldByTensionOrByAStrand) {
  constexpr double kForce = 200.0, kShare = 1.5, kPressed = 3e3;  // F_b [N], c, p [N/m]
  Material material = bent(0.0);
  material.breaking_force = kForce;
  material.breaking.set("crushing_share", kShare);
  constexpr int kNodes = 41;
  const double h = material.radius, edge = 0.3 * h;
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(kNodes - 1, edge));
  const RopeStrengths strengths(material, rod);
  EXPECT_TRUE(strengths.crush());
  EXPECT_FALSE(RopeStrengths(bent(0.3), rod).crush());
  const double strain = 1e-4, tension = material.stretching_stiffness * strain / kForce;
  const Points position = along_z(std::vector<double>(kNodes - 1, edge * (1.0 + strain)));
  Pressing from_below = Pressing::Zero(4, kNodes), squeezed = from_below;
  from_below.row(0).setConstant(kPressed * edge);
  from_below.row(3) = from_below.row(0);
  squeezed.row(3) = 2.0 * from_below.row(0);
  for (const Pressing& pressing : {from_below, squeezed})
    EXPECT_NEAR(strengths.most_exposed(rod, position, pressing).fraction, tension + kShare * h * kPressed / kForce,
                1e-9);
  EXPECT_NEAR(strengths.most_exposed(rod, position).fraction, tension, 1e-9);
  // A force at one node alone is that on a diameter of rod.
  Pressing crossed = Pressing::Zero(4, kNodes);
  crossed(1, 20) = crossed(3, 20) = 0.1 * kForce;
  EXPECT_NEAR(strengths.most_exposed(rod, position, crossed).fraction, tension + 0.5 * 0.1 * kShare, 1e-9);
}

/// A limp strand around a frictionless post of radius R, its centreline at R + h, is pressed by p = T/(R + h), and
/// parts at T = F_b/(1 + c h/(R + h)): it parts under 1 % more and holds with 1 % less, of which its stiffness, where
/// it leaves the post, and its polygon take 0.3 %. It has next to no mass, with which a load that is hung on would
/// swing.
TEST(Fracture, AStrandAroundAPostIsCrushedAtTheLoadOfTheClosedForm) {
  constexpr double kPost = 0.02, kTension = 400.0, kShare = 2.0;  // diameter [m], [N]
  Material material = bent(0.0);
  const double h = material.radius;
  material.breaking.set("crushing_share", kShare);
  SpecimenOptions specimen = knot_of(knot_named("capstan")).defaults(h);
  specimen.knot = knot_named("capstan");
  specimen.wrap = M_PI;
  specimen.post_diameter = kPost;
  specimen.edge_length = 0.5 * h;
  knot_of(specimen).suit(SpecimenOptions(specimen), 0.0, h, specimen);
  HoldStep settle;
  settle.duration = 2.0;
  PhysicsOptions physics;
  physics.inertia = 1e-6;
  const double parts_at = kTension * (1.0 + kShare * h / (0.5 * kPost + h));
  for (const double more : {0.99, 1.01}) {
    specimen.tail_load = more * kTension;
    material.breaking_force = parts_at;
    const Pulled held = run(specimen, material, physics, {settle});
    EXPECT_EQ(held.program.ended_by(), more > 1.0 ? EndedBy::kBreak : EndedBy::kProgram) << held.program.reason();
  }
}

/// What joins two ropes is no part of them: neither its length nor the bend at its ends counts.
TEST(Fracture, NoRodPartsWhereItIsCut) {
  const Material material = bent(1.0);
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(5, 0.01), {2});
  Points position = along_z({0.0101, 0.0101, 0.0, 0.0102, 0.0101});
  for (int i = 3; i < 6; ++i) position.col(i) += Vec3(0.3, 0.0, 0.0);
  const Exposure found = RopeStrengths(material, rod).most_exposed(rod, position);
  EXPECT_EQ(found.edge, 3);
  EXPECT_NEAR(found.value, 0.02, 1e-12);
}

}  // namespace
}  // namespace knot_utm
