// Closed forms of friction at the surface of strands that roll and twist.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <vector>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/neo_hookean_stretching.hpp"
#include "knot_utm/rod/rod.hpp"
#include "reference.hpp"
#include "rod/own_laws.hpp"
#include "sim/capstan.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr double kGravity = OnAnIncline::kGravity;

/// Runs a scene in steps of at most `longest` [s]; `boundary(to)` stands at the end of a step.
template <typename BoundaryAt>
void run(TimeStep& stepper, double from, double to, double longest, BoundaryAt boundary) {
  StepControl::Options options;
  options.longest = options.first = longest;
  options.motion = options.slip = 1e3;
  run_to(to, stepper, from, options, boundary);
}

// ---- R12 ------------------------------------------------------------------------------------------------------------

constexpr double kMu = 0.3;

/// A straight rod along x lies on a plane that falls towards +y by `angle`.
struct AcrossAnIncline : OnAnIncline {
  double radius = material.radius;
  std::unique_ptr<TimeStep> stepper;

  AcrossAnIncline(double angle, bool spin_inertia, double rolling_resistance = 0.0, double growth = 0.0, int edges = 16)
      : OnAnIncline(angle, Vec3::UnitY(), edges, MemoryFriction{kMu, 1e-4 * braided_rope().radius}) {
    settings.friction_couple = 1.0;
    settings.rolling = {rolling_resistance, radius, 1e-4 * radius, growth};
    settings.spin_inertia = spin_inertia;
    initialise_frames(&state);
    stepper = TimeStep::make(rod, state, settings);
  }

  /// Between two times: means of the accelerations down the plane and of the spin.
  std::pair<double, double> accelerations() {
    const auto at = [this](double) -> const Boundary& { return boundary; };
    run(*stepper, 0.0, 0.1, 2e-3, at);
    const double speed = stepper->state().velocity.row(1).mean(), rate = stepper->state().twist_rate.mean();
    run(*stepper, 0.1, 0.4, 2e-3, at);
    return {(stepper->state().velocity.row(1).mean() - speed) / 0.3, (stepper->state().twist_rate.mean() - rate) / 0.3};
  }
};

TEST(R12Rolling, ACylinderRollsAcrossAnInclineAtTwoThirds) {
  for (const double angle : {0.1, 0.5, 0.95 * std::atan(3.0 * kMu)}) {
    AcrossAnIncline scene(angle, true);
    const auto [down, spin] = scene.accelerations();
    const double expected = 2.0 / 3.0 * kGravity * std::sin(angle);
    hold_against(formatted("R12 rolling across an incline of %.2f: acceleration [m/s^2]", angle), expected, down, 0.01);
    EXPECT_NEAR(std::abs(spin) * scene.radius, expected, 0.01 * expected) << "it rolls";
  }
}

/// The couple mu_r h N holds it up to a slope of mu_r. Beyond, m a = m g sin - F and 1/2 m h a = F h - mu_r h N.
TEST(R12Rolling, ResistanceHoldsACylinderAndThenSlowsIt) {
  constexpr double kResistance = 0.1;
  AcrossAnIncline held(std::atan(0.95 * kResistance), true, kResistance);
  EXPECT_LT(std::abs(held.accelerations().first), 1e-5 * kGravity);
  for (const double slope : {1.05, 3.0}) {
    const double angle = std::atan(slope * kResistance);
    AcrossAnIncline scene(angle, true, kResistance);
    const auto [down, spin] = scene.accelerations();
    const double expected = 2.0 / 3.0 * kGravity * (std::sin(angle) - kResistance * std::cos(angle));
    hold_against(formatted("R12 rolling against resistance, tan alpha/mu_r = %.2f: acceleration [m/s^2]", slope),
                 expected, down, 0.01);
    EXPECT_NEAR(std::abs(spin) * scene.radius, expected, 0.01 * expected) << "it rolls";
  }
}

