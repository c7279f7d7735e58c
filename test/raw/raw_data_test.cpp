#include "knot_utm/raw/raw_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/run/run_folder.hpp"

namespace knot_utm {
namespace {

using testing::HasSubstr;

/// The dialects: files as Bluehill writes them, of the same five readings. The fuzz target has them too.
std::string dialect(const std::string& name) { return std::string(KNOT_UTM_SOURCE_DIR) + "/test/raw/raw_data/" + name; }

std::vector<CurveRow> read(const std::string& name) { return read_raw_data(read_input(dialect(name)), dialect(name)); }

struct Reading {
  double time, extension, load;  // [s], [mm], [N]
};
constexpr Reading kReadings[] = {
    {0, 0, 0}, {0.1, 0.33, 1.25}, {0.25, 0.825, 2.5}, {0.4, 1.32, 4.75}, {0.5, 1.65, 1234.5}};

class EveryDialect : public testing::TestWithParam<const char*> {};

TEST_P(EveryDialect, GivesTheSameReadings) {
  const std::vector<CurveRow> rows = read(GetParam());
  ASSERT_EQ(rows.size(), std::size(kReadings));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].time, kReadings[i].time);
    // A decimal and its unit are each rounded once.
    EXPECT_DOUBLE_EQ(rows[i].extension, 1e-3 * kReadings[i].extension);
    EXPECT_DOUBLE_EQ(rows[i].load, kReadings[i].load);
    EXPECT_EQ(rows[i].phase, Phase::kPull);
    EXPECT_TRUE(std::isnan(rows[i].knot_distance) && std::isnan(rows[i].end_to_end) && std::isnan(rows[i].load_lower));
  }
}

INSTANTIATE_TEST_SUITE_P(RawData, EveryDialect,
                         testing::Values("english.csv", "english_lf.csv", "english_quoted.csv",
                                         "english_units_in_names.csv", "english_strain_gauges.csv",
                                         "english_results_first.csv", "english_thousands.csv", "german_cp1252.csv",
                                         "german_utf16.csv", "german_utf16_tabs.csv", "polish_cp1250.csv",
                                         "polish_utf8.csv", "french_cp1252.csv", "french_utf8.csv", "empty_rows.csv"),
                         [](const testing::TestParamInfo<const char*>& dialect_info) {
                           const std::string name = dialect_info.param;
                           return name.substr(0, name.size() - 4);
                         });

std::string complaint(const std::string& name) {
  try {
    read(name);
  } catch (const InvalidInput& invalid) {
    return std::string(invalid.what()).substr(dialect("").size());
  }
  return "none";
}

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

TEST(RawData, UnitsAreNeverGuessed) {
  EXPECT_EQ(complaint("no_unit.csv"),
            "no_unit.csv: the unit of column Load is missing: give mN, cN, N, daN, kN, gf (g), kgf (kg, kp), lbf (lb), "
            "ozf or "
            "kip, by --units load=UNIT");
  EXPECT_EQ(complaint("unknown_unit.csv"),
            "unknown_unit.csv: the unit of column Load is MPa, but must be mN, cN, N, daN, kN, gf (g), kgf (kg, kp), "
            "lbf (lb), ozf or kip");
  EXPECT_EQ(complaint_of("Time,Extension,Load\n0,0,0\n"),
            "raw.csv: the unit of column Time is missing: give ms, s, min or h, by --units time=UNIT");
  EXPECT_THAT(
      complaint_of("Time (s),Extension (mm),Load (N)\n(s),(cm),(N)\n0,0,0\n"),
      HasSubstr("the unit of column Extension (mm) is cm below the name, but must be the same as in the name, mm"));
}

TEST(RawData, MegaIsNotMilli) {
  EXPECT_THAT(complaint_of("Time,Extension,Load\n(s),(mm),(MN)\n0,0,0\n"), HasSubstr("is MN, but must be mN"));
  EXPECT_DOUBLE_EQ(read_raw_data("Time,Extension,Load\n(s),(mm),(mN)\n0,0,2\n", "raw.csv").front().load, 2e-3);
}

