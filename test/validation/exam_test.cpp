// X1 to X15: scenes of cosseratbench, a public bench of rod codes, by its numbers and with its right values. X15 is of
// its findings. bench/exam.yaml has the results of other codes.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "knot_utm/rod/frames.hpp"
#include "reference.hpp"
#include "rod/static_rod.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr double kGravity = 9.81;
const Vec3 kDown = -kGravity * Vec3::UnitZ();

/// A round rod of one solid of 1000 kg/m^3, with a Poisson's ratio of 1/2.
RodMaterial solid(double radius, double youngs_modulus) {
  RodMaterial out;
  out.radius = radius;
  out.density = 1000.0;
  out.stretching_stiffness = youngs_modulus * M_PI * radius * radius;
  out.bending_stiffness = 0.25 * out.stretching_stiffness * radius * radius;
  out.twisting_stiffness = 2.0 / 3.0 * out.bending_stiffness;
  return out;
}

struct Scene {
  RodProperties rod;
  RodState state;
  StepSettings settings;
  Boundary boundary;
  std::unique_ptr<TimeStep> step;
  double time = 0.0;

  Scene(const RodMaterial& material, const Points& position, const Eigen::VectorXd& rest_length, const Vec3& gravity,
        double drag, const std::vector<int>& held, const std::vector<int>& cuts = {})
      : rod(make_rod(material, rest_length, cuts)), settings(closed_form_settings(material)) {
    state.position = position;
    state.velocity = Points::Zero(3, position.cols());
    settings.gravity = gravity;
    settings.drag = drag;
    settings.residual = 1e-10;
    settings.newton_cap = settings.motion_limit = 10.0;
    for (const int node : held) boundary.fixed_nodes.push_back({node, position.col(node)});
  }

  /// `before`: sets the boundary at the end of a step.
  void run(double until, double longest, double motion = 0.1, const std::function<void(double)>& before = {}) {
    if (!step) step = TimeStep::make(rod, state, settings);
    StepControl::Options options;
    options.longest = options.first = longest;
    options.motion = motion;
    run_to(until, *step, time, options, [&](double to) -> const Boundary& {
      if (before) before(to);
      return boundary;
    });
  }
  const Points& x() const { return step->state().position; }
};

/// Rest lengths of a rod of 1 m.
Eigen::VectorXd even(int edges) { return Eigen::VectorXd::Constant(edges, 1.0 / edges); }

/// An arc of 1 m over a chord of 0.8 m along `along`, which hangs below it; its middle lies on the z axis.
Points hanging_arc(int edges, const Vec3& along, double height) {
  constexpr double kHalf = 1.1311021;  // sin a = 0.8 a
  Points x(3, edges + 1);
  for (int i = 0; i <= edges; ++i) {
    const double angle = kHalf * (2.0 * i / edges - 1.0), up = std::cos(kHalf) - std::cos(angle);
    x.col(i) = 0.5 / kHalf * (std::sin(angle) * along + up * Vec3::UnitZ()) + height * Vec3::UnitZ();
  }
  return x;
}