/// A soft cylinder whose contact, of half width a, loses the fraction alpha of the work that goes into it: it rests up
/// to the slope alpha 2 a/(3 pi h). a is Hertz's, of two like cylinders side by side under their weight per length.
TEST(R12Rolling, HysteresisOfAWideContactHoldsACylinderUpToItsHalfWidth) {
  constexpr double kAlpha = 0.5, kModulus = 5e3, kPoisson = 0.5;  // [-, Pa, -]
  const Material rope = braided_rope();
  const double h = rope.radius, growth = RollingResistance::growth_of_hysteresis(kAlpha, h, M_PI * h * h * kModulus);
  const auto slope = [&](double angle) {
    const double load = rope.density * M_PI * h * h * kGravity * std::cos(angle);
    const double reduced = kModulus / (2.0 * (1.0 - kPoisson * kPoisson));
    return kAlpha * 2.0 * std::sqrt(4.0 * load * (0.5 * h) / (M_PI * reduced)) / (3.0 * M_PI * h);
  };
  const double steepest = std::atan(slope(0.0));
  ASSERT_GT(steepest, 0.01);
  // The last half edge on either side has no contact, so that the others bear 1/kEdges more load, and resist more.
  constexpr int kEdges = 256;
  AcrossAnIncline held(0.95 * steepest, true, 0.0, growth, kEdges);
  EXPECT_LT(std::abs(held.accelerations().first), 1e-5 * kGravity);
  for (const double angle : {1.5 * steepest, 4.0 * steepest}) {
    AcrossAnIncline scene(angle, true, 0.0, growth, kEdges);
    const double expected = 2.0 / 3.0 * kGravity * (std::sin(angle) - slope(angle) * std::cos(angle));
    hold_against(formatted("R12 rolling against hysteresis, slope %.4f: acceleration [m/s^2]", std::tan(angle)),
                 expected, scene.accelerations().first, 0.01);
  }
}

TEST(R12Rolling, BeyondThreeTimesTheFrictionAngleItSlidesAndSpinsUp) {
  const double angle = 1.05 * std::atan(3.0 * kMu);
  AcrossAnIncline scene(angle, true);
  const auto [down, spin] = scene.accelerations();
  hold_against("R12 beyond: acceleration [m/s^2]", kGravity * (std::sin(angle) - kMu * std::cos(angle)), down, 0.01);
  hold_against("R12 beyond: spin [1/s^2]", 2.0 * kMu * kGravity * std::cos(angle) / scene.radius, std::abs(spin), 0.01);
}

// ---- R14 ------------------------------------------------------------------------------------------------------------

/// Two strands of one rod cross at right angles, the first above the second one, pressed together by what they
/// overlap; all nodes are held. The first is dragged along itself. The second one's edges are kept from turning at
/// distance l on both sides, and free to spin between.
struct CrossedRods {
  static constexpr int kHalf = 160;              // edges from the crossing to where a strand is kept
  static constexpr int kStrand = 2 * kHalf + 1;  // edges of a strand, the crossing in the middle of one
  static constexpr double kRadius = 3e-3, kEdge = 0.1 * kRadius, kPresliding = 1e-3 * kRadius, kFriction = 0.5;
  static constexpr double kSpeed = 1e-4;
  RodProperties rod;
  Boundary boundary;
  std::unique_ptr<TimeStep> stepper;
  Points begin;

  explicit CrossedRods(double couple, double rolling_resistance = 0.0) {
    Material material;
    material.radius = kRadius;
    material.density = 1000.0;
    material.stretching_stiffness = 1e-3;  // what joins the strands pulls at neither
    material.bending_stiffness = 1e-12;
    material.twisting_stiffness = 2e-5;
    const int nodes = 2 * (kStrand + 1) + 2;
    StepSettings settings = closed_form_settings(material);
    settings.pressure_law = NormalLaw{1e5, 0.005 * kRadius};
    settings.friction = MemoryFriction{kFriction, kPresliding};
    settings.friction_couple = couple;
    settings.rolling = {rolling_resistance, kRadius, kPresliding};
    settings.spin_inertia = false;
    RodState state;
    state.position.resize(3, nodes);
    const double height = 2.0 * lever();
    for (int i = 0; i <= kStrand; ++i) {
      const double s = kEdge * (i - 0.5 * kStrand);
      state.position.col(i) << s, 0.0, height;
      state.position.col(kStrand + 3 + i) << 0.0, s, 0.0;
    }
    state.position.col(kStrand + 1) << 1.0, 0.0, 1.0;
    state.position.col(kStrand + 2) << 1.0, -1.0, 1.0;
    state.velocity = Points::Zero(3, nodes);
    initialise_frames(&state);
    begin = state.position;
    const Points edges = begin.rightCols(nodes - 1) - begin.leftCols(nodes - 1);
    rod = make_rod(material, edges.colwise().norm().transpose());
    stepper = TimeStep::make(rod, state, settings);
    for (int i = 0; i < nodes; ++i) boundary.fixed_nodes.push_back({i, begin.col(i)});
    const int crossing = kStrand + 3 + kHalf;
    for (int j = 0; j < nodes - 1; ++j)
      if (std::abs(j - crossing) >= kHalf) boundary.fixed_twists.push_back({j, 0.0});
  }