TEST(RawData, WhatIsNotANumberIsNamedByRowAndColumn) {
  EXPECT_EQ(complaint("cut_off.csv"),
            "cut_off.csv: row 8: Load is \"\", but must be a number with \".\" before its decimals");
  EXPECT_EQ(complaint("goes_back.csv"), "goes_back.csv: row 8: Time goes back to 0.3");
  EXPECT_EQ(
      complaint("no_names.csv"),
      "no_names.csv: no row names the columns time, extension and load; --columns takes other names, or numbers, such "
      "as --columns time=1,extension=2,load=3");
  EXPECT_EQ(complaint("empty"), "empty: the file is empty");
  EXPECT_THAT(complaint_of("Time,Extension,Load\n(s),(mm),(N)\n"), HasSubstr("no row of numbers follows the names"));
}

TEST(RawData, ACommaIsOfDecimalsOrOfThousandsNeverOfBoth) {
  const std::string head = "Time;Extension;Load\n(s);(mm);(N)\n";
  const std::vector<CurveRow> rows = read_raw_data(head + "0;0;1.234,5\n1;1;1.234.567,5\n", "raw.csv");
  EXPECT_EQ(rows[0].load, 1234.5);
  EXPECT_EQ(rows[1].load, 1234567.5);
  for (const char* load : {"12,34", "0,123", "1234,567", "1,2345", ",123", "1,,234"})
    EXPECT_THAT(complaint_of(head + "0.5;0;" + load + "\n"), HasSubstr("row 3: Load")) << load;
}

double load_of(const std::string& rows) {
  return read_raw_data("Time;Extension;Load\n(s);(mm);(N)\n" + rows, "raw.csv").back().load;
}

TEST(RawData, OneNumberTellsTheMarkOfAll) {
  EXPECT_EQ(load_of("0,000;0,000;0,000\n0,100;0,100;1,234\n"), 1.234);
  EXPECT_EQ(load_of("0.5;1;1,234\n"), 1234.0);
  EXPECT_EQ(load_of("0;0;1,234,567\n"), 1234567.0);
  EXPECT_EQ(load_of("0;0;1 234,50\n"), 1234.5);
  EXPECT_EQ(load_of("0;0;1\xA0"
                    "234,50\n"),
            1234.5);
  EXPECT_EQ(load_of("0;0;1\xC2\xA0"
                    "234,50\n"),
            1234.5);
  EXPECT_EQ(load_of("0;0;1\xE2\x80\xAF"
                    "234,50\n"),
            1234.5);
  const std::string head = "Time;Extension;Load\n(s);(mm);(N)\n";
  for (const char* row : {"1;1;1,234\n", "1,500;1,250;1.201\n", "1;1;1.234\n"})
    EXPECT_THAT(complaint_of(head + row), HasSubstr("may have decimals or thousands")) << row;
}

TEST(RawData, EveryCellHasAName) {
  const std::string head = "Zeit,Traversenweg,Kraft\n(s),(mm),(N)\n";
  EXPECT_THAT(complaint_of(head + "0,10,0,33,1,25\n"),
              HasSubstr("row 3 has 6 cells, but must have 3 as there are names"));
  EXPECT_EQ(complaint_of(head + "0,10,0.5,,\n"), "none");
}

TEST(RawData, OfTwoTablesNoneIsReadUnlessItIsChosen) {
  const std::string table = "Time,Extension,Load\n(s),(mm),(N)\n0,0,0\n";
  EXPECT_THAT(complaint_of(table + table), HasSubstr("holds 2 specimens, in tables that begin with rows 1 and 4"));
}

TEST(RawData, ARowOfSeparatorsIsEmpty) {
  EXPECT_EQ(complaint_of("Time,Extension,Load\n,,\n(s),(mm),(N)\n,,\n0,0,0\n"), "none");
}

TEST(RawData, WhatIsSaidOfNumbersAsLargeAsTheyGet) {
  EXPECT_THAT(complaint_of("Time,Extension,Load\n(s),(mm),(kN)\n0,0,1e308\n"), HasSubstr("row 3: Load"));
  EXPECT_THAT(complaint_of("Time,Extension,Load\n(s),(mm),(N)\n0,0,nan\n"), HasSubstr("row 3: Load"));
}

// Raw data as other machines and languages name it. The files follow headers that were found in public programs and
// manuals that read such exports; their numbers are our own, each with a beginning, an offset and a rate of its own.

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
  const std::vector<CurveRow> rows = read_raw_data(read_input(dialect(file.name)), file.name);
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

TEST(RawNames, AUserMayNameTheColumns) {
  const std::string text = read_input(dialect("own_names.csv"));
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

}  // namespace
}  // namespace knot_utm
