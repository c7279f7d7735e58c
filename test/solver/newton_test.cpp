#include "knot_utm/solver/newton.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace knot_utm {
namespace {

/// One equation in one unknown.
struct Equation {
  double (*f)(double);
  double (*slope)(double);
  double x, change = 0.0, still = 0.0;

  double residual() const { return std::abs(f(x)); }
  double tolerance() const { return 1e-9; }
  bool solve() {
    change = -f(x) / slope(x);
    return std::isfinite(change);
  }
  void move(double factor) { x += factor * change; }
  bool stands_still() const { return std::abs(change) < still; }
};

/// |x|^(1/2) sign x: whole changes lead from x to -x for ever.
Equation circling() {
  return {[](double x) { return std::copysign(std::sqrt(std::abs(x)), x); },
          [](double x) { return 0.5 / std::sqrt(std::abs(x)); }, 1.0};
}

TEST(Newton, GivesUpWhereTheResidualDoesNotFall) {
  Equation equation = circling();
  const NewtonSummary summary = newton(equation, {40, 1.0, true});
  EXPECT_EQ(summary.end, NewtonSummary::End::kAbandonedEarly);
  EXPECT_EQ(summary.iterations, 4);
  EXPECT_STREQ(summary.reason(), "the residual did not fall");
}

TEST(Newton, HalfTheChangeBreaksACycle) {
  Equation equation = circling();
  const NewtonSummary summary = newton(equation, {40});
  EXPECT_TRUE(summary.converged()) << summary.reason();
  EXPECT_GT(summary.iterations, 4);
}

TEST(Newton, GivesNothingUpThatConvergesHoweverSlowly) {
  // A root of third order: each change takes a third off, and the residual falls to 8/27.
  Equation equation{[](double x) { return x * x * x; }, [](double x) { return 3.0 * x * x; }, 1.0};
  const NewtonSummary summary = newton(equation, {40, 1.0, true});
  EXPECT_TRUE(summary.converged()) << summary.reason();
}

TEST(Newton, ACycleNearTheToleranceIsNotGivenUp) {
  Equation equation = circling();
  equation.x = 4e-18;  // residual 2e-9, twice the tolerance
  EXPECT_TRUE(newton(equation, {40, 1.0, true}).converged());
}

TEST(Newton, TwoSidesOfAJumpThatAreNotApartAreASolution) {
  Equation equation{[](double x) { return x + std::copysign(1e-6, x); }, [](double) { return 1.0; }, 1.0};
  EXPECT_FALSE(newton(equation, {12}).converged());
  equation.x = 1.0;
  equation.still = 1e-5;
  const NewtonSummary summary = newton(equation, {12});
  EXPECT_TRUE(summary.converged());
  EXPECT_NEAR(equation.x, 0.0, 2e-6);
  EXPECT_GT(summary.residual, summary.tolerance) << "it says what is left";
}

}  // namespace
}  // namespace knot_utm