  double free_length() const { return kHalf * kEdge; }
  /// The strands' surfaces meet half way between the centrelines; pressed so far that the patch has many points.
  static double lever() { return 0.99 * kRadius; }
  /// Drags the first strand to `way` from where it began, in as many steps; force along it [N].
  double force_at(double from, double way, int steps) {
    run(*stepper, from / kSpeed, way / kSpeed, (way - from) / kSpeed / steps, [&](double to) -> const Boundary& {
      for (int i = 0; i <= kStrand; ++i)
        boundary.fixed_nodes[static_cast<std::size_t>(i)].position[0] = begin(0, i) + kSpeed * to;
      return boundary;
    });
    double force = 0.0;
    for (int i = 0; i <= kStrand; ++i) force += stepper->readings().reaction(i)[0];
    return force;
  }
};

TEST(R14CrossedRods, RollElasticallyThenSlip) {
  CrossedRods scene(1.0);
  const double pressed = [&] {
    scene.force_at(0.0, 1e-9, 1);
    return scene.stepper->readings().contact().normal_force;
  }();
  const double h = CrossedRods::lever(), limit = CrossedRods::kFriction * pressed;
  const double roll = 2.0 * scene.rod.material.twisting_stiffness / (scene.free_length() * h * h);
  const double sticks = limit / CrossedRods::kPresliding;
  const double together = 1.0 / (1.0 / roll + 1.0 / sticks), slips_at = limit / together;
  ASSERT_GT(slips_at, 5.0 * CrossedRods::kPresliding) << "it should roll, not only stick";
  const double half = scene.force_at(1e-9, 0.5 * slips_at, 20);
  hold_against("R14 crossed rods: stiffness while they roll [N/m]", together, half / (0.5 * slips_at), 0.02);
  const double before = scene.force_at(0.5 * slips_at, 0.97 * slips_at, 20);
  EXPECT_NEAR(before, 0.97 * limit, 0.02 * limit);
  const double beyond = scene.force_at(0.97 * slips_at, 1.5 * slips_at, 20);
  hold_against("R14 crossed rods: force as they slip [N]", limit, beyond, 0.02);
}

/// The rod that is not dragged rests until friction's couple F lambda passes mu_r N h/2, and its turn phi gives way to
/// what is beyond: F lambda - mu_r N h/2 = 2 k_t phi/l, with lambda half of the centrelines' distance. It is half of
/// N, since each strand resists about its own line, at its own points, and where strands cross they bear half of it.
TEST(R14CrossedRods, RestUntilResistanceToRollingIsOvercome) {
  constexpr double kRolling = 0.2;
  CrossedRods scene(1.0, kRolling);
  scene.force_at(0.0, 1e-9, 1);
  const double pressed = scene.stepper->readings().contact().normal_force, h = CrossedRods::lever();
  const double roll = 2.0 * scene.rod.material.twisting_stiffness / (scene.free_length() * h * h);
  const double sticks = CrossedRods::kFriction * pressed / CrossedRods::kPresliding;
  const double held = 0.5 * kRolling * pressed * CrossedRods::kRadius / h, limit = CrossedRods::kFriction * pressed;
  const double force = 0.5 * (held + limit), way = force / sticks + (force - held) / roll;
  ASSERT_GT((force - held) / roll, 3.0 * CrossedRods::kPresliding) << "it should roll further than both springs give";
  hold_against("R14 crossed rods that resist rolling: force while they roll [N]", force, scene.force_at(1e-9, way, 20),
               0.02);
  const double slips_at = limit / sticks + (limit - held) / roll;
  hold_against("R14 crossed rods that resist rolling: force as they slip [N]", limit,
               scene.force_at(way, 1.5 * slips_at, 20), 0.02);
}

// ---- R15 ------------------------------------------------------------------------------------------------------------

/// A limp rod over nine tenths of a half turn of a fixed shaft along x, in the plane of y and z; its centreline runs
/// at rho = 1, its radius is eta. T1 is a dead load on the first node; the last one is pulled along its tail.
struct SurfaceCapstan {
  static constexpr double kSpeed = 0.1, kWrap = 0.9 * M_PI, kFriction = 0.46;
  Boundary boundary;
  std::unique_ptr<TimeStep> stepper;
  Vec3 pull;
  double edge, settles_by = 0.5;
  int last = 0;
  double time = 0.0;

