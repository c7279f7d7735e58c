#include "knot_utm/contact/smooth_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "contact/candidate_pairs.hpp"
#include "contact/nodal_forces.hpp"
#include "knot_utm/contact/centreline_curve.hpp"
#include "knot_utm/contact/roller_contact.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/material.hpp"
#include "rod/finite_difference.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr double kRadius = 3e-3;
constexpr int kHalf = 20;
constexpr int kDetour = 2;  // nodes far away between the strands, so that what joins them touches nothing

/// Two strands of one rod: the first straight along z, the second a helix around it, overlapping a little.
/// The long edge between them belongs to nothing that touches.
struct TwoStrands {
  RodProperties rod;
  Points start, position;

  explicit TwoStrands(double helix_radius) {
    Material material;
    material.radius = kRadius;
    material.density = 1000.0;
    rod = make_rod(material, Eigen::VectorXd::Constant(2 * kHalf + kDetour - 1, 0.7 * kRadius));
    position.resize(3, 2 * kHalf + kDetour);
    position.col(kHalf) << 1.0, 0.0, 0.7 * kRadius * kHalf;
    position.col(kHalf + 1) << 1.0, 0.0, 0.4 * kRadius * 4;
    for (int i = 0; i < kHalf; ++i) {
      position.col(i) << 0.0, 0.0, 0.7 * kRadius * i;
      const double angle = 0.3 * i;
      position.col(kHalf + kDetour + i) << helix_radius * std::cos(angle), helix_radius * std::sin(angle),
          0.4 * kRadius * (i + 4);
    }
    start = position;
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 0.01 * kRadius);
    for (Eigen::Index i = 0; i < position.size(); ++i) position.data()[i] += noise(random);
  }

  Eigen::VectorXd forces(SmoothContact& contact, const Points& x, double dt) const {
    contact.begin(start);
    contact.evaluate(x, start, dt);
    return nodal_forces(contact.contacts(), x.cols());
  }

  Eigen::MatrixXd stiffness(SmoothContact& contact, const Points& x, double dt) const {
    contact.begin(start);
    contact.evaluate(x, start, dt);
    for (ContactPoint& point : contact.contacts())
      point.prediction = point.pressure;  // tangents at the present overlap
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(x.size(), x.size());
    std::vector<ContactModel> models;
    contact.linearise({}, dt, models);
    std::size_t n = 0;
    for (const ContactPoint& point : contact.contacts()) {
      if (!point.active()) continue;
      const ContactModel& local = models[n++];
      const Mat3 still = still_of(local);
      const Vec3 du_s = point.inverse_g * point.db, du_r = point.inverse_g * point.x;
      auto node = [&](int k) { return k < 3 ? point.a0 + k : point.b0 + k - 3; };
      for (int k = 0; k < 6; ++k)
        for (int l = 0; l < 6; ++l)
          out.block<3, 3>(3 * node(k), 3 * node(l)) +=
              point.c[k] * point.c[l] * still + to_vec3(point.beta[k] * local.force - point.c[k] * local.slide) *
                                                    (point.c[l] * du_s + point.beta[l] * du_r).transpose();
    }
    return out;
  }
};

struct Law {
  const char* name;
  Friction friction;
};

class SmoothContactJacobian : public testing::TestWithParam<Law> {};

TEST_P(SmoothContactJacobian, IsTheDerivativeOfTheForces) {
  TwoStrands scene(1.93 * kRadius);
  const Law law = GetParam();
  SmoothContact contact(scene.rod, NormalLaw{1e6, 0.05 * kRadius}, law.friction, 0.5 * kRadius);
  const double dt = 0.01;
  contact.begin(scene.start);
  contact.evaluate(scene.start, scene.start, dt);
  contact.commit(scene.start);

  const Eigen::MatrixXd analytic = scene.stiffness(contact, scene.position, dt);
  ASSERT_GT(analytic.norm(), 0.0);
  const auto force = [&](const Eigen::VectorXd& x) { return scene.forces(contact, unflat(x), dt); };
  const Eigen::MatrixXd numeric = -finite_difference(force, flat(scene.position), 1e-7 * kRadius);
  // Central differences: rounding 1e-16 / 1e-7 relative, curvature of the laws over the step smaller still.
  EXPECT_LT((analytic - numeric).norm(), 2e-6 * numeric.norm());
}

INSTANTIATE_TEST_SUITE_P(Laws, SmoothContactJacobian,
                         testing::Values(Law{"frictionless", MemoryFriction{0.0, 1.0}},
                                         Law{"sticking", MemoryFriction{0.4, 0.5 * kRadius}},
                                         Law{"slipping", MemoryFriction{0.4, 1e-3 * kRadius}},
                                         Law{"smoothed", SmoothedFriction{0.4, 2e-2}}),
                         [](const auto& law) { return law.param.name; });

TEST(NormalLaw, SlopeAndEnergyAreThePressuresDerivativeAndIntegral) {
  const NormalLaw law{3e6, 1e-4, 2e-4};
  for (const double overlap : {-6e-5, -4e-5, 1e-5, 4e-5, 6e-5, 1.3e-4, 4e-4}) {
    const double step = 1e-9;
    const double p = law.pressure(overlap);
    // Curvature over the step, and rounding of two pressures divided by it.
    EXPECT_NEAR(law.slope(overlap), (law.pressure(overlap + step) - law.pressure(overlap - step)) / (2 * step),
                1e-5 * law.stiffness + 4e-16 * p / step);
    EXPECT_NEAR(p, (law.energy(overlap + step) - law.energy(overlap - step)) / (2 * step), 1e-5 * (p + 1.0));
    if (p > 0.0) {
      EXPECT_NEAR(law.overlap_at(p), overlap, 1e-9 * law.tolerance);
    }
  }
}

