// What is known of a method before it is run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "knot_utm/verdict/run_warnings.hpp"
#include "knot_utm/words/number.hpp"
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
  const Answer answer = answer_of(tool("tensile_test", "straight --check --set material.density=100"));
  EXPECT_EQ(answer.code, 0);
  EXPECT_THAT(answer.text, HasSubstr("tensile_test: material.density is 100 kg/m3"));
  EXPECT_THAT(answer.text, HasSubstr("g/m at a diameter of 6.35 mm, E = 2.32 GPa"));
}

}  // namespace
}  // namespace knot_utm
