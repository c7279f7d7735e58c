// tensile_test --draw: a knot before anything pulls it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Draw : public MadeFolder {
 protected:
  Answer draw(const std::string& words) {
    return answer_of(tool("tensile_test", "--out '" + folder() + "' --draw " + words));
  }
  std::string picture(const std::string& name) {
    std::ostringstream out;
    out << std::ifstream(folder() + "/" + name + ".svg").rdbuf();
    return out.str();
  }
  static std::size_t count(const std::string& text, const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
    return found;
  }
};

/// Reef and granny have six crossings each; the granny's ropes go around each other three times one way.
TEST_F(Draw, TellsAReefKnotFromAGranny) {
  const Answer reef = draw("reef"), granny = draw("granny");
  EXPECT_EQ(reef.code, 0) << reef.text;
  EXPECT_THAT(reef.text, HasSubstr("title: Reef knot\nuse: "));
  EXPECT_THAT(reef.text, HasSubstr("\nstrands: 2\nheld: lower by the lower grip, upper by the upper grip\n"
                                   "pulled: lower_tail and upper_tail\ncrossings: 6, from the front\n"));
  EXPECT_THAT(reef.text, HasSubstr("linking number of ropes 1 and 2: 0"));
  EXPECT_THAT(granny.text, HasSubstr("crossings: 6, from the front\n"));
  EXPECT_THAT(granny.text, HasSubstr("linking number of ropes 1 and 2: 3"));
  const std::string svg = picture("reef");
  EXPECT_EQ(svg.rfind("<svg", 0), 0u);
  for (const char* end : {">lower<", ">lower_tail<", ">upper<", ">upper_tail<"}) EXPECT_EQ(count(svg, end), 2u) << end;
  EXPECT_GT(count(svg, "#d9622b"), 20u);
}

TEST_F(Draw, ShowsAKnotThatTheProgramDrawsItself) {
  const Answer overhand = draw("overhand");
  EXPECT_EQ(overhand.code, 0) << overhand.text;
  EXPECT_THAT(overhand.text, HasSubstr("title: Overhand knot\nstrands: 1\n"));
  EXPECT_THAT(overhand.text,
              HasSubstr("crossings: 3, from the front\ntype: Alexander polynomial 1 - t + t^2, determinant 3"));
  EXPECT_THAT(draw("fisherman").text, HasSubstr("held: the loop by both grips\npulled: its two tails\ncrossings: "));
  EXPECT_THAT(draw("straight").text, HasSubstr("least distance of strands: above 4 radii\nsharpest bend: none\n"));
}

TEST_F(Draw, ShowsAPostAsACircleAndABar) {
  const Answer hitch = draw("clove_hitch");
  EXPECT_THAT(hitch.text, HasSubstr("held: a post stands for the lower grip, upper by the upper grip\n"));
  EXPECT_THAT(hitch.text, HasSubstr("type: not defined, as the rope has a free end\n"));
  EXPECT_EQ(count(picture("clove_hitch"), "<circle"), 1u);
  EXPECT_EQ(count(picture("clove_hitch"), "<line"), 1u);
}

/// Where the places are that it names: in the frame of the file.
TEST_F(Draw, NamesPlacesAsTheFileHasThem) {
  const std::string file = folder() + "/bent.yaml";
  std::ofstream(file) << "title: \"a < b & c\"\nstrands:\n"
                         "  - {ends: [a, b], points: [[0, 0, -12], [0, 0, -8], [3, 0, 0], [0, 0, 8], [0, 0, 12]]}\n"
                         "lower: [a]\nupper: [b]\n";
  const Answer bent = draw("'" + file + "'");
  EXPECT_EQ(bent.code, 0) << bent.text;
  EXPECT_THAT(bent.text, HasSubstr("sharpest bend: "));
  EXPECT_THAT(bent.text, HasSubstr(" radii at (2."));
  EXPECT_THAT(bent.text, HasSubstr(", 0.0, "));
  EXPECT_THAT(picture("bent"), HasSubstr("a &lt; b &amp; c"));
}

}  // namespace
}  // namespace knot_utm