/// Where `holds` turns false in (low, high), to `share` of it.
double onset(double low, double high, double share, const std::function<bool(double)>& holds) {
  while (high - low > share * high) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

TEST(X1_Twist, AStretchedClampedRodBucklesAtGreenhillsTwist) {
  // M L/B of B w'''' - i M w''' - T w'' = 0, clamped at both ends, with T L^2/B = 10 (own solution).
  constexpr double kGreenhill = 10.428856439, kTension = 10.0, kStretching = 4e4, kTwisting = 2.0 / 3.0;
  for (const auto& [edges, gate] : {std::pair(25, 0.02), {50, 0.005}, {100, 0.005}}) {
    const double l = 1.0 / (edges - 1);
    const double critical = onset(0.8, 1.2, 1e-6, [&, n = edges](double share) {
      StaticRod rod(unit_rod(n, l, kStretching, kTwisting), straight_line(n, l * (1.0 + kTension / kStretching)),
                    StaticRod::Path::kIsotropicTwist);
      rod.load()[StaticRod::x(n)] = kTension;
      for (int j = 0; j < n; ++j) rod.state().twist[j] = share * kGreenhill / kTwisting * l * j;
      rod.hold_node(0);
      for (const int node : {1, n - 1, n})
        for (const int axis : {1, 2}) rod.hold(StaticRod::x(node, axis));
      for (const int edge : {0, n - 1}) rod.hold(StaticRod::theta(edge));
      return rod.unstable_modes() == 0;
    });
    hold_against(formatted("X1 twist, %d edges: critical twist over Greenhill's", edges), 1.0, critical, gate);
  }
}

TEST(X3_Catenary, HangsAsTheElasticCatenary) {
  Scene scene(solid(5e-3, 1e6), hanging_arc(50, Vec3::UnitX(), 0.0), even(50), kDown, 1.0, {0, 50});
  scene.run(100.0, 2.0);
  hold_against("X3 catenary: sag [m]", 0.26868412256, -scene.x().row(2).minCoeff(), 5e-4);
}

TEST(X4_Cantilever, BendsUnderALittleLoadAsABeam) {
  constexpr int kEdges = 20;
  constexpr double kForce = 7.5e-3, l = 1.0 / (kEdges - 0.5);  // clamped in the middle of its first edge
  const RodMaterial material = solid(0.02, 1e6);
  Scene scene(material, straight_line(kEdges, l), Eigen::VectorXd::Constant(kEdges, l), Vec3::Zero(), 1.0, {0, 1});
  scene.boundary.forces = {{kEdges, -kForce * Vec3::UnitZ()}};
  scene.run(100.0, 2.0);
  hold_against("X4 cantilever: deflection of its tip [m]", kForce / (3.0 * material.bending_stiffness),
               -scene.x()(2, kEdges), 0.005);
}

/// A cable of 1 m that hangs from a pin swings in its first mode for 5 s, with 2 cm at its tip: its period [s], and the
/// amplitude of its last half period over that of the first.
std::pair<double, double> swing(double dt) {
  constexpr int kEdges = 50;
  Points x = Points::Zero(3, kEdges + 1);
  Eigen::VectorXd mode(kEdges + 1);  // of a chain without bending stiffness
  for (int i = 0; i <= kEdges; ++i) {
    const double s = static_cast<double>(i) / kEdges;
    mode[i] = std::cyl_bessel_j(0.0, 2.404825557695773 * std::sqrt(1.0 - s));
    x.col(i) = Vec3(0.02 * mode[i], 0.0, -s - 1000.0 * kGravity / 1e7 * (s - 0.5 * s * s));
  }
  Scene scene(solid(2e-3, 1e7), x, even(kEdges), kDown, 0.0, {0});
  scene.step = TimeStep::make(scene.rod, scene.state, scene.settings);
  // The share of that mode in the motion crosses zero twice a period.
  const Eigen::VectorXd weights = scene.rod.mass.cwiseProduct(mode);
  std::vector<double> crossed, largest{0.0};
  double before = x.row(0) * weights;
  for (int i = 1; i * dt <= 5.0; ++i) {
    if (!scene.step->step(scene.boundary, dt).accepted()) throw std::runtime_error("X5: a step was not accepted");
    const double now = scene.x().row(0) * weights;
    if (now * before < 0.0) {
      crossed.push_back(dt * (i - now / (now - before)));
      largest.push_back(0.0);
    }
    largest.back() = std::max(largest.back(), std::abs(now));
    before = now;
  }
  const std::size_t last = crossed.size() - 1;
  return {2.0 * (crossed[last] - crossed[0]) / static_cast<double>(last), largest[last] / largest[1]};
}

TEST(X5_Pendulum, SwingsInItsFirstMode) {
  const auto [period, amplitude] = swing(1e-4);
  // Of (EI u'')'' - (T/(1 + T/EA) u')' = rho A omega^2 u (own solution).
  hold_against("X5 pendulum: period [s]", 1.66767229563, period, 3e-4);
  hold_against("X5 pendulum, steps of 0.1 ms: amplitude kept", 1.0, amplitude, 3e-3);
  hold_against("X5 pendulum, steps to none: amplitude kept", 1.0, 2.0 * amplitude - swing(2e-4).second, 1e-4);
}

constexpr double kMu = 0.3, kLight = 0.15, kRope = 1e-3, kRadius = 0.05 + kRope;  // of the capstan's centreline

/// A rope over a cylinder of 5 cm, which hangs by kLight on one side and by `heavy` on the other one, and begins
/// stretched as it hangs: by how much the light end rises within 2 s [m], up to 0.1.
double slide(double heavy) {
  constexpr int kEdges = 100;
  constexpr double kStrain = 1000.0 * kGravity / 3e5;  // by a metre of rope below [1/m]
  const auto drawn = [](double length) { return length + 0.5 * kStrain * length * length; };
  const double left = drawn(kLight), arc = M_PI * kRadius, whole = left + arc + drawn(heavy), gap = whole / kEdges;
  Points x = Points::Zero(3, kEdges + 1);
  Eigen::VectorXd rest(kEdges);
  for (int i = 0; i <= kEdges; ++i) {
    const double s = gap * i, phi = (s - left) / kRadius, out = kRadius / std::cos(0.5 * gap / kRadius);
    x.col(i) = s < left         ? Vec3(-kRadius, 0.0, s - left)
               : s > left + arc ? Vec3(kRadius, 0.0, left + arc - s)
                                : Vec3(-out * std::cos(phi), 0.0, out * std::sin(phi));
    if (i == 0) continue;
    const double middle = s - 0.5 * gap, wrapped = std::clamp((middle - left) / arc, 0.0, 1.0);
    const double on_cylinder = kLight * std::pow(heavy / kLight, wrapped);
    const double below = middle < left ? middle : std::min(whole - middle, on_cylinder);
    rest[i - 1] = (x.col(i) - x.col(i - 1)).norm() / (1.0 + kStrain * below);
  }
  Scene scene(solid(kRope, 3e5), x, rest, kDown, 0.01, {});
  scene.settings.roller_friction = MemoryFriction{kMu, 1e-3 * kRope};
  scene.settings.overlap_limit = kRope;
  scene.boundary.rollers = {Roller{Vec3::Zero(), Vec3::UnitY(), kRadius - kRope}};
  double out = 0.0;
  while (scene.time < 2.0 && out < 0.1) {
    scene.run(scene.time + 0.05, 1e-3, 2e-3);
    out = std::max(out, scene.x()(2, 0) - x(2, 0));
  }
  return out;
}

TEST(X7_Capstan, ARopeOverACylinderHoldsByItsOwnWeightToo) {
  // The longest overhang that holds, by dT/dphi = mu T + w R (cos phi + mu sin phi).
  const double grown = std::exp(kMu * M_PI), plain = grown * kLight;
  const double right = plain + 2.0 * kMu * kRadius / (1.0 + kMu * kMu) * (grown + 1.0);
  for (const double share : {0.8, 0.95})
    hold_below(formatted("X7 capstan, %g of what holds: way in 2 s [mm]", share), 0.5, 1e3 * slide(share * right));
  const double ours = right * onset(0.95, 1.05, 1e-3, [&](double share) { return slide(share * right) < 5e-3; });
  hold_against("X7 capstan: overhang that holds, over the plain capstan's", right / plain, ours / plain, 0.02);
}

/// Two ropes cross at right angles without friction. The lower one's pins are raised until the upper one rests on it.
TEST(X10_Crossing, ARopeThatRestsOnAnotherIsLiftedByTheForceOfTheElastica) {
  constexpr double kFree = -0.26858131878, kDrop = 0.1;  // of a rope that hangs alone, and of the upper rope's pins
  const RodMaterial material = solid(5e-3, 1e6);
  const double h = material.radius, low = 2.0 * kDrop;
  // Edges of 200 to a rope are as long as its radius; of 50, four times that.
  for (const auto& [edges, gate] : {std::pair(50, 0.02), {51, 0.02}, {200, 0.002}, {201, 0.002}}) {
    const int upper = edges + 1, last = upper + edges;
    Points x(3, last + 1);
    x << hanging_arc(edges, Vec3::UnitX(), -low), hanging_arc(edges, Vec3::UnitY(), -kDrop);
    for (int i = 1; i < edges; ++i) x(1, i) += 1e-3 * std::sin(M_PI * i / edges);  // out of its plane
    Scene scene(material, x, Eigen::VectorXd::Constant(last, 1.0 / edges), kDown, 1.0, {0, edges, upper, last},
                {edges});
    scene.settings.pressure_law = {75.0 * material.stretching_stiffness / (h * h), 5e-3 * h};  // that of a method
    scene.settings.motion_limit = 0.8 * h;
    scene.run(60.0, 0.1, 0.4 * h, [&](double to) {
      for (FixedNode* pin : {&scene.boundary.fixed_nodes[0], &scene.boundary.fixed_nodes[1]})
        pin->position.z() = -low * (1.0 - std::clamp((to - 5.0) / 10.0, 0.0, 1.0));
    });
    double force = 0.5 * scene.rod.mass.sum() * kGravity;
    for (const int pin : {upper, last}) force -= scene.step->readings().reaction(pin).z();
    const double lift = scene.x()(2, upper + upper / 2) + kDrop - kFree;
    const double aside = scene.x().leftCols(upper).row(1).cwiseAbs().maxCoeff();
    const std::string what = formatted("X10 crossing, %d edges: ", edges);
    // Two planar elasticas of the same material, pressed apart to one diameter (own solution).
    hold_against(what + "force between the ropes [N]", 0.26679307756, force, gate);
    hold_against(what + "lift of the upper rope [m]", 0.09066591446, lift, gate);
    hold_below(what + "way of the lower rope to its side [mm]", 1e-3, 1e3 * aside);
  }
}

TEST(X15_Start, StraightAndThenCurvedSpringsStraightAndFallsByG) {
  // Without stress where straight: half of it is straight as it begins, the other half an arc. With frames.
  Points x = Points::Zero(3, 51);
  for (int i = 1; i <= 50; ++i) {
    const double angle = std::max(0.0, 0.1 * (i - 0.5) - 2.5);
    x.col(i) = x.col(i - 1) + 0.02 * Vec3(std::cos(angle), std::sin(angle), 0.0);
  }
  const auto fallen = [&](double drag, double until, double longest) {
    Scene scene(solid(5e-3, 1e6), x, even(50), kDown, drag, {});
    initialise_frames(&scene.state);
    scene.run(until, longest);
    return scene;
  };
  const Scene free = fallen(0.0, 0.5, 1e-4), damped = fallen(1.0, 50.0, 0.1);
  const auto centre = [&](const Points& of_nodes) { return -of_nodes.row(2).dot(free.rod.mass) / free.rod.mass.sum(); };
  hold_against("X15 free fall: way in 0.5 s [m]", 0.125 * kGravity, centre(free.x()), 1e-3);
  hold_against("X15 damped fall: speed [m/s]", free.rod.mass.sum() * kGravity, centre(damped.step->state().velocity),
               1e-6);
  hold_against("X15 start straight and then curved: distance of the ends once straight [m]", 1.0,
               (damped.x().rightCols<1>() - damped.x().leftCols<1>()).norm(), 1e-4);
}

}  // namespace
}  // namespace knot_utm
