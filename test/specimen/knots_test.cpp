#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {
namespace {

/// The machine follows these, and lets those among them that are no loop pull without drag. A shape from a file is one
/// of them, since nobody knows what its file holds.
TEST(Knots, AllButAStraightRodAndAStrandOnPostsMayHoldAKnot) {
  for (const char* name : {"fisherman", "overhand", "file"})
    EXPECT_TRUE(knot_of(knot_named(name)).about().may_hold_a_knot()) << name;
  for (const char* name : {"straight", "capstan"})
    EXPECT_FALSE(knot_of(knot_named(name)).about().may_hold_a_knot()) << name;
}

TEST(Knots, HaveANameAndTheirKeysInTheReport) {
  std::ifstream file(std::string(KNOT_UTM_SOURCE_DIR) + "/report/method_facts.py");
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  for (const char* table : {"OF_KNOT = {", "KNOTS = {"}) {
    const std::size_t begin = text.find(std::string("\n") + table);
    ASSERT_NE(begin, std::string::npos) << table;
    const std::string entries = text.substr(begin, text.find('}', begin) - begin);
    for (const Knot* knot : knots())
      EXPECT_NE(entries.find('"' + std::string(knot->about().name) + "\":"), std::string::npos)
          << table << " " << knot->about().name;
  }
}

}  // namespace
}  // namespace knot_utm
