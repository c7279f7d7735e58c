#!/usr/bin/python3
"""What testing machines export, read by knot_utm.importing. raw_data.txt has files as machines and languages write them, their headers
found in public programs and manuals, their numbers our own, and those that users had trouble with: each after a line "@ name encoding
line-end". The texts in here follow what public programs that read such exports say of their form. The structure is of mts793_blocks that
of BAMresearch/LebeDigital (specimen.dat), of wavematrix_* elcritch/scilab and scripts that read Test1.Stop.csv, of linescale linescaleGUI
(tests/inputFiles), of mecmesin blokeley/forcelib (examples), of wintest jpeloquin/postmech (bose_export.TXT)."""
import math
import os
import random
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
PROGRAM = os.path.join(HERE, "../../python/knot_utm/importing/import_instron.py")
sys.path.insert(0, os.path.join(HERE, "../../python"))

from knot_utm.errors import WrongInput
from knot_utm.importing.table import parsed_columns, read_record, Reading

POUND, KILOGRAM, NAN = 4.4482216152605, 9.80665, math.nan
# The same five readings in files as Bluehill writes them.
BLUEHILL = [(0, 0, 0), (0.1, 0.33, 1.25), (0.25, 0.825, 2.5), (0.4, 1.32, 4.75), (0.5, 1.65, 1234.5)]
BLUEHILL_FILES = """english english_lf english_quoted english_units_in_names english_strain_gauges english_results_first
    english_thousands german_cp1252 german_utf16 german_utf16_tabs polish_cp1250 polish_utf8 french_cp1252 french_utf8 empty_rows"""
# Of other machines and languages: how many readings, the first and the last one [s], [mm], [N].
EXPORTS = {
    "zwick_german_cp1252": (7, (0, 12.345, -0.8), (0.12, 12.405, -0.723)),
    "zwick_german_utf16": (5, (0, 0, 1.5), (0.4, 0.8, 9.73)),
    "mts_tabs": (6, (0, -3.21, 0.02), (0.05, -2.71, 0.1825)),
    "mts_axial": (6, (1.25, 0.5, 4), (1.5, 0.75, 8.123)),
    "shimadzu_english": (8, (0, 0, 0), (1.75, 8.75, 28.514)),
    "shimadzu_sjis": (4, (0, 8, 0.7), (1.5, 12.5, 16.245)),
    "japanese_utf8": (5, (0, 0, 30), (0.8, 0.8, 35.986)),
    "chinese_gb18030": (5, (0, 100, -12), (0.16, 100.032, -10.974)),
    "chinese_utf8": (5, (0, 0, 2), (4, 1.32, 23.52)),
    "spanish_utf8": (6, (0, 1, 0.3), (1.667, 11, 18.257)),
    "italian_cp1252": (5, (0, 0, 0), (0.5, 0.75, 2.752)),
    "portuguese_cp1252": (5, (0, -2, 6), (0.5, -1.25, 33.5194)),
    "dutch": (5, (0, 0, 0.1), (0.333, 0.8333, 0.889)),
    "wavematrix": (9, (0, 0, 0.4), (0.125, 0.1, 0.565)),
    "unit_behind_name": (5, (0, 0, 5), (0.4, 0.4, 6.823))}
