// Raw data that users had trouble with. The files of test/raw/files are as their programs, spreadsheets and machines
// left them; the texts in here follow what public programs that read such exports say of their form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/raw/raw_data.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/curve_file.hpp"
#include "knot_utm/run/run_folder.hpp"

namespace knot_utm {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

std::string case_file(const std::string& name) { return std::string(KNOT_UTM_SOURCE_DIR) + "/test/raw/files/" + name; }

struct Reading {
  double time, extension, load;  // [s], [mm], [N]
};

void expect_reading(const CurveRow& row, const Reading& reading) {
  if (std::isnan(reading.time)) {
    EXPECT_TRUE(std::isnan(row.time));
  } else {
    EXPECT_NEAR(row.time, reading.time, 1e-9);
  }
  EXPECT_NEAR(1e3 * row.extension, reading.extension, 1e-9);
  EXPECT_NEAR(row.load, reading.load, 1e-9 * std::abs(reading.load) + 1e-12);
}

/// What became of a text: its readings and what was told of them, or why it was refused.
struct Outcome {
  std::vector<CurveRow> rows;
  std::vector<std::string> told;
  std::string refused;
};

template <class Read>
Outcome outcome_of(Read read) {
  Outcome out;
  try {
    out.rows = read([&](const std::string& line) { out.told.push_back(line); });
  } catch (const InvalidInput& invalid) {
    out.refused = invalid.what();
  }
  return out;
}

Outcome of_file(const std::string& name, RawOptions options = {}) {
  options.needs_time = false;
  return outcome_of([&](const Tell& tell) { return read_curve_file(case_file(name), options, tell); });
}

Outcome of_text(const std::string& text, const RawOptions& options = {}) {
  return outcome_of([&](const Tell& tell) { return read_raw_data(text, "raw.csv", options, tell); });
}

RawOptions specimen(int number) {
  RawOptions out;
  out.specimen = number;
  return out;
}
RawOptions columns(const char* text, const char* units = "") {
  RawOptions out;
  out.columns = parse_raw_columns(text, "--columns");
  if (*units != '\0') out.units = parse_raw_columns(units, "--units");
  return out;
}
RawOptions units(const char* text) {
  RawOptions out;
  out.units = parse_raw_columns(text, "--units");
  return out;
}
RawOptions inverted(const char* invert) {
  RawOptions out;
  out.invert = invert;
  return out;
}

struct Case {
  const char* name;
  RawOptions options;
  std::size_t readings;
  Reading first, last;
  const char* told;  // part of a line
};

class EveryCase : public testing::TestWithParam<Case> {};

TEST_P(EveryCase, IsReadAndTold) {
  const Outcome out = of_file(GetParam().name, GetParam().options);
  ASSERT_EQ(out.refused, "");
  ASSERT_THAT(out.rows, SizeIs(GetParam().readings));
  expect_reading(out.rows.front(), GetParam().first);
  expect_reading(out.rows.back(), GetParam().last);
  EXPECT_THAT(out.told, Contains(HasSubstr(GetParam().told)));
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kPound = 4.4482216152605;

INSTANTIATE_TEST_SUITE_P(
    RawCases, EveryCase,
    testing::Values(
        Case{"side_by_side.csv", specimen(1), 9, {0, 0, 0.25}, {4, 2, 8.25}, "load is column 3 \"Load\" in N"},
        Case{"side_by_side.csv", specimen(2), 9, {0, 0, 0.125}, {4, 2, 4.125}, "9 readings of specimen 2 of 2"},
        Case{"disp_and_ext.csv",
             {},
             11,
             {0, 0, 0.125},
             {5, 2.5, 5.125},
             "column 3 \"Extension (mm)\", which goes over 0.25 mm"},
        Case{"extenso.csv", {}, 11, {0, 0, 0.125}, {5, 2.5, 5.125}, "--columns extension=3 would read it"},
        Case{"position_and_ext.csv",
             {},
             11,
             {0, 100, 0.125},
             {5, 102.5, 5.125},
             "extension is column 2 \"Position (mm)\""},
        Case{"extenso.csv", columns("extension=3"), 11, {0, 0, 0.125}, {5, 0.25, 5.125}, "column 3 \"Extension (mm)\""},
        Case{"downwards.csv", {}, 12, {0.8, -794, 0.5}, {1.9, -795.8, 4.1}, "the extension falls from -794 to -796 mm"},
        Case{"neg_ext.csv", inverted("falling"), 10, {0, 0, 0.125}, {4.5, 2.25, 4.625}, "10 readings"},
        Case{"neg_load.csv", {}, 10, {0, 0, -0.125}, {4.5, 2.25, -4.625}, "the load falls from -0.125 to -4.62 N"},
        Case{"neg_load.csv", inverted("falling"), 10, {0, 0, 0.125}, {4.5, 2.25, 4.625}, "the sign of load is turned"},
        Case{"neg_load.csv", inverted("both"), 10, {0, 0, 0.125}, {4.5, -2.25, 4.625}, "10 readings"},
        Case{"headerless.csv",
             columns("time=1,extension=2,load=3", "time=min,extension=cm,load=daN"),
             12,
             {0, 0, 1.25},
             {330, 27.5, 56.25},
             "load is column 3 in daN"},
        Case{"no_time.csv", {}, 11, {kNone, 0, 0.125}, {kNone, 2.5, 5.125}, "no column of time"},
        Case{"no_time.csv",
             inverted("falling"),
             11,
             {kNone, 0, 0.125},
             {kNone, 2.5, 5.125},
             "nothing falls, and --invert turns nothing"},
        Case{"no_units.csv",
             units("time=s,extension=mm,load=N"),
             11,
             {0, 0, 0.125},
             {5, 2.5, 5.125},
             "column 2 \"Disp\" in mm"},
        Case{"unit_Seconds_inches_lbs.csv", {}, 10, {0, 0, 0.125 * kPound}, {4.5, 57.15, 4.625 * kPound}, "in inches"},
        Case{"unit_minutes.csv", {}, 10, {0, 0, 0.125}, {270, 2.25, 4.625}, "in minutes"},
        Case{"unit_s_in_lb.csv", {}, 10, {0, 0, 0.125 * kPound}, {4.5, 57.15, 4.625 * kPound}, "in lb"},
        Case{"unit_s_in_lb.csv",
             units("load=kgf"),
             10,
             {0, 0, 0.125 * 9.80665},
             {4.5, 57.15, 4.625 * 9.80665},
             "in kgf"},
        Case{"unit_s_mm_Newtons.csv", {}, 10, {0, 0, 0.125}, {4.5, 2.25, 4.625}, "in Newtons"},
        Case{"unit_seconds.csv", {}, 10, {0, 0, 0.125}, {4.5, 2.25, 4.625}, "in seconds"},
        Case{"form_prefix.csv", {}, 11, {0, 0, 0.125}, {5, 2.5, 5.125}, "C_1_Load[N]"},
        Case{"name_comp_ext.csv", {}, 10, {0, 0, 0.125}, {4.5, 2.25, 4.625}, "is the name of a test in compression"},
        Case{"name_en_zwick.csv", {}, 10, {0, 0, 0.125}, {4.5, 2.25, 4.625}, "Crosshead absolute"},
        Case{"name_fr_course_std.csv", {}, 10, {0, 0, 0.125}, {4.5, 2.25, 4.625}, "Course standard"},
        Case{"name_fr_zwick.csv", {}, 10, {0, 0, 0.125}, {4.5, 2.25, 4.625}, "Traverse absolue"},
        Case{"name_zw_grip.csv", {}, 10, {0, 0, 0.125}, {4.5, 2.25, 4.625}, "Grip to grip separation"},
        Case{"ctrl_z.csv", {}, 40, {0, 0, 0.125}, {19.5, 9.75, 19.625}, "40 readings"},
        Case{"nul_end.csv", {}, 40, {0, 0, 0.125}, {19.5, 9.75, 19.625}, "40 readings"},
        Case{"pipes.txt", {}, 11, {0, 0, 0.125}, {5, 2.5, 5.125}, "11 readings"},
        Case{"spaces.txt", {}, 11, {0, 0, 0.125}, {5, 2.5, 5.125}, "load is column 3 \"Load(N)\""},
        Case{"swiss.csv", {}, 10, {0, 0, 1000.5}, {4.5, 2.25, 1004.5}, "10 readings"},
        Case{"unicode_minus.csv", {}, 10, {0, 0, -2.875}, {4.5, 2.25, 1.625}, "10 readings"},
        Case{"spike.csv", {}, 60, {0, 0, 0}, {6, 10, 14}, "row 20, whose extension of 5.4 mm lies far off"}),
    [](const testing::TestParamInfo<Case>& of) {
      std::string name = std::to_string(of.index) + "_" + of.param.name;
      return name.substr(0, name.rfind('.'));
    });

struct Refusal {
  const char* name;
  RawOptions options;
  const char* why;
};

class EveryRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(EveryRefusal, SaysWhatToDo) {
  const Outcome out = of_file(GetParam().name, GetParam().options);
  EXPECT_THAT(out.refused, AllOf(HasSubstr(GetParam().name), HasSubstr(GetParam().why)));
  EXPECT_THAT(out.told, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    RawCases, EveryRefusal,
    testing::Values(
        Refusal{"side_by_side.csv", {}, "the file holds 2 specimens, side by side: choose one by --specimen 1 to 2"},
        Refusal{"side_by_side.csv", specimen(3), "--specimen is 3, but the file holds 2 specimens"},
        Refusal{"headerless.csv", {}, "such as --columns time=1,extension=2,load=3"},
        Refusal{"headerless.csv", columns("time=1,extension=2,load=3"),
                "the unit of column 1 is missing: give ms, s, "},
        Refusal{"headerless.csv", columns("time=1,extension=2,load=7"), "no row names the columns"},
        Refusal{"no_units.csv", {}, "the unit of column Time is missing: give ms, s, min or h, by --units time=UNIT"},
        Refusal{"book.xlsx", {}, "the file is a workbook (xlsx, ods) or another zip archive, and no text: save"},
        Refusal{"cr_only.csv", {}, "end with a carriage return alone, as on old Macs"}),
    [](const testing::TestParamInfo<Refusal>& of) { return "refusal_" + std::to_string(of.index); });

TEST(RawCases, AMissingTimeIsNamedWhereItIsNeeded) {
  const Outcome out = of_text(read_input(case_file("no_time.csv")));
  EXPECT_THAT(out.refused, HasSubstr("row 1 is \"Extension (mm),Load (N)\" and does not name time, whose known names"));
}

TEST(RawCases, ACurveThatASpreadsheetSavedIsTheCurve) {
  const Outcome out = of_file("excel_bom.csv");
  ASSERT_EQ(out.refused, "");
  EXPECT_THAT(out.told, Contains(HasSubstr("a curve.csv that a spreadsheet saved anew")));
  ASSERT_THAT(out.rows, SizeIs(11));
  EXPECT_EQ(out.rows[0].phase, Phase::kIdle);
  EXPECT_EQ(out.rows[4].phase, Phase::kPull);
  EXPECT_EQ(out.rows[4].end_to_end, 0.24602);
  // With semicolons and a decimal comma, as in half of Europe.
  std::string text = read_input(case_file("excel_bom.csv"));
  for (char& c : text) c = c == ',' ? ';' : c == '.' ? ',' : c;
  const std::string european = testing::TempDir() + "european.csv";
  write_whole(european, text + ";;;;;;\r\n");
  const std::vector<CurveRow> rows = read_curve_file(european);
  ASSERT_THAT(rows, SizeIs(11));
  EXPECT_EQ(rows[4].end_to_end, 0.24602);
}

/// Forms that are no case of their own file: each has two readings, (0, 1, 1.5) and (1, 2, 2.5).
TEST(RawCases, FormsThatAreReadAsTheyAreMeant) {
  const std::string row = "Time (s),Extension (mm),Load (N)\n", numbers = "0,1,1.5\n1,2,2.5\n";
  const std::vector<std::string> texts = {
      "# " + row + numbers,  // as NumPy writes names
      "% Time (s)\tExt (mm)\tLoad (N)\n0\t1\t1.5\n1\t2\t2.5\n",
      "\"Time\n(s)\",\"Extension\r\n(mm)\",\"Load\n(N)\"\n" + numbers,  // line ends in names
      row + "0.000,1.000,1.500\n1.000,2.000,2.500\n",
      // Arabic digits and their mark of decimals
      row + "\u0660,\u0661,\u0661\u066B\u0665\n\u0661,\u0662,\u0662\u066B\u0665\n"};
  for (const std::string& text : texts) {
    const Outcome out = of_text(text);
    ASSERT_EQ(out.refused, "") << text;
    ASSERT_THAT(out.rows, SizeIs(2)) << text;
    expect_reading(out.rows.front(), {0, 1, 1.5});
    expect_reading(out.rows.back(), {1, 2, 2.5});
  }
  const Outcome named = of_text("# time extension load\n0 1 1.5\n1 2 2.5\n", units("time=s,extension=mm,load=N"));
  ASSERT_EQ(named.refused, "");
  expect_reading(named.rows.back(), {1, 2, 2.5});
  // All of it has three digits behind a point, which commas between cells tell to be decimals.
  const Outcome clear = of_text(row + "1.000,1.000,1.500\n2.000,2.000,2.500\n");
  ASSERT_EQ(clear.refused, "");
  expect_reading(clear.rows.back(), {2, 2, 2.5});
  const Outcome unclear = of_text("Time (s);Extension (mm);Load (N)\n1,000;1,000;1,500\n2,000;2,000;2,500\n");
  EXPECT_THAT(unclear.refused, HasSubstr("tells which: a zero more behind its decimals would"));
  EXPECT_EQ(of_text("Time (s);Extension (mm);Load (N)\n1,0000;1,000;1,500\n").refused, "");
}

/// A sign of inches is no quote, and rows keep their numbers behind names of several lines.
TEST(RawCases, AQuoteThatIsNotClosedTakesNoOtherRow) {
  const Outcome inches = of_text("Time (s),Extension (\"),Load (N)\n0,1,1.5\n1,2,2.5\n");
  ASSERT_EQ(inches.refused, "");
  expect_reading(inches.rows.back(), {1, 50.8, 2.5});
  EXPECT_THAT(of_text("\"Time\n(s)\",\"Extension (mm)\",\"Load (N)\"\n0,1,2\n1,x,2\n").refused,
              HasSubstr("row 4: Extension"));
}

TEST(RawCases, OldLineEndsAreSeenBesideALastOneOfAnotherKind) {
  const std::string old = "Time (s),Extension (mm),Load (N)\r0,1,1.5\r1,2,2.5\r";
  for (const char* last : {"", "\n"}) EXPECT_THAT(of_text(old + last).refused, HasSubstr("as on old Macs"));
  for (const char* end : {"\r\n", "\r\r\n"})
    EXPECT_EQ(of_text("Time (s),Extension (mm),Load (N)" + std::string(end) + "0,1,1.5" + end).refused, "");
}

TEST(RawCases, OneReadingIsOne) {
  EXPECT_THAT(of_text("Time (s),Extension (mm),Load (N)\n0,1,1.5\n").told, Contains(HasSubstr(": 1 reading: time is")));
}

std::string utf16(const std::string& ascii, bool low_first) {
  std::string out;
  for (const char c : ascii) out += low_first ? std::string{c, '\0'} : std::string{'\0', c};
  return out;
}

TEST(RawCases, EncodingsAndBlanksThatAreNotNamed) {
  const std::string table = "Zeit;Weg;Kraft\r\ns;mm;N\r\n0;0;1,5\r\n1;2,5;3,5\r\n";
  for (const std::string& text : {utf16(table, true), utf16(table, false), "\xEF\xBB\xBF" + table}) {
    const Outcome out = of_text(text);
    ASSERT_EQ(out.refused, "");
    expect_reading(out.rows.back(), {1, 2.5, 3.5});
  }
  // Thin, narrow, full-width and figure blanks; the typographic apostrophe; minus signs of all kinds.
  const std::string head = "Time;Extension;Load\ns;mm;N\n";
  for (const char* load : {"1\xE2\x80\x89"
                           "234.5",
                           "1\xE2\x80\xAF"
                           "234.5",
                           "1\xE3\x80\x80"
                           "234.5",
                           "1\xE2\x80\x87"
                           "234.5",
                           "1\xE2\x80\x99"
                           "234.5",
                           "1'234.5"})
    EXPECT_EQ(of_text(head + "0;0;" + load + "\n").rows.at(0).load, 1234.5) << load;
  for (const char* load : {"\xE2\x88\x92"
                           "2.5",
                           "\xEF\xBC\x8D"
                           "2.5",
                           "\xE2\x80\x90"
                           "2.5"})
    EXPECT_EQ(of_text(head + "0;0;" + load + "\n").rows.at(0).load, -2.5) << load;
}

TEST(RawCases, UnitsMayStandAboveTheNames) {
  const Outcome out = of_text("Test 7\n(s),(mm),(kN)\nTime,Extension,Load\n0,0,1.5\n");
  ASSERT_EQ(out.refused, "");
  expect_reading(out.rows.at(0), {0, 0, 1500});
}

TEST(RawCases, UnitsAreSpeltAsPeopleSpellThem) {
  const std::string head = "Time;Extension;Load\n";
  const auto read = [&](const std::string& time, const std::string& extension, const std::string& load) {
    return of_text(head + time + ';' + extension + ';' + load + "\n2;2;2\n");
  };
  for (const char* same : {"N", "newton", "Newtons", "(N)", "[n]"})
    EXPECT_EQ(read("s", "mm", same).rows.at(0).load, 2.0) << same;
  for (const char* same : {"kg", "Kg.", "kgf", "kp", "kilograms"})
    EXPECT_NEAR(read("s", "mm", same).rows.at(0).load, 2 * 9.80665, 1e-12) << same;
  for (const char* same : {"lb", "lbs", "LBF", "lb.", "pounds"})
    EXPECT_NEAR(read("s", "mm", same).rows.at(0).load, 2 * kPound, 1e-12) << same;
  EXPECT_NEAR(read("s", "mm", "g").rows.at(0).load, 2 * 9.80665e-3, 1e-15);
  EXPECT_NEAR(read("s", "mm", "kip").rows.at(0).load, 2e3 * kPound, 1e-9);
  EXPECT_EQ(read("s", "mm", "daN").rows.at(0).load, 20.0);
  EXPECT_NEAR(read("Min", "inch.", "N").rows.at(0).extension, 0.0508, 1e-12);
  EXPECT_EQ(read("Min", "inch.", "N").rows.at(0).time, 120.0);
  EXPECT_THAT(read("s", "mm", "MPa").refused, HasSubstr("the unit of column Load is MPa, but must be mN, cN, N, daN"));
  EXPECT_THAT(of_text(head + "s;mm;N\n2;2;2\n", units("load=MPa")).refused,
              HasSubstr("--units is load=MPa, but must be"));
}

/// As testXpert names them where an extensometer measures, too.
TEST(RawCases, TheCrossheadCountsBesideAnExtensometer) {
  const Outcome out = of_text(
      "Prüfzeit;Standardweg;Traverse "
      "abs.;Standardkraft\ns;mm;mm;N\n0;0;250,0;1,5\n1;0,01;251,0;3,5\n2;0,02;252,0;5,5\n");
  ASSERT_EQ(out.refused, "");
  EXPECT_NEAR(out.rows.back().extension, 0.252, 1e-12);
  EXPECT_THAT(out.told, Contains(HasSubstr("column 2 \"Standardweg\", which goes over 0.02 mm, is not read")));
  // Where both go the same way it is the machine's own extension.
  const Outcome same =
      of_text("Time;Extension;Position;Load\ns;mm;mm;N\n0;0;250.0;1.5\n1;1.0;251.0;3.5\n2;2;252.0;5.5\n");
  EXPECT_NEAR(same.rows.back().extension, 0.002, 1e-12);
}

TEST(RawCases, ASecondCellIsTold) {
  const std::string text = "Time;Extension;Load 1;Load 2\ns;mm;N;N\n0;0;1;3\n1;1;2;6\n";
  const Outcome out = of_text(text);
  expect_reading(out.rows.at(1), {1, 1, 2});
  EXPECT_THAT(out.told, Contains(HasSubstr("column 4 \"Load 2\" is not read; --columns load=4 would read it")));
  expect_reading(of_text(text, columns("load=4")).rows.at(1), {1, 1, 6});
  EXPECT_THAT(of_text(text, columns("extension=3,load=3")).refused, HasSubstr("another column for the extension"));
}

/// The shorter one has empty cells where the time goes on.
TEST(RawCases, SpecimensOfOneTimeMayBeOfDifferentLength) {
  const std::string text = "Time;Extension 1;Load 1;Extension 2;Load 2\ns;mm;N;mm;N\n0;0;1;0;2\n1;1;2;1;4\n2;2;3;;\n";
  EXPECT_THAT(of_text(text, specimen(1)).rows, SizeIs(3));
  const Outcome second = of_text(text, specimen(2));
  ASSERT_THAT(second.rows, SizeIs(2));
  expect_reading(second.rows.back(), {1, 1, 4});
  EXPECT_THAT(second.told, Contains(HasSubstr("empty rows: 1")));
}

TEST(RawCases, SpecimensBelowEachOther) {
  const std::string text =
      "ASCII Export File Version:,3\nSample / Slot "
      "Number:,2\nRecord,Index,Position,Strain,Time,Force\n,,\xC2\xB5m,%,s,N\n"
      "101,0,10,0,0,0.5\n101,1,20,1.5,1,2.5\n\nSample / Slot Number:,5\nRecord,Index,Position,Strain,Time,Force\n"
      ",,\xC2\xB5m,%,s,N\n200,0,0,0.5,0,0.30\n200,1,40,0.5,1,0.70\n";
  EXPECT_THAT(
      of_text(text).refused,
      HasSubstr("the file holds 2 specimens, in tables that begin with rows 3 and 9: choose one by --specimen 1"));
  const Outcome first = of_text(text, specimen(1)), second = of_text(text, specimen(2));
  ASSERT_EQ(first.refused + second.refused, "");
  ASSERT_THAT(first.rows, SizeIs(2));
  expect_reading(first.rows.back(), {1, 0.02, 2.5});
  ASSERT_THAT(second.rows, SizeIs(2));
  expect_reading(second.rows.back(), {1, 0.04, 0.7});
}

TEST(RawCases, NumbersOfSpecimensInNames) {
  const std::string shared =
      "Time [s];C_1_Extension[mm];C_1_Load[N];C_2_Extension[mm];C_2_Load[N]\n0;0;1.5;0;2.5\n1;1;3;2;4\n";
  EXPECT_THAT(of_text(shared).refused, HasSubstr("holds 2 specimens"));
  expect_reading(of_text(shared, specimen(2)).rows.at(1), {1, 2, 4});
  for (const char* names : {"Time_S\tDisp_mm\tForce_N\tTime_S.1\tDisp_mm.1\tForce_N.1\n",
                            "Time (s)\tDisp (mm)\tForce (N)\tTime (s).1\tDisp (mm).1\tForce (N).1\n",
                            "Time 1 (s)\tDisp 1 (mm)\tForce 1 (N)\tTime 2 (s)\tDisp 2 (mm)\tForce 2 (N)\n",
                            "Time s (1)\tDisp mm (1)\tForce N (1)\tTime s (2)\tDisp mm (2)\tForce N (2)\n"}) {
    const std::string text = names + std::string("0\t0\t1.5\t0\t0\t2.5\n1\t2\t3.5\t4\t5\t6.5\n");
    EXPECT_THAT(of_text(text).refused, HasSubstr("holds 2 specimens")) << names;
    const Outcome second = of_text(text, specimen(2));
    ASSERT_EQ(second.refused, "");
    expect_reading(second.rows.at(1), {4, 5, 6.5});
  }
}

TEST(RawCases, ASteppedMoveIsNoOutlier) {
  std::string text = "Time,Extension,Load\ns,mm,N\n";
  for (int i = 0; i < 20; ++i)
    text += std::to_string(i) + ".5," + std::to_string(i % 4 < 2 ? 5 : 0) + "," + std::to_string(i) + "\n";
  EXPECT_THAT(of_text(text).rows, SizeIs(20));
}

/// Of ten readings two, with one between them.
TEST(RawCases, ManyOutliersAreCountedAndTheFirstOnesNamed) {
  const auto outliers = [](int rows) {
    std::string text = "Time,Extension,Load\ns,mm,N\n";
    for (int i = 0; i < rows; ++i)
      text += std::to_string(i) + "," + std::to_string(i % 10 == 1 || i % 10 == 3 ? -5000 : i) + "," +
              std::to_string(i) + "\n";
    return of_text(text);
  };
  const Outcome many = outliers(20001);
  EXPECT_THAT(many.rows, SizeIs(16001));
  for (const CurveRow& row : many.rows) ASSERT_EQ(row.load, std::round(1e3 * row.extension));
  EXPECT_THAT(many.told, SizeIs(7)) << "the columns, five rows, and how many others";
  EXPECT_EQ(many.told[5],
            "raw.csv: row 24, whose extension of -5000 mm lies far off the readings before and behind it, is left out");
  EXPECT_EQ(many.told[6], "raw.csv: 3995 other rows are left out for the same reason");
  EXPECT_THAT(outliers(23).told, SizeIs(6)) << "all five are named";
  EXPECT_THAT(outliers(31).told, Contains(HasSubstr(": 1 other row is left out")));
}

TEST(RawCases, WhatIsNoTextIsNamed) {
  for (const auto& [bytes, words] : {std::pair<std::string, const char*>{"\xD0\xCF\x11\xE0\xA1", "old workbook (xls)"},
                                     {"%PDF-1.7\n", "a PDF"},
                                     {"\x1F\x8B\x08", "compressed"},
                                     {"#ROSBAG V2.0\n", "a bag, and no table of text: give the curve.csv of its run"},
                                     {"<?xml version=\"1.0\"?>\n<Workbook>", "XML or HTML"}})
    EXPECT_THAT(of_text(bytes).refused, HasSubstr(words));
}

}  // namespace
}  // namespace knot_utm
