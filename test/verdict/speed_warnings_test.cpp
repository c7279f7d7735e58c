#include "knot_utm/verdict/speed_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/numeric/number.hpp"

namespace knot_utm {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kTighten = std::string(KNOT_UTM_SOURCE_DIR) + "/config/tighten.yaml";

TEST(SpeedWarnings, SayWhatShareSpeedHasInTheForce) {
  EXPECT_THAT(speed_warnings(RateShares{0.009, 0.009, 0.0}, 1.0), IsEmpty());
  EXPECT_THAT(speed_warnings(RateShares{}, 1e-6), IsEmpty());
  EXPECT_THAT(speed_warnings(RateShares{0.5, 0.02, 0.0}, 1.0),
              ElementsAre(HasSubstr("drag makes up 50 % of the force"), HasSubstr("inertia changes the force by 2 %")));
  EXPECT_THAT(speed_warnings(RateShares{0.0, 0.02, 0.0}, 0.5),
              ElementsAre(HasSubstr("choose a physics.inertia much smaller than 0.5")));
  EXPECT_THAT(speed_warnings(RateShares{0.0, 0.02, 0.0}, 1e-7), ElementsAre(HasSubstr("pull more slowly")));
  EXPECT_THAT(speed_warnings(RateShares{35.0, 0.0, 0.0}, 1.0), ElementsAre(HasSubstr("drag takes 35 times the work")));
}

TEST(SnapWarnings, TellOfWhatLetGoButNotOfKnotsThatSlideOrJump) {
  Results results;
  results.fastest_node = 0.14;  // pink VPS as shipped
  EXPECT_THAT(snap_warnings(results, 3.3e-3), IsEmpty());
  results.fastest_node = 1.635;  // nylon on a frame of 3 kN/m
  EXPECT_THAT(snap_warnings(results, 3.3e-3), ElementsAre(HasSubstr("1.64 m/s, 495 times as fast as the pull")));
  EXPECT_THAT(snap_warnings(results, 0.0), IsEmpty()) << "a record is followed";
  results.curve.jump_force = 1.0;
  EXPECT_THAT(snap_warnings(results, 3.3e-3), IsEmpty()) << "that is told already";
}

TEST(SpeedWarnings, SayWhatTheMassThatIsLeftOutWouldDo) {
  const RateShares rate{0.0, 1e-4, 0.0};
  EXPECT_THAT(speed_warnings(rate, 0.1), IsEmpty());
  EXPECT_THAT(speed_warnings(rate, 2e-3), ElementsAre(HasSubstr("all of it would change the force by about 5 %")));
  EXPECT_THAT(speed_warnings(rate, 1e-6), ElementsAre(HasSubstr("by more than itself")));
  EXPECT_THAT(speed_warnings(rate, 400.0), IsEmpty());
}

TEST(SpeedWarnings, SayThatKnotsAreTiedInHaste) {
  const Method plain = load_method(kTighten);
  EXPECT_THAT(speed_warnings(plain), IsEmpty());
  const std::string by_default =
      format_number(std::round(100.0 * plain.program[0]->speed / plain.material.radius) / 100.0);
  EXPECT_THAT(speed_warnings(load_method(kTighten, {"program.tie.speed=0.029"})), IsEmpty());
  EXPECT_THAT(speed_warnings(load_method(kTighten, {"program.tie.speed=0.1"})),
              ElementsAre(HasSubstr("tied at 31.5 radii a second, by default at " + by_default + ";")));
}

TEST(SpeedWarnings, SayThatALoopIsPulledInHaste) {
  EXPECT_THAT(speed_warnings(load_method(kTighten, {"program.pull.speed=0.016"})), IsEmpty());
  EXPECT_THAT(speed_warnings(load_method(kTighten, {"program.pull.speed=0.033"})),
              ElementsAre(HasSubstr("pulled at 10.4 radii a second, as shipped at 1.04;")));
  EXPECT_THAT(speed_warnings(
                  load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/straight.yaml", {"program.pull.speed=0.1"})),
              IsEmpty());
}

}  // namespace
}  // namespace knot_utm