  /// Of a solid rod of rubber, whose section gives by its own modulus.
  static constexpr double kRubber = -1.0;

  /// `flattened`: by how much of eta T1 presses it against the shaft; 0: hardly, with a section that keeps its shape.
  SurfaceCapstan(double eta, double t1, double edges_a_radian, double rolling_resistance = 0.0, double flattened = 0.0,
                 double wrap = kWrap) {
    edge = 1.0 / edges_a_radian;
    const double tail = 1.5 + 7.0 / std::sqrt(t1);
    const int tails = static_cast<int>(std::ceil(tail / edge)), wrapped = static_cast<int>(std::lround(wrap / edge));
    last = 2 * tails + wrapped;
    Material material;
    material.radius = eta;
    const bool swings = t1 < 100.0;  // for long, on its tails, unless it is light and dragged
    material.density = swings ? 1e-3 : 1.0;
    material.bending_stiffness = 1.0;
    material.twisting_stiffness = 1.0;
    material.stretching_stiffness = 1e4 * t1;
    if (flattened != 0.0) material.section = CrossSection::kSoft;
    if (flattened == kRubber) {
      material.stretching_stiffness = 4.0 / (eta * eta);
      settles_by += 4.0 * tail * t1 / material.stretching_stiffness;
    }
    RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(last, edge));
    if (flattened == kRubber) set_law(rod, StretchingLaws(NeoHookeanStretching()));
    const double half = 0.5 * wrap;
    const auto place = [&](double angle) { return Vec3(0.0, std::sin(angle), std::cos(angle)); };
    const auto along = [&](double angle) { return Vec3(0.0, std::cos(angle), -std::sin(angle)); };
    RodState state;
    state.position.resize(3, last + 1);
    state.velocity = Points::Zero(3, last + 1);
    for (int i = 0; i <= last; ++i) {
      const double s = edge * i - 0.5 * edge * last;
      state.position.col(i) = s < -half  ? Vec3(place(-half) + (s + half) * along(-half))
                              : s > half ? Vec3(place(half) + (s - half) * along(half))
                                         : place(s);
    }
    pull = along(half);
    initialise_frames(&state);
    StepSettings settings = capstan_settings(material, t1, 1e-3, 1e-7);
    settings.roller_friction = MemoryFriction{kFriction, 1e-3};
    settings.friction_couple = 1.0;
    settings.rolling = {rolling_resistance, eta, 1e-3};
    settings.overlap_limit = flattened == kRubber ? kDeepestSoft * eta : 0.05 + 2.0 * flattened * eta;
    // Of a law that goes with the fifth power, so that the overlap hardly changes along the wrap.
    if (flattened > 0.0)
      settings.pressure_law = NormalLaw{0.5e-4 * t1 / (flattened * eta), 1e-3, 0.2 * flattened * eta};
    if (flattened == kRubber)
      settings.pressure_law =
          NormalLaw{0.77 * material.stretching_stiffness / (M_PI * eta * eta), 0.01 * eta, 0.8 * eta};
    settings.spin_inertia = false;
    if (swings) settings.drag = 1e-3 * t1;
    stepper = TimeStep::make(rod, state, settings);
    Roller roller;
    roller.axis = Vec3::UnitX();
    roller.radius = 1.0 - eta;
    boundary.rollers = {roller};
    boundary.forces = {{0, -t1 * along(-half)}};
    boundary.fixed_nodes = {{last, state.position.col(last)}};
  }

  void pull_by(double way) {
    const Vec3 from = boundary.fixed_nodes[0].position;
    const double begin = time;
    run(*stepper, begin, begin + way / kSpeed, 0.2 * edge / kSpeed, [&](double to) -> const Boundary& {
      boundary.fixed_nodes[0].position = from + kSpeed * (to - begin) * pull;
      return boundary;
    });
    time = begin + way / kSpeed;
  }

  /// Mean of what `read()` gives at eight places while the rod slides by the length of an edge, once it slides.
  template <typename Read>
  double mean(Read read) {
    constexpr int kReadings = 8;
    pull_by(settles_by);
    double sum = 0.0;
    for (int reading = 0; reading < kReadings; ++reading) {
      pull_by(edge / kReadings);
      sum += read();
    }
    return sum / kReadings;
  }

  /// x of T ~ e^{x phi} inside the wrap, by least squares over its middle 1.8 radians.
  double exponent() {
    return mean([this] {
      const Eigen::VectorXd tension = stepper->tension();
      double n = 0.0, a = 0.0, aa = 0.0, t = 0.0, at = 0.0;
      for (int j = 0; j < last; ++j) {
        const Vec3 middle = 0.5 * (stepper->state().position.col(j) + stepper->state().position.col(j + 1));
        const double angle = std::atan2(middle[1], middle[2]), l = std::log(tension[j]);
        if (middle.norm() > 1.1 || std::abs(angle) > 0.9) continue;
        n += 1.0;
        a += angle;
        aa += angle * angle;
        t += l;
        at += angle * l;
      }
      return (n * at - a * t) / (n * aa - a * a);
    });
  }
  /// T2/T1
  double ratio() {
    return mean([this] { return stepper->readings().reaction(last).norm() / boundary.forces[0].force.norm(); });
  }
};

