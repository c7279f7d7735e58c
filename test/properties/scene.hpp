#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/time_step.hpp"

namespace knot_utm::properties {

/// What a few time steps need to know, as plain data: symmetries are functions from a Scene to another one.
struct Scene {
  RodProperties rod;
  RodState state;  ///< frames are initialised where `twist`
  StepSettings settings;
  std::vector<Boundary> boundary;  ///< of each step
  double dt = 0.0;                 ///< [s]
  bool twist = false;
};

/// What came out.
struct Outcome {
  bool accepted = false;  ///< every step
  RodState state;
  Eigen::VectorXd tension, twist;  ///< twist m_i of the inner nodes, empty without
  Points reaction;                 ///< of the held nodes
  Energies energies;
  ContactReading contact;
  StepWork work;
  int iterations = 0, most_iterations = 0;  ///< of all steps, of one
};

inline Outcome run(const Scene& scene) {
  Outcome out;
  RodState state = scene.state;
  if (scene.twist) initialise_frames(&state);
  const auto step = TimeStep::make(scene.rod, state, scene.settings);
  for (const Boundary& boundary : scene.boundary) {
    const StepSummary summary = step->step(boundary, scene.dt);
    out.iterations += summary.newton.iterations;
    out.most_iterations = std::max(out.most_iterations, summary.newton.iterations);
    if (!summary.accepted()) return out;
  }
  out.accepted = true;
  out.state = step->state();
  out.tension = step->tension();
  if (scene.twist) {
    const Eigen::Index inner = scene.rod.nodes() - 2;
    out.twist = out.state.twist.tail(inner) - out.state.twist.head(inner) + out.state.reference_twist;
  }
  const std::vector<FixedNode>& held = scene.boundary.back().fixed_nodes;
  out.reaction.resize(3, static_cast<Eigen::Index>(held.size()));
  for (std::size_t i = 0; i < held.size(); ++i)
    out.reaction.col(static_cast<Eigen::Index>(i)) = step->readings().reaction(held[i].node);
  out.energies = step->readings().energies();
  out.contact = step->readings().contact();
  out.work = step->readings().work();
  return out;
}

/// Two runs of the same physics differ by what Newton's method leaves: forces of up to the residual r at every node.
/// Each step answers with a shift of at most s = sqrt(N) r/(m/dt^2), inertia being the least of what holds a node; a
/// node that was shifted goes on in free flight at worst, so that n steps make s n(n+1)/2 of it, on both sides.
inline double newton_error(const Scene& scene) {
  const auto steps = static_cast<double>(scene.boundary.size()), nodes = static_cast<double>(scene.rod.nodes());
  const double shift = std::sqrt(nodes) * scene.settings.residual * scene.dt * scene.dt / scene.rod.mass.minCoeff();
  return shift * steps * (steps + 1.0);
}

/// A coil whose windings touch, with smooth bumps, pressed together and sliding past itself, a roller beside it: held
/// at one end, pulled at the other one by a force, in its middle by a grip that slips. `numbers` from 0 to 1000 choose
/// all of it.
class RandomScene {
 public:
  static constexpr std::size_t kNumbers = 40;

  RandomScene(const std::vector<int>& numbers, bool twist) : numbers_(numbers) {
    Scene& s = scene_;
    s.twist = twist;
    RodMaterial material;
    material.radius = h_;
    material.density = 1000.0;
    material.bending_stiffness = 1e-4;
    material.twisting_stiffness = 1e-4 * between(0.5, 1.5);
    const double bending_force = material.bending_stiffness / (h_ * h_);
    material.stretching_stiffness = bending_force * between(50.0, 2000.0);
    lay(static_cast<int>(between(30.0, 60.0)));
    Eigen::VectorXd rest(s.state.position.cols() - 1);
    for (Eigen::Index j = 0; j < rest.size(); ++j)
      rest[j] =
          (s.state.position.col(j + 1) - s.state.position.col(j)).norm() * (1.0 - 2e-3 * std::sin(0.3 * double(j)));
    s.rod = make_rod(material, rest);
    const double bending_time = h_ * h_ * std::sqrt(material.density * M_PI * h_ * h_ / material.bending_stiffness);
    s.dt = bending_time * between(0.1, 0.5);
    s.settings.weighting_time = between(1.0, 10.0) * s.dt;
    s.settings.pressure_law = NormalLaw{300.0 * material.bending_stiffness / std::pow(h_, 4), 0.02 * h_, 0.05 * h_};
    s.settings.friction = MemoryFriction{between(0.0, 0.4), 0.02 * h_};
    s.settings.roller_friction = SmoothedFriction{between(0.0, 0.6), 0.02 * h_ / s.dt};
    s.settings.gravity = random_vector() * 0.005 * h_ / (s.dt * s.dt);
    s.settings.drag = between(0.0, 1.0);
    s.settings.residual = 1e-10 * bending_force;
    s.settings.newton_cap = 0.1 * h_;
    s.settings.motion_limit = 0.8 * h_;
    s.settings.overlap_limit = 0.5 * h_;
    s.settings.candidate_margin = 0.5 * h_;
    s.settings.max_iterations = 60;
    surround(4, bending_force);
  }

