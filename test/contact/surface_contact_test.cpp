// Friction at the surfaces of strands: its linearisation, its work, its balance of moments.

#include "knot_utm/contact/surface_contact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

#include "knot_utm/contact/roller_contact.hpp"
#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_matrix.hpp"
#include "knot_utm/specimen/material.hpp"
#include "rod/finite_difference.hpp"

namespace knot_utm {
namespace {

constexpr double kRadius = 3e-3, kEdge = 0.7 * kRadius, kStep = 0.01;
constexpr int kHalf = 16, kDetour = 2;  // nodes of a strand, and far away between them

/// A rod whose second half winds around its first one, or lies on a roller in its place; in the step every node has
/// moved, and every edge has spun.
struct Wound {
  RodProperties rod;
  Points start, position;
  SectionTurns turns;
  std::vector<Vec3> lean;  // of every edge, as if the frames had moved so
  Roller roller;

  /// `second`: radius of its second half.
  explicit Wound(double second = kRadius) {
    Material material;
    material.radius = kRadius;
    material.density = 1000.0;
    const Eigen::VectorXd edges = Eigen::VectorXd::Constant(2 * kHalf + kDetour - 1, kEdge);
    rod = make_rod(material, edges);
    if (second != kRadius) {
      Material other = material;
      other.radius = second;
      rod = make_rod(material, other, edges, {kHalf});
    }
    position.resize(3, rod.nodes());
    position.col(kHalf) << 1.0, 0.0, 0.0;
    position.col(kHalf + 1) << 1.0, 0.0, 0.1;
    const double away = 0.975 * (kRadius + second);
    for (int i = 0; i < kHalf; ++i) {
      const double angle = 0.3 * i;
      position.col(i) << 0.0, 0.0, kEdge * i;
      position.col(kHalf + kDetour + i) << away * std::cos(angle), away * std::sin(angle), 0.4 * kRadius * (i + 3);
    }
    start = position;
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0.0, 0.01 * kRadius);
    for (Eigen::Index i = 0; i < position.size(); ++i) position.data()[i] += noise(random);
    for (Eigen::Index j = 0; j < rod.edges(); ++j) {
      turns.turn.push_back(40.0 * noise(random) / kRadius);
      lean.emplace_back(40.0 / kRadius / kRadius * Vec3(noise(random), noise(random), noise(random)));
    }
    set_lengths();
    roller.axis = Vec3::UnitZ();
    roller.radius = kRadius;
  }

