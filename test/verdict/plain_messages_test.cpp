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
  write("broken.yaml", "specimen:\n  knot: [fisherman\nmaterial: nylon\n");
  const std::vector<Mistake> mistakes{
      {"", "METHOD is missing: give the method: a YAML file, or the name of one that comes with the package"},
      {"nosuch.yaml", "cannot read nosuch.yaml: no such file"},
      {"broken.yaml", "broken.yaml: line 3, column 9: end of sequence flow not found"},
      {"tighten.yaml --set specimen.prelaod=3",
       "tighten.yaml: specimen.prelaod is no key of a method; did you mean specimen.preload?"},
      {"tighten.yaml --set specimen.preload=abc",
       "tighten.yaml: specimen.preload is \"abc\", but must be a number from 1e-9 to 1e9 (in N), or auto"},
      {"tighten.yaml --set 'specimen.preload=[3'",
       "--set specimen.preload=[3: the value is not YAML: end of sequence flow not found"},
      {"tighten.yaml --set machine.grips=clamp",
       "tighten.yaml: machine.grips is \"clamp\", but must be rollers, nodes or clamps; did you mean clamps?"},
      {"tighten.yaml --sett specimen.preload=3", "--sett is no option of tensile_test; did you mean --set?"},
      {"tighten.yaml --set --out bad", "--set needs a value, but the option --out follows it"},
  };
  for (const Mistake& mistake : mistakes)
    EXPECT_EQ(said("tensile_test", mistake.arguments), "tensile_test: " + mistake.answer);
}

}  // namespace
}  // namespace knot_utm
