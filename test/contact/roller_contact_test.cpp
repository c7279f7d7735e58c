#include "knot_utm/contact/roller_contact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "contact/nodal_forces.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/roller_turns.hpp"
#include "rod/finite_difference.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

/// A rod wound by a third of a turn around a roller along y, pressed in by a tenth of the tolerance.
struct Wound {
  RodProperties rod = make_rod(braided_rope(), Eigen::VectorXd::Constant(20, 0.0032));
  NormalLaw normal{1e7, 2e-4};
  Roller roller;
  Points position{3, 21};

  Wound() {
    roller.radius = 0.019;
    roller.centre = Vec3(0.01, 0.02, -0.03);
    const double reach = roller.radius + rod.material.radius - 0.1 * normal.tolerance;
    for (int i = 0; i < 21; ++i) {
      const double angle = 0.1 * (i - 10);
      position.col(i) = roller.centre + reach * Vec3(std::sin(angle), 0.0, std::cos(angle));
    }
  }
  RollerContact touch(const Friction& friction, const Points& end) const {
    RollerContact contact(rod, normal, friction, rod.material.radius);
    contact.begin({roller}, position, 0.01);
    contact.evaluate({roller}, end, position, 0.01);
    return contact;
  }
  /// In a second step, in which the roller turns.
  RollerContact touch(const Friction& friction, const Points& end, double turn) const {
    RollerContact contact = touch(friction, position);
    contact.commit({roller});
    Roller turned = roller;
    turned.turn = turn;
    contact.begin({turned}, position, 0.01);
    contact.evaluate({turned}, end, position, 0.01);
    return contact;
  }
};

Vec3 force_on_rod(const RollerContact& contact) { return unflat(nodal_forces(contact.contacts(), 21)).rowwise().sum(); }

TEST(RollerContact, WhatTheRodPushesTheRollerPushesBack) {
  const Wound scene;
  Points end = scene.position;
  end.row(0).array() += 1e-5;  // and slides a little
  const RollerContact contact = scene.touch(MemoryFriction{0.3, 2e-3 * scene.rod.material.radius}, end);
  ASSERT_GT(contact.contacts().size(), 10u);
  EXPECT_GT(force_on_rod(contact)[2], 0.0);
  EXPECT_LT((force_on_rod(contact) + contact.force_on(0)).norm(), 1e-12 * contact.force_on(0).norm());
}

TEST(RollerContact, WithoutFrictionItPushesStraightOutwards) {
  const Wound scene;
  const RollerContact contact = scene.touch(MemoryFriction{0.0, 1e-5}, scene.position);
  for (const ContactPoint& point : contact.contacts()) {
    EXPECT_LT(point.force.cross(point.n).norm(), 1e-12 * point.force.norm());
    EXPECT_GT(point.force.dot(point.n), 0.0);
    EXPECT_NEAR(point.pressure, scene.normal.pressure(point.overlap), 1e-9 * point.pressure);
    EXPECT_EQ(point.axis.dot(point.force), 0.0);
  }
}

TEST(RollerContact, FrictionIsAtMostItsShareAndAgainstTheSlip) {
  constexpr double kMu = 0.3;
  const Wound scene;
  Points end = scene.position;
  end.row(1).array() += 1e-3;  // along the roller, far beyond presliding
  const RollerContact contact = scene.touch(MemoryFriction{kMu, 1e-5}, end);
  for (const ContactPoint& point : contact.contacts())
    EXPECT_NEAR(point.force[1], -kMu * point.force.dot(point.n), 0.01 * kMu * point.force.norm());
}