  const Scene& scene() const { return scene_; }

 private:
  double between(double low, double high) { return low + (high - low) * 1e-3 * numbers_[next_++ % numbers_.size()]; }
  Vec3 random_vector() {
    const double x = between(-1.0, 1.0), y = between(-1.0, 1.0), z = between(-1.0, 1.0);
    return {x, y, z};
  }

  void lay(int nodes) {
    winding_ = between(2.2, 4.0) * h_;
    const double pitch = 2.0 * h_ * between(0.99, 1.0), turn = between(0.7, 1.0) * h_ / winding_;
    Points& x = scene_.state.position;
    Points& v = scene_.state.velocity;
    x.resize(3, nodes);
    v.resize(3, nodes);
    const double flat = between(1.0, 1.3);
    const Vec3 bumps[2] = {random_vector(), random_vector()}, slides[2] = {random_vector(), random_vector()};
    for (Eigen::Index i = 0; i < nodes; ++i) {
      const double angle = turn * static_cast<double>(i);
      const double wave[2] = {std::sin(0.7 * angle), std::cos(1.3 * angle)};
      x.col(i) = Vec3(flat * winding_ * std::cos(angle), winding_ * std::sin(angle), pitch * angle / (2.0 * M_PI));
      v.col(i).setZero();
      for (int k = 0; k < 2; ++k) {
        x.col(i) += 0.005 * h_ * wave[k] * bumps[k];
        v.col(i) += wave[k] * slides[k];
      }
    }
  }

  void surround(int steps, double bending_force) {
    Scene& s = scene_;
    s.state.velocity *= 0.01 * h_ / s.dt;
    const int last = static_cast<int>(s.rod.nodes()) - 1;
    Boundary boundary;
    Roller roller;
    roller.radius = 6.0 * h_;
    roller.axis = Vec3(0.1, 0.2, 1.0).normalized();
    const double angle = between(0.0, 6.0);
    roller.centre = (1.3 * winding_ + roller.radius + 0.995 * h_) * Vec3(std::cos(angle), std::sin(angle), 0.0);
    boundary.rollers = {roller};
    boundary.forces = {{last, 0.2 * bending_force * random_vector()}};
    const double press = bending_force * between(0.03, 0.15);  // its windings onto one another
    for (int i = 0; i <= last; ++i) boundary.forces.push_back({i, Vec3(0.0, 0.0, i < last / 2 ? press : -press)});
    SlippingGrip grip;
    grip.node = last / 2;
    grip.direction = Vec3(1.0, 2.0, -2.0) / 3.0;
    grip.place = grip.direction.dot(s.state.position.col(grip.node)) + 0.01 * h_;
    grip.stiffness = 10.0 * bending_force / h_;
    grip.slip_force = 0.2 * bending_force;
    boundary.grips = {grip};
    const Vec3 way = 0.01 * h_ * random_vector();
    const double turn = between(-0.1, 0.1);
    for (int k = 1; k <= steps; ++k) {
      boundary.rollers[0].centre -= 0.005 * h_ * Vec3(std::cos(angle), std::sin(angle), 0.5);
      boundary.fixed_nodes.clear();
      for (const int node : {0, 1}) boundary.fixed_nodes.push_back({node, s.state.position.col(node) + k * way});
      if (s.twist) boundary.fixed_twists = {{0, k * turn}};
      s.boundary.push_back(boundary);
    }
  }

  const std::vector<int>& numbers_;
  std::size_t next_ = 0;
  double h_ = 3e-3;  // [m]
  double winding_ = 0.0;
  Scene scene_;
};

/// x -> turn x + shift. `turn` is orthogonal; where its determinant is -1 it mirrors, and angles change their sign.
struct Motion {
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();

