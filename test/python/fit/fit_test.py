#!/usr/bin/python3
"""scripts/fit: hidden values are found, what cannot be told is told so, what cannot be fitted is refused."""
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from head import ROOT, TOOLS, content, write

import pandas as pd

import knot_utm
from knot_utm.fitting.found import write_report
from knot_utm.yaml_text import load, text_of

CELL = {"machine.load_cell.accuracy": 0.005, "machine.load_cell.noise": 1.0}
STRETCH = "material.stretching_stiffness"
ROLLER = "machine.roller_friction"
SHORT = {"program.pull.until.extension": 0.008}  # the rod does not part
PULLED = {**SHORT, **CELL}


class Fits(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def measured(self, name, method, **settings):
        """The curve of a test that the fit knows nothing of."""
        knot_utm.run(method, self.path(name), **{"machine.load_cell.seed": 7, **settings})
        return self.path(name, "curve.csv")

    def straight(self, name="record", **settings):
        return self.measured(name, "straight", **{STRETCH: 6.1e4, **SHORT, **CELL, **settings})

    def altered(self, name, file, **columns):
        """The same curve, with columns as functions of the table."""
        lines = content(file).decode().splitlines(keepends=True)
        table = pd.read_csv(file, skiprows=[1])
        for column, of in columns.items():
            table[column] = of(table)
        with open(self.path(name), "w", encoding="utf-8") as out:
            out.writelines(lines[:2])
            table.to_csv(out, index=False, header=False)
        return self.path(name)

    def command(self, *words, settings=None, code=0, tools=TOOLS):
        sets = [word for key, value in (settings or {}).items() for word in ("--set", f"{key}={text_of(value)}")]
        done = subprocess.run([os.path.join(ROOT, "scripts/fit"), *words, *sets], cwd=self.folder, check=False, text=True,
                              env={**os.environ, "KNOT_UTM_SKIP_BUILD": "1", "KNOT_UTM_TOOLS_DIR": tools},
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def fit(self, out, *words, settings=None, code=0):
        """What fit.yaml says, and what the command said."""
        said = self.command(*words, "--out", self.path(out), "--no-report", settings=settings, code=code)
        return load(self.path(out, "fit.yaml")), said

    def assert_found(self, found, truth):
        self.assertTrue(found["identifiable"])
        self.assertLessEqual(found["low"], truth)
        self.assertLessEqual(truth, found["high"])
        self.assertLess(found["low"], found["value"])
        self.assertLess(found["value"], found["high"])
        self.assertLess(found["high"] - found["low"], 0.1 * truth, "the interval tells something")


class Hidden(Fits):
    def test_stiffness_of_a_straight_rod_is_found(self):
        record = self.straight()
        fitted, said = self.fit("fit", record, "straight", "--free", STRETCH, "--jobs", "1", settings=PULLED)
        self.assert_found(fitted[STRETCH], 6.1e4)
        self.assertTrue(fitted["fits"])
        self.assertLess(fitted["rms"], 3.0)
        self.assertIn(f"{STRETCH}: ", said)
        method = load(self.path("fit/method.yaml"))
        self.assertEqual(method["material"]["stretching_stiffness"], fitted[STRETCH]["value"])
        self.assertEqual(method["machine"]["load_cell"]["noise"], 1.0, "the cell of the method")
        self.fit("same", record, "straight", "--free", STRETCH, "--jobs", "3", settings=PULLED)
        for name in ("fit.yaml", "method.yaml", "curves.csv", "profiles.csv"):
            self.assertEqual(content(self.path("fit", name)), content(self.path("same", name)), "the same bytes whatever the jobs")

    def test_it_has_a_page(self):
        words = [self.straight(), "straight", "--free", STRETCH, "record.force_offset", "--out", self.path("fit")]
        self.command(*words, settings=PULLED)
        page = content(self.path("fit/report.html")).decode()
        self.assertIn("fit.yaml exists already", self.command(*words, settings=PULLED, code=2))
        for word in (f'data-key="{STRETCH}"', 'data-key="record.force_offset"', "The curve fits within the errors",
                     "record/curve.csv", f"{STRETCH}, record.force_offset", "curves.csv", "profiles.csv"):
            self.assertIn(word, page)
        write(self.path("fit/fit.yaml"), text_of({**load(self.path("fit/fit.yaml")), "fits": False}))
        write_report(self.path("fit"), "a test")
        self.assertEqual(content(self.path("fit/report.html")).decode().count("the values and their intervals mean little"), 1)

    def test_friction_on_a_post_is_found_from_two_records(self):
        truth, cell = 0.23, {**CELL, "machine.load_cell.noise": 0.05}
        files = [self.measured(name, "capstan", **{ROLLER: truth, "specimen.wrap": wrap, **cell})
                 for name, wrap in (("a", 6.0), ("b", 4.0))]
        fitted, _ = self.fit("fit", files[0], "capstan", "--free", ROLLER + "=0.05:0.8", "--also", files[1], "specimen.wrap=4.0",
                             settings={"specimen.wrap": 6.0, **cell})
        self.assert_found(fitted[ROLLER], truth)
        for name, wrap in (("method.yaml", 6.0), ("method_2.yaml", 4.0)):
            self.assertEqual(load(self.path("fit", name))["specimen"]["wrap"], wrap)

    def test_raw_data_of_a_machine_are_read(self):
        table = pd.read_csv(self.straight(), skiprows=[1])
        table = table[table["phase"].isin(["balance", "pull"])]
        with open(self.path("raw.csv"), "w", encoding="utf-8") as file:
            file.write("Time,Extension,Load\n(s),(mm),(N)\n")
            for row in table.itertuples():
                file.write(f"{row.time:.4f},{1e3 * row.extension + 3.0:.5f},{row.load + 5.0:.4f}\n")
        fitted, said = self.fit("fit", "raw.csv", "straight", "--free", STRETCH, settings=PULLED)
        self.assert_found(fitted[STRETCH], 6.1e4)
        self.assertRegex(said, "raw.csv: [0-9]+ readings: time is column 1")
        # The same in compression, as some machines sign it.
        rows = pd.read_csv(self.path("raw.csv"), skiprows=[1])
        for name, column in (("load.csv", "Load"), ("extension.csv", "Extension")):
            text = rows.assign(**{column: -rows[column]}).to_csv(index=False)
            write(self.path(name), text.replace("\n", "\n(s),(mm),(N)\n", 1))
            refused = self.command(name, "straight", "--free", STRETCH, settings=PULLED, code=2)
            self.assertEqual(refused.count("\n"), 1, refused)
            self.assertRegex(refused, f"{name}: .*--invert turns")
        turned, _ = self.fit("turned", "load.csv", "straight", "--free", STRETCH, "--invert", settings=PULLED)
        self.assertEqual(turned[STRETCH], fitted[STRETCH])
        said = self.command("raw.csv", self.path("fit/method.yaml"), "--free", STRETCH, "--out", self.path("fit"), "--overwrite", code=2)
        self.assertIn("method.yaml is an input, and would be written over", said)


class Broken(Fits):
    def test_tool_is_told_in_a_line(self):
        """As one whose library was built anew."""
        record = self.straight()
        write(self.path("tensile_test"), "#!/bin/sh\nkill -SEGV $$\n")
        os.chmod(self.path("tensile_test"), 0o755)
        said = self.command(record, "straight", "--free", STRETCH, "--out", self.path("fit"), code=1, tools=self.folder)
        self.assertEqual(said, "fit: tensile_test failed at --list-method-keys: exit code -11\n")


class Untold(Fits):
    def test_two_springs_in_a_row_are_known_together_only(self):
        fitted, said = self.fit("fit", self.straight(), "straight", "--free", STRETCH, "machine.stiffness=1e5:1e8", settings=PULLED)
        for key in (STRETCH, "machine.stiffness"):
            self.assertEqual((fitted[key]["high"], fitted[key]["identifiable"]), (None, False))
            self.assertIn(f"{key} is not identifiable: the data only tell that it is above", said)
        self.assertLess(fitted["correlation"][STRETCH]["machine.stiffness"], -0.9)
        self.assertIn("only known together", said)

    def test_what_does_not_fit_is_told_so(self):
        record = self.altered("bent.csv", self.straight(), load=lambda table: table["load"] * (0.5 + 60.0 * table["extension"]))
        fitted, said = self.fit("fit", record, "straight", "--free", STRETCH, settings=PULLED, code=1)
        self.assertFalse(fitted["fits"])
        self.assertIn("nothing fits within the errors", said)


class Refused(Fits):
    def refused(self, *words, says, settings=None):
        said = self.command("--out", self.path("fit"), *words, settings=PULLED if settings is None else settings, code=2)
        self.assertEqual(said.count("\n"), 1, said)
        self.assertIn(says, said)
        self.assertFalse(os.path.exists(self.path("fit")))

    def test_in_one_line_before_anything_is_written(self):
        record = self.straight()
        self.refused(record, "straight", says="--free is missing")
        self.refused(record, "straight", "--free", "material.stifness=1:2",
                     says="material.stifness is no key of a method; the keys of material")
        self.refused(record, "straight", "--free", STRETCH + "=-5:10", says="material.stretching_stiffness is -5")
        self.refused(record, "straight", "--free", STRETCH + "=10:5", says="low:high")
        self.refused(record, "straight", "--free", STRETCH, STRETCH, says="twice")
        self.refused(record, "straight", "--free", "record.force_offset", says="nothing but offsets")
        self.refused(record, "straight", "--free", "machine.stiffness", says="give --free machine.stiffness=low:high")
        self.refused(record, "strait", "--free", STRETCH, says="method is strait")
        self.refused("absent.csv", "straight", "--free", STRETCH, says="absent.csv: no such file")
        self.refused(record, "straight", "--free", STRETCH, settings={}, says="machine.load_cell.accuracy")
        self.refused(record, "straight", "--free", STRETCH, settings={**PULLED, "specimen.lenght": 1},
                     says="--set: specimen.lenght is no key of a method; did you mean specimen.length?")
        self.refused(record, "straight", "--free", STRETCH, "--also", record, "specimen.lenght=1",
                     says=f"--also {record}: specimen.lenght is no key of a method; did you mean specimen.length?")
        self.refused(record, "straight", "--free", "specimen.knot=0:1",
                     says="--free: specimen.knot is straight, but only a number that acts on the test may be free")
        self.refused(record, "straight", "--free", STRETCH, "--out", os.path.dirname(record), says="holds a run")
        self.refused(record, "straight", "--free", "machine.load_cell.noise=0:1", says="machine.load_cell.noise is an error of the cell")
        self.refused(record, "straight", "--free", STRETCH, "--also", record, STRETCH + "=5e4", says=STRETCH + " is set, but it is free")
        self.refused(record, "overhand", "--free", "specimen.turns=1:3", says="specimen.turns is 1.8642, but must be a whole number",
                     settings=CELL)

    def test_where_a_corner_of_the_ranges_is_refused_before_the_first_run(self):
        """Each end of each range alone is allowed: the strength is what the pre-load must not reach."""
        settings = {**CELL, "physics.accuracy": "draft"}
        self.refused(self.straight(), "tighten", "--free", "specimen.preload=50:1000", "material.breaking_force=900:4000",
                     says="a run with specimen.preload=1000.0, material.breaking_force=900.0 would be refused", settings=settings)

    def test_where_the_method_cannot_produce_the_curve(self):
        record = self.straight()
        for column in ("extension", "load"):
            milli = self.altered("milli.csv", record, **{column: lambda table, column=column: 1e3 * table[column]})
            self.refused(milli, "straight", "--free", STRETCH, says="other units")
        self.refused(record, "straight", "--free", STRETCH, says="let it go on",
                     settings={**CELL, "program.pull.until.extension": 0.004})
        for name, text in (("empty.csv", ""), ("words.csv", "a,b\nc,d\n"), ("short.csv", content(record).decode()[:120])):
            with open(self.path(name), "w", encoding="utf-8") as file:
                file.write(text)
            self.refused(self.path(name), "straight", "--free", STRETCH, says=name)
        nothing = self.altered("nothing.csv", record, phase=lambda table: "hold")
        self.refused(nothing, "straight", "--free", STRETCH, says="nothing is pulled")


if __name__ == "__main__":
    unittest.main()
