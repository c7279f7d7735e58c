// What a newcomer's mistakes are answered with: the whole sentence, as it stands on the console.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "run/command.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

class PlainMessages : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    fs::copy_file(std::string(KNOT_UTM_SOURCE_DIR) + "/config/tighten.yaml", folder_ / "tighten.yaml",
                  fs::copy_options::overwrite_existing);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const char* name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  /// The one line that a command in the folder says; its exit code must be that of wrong input.
  std::string said(const std::string& name, const std::string& arguments) const {
    const Answer answer = answer_of("( cd '" + folder_.string() + "' && " + tool(name, arguments) + " )");
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
    return answer.text.substr(0, answer.text.find('\n'));
  }

  fs::path folder_ = fs::path(::testing::TempDir()) /
                     (std::string("knot_utm_plain_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

struct Mistake {
  const char* arguments;
  std::string answer;
};

TEST_F(PlainMessages, OfTensileTest) {
  write("no_material.yaml", "specimen: {knot: straight}\nprogram: [{pull: {}}]\n");
  write("broken.yaml", "specimen:\n  knot: [fisherman\nmaterial: nylon\n");
  write("indented.yaml", "specimen:\n  knot: fisherman\n tail: 0.1\n");
  write("list.yaml", "- specimen\n");
  write("wrong.bin", "\x01\x02");
  const std::vector<Mistake> mistakes{
      {"", "METHOD is missing: give the method: a YAML file, or the name of one that comes with the package"},
      {"nosuch.yaml", "cannot read nosuch.yaml: no such file"},
      {".", "cannot read .: is a directory"},
      {"list.yaml",
       "list.yaml: the file is [specimen], but must be a map with the keys specimen, material, machine and program"},
      {"broken.yaml", "broken.yaml: line 3, column 9: a list begins with \"[\" and has no \"]\""},
      {"indented.yaml",
       "indented.yaml: line 3, column 2: this line is neither a key of the map above it nor indented as a part of it"},
      {"tighten.yaml --set specimen.prelaod=3",
       "tighten.yaml: specimen.prelaod is no key of a method; did you mean specimen.preload?"},
      {"tighten.yaml --set specimen.preload=abc",
       "tighten.yaml: specimen.preload is \"abc\", but must be a number from 1e-9 to 1e9 (in N), or auto"},
      {"tighten.yaml --set specimen.preload=1e10",
       "tighten.yaml: specimen.preload is 1e10, but must be 1e-9 to 1e9 N, or auto"},
      {"tighten.yaml --set specimen.preload",
       "--set \"specimen.preload\" sets no key: write key=value, such as specimen.preload=20"},
      {"tighten.yaml --set 'specimen.preload=[3'",
       "--set specimen.preload=[3: the value is not YAML: a list begins with \"[\" and has no \"]\""},
      {"tighten.yaml --set 'program=[{pul: {}}]'",
       "tighten.yaml: program.0 is \"pul\", but must be tie, release, mount, preload, balance, pull, hold, cycle, "
       "return, follow or twist; did you mean pull?"},
      {"tighten.yaml --set 'program=[{pull: {}}]'",
       "tighten.yaml: program.0.pull.until is missing: give one or more of extension, load, time and break"},
      {"tighten.yaml --set machine.grips=clamp",
       "tighten.yaml: machine.grips is \"clamp\", but must be rollers, nodes or clamps; did you mean clamps?"},
      {"tighten.yaml --sett specimen.preload=3", "--sett is no option of tensile_test; did you mean --set?"},
      {"tighten.yaml --set --out bad", "--set needs a value, but the option --out follows it"},
      {"tighten.yaml --out --quiet", "--out needs a value, but the option --quiet follows it"},
      {"tighten.yaml another.yaml",
       "\"another.yaml\" is one argument too many; see " KNOT_UTM_TOOLS_DIR "/tensile_test --help"},
      {"tighten.yaml --set",
       "--set needs a value: dotted.key=YAML, instead of what the method says; may be given more than once"},
      {"tighten.yaml --out wrong.bin", "cannot make the folder \"wrong.bin\": not a directory"},
      {"--resume nowhere", "cannot read nowhere/method.yaml: no such file"},
      {"--from-samples nowhere", "there is no samples.csv in nowhere from which results can be made"},
  };
  for (const Mistake& mistake : mistakes)
    EXPECT_EQ(said("tensile_test", mistake.arguments), "tensile_test: " + mistake.answer);
}

/// These two list the materials that there are.
TEST_F(PlainMessages, OfAMaterial) {
  write("no_material.yaml", "specimen: {knot: straight}\nprogram: [{pull: {}}]\n");
  const std::string missing = said("tensile_test", "no_material.yaml");
  const std::string misspelt = said("tensile_test", "tighten.yaml --set material=nyln");
  const std::string begin = "tensile_test: no_material.yaml: material is missing: give a name (", end = ") or a map";
  ASSERT_EQ(missing.substr(0, begin.size()), begin);
  ASSERT_EQ(missing.substr(missing.size() - end.size()), end);
  const std::string names = missing.substr(begin.size(), missing.size() - begin.size() - end.size());
  for (const auto& file : fs::directory_iterator(std::string(KNOT_UTM_SOURCE_DIR) + "/config/materials"))
    EXPECT_NE((", " + names + ",").find(", " + file.path().stem().string() + ","), std::string::npos) << file.path();
  EXPECT_EQ(misspelt, "tensile_test: tighten.yaml: material is \"nyln\", but must be a name (" + names +
                          ") or a map; did you mean nylon?");
}

TEST_F(PlainMessages, OfTheOtherTools) {
  EXPECT_EQ(said("compare", "a.csv"), "compare: B is missing: give the other curve");
  EXPECT_EQ(said("compare", "a.csv b.csv --begins-at far"), "compare: --begins-at is far, but must be a number");
  EXPECT_EQ(said("compare", "a.csv b.csv --tolerance some"),
            "compare: --tolerance is some, but must be a number of at least 0");
  EXPECT_EQ(said("compare", "nosuch.csv nosuch.csv"), "compare: cannot read nosuch.csv: no such file");
}

}  // namespace
}  // namespace knot_utm
