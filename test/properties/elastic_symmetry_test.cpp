// Elastic energies and forces of a random rod with natural curvature and twist.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "knot_utm/rod/energy.hpp"
#include "knot_utm/sim/centreline_terms.hpp"
#include "knot_utm/sim/frame_terms.hpp"
#include "properties/random.hpp"

namespace knot_utm::properties {
namespace {

/// A rod with frames and what it exerts on itself.
struct Rod {
  RodProperties rod;
  RodState state;

  double energy() const { return elastic_energy(rod, state).total(); }

  /// Force on every node, and in the last row torque about every edge.
  Eigen::Matrix4Xd forces() const {
    std::vector<Lanes> sum(static_cast<std::size_t>(rod.nodes()), Lanes{0.0, 0.0, 0.0, 0.0});
    const Boundary free;
    const StepStart step{state, free, 1.0};
    CentrelineTerms(rod, !state.curved_at_rest()).add_forces(step, state.position, sum);
    StepSettings settings;
    settings.spin_inertia = false;
    FrameTerms frames(rod, settings);
    frames.begin(step, false);
    frames.add_forces(step, state.position, sum);
    Eigen::Matrix4Xd out(4, rod.nodes());
    for (Eigen::Index i = 0; i < rod.nodes(); ++i)
      for (int k = 0; k < 4; ++k) out(k, i) = sum[static_cast<std::size_t>(i)][k];
    return out;
  }

  /// By how much a coordinate may be off: places are sums of a few numbers of this size.
  double coordinate_error() const {
    return 8.0 * std::numeric_limits<double>::epsilon() * state.position.cwiseAbs().maxCoeff();
  }
  /// Stiffest a node can be: two edges' stretching, and bending and twisting over edges of l.
  double stiffness() const {
    const RodMaterial& m = rod.material;
    const double l = rod.rest_length.minCoeff();
    return 4.0 * m.stretching_stiffness / l + 64.0 * (m.bending_stiffness + m.twisting_stiffness) / (l * l * l);
  }
  double force_error() const { return coordinate_error() * stiffness(); }
  /// Of all nodes, to first and second order.
  double energy_error() const {
    const double largest = forces().topRows<3>().colwise().norm().maxCoeff();
    return static_cast<double>(rod.nodes()) * coordinate_error() * (largest + force_error()) + 1e-14 * energy();
  }
};

Rod random_rod() {
  const std::vector<int> numbers = random_numbers(RandomScene::kNumbers);
  const Scene scene = RandomScene(numbers, true).scene();
  Rod out{scene.rod, scene.state};
  initialise_frames(&out.state);
  const Eigen::Index edges = out.rod.edges(), inner = edges - 1;
  const double a = random_between(-0.5, 0.5), b = random_between(-0.5, 0.5), c = random_between(0.1, 2.0);
  for (Eigen::Index j = 0; j < edges; ++j) out.state.twist[j] = a * std::sin(c * static_cast<double>(j));
  out.state.natural_curvature.resize(2, inner);
  for (Eigen::Index i = 0; i < inner; ++i) {
    out.state.natural_curvature.col(i) << b, a * std::cos(c * static_cast<double>(i));
  }
  return out;
}

/// A mirror turns angles around, and with them m2: of the curvatures on (m1, m2) the second changes its sign.
Rod moved(Rod rod, const Motion& motion) {
  rod.state.position = motion.of(rod.state.position);
  rod.state.reference_director = motion.turn * rod.state.reference_director;
  rod.state.twist *= motion.handedness();
  rod.state.reference_twist *= motion.handedness();
  rod.state.natural_curvature.row(1) *= motion.handedness();
  return rod;
}

/// Tangents turn around, and so do angles about them; twist, which is their change along the rod, does not.
Rod reversed(Rod rod) {
  const Rod before = rod;
  rod.state.position = before.state.position.rowwise().reverse();
  rod.state.reference_director = before.state.reference_director.rowwise().reverse();
  rod.state.twist = -before.state.twist.reverse();
  rod.state.reference_twist = before.state.reference_twist.reverse();
  rod.rod = make_rod(before.rod.material, before.rod.rest_length.reverse());
  rod.state.natural_curvature = before.state.natural_curvature.rowwise().reverse();
  rod.state.natural_curvature.row(1) *= -1.0;
  return rod;
}

void expect_same(const Rod& now, const Rod& then, const Eigen::Matrix4Xd& forces_then, const Motion& motion) {
  near(std::abs(then.energy() - now.energy()), now.energy_error() + then.energy_error(), "energy");
  const Eigen::Matrix4Xd forces = now.forces();
  near((forces_then.topRows<3>() - motion.turn * forces.topRows<3>()).colwise().norm().maxCoeff(),
       now.force_error() + then.force_error(), "force");
  // A torque turns an edge's ends by its length.
  near((forces_then.row(3) - motion.handedness() * forces.row(3)).lpNorm<Eigen::Infinity>(),
       (now.force_error() + then.force_error()) * now.rod.rest_length.maxCoeff(), "torque");
}

RC_GTEST_PROP(ElasticSymmetry, RigidMotion, ()) {
  const Rod rod = random_rod();
  const Motion motion = random_motion(1.0);
  const Rod then = moved(rod, motion);
  expect_same(rod, then, then.forces(), motion);
}

RC_GTEST_PROP(ElasticSymmetry, Mirror, ()) {
  const Rod rod = random_rod();
  Motion motion = random_motion(1.0);
  motion.turn.col(2) *= -1.0;
  const Rod then = moved(rod, motion);
  expect_same(rod, then, then.forces(), motion);
}

RC_GTEST_PROP(ElasticSymmetry, Reversal, ()) {
  const Rod rod = random_rod();
  const Rod then = reversed(rod);
  const Eigen::Matrix4Xd backwards = then.forces();
  Eigen::Matrix4Xd forces = backwards.rowwise().reverse();
  const Eigen::Index edges = rod.rod.edges();
  forces.row(3).head(edges) = -backwards.row(3).head(edges).reverse();
  forces(3, edges) = 0.0;
  expect_same(rod, then, forces, {});
}

/// A rod exerts neither force nor moment on itself; torques about edges are part of the moment.
RC_GTEST_PROP(ElasticSymmetry, ForcesAndMomentsAddUpToNothing, ()) {
  const Rod rod = random_rod();
  const Eigen::Matrix4Xd forces = rod.forces();
  const Points& x = rod.state.position;
  const Vec3 sum = forces.topRows<3>().rowwise().sum();
  Vec3 moment = Vec3::Zero();
  const Points t = tangents(x);
  for (Eigen::Index i = 0; i < x.cols(); ++i) moment += Vec3(x.col(i)).cross(Vec3(forces.col(i).head<3>()));
  for (Eigen::Index j = 0; j < t.cols(); ++j) moment += forces(3, j) * t.col(j);
  const auto nodes = static_cast<double>(x.cols());
  near(sum.norm(), nodes * rod.force_error(), "force");
  near(moment.norm(), nodes * rod.force_error() * x.colwise().norm().maxCoeff(), "moment");
}

}  // namespace
}  // namespace knot_utm::properties
