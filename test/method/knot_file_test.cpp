// Knots from files: what a file says, and each line with which one is refused.
#include "knot_utm/method/knot_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "complaint.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/topology/knot_invariants.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const std::string kBend = std::string(KNOT_UTM_SOURCE_DIR) + "/config/knot.yaml";

const char* const kHooks = R"(title: Two hooks
use: Holds nothing.
strands:
  - ends: [lower, lower_tail]
    points: [[0, 0, -8], [0, 0, -4], [0, 1, 0], [3, 2, 2], [6, 1, 3], [9, 0, 3]]
  - ends: [upper_tail, upper]
    points: [[-6, 5, -6], [-4, 4, -3], [0, 4, -2], [4, -1, -1], [4, -2, 3], [4, -2, 7]]
lower: [lower]
upper: [upper]
tie:
  - {lower_tail: 1, upper_tail: 0.5}
)";

class KnotFile : public MadeFolder {
 protected:
  static std::string file() { return in("hooks.yaml"); }
  void write(const std::string& text) const { std::ofstream(file()) << text; }

  /// What is said of the file with one text for another.
  std::string complaint(const std::string& from, const std::string& to) const {
    std::string text = kHooks;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    write(text.replace(at, from.size(), to));
    return complaint_of([&] { read_knot_file(file(), "hooks"); });
  }
};

TEST_F(KnotFile, IsReadAsItSays) {
  write(kHooks);
  const auto knot = read_knot_file(file(), "hooks");
  EXPECT_EQ(knot->name, "hooks");
  EXPECT_EQ(knot->title, "Two hooks");
  ASSERT_EQ(knot->strands.size(), 2u);
  EXPECT_EQ(knot->strands[0].points[3], Vec3(3, 2, 2));
  EXPECT_EQ(knot->held("upper"), KnotDrawing::End::kUpper);
  EXPECT_EQ(knot->held("upper_tail"), KnotDrawing::End::kFree);
  ASSERT_EQ(knot->tie.size(), 1u);
  EXPECT_EQ(knot->tie[0][1].fraction, 0.5);
}

TEST_F(KnotFile, ItsTextIsThatOfWhatIsTiedAndNotOfItsWords) {
  write(kHooks);
  const std::string text = read_knot_file(file(), "hooks")->text;
  std::string other = kHooks;
  write(other.replace(other.find("Two hooks"), 9, "Hooks"));
  EXPECT_EQ(read_knot_file(file(), "hooks")->text, text);
  write(other.replace(other.find("0.5"), 3, "0.6"));
  EXPECT_NE(read_knot_file(file(), "hooks")->text, text);
}

/// What of the file is wrong with one text for another, and how its message goes on after the file's name.
struct Wrong {
  const char *from, *to, *begin;
};

TEST_F(KnotFile, IsRefusedByFileAndKey) {
  const std::string post = "{through: [0, 0, 30], along: [0, 1, 0], radius: 5";
  const std::string upper = "upper: [upper]\nposts: [" + post + ", grip: upper}]\n", lower = "posts: [" + post + "}]\n",
                    neither = "posts: [" + post + ", grip: up}]\n";
  for (const Wrong& wrong : std::vector<Wrong>{
           {"[lower, lower_tail]", "[upper, lower_tail]", "strands: two ends are called upper"},
           {"[lower, lower_tail]", "[lower]", "strands.0.ends is [lower]"},
           {"upper: [upper]", "upper: [top]", "upper: no end is called top"},
           {"upper: [upper]", "upper: [lower]", "upper: lower is held already"},
           {"upper: [upper]\n", "", "upper: the upper grip must hold at least one end"},
           {"lower: [lower]\n", "", "lower: the lower grip must hold at least one end"},
           {"lower_tail: 1,", "tail: 1,", "tie.0: no end is called tail"},
           {"lower_tail: 1,", "lower: 1,", "tie.0: lower is held by the lower grip"},
           {"lower_tail: 1,", "lower_tail: -1,", "tie.0.lower_tail is -1"},
           {"[0, 1, 0]", "[0, 1]", "strands.0.points.2"},
           {"[0, 1, 0]", "[0, one, 0]", "strands.0.points.2"},
           {"[0, 1, 0]", "[0, 0, -4]", "strands.0.points.2"},
           {"[0, 0, -8]", "[0, 1, -8]", "strands.0"},
           {"use:", "used:", "used"},
           {"upper: [upper]\n", upper.c_str(), "upper: the upper grip must not hold an end"},
           {"upper: [upper]\n", lower.c_str(), "upper: the upper grip must hold at least one end"},
           {"upper: [upper]\n", neither.c_str(), "posts.0.grip is \"up\""},
           {"tie:", "weights: {tail: 1}\ntie:", "weights: no end and no landmark is called tail"},
           {"tie:", "weights: {lower: 1}\ntie:", "weights: lower is held by a grip"},
           {"tie:", "weights: {lower_tail: 0}\ntie:", "weights.lower_tail is 0"},
           {"tie:", "landmarks: {upper: [0, 1]}\ntie:", "landmarks: upper is the name of an end"},
           {"tie:", "landmarks: {bend: [2, 3]}\ntie:", "landmarks.bend.0 is 2"},
           {"tie:", "landmarks: {bend: [0, 6]}\ntie:", "landmarks.bend.1 is 6"},
           {"tie:", "landmarks: {bend: [0, 3]}\nread: {bend: {loop: eye}}\ntie:", "read.bend.loop: no landmark"},
           {"tie:", "landmarks: {bend: [0, 3]}\nread: {bend: {ring: bend}}\ntie:", "read.bend is {ring: bend}"},
           {"tie:", "landmarks: {a: [0, 3], b: [1, 3]}\nread: {way: {between: [a, b]}}\ntie:", "read.way.between: "}})
    EXPECT_THAT(complaint(wrong.from, wrong.to), HasSubstr(std::string("hooks.yaml: ") + wrong.begin)) << wrong.to;
}