  Eigen::Index nodes() const { return rod.nodes(); }
  /// x and the spin angle of all nodes and edges, one after the other.
  Eigen::VectorXd unknowns() const {
    Eigen::Matrix4Xd out = Eigen::Matrix4Xd::Zero(4, nodes());
    out.topRows<3>() = position;
    for (Eigen::Index j = 0; j < rod.edges(); ++j) out(3, j) = turns.turn[static_cast<std::size_t>(j)];
    return Eigen::Map<Eigen::VectorXd>(out.data(), out.size());
  }
  void set_lengths() {
    turns.length.resize(turns.turn.size());
    turns.tangent.resize(turns.turn.size());
    turns.pull.resize(turns.turn.size());
    for (Eigen::Index j = 0; j < rod.edges(); ++j) {
      const auto i = static_cast<std::size_t>(j);
      const Vec3 edge = position.col(j + 1) - position.col(j);
      turns.length[i] = edge.norm();
      turns.tangent[i] = to_lanes(Vec3(edge.normalized()));
      turns.pull[i] = to_lanes(Vec3(lean[i] - turns.turn[i] / edge.squaredNorm() * edge));
    }
  }
  void set(const Eigen::VectorXd& unknowns) {
    const Eigen::Map<const Eigen::Matrix4Xd> all(unknowns.data(), 4, nodes());
    position = all.topRows<3>();
    for (Eigen::Index j = 0; j < rod.edges(); ++j) turns.turn[static_cast<std::size_t>(j)] = all(3, j);
    set_lengths();
  }
};

constexpr double kStiffness = 1e6, kTolerance = 0.05 * kRadius;

/// Each kind of contact in the scene, as it is evaluated first in a step.
struct BetweenStrands {
  static constexpr double kSecond = kRadius;
  Wound& scene;
  SmoothContact contact;
  BetweenStrands(Wound& wound, const Friction& friction)
      : scene(wound), contact(wound.rod, NormalLaw{kStiffness, kTolerance}, friction, 0.5 * kRadius) {
    contact.begin(wound.start);
    contact.evaluate(wound.start, wound.start, kStep);
    contact.commit(wound.start);
  }
  void evaluate() {
    contact.begin(scene.start);
    contact.evaluate(scene.position, scene.start, kStep);
  }
};
using Smooth = BetweenStrands;
/// A thinner strand of another material winds around the first one.
struct OfTwoMaterials : BetweenStrands {
  static constexpr double kSecond = 0.6 * kRadius;
  OfTwoMaterials(Wound& wound, const Friction& friction) : BetweenStrands(wound, friction) {
    contact.tell_apart({NormalLaw{0.5 * kStiffness, kTolerance}, friction},
                       {NormalLaw{kStiffness, kTolerance}, friction});
  }
};
struct OnARoller {
  static constexpr double kSecond = kRadius;
  Wound& scene;
  RollerContact contact;
  const Vec3 moves = Vec3(1e-2, -2e-2, 1e-2) * kRadius;  // in the step
  OnARoller(Wound& wound, const Friction& friction, double ring = 0.0)
      : scene(wound), contact(wound.rod, NormalLaw{kStiffness, kTolerance}, friction, kRadius) {
    scene.roller.first_node = kHalf + kDetour + 1;
    if (ring > 0.0) bend_to_a_ring(ring);
    contact.begin({scene.roller}, scene.start);
    contact.evaluate({scene.roller}, scene.start, scene.start, kStep);
    contact.commit({scene.roller});
    scene.roller.centre += moves;
  }
  void bend_to_a_ring(double radius) {
    scene.roller.ring = radius;
    scene.roller.axis = Vec3::UnitY();
    scene.roller.centre = Vec3(-radius, 0.0, 0.0);
  }
  void evaluate() {
    contact.begin({scene.roller}, scene.start);
    contact.evaluate({scene.roller}, scene.position, scene.start, kStep);
  }
};

struct OnARing : OnARoller {
  OnARing(Wound& wound, const Friction& friction) : OnARoller(wound, friction, 12.0 * kRadius) {}
};

/// Their sections give; edges of unlike lengths are a little stretched or compressed.
template <typename Kind>
struct WithSoftSections : Kind {
  Eigen::VectorXd rest;
  using Kind::Kind;
  void evaluate() {
    rest.resize(this->scene.rod.edges());
    for (Eigen::Index j = 0; j < rest.size(); ++j) rest[j] = (0.95 + 0.04 * static_cast<double>(j * j % 7)) * kEdge;
    this->contact.soften(rest);
    Kind::evaluate();
  }
  /// The same with strands that are evenly stretched, the first one by a twentieth.
  void evaluate_evenly() {
    rest.setConstant(this->scene.rod.edges(), 1.05 * kEdge);
    rest.head(kHalf + 1).setConstant(kEdge / 1.05);
    this->contact.soften(rest);
    Kind::evaluate();
  }
};
using Soft = WithSoftSections<Smooth>;
using SoftOfTwoMaterials = WithSoftSections<OfTwoMaterials>;
using SoftOnARoller = WithSoftSections<OnARoller>;

template <typename Kind>
class Surface : public testing::Test {
 protected:
  Wound scene{Kind::kSecond};

