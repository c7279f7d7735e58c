#include "sim/capstan.hpp"

#include <gtest/gtest.h>

#include "reference.hpp"

namespace knot_utm {
namespace {

class R8Capstan : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(R8Capstan, FormulaIsTheReferences) {
  const auto [t1, expected] = GetParam();
  EXPECT_NEAR(elastic_capstan(t1, Capstan::kMu, 2.0 * M_PI), expected, 5e-4);
}

TEST_P(R8Capstan, SlidesAtTheElasticRatio) {
  // Edges of rho/10; the error, second order in their length, passes 1 % at rho/5.
  const auto [t1, expected] = GetParam();
  Capstan scene(t1, {});
  hold_against("R8 capstan, T1 rho^2/B = " + std::to_string(std::lround(t1)) + ": T2/T1", expected, scene.ratio(),
               0.01);
}

TEST_P(R8Capstan, ErrorFallsWithTheSquareOfTheEdgeLength) {
  const auto [t1, expected] = GetParam();
  Capstan::Options few, many;
  few.edges_a_turn = 24.0;
  many.edges_a_turn = 48.0;
  Capstan coarse(t1, few), fine(t1, many);
  const double error = std::abs(coarse.ratio() - expected);
  EXPECT_LT(error, 0.05 * expected);
  EXPECT_LT(std::abs(fine.ratio() - expected), error / 3.0);
}

INSTANTIATE_TEST_SUITE_P(Loads, R8Capstan,
                         testing::Values(std::pair{2.0, 5.319}, std::pair{10.0, 6.305}, std::pair{50.0, 6.527},
                                         std::pair{1000.0, 6.583}),
                         [](const auto& load) { return "T" + std::to_string(std::lround(load.param.first)); });

}  // namespace
}  // namespace knot_utm