TEST(RollerContact, ARollerThatTurnsTakesARodAlongAsARodThatMovesTheOtherWay) {
  const Wound scene;
  const MemoryFriction friction{0.3, 1e-3 * scene.rod.material.radius};
  const double turn = 1e-3;
  const RollerContact turned = scene.touch(friction, scene.position, turn);
  Points back = scene.position.colwise() - scene.roller.centre;
  back = Eigen::AngleAxisd(-turn, scene.roller.axis).toRotationMatrix() * back;
  back.colwise() += scene.roller.centre;
  const RollerContact moved = scene.touch(friction, back, 0.0);
  EXPECT_NEAR(turned.torque_on(0), moved.torque_on(0), 1e-3 * std::abs(moved.torque_on(0)));
  EXPECT_LT(turned.torque_on(0), 0.0) << "the rod resists";
  EXPECT_NEAR(turned.torque_on(0), turned.moment_on(scene.roller, 0, scene.position).dot(scene.roller.axis),
              1e-12 * std::abs(turned.torque_on(0)));
}

class RollerContactJacobian : public testing::TestWithParam<double> {
 protected:
  static constexpr double kTurn = 3e-5;  // of the roller in the step [rad]
};

TEST_P(RollerContactJacobian, IsTheDerivativeOfTheForces) {
  const Wound scene;
  const MemoryFriction friction{0.3, 1e-5};
  Points end = scene.position;
  // Across the roller, along it and away from it: every term of the slip turns.
  end.row(0).array() += GetParam();
  end.row(1).array() += 2.0 * GetParam();
  end.row(2).array() += 1e-6;
  RollerContact contact = scene.touch(friction, end, kTurn);
  for (ContactPoint& point : contact.contacts()) point.prediction = point.pressure;  // tangents at the present overlap
  Eigen::MatrixXd analytic = Eigen::MatrixXd::Zero(end.size(), end.size());
  std::vector<RollerModel> models;
  contact.linearise({}, 0.01, models);
  std::size_t n = 0;
  for (const ContactPoint& point : contact.contacts()) {
    const Mat3 still = still_of(models[n++]);
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        analytic.block<3, 3>(3 * (point.a0 + k), 3 * (point.a0 + l)) += point.c[k] * point.c[l] * still;
  }
  const auto force = [&](const Eigen::VectorXd& x) {
    return nodal_forces(scene.touch(friction, unflat(x), kTurn).contacts(), end.cols());
  };
  const Eigen::MatrixXd numeric = -finite_difference(force, flat(end), 1e-7 * scene.rod.material.radius);
  // Central differences: rounding 1e-16 / 1e-7 relative, curvature of the laws over the step smaller still.
  ASSERT_GT(analytic.norm(), 0.0);
  EXPECT_LT((analytic - numeric).norm(), 2e-6 * numeric.norm());
}

TEST_P(RollerContactJacobian, OfATurningRollerIsTheDerivativeOfForcesAndTorque) {
  const Wound scene;
  const MemoryFriction friction{0.3, 1e-5};
  Points end = scene.position;
  end.row(0).array() += GetParam();
  end.row(1).array() += 2.0 * GetParam();
  RollerContact contact = scene.touch(friction, end, kTurn);
  for (ContactPoint& point : contact.contacts()) point.prediction = point.pressure;
  Roller free = scene.roller;
  free.inertia = 1e-300;  // it is free, and nothing beside what is looked at
  RollerTurns turns;
  turns.begin({free}, contact, static_cast<int>(end.cols()), 0.01);
  std::vector<RollerModel> models;
  contact.linearise({}, 0.01, models);
  std::size_t n = 0;
  for (const ContactPoint& point : contact.contacts()) turns.add(point, models[n++]);
  const RollerTurns::Border& border = turns.border(0);

  // The positions, and the turn behind them.
  Eigen::VectorXd at(end.size() + 1);
  at << flat(end), kTurn;
  const auto all = [&](const Eigen::VectorXd& x) {
    const RollerContact moved = scene.touch(friction, unflat(x.head(end.size())), x[end.size()]);
    Eigen::VectorXd out(end.size() + 1);
    out << nodal_forces(moved.contacts(), end.cols()), moved.torque_on(0);
    return out;
  };
  const Eigen::MatrixXd numeric = -finite_difference(all, at, 1e-7 * scene.rod.material.radius);
  Eigen::VectorXd column(end.size()), row(end.size());
  for (Eigen::Index i = 0; i < end.cols(); ++i) {
    column.segment<3>(3 * i) = to_vec3(border.column[static_cast<std::size_t>(i)]);
    row.segment<3>(3 * i) = to_vec3(border.row[static_cast<std::size_t>(i)]);
  }
  ASSERT_GT(column.norm(), 0.0);
  const Eigen::VectorXd numeric_column = numeric.col(end.size()).head(end.size());
  const Eigen::VectorXd numeric_row = numeric.row(end.size()).head(end.size());
  EXPECT_LT((column - numeric_column).norm(), 1e-5 * numeric_column.norm());
  EXPECT_LT((row - numeric_row).norm(), 1e-5 * numeric_row.norm());
  const double diagonal = numeric(end.size(), end.size());
  EXPECT_NEAR(border.diagonal, diagonal, 1e-5 * std::abs(diagonal));
  EXPECT_NEAR(border.torque, contact.torque_on(0), 1e-9 * std::abs(border.torque));
}