  static Eigen::VectorXd forces(Kind& kind) {
    kind.evaluate();
    std::vector<Lanes> force(static_cast<std::size_t>(kind.scene.nodes()));
    for (std::size_t i = 0; i < kind.contact.contacts().size(); ++i) {
      const ContactPoint& contact = kind.contact.contacts()[i];
      if (!contact.touches()) continue;
      const Lanes g = to_lanes(contact.force);
      for (int k = 0; k < 3; ++k) {
        force[static_cast<std::size_t>(contact.a0 + k)] += contact.c[k] * g;
        if (!contact.on_roller()) force[static_cast<std::size_t>(contact.b0 + k)] += contact.c[3 + k] * g;
      }
      const SurfacePoint& surface = kind.contact.surfaces()[i];
      add_couples(contact, surface, surface.on_a, surface.on_b, force);
    }
    return Eigen::Map<Eigen::VectorXd>(reinterpret_cast<double*>(force.data()), 4 * kind.scene.nodes());
  }

  static Eigen::MatrixXd stiffness(Kind& kind) {
    kind.evaluate();
    for (ContactPoint& point : kind.contact.contacts()) point.prediction = point.pressure;  // tangents where it is
    StepMatrix<4> matrix(static_cast<int>(kind.scene.nodes()));
    if constexpr (std::is_base_of_v<OnARoller, Kind>)
      matrix.locate({});  // contacts with rollers stand within the band
    else
      matrix.locate(kind.contact.contacts());
    const BlockPattern& pattern = matrix.values().pattern();
    for (int block = 0; block < pattern.blocks(); ++block) matrix.block(block).set_zero();
    std::size_t n = 0;
    linearise_surfaces(kind.contact, {}, kStep, [&](std::size_t i, const SurfaceModel& model) {
      matrix.add(kind.contact.contacts()[i], kind.contact.surfaces()[i], model, kind.scene.turns, n++);
    });
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(4 * kind.scene.nodes(), 4 * kind.scene.nodes());
    for (int i = 0; i < kind.scene.nodes(); ++i)
      for (int j = 0; j < kind.scene.nodes(); ++j) {
        const int block = pattern.index(i, j);
        if (block < 0) continue;
        for (int row = 0; row < 4; ++row)
          for (int column = 0; column < 4; ++column)
            out(4 * i + row, 4 * j + column) = matrix.block(block)(row, column);
      }
    return out;
  }

