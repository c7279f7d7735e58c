// Raw data as other machines and languages name it. The files follow headers that were found in public programs and
// manuals that read such exports; their numbers are our own, each with a beginning, an offset and a rate of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/raw/raw_data.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "run/command.hpp"

namespace knot_utm {
namespace {

using testing::HasSubstr;

std::string fixture(const std::string& name) { return std::string(KNOT_UTM_SOURCE_DIR) + "/test/raw/raw_data/" + name; }

struct Reading {
  double time, extension, load;  // [s], [mm], [N]
};

struct Export {
  const char* name;
  std::size_t readings;
  Reading first, last;
};

void expect_reading(const CurveRow& row, const Reading& reading) {
  EXPECT_NEAR(row.time, reading.time, 1e-12);
  EXPECT_NEAR(row.extension, 1e-3 * reading.extension, 1e-12);
  EXPECT_NEAR(row.load, reading.load, 1e-9);
}

class EveryExport : public testing::TestWithParam<Export> {};

TEST_P(EveryExport, IsReadWithoutBeingToldHow) {
  const Export& file = GetParam();
  const std::vector<CurveRow> rows = read_raw_data(read_input(fixture(file.name)), file.name);
  ASSERT_EQ(rows.size(), file.readings);
  expect_reading(rows.front(), file.first);
  expect_reading(rows.back(), file.last);
}

INSTANTIATE_TEST_SUITE_P(
    RawNames, EveryExport,
    testing::Values(Export{"zwick_german_cp1252.csv", 7, {0.0, 12.345, -0.8}, {0.12, 12.405, -0.723}},
                    Export{"zwick_german_utf16.csv", 5, {0.0, 0.0, 1.5}, {0.4, 0.8, 9.73}},
                    Export{"mts_tabs.csv", 6, {0.0, -3.21, 0.02}, {0.05, -2.71, 0.1825}},
                    Export{"mts_axial.csv", 6, {1.25, 0.5, 4.0}, {1.5, 0.75, 8.123}},
                    Export{"shimadzu_english.csv", 8, {0.0, 0.0, 0.0}, {1.75, 8.75, 28.514}},
                    Export{"shimadzu_sjis.csv", 4, {0.0, 8.0, 0.7}, {1.5, 12.5, 16.245}},
                    Export{"japanese_utf8.csv", 5, {0.0, 0.0, 30.0}, {0.8, 0.8, 35.986}},
                    Export{"chinese_gb18030.csv", 5, {0.0, 100.0, -12.0}, {0.16, 100.032, -10.974}},
                    Export{"chinese_utf8.csv", 5, {0.0, 0.0, 2.0}, {4.0, 1.32, 23.52}},
                    Export{"spanish_utf8.csv", 6, {0.0, 1.0, 0.3}, {1.667, 11.0, 18.257}},
                    Export{"italian_cp1252.csv", 5, {0.0, 0.0, 0.0}, {0.5, 0.75, 2.752}},
                    Export{"portuguese_cp1252.csv", 5, {0.0, -2.0, 6.0}, {0.5, -1.25, 33.5194}},
                    Export{"dutch.csv", 5, {0.0, 0.0, 0.1}, {0.333, 0.8333, 0.889}},
                    Export{"wavematrix.csv", 9, {0.0, 0.0, 0.4}, {0.125, 0.1, 0.565}},
                    Export{"unit_behind_name.csv", 5, {0.0, 0.0, 5.0}, {0.4, 0.4, 6.823}}),
    [](const testing::TestParamInfo<Export>& file) {
      const std::string name = file.param.name;
      return name.substr(0, name.size() - 4);
    });

constexpr const char* kOwnNames = "time=Zeitpunkt,extension=Weg, oben,load=Messwert 2";

std::string complaint_of(const std::string& text, const char* columns = "") {
  try {
    RawOptions options;
    if (*columns != '\0') options.columns = parse_raw_columns(columns, "--columns");
    read_raw_data(text, "raw.csv", options);
  } catch (const InvalidInput& invalid) {
    return invalid.what();
  }
  return "none";
}

TEST(RawNames, AUserMayNameTheColumns) {
  const std::string text = read_input(fixture("own_names.csv"));
  RawOptions options;
  options.columns = parse_raw_columns(kOwnNames, "--columns");
  const std::vector<CurveRow> rows = read_raw_data(text, "raw.csv", options);
  ASSERT_EQ(rows.size(), 2u);
  expect_reading(rows.back(), {0.5, 2.25, 4.5});
  EXPECT_EQ(complaint_of("Czas;Weg;Kraft\ns;mm;N\n0,5;1;1\n", "time=Czas"), "none");
}

TEST(RawNames, ARefusalShowsTheRowAndTheNames) {
  const std::string complaint = complaint_of("Seil;3\nZeitpunkt;Kraft;Messweg\ns;N;mm\n0;1;2\n");
  EXPECT_THAT(complaint, HasSubstr("row 2 is \"Zeitpunkt;Kraft;Messweg\" and does not name time"));
  for (const char* known : {"time, whose known names are time, test time, ", " others; extension", "--columns"})
    EXPECT_THAT(complaint, HasSubstr(known));
  EXPECT_THAT(complaint, testing::Not(HasSubstr("load, whose"))) << "the load was found";
  EXPECT_LT(complaint.size(), 500u);
  EXPECT_THAT(complaint_of("Time,Stroke,Force\ns,mm,N\n0,1,2\n", "load=Cell 3"),
              HasSubstr("load, whose known names are \"Cell 3\" alone"));
}

/// Of the many that there are.
TEST(RawNames, ARefusalNamesTheNearestFirst) {
  EXPECT_THAT(complaint_of("Versuchzeit;Weg;Kraft\ns;mm;N\n0;1;2\n"),
              HasSubstr("does not name time, whose known names are versuchszeit, time, test time, total time and "));
}

TEST(RawNames, NamesOfColumnsAreOfAForm) {
  for (const char* wrong : {"", "Zeit", "zeit=Zeit", "time=", "time=a,time=b", "Weg,time=a"})
    EXPECT_THROW(parse_raw_columns(wrong, "--columns"), InvalidInput) << wrong;
}

TEST(RawNames, CompareAndFollowTakeThem) {
  const std::string file = "'" + fixture("own_names.csv") + "'";
  EXPECT_EQ(answer_of(tool("compare", file + " " + file)).code, 2);
  const Answer answer = answer_of(tool("compare", file + " " + file + " --yaml --columns '" + kOwnNames + "'"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("rms_difference: 0"));
  const Method method =
      load_test(std::string(KNOT_UTM_SOURCE_DIR) + "/config/straight.yaml",
                {"program=[{follow: {record: '" + fixture("own_names.csv") + "', columns: '" + kOwnNames + "'}}]"});
  ASSERT_EQ(method.program.front().recorded.size(), 2u);
  EXPECT_NEAR(method.program.front().recorded.back().displacement, 1e-3, 1e-12);
}

}  // namespace
}  // namespace knot_utm
