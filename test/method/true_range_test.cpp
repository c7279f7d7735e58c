// What a message says is allowed is allowed, and what lies just outside of it is not: of every number of every kind of
// method.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/limit_text.hpp"
#include "knot_utm/numeric/number.hpp"

namespace knot_utm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kInside = 2e-3, kOutside = 0.05;  // of a limit

std::string shipped(const std::string& name) { return std::string(KNOT_UTM_SOURCE_DIR) + "/config/" + name + ".yaml"; }

/// A method that is tried with other values of single keys.
struct Tried {
  std::string file;
  std::vector<std::string> overrides;

  /// Why the value is refused; nothing where it is not, or where that is for another key beside it.
  std::optional<std::string> refusal(const std::string& key, double value) const {
    std::vector<std::string> with = overrides;
    with.push_back(key + "=" + format_yaml_number(value));
    try {
      const Method method = load_method(file, with);
      // Only laying the rod refuses some of these, which takes long where it has many edges.
      const SpecimenOptions& rod = method.specimen;
      const bool few_edges =
          std::max({rod.length, rod.end_to_end, rod.knot_distance, rod.tail}) < 8000.0 * rod.edge_length;
      if (few_edges && (key.rfind("specimen.", 0) == 0 || key == "machine.roller_diameter"))
        TestingMachine(method.specimen, method.material, method.machine, method.physics);
    } catch (const InvalidInput& invalid) {
      const std::string why = invalid.what();
      const bool without_effect = why.find("has an effect only") != std::string::npos;
      return is_of(invalid.key, key) && !without_effect ? std::optional<std::string>(why) : std::nullopt;
    }
    return std::nullopt;
  }

  /// Messages name a step by its number, too: "program.4.pull.speed" of "program.pull.speed".
  static bool is_of(const std::string& said, const std::string& key) {
    return said == key || std::regex_replace(said, std::regex("^program\\.\\d+\\."), "program.") == key;
  }
};

/// What a message allows. The ends themselves are allowed unless it says "more than" or "less than".
struct Said {
  double low = -kInfinity, high = kInfinity;
  bool above_low = false, below_high = false, whole = false;

  explicit Said(const std::string& message) {
    const std::string text = message.substr(message.find("must be "));
    whole = text.find("a whole number") != std::string::npos;
    const std::string number = "(-?[0-9.]+(?:e[-+]?[0-9]+)?)";
    // A number, or words that say what it is and then the number.
    const std::regex limits("(at least|at most|more than|less than) (?:\\d+ radii, |[^0-9:]*, )?" + number),
        ranges(number + " (?:to|or) " + number);
    for (std::sregex_iterator one(text.begin(), text.end(), ranges), end; one != end; ++one) {
      raise((*one)[1], false);
      lower((*one)[2], false);
    }
    for (std::sregex_iterator one(text.begin(), text.end(), limits), end; one != end; ++one) {
      const std::string words = (*one)[1];
      if (words == "at least" || words == "more than") raise((*one)[2], words == "more than");
      if (words == "at most" || words == "less than") lower((*one)[2], words == "less than");
    }
  }

  double just_inside_low() const { return above_low ? low + step(low, kInside) : low; }
  double just_outside_low() const { return low - step(low, kOutside); }
  double just_inside_high() const { return below_high ? high - step(high, kInside) : high; }
  double just_outside_high() const { return high + step(high, kOutside); }

 private:
  double step(double end, double share) const { return whole ? 1.0 : end == 0.0 ? share : share * std::abs(end); }
  void raise(const std::string& to, bool above) {
    if (*parse_number(to) <= low) return;
    low = *parse_number(to);
    above_low = above;
  }
  void lower(const std::string& to, bool below) {
    if (*parse_number(to) >= high) return;
    high = *parse_number(to);
    below_high = below;
  }
};

void expect_true(const Tried& tried, const std::string& key, int& judged) {
  const std::optional<std::string> message = tried.refusal(key, 1e30);
  if (!message || message->find("must be ") == std::string::npos || message->find("a list") != std::string::npos)
    return;
  const Said said(*message);
  ++judged;
  if (std::isfinite(said.low)) {
    EXPECT_FALSE(tried.refusal(key, said.just_inside_low())) << *message;
    EXPECT_TRUE(tried.refusal(key, said.just_outside_low())) << *message;
  }
  if (std::isfinite(said.high)) {
    EXPECT_FALSE(tried.refusal(key, said.just_inside_high())) << *message;
    EXPECT_TRUE(tried.refusal(key, said.just_outside_high())) << *message;
  }
}