  void expect_exact(const Friction& friction, double couple, const RollingLaws& rolling = {}, double fraction = 1e-6) {
    Kind kind(scene, friction);
    kind.contact.act_at_surface(couple, scene.turns, rolling);
    const Eigen::VectorXd at = scene.unknowns();
    Eigen::MatrixXd analytic = stiffness(kind);
    // Positions and angles differ in size.
    Eigen::MatrixXd numeric(at.size(), at.size());
    for (Eigen::Index j = 0; j < at.size(); ++j) {
      const double step = j % 4 == 3 ? fraction : fraction * kRadius;
      const auto force = [&](const Eigen::VectorXd& shift) {
        Eigen::VectorXd moved = at;
        moved[j] += shift[0];
        scene.set(moved);
        return forces(kind);
      };
      numeric.col(j) = -finite_difference(force, Eigen::VectorXd::Zero(1), step);
    }
    scene.set(at);
    // Newton's method moves spins: dpsi_j = ds_j - lean_j . (dx_{j+1} - dx_j).
    for (Eigen::Index j = 0; j < scene.rod.edges(); ++j) {
      const Eigen::VectorXd by_spin = numeric.col(4 * j + 3);
      const Vec3& lean = scene.lean[static_cast<std::size_t>(j)];
      for (int i = 0; i < 3; ++i) {
        numeric.col(4 * j + i) += by_spin * lean[i];
        numeric.col(4 * j + 4 + i) -= by_spin * lean[i];
      }
    }
    ASSERT_GT(analytic.norm(), 0.0);
    // Forces, and torques over the radius; changes of positions, and of angles times the radius.
    for (Eigen::Index j = 3; j < at.size(); j += 4)
      for (Eigen::MatrixXd* m : {&analytic, &numeric}) {
        m->row(j) /= kRadius;
        m->col(j) /= kRadius;
      }
    EXPECT_LT((analytic - numeric).norm(), 2e-6 * numeric.norm());
    const auto spins = [](const Eigen::MatrixXd& m) {
      Eigen::MatrixXd out = m;
      for (Eigen::Index j = 0; j < m.rows(); ++j)
        if (j % 4 != 3) out.row(j).setZero();
      return out;
    };
    EXPECT_GT(spins(numeric).norm(), 1e-4 * numeric.norm());
    EXPECT_LT(spins(analytic - numeric).norm(), 1e-5 * spins(numeric).norm());
  }
};

using Kinds = testing::Types<Smooth, OnARoller, OnARing, OfTwoMaterials, Soft, SoftOfTwoMaterials, SoftOnARoller>;
TYPED_TEST_SUITE(Surface, Kinds);

TYPED_TEST(Surface, JacobianIsTheDerivativeOfTheForcesWhereItSlides) {
  this->expect_exact(MemoryFriction{0.4, 1e-3 * kRadius}, 1.0);
}
TYPED_TEST(Surface, JacobianIsTheDerivativeOfTheForcesWhereItSticks) {
  this->expect_exact(MemoryFriction{0.4, 5.0 * kRadius}, 1.0);
}
TYPED_TEST(Surface, JacobianIsTheDerivativeOfTheForcesWithSmoothedFrictionAndAShareOfTheCouple) {
  this->expect_exact(SmoothedFriction{0.4, 2e-2}, 0.3);
}

/// Beyond the elastic rolling, and within it.
TYPED_TEST(Surface, JacobianIsTheDerivativeOfTheForcesWhereItResistsRolling) {
  for (const double presliding : {1e-3, 5.0})
    for (const double growth : {0.0, 0.05})
      this->expect_exact(MemoryFriction{0.4, 1e-3 * kRadius}, 0.7,
                         RollingResistance{0.3, kRadius, presliding * kRadius, growth});
}

/// All contacts of its scene are between both materials.
using SurfaceOfTwoMaterials = Surface<OfTwoMaterials>;

TEST_F(SurfaceOfTwoMaterials, JacobianIsTheDerivativeOfTheForcesWhereOnlyTheirPairResistsRolling) {
  RollingLaws rolling;
  rolling.of[1] = {0.3, 0.8 * kRadius, 0.5 * kRadius, 0.05};
  expect_exact(MemoryFriction{0.4, 1e-3 * kRadius}, 0.7, rolling);
  OfTwoMaterials with(scene, MemoryFriction{0.4, 1e-3 * kRadius}), of_others(with);
  rolling.of[0] = {0.7, 0.3 * kRadius, kRadius};
  with.contact.act_at_surface(0.7, scene.turns, rolling);
  of_others.contact.act_at_surface(0.7, scene.turns, rolling[1]);
  EXPECT_EQ(forces(with), forces(of_others));
}

/// In the step, a straight strand bends around another one until its feet are about to jump: G falls to 4e-4 |b'|^2,
/// while the contacts keep the weighting factors of the straight strand. The foot of a contact then moves by some
/// 4000 times as much as its point, so that differences are taken over shorter ways.
struct SurfaceWhereAFootIsAboutToJump : Surface<Smooth> {
  static constexpr double kG = 4e-4;  // [|b'|^2]
};

TEST_F(SurfaceWhereAFootIsAboutToJump, JacobianIsTheDerivativeOfTheForces) {
  const double away = 1.95 * kRadius, s2 = kEdge * kEdge;
  // x.b'' = (1 - kG) |b'|^2 half way along a segment, where the foot is b''/8 nearer than the node.
  const double wanted = (1.0 - kG) * s2, bend = 4.0 * (away - std::sqrt(away * away - 0.5 * wanted));
  constexpr int kFirst = kHalf + kDetour, kMiddle = kFirst + kHalf / 2;
  for (int i = kFirst; i < kFirst + kHalf; ++i) {
    const double from_middle = i - kMiddle;
    scene.start.col(i) << away, kEdge * from_middle, kEdge * kHalf / 2;
    scene.position.col(i) = scene.start.col(i);
    if (std::abs(i - kMiddle) < 2) scene.position(0, i) -= 0.5 * bend * from_middle * from_middle;
  }
  scene.position.leftCols<kHalf>() = scene.start.leftCols<kHalf>();
  scene.set_lengths();
  Smooth kind(scene, MemoryFriction{0.4, 1e-3 * kRadius});
  kind.contact.act_at_surface(1.0, scene.turns);
  kind.evaluate();
  double least = 1.0, weighting = 0.0;
  for (const ContactPoint& contact : kind.contact.contacts())
    if (contact.touches() && contact.inverse_g * contact.db.squaredNorm() > 100.0) {
      least = std::min(least, 1.0 / (contact.inverse_g * contact.db.squaredNorm()));
      weighting = std::max(weighting, contact.weighting);
    }
  EXPECT_NEAR(least, kG, 0.1 * kG);
  EXPECT_GT(weighting, 0.4);
  for (const double presliding : {1e-3, 5.0})
    expect_exact(MemoryFriction{0.4, presliding * kRadius}, 1.0, RollingResistance{0.3, kRadius, 1e-3 * kRadius}, 1e-9);
}

/// The forces of soft sections without friction are the derivative of their energy where strands cross that are
/// straight and evenly stretched, so that feet do not move along a cone; and on a roller.
template <typename Kind>
void expect_forces_of_energy() {
  Wound scene;
  if constexpr (!std::is_base_of_v<OnARoller, Kind>)
    for (int i = 0; i < kHalf; ++i)
      scene.start.col(kHalf + kDetour + i) << 1.9 * kRadius, 0.8 * kEdge * (i - 7), kEdge * (7.0 + 0.6 * (i - 7));
  scene.position = scene.start;
  scene.set_lengths();
  Kind kind(scene, MemoryFriction{0.0, kRadius});
  kind.contact.act_at_surface(1.0, scene.turns);
  const auto energy = [&](const Eigen::VectorXd& position) {
    scene.position = Eigen::Map<const Points>(position.data(), 3, scene.nodes());
    scene.set_lengths();
    kind.evaluate_evenly();
    double sum = 0.0;
    for (const ContactPoint& contact : kind.contact.contacts())
      sum += kind.contact.motion(contact, scene.position, scene.start).weight *
             kind.contact.energy(contact.pair, contact.overlap);
    return sum;
  };
  const Eigen::VectorXd at = Eigen::Map<Eigen::VectorXd>(scene.position.data(), scene.position.size());
  ASSERT_GT(energy(at), 0.0);
  std::vector<Lanes> force(static_cast<std::size_t>(scene.nodes()));
  for (std::size_t i = 0; i < kind.contact.contacts().size(); ++i) {
    const ContactPoint& contact = kind.contact.contacts()[i];
    for (int k = 0; k < 3; ++k) {
      force[static_cast<std::size_t>(contact.a0 + k)] += contact.c[k] * to_lanes(contact.force);
      if (!contact.on_roller())
        force[static_cast<std::size_t>(contact.b0 + k)] += contact.c[3 + k] * to_lanes(contact.force);
    }
    const SurfacePoint& surface = kind.contact.surfaces()[i];
    add_couples(contact, surface, surface.on_a, surface.on_b, force);
  }
  double largest = 0.0, apart = 0.0;
  for (Eigen::Index j = 0; j < at.size(); ++j) {
    const double step = 1e-6 * kRadius;
    const Eigen::VectorXd shift = step * Eigen::VectorXd::Unit(at.size(), j);
    const double numeric = -(energy(at + shift) - energy(at - shift)) / (2.0 * step);
    const double own = force[static_cast<std::size_t>(j / 3)][static_cast<int>(j % 3)];
    largest = std::max(largest, std::abs(numeric));
    apart = std::max(apart, std::abs(own - numeric));
  }
  EXPECT_LT(apart, 1e-5 * largest);
}

TEST(SoftSections, ForcesAreTheDerivativeOfTheEnergy) {
  expect_forces_of_energy<Soft>();
  expect_forces_of_energy<SoftOnARoller>();
}

/// How much the overlap of each contact changes with the nodes, by which Newton's method predicts its pressure.
template <typename Kind>
void expect_predicted_overlaps() {
  Wound scene{Kind::kSecond};
  Kind kind(scene, MemoryFriction{0.0, kRadius});
  kind.contact.act_at_surface(1.0, scene.turns);
  const Points at = scene.position;
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1e-6 * kRadius);
  Points change(3, at.cols());
  for (double& one : change.reshaped()) one = noise(random);
  const auto contacts_at = [&](double factor) {
    scene.position = at + factor * change;
    scene.set_lengths();
    kind.evaluate();
    return kind.contact.contacts();
  };
  const std::vector<ContactPoint> behind = contacts_at(-1.0), ahead = contacts_at(1.0), contacts = contacts_at(0.0);
  ASSERT_EQ(ahead.size(), contacts.size());
  ASSERT_EQ(behind.size(), contacts.size());
  double largest = 0.0, apart = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactPoint& contact = contacts[i];
    if (!contact.touches()) continue;
    const SurfacePoint& surface = kind.contact.surfaces()[i];
    Vec3 shift = Vec3::Zero(), turn_a = Vec3::Zero(), turn_b = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      shift += contact.c[k] * change.col(contact.a0 + k);
      turn_a += surface.d_a[k] * change.col(contact.a0 + k);
      if (contact.on_roller()) continue;
      shift += contact.c[3 + k] * change.col(contact.b0 + k);
      turn_b += contact.beta[3 + k] * change.col(contact.b0 + k);
    }
    const double predicted = overlap_change(contact, surface, kind.contact.soft_points()[i], shift, turn_a, turn_b);
    largest = std::max(largest, std::abs(predicted));
    apart = std::max(apart, std::abs(predicted - 0.5 * (ahead[i].overlap - behind[i].overlap)));
  }
  ASSERT_GT(largest, 0.0);
  EXPECT_LT(apart, 1e-6 * largest);
}