USUAL, LONGER = (10, (0, 0, 0.125), (4.5, 2.25, 4.625)), (11, (0, 0, 0.125), (5, 2.5, 5.125))
INCHES, PADDED = (10, (0, 0, 0.125 * POUND), (4.5, 57.15, 4.625 * POUND)), (40, (0, 0, 0.125), (19.5, 9.75, 19.625))
NUMBERS = "time=1,extension=2,load=3"
# File, options, readings, and part of a line that is told.
CASES = [
    ("side_by_side.csv", {"specimen": 1}, (9, (0, 0, 0.25), (4, 2, 8.25)), 'load is column 3 "Load" in N'),
    ("side_by_side.csv", {"specimen": 2}, (9, (0, 0, 0.125), (4, 2, 4.125)), "9 readings of specimen 2 of 2"),
    ("disp_and_ext.csv", {}, LONGER, 'column 3 "Extension (mm)", which goes over 0.25 mm'),
    ("extenso.csv", {}, LONGER, "--columns extension=3 would read it"),
    ("position_and_ext.csv", {}, (11, (0, 100, 0.125), (5, 102.5, 5.125)), 'extension is column 2 "Position (mm)"'),
    ("extenso.csv", {"columns": "extension=3"}, (11, (0, 0, 0.125), (5, 0.25, 5.125)), 'column 3 "Extension (mm)"'),
    ("downwards.csv", {}, (12, (0.8, -794, 0.5), (1.9, -795.8, 4.1)), "the extension falls from -794 to -796 mm"),
    ("neg_ext.csv", {"invert": "falling"}, USUAL, "10 readings"),
    ("neg_load.csv", {}, (10, (0, 0, -0.125), (4.5, 2.25, -4.625)), "the load falls from -0.125 to -4.62 N"),
    ("neg_load.csv", {"invert": "falling"}, USUAL, "the sign of load is turned"),
    ("neg_load.csv", {"invert": "both"}, (10, (0, 0, 0.125), (4.5, -2.25, 4.625)), "10 readings"),
    ("headerless.csv", {"columns": NUMBERS, "units": "time=min,extension=cm,load=daN"}, (12, (0, 0, 1.25), (330, 27.5, 56.25)),
     "load is column 3 in daN"),
    ("no_time.csv", {}, (11, (NAN, 0, 0.125), (NAN, 2.5, 5.125)), "no column of time"),
    ("no_time.csv", {"invert": "falling"}, (11, (NAN, 0, 0.125), (NAN, 2.5, 5.125)), "nothing falls, and --invert turns nothing"),
    ("no_units.csv", {"units": "time=s,extension=mm,load=N"}, LONGER, 'column 2 "Disp" in mm'),
    ("unit_Seconds_inches_lbs.csv", {}, INCHES, "in inches"),
    ("unit_minutes.csv", {}, (10, (0, 0, 0.125), (270, 2.25, 4.625)), "in minutes"),
    ("unit_s_in_lb.csv", {}, INCHES, "in lb"),
    ("unit_s_in_lb.csv", {"units": "load=kgf"}, (10, (0, 0, 0.125 * KILOGRAM), (4.5, 57.15, 4.625 * KILOGRAM)), "in kgf"),
    ("unit_s_mm_Newtons.csv", {}, USUAL, "in Newtons"), ("unit_seconds.csv", {}, USUAL, "in seconds"),
    ("form_prefix.csv", {}, LONGER, "C_1_Load[N]"), ("name_comp_ext.csv", {}, USUAL, "is the name of a test in compression"),
    ("name_en_zwick.csv", {}, USUAL, "Crosshead absolute"), ("name_fr_course_std.csv", {}, USUAL, "Course standard"),
    ("name_fr_zwick.csv", {}, USUAL, "Traverse absolue"), ("name_zw_grip.csv", {}, USUAL, "Grip to grip separation"),
    ("ctrl_z.csv", {}, PADDED, "40 readings"), ("nul_end.csv", {}, PADDED, "40 readings"), ("pipes.txt", {}, LONGER, "11 readings"),
    ("spaces.txt", {}, LONGER, 'load is column 3 "Load(N)"'),
    ("swiss.csv", {}, (10, (0, 0, 1000.5), (4.5, 2.25, 1004.5)), "10 readings"),
    ("unicode_minus.csv", {}, (10, (0, 0, -2.875), (4.5, 2.25, 1.625)), "10 readings"),
    ("spike.csv", {}, (60, (0, 0, 0), (6, 10, 14)), "row 20, whose extension of 5.4 mm lies far off"),
    ("mts793_blocks.dat", {}, (5, (1.25, 0.25, 12), (2.25, 3, 250)), "one test in 2 tables whose time goes on, with their names in rows 14 and 21"),
    ("mts793_blocks.dat", {}, (5, (1.25, 0.25, 12), (2.25, 3, 250)), "what stands below the names in row 27, such as extremes, is no part"),
    ("mts793_blocks.dat", {"columns": "time=2,extension=5,load=4"}, (5, (1.25, 0.25, 12), (2.25, 3, 250)), "one test in 2 tables"),
    ("mts793_padded.dat", {}, (5, (0.1, 5, 1), (0.5, 5.4, 16)), 'extension is column 3 "Axial Displacement"'),
    ("wavematrix_colon.csv", {}, (4, (0, -76.88, 1.6), (0.03, -76.16, 121.6)), 'load is column 8 "Load(8800 (0,3):Load) (kN)"'),
    ("wavematrix_colon.csv", {"columns": "time=1,extension=10,load=8"}, (4, (0, -0.03, 1.6), (0.03, -0.027, 121.6)), "4 readings"),
    ("wavematrix_two_cells.csv", {"columns": "load=6"}, (4, (0, 0, -0.8), (0.3, 0.15, 5.71)), "it begins with cycle 993, as a file"),
    ("mecmesin.csv", {"specimen": 2}, (3, (0, 0, 0.0601), (6, 0.5, 1.6601)), "3 readings of specimen 2 of 2"),
    ("testsuite.csv", {}, (3, (0.5, 0.1, 10), (1.5, 0.5, 90)), 'extension is column 2 "Axial Displacement"'),
    ("wintest.txt", {}, (3, (0, -6.02458, -0.73), (0.01, -5.974601, 0.94)), 'extension is column 2 "Disp" in mm'),
    ("linescale.csv", {}, (5, (0, NAN, 0), (0.1, NAN, 2 * KILOGRAM)), "--rate 36 takes that"),
    ("linescale.csv", {"rate": 10.0, "invert": "load"}, (5, (0, NAN, 0), (0.4, NAN, -2 * KILOGRAM)), "its loads are relative to 0.02 kgf"),
    ("no_time.csv", {"rate": 4.0, "needs_time": True}, (11, (0, 0, 0.125), (2.5, 2.5, 5.125)), "4 of them a second"),
    ("own_names.csv", {"columns": "time=Zeitpunkt,extension=Weg, oben,load=Messwert 2"},
     (2, (0, 1.25, 3.5), (0.5, 2.25, 4.5)), "2 readings")]
