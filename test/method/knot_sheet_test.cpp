// tensile_test --draw: a knot before anything pulls it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Draw : public MadeFolder {
 protected:
  static Answer draw(const std::string& words) {
    return answer_of(tool("tensile_test", "--out '" + folder() + "' --draw " + words));
  }
};

/// Reef and granny have six crossings each; the granny's ropes go around each other three times one way.
TEST_F(Draw, SaysWhatAKnotIsAndWritesItsPictureOnce) {
  const Answer reef = draw("reef"), granny = draw("granny");
  EXPECT_EQ(reef.code, 0) << reef.text;
  EXPECT_THAT(reef.text,
              AllOf(HasSubstr("title: Reef knot\nuse: "),
                    HasSubstr("\nstrands: 2\nheld: lower by the lower grip, upper by the upper grip\n"
                              "pulled: lower_tail and upper_tail\ncrossings: 6, from the front\n"),
                    HasSubstr("linking number of ropes 1 and 2: 0"), HasSubstr("picture: " + in("reef.png"))));
  EXPECT_THAT(granny.text,
              AllOf(HasSubstr("crossings: 6, from the front\n"), HasSubstr("linking number of ropes 1 and 2: 3")));
  EXPECT_GT(fs::file_size(in("reef.png")), 10000u);
  EXPECT_EQ(draw("reef").code, 2);
  EXPECT_EQ(draw("reef --overwrite").code, 0);
  const Answer overhand = draw("overhand");
  EXPECT_THAT(overhand.text,
              HasSubstr("crossings: 3, from the front\ntype: Alexander polynomial 1 - t + t^2, determinant 3"));
  EXPECT_THAT(draw("fisherman").text, HasSubstr("held: the loop by both grips\npulled: its two tails\ncrossings: "));
  EXPECT_THAT(draw("straight").text, HasSubstr("least distance of strands: above 4 radii\nsharpest bend: none\n"));
  EXPECT_THAT(draw("clove_hitch").text, AllOf(HasSubstr("held: a post stands for the lower grip, upper by the upper"),
                                              HasSubstr("type: not defined, as the rope has a free end\n")));
}

/// Where the places are that it names: in the frame of the file.
TEST_F(Draw, NamesPlacesAsTheFileHasThem) {
  std::ofstream(in("bent.yaml")) << "title: \"a < b & c\"\nstrands:\n"
                                    "  - {ends: [a, b], points: [[0, 0, -12], [0, 0, -8], [3, 0, 0], [0, 0, 8], "
                                    "[0, 0, 12]]}\nlower: [a]\nupper: [b]\n";
  const Answer bent = draw("'" + in("bent.yaml") + "'");
  EXPECT_EQ(bent.code, 0) << bent.text;
  EXPECT_THAT(bent.text, AllOf(HasSubstr("sharpest bend: "), HasSubstr(" radii at (2."), HasSubstr(", 0.0, ")));
}

TEST_F(Draw, RefusesInOneLineAndWritesNothing) {
  std::ofstream(in("crossed.yaml")) << "strands:\n"
                                       "  - {ends: [a, b], points: [[0, 0, -12], [0, 0, -8], [0, 0, 8], [0, 0, 12]]}\n"
                                       "  - {ends: [c, d], points: [[-9, 0.5, 0], [-3, 0.5, 0], [3, 0.5, 0], "
                                       "[9, 0.5, 0]]}\nlower: [a]\nupper: [b]\n";
  const auto refused = [](const std::string& words, const std::string& why) {
    const Answer answer = draw(words);
    EXPECT_EQ(answer.code, 2) << answer.text;
    EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
    EXPECT_THAT(answer.text, HasSubstr(why));
  };
  refused("'" + in("crossed.yaml") + "'", "strands overlap at (0.0, 0.2, 0.0), where they are 0.5 radii apart");
  refused("reff", "reef");
  refused("/nowhere/knot.yaml", "/nowhere/knot.yaml");
  refused("reef tighten", "--draw");
  refused("file", "specimen.file is missing");
  for (const auto& entry : fs::directory_iterator(folder()))
    EXPECT_NE(entry.path().extension(), ".png") << entry.path();
}

}  // namespace
}  // namespace knot_utm