TEST(SoftSections, PredictedOverlapsAreTheirDerivatives) {
  expect_predicted_overlaps<Soft>();
  expect_predicted_overlaps<SoftOfTwoMaterials>();
  expect_predicted_overlaps<SoftOnARoller>();
}

/// The work of all forces and torques on what nodes and spins did in the step is that of g on the slip, less what
/// resistance to rolling takes up.
TYPED_TEST(Surface, WorkIsThatOfTheForceOnTheSlipExactly) {
  TypeParam kind(this->scene, MemoryFriction{0.4, 1e-3 * kRadius});
  kind.contact.act_at_surface(0.7, this->scene.turns, RollingResistance{0.3, kRadius, 0.05 * kRadius});
  const Eigen::VectorXd force = this->forces(kind);
  Eigen::VectorXd way = this->scene.unknowns();
  for (Eigen::Index i = 0; i < this->scene.nodes(); ++i) way.segment<3>(4 * i) -= this->scene.start.col(i);
  double work = force.dot(way), slip = 0.0, gross = 0.0;
  for (const ContactPoint& contact : kind.contact.contacts()) {
    if (!contact.touches()) continue;
    const ContactMotion motion = kind.contact.motion(contact, this->scene.position, this->scene.start);
    slip += contact.force.dot(motion.slip + motion.rolling) + motion.thinning;
    gross += contact.force.norm() * motion.rolling.norm();
    slip -= rolling_loss(contact,
                         kind.contact.surfaces()[static_cast<std::size_t>(&contact - kind.contact.contacts().data())]);
    if constexpr (std::is_base_of_v<OnARoller, TypeParam>) slip += contact.force.dot(kind.moves);
  }
  ASSERT_GT(gross, 0.0);
  EXPECT_NEAR(work, slip, 1e-12 * gross + 1e-12 * std::abs(work));
}

