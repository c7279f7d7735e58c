#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "knot_utm/analysis/statistics.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/study/batch.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kConfig = std::string(KNOT_UTM_SOURCE_DIR) + "/config/";

Method straight(const std::string& specimens) {
  return load_method(kConfig + "straight.yaml", {"specimens=" + specimens});
}

std::string refused(const std::string& method, const std::vector<std::string>& overrides) {
  try {
    draw_specimens(load_method(kConfig + method, overrides));
  } catch (const InvalidInput& invalid) {
    return invalid.what();
  }
  return "";
}

TEST(Specimens, OneIsDrawnAsAmongAllOthers) {
  const Method method = straight("{count: 3, scatter: {specimen.length: {normal: 0.02}}}");
  const std::vector<DrawnSpecimen> all = draw_specimens(method);
  for (const int number : {3, 1}) {
    const DrawnSpecimen one = draw_specimen(method, number);
    EXPECT_EQ(one.number, number);
    EXPECT_EQ(one.drawn, all[static_cast<std::size_t>(number - 1)].drawn);
    EXPECT_EQ(method_yaml(one.method), method_yaml(all[static_cast<std::size_t>(number - 1)].method));
  }
}

/// The standard error of a standard deviation over n normal readings is its 1/sqrt(2 n)-th part, that of the mean the
/// 1/sqrt(n)-th; three of them, which the fixed seed keeps. Leaving out what is beyond 3 standard deviations takes 1.3
/// % of the standard deviation.
TEST(Specimens, AreDrawnWithTheSpreadThatTheMethodSays) {
  constexpr int kCount = 400;
  const Method method = straight(
      "{count: 400, scatter: {specimen.length: {normal: 0.02}, material.radius: {uniform: 0.1}, "
      "material.density: {log_normal: 0.2}}}");
  std::vector<double> lengths, radii, densities;
  for (const DrawnSpecimen& specimen : draw_specimens(method)) {
    lengths.push_back(specimen.method.specimen.length);
    radii.push_back(specimen.method.material.radius);
    densities.push_back(std::log(specimen.method.material.density / method.material.density));
    EXPECT_EQ(specimen.drawn[0].second, lengths.back());
    EXPECT_EQ(specimen.method.specimens.count, 1);
  }
  const double of_sd = 3.0 / std::sqrt(2.0 * kCount), of_mean = 3.0 / std::sqrt(1.0 * kCount);
  const Statistics length = statistics_of(lengths), radius = statistics_of(radii), density = statistics_of(densities);
  EXPECT_NEAR(*length.cv, 0.02 * (1.0 - 0.013), 0.02 * of_sd);
  EXPECT_NEAR(*length.mean / method.specimen.length, 1.0, 0.02 * of_mean);
  EXPECT_LE(*length.maximum, 1.06 * method.specimen.length);
  EXPECT_NEAR(*radius.cv, 0.1 / std::sqrt(3.0), 0.1 * of_sd);
  EXPECT_GE(*radius.minimum, 0.9 * method.material.radius);
  EXPECT_LE(*radius.maximum, 1.1 * method.material.radius);
  EXPECT_NEAR(*density.sd, 0.2 * (1.0 - 0.013), 0.2 * of_sd);
  EXPECT_NEAR(*density.mean, 0.0, 0.2 * of_mean);
}

TEST(Specimens, StayTheSameHoweverManyThereAreAndWhateverElseScatters) {
  const auto few = draw_specimens(straight("{count: 3, scatter: {specimen.length: {normal: 0.02}}}"));
  const auto many = draw_specimens(
      straight("{count: 9, scatter: {material.radius: {normal: 0.02}, specimen.length: {normal: 0.02}}}"));
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i].method.specimen.length, many[i].method.specimen.length);
  const auto other = draw_specimens(straight("{count: 3, seed: 2, scatter: {specimen.length: {normal: 0.02}}}"));
  EXPECT_NE(few[0].method.specimen.length, other[0].method.specimen.length);
}