TEST(R15Capstan, TensionGrowsByTheLeverOfTheSurface) {
  for (const double eta : {0.1, 0.25, 0.5, 0.7}) {
    SurfaceCapstan scene(eta, 3e4, 32.0);
    hold_against(formatted("R15 capstan at the surface, h/rho = %.2f: exponent per radian", eta),
                 surface_exponent(SurfaceCapstan::kFriction, eta), scene.exponent(), 0.02);
  }
}

/// A rod that slides around the shaft rolls over nothing: its sections turn about the shaft's axis, and the contact
/// stays where it is. A resistance about all axes would raise the exponent from 0.219 to 0.46.
TEST(R15Capstan, DoesNotDependOnResistanceToRolling) {
  constexpr double kEta = 0.5, kSlips = SurfaceCapstan::kFriction;
  const double without = SurfaceCapstan(kEta, 3e4, 32.0).exponent();
  for (const double rolling : {0.3, kSlips}) {
    const double with = SurfaceCapstan(kEta, 3e4, 32.0, rolling).exponent();
    hold_against(formatted("R15 capstan that resists rolling by %.2f: exponent per radian", rolling),
                 surface_exponent(kSlips, kEta), with, 0.02);
    EXPECT_NEAR(with, without, 0.01 * without);
  }
}

/// A section that is flattened by D touches nearer to its middle, at eta = (rho - R)/rho. A strand that slides on is
/// flattened further as its tension grows, D as T^1/5 by this law, which takes p D': mu eta x^2 + (1 - D/(5 rho)) x =
/// f.
TEST(R15Capstan, TensionGrowsByTheShorterLeverOfAFlattenedSection) {
  constexpr double kEta = 0.5, kShaft = 1.0 - kEta;
  SurfaceCapstan scene(kEta, 3e4, 32.0, 0.0, 0.2);
  const double exponent = scene.exponent();
  double sum = 0.0, n = 0.0;
  for (int i = 0; i <= scene.last; ++i) {
    const Vec3 place = scene.stepper->state().position.col(i);
    if (place.norm() > 1.1 || std::abs(std::atan2(place[1], place[2])) > 0.9) continue;
    sum += place.norm();
    n += 1.0;
  }
  const double rho = sum / n;
  EXPECT_LT(rho, 1.0 - 0.15 * kEta);
  const double lever = SurfaceCapstan::kFriction * (rho - kShaft) / rho, f = SurfaceCapstan::kFriction - lever,
               left = 1.0 - 0.2 * (1.0 - rho) / rho;
  hold_against("R15 capstan of a flattened section: exponent per radian",
               2.0 * f / (left + std::sqrt(left * left + 4.0 * lever * f)), exponent, 0.03);
}

/// As the load grows, the rod first touches the shaft at a point and then along a band. Between them the force ratio
/// has a minimum, which Grandgeorge, Sano and Reis measured. A rod of rubber, which is flattened and grows thin, has
/// it, too. Over a quarter of a turn, as a rod that touches at a point only slides off a half turn.
TEST(R15CapstanMinimum, TheForceRatioFallsWhereContactBecomesABandAndRisesAgain) {
  for (const double section : {0.0, SurfaceCapstan::kRubber}) {
    const auto ratio = [&](double load) { return SurfaceCapstan(0.2, load, 32.0, 0.0, section, 0.5 * M_PI).ratio(); };
    const double point = ratio(0.5), between = ratio(2.0), band = ratio(10.0);
    EXPECT_LT(between, 0.97 * point);
    EXPECT_LT(between, 0.98 * band);
  }
}

}  // namespace
}  // namespace knot_utm