/// Resistance to rolling of the scene, whose second strand winds around its first one, as that strand does in a step
/// what `moves` says of a node and its place along the helix.
struct RollingHelix {
  static constexpr double kPresliding = 1e-3 * kRadius;
  static constexpr double kResistance = 0.3;
  Wound scene;
  Smooth kind{scene, MemoryFriction{0.4, 1e-3 * kRadius}};
  Points before;

  RollingHelix() {
    scene.position = before = scene.start;
    std::fill(scene.turns.turn.begin(), scene.turns.turn.end(), 0.0);
    std::fill(scene.lean.begin(), scene.lean.end(), Vec3::Zero());
    kind.contact.act_at_surface(1.0, scene.turns, RollingResistance{kResistance, kRadius, kPresliding});
  }
  /// Sum of |C|, and of its limit mu_r h w p, over the contacts that the helix bears nearly alone.
  std::pair<double, double> couples() {
    scene.set_lengths();
    kind.evaluate();
    double couple = 0.0, limit = 0.0;
    for (std::size_t i = 0; i < kind.contact.contacts().size(); ++i) {
      const ContactPoint& contact = kind.contact.contacts()[i];
      if (!contact.touches() || contact.weighting < 0.9) continue;
      couple += kind.contact.surfaces()[i].couple.norm();
      limit += kResistance * kRadius * contact.weight * contact.pressure;
    }
    return {couple, limit};
  }
};

