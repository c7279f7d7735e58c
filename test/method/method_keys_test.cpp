#include "knot_utm/method/method_keys.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "knot_utm/contact/friction.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {
namespace {

TEST(MethodKeys, StandThereOnceAndHaveALabelAndAUnit) {
  std::set<std::string> seen;
  for (const MethodKey& one : method_keys()) {
    EXPECT_TRUE(seen.insert(one.key).second) << one.key;
    EXPECT_NE(one.label, "") << one.key;
    EXPECT_NE(one.unit, "") << one.key;
  }
}

TEST(MethodKeys, AreThoseOfEveryKnotLawAndStep) {
  const std::vector<MethodKey> keys = method_keys();
  const auto unit_of = [&](const std::string& key) {
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const MethodKey& one) { return one.key == key; });
    return found == keys.end() ? "no such key" : found->unit;
  };
  for (const Knot* knot : knots()) {
    EXPECT_STRNE(knot->about().title, "") << knot->about().name;
    for (const std::string& key : knot->about().keys) EXPECT_NE(unit_of("specimen." + key), "no such key") << key;
  }
  for (const LawKey& key : FrictionRegistry::keys())
    EXPECT_EQ(unit_of(std::string("physics.friction.") + key.name), key.unit);
  for (const LawKey& key : BendingRegistry::keys()) EXPECT_EQ(unit_of(std::string("material.") + key.name), key.unit);
  for (const char* step : {"tie", "mount", "preload", "pull", "hold", "cycle", "return"})
    EXPECT_EQ(unit_of(std::string("program.") + step + ".speed"), "m/s") << step;
  EXPECT_EQ(unit_of("program.pull.until.load"), "N");
  EXPECT_EQ(unit_of("program.cycle.extension"), "m");
}

}  // namespace
}  // namespace knot_utm
