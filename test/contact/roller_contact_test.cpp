#include "knot_utm/contact/roller_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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

class RollerContactJacobian : public testing::TestWithParam<double> {
 protected:
  static constexpr double kTurn = 3e-5;  // of the roller in the step [rad]
};

TEST_P(RollerContactJacobian, IsTheDerivativeOfForcesAndTorque) {
  const Wound scene;
  const MemoryFriction friction{0.3, 1e-5};
  Points end = scene.position;
  end.row(0).array() += GetParam();
  end.row(1).array() += 2.0 * GetParam();
  end.row(2).array() += 1e-6;
  RollerContact contact = scene.touch(friction, end, kTurn);
  for (ContactPoint& point : contact.contacts()) point.prediction = point.pressure;
  Roller free = scene.roller;
  free.inertia = 1e-300;  // it is free, and nothing beside what is looked at
  RollerTurns turns;
  turns.begin({free}, contact, static_cast<int>(end.cols()), 0.01);
  std::vector<RollerModel> models;
  contact.linearise({}, 0.01, models);
  std::size_t n = 0;
  Eigen::MatrixXd analytic = Eigen::MatrixXd::Zero(end.size(), end.size());
  for (const ContactPoint& point : contact.contacts()) {
    const Mat3 still = still_of(models[n]);
    turns.add(point, models[n++]);
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        analytic.block<3, 3>(3 * (point.a0 + k), 3 * (point.a0 + l)) += point.c[k] * point.c[l] * still;
  }
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
  // Central differences: rounding 1e-16 / 1e-7 relative, curvature of the laws over the step smaller still.
  const Eigen::MatrixXd of_positions = numeric.topLeftCorner(end.size(), end.size());
  EXPECT_LT((analytic - of_positions).norm(), 2e-6 * of_positions.norm());
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

/// A ring whose section is the roller of a wound rod, and which the rod passes through.
Wound through_a_ring() {
  Wound out;
  out.roller.ring = 0.025;
  out.roller.centre[0] -= out.roller.ring;
  out.roller.axis = Vec3::UnitZ();
  return out;
}

TEST(Ring, IsACylinderForARodInAPlaneThroughItsAxis) {
  const Wound cylinder, ring = through_a_ring();
  const MemoryFriction friction{0.3, 1e-5};
  Points end = cylinder.position;
  end.row(0).array() += 1e-4;
  end.row(2).array() += 1e-6;
  const RollerContact on_cylinder = cylinder.touch(friction, end), on_ring = ring.touch(friction, end);
  ASSERT_GT(on_cylinder.force_on(0).norm(), 1.0);
  // Both are the same sums but for the place of the nearest section, which is found to rounding.
  EXPECT_LT((on_ring.force_on(0) - on_cylinder.force_on(0)).norm(), 1e-9 * on_cylinder.force_on(0).norm());
  const Vec3 about_ring = on_ring.moment_on(ring.roller, 0, end),
             about_cylinder = on_cylinder.moment_on(cylinder.roller, 0, end);
  const Vec3 between = Vec3(ring.roller.ring, 0.0, 0.0).cross(on_ring.force_on(0));
  EXPECT_LT((about_ring - about_cylinder - between).norm(), 1e-9 * about_ring.norm());
}

TEST(Ring, GapChangesAsThePlaceMoves) {
  const Roller ring = through_a_ring().roller;
  const auto gap = [&](const Eigen::VectorXd& place) -> Eigen::VectorXd { return beside(ring, place).x; };
  for (const Vec3& away : {Vec3(0.004, 0.007, 0.01), Vec3(-0.03, 0.012, -0.02), Vec3(0.0, 1e-4, 0.015)}) {
    const Vec3 place = ring.centre + away, b = beside(ring, place).axis;
    // Central differences: the curvature of the gap over a step of 1e-4 of the distance from the ring's axis.
    const Eigen::MatrixXd numeric = finite_difference(gap, place, 1e-4 * away.head<2>().norm());
    EXPECT_LT((numeric - (Mat3::Identity() - b * b.transpose())).norm(), 1e-7 * numeric.norm());
    EXPECT_NEAR(b.dot(beside(ring, place).x), 0.0, 1e-15);
  }
  const BesideRoller middle = beside(ring, ring.centre);
  EXPECT_NEAR(middle.x.norm(), ring.ring, 1e-15) << "as far from all sections";
}

TEST(Ring, JacobianIsTheDerivativeOfForces) {
  const Wound scene = through_a_ring();
  for (const double slip : {1e-6, 1e-4}) {
    const MemoryFriction friction{0.3, 1e-5};
    Points end = scene.position;
    end.row(0).array() += slip;
    for (int i = 0; i < 21; ++i) end(1, i) += 2.0 * slip + 1e-4 * (i - 10);  // out of the plane through its axis
    end.row(2).array() += 1e-6;
    RollerContact contact = scene.touch(friction, end);
    for (ContactPoint& point : contact.contacts()) point.prediction = point.pressure;
    std::vector<RollerModel> models;
    contact.linearise({}, 0.01, models);
    Eigen::MatrixXd analytic = Eigen::MatrixXd::Zero(end.size(), end.size());
    for (std::size_t n = 0; n < contact.contacts().size(); ++n) {
      const ContactPoint& point = contact.contacts()[n];
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          analytic.block<3, 3>(3 * (point.a0 + k), 3 * (point.a0 + l)) += point.c[k] * point.c[l] * still_of(models[n]);
    }
    const auto forces = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return nodal_forces(scene.touch(friction, unflat(x)).contacts(), end.cols());
    };
    const Eigen::MatrixXd numeric = -finite_difference(forces, flat(end), 1e-7 * scene.rod.material.radius);
    ASSERT_GT(numeric.norm(), 0.0);
    EXPECT_LT((analytic - numeric).norm(), 2e-6 * numeric.norm()) << slip;  // as on a cylinder, above
  }
}

TEST(Ring, MotionKnowsTheOverlapBefore) {
  const Wound scene = through_a_ring();
  Points end = scene.position;
  end.row(1).array() += 3e-3;  // along the ring
  const MemoryFriction friction{0.3, 1e-5};
  const RollerContact before = scene.touch(friction, scene.position), now = scene.touch(friction, end);
  ASSERT_FALSE(now.contacts().empty());
  for (const ContactPoint& point : now.contacts()) {
    const auto same = std::find_if(before.contacts().begin(), before.contacts().end(), [&](const ContactPoint& other) {
      return other.a0 == point.a0 && other.point == point.point;
    });
    ASSERT_NE(same, before.contacts().end());
    EXPECT_NEAR(now.motion(point, end, scene.position).overlap_before, same->overlap, 1e-12 * scene.roller.radius);
  }
}

INSTANTIATE_TEST_SUITE_P(Slips, RollerContactJacobian, testing::Values(1e-6, 1e-4),
                         [](const auto& slip) { return slip.param < 1e-5 ? "sticking" : "slipping"; });

}  // namespace
}  // namespace knot_utm