/// All numbers of a method that begin with one of these words.
void expect_true_ranges(const Tried& tried, const std::vector<std::string>& sections, int at_least) {
  int judged = 0;
  for (const KeyUnit& one : key_units(load_method(tried.file, tried.overrides)))
    for (const std::string& section : sections)
      // Steps stand there by their numbers, too, which a message names.
      if (one.key.rfind(section, 0) == 0 && !std::regex_search(one.key, std::regex("^program\\.\\d")))
        expect_true(tried, one.key, judged);
  EXPECT_GE(judged, at_least) << tried.file;
}

const std::vector<std::string> kAll{"specimen.", "material.", "machine.", "program.", "ends.", "physics."};
const std::vector<std::string> kOfTheSpecimen{"specimen.", "program."};

TEST(TrueRange, OfALoopAndItsMachine) {
  const std::vector<std::string> with{"ends.break_at_fraction_of_peak=0.5", "machine.roller_friction=0.1",
                                      "machine.roller_rotation=free"};
  expect_true_ranges({shipped("tighten"), with}, kAll, 60);
}

TEST(TrueRange, OfEveryOtherKnot) {
  expect_true_ranges({shipped("double_fisherman"), {}}, {"specimen.turns", "specimen.tail"}, 2);
  expect_true_ranges({shipped("overhand"), {}},
                     {"specimen.edge_length", "specimen.refinement", "specimen.turns", "program."}, 4);
  // The room for its knot follows from specimen.end_to_end and specimen.length together.
  for (const char* length : {"0.6", "1"})
    for (const char* turns : {"1", "2"})
      expect_true_ranges({shipped("overhand"),
                          {std::string("specimen.length=") + length, std::string("specimen.turns=") + turns,
                           "specimen.edge_length=0.006", "specimen.refinement=1", "specimen.end_to_end=auto"}},
                         {"specimen.end_to_end"}, 1);
  expect_true_ranges({shipped("straight"), {}}, kOfTheSpecimen, 3);
  expect_true_ranges({shipped("capstan"), {}}, kOfTheSpecimen, 6);
  expect_true_ranges({shipped("from_file"), {"material.bending_law=elastic"}}, kOfTheSpecimen, 4);
}

TEST(TrueRange, OfLawsWithKeysOfTheirOwn) {
  expect_true_ranges({shipped("straight"), {"physics.friction={law: smoothed}"}}, {"physics.friction."}, 1);
  expect_true_ranges({shipped("straight"), {"physics.friction={law: power, exponent: 0.9, reference_pressure: 100}"}},
                     {"physics.friction."}, 2);
}

TEST(TrueRange, AThinAndAThickRod) {
  for (const char* radius : {"0.000137", "0.0137"})
    expect_true_ranges({shipped("tighten"),
                        {std::string("material={radius: ") + radius +
                             ", density: 1100, stretching_stiffness: 2e4, bending_stiffness: 2e-5, twisting_stiffness: "
                             "2e-5, friction_coefficient: 0.3}",
                         "specimen={knot: fisherman}", "machine={}"}},
                       {"specimen."}, 4);
}

TEST(LimitText, StaysOnTheAllowedSide) {
  for (const double limit : {0.00015875, 1.46497, 0.41138, 123456.0, 9.9999, 1e-300, -2.71828, 5e4, 1.0 / 3.0})
    for (const int digits : {2, 3, 4, 6}) {
      const double least = *parse_number(least_text(limit, digits)), most = *parse_number(most_text(limit, digits));
      EXPECT_GE(least, limit) << digits;
      EXPECT_LE(most, limit) << digits;
      EXPECT_NEAR(least, limit, std::abs(limit) * std::pow(10.0, 1 - digits));
      EXPECT_NEAR(most, limit, std::abs(limit) * std::pow(10.0, 1 - digits));
    }
  EXPECT_EQ(least_text(0.00015875), "0.0001588");
  EXPECT_EQ(most_text(0.00635), "0.00635");
  EXPECT_EQ(limits_text(1.00001, 1.00002), "1.00001 to 1.00002");
}

}  // namespace
}  // namespace knot_utm