REFUSED = [
    ("side_by_side.csv", {}, "the file holds 2 specimens, side by side: choose one by --specimen 1 to 2"),
    ("side_by_side.csv", {"specimen": 3}, "--specimen is 3, but the file holds 2 specimens"),
    ("headerless.csv", {}, "such as --columns time=1,extension=2,load=3"),
    ("headerless.csv", {"columns": NUMBERS}, "the unit of column 1 is missing: give ms, s, "),
    ("headerless.csv", {"columns": "time=1,extension=2,load=7"}, "no row names the columns"),
    ("no_units.csv", {}, "the unit of column Time is missing: give ms, s, min or h, by --units time=UNIT"),
    ("no_time.csv", {"needs_time": True}, 'row 1 is "Extension (mm),Load (N)" and does not name time, whose known names'),
    ("book.xlsx", {}, "the file is a workbook (xlsx, ods) or another zip archive, and no text: save"),
    ("cr_only.csv", {}, "end with a carriage return alone, as on old Macs"),
    ("no_unit.csv", {}, "the unit of column Load is missing: give mN, cN, N, daN, kN, gf (g), kgf (kg, kp), lbf (lb), "),
    ("unknown_unit.csv", {}, "the unit of column Load is MPa, but must be mN, cN, N, daN"),
    ("cut_off.csv", {}, 'row 8: Load is "", but must be a number with "." before its decimals'),
    ("goes_back.csv", {}, "row 8: Time goes back to 0.3"),
    ("no_names.csv", {}, "no row names the columns extension and load; --columns takes other names, or numbers"),
    ("wavematrix_two_cells.csv", {}, 'two loads, column 4 "Load(Linear:Load) (N)" from 0 to 0.05 N and column 6 "Load(Linear:Small cell) (N)" from '
     "-0.8 to 5.71 N: choose one by --columns load=4 or load=6"), ("unit_s_in_lb.csv", {"rate": 2.0}, "but the file has times of its own"),
    ("empty", {}, "the file is empty"), ("not_there.csv", {}, "not_there.csv: no such file")]
HEAD, ROW = "Time;Extension;Load\ns;mm;N\n", "Time (s),Extension (mm),Load (N)\n"
TABLE = "Time,Extension,Load\n(s),(mm),(N)\n0,0,0\n"
TWO = "0,1,1.5\n1,2,2.5\n"  # readings (0, 1, 1.5) and (1, 2, 2.5)
# Forms of a text that all have these two.
FORMS = ["# " + ROW + TWO, "% Time (s)\tExt (mm)\tLoad (N)\n0\t1\t1.5\n1\t2\t2.5\n",
         '"Time\n(s)","Extension\r\n(mm)","Load\n(N)"\n' + TWO, ROW + "0.000,1.000,1.500\n1.000,2.000,2.500\n",
         ROW + "٠,١,١٫٥\n١,٢,٢٫٥\n", "Test 7\n(s),(mm),(N)\nTime,Extension,Load\n" + TWO, "\ufeff" + ROW + TWO,
         ROW.replace("(mm)", '(")') + "0,0.03937007874015748,1.5\n1,0.07874015748031496,2.5\n",
         (ROW + TWO).replace("\n", "\r\n"), (ROW + TWO).replace("\n", "\r\r\n"), (ROW + TWO).encode("utf-16-le"),
         (ROW + TWO).encode("utf-16-be"), "Time,Extension,Load\n,,\n(s),(mm),(N)\n,,\n0,1,1.5,,\n1,2,2.5\n"]
# One cell of load, and what it is [N].
LOADS = {**dict.fromkeys(["1\u2009234.5", "1\u202f234.5", "1\u3000234.5", "1\u2007234.5", "1\u2019234.5", "1'234.5", "1 234,50",
                          "1\xa0234,50", "1.234,5"], 1234.5),
         **dict.fromkeys(["\u22122.5", "\uff0d2.5", "\u20102.5"], -2.5), "1,234,567": 1234567.0, "1.234.567,5": 1234567.5}
UNITS = {"load": {1: ["N", "newton", "Newtons", "(N)", "[n]"], KILOGRAM: ["kg", "Kg.", "kgf", "kp", "kilograms"],
                  POUND: ["lb", "lbs", "LBF", "lb.", "pounds"], 1e-3 * KILOGRAM: ["g"], 1e3 * POUND: ["kip"], 10: ["daN"], 1e-3: ["mN"]},
         "extension": {0.0254: ["inch."]}, "time": {60: ["Min"]}}