INSTANTIATE_TEST_SUITE_P(Slips, RollerContactJacobian, testing::Values(1e-6, 1e-4),
                         [](const auto& slip) { return slip.param < 1e-5 ? "sticking" : "slipping"; });

TEST(RollerContact, ARodThatDoesNotReachItFeelsNothing) {
  const Wound scene;
  Points away = scene.position;
  away.row(2).array() += 0.1;
  const RollerContact contact = scene.touch(MemoryFriction{0.3, 1e-5}, away);
  EXPECT_TRUE(contact.contacts().empty());
  EXPECT_EQ(contact.force_on(0), Vec3::Zero());
}

TEST(RollerContact, ARodPressedOnARollerRestsOnItWithItsWholeWeight) {
  const Material material = braided_rope();
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(20, material.radius));
  StepSettings settings = closed_form_settings(material);
  settings.gravity = Vec3(0.0, 0.0, -9.81);
  settings.drag = 1.0;
  RodState state = straight_state(rod);
  state.position.row(2).setConstant(-settings.pressure_law.overlap_at(rod.mass.sum() / rod.length() * 9.81));
  const std::unique_ptr<TimeStep> stepper = TimeStep::make(rod, state, settings);
  Boundary boundary;
  boundary.rollers = {plane_below(material.radius)};
  const double weight = 9.81 * rod.mass.sum();
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(stepper->step(boundary, 0.01).accepted());
  EXPECT_NEAR(stepper->readings().roller_force(0)[2], -weight, 1e-3 * weight);
  EXPECT_LT(std::abs(stepper->readings().roller_force(0)[0]), 1e-9);
}

TEST(RollerContact, AStepThatFailsLeavesTheReadingsOfTheLastOne) {
  const Material material = braided_rope();
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(20, material.radius));
  StepSettings settings = closed_form_settings(material);
  settings.gravity = Vec3(0.0, 0.0, -9.81);
  settings.drag = 1.0;
  const std::unique_ptr<TimeStep> stepper = TimeStep::make(rod, straight_state(rod), settings);
  Boundary boundary;
  boundary.rollers = {plane_below(material.radius)};
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(stepper->step(boundary, 0.01).accepted());
  const Vec3 force = stepper->readings().roller_force(0);
  const double contact_energy = stepper->readings().energies().contact;
  const Points position = stepper->state().position;
  ASSERT_LT(force[2], 0.0);
  ASSERT_GT(contact_energy, 0.0);

  boundary.rollers[0].centre[2] += 10.0 * material.radius;  // into the rod, further than a step may move it
  EXPECT_FALSE(stepper->step(boundary, 0.01).accepted());
  EXPECT_EQ(stepper->readings().roller_force(0), force);
  EXPECT_EQ(stepper->readings().energies().contact, contact_energy);
  EXPECT_EQ(stepper->state().position, position);
}

}  // namespace
}  // namespace knot_utm
