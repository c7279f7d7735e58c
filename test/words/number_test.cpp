#include "knot_utm/words/number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Number, ShortestTextReadsBackToTheSameBits) {
  for (const double value : {0.1, 1.0 / 3.0, -2.5e-300, 1e22, 5e-324, 0.0, 123456789.123456789}) {
    EXPECT_EQ(parse_number(format_number(value)), value);
    EXPECT_EQ(parse_number(format_yaml_number(value)), value);
  }
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(1e-4), "1e-04");
  EXPECT_EQ(format_yaml_number(1e-4), "1.0e-04");
  EXPECT_EQ(format_yaml_number(3.5e-7), "3.5e-07");
}

TEST(Number, WhatIsNoOrdinaryNumber) {
  EXPECT_EQ(format_number(std::nan("")), "nan");
  EXPECT_EQ(format_yaml_number(std::nan("")), ".nan");
  EXPECT_EQ(format_yaml_number(-kInfinity), "-.inf");
  EXPECT_EQ(parse_number(".inf"), kInfinity);
  EXPECT_TRUE(std::isnan(parse_number("nan").value()));
  for (const char* text : {"", "1 N", "0,1", "0x10", "1e", "infinity", "--1", "+-1", "++1", "1.2.3"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

TEST(Number, OfThreeDigitsIsPlainWherePeopleWriteItSo) {
  for (const auto& [value, text] :
       {std::pair{1000.5, "1000"}, std::pair{-1968.4, "-1970"}, std::pair{999.9, "1000"}, std::pair{123456.0, "123000"},
        std::pair{1e5, "100000"}, std::pair{0.12345, "0.123"}, std::pair{1.5e6, "1.5e+06"}, std::pair{2e-7, "2e-07"},
        std::pair{-0.0, "0"}})
    EXPECT_EQ(short_number(value), text);
  EXPECT_EQ(short_number(-kInfinity), "-inf");
}

const std::vector<std::string> kKeys{"knot", "handedness", "preload", "edge_length", "refinement", "tail"};

TEST(KnownNames, AreListedAsOneSaysThem) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"a"}), "a");
  EXPECT_EQ(listed({"a", "b"}), "a or b");
  EXPECT_EQ(listed({"a", "b", "c"}, " and "), "a, b and c");
}

TEST(KnownNames, AMisspeltOneIsTakenForTheNearest) {
  EXPECT_EQ(nearest_name("prelaod", kKeys), "preload");  // swapped
  EXPECT_EQ(nearest_name("pre_load", kKeys), "preload");
  EXPECT_EQ(nearest_name("Preload", kKeys), "preload");
  EXPECT_EQ(nearest_name("edgelength", kKeys), "edge_length");
  EXPECT_EQ(nearest_name("refinment", kKeys), "refinement");
  EXPECT_EQ(nearest_name("knots", kKeys), "knot");
  EXPECT_EQ(nearest_name("tial", kKeys), "tail");
}

TEST(KnownNames, WhatIsNearNoneIsTakenForNone) {
  EXPECT_EQ(nearest_name("", kKeys), "");
  EXPECT_EQ(nearest_name("speed", kKeys), "");
  EXPECT_EQ(nearest_name("no", kKeys), "");
  EXPECT_EQ(nearest_name("preload", {}), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'x'), kKeys), "");
}

}  // namespace
}  // namespace knot_utm