  Points of(const Points& points) const { return (turn * points).colwise() + shift; }
  double handedness() const { return turn.determinant() < 0.0 ? -1.0 : 1.0; }
};

inline Scene moved(Scene scene, const Motion& motion) {
  scene.state.position = motion.of(scene.state.position);
  scene.state.velocity = motion.turn * scene.state.velocity;
  scene.settings.gravity = motion.turn * scene.settings.gravity;
  for (Boundary& boundary : scene.boundary) {
    for (Roller& roller : boundary.rollers) {
      roller.centre = motion.turn * roller.centre + motion.shift;
      roller.axis = motion.turn * roller.axis;
    }
    for (FixedNode& fixed : boundary.fixed_nodes) fixed.position = motion.turn * fixed.position + motion.shift;
    for (FixedTwist& fixed : boundary.fixed_twists) fixed.angle *= motion.handedness();
    for (NodeForce& force : boundary.forces) force.force = motion.turn * force.force;
    for (SlippingGrip& grip : boundary.grips) {
      grip.direction = motion.turn * grip.direction;
      grip.place += grip.direction.dot(motion.shift);
    }
  }
  return scene;
}

/// The same rod with its nodes counted from the other end.
inline Scene reversed(Scene scene) {
  const int last = static_cast<int>(scene.rod.nodes()) - 1;
  scene.rod = make_rod(scene.rod.material, scene.rod.rest_length.reverse());
  scene.state.position = scene.state.position.rowwise().reverse().eval();
  scene.state.velocity = scene.state.velocity.rowwise().reverse().eval();
  for (Boundary& boundary : scene.boundary) {
    for (FixedNode& fixed : boundary.fixed_nodes) fixed.node = last - fixed.node;
    // Tangents turn around, and angles are counted about them.
    for (FixedTwist& fixed : boundary.fixed_twists) fixed = {last - 1 - fixed.edge, -fixed.angle};
    for (NodeForce& force : boundary.forces) force.node = last - force.node;
    for (SlippingGrip& grip : boundary.grips) grip.node = last - grip.node;
  }
  return scene;
}

/// New units: a length of 1 becomes `length`, a force `force`, a time `time`.
struct Units {
  double length, force, time;

  double mass() const { return force * time * time / length; }
  double stress() const { return force / (length * length); }
  double energy() const { return force * length; }
  double speed() const { return length / time; }
};

inline Friction scaled(const Friction& friction, const Units& units) {
  return friction.visit([&](auto law) {
    if constexpr (std::is_same_v<decltype(law), MemoryFriction>) law.presliding *= units.length;
    if constexpr (std::is_same_v<decltype(law), SmoothedFriction>) law.slip_tolerance *= units.speed();
    return Friction(law);
  });
}

inline Scene scaled(Scene scene, const Units& units) {
  RodMaterial material = scene.rod.material;
  material.radius *= units.length;
  material.density *= units.mass() / (units.length * units.length * units.length);
  material.stretching_stiffness *= units.force;
  material.bending_stiffness *= units.force * units.length * units.length;
  material.twisting_stiffness *= units.force * units.length * units.length;
  scene.rod = make_rod(material, units.length * scene.rod.rest_length);
  scene.state.position *= units.length;
  scene.state.velocity *= units.speed();
  scene.dt *= units.time;
  StepSettings& settings = scene.settings;
  auto& normal = settings.pressure_law;
  normal.stiffness *= units.stress();
  normal.tolerance *= units.length;
  normal.stiffening *= units.length;
  settings.friction = scaled(settings.friction, units);
  settings.roller_friction = scaled(settings.roller_friction, units);
  settings.weighting_time *= units.time;
  settings.gravity *= units.speed() / units.time;
  settings.drag *= units.stress() * units.time;
  settings.residual *= units.force;
  settings.residual_from_step *= units.time;
  settings.newton_cap *= units.length;
  settings.motion_limit *= units.length;
  settings.overlap_limit *= units.length;
  settings.candidate_margin *= units.length;
  for (Boundary& boundary : scene.boundary) {
    boundary.extra_drag *= units.stress() * units.time;
    for (Roller& roller : boundary.rollers) {
      roller.centre *= units.length;
      roller.radius *= units.length;
    }
    for (FixedNode& fixed : boundary.fixed_nodes) fixed.position *= units.length;
    for (NodeForce& force : boundary.forces) force.force *= units.force;
    for (SlippingGrip& grip : boundary.grips) {
      grip.place *= units.length;
      grip.stiffness *= units.force / units.length;
      grip.slip_force *= units.force;
    }
  }
  return scene;
}

}  // namespace knot_utm::properties