/// No number of specimens averages the cell's systematic error out, as in a laboratory.
TEST(Specimens, AreReadByOneCellWithNoiseOfItsOwnForEach) {
  const auto drawn = draw_specimens(straight("{count: 2}")), others = draw_specimens(straight("{count: 2, seed: 2}"));
  const auto cell = [](const DrawnSpecimen& specimen) { return specimen.method.machine.load_cell; };
  EXPECT_EQ(cell(drawn[0]).seed, cell(drawn[1]).seed);
  EXPECT_NE(cell(drawn[0]).noise_run, cell(drawn[1]).noise_run);
  EXPECT_NE(cell(drawn[0]).noise_run, cell(others[0]).noise_run);
}

/// What a resumed batch reads is its own method.yaml.
TEST(Specimens, AreThoseOfTheMethodThatIsWritten) {
  const Method method = load_method(kConfig + "tighten.yaml", {"specimens.count=2"});
  const Method again = parse_method(method_yaml(method), kConfig + "tighten.yaml");
  const auto drawn = draw_specimens(method), redrawn = draw_specimens(again);
  ASSERT_EQ(drawn.size(), redrawn.size());
  ASSERT_GT(drawn[0].drawn.size(), 2u);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    EXPECT_EQ(drawn[i].drawn, redrawn[i].drawn);
    EXPECT_EQ(method_yaml(drawn[i].method), method_yaml(redrawn[i].method));
  }
}

/// A key of the chosen law that the method leaves out has its plain value, which scatters.
TEST(Specimens, MayDifferInAKeyThatIsLeftOut) {
  EXPECT_EQ(refused("tighten.yaml", {"specimens.count=2", "specimens.scatter={material.stick_ratio: {normal: 0.1}}"}),
            "");
  EXPECT_THAT(refused("tighten.yaml", {"specimens.count=2", "specimens.scatter={material.hardening: {normal: 0.1}}"}),
              HasSubstr("material.hardening"));
}

TEST(Specimens, AreRefusedBeforeAnyIsTested) {
  const std::string scatter = "specimens.scatter=";
  EXPECT_THAT(refused("straight.yaml", {"specimens.count=2", scatter + "{specimen.lenght: {normal: 0.1}}"}),
              AllOf(HasSubstr("specimen.lenght"), HasSubstr("no key of this method that has a number")));
  EXPECT_THAT(refused("straight.yaml", {"specimens.count=2", scatter + "{specimen.length: 0.1}"}),
              AllOf(HasSubstr("specimens.scatter.specimen.length"), HasSubstr("{normal: 0.05}")));
  EXPECT_THAT(refused("straight.yaml", {"specimens.count=2", scatter + "{specimen.length: {normal: 2}}"}),
              AllOf(HasSubstr("specimens.scatter.specimen.length.normal is 2"), HasSubstr("0.3")));
  EXPECT_THAT(refused("straight.yaml", {"specimens.count=0"}), HasSubstr("specimens.count is 0"));
  EXPECT_THAT(refused("straight.yaml", {"specimens.cuont=2"}), HasSubstr("did you mean specimens.count?"));
  EXPECT_THAT(refused("tighten.yaml", {"specimens.count=50", scatter + "{specimen.knot_distance: {normal: 0.3}}"}),
              AllOf(HasSubstr("cannot be made"), HasSubstr("specimen.")));
}

TEST(KeyUnits, AreThoseOfTheMethodsKeys) {
  const Method method = load_method(kConfig + "tighten.yaml");
  EXPECT_EQ(unit_of_key(method, "specimen.knot_distance"), "m");
  EXPECT_EQ(unit_of_key(method, "material.bending_stiffness"), "N m2");
  EXPECT_EQ(unit_of_key(method, "program.pull.speed"), "m/s");
  EXPECT_EQ(unit_of_key(method, "program.0.tie.speed"), "m/s");
  EXPECT_EQ(unit_of_key(method, "machine.load_cell.sampling_rate"), "Hz");
  EXPECT_EQ(unit_of_key(method, "specimen.handedness"), "");
  EXPECT_EQ(unit_of_key(method, "specimen.no_key"), "");
}

}  // namespace
}  // namespace knot_utm
