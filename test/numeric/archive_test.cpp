#include "knot_utm/numeric/archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "knot_utm/numeric/pieces.hpp"
#include "knot_utm/numeric/random.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

enum class Colour { kRed, kGreen, kBlue };

/// One of everything.
struct Things {
  double number = 0.0;
  int whole = 0;
  std::uint64_t count = 0;
  bool flag = false;
  std::string text;
  std::pair<int, double> pair;
  double both[2] = {};
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 2);
  std::vector<int> fixed = std::vector<int>(2);
  std::vector<double> list;
  int node = 0;
  Colour colour = Colour::kRed;

  void state(Archive& archive) {
    archive.section("ALL ");
    archive(number, whole, count, flag, text, pair, both, place, points, fixed);
    archive.list(list);
    archive.number("node", node, 0, 9);
    archive.choice("colour", colour, Colour::kBlue);
  }
};

Things some() {
  Things out;
  out.number = -0.0;
  out.whole = -7;
  out.count = std::numeric_limits<std::uint64_t>::max();
  out.flag = true;
  out.text = std::string("two\nlines and a \0", 17);
  out.pair = {-1, std::nextafter(1.0, 2.0)};
  out.both[0] = std::numeric_limits<double>::infinity();
  out.both[1] = std::numeric_limits<double>::denorm_min();
  out.place << 1.0, 2.0, 3.0;
  out.points << 1, 2, 3, 4, 5, 6;
  out.fixed = {4, 5};
  out.list = {0.1, 0.2, 0.3};
  out.node = 9;
  out.colour = Colour::kGreen;
  return out;
}

std::string saved(Things things, const std::string& kind = "test") {
  Archive archive(kind);
  archive(things);
  return archive.bytes();
}

Things loaded(const std::string& bytes) {
  Things out;
  Archive archive("test", bytes, "file");
  archive(out);
  archive.end();
  return out;
}

/// Empty: it could be loaded.
std::string complaint(const std::string& bytes) {
  try {
    loaded(bytes);
  } catch (const InvalidInput& invalid) {
    EXPECT_EQ(std::string(invalid.what()).find('\n'), std::string::npos) << invalid.what();
    EXPECT_EQ(invalid.file, "file");
    return invalid.what();
  }
  return "";
}

TEST(Archive, LoadsWhatItSaved) {
  const Things expected = some(), found = loaded(saved(some()));
  EXPECT_EQ(found.number, 0.0);
  EXPECT_TRUE(std::signbit(found.number));
  EXPECT_EQ(saved(found), saved(expected));
}

TEST(Archive, IsLittleEndianBehindALineOfText) {
  Archive archive("test");
  int value = 258;
  archive(value);
  const std::string bytes = archive.bytes(), line = bytes.substr(0, bytes.find('\n') + 1);
  EXPECT_THAT(line, testing::MatchesRegex("knot_utm test, version [0-9.]+\n"));
  EXPECT_EQ(bytes.substr(line.size(), 16), std::string("\10\0\0\0\0\0\0\0\2\1\0\0\0\0\0\0", 16));
}

TEST(Archive, TellsEveryDamage) {
  const std::string whole = saved(some());
  ASSERT_EQ(complaint(whole), "");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_NE(complaint(whole.substr(0, i)), "") << "cut at " << i;
    for (const int bit : {0, 3, 7}) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      EXPECT_NE(complaint(damaged), "") << "byte " << i << ", bit " << bit;
    }
  }
  EXPECT_THAT(complaint(whole + "x"), testing::HasSubstr("file: the test cannot be loaded: length: found "));
}

TEST(Archive, TellsAForeignFileAndAnotherKind) {
  EXPECT_THAT(complaint("time,extension\ns,m\n"), testing::HasSubstr("first line: found that of a foreign file"));
  EXPECT_THAT(complaint(saved(some(), "dream")),
              testing::ContainsRegex("first line: found \"knot_utm dream, version .*\", expected \"knot_utm test, "));
  std::string older = saved(some());
  const std::size_t version = older.find("version ") + 8;
  older[version] = static_cast<char>(older[version] + 1);
  EXPECT_THAT(complaint(older), testing::HasSubstr("first line: "));
}

/// Whole files of other things: what does not fit is told.
TEST(Archive, TellsWhatDoesNotFit) {
  const auto complaint_of = [](auto change) {
    Things things = some();
    change(things);
    return complaint(saved(things));
  };
  EXPECT_THAT(complaint_of([](Things& t) { t.points.setZero(3, 5); }),
              testing::HasSubstr("columns: found 5, expected 2"));
  EXPECT_THAT(complaint_of([](Things& t) { t.fixed.resize(3); }), testing::HasSubstr("length: found 3, expected 2"));
  EXPECT_THAT(complaint_of([](Things& t) { t.node = 10; }), testing::HasSubstr("node: found 10"));
  EXPECT_THAT(complaint_of([](Things& t) { t.node = -1; }), testing::HasSubstr("node: found -1"));
  EXPECT_THAT(complaint_of([](Things& t) { t.colour = static_cast<Colour>(3); }),
              testing::HasSubstr("colour: found 3"));

  Archive other("test");
  other.section("NONE");
  EXPECT_THAT(complaint(other.bytes()), testing::HasSubstr("section: found not \"ALL \""));
  EXPECT_THAT(complaint(Archive("test").bytes()), testing::HasSubstr("section: "));
  Archive two("test");
  Things things = some();
  two(things, things);
  EXPECT_THAT(complaint(two.bytes()), testing::HasSubstr("length: "));

  // A list that is longer than the file.
  Archive list("test");
  std::uint64_t length = std::uint64_t{1} << 60;
  list(length);
  Archive in("test", list.bytes(), "file");
  std::vector<double> values;
  EXPECT_THROW(in.list(values), InvalidInput);
  Archive text("test", list.bytes(), "file");
  std::string word;
  EXPECT_THROW(text(word), InvalidInput);
}

