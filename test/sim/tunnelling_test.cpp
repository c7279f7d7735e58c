// Nothing passes through: strands thrown at each other so fast that one step would carry them past, with every other
// limit of a step taken away.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr const char* kPassage = "strands would pass through each other at ";

/// One rod: a strand along x, a wide bend, and a strand along y three radii above the first, thrown down at it.
struct Thrown {
  static constexpr int kStrand = 21, kBend = 24;
  double radius;
  double way;  // of the strand thrown, in the step that is tried [radii]

  static int nodes() { return 2 * kStrand + kBend; }
  static constexpr double kSpeed = 40.0;  // of the throw [m/s]
  /// In which it would get `way` [s].
  double step() const { return way * radius / kSpeed; }

  Material material() const {
    Material out = braided_rope();
    const double scale = radius / out.radius;
    out.radius = radius;
    out.stretching_stiffness *= scale * scale;
    out.bending_stiffness *= std::pow(scale, 4.0);
    return out;
  }
  Points shape() const {
    Points x(3, nodes());
    for (int i = 0; i < kStrand; ++i) x.col(i) << i - 10.0, 0.0, 0.0;
    // Three quarters of a circle in the plane, rising, from (10, 0) to (0, 10).
    for (int i = 0; i < kBend; ++i) {
      const double share = (i + 1.0) / (kBend + 1.0), angle = -0.5 * M_PI + 1.5 * M_PI * share;
      x.col(kStrand + i) << 10.0 + 10.0 * std::cos(angle), 10.0 + 10.0 * std::sin(angle), 3.0 * share;
    }
    for (int i = 0; i < kStrand; ++i) x.col(kStrand + kBend + i) << 0.0, 10.0 - i, 3.0;
    return radius * x;
  }
  RodProperties rod() const {
    const Points x = shape();
    return make_rod(material(), (x.rightCols(nodes() - 1) - x.leftCols(nodes() - 1)).colwise().norm());
  }
  std::unique_ptr<TimeStep> stepper() const {
    StepSettings settings = closed_form_settings(material());
    settings.candidate_margin = radius;
    settings.newton_cap = settings.motion_limit = settings.overlap_limit = std::numeric_limits<double>::infinity();
    settings.residual = 1e-6 * settings.pressure_law.stiffness * radius * radius;
    RodState state;
    state.position = shape();
    state.velocity = Points::Zero(3, nodes());
    state.velocity.rightCols(kStrand).row(2).setConstant(-kSpeed);
    return TimeStep::make(rod(), state, settings);
  }
};

/// Whether all of the second strand that lies over the first, as seen along z, is above it; how many places those are.
struct Above {
  int places = 0;
  bool all = true;

  explicit Above(const Points& x) {
    for (int a = 0; a + 1 < Thrown::kStrand; ++a)
      for (int b = Thrown::nodes() - Thrown::kStrand; b + 1 < Thrown::nodes(); ++b) {
        const Vec3 p = x.col(b) - x.col(a), ea = x.col(a + 1) - x.col(a), eb = x.col(b + 1) - x.col(b);
        const double area = ea.x() * eb.y() - ea.y() * eb.x();
        const double t = (p.x() * eb.y() - p.y() * eb.x()) / area, u = (p.x() * ea.y() - p.y() * ea.x()) / area;
        if (!(t >= 0.0 && t < 1.0 && u >= 0.0 && u < 1.0)) continue;
        ++places;
        all = all && p.z() + u * eb.z() - t * ea.z() > 0.0;
      }
  }
};

class NothingPassesThrough : public testing::TestWithParam<Thrown> {};

TEST_P(NothingPassesThrough, AStepThatWouldIsRejectedAndSaysWhere) {
  const Thrown& scene = GetParam();
  const std::unique_ptr<TimeStep> stepper = scene.stepper();
  const Points before = stepper->state().position, velocity = stepper->state().velocity;
  const StepSummary summary = stepper->step({}, scene.step());
  ASSERT_TRUE(summary.newton.converged()) << "nothing else must stand in the way";
  EXPECT_GT(summary.largest_motion, 3.0 * scene.radius);
  ASSERT_FALSE(summary.accepted());
  EXPECT_THAT(summary.reason, testing::StartsWith(kPassage));
  EXPECT_EQ(stepper->state().position, before);
  EXPECT_EQ(stepper->state().velocity, velocity);
  // The middles of both strands lie over each other.
  double first = 0.0, second = 0.0;
  ASSERT_EQ(std::sscanf(summary.reason.c_str() + std::string(kPassage).size(), "%lf m and %lf m along the rod", &first,
                        &second),
            2);
  const Eigen::VectorXd arclength = scene.rod().arclength();
  EXPECT_NEAR(first, arclength[10], scene.radius);
  EXPECT_NEAR(second, arclength[Thrown::nodes() - 11], scene.radius);
}

TEST_P(NothingPassesThrough, ShorterStepsGetThereAndTheStrandsStop) {
  const Thrown& scene = GetParam();
  const std::unique_ptr<TimeStep> stepper = scene.stepper();
  StepControl::Options options;
  options.longest = options.first = scene.step();
  options.shortest = 1e-12;
  options.motion = std::numeric_limits<double>::infinity();
  StepControl control(options);
  const Boundary boundary;
  double time = 0.0, nearest = std::numeric_limits<double>::infinity();
  const std::string gave_up = control.advance(
      *stepper, time, 10.0 * scene.radius / Thrown::kSpeed, [&](double, double) -> const Boundary& { return boundary; },
      [&](double, double, const StepSummary&) {
        const Points& now = stepper->state().position;
        const Above above(now);
        EXPECT_GT(above.places, 0);
        EXPECT_TRUE(above.all) << "at " << time << " s";
        nearest = std::min(nearest, now.row(2).tail(Thrown::kStrand).minCoeff());
      });
  EXPECT_EQ(gave_up, "");
  EXPECT_GT(control.counters().rejected, 0U);
  EXPECT_LT(nearest, 2.0 * scene.radius) << "they must have touched";
}

INSTANTIATE_TEST_SUITE_P(Throws, NothingPassesThrough, testing::Values(Thrown{3e-3, 6.0}, Thrown{1e-4, 40.0}),
                         [](const auto& scene) {
                           const Thrown& thrown = scene.param;
                           return std::string(thrown.radius < 1e-3 ? "Thin" : "Thick") +
                                  std::to_string(static_cast<int>(thrown.way)) + "RadiiAStep";
                         });

}  // namespace
}  // namespace knot_utm
