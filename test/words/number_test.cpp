#include "knot_utm/words/number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/text_rows.hpp"

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

const std::vector<std::string> kKeys{"knot", "handedness", "preload", "edge_length", "refinement", "tail"};

TEST(KnownNames, AMisspeltOneIsTakenForTheNearest) {
  EXPECT_EQ(nearest_name("prelaod", kKeys), "preload");  // swapped
  EXPECT_EQ(nearest_name("pre_load", kKeys), "preload");
  EXPECT_EQ(nearest_name("Preload", kKeys), "preload");
  EXPECT_EQ(nearest_name("edgelength", kKeys), "edge_length");
  EXPECT_EQ(nearest_name("refinment", kKeys), "refinement");
  EXPECT_EQ(nearest_name("knots", kKeys), "knot");
  EXPECT_EQ(nearest_name("tial", kKeys), "tail");
  EXPECT_EQ(nearest_name("odga_lungth", kKeys), "edge_length") << "three mistakes in a long name";
}

TEST(KnownNames, WhatIsNearNoneIsTakenForNone) {
  EXPECT_EQ(nearest_name("", kKeys), "");
  EXPECT_EQ(nearest_name("speed", kKeys), "");
  EXPECT_EQ(nearest_name("prolaud", kKeys), "") << "three mistakes in a shorter one";
  EXPECT_EQ(nearest_name("no", kKeys), "");
  EXPECT_EQ(nearest_name("preload", {}), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'x'), kKeys), "");
}

TEST(TextRows, AreCountedWithOrWithoutALastLineEnd) {
  for (const char* text : {"a\n\nb", "a\n\nb\n"}) {
    std::istringstream in(text);
    TextRows rows(in);
    for (const char* row : {"a", "", "b"}) {
      ASSERT_TRUE(rows.next());
      EXPECT_EQ(rows.text(), row);
    }
    EXPECT_EQ(rows.number(), 3u);
    EXPECT_FALSE(rows.next());
    EXPECT_EQ(rows.fault(), "");
  }
}

TEST(TextRows, OfAFileThatIsNotThereAreNone) {
  std::istringstream in;
  in.setstate(std::ios::failbit);
  EXPECT_FALSE(TextRows(in).next());
}

/// A text without end: no more of it is read than the bounds let through.
class Endless : public std::streambuf {
 public:
  explicit Endless(std::size_t row) : text_(row, 'x') { text_ += '\n'; }

 protected:
  int_type underflow() override {
    setg(text_.data(), text_.data(), text_.data() + text_.size());
    return traits_type::to_int_type(text_.front());
  }

 private:
  std::string text_;
};

TEST(TextRows, EndWhereABoundIsPassed) {
  Endless many(0), wide(5000);
  std::istream many_in(&many), wide_in(&wide);
  TextRows many_rows(many_in), wide_rows(wide_in);
  std::size_t count = 0;
  while (many_rows.next()) ++count;
  EXPECT_EQ(count, 2000000u);
  EXPECT_EQ(many_rows.fault(), "there are more than 2000000 rows");
  EXPECT_FALSE(many_rows.next());
  EXPECT_FALSE(wide_rows.next());
  EXPECT_EQ(wide_rows.fault(), "row 1 is longer than 4096 characters");
}

}  // namespace
}  // namespace knot_utm
