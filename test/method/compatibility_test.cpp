// Defaults of release 1 (`compatibility: 1`), and keys that another choice leaves without effect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/verdict/foreseen.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kConfig = std::string(KNOT_UTM_SOURCE_DIR) + "/config/";
const std::string kTighten = kConfig + "tighten.yaml";

std::string law_of(const Method& method) { return BendingRegistry::entry(method.material.bending.law).name; }

TEST(Compatibility, HasShippedMaterialsOfTheFirstRelease) {
  int with_law = 0, that_resist = 0;
  for (const auto& file : fs::directory_iterator(kConfig + "materials")) {
    const std::string name = file.path().stem().string();
    const Method now = load_method(kTighten, {"material=" + name});
    EXPECT_EQ(now.material.friction_couple, 1.0) << name;
    with_law += law_of(now) != "elastic" ? 1 : 0;
    that_resist += now.material.rolling_resistance > 0.0 ? 1 : 0;
    // A key inside the material changes a copy of it, of which the same holds.
    for (const char* more : {"specimen.handedness=same", "material.density=1000", "material.friction_couple=auto"}) {
      const Method then = load_method(kTighten, {"material=" + name, more, "compatibility=1"});
      EXPECT_EQ(then.material.friction_couple, 0.0) << name << ' ' << more;
      EXPECT_EQ(then.material.rolling_resistance, 0.0) << name << ' ' << more;
      EXPECT_EQ(law_of(then), "elastic") << name << ' ' << more;
      EXPECT_EQ(then.material.stretching_stiffness, now.material.stretching_stiffness) << name;
    }
  }
  EXPECT_GT(with_law, 0);
  EXPECT_GT(that_resist, 0);
}

TEST(Compatibility, IsWrittenAndReadBack) {
  for (const std::vector<std::string>& set : {std::vector<std::string>{}, {"compatibility=1"}}) {
    const std::string text = method_yaml(load_method(kTighten, set));
    EXPECT_EQ(method_yaml(parse_method(text, "method.yaml")), text);
    EXPECT_EQ(text.find("compatibility: 1") != std::string::npos, !set.empty());
  }
  const Method without = load_method(kTighten, {"compatibility=none"});
  EXPECT_EQ(method_yaml(without), method_yaml(load_method(kTighten)));
}

TEST(Compatibility, LeavesWhatTheMethodSaysOfItsMaterial) {
  const Method set =
      load_method(kTighten, {"compatibility=1", "material.friction_couple=1", "material.rolling_resistance=0.2",
                             "material.bending_law=frictional", "material.friction_moment=0.1"});
  EXPECT_EQ(set.material.friction_couple, 1.0);
  EXPECT_EQ(set.material.rolling_resistance, 0.2);
  EXPECT_EQ(set.material.bending.value("friction_moment"), 0.1);
  EXPECT_EQ(set.material.bending.value("compaction"), 0.0) << "that of the shipped file is of a later release";
}

TEST(Compatibility, LeavesOwnMaterials) {
  const fs::path folder = fs::path(::testing::TempDir()) / "knot_utm_compatibility";
  fs::create_directories(folder / "materials");
  fs::copy_file(kTighten, folder / "mine.yaml", fs::copy_options::overwrite_existing);
  fs::copy_file(kConfig + "materials/nylon.yaml", folder / "materials/nylon.yaml",
                fs::copy_options::overwrite_existing);
  const Method mine = load_method((folder / "mine.yaml").string(), {"compatibility=1"});
  EXPECT_EQ(law_of(mine), "frictional");
  EXPECT_EQ(mine.material.friction_couple, 0.0);
  fs::remove_all(folder);
}

/// What a nearer choice leaves without effect goes, whether a file of a material gave it or the method.
TEST(OverruledKeys, OfAFormerLawGo) {
  const std::string own =
      "material={radius: 1e-3, density: 1000, stretching_stiffness: 1e4, bending_stiffness: 1e-6, twisting_stiffness: "
      "1e-6, friction_coefficient: 0.4, bending_law: frictional, friction_moment: 0.05, rolling_resistance: 0.1}";
  for (const std::string& material : {std::string("material=nylon"), own}) {
    const std::string elastic = method_yaml(load_method(kTighten, {"material.bending_law=elastic", material}));
    EXPECT_THAT(elastic, Not(AnyOf(HasSubstr("friction_moment"), HasSubstr("stick_ratio"), HasSubstr("compaction"))));
  }
  const std::string power =
      method_yaml(load_method(kTighten, {"physics.friction={law: power, exponent: 0.9, reference_pressure: 100}"}));
  const std::string memory = method_yaml(parse_method(power, "method.yaml", {"physics.friction.law=memory"}));
  EXPECT_EQ(memory, method_yaml(parse_method(method_yaml(load_method(kTighten)), "method.yaml")));
}

/// A soft rod is taken as round by a method that needs it so.
TEST(OverruledKeys, OfASectionThatMustBeRoundGo) {
  ASSERT_TRUE(load_method(kTighten, {"material=pink_vps"}).material.is_soft());
  for (const char* needs : {"material.friction_couple=0", "physics.friction.at=centreline", "physics.contact.law=edge",
                            "material.stretching_stiffness=1700"}) {
    const Method method = load_method(kTighten, {"material=pink_vps", "material.rolling_hysteresis=0", needs});
    EXPECT_FALSE(method.material.is_soft()) << needs;
    EXPECT_THAT(method.overruled, testing::ElementsAre(HasSubstr("material.section is soft, but must be round w")));
  }
  EXPECT_FALSE(load_method(kTighten, {"material=pink_vps", "compatibility=1"}).material.is_soft());
}

TEST(OverruledKeys, OfStrandsThatDoNotRollGo) {
  ASSERT_GT(load_method(kTighten).material.rolling_resistance, 0.0);
  EXPECT_THAT(load_method(kTighten).overruled, testing::IsEmpty());
  for (const char* held : {"material.friction_couple=0", "physics.friction.at=centreline",
                           "physics.friction={at: centreline}", "material.friction_coefficient=0"}) {
    const Method method = load_method(kTighten, {held});
    EXPECT_EQ(method.material.rolling_resistance, 0.0) << held;
    EXPECT_THAT(method.overruled,
                testing::ElementsAre(HasSubstr("material.rolling_resistance is 0.3, but has an effect only with ")));
    EXPECT_THAT(foreseen_warnings(method), testing::Contains(method.overruled.front()));
  }
  const Method first = load_method(kTighten, {"compatibility=1"});
  EXPECT_EQ(first.material.rolling_resistance, 0.0);
  EXPECT_THAT(first.overruled, testing::IsEmpty()) << "release 1 had no such key";
}

}  // namespace
}  // namespace knot_utm
