// What is known of a method before it is run.
#include "knot_utm/verdict/foreseen.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "knot_utm/numeric/number.hpp"
#include "run/command.hpp"

namespace knot_utm {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kConfig = std::string(KNOT_UTM_SOURCE_DIR) + "/config/";

std::vector<std::string> warnings_of(const std::string& name, const std::vector<std::string>& set) {
  return foreseen_warnings(load_method(kConfig + name + ".yaml", set));
}

TEST(Foreseen, NothingIsSaidOfTheShippedMethods) {
  for (const std::string& folder : {kConfig, kConfig + "standards/"})
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".yaml" && entry.path().filename() != "from_file.yaml") {
        EXPECT_THAT(foreseen_warnings(load_method(entry.path().string())), IsEmpty()) << entry.path();
      }
}

TEST(Foreseen, AnOverhandThatAutoMadeLongerThanUsual) {
  EXPECT_THAT(warnings_of("overhand", {"specimen.end_to_end=0.73"}), IsEmpty()) << "0.27 m are enough";
  const std::vector<std::string> set{"specimen.end_to_end=0.9"};
  EXPECT_THAT(warnings_of("overhand", set),
              ElementsAre(AllOf(HasSubstr("specimen.length: auto is 1.2 m, more than its usual 1 m"),
                                HasSubstr("the length of rod in the knot, 0.3 m, is the same"))));
  EXPECT_THAT(warnings_of("overhand", {set[0], "specimen.length=1.19"}), IsEmpty()) << "chosen";
  // method.yaml of the run has the number in place of `auto`, and a test goes on from it.
  const Method again = parse_method(method_yaml(load_method(kConfig + "overhand.yaml", set)), "method.yaml");
  EXPECT_EQ(foreseen_warnings(again).size(), 1u);
}

TEST(Foreseen, KnotsThatAreTiedNearTheRollers) {
  const std::vector<std::string> set{"material=polypropylene", "specimen.knot_distance=0.2", "specimen.end_to_end="};
  EXPECT_THAT(warnings_of("tighten", {set[0], set[1], set[2] + "0.25"}),
              ElementsAre(AllOf(HasSubstr("specimen.end_to_end is 0.25 m, only 15.7 radii more than"),
                                HasSubstr("from 19 radii more on, which is a specimen.end_to_end of 0.26 m"))));
  EXPECT_THAT(warnings_of("tighten", {set[0], set[1], set[2] + "0.261"}), IsEmpty());
  EXPECT_THAT(warnings_of("tighten", {set[0], set[1], set[2] + "0.25", "machine.grips=nodes"}),
              testing::Each(testing::Not(HasSubstr("rollers are near"))))
      << "there are no rollers";
}

/// Its load climbs to kilonewtons while the knots slide, and its stiffness is that of the straight side.
TEST(Foreseen, ALoopBetweenHeldNodes) {
  EXPECT_THAT(warnings_of("tighten", {"machine.grips=nodes"}),
              ElementsAre(HasSubstr("the side of the loop without knots bears the load")));
  EXPECT_THAT(warnings_of("straight", {"machine.grips=nodes"}), IsEmpty());
}

TEST(Foreseen, AKnotThatIsDrawnTooWideForItsPull) {
  EXPECT_THAT(warnings_of("knot", {"specimen.knot=surgeon_1"}),
              ElementsAre(AllOf(HasSubstr("the pull takes up 80 radii of a rope that is drawn with 1210 radii"),
                                HasSubstr("until.extension: 3.8"))));
  EXPECT_THAT(warnings_of("knot", {"specimen.knot=surgeon_1", "program.3.pull.until.extension=3.5"}), IsEmpty());
  EXPECT_THAT(warnings_of("knot", {"specimen.knot=butterfly_loop"}), IsEmpty());
}

/// Three of four specimens of nylon slid, and one jumped open.
TEST(Foreseen, KnotsOfOppositeHandedness) {
  EXPECT_THAT(warnings_of("tighten", {"specimen.handedness=opposite"}),
              ElementsAre(HasSubstr("is one of a distribution")));
}

/// A power of the pressure that holds at a pressure far beyond that of knots.
TEST(Foreseen, FrictionThatIsMuchLargerInKnotsThanTheMethodSays) {
  const std::string law = "physics.friction={law: power, exponent: 0.6, reference_pressure: ";
  EXPECT_THAT(
      warnings_of("tighten", {law + "67323}"}),
      ElementsAre(AllOf(HasSubstr("law: power makes the friction coefficient 2.16"), HasSubstr("at 1350 N/m"))));
  EXPECT_THAT(warnings_of("tighten", {law + "1000}"}), IsEmpty());
  EXPECT_THAT(warnings_of("straight", {"physics.friction={law: memory}"}), IsEmpty());
}

TEST(Foreseen, AnExtensionBeyondTheTravelOfTheCrosshead) {
  EXPECT_THAT(warnings_of("straight", {"machine.travel=0.02", "program=[{pull: {until: {extension: 0.02}}}]"}),
              IsEmpty());
  EXPECT_THAT(
      warnings_of("straight", {"machine.travel=0.02", "program=[{pull: {until: {extension: 0.03}}}]"}),
      ElementsAre("program.0.pull.until.extension is 0.03 m, which is never reached: before it the crosshead is "
                  "at the end of machine.travel, 0.02 m, and the test ends there"));
  EXPECT_THAT(warnings_of("straight", {"machine.travel=0.02", "program=[{cycle: {extension: [0, 0.03], count: 2}}]"}),
              ElementsAre(HasSubstr("program.0.cycle.extension.1 is 0.03 m, which is never reached")));
}