TEST(RollingAboutItsLine, AHelixThatAdvancesThroughItselfRollsOverNothing) {
  RollingHelix helix;
  const Points& start = helix.scene.start;
  for (int i = kHalf + kDetour; i + 1 < helix.scene.nodes(); ++i)
    helix.scene.position.col(i) += 0.05 * (start.col(i + 1) - start.col(i));
  const auto [couple, limit] = helix.couples();
  ASSERT_GT(limit, 0.0);
  // Chords between nodes are not the curve: its sections turn about their own tangents by a little.
  EXPECT_LT(couple, 0.02 * limit);
}

TEST(RollingAboutItsLine, AHelixThatSpinsInPlaceIsResistedInFull) {
  RollingHelix helix;
  for (int j = kHalf + kDetour; j < helix.scene.rod.edges(); ++j)
    helix.scene.turns.turn[static_cast<std::size_t>(j)] = 0.05;
  const auto [couple, limit] = helix.couples();
  ASSERT_GT(limit, 0.0);
  EXPECT_NEAR(couple, limit, 1e-9 * limit);
}

/// Over any history of turns, what resistance takes up less what its springs store, w mu_r p rho_s zeta^2/2, grows.
TEST(RollingAboutItsLine, WorkIsNeverCreated) {
  RollingHelix helix;
  SmoothContact& contact = helix.kind.contact;
  std::mt19937 random(11);
  std::normal_distribution<double> turns(0.0, 2.0 * RollingHelix::kPresliding / kRadius);
  const auto stored = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i < contact.contacts().size(); ++i) {
      const ContactPoint& point = contact.contacts()[i];
      const double zeta = contact.surfaces()[i].zeta;
      if (point.touches())
        sum +=
            0.5 * point.weight * RollingHelix::kResistance * point.pressure * RollingHelix::kPresliding * zeta * zeta;
    }
    return sum;
  };
  double store = 0.0, gross = 0.0;
  for (int step = 0; step < 200; ++step) {
    for (double& turn : helix.scene.turns.turn) turn = turns(random);
    helix.kind.evaluate();
    double lost = store - stored();
    store = stored();
    for (std::size_t i = 0; i < contact.contacts().size(); ++i)
      if (contact.contacts()[i].touches()) lost += rolling_loss(contact.contacts()[i], contact.surfaces()[i]);
    gross += lost;
    EXPECT_GE(lost, -1e-12 * gross) << "step " << step;
    contact.commit(helix.scene.position);
  }
  EXPECT_GT(gross, 0.0);
}

}  // namespace
}  // namespace knot_utm