# Parts of a refusal of a text, options.
TEXTS_REFUSED = [
    (ROW + "(s),(cm),(N)\n0,0,0\n", {}, "column Extension (mm) is cm below the name, but must be the same as in the name, mm"),
    ("Time,Extension,Load\n(s),(mm),(MN)\n0,0,0\n", {}, "is MN, but must be mN"),
    (HEAD + "2;2;2\n", {"units": "load=MPa"}, "--units is load=MPa, but must be"),
    ("Time,Extension,Load\n(s),(mm),(N)\n", {}, "no row of numbers follows the names"),
    ("Zeit,Traversenweg,Kraft\n(s),(mm),(N)\n0,10,0,33,1,25\n", {}, "row 3 has 6 cells, but must have 3 as there are names"),
    (TABLE + TABLE, {}, "holds 2 specimens, in tables that begin with rows 1 and 4"),
    (TABLE.replace("N", "kN") + "0,0,1e308\n", {}, "row 4: Load"), (TABLE + "0,0,nan\n", {}, "row 4: Load"),
    ('"Time\n(s)","Extension (mm)","Load (N)"\n0,1,2\n1,x,2\n', {}, "row 4: Extension"),
    (ROW.replace(",", ";") + "1,000;1,000;1,500\n2,000;2,000;2,500\n", {}, "tells which: a zero more behind its decimals would"),
    (ROW.replace("\n", "\r") + "0,1,1.5\r1,2,2.5\r\n", {}, "as on old Macs"),
    ("Time;Extension;Load\ns;mm;N\n0;0;1\n", {"columns": "extension=3,load=3"}, "another column for the extension"),
    ("Seil;3\nZeitpunkt;Kraft;Messweg\ns;N;mm\n0;1;2\n", {}, 'row 2 is "Zeitpunkt;Kraft;Messweg" and does not name time, whose known'),
    ("Time,Stroke,Force\ns,mm,N\n0,1,2\n", {"columns": "load=Cell 3"}, 'load, whose known names are "Cell 3" alone'),
    (ROW.replace("(N)", "(tonf)") + TWO, {}, "is tonf, which is 8896.44 N (2000 lbf) in one program and 9806.65 N (1000 kgf) in another"),
    ("Specimen,Maximum Load (N),Extension at Break (mm)\n1,5,2\n", {}, "is the head of a table of results, one row a specimen"),
    ("Total Time (s),Total Cycles,Load(Linear:Load):Maximum (N),Load(Linear:Load):Minimum (N)\n0,1,2,3\n", {}, "one row a cycle"),
    ("Total Time (s),Total Cycles,Position(A:Position) (mm),Load(A:Load) (N)\n" + "".join(f"{i},{i},1,{i}\n" for i in range(5)), {},
     "row 2: from here on there is one row a cycle, as in a file of trends"),
    ("LabVIEW Measurement\nSeparator\tTab\n***End_of_Header***\nX_Value\tUntitled\tUntitled 1\n0.0\t1.0\t2.0\n", {}, "file of LabVIEW (lvm)"),
    (HEAD + "0.5;0;1.25\n1;1;01. Mai\n", {}, "its decimals, of which a spreadsheet made something else"),
    ("6B:6C:05\nLogNo=002\nUnit=kN\nMode=ABS\nSpeed=40\n1.5\nx\n", {}, 'row 7 is "x", but must be a load'),
    ("6B:6C:05\nLogNo=002\nUnit=MPa\nMode=ABS\nSpeed=40\n1.5\n", {}, "Unit is MPa and Speed is 40, but must be"),
    ("Versuchzeit;Weg;Kraft\ns;mm;N\n0;1;2\n", {}, "whose known names are versuchszeit, time, test time, total time and "),
    *((HEAD + f"0.5;0;{load}\n", {}, "row 3: Load") for load in ("12,34", "0,123", "1234,567", "1,2345", ",123", "1,,234")),
    *((HEAD + row, {}, "may have decimals or thousands") for row in ("1;1;1,234\n", "1,500;1,250;1.201\n", "1;1;1.234\n")),
    *((mark + b"x", {}, words) for mark, words in ((b"\xD0\xCF\x11\xE0", "old workbook (xls)"), (b"%PDF-1.7\n", "a PDF"),
                                                   (b"\x1F\x8B\x08", "compressed"), (b"TDSm", "of LabVIEW (TDMS), and no text: export"),
                                                   (b"<?xml ", "XML or HTML"),
                                                   (b"#ROSBAG V2.0\n", "a bag, and no table of text: give the curve.csv of its run")))]
BELOW = ("ASCII Export File Version:,3\nSample / Slot Number:,2\nRecord,Index,Position,Strain,Time,Force\n,,µm,%,s,N\n"
         "101,0,10,0,0,0.5\n101,1,20,1.5,1,2.5\n\nSample / Slot Number:,5\nRecord,Index,Position,Strain,Time,Force\n,,µm,%,s,N\n"
         "200,0,0,0.5,0,0.30\n200,1,40,0.5,1,0.70\n")
