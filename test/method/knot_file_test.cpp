// Knots from files: what a file says, and each line with which one is refused.

#include "knot_utm/method/knot_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "knot_utm/machine/specimen_centreline.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/topology/knot_invariants.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

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

class KnotFile : public ::testing::Test {
 protected:
  KnotFile()
      : folder_(fs::path(::testing::TempDir()) /
                (std::string("knot_utm_knot_") + ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~KnotFile() override { fs::remove_all(folder_); }

  std::string file() const { return (folder_ / "hooks.yaml").string(); }
  void write(const std::string& text) const { std::ofstream(file()) << text; }

  /// What is said of the file with one text for another.
  std::string complaint(const std::string& from, const std::string& to) const {
    std::string text = kHooks;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    write(text.replace(at, from.size(), to));
    try {
      read_knot_file(file(), "hooks");
    } catch (const InvalidInput& refused) {
      return refused.what();
    }
    return "";
  }

 private:
  fs::path folder_;
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

const std::string kPost = "posts: [{through: [0, 0, 30], along: [0, 1, 0], radius: 5, grip: upper}]\n";

const char* const kReadHooks = R"(landmarks: {bend: [0, 3], hook: [1, 3], tip: [0, 5]}
read:
  bend: {loop: bend}
  way: {between: [bend, tip]}
  opening: {distance: [bend, hook]}
tie:)";

/// One text of the file, or of what it reads of the knot, for another, and where the one line says what is wrong.
struct Wrong {
  std::string from, to;
  const char* says;
};

TEST_F(KnotFile, IsRefusedByOneLineWithFileAndKey) {
  const std::string upper = "upper: [upper]\n", lower = "lower: [lower]\n";
  for (const auto& [from, to, says] : std::vector<Wrong>{
           {"[lower, lower_tail]", "[upper, lower_tail]", "hooks.yaml: strands: two ends are called upper"},
           {"[lower, lower_tail]", "[lower]", "strands.0.ends is [lower]"},
           {upper, "upper: [top]\n", "upper: no end is called top"},
           {upper, "upper: [lower]\n", "upper: lower is held already"},
           {upper, "", "upper: the upper grip must hold"},
           {lower, "", "lower: the lower grip must hold"},
           {"lower_tail: 1,", "tail: 1,", "tie.0: no end is called tail"},
           {"lower_tail: 1,", "lower: 1,", "tie.0: lower is held by the lower grip"},
           {"lower_tail: 1,", "upper_tail: 1,", "tie.0: upper_tail is pulled already"},
           {"lower_tail: 1,", "lower_tail: -1,", "tie.0.lower_tail is -1"},
           {"[0, 1, 0]", "[0, one, 0]", "strands.0.points.2"},
           {"[0, 1, 0]", "[0, 0, -4]", "the same point as the one before it"},
           {"[0, 0, -8]", "[0, 1, -8]", "must lead straight down along z"},
           {"use:", "used:", "used"},
           {"Two hooks", "\"Two\\nhooks\"", "title: it must be one line"},
           {upper, upper + kPost, "upper: the upper grip must not hold an end where a post"},
           {upper, "posts: [{through: [0, 0, 30], along: [0, 1, 0], radius: 5, grip: up}]\n", "posts.0.grip is \"up\""},
           {lower, "posts: [{through: [9, 0, 0], along: [0, 0, 1], radius: 2, ring: 3}]\n", "posts.0.ring is 3"},
           {"tie:", "weights: {tail: 1}\ntie:", "weights: no end and no landmark is called tail"},
           {"tie:", "weights: {lower: 1}\ntie:", "weights: lower is held by a grip"},
           {"tie:", "weights: {lower_tail: 0}\ntie:", "weights.lower_tail is 0"},
           {"tie:", "landmarks: {upper: [0, 1]}\ntie:", "landmarks: upper is the name of an end"}})
    EXPECT_THAT(complaint(from, to), HasSubstr(says));
  for (const auto& [from, to, says] :
       std::vector<Wrong>{{"[0, 3]", "[2, 3]", "hooks.yaml: landmarks.bend.0 is 2"},
                          {"[0, 3]", "[0, 6]", "landmarks.bend.1 is 6"},
                          {"[0, 3]", "3", "landmarks.bend is 3"},
                          {"{loop: bend}", "{loop: eye}", "read.bend.loop: no landmark is called eye"},
                          {"{loop: bend}", "{ring: bend}", "read.bend is {ring: bend}"},
                          {"[bend, tip]", "[bend, hook]", "read.way.between: both landmarks must be of one strand"},
                          {"[bend, tip]", "[bend, bend]", "read.way.between: it must have two landmarks that differ"},
                          {"[bend, tip]", "[bend]", "read.way.between is [bend]"},
                          {"  way:", "  a: {loop: tip}\n  b: {loop: tip}\n  way:", "read.opening: at most 4"}}) {
    std::string lines = kReadHooks;
    EXPECT_THAT(complaint("tie:", lines.replace(lines.find(from), from.size(), to)), HasSubstr(says));
  }
}

TEST_F(KnotFile, MayStandOnPostsOfEitherGripAndBearWeights) {
  EXPECT_EQ(complaint("upper: [upper]\n", kPost + "landmarks: {eye: [0, 3]}\nweights: {upper: 0.5, eye: 1}\n"), "");
  const auto knot = read_knot_file(file(), "hooks");
  EXPECT_TRUE(knot->posts.front().upper);
  EXPECT_EQ(knot->top(), 30.0);
  ASSERT_EQ(knot->weights.size(), 2u);
  EXPECT_EQ(knot->weights.front().fraction, 0.5);
}

TEST_F(KnotFile, MayPullEndsOfTheUpperGripAndAnEndAgainInALaterGroup) {
  EXPECT_EQ(complaint("upper_tail: 0.5}", "upper: 2}\n  - {upper: 1, lower_tail: 0.5}"), "");
  const auto knot = read_knot_file(file(), "hooks");
  ASSERT_EQ(knot->tie.size(), 2u);
  EXPECT_EQ(knot->tie[0][1].end, "upper");
  EXPECT_EQ(knot->tie[1][0].end, "upper");
  EXPECT_EQ(knot->tie[1][1].fraction, 0.5);
}

TEST_F(KnotFile, SaysWhatIsReadOfTheKnot) {
  EXPECT_EQ(complaint("tie:", kReadHooks), "");
  const auto knot = read_knot_file(file(), "hooks");
  ASSERT_EQ(knot->landmarks.size(), 3u);
  EXPECT_EQ(knot->landmarks[1].name, "hook");
  EXPECT_EQ(knot->landmarks[1].strand, 1u);
  EXPECT_EQ(knot->landmarks[1].point, 3u);
  ASSERT_EQ(knot->read.size(), 3u);
  EXPECT_EQ(knot->read[0].kind, KnotReading::Kind::kLoop);
  EXPECT_EQ(knot->read[1].kind, KnotReading::Kind::kBetween);
  EXPECT_EQ(knot->read[1].second, 2u);
  EXPECT_EQ(knot->read[2].kind, KnotReading::Kind::kDistance);
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

TEST(KnotFileName, ThatNobodyKnowsIsRefusedWithTheOneThatMayBeMeant) {
  try {
    load_method(kBend, {"specimen.knot=reeff"});
    FAIL();
  } catch (const InvalidInput& refused) {
    EXPECT_THAT(refused.what(), HasSubstr("specimen.knot"));
    EXPECT_THAT(refused.what(), HasSubstr("--list knots"));
    EXPECT_THAT(refused.what(), HasSubstr("reef"));
  }
}

/// What each shipped knot is made of. A new one is a file and a line here.
struct Shipped {
  const char* name;
  std::size_t ropes, free_ends, posts;
};
const Shipped kShipped[] = {
    {"bowline", 1, 1, 1},
    {"butterfly_bend", 2, 2, 0},
    {"butterfly_loop", 1, 0, 0},
    {"carrick", 2, 2, 0},
    {"clove_hitch", 1, 1, 1},
    {"double_fisherman_bend", 2, 2, 0},
    {"double_sheet_bend", 2, 2, 0},
    {"dropper_loop", 1, 0, 0},
    {"figure_eight", 1, 0, 0},
    {"figure_eight_bend", 2, 2, 0},
    {"figure_eight_stopper", 1, 1, 1},
    {"fisherman_bend", 2, 2, 0},
    {"flat_overhand", 2, 2, 0},
    {"granny", 2, 2, 0},
    {"grief", 2, 2, 0},
    {"overhand_stopper", 1, 1, 1},
    {"overhand_tied", 1, 0, 0},
    {"prusik", 2, 1, 0},
    {"reef", 2, 2, 0},
    {"round_turn", 1, 1, 1},
    {"sheet_bend", 2, 2, 0},
    {"shoelace_bow", 2, 2, 0},
    {"simple_simon_crossover", 2, 2, 0},
    {"simple_simon_double", 2, 2, 0},
    {"simple_simon_over", 2, 2, 0},
    {"simple_simon_under", 2, 2, 0},
    {"square_3", 2, 2, 0},
    {"square_4", 2, 2, 0},
    {"surgeon", 2, 2, 0},
    {"surgeon_1", 1, 0, 0},
    {"surgeon_2", 1, 0, 0},
    {"surgeon_2_2", 1, 0, 0},
    {"surgeon_3", 1, 0, 0},
    {"thief", 2, 2, 0},
    {"triple_fisherman_bend", 2, 2, 0},
    {"two_strands", 2, 0, 0},
    {"zeppelin", 2, 2, 0},
};

TEST(ShippedKnots, AreThoseOfTheListAndWhatItSays) {
  std::size_t files = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(std::string(KNOT_UTM_SOURCE_DIR) + "/config/knots"))
    files += entry.path().extension() == ".yaml" ? 1 : 0;
  EXPECT_EQ(files, std::size(kShipped));
  for (const Shipped& shipped : kShipped) {
    const Method method = load_method(kBend, {std::string("specimen.knot=") + shipped.name});
    const KnotDrawing& knot = *method.specimen.drawing;
    EXPECT_EQ(knot.name, shipped.name);
    EXPECT_EQ(knot.strands.size(), shipped.ropes) << shipped.name;
    EXPECT_EQ(2 * knot.strands.size() - knot.lower.size() - knot.upper.size(), shipped.free_ends) << shipped.name;
    EXPECT_EQ(knot.posts.size(), shipped.posts) << shipped.name;
    EXPECT_FALSE(knot.title.empty() || knot.use.empty() || knot.source.empty()) << shipped.name;
  }
}

TEST(ShippedKnots, FitBetweenTheGripsAtTheirDefaults) {
  for (const Shipped& shipped : kShipped)
    for (const char* accuracy : {"draft", "normal"})
      for (const char* material : {"nylon", "pink_vps", "dyneema_2mm"}) {
        const Method method =
            load_method(kBend, {std::string("specimen.knot=") + shipped.name, std::string("material=") + material,
                                std::string("physics.accuracy=") + accuracy});
        EXPECT_NO_THROW(specimen_centreline(method.specimen, method.material, method.machine, method.physics))
            << shipped.name << ' ' << accuracy;
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

}  // namespace
}  // namespace knot_utm