TEST(Foreseen, ALoadOrATimeBeyondWhatEndsTheTest) {
  EXPECT_THAT(warnings_of("straight", {"ends.load=50", "program=[{pull: {until: {load: 100}}}]"}),
              ElementsAre(HasSubstr("program.0.pull.until.load is 100 N, which is never reached: before it the load is "
                                    "at ends.load, 50 N")));
  EXPECT_THAT(warnings_of("straight", {"ends.time=5", "program=[{pull: {until: {time: 9}}}]"}),
              ElementsAre(HasSubstr("program.0.pull.until.time is 9 s, which is never reached")));
  EXPECT_THAT(warnings_of("straight", {"program=[{pull: {speed: 0.1, until: {time: 100}}}]"}),
              ElementsAre(HasSubstr("at the end of machine.travel after 10 s at 0.1 m/s")));
}

TEST(Foreseen, AFractureOfARodThatNothingBreaks) {
  const std::vector<std::string> set{"program=[{pull: {until: {break: true}}}]", "material=pink_vps"};
  EXPECT_THAT(warnings_of("straight", set),
              ElementsAre(HasSubstr("program.0.pull.until.break is the only end of the pull, but nothing breaks")));
  EXPECT_THAT(warnings_of("straight", {set[0], set[1], "material.breaking_force=2"}), IsEmpty());
  EXPECT_THAT(warnings_of("straight", {set[0], set[1], "ends.break_at_fraction_of_peak=0.5"}), IsEmpty());
}

TEST(Foreseen, NoShippedRodIsAskedAbout) {
  for (const auto& entry : std::filesystem::directory_iterator(kConfig + "materials/"))
    EXPECT_THAT(warnings_of("straight", {"material=" + entry.path().string(), "program=[{hold: {duration: 1}}]"}),
                IsEmpty())
        << entry.path();
}

TEST(Foreseen, SlipsOfUnitsAreAskedAbout) {
  const auto asked = [](const std::string& key, const std::string& value) {
    std::vector<std::string> settings = {"program=[{hold: {duration: 1}}]", "material." + key + "=" + value};
    if (key == "bending_stiffness") settings.push_back("material.twisting_stiffness=" + value);
    return warnings_of("straight", settings);
  };
  EXPECT_THAT(asked("density", "100"), ElementsAre(HasSubstr("material.density is 100 kg/m3, where cork has 200")));
  EXPECT_THAT(asked("density", "20000"), ElementsAre(HasSubstr("is it in kg/m3")));
  // E in MPa; that it would then also bend too stiffly needs no word.
  EXPECT_THAT(asked("stretching_stiffness", "0.0734"),
              ElementsAre(HasSubstr("which is E = 2.32 kPa, where rubber has 1 MPa")));
  EXPECT_THAT(asked("bending_stiffness", "4.31e-11"), ElementsAre(HasSubstr("of that of a solid rod")));
  EXPECT_THAT(asked("bending_stiffness", "43.1"), ElementsAre(HasSubstr("is it in N m2?")));
  EXPECT_THAT(asked("breaking_force", "2.5"), ElementsAre(HasSubstr("at a strain of 3.41e-05: is it in N?")));
}

TEST(SpeedWarnings, SayThatKnotsAreTiedInHaste) {
  const Method plain = load_method(kConfig + "tighten.yaml");
  EXPECT_THAT(speed_warnings(plain), IsEmpty());
  const std::string by_default =
      format_number(std::round(100.0 * plain.program[0]->speed / plain.material.radius) / 100.0);
  EXPECT_THAT(speed_warnings(load_method(kConfig + "tighten.yaml", {"program.tie.speed=0.029"})), IsEmpty());
  EXPECT_THAT(speed_warnings(load_method(kConfig + "tighten.yaml", {"program.tie.speed=0.1"})),
              ElementsAre(HasSubstr("tied at 31.5 radii a second, by default at " + by_default + ";")));
}

TEST(SpeedWarnings, SayThatALoopIsPulledInHaste) {
  EXPECT_THAT(speed_warnings(load_method(kConfig + "tighten.yaml", {"program.pull.speed=0.016"})), IsEmpty());
  EXPECT_THAT(speed_warnings(load_method(kConfig + "tighten.yaml", {"program.pull.speed=0.033"})),
              ElementsAre(HasSubstr("pulled at 10.4 radii a second, as shipped at 1.04;")));
  EXPECT_THAT(speed_warnings(load_method(kConfig + "straight.yaml", {"program.pull.speed=0.1"})), IsEmpty());
}

TEST(Foreseen, CheckSaysIt) {
  const Answer answer = answer_of(tool("tensile_test", "straight --check --set machine.travel=0.001"));
  EXPECT_EQ(answer.code, 0);
  EXPECT_THAT(answer.text, HasSubstr("tensile_test: program."));
  EXPECT_THAT(answer.text, HasSubstr("which is never reached"));
  EXPECT_THAT(answer.text, HasSubstr("tensile_test: the rod: 36.4 g/m at a diameter of 6.35 mm, E = 2.32 GPa"));
}

}  // namespace
}  // namespace knot_utm