SECOND = "0\t0\t1.5\t0\t0\t2.5\n1\t2\t3.5\t4\t5\t6.5\n"
# Texts of two specimens: the last reading of the second one.
PAIRS = [(BELOW, (1, 0.04, 0.7)),
         ("Time [s];C_1_Extension[mm];C_1_Load[N];C_2_Extension[mm];C_2_Load[N]\n0;0;1.5;0;2.5\n1;1;3;2;4\n", (1, 2, 4)),
         ("Time;Extension 1;Load 1;Extension 2;Load 2\ns;mm;N;mm;N\n0;0;1;0;2\n1;1;2;1;4\n2;2;3;;\n", (1, 1, 4)),
         *((names + SECOND, (4, 5, 6.5)) for names in (
             "Time_S\tDisp_mm\tForce_N\tTime_S.1\tDisp_mm.1\tForce_N.1\n",
             "Time (s)\tDisp (mm)\tForce (N)\tTime (s).1\tDisp (mm).1\tForce (N).1\n",
             "Time 1 (s)\tDisp 1 (mm)\tForce 1 (N)\tTime 2 (s)\tDisp 2 (mm)\tForce 2 (N)\n",
             "Time s (1)\tDisp mm (1)\tForce N (1)\tTime s (2)\tDisp mm (2)\tForce N (2)\n"))]


def raw_files():
    """The bytes of each file, by its name."""
    with open(os.path.join(HERE, "raw_data.txt"), encoding="utf-8") as file:
        entries = file.read()[2:].split("\n@ ")
    files = {"empty": b"", "book.xlsx": b"PK\x03\x04\x14\x00\x06\x00"}
    for entry in entries:
        head, text = entry.split("\n", 1)
        name, encoding, end, *mark = head.split()
        text = (text.rstrip("\n") + "\n").replace("\n", {"lf": "\n", "crlf": "\r\n"}[end])
        files[name] = (("\ufeff" if mark else "") + text).encode(encoding)
    padded = files.pop("padded.csv")
    files["wintest.txt"] = files["wintest.txt"].replace(b"~", b"\0")
    return {**files, "ctrl_z.csv": padded + b"\x1a", "nul_end.csv": padded + bytes(512), "cr_only.csv": padded.replace(b"\n", b"\r")}


FILES = raw_files()