TEST_F(KnotFile, SaysWhatIsReadOfTheKnot) {
  EXPECT_EQ(
      complaint("tie:",
                "landmarks: {bend: [0, 3], hook: [1, 3], tip: [0, 5]}\n"
                "read: {bend: {loop: bend}, way: {between: [bend, tip]}, opening: {distance: [bend, hook]}}\ntie:"),
      "");
  const auto knot = read_knot_file(file(), "hooks");
  ASSERT_EQ(knot->landmarks.size(), 3u);
  EXPECT_EQ(knot->landmarks[1].name, "hook");
  EXPECT_EQ(knot->landmarks[1].strand, 1u);
  EXPECT_EQ(knot->landmarks[1].point, 3u);
  ASSERT_EQ(knot->readings.size(), 3u);
  EXPECT_EQ(knot->readings[0].kind, KnotReading::Kind::kLoop);
  EXPECT_EQ(knot->readings[1].kind, KnotReading::Kind::kBetween);
  EXPECT_EQ(knot->readings[1].second, 2u);
  EXPECT_EQ(knot->readings[2].kind, KnotReading::Kind::kDistance);
}

TEST_F(KnotFile, MayBeNamedFromTheFolderOfTheMethod) {
  write(kHooks);
  const std::string text =
      "specimen: {knot: hooks.yaml}\nmaterial: nylon\nmachine: {grips: clamps}\n"
      "program: [pull: {until: {load: 1}}]\n";
  const Method method = parse_method(text, (fs::path(file()).parent_path() / "method.yaml").string());
  ASSERT_TRUE(method.specimen.drawing);
  EXPECT_EQ(method.specimen.drawing->name, file());
  EXPECT_THAT(method_yaml(method), HasSubstr("knot: " + file()));
}

/// Every shipped knot by its name.
std::vector<std::string> shipped_knots() {
  std::vector<std::string> out;
  for (const fs::directory_entry& entry : fs::directory_iterator(std::string(KNOT_UTM_SOURCE_DIR) + "/config/knots"))
    if (entry.path().extension() == ".yaml") out.push_back(entry.path().stem().string());
  return out;
}

TEST(ShippedKnots, SayWhatTheyAreAndFitBetweenTheGripsAtTheirDefaults) {
  EXPECT_GE(shipped_knots().size(), 37u);
  for (const std::string& name : shipped_knots())
    for (const char* accuracy : {"draft", "normal"})
      for (const char* material : {"nylon", "pink_vps", "dyneema_2mm"}) {
        const Method method = load_method(kBend, {"specimen.knot=" + name, std::string("material=") + material,
                                                  std::string("physics.accuracy=") + accuracy});
        const KnotDrawing& knot = *method.specimen.drawing;
        EXPECT_FALSE(knot.title.empty() || knot.use.empty() || knot.source.empty()) << name;
        EXPECT_NO_THROW(specimen_centreline(method.specimen, method.material, method.machine, method.physics))
            << name << ' ' << accuracy;
      }
}

/// The knots of one rope with both ends held are told by their Alexander polynomials at -1.
TEST(ShippedKnots, OfOneRopeBetweenTheGripsAreWhatTheyAreCalled) {
  const std::pair<const char*, std::int64_t> kDeterminants[] = {
      {"overhand_tied", 3}, {"figure_eight", 5}, {"butterfly_loop", 1}, {"dropper_loop", 1},
      {"surgeon_1", 9},     {"surgeon_2", 15},   {"surgeon_3", 21},     {"surgeon_2_2", 25}};
  for (const auto& [name, determinant] : kDeterminants) {
    const Method method = load_method(kBend, {std::string("specimen.knot=") + name});
    const Points rod = specimen_centreline(method.specimen, method.material, method.machine, method.physics).points;
    EXPECT_EQ(knot_determinant(alexander_polynomial(closed_far_away(rod, Vec3::UnitZ()))), determinant) << name;
  }
}

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

}  // namespace
}  // namespace knot_utm