/// As a file of shapes has it, which frames it itself.
TEST(Archive, BareIsTheStateAlone) {
  const Things things = some();
  std::string bytes = "before";
  Archive::to(bytes).save(things);
  const std::string file = saved(things), state = bytes.substr(6);
  constexpr std::size_t kSumBytes = 4;
  EXPECT_EQ(bytes.substr(0, 6), "before");
  EXPECT_EQ(state, file.substr(file.size() - kSumBytes - state.size(), state.size()));

  Things found;
  Archive in = Archive::from(state, "test", "file");
  in(found);
  in.end();
  EXPECT_EQ(saved(found), file);
  for (std::size_t cut = 0; cut < state.size(); ++cut) {
    Archive shorter = Archive::from(std::string_view(state).substr(0, cut), "test", "file");
    EXPECT_THROW(shorter(found), InvalidInput) << cut;
  }
  const std::string longer = state + "x";
  Archive more = Archive::from(longer, "test", "file");
  more(found);
  EXPECT_THROW(more.end(), InvalidInput);
}

TEST(Archive, AValueHasOneForm) {
  for (const std::uint64_t bits : {std::uint64_t{2}, std::uint64_t{1} << 31U, ~std::uint64_t{0}}) {
    std::string bytes;
    Archive::to(bytes).save(bits);
    Archive flags = Archive::from(bytes, "test", "file"), wholes = Archive::from(bytes, "test", "file");
    bool flag = false;
    EXPECT_THROW(flags(flag), InvalidInput) << bits;
    int whole = 0;
    if (bits == std::uint64_t{1} << 31U)
      EXPECT_THROW(wholes(whole), InvalidInput);
    else
      EXPECT_NO_THROW(wholes(whole));
  }
}

struct Large {
  double values[100] = {};
  void state(Archive& archive) { archive(values); }
};

TEST(Archive, ALengthAloneTakesNoMemory) {
  std::string bytes;
  Archive::to(bytes).save(std::uint64_t{1000});
  bytes.resize(1008, '\0');
  Archive in = Archive::from(bytes, "test", "file");
  std::vector<Large> list;
  EXPECT_THROW(in.list(list), InvalidInput);
  EXPECT_LE(list.capacity() * sizeof(Large), 2 * bytes.size());
}

constexpr int kDraws = 100000;

/// Moments of the normal distribution are 0, 1, 0 and 3. The mean of n draws of z^k has the standard error
/// sqrt(var(z^k)/n), var being 1, 2, 15 and 96; five of them are exceeded once in a million.
TEST(Random, NormalNumbersHaveTheMomentsOfTheNormalDistribution) {
  std::mt19937_64 random(7);
  double sums[4] = {};
  for (int i = 0; i < kDraws; ++i) {
    const double z = standard_normal(random);
    for (int k = 0; k < 4; ++k) sums[k] += std::pow(z, k + 1);
  }
  const double moments[4] = {0.0, 1.0, 0.0, 3.0}, variances[4] = {1.0, 2.0, 15.0, 96.0};
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(sums[k] / kDraws, moments[k], 5.0 * std::sqrt(variances[k] / kDraws)) << k;
}

/// Neighbouring seeds, numbers and names are no neighbours in what they give.
TEST(Random, SequencesOfDifferentSeedNumberOrNameAreUncorrelated) {
  const auto first = [](std::uint64_t seed, std::uint64_t number, const std::string& name) {
    std::mt19937_64 random = sequence_of(seed, number, name);
    return uniform(random) - 0.5;
  };
  double by_seed = 0.0, by_number = 0.0, by_name = 0.0, mean = 0.0;
  constexpr int kSequences = 20000;
  for (std::uint64_t i = 0; i < kSequences; ++i) {
    const double here = first(i, 1, "specimen.tail");
    mean += here;
    by_seed += here * first(i + 1, 1, "specimen.tail");
    by_number += here * first(i, 2, "specimen.tail");
    by_name += here * first(i, 1, "specimen.tai");
  }
  // A product of two independent numbers has the variance 1/144.
  const double five_errors = 5.0 / std::sqrt(144.0 * kSequences);
  for (const double product : {by_seed, by_number, by_name}) EXPECT_NEAR(product / kSequences, 0.0, five_errors);
  EXPECT_NEAR(mean / kSequences, 0.0, 5.0 / std::sqrt(12.0 * kSequences));
}

TEST(Pieces, LieBetweenTheMissingEdges) {
  const std::vector<Piece> pieces = pieces_between(10, {3, 4, 8});
  ASSERT_EQ(pieces.size(), 4u);
  const Eigen::Index begins[] = {0, 4, 5, 9}, ends[] = {4, 5, 9, 10};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    EXPECT_EQ(pieces[i].begin, begins[i]);
    EXPECT_EQ(pieces[i].end, ends[i]);
  }
  EXPECT_EQ(pieces_between(10, {}).size(), 1u);
  EXPECT_EQ(pieces_between(10, {9, 12}).size(), 1u);
}

TEST(Pieces, AreAsLongAsTheirEdges) {
  Points points = Points::Zero(3, 5);
  points.row(1) << 0.0, 1.0, 3.0, 10.0, 10.5;
  EXPECT_EQ(length_of_pieces(points, {}), 10.5);
  EXPECT_EQ(length_of_pieces(points, {2}), 3.5);
  EXPECT_EQ(length_of_pieces(points, {0, 2}), 2.5);
}

}  // namespace
}  // namespace knot_utm