constexpr int kWhole = -2;  // as parted edge: no segment reaches into it

/// All pairs of segments of a rod of even edges that are apart by the exclusion along it, and whose nodes are nearer
/// to each other than `near` and half of the longer edge at each. None of them reaches into an edge that has parted.
std::vector<std::pair<int, int>> near_pairs(const Points& x, double edge, double exclusion, double near,
                                            int parted = kWhole) {
  std::vector<std::pair<int, int>> pairs;
  const int nodes = static_cast<int>(x.cols());
  auto half = [&](int i) { return 0.5 * std::max((x.col(i) - x.col(i - 1)).norm(), (x.col(i + 1) - x.col(i)).norm()); };
  auto touches = [&](int i) { return i != parted && i != parted + 1; };
  for (int i = 1; i + 1 < nodes; ++i)
    for (int j = i + 1; j + 1 < nodes; ++j)
      if (touches(i) && touches(j) && edge * (j - i) >= exclusion &&
          (x.col(i) - x.col(j)).norm() < near + half(i) + half(j))
        pairs.push_back({i, j});
  return pairs;
}

TEST(Candidates, OfRodsOfAnyNumberOfNodesAreThoseOfBruteForceWhetherPartedOrNot) {
  std::mt19937 random(7);
  const double edge = 2e-3, reach = 6e-3, margin = 1e-3, exclusion = 9e-3;
  std::vector<int> numbers = {127, 128, 129, 130, 255, 256, 257, 258, 259, 260};
  for (int nodes = 2; nodes <= 70; ++nodes) numbers.push_back(nodes);
  std::size_t found = 0;
  for (const int nodes : numbers)
    for (const int parted : {kWhole, (nodes - 1) / 2}) {
      // A strand that wanders through a box which is the larger the longer it is, a part of it in any place.
      std::uniform_real_distribution<double> step(-edge, edge);
      const double box = 0.8 * edge * std::cbrt(64.0 * nodes);
      Points x = Points::Zero(3, nodes);
      for (int i = 1; i < nodes; ++i)
        for (int k = 0; k < 3; ++k) x(k, i) = std::clamp(x(k, i - 1) + step(random), -0.5 * box, 0.5 * box);
      const RodProperties rod = make_rod({}, Eigen::VectorXd::Constant(nodes - 1, edge));
      Candidates candidates(rod, reach, margin, exclusion);
      if (parted != kWhole) candidates.part(parted);
      candidates.refresh(x);
      auto expected = near_pairs(x, edge, exclusion, reach + margin, parted);
      EXPECT_EQ(pairs_of(candidates), expected) << nodes << ' ' << parted;
      for (std::size_t k = 0, pairs = expected.size(); k < pairs; ++k)
        expected.emplace_back(expected[k].second, expected[k].first);
      std::sort(expected.begin(), expected.end());
      EXPECT_EQ(neighbours_of(candidates), expected) << nodes << ' ' << parted;
      // Runs are as long as they can be, and segments without neighbours have none.
      std::size_t listed = 0;
      for (int i = 0; i < nodes; ++i)
        for (const Candidates::Run* run = candidates.begin(i); run != candidates.end(i); ++run) {
          listed += static_cast<std::size_t>(run->last - run->first + 1);
          EXPECT_TRUE(run == candidates.begin(i) || run[-1].last + 1 < run->first) << nodes << ' ' << i;
        }
      EXPECT_EQ(listed, expected.size()) << nodes;
      found += listed;
    }
  EXPECT_GT(found, 10000u);
}

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
    contact.begin({roller}, position);
    contact.evaluate({roller}, end, position, 0.01);
    return contact;
  }
};

class RollerContactJacobian : public testing::TestWithParam<double> {};

TEST_P(RollerContactJacobian, IsTheDerivativeOfForces) {
  const Wound scene;
  const MemoryFriction friction{0.3, 1e-5};
  Points end = scene.position;
  end.row(0).array() += GetParam();
  end.row(1).array() += 2.0 * GetParam();
  end.row(2).array() += 1e-6;
  RollerContact contact = scene.touch(friction, end);
  for (ContactPoint& point : contact.contacts()) point.prediction = point.pressure;
  std::vector<RollerModel> models;
  contact.linearise({}, 0.01, models);
  std::size_t n = 0;
  Eigen::MatrixXd analytic = Eigen::MatrixXd::Zero(end.size(), end.size());
  for (const ContactPoint& point : contact.contacts()) {
    const Mat3 still = still_of(models[n++]);
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        analytic.block<3, 3>(3 * (point.a0 + k), 3 * (point.a0 + l)) += point.c[k] * point.c[l] * still;
  }

  const auto all = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return nodal_forces(scene.touch(friction, unflat(x)).contacts(), end.cols());
  };
  const Eigen::MatrixXd numeric = -finite_difference(all, flat(end), 1e-7 * scene.rod.material.radius);
  // Central differences: rounding 1e-16 / 1e-7 relative, curvature of the laws over the step smaller still.
  EXPECT_LT((analytic - numeric).norm(), 2e-6 * numeric.norm());
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