class Raw(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def written(self, text, name="raw.csv"):
        with open(os.path.join(self.folder, name), "wb") as file:
            file.write(text if isinstance(text, bytes) else text.encode())
        return file.name

    def read(self, file, columns="", units="", needs_time=False, **options):
        return read_record(file, Reading(*(parsed_columns(text, option) if text else ("", "", "") for text, option in
                                           ((columns, "--columns"), (units, "--units"))), needs_time=needs_time, **options))

    def kept(self, name):
        """The path of one of FILES, or of none."""
        return self.written(FILES[name], name) if name in FILES else os.path.join(self.folder, name)

    def of_text(self, text, **options):
        return self.read(self.written(text), **options)

    def refusal(self, file, **options):
        with self.assertRaises(WrongInput, msg=(file, options)) as caught:
            self.read(file, **options)
        self.assertNotIn("\n", str(caught.exception))
        return str(caught.exception)

    def assert_readings(self, record, count, first, last):
        rows = readings_of(record)
        self.assertEqual(len(rows), count)
        for row, wanted in ((rows[0], first), (rows[-1], last)):
            for value, expected in zip(row, wanted):
                if not math.isnan(value) or not math.isnan(expected):
                    self.assertAlmostEqual(value, expected, delta=1e-9 * max(abs(expected), 1e-3))

    def test_files_of_bluehill_give_the_same_readings(self):
        for name in BLUEHILL_FILES.split():
            with self.subTest(name):
                record = self.read(self.kept(name + ".csv"), needs_time=True)
                self.assertEqual(len(readings_of(record)), len(BLUEHILL))
                for row, (time, extension, load) in zip(readings_of(record), BLUEHILL):
                    self.assertEqual(row[0], time)
                    # A decimal and its unit are each rounded once.
                    self.assertAlmostEqual(row[1], extension, delta=4e-16 * extension)
                    self.assertAlmostEqual(row[2], load, delta=4e-16 * load)
                self.assertEqual(set(record.columns["phase"]), {"pull"})

    def test_files_are_read_without_being_told_how(self):
        for name, wanted in EXPORTS.items():
            with self.subTest(name):
                self.assert_readings(self.read(self.kept(name + ".csv"), needs_time=True), *wanted)

    def test_every_case_is_read_and_told(self):
        for name, options, wanted, told in CASES:
            with self.subTest(name, **options):
                record = self.read(self.kept(name), **options)
                self.assert_readings(record, *wanted)
                self.assertIn(told, "\n".join(record.notes))

    def test_a_refusal_names_file_and_remedy(self):
        for name, options, why in REFUSED:
            with self.subTest(name, **options):
                said = self.refusal(self.kept(name), **options)
                self.assertIn(name, said)
                self.assertIn(why, said)
        for text, options, why in TEXTS_REFUSED:
            with self.subTest(text, **options):
                said = self.refusal(self.written(text), needs_time=True, **options)
                self.assertIn(why, said)
                self.assertLess(len(said) - len(self.folder), 520)

    def test_forms_are_read_as_they_are_meant(self):
        for text in FORMS:
            with self.subTest(text):
                self.assert_readings(self.of_text(text, needs_time=True), 2, (0, 1, 1.5), (1, 2, 2.5))
        named = self.of_text("# time extension load\n0 1 1.5\n1 2 2.5\n", units="time=s,extension=mm,load=N")
        self.assert_readings(named, 2, (0, 1, 1.5), (1, 2, 2.5))

    def test_one_number_tells_the_mark_of_all(self):
        for load, wanted in LOADS.items():
            self.assertEqual(self.of_text(HEAD + f"0;0;{load}\n").columns["load"], [wanted], load)
        for rows, wanted in (("0,000;0,000;0,000\n0,100;0,100;1,234\n", 1.234), ("0.5;1;1,234\n", 1234.0),
                             ("1,0000;1,000;1,500\n", 1.5)):
            self.assertEqual(self.of_text(HEAD + rows).columns["load"][-1], wanted)
        self.assertEqual(self.of_text((HEAD + "0;0;1~234,50\n").replace("~", "\xa0").encode("latin-1")).columns["load"], [1234.5])

    def test_units_are_spelt_as_people_spell_them(self):
        for quantity, sizes in UNITS.items():
            for size, spellings in sizes.items():
                for unit in spellings:
                    units = {"time": "s", "extension": "mm", "load": "N", quantity: unit}
                    value, = self.of_text(f"Time;Extension;Load\n{';'.join(units.values())}\n2;2;2\n").columns[quantity]
                    self.assertAlmostEqual(value / size, 2.0, 12, unit)

    def test_of_several_specimens_one_is_chosen(self):
        for text, last in PAIRS:
            with self.subTest(text):
                self.assertIn("the file holds 2 specimens, ", self.refusal(self.written(text)))
                second = self.of_text(text, specimen=2)
                self.assert_readings(second, 2, readings_of(second)[0], last)
                self.assertIn("specimen 1 of 2", self.of_text(text, specimen=1).notes[0])

    def test_the_crosshead_counts_beside_an_extensometer(self):
        head = "Prüfzeit;Standardweg;Traverse abs.;Standardkraft\ns;mm;mm;N\n"
        record = self.of_text(head + "0;0;250,0;1,5\n1;0,01;251,0;3,5\n2;0,02;252,0;5,5\n")
        self.assertAlmostEqual(record.columns["extension"][-1], 0.252, 12)
        self.assertIn('column 2 "Standardweg", which goes over 0.02 mm, is not read', record.notes[1])
        # Where both go the same way it is the machine's own extension.
        same = self.of_text("Time;Extension;Position;Load\ns;mm;mm;N\n0;0;250.0;1.5\n1;1.0;251.0;3.5\n2;2;252.0;5.5\n")
        self.assertAlmostEqual(same.columns["extension"][-1], 0.002, 12)
        cells = "Time;Extension;Load 1;Load 2\ns;mm;N;N\n0;0;1;3\n1;1;2;6\n"
        self.assertIn("choose one by --columns load=3 or load=4", self.refusal(self.written(cells)))
        self.assertEqual(self.of_text(cells, columns="load=4").columns["load"], [3.0, 6.0])
        self.assertIn('column 4 "Load 2" is not read; --columns load=4 would read it',
                      self.of_text(cells.replace("3\n", "1\n").replace("6\n", "2.01\n")).notes[1])

    def test_outliers_are_left_out_and_steps_are_not(self):
        """Of ten readings two, with one between them."""
        def of(extensions):
            return self.of_text("Time,Extension,Load\ns,mm,N\n" + "".join(f"{i},{s},{i}\n" for i, s in enumerate(extensions)))

        many = of(-5000 if i % 10 in (1, 3) else i for i in range(2001))
        self.assertEqual([round(1e3 * s) for s in many.columns["extension"]], many.columns["load"])
        self.assertEqual((len(many.columns["load"]), len(many.notes)), (1601, 7))
        self.assertIn("row 24, whose extension of -5000 mm lies far off the readings before and behind it", many.notes[5])
        self.assertIn("395 other rows are left out for the same reason", many.notes[6])
        self.assertEqual(len(of(5 if i % 4 < 2 else 0 for i in range(20)).columns["load"]), 20)
        self.assertIn("and with it its load of 21 N", many.notes[5])

    def test_spikes_are_found_and_nothing_else_is_touched(self):
        """Of 20 drawn records: pulls, cycles of many and of few readings, breaks, noise, and coarse encoders."""
        for seed in range(20):
            draw = random.Random(seed)
            s, load = drawn_record(draw)
            for spiked in (False, True):
                dirty, far, places = list(s), 12.0 * max(abs(b - a) for a, b in zip(s, s[1:])), set()
                while spiked and len(places) < 1 + len(s) // 80:
                    i = draw.randrange(3, len(s) - 4)
                    if places.isdisjoint(range(i - 3, i + 4)) and abs(load[i + 1] - load[i]) < 0.1 * max(load):
                        places.add(i)
                        dirty[i] += draw.choice((-1, 1)) * draw.uniform(1.0, 5.0) * max(far, 0.2 * max(s))
                rows = [f"{0.1 * i:.1f},{dirty[i]:.6f},{load[i]:.4f}" for i in range(len(s))]
                read = self.of_text("Time,Extension,Load\ns,mm,N\n" + "\n".join(rows) + "\n")
                kept = [round(10.0 * time) for time in read.columns["time"]]
                self.assertEqual(set(range(len(s))) - set(kept), places, (seed, spiked))
                self.assertEqual(read.columns["load"], [round(load[i], 4) for i in kept], (seed, spiked))

    def test_a_zero_set_within_the_record_is_joined_if_asked(self):
        """At rest with the load zeroed, too, in motion, and in inches; steps and breaks of a test are none."""
        rest = [(-14.84 - 0.001 * (i % 3), 3.0 + 0.01 * (i % 2)) for i in range(20)]
        pull = [(0.05 * i, 5.0 * i) for i in range(100)]
        moving = [(5.0 + 0.05 * i, 3.0 + 0.5 * i) for i in range(20)] + [(0.05 * i, 13.0 + 0.5 * i) for i in range(100)]
        for rows, top in ((rest + pull, 495.0), ([(s, 0.0) for s, _ in rest] + pull, 495.0), (moving, 62.5)):
            text = "Time,Extension,Load\ns,in,N\n" + "".join(f"{0.5 * i},{s:.4f},{load:.3f}\n" for i, (s, load) in enumerate(rows))
            self.assertIn("row 23: the extension jumps by ", self.refusal(self.written(text)))
            joined = self.of_text(text, join=True)
            self.assertLess(max(abs(b - a) for a, b in zip(joined.columns["extension"], joined.columns["extension"][1:])), 0.06 * 0.0254)
            self.assertEqual((len(joined.columns["load"]), joined.columns["load"][-1]), (120, top))
            self.assertIn("joined at row 23, where the crosshead was set to zero", "\n".join(joined.notes))
        for rows in ([(i // 10, i // 10) for i in range(60)], [(5.0 * (i // 10 % 2), 9.0 * (i // 10 % 2) + i // 20) for i in range(60)],
                     [(0.01 * i, i) for i in range(40)] + [(0.05, 0.0)] * 9):
            text = "Time,Extension,Load\ns,mm,N\n" + "".join(f"{i},{s},{load}\n" for i, (s, load) in enumerate(rows))
            self.assertEqual(len(self.of_text(text).columns["load"]), len(rows))

    def test_what_a_spreadsheet_spoilt_is_refused(self):
        """Of numbers with fixed decimals, with and without zeros behind them; numbers of four digits, of which 524.7 is and 1152, are sound."""
        def of(cells, mark):
            return HEAD + "".join(f"{i};{cell.replace(',', '.').replace('.', mark)};1\n" for i, cell in enumerate(cells))

        values = [0.1 + 0.0321 * i for i in range(200)]
        for mark in ",.":
            for form in (".4f", ".5f", ".6f"):
                for cells in ([f"{value:{form}}" for value in values], [f"{value:{form}}".rstrip("0").rstrip(".") for value in values]):
                    self.assertEqual(len(self.of_text(of(cells, mark)).columns["load"]), 200)
                    spoilt = [f"{int(cell.replace('.', '')):,}" if cell[0] != "0" and len(cell.partition(".")[2]) > 2 else cell for cell in cells]
                    said = self.refusal(self.written(of(spoilt, mark)))
                    self.assertIn("a spreadsheet took decimals for thousands and moved the mark", said)
                    self.assertIn("row 32: Extension is 1", said)
            for low, rise in ((0.01, 1.07), (524.7, 1.02), (-43.0, 1.01)):
                self.assertEqual(len(self.of_text(of([f"{low * rise**i:.4g}" for i in range(140)], mark)).columns["load"]), 140)

    def test_options_have_a_form(self):
        for wrong in ("", "Zeit", "zeit=Zeit", "time=", "time=a,time=b", "Weg,time=a"):
            with self.assertRaises(WrongInput, msg=wrong):
                parsed_columns(wrong, "--columns")

    def test_a_curve_that_a_spreadsheet_saved_is_the_curve(self):
        text = FILES["excel_bom.csv"]
        european = text.translate(bytes.maketrans(b",.", b";,")) + b";;;;;;\r\n"
        for content in (text, european):
            record = self.of_text(content)
            self.assertIn("a curve.csv that a spreadsheet saved anew", record.notes[0])
            self.assertEqual([len(record.columns["time"]), *(record.columns["phase"][i] for i in (0, 4))], [11, "idle", "pull"])
            self.assertEqual(record.columns["end_to_end"][4], 0.24602)

    def imported(self, *words):
        return subprocess.run([PROGRAM, *words], cwd=self.folder, check=False, capture_output=True, text=True)

    def test_the_program_writes_a_curve_once(self):
        self.written(TABLE + "1,1,2\n")
        done = self.imported("raw.csv", "curve.csv", "--invert")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("raw.csv: 2 readings: time is column 1 \"Time\" in s", done.stdout)
        self.assertIn("2 readings over 1 s written to curve.csv", done.stdout)
        with open(os.path.join(self.folder, "curve.csv"), encoding="utf-8") as file:
            self.assertEqual(file.read().splitlines()[::3], ["time,extension,load,knot_distance,end_to_end,load_lower,phase,balance_offset",
                                                             "1,0.001,2,nan,nan,nan,pull,0"])
        for words in (["raw.csv", "curve.csv"], ["raw.csv", "raw.csv", "--overwrite"], ["curve.csv", "raw.csv", "--overwrite"],
                      ["no.csv", "x.csv"], ["raw.csv", "x.csv", "--specimen", "0"], ["raw.csv", "x.csv", "--invert=up"], ["raw.csv"],
                      ["raw.csv", "x.csv", "--units", "N"], ["raw.csv", "x.csv", "--wrong"]):
            refused = self.imported(*words)
            self.assertEqual((refused.returncode, refused.stdout, refused.stderr.count("\n")), (2, "", 1), refused.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "x.csv")))
        self.assertEqual(self.imported("raw.csv", "no/curve.csv").returncode, 1)
        again = self.imported("curve.csv", "again.csv", "--units", "load=kN")
        self.assertIn("the curve is one of knot_utm, for which --units changes nothing", again.stdout)
        self.assertEqual(self.imported("raw.csv", "curve.csv", "--overwrite", "--quiet").stdout, "")


def drawn_record(draw):
    """Extensions [mm] and loads [N] of a test, with or without cycles, a break, noise and a coarse encoder."""
    far, step, s = draw.uniform(2.0, 30.0), draw.choice((0.01, 0.05, 0.2)), [0.0] * draw.randrange(5, 60)
    turns = [far, 0.3 * far] * draw.randrange(4) + [1.2 * far]
    if draw.random() < 0.3:  # few readings a cycle
        s += [far * (1.0 - abs(i % 5 / 2.5 - 1.0)) for i in range(60)]
    for turn in turns:
        count = max(int(abs(turn - s[-1]) / (step * far)), 1)
        s += [s[-1] + (turn - s[-1]) * (i + 1) / count for i in range(count)]
    load = [30.0 * value for value in s]
    if draw.random() < 0.6:  # the last reading before the fall is far on, and the crosshead springs back
        s, load = s + [1.22 * far] + [draw.choice((1.0, 1.22)) * far] * 20, load + [1.01 * load[-1]] + [0.5] * 20
    noise, encoder = draw.choice((0.0, 0.001, 0.008)), draw.choice((1e-6, 0.001, 0.008))
    return [encoder * round((value + draw.gauss(0.0, noise)) / encoder) for value in s], load


def readings_of(record):
    """[s], [mm], [N]."""
    return [(time, 1e3 * extension, load) for time, extension, load in zip(*(record.columns[name] for name in ("time", "extension", "load")))]


class Balance(unittest.TestCase):
    COMPARE = os.path.join(os.environ.get("KNOT_UTM_TOOLS_DIR", os.path.join(HERE, "../../build/devel/lib/knot_utm")), "compare")

    def test_zero_is_that_of_compare(self):
        # At rest with some noise, a touch backwards, and then a pull.
        rows = [(0.0, 10.0, 3.1), (0.1, 10.0004, 3.3), (0.2, 9.9998, 3.2), (0.3, 10.0, 3.4)] + [(0.4 + i, 10.1 + i, 4.0 + 7 * i) for i in range(5)]
        with tempfile.TemporaryDirectory() as folder:
            raw, plain, balanced = (os.path.join(folder, name) for name in ("raw.csv", "plain.csv", "balanced.csv"))
            with open(raw, "w", encoding="utf-8") as file:
                file.write("Time (s),Extension (mm),Load (N)\n" + "".join(f"{t},{s},{f}\n" for t, s, f in rows))
            for out, *more in ((plain, "--quiet"), (balanced, "--balance")):
                said = subprocess.run([sys.executable, PROGRAM, raw, out, *more], check=True, capture_output=True, text=True).stdout
            self.assertIn("zero is 3.25 N at", said)
            with open(balanced, encoding="utf-8") as file:
                first, *_, last = [[float(cell) for cell in line.split(",")[:3]] for line in file.read().splitlines()[2:]]
            self.assertEqual((first[0], last[0]), (0.3, 4.4))
            self.assertAlmostEqual(first[2], 0.15, places=12)
            if not os.path.exists(self.COMPARE):
                self.skipTest("compare is not built")
            told = subprocess.run([self.COMPARE, plain, balanced], check=True, capture_output=True, text=True).stderr
            self.assertIn(said[said.index("zero is "):].splitlines()[0], told)


if __name__ == "__main__":
    unittest.main()
