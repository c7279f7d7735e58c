#!/usr/bin/python3
"""The Python package knot_utm: a run, a batch and a sweep made by it and read by it, and its place among the messages of ROS.
Skipped, with exit code 77, where a module is not installed."""
import copy
import os
import re
import subprocess
import sys
import unittest

from sweeps import CONFIG, LENGTHS, ROOT, Sweeps, read, rows, write

import matplotlib
import numpy as np

import knot_utm
from knot_utm import tool
from knot_utm.yaml_text import load

matplotlib.use("Agg")  # with and without a display

DRAFT = {"physics.accuracy": "draft"}
# Such knots come undone once they are let go.
SLIPPERY = {"material.bending_law": "elastic", "material.friction_couple": 0, "material.friction_coefficient": 0.05}


class Package(Sweeps):
    def test_a_shipped_method_is_found_by_its_name(self):
        standard = os.path.join(CONFIG, "standards/usp_881_knot_pull.yaml")
        for name, file in (("tighten", CONFIG + "/tighten.yaml"), ("usp_881_knot_pull", standard),
                           ("usp_881_knot_pull.yaml", standard), ("standards/usp_881_knot_pull", standard)):
            self.assertEqual(tool.find_method(name, self.folder), file)
        for name in ("nylon", "preload", "../tighten.yaml"):
            with self.assertRaisesRegex(knot_utm.WrongInput, f"method is {name}"):
                tool.find_method(name, self.folder)

    def test_a_run_is_made_and_read_with_units(self):
        out = self.path("run")
        run = knot_utm.run("straight", out, **{"physics.accuracy": "draft", "specimen.length": 0.2})
        self.assertEqual(run.method["specimen"]["length"], 0.2)
        self.assertEqual(run.results["peak_force"], load(os.path.join(out, "result.yaml"))["peak_force"])
        self.assertEqual(run.results.attrs["units"]["peak_force"], "N")
        names, units, *values = rows(read(out, "curve.csv"))
        self.assertEqual(run.curve.attrs["units"], dict(zip(names, units)))
        self.assertEqual(list(run.curve["load"]), [float(row[names.index("load")]) for row in values])
        with self.assertRaisesRegex(knot_utm.WrongInput, "holds a run already: choose another folder, or overwrite=True"):
            knot_utm.run("straight", out)
        self.is_a_dict_of_its_readings(run)
        self.is_drawn(run)
        again = knot_utm.run("straight", out, overwrite=True, **DRAFT)
        self.assertEqual(again.method["specimen"]["length"], 0.25)

    def is_a_dict_of_its_readings(self, run):
        self.assertEqual((list(run), len(run), list(run.values())), (list(run.results.index), len(run.results), list(run.results)))
        self.assertEqual(dict(run.items())["peak_force"], run["peak_force"])
        self.assertTrue("peak_force" in run and "peek_force" not in run)
        self.assertEqual((run.get("peak_force"), run.get("peek_force", 3)), (run["peak_force"], 3))
        with self.assertRaisesRegex(KeyError, "no reading 'peek_force'; did you mean peak_force?"):
            run["peek_force"]
        self.assertEqual(copy.copy(run).folder, run.folder)
        self.assertRegex(repr(run), rf"^<Run {re.escape(run.folder)}: ended by extension, largest load 3\d* N, 0 warnings>$")

    def is_drawn(self, run):
        pulled = run.curve[run.curve["phase"] == "pull"]
        axes = run.plot(label="mine")
        line, = axes.get_lines()
        np.testing.assert_allclose(line.get_xdata(), 1e3 * pulled["extension"])
        np.testing.assert_allclose(line.get_ydata(), pulled["load"])
        self.assertEqual((line.get_label(), axes.get_xlabel(), axes.get_ylabel()), ("mine", "extension [mm]", "load [N]"))
        self.assertIs(run.plot(axes), axes)

    def test_what_it_warns_of_are_warnings_and_a_test_that_failed_raises(self):
        # Nothing pulls the knot tight, so that it stays a loose loop.
        loose = {**DRAFT, "program": [{"hold": {"duration": 1}}, {"pull": {"speed": 0.01, "until": {"extension": 0.001}}}]}
        with self.assertWarnsRegex(knot_utm.RunWarning, "the knot was still loose") as caught:
            run = knot_utm.run("overhand", self.path("loose"), **loose)
        self.assertEqual(caught.filename, __file__, "the line is the caller's")
        self.assertEqual([str(one.message) for one in caught.warnings], run.warnings)
        with self.assertRaisesRegex(knot_utm.RunFailed, f"^{self.path('undone')}: the knot came undone: ") as raised:
            knot_utm.run("tighten", self.path("undone"), **DRAFT, **SLIPPERY)
        self.assertEqual(raised.exception.run["ended_by"], "untangled")
        self.assertEqual(knot_utm.read(self.path("undone"))["ended_by"], "untangled", "reading it raises nothing")

    def test_a_run_is_one_specimen_whatever_the_method_says(self):
        method = write(self.path("method.yaml"), read(CONFIG, "straight.yaml") + "specimens: {count: 3}\n")
        run = knot_utm.run(method, self.path("run"), **DRAFT)
        alone = knot_utm.run("straight", self.path("alone"), **DRAFT)
        self.assertTrue(run.curve.equals(alone.curve))
        with self.assertRaisesRegex(knot_utm.WrongInput, "specimens.count is 3, but run tests one specimen"):
            knot_utm.run("straight", self.path("more"), **{"specimens.count": 3})

    def test_what_is_refused_raises(self):
        with self.assertRaisesRegex(knot_utm.WrongInput, "specimen.length is -1"):
            knot_utm.run("straight", self.path("run"), **{"specimen.length": -1})
        with self.assertRaisesRegex(knot_utm.WrongInput, r"method is strait, .*; did you mean straight\?"):
            knot_utm.run("strait", self.path("run"))
        with self.assertRaisesRegex(knot_utm.WrongInput, "no such file"):
            knot_utm.read(self.path("run"))

    def test_messages_of_ros_are_a_part_of_it(self):
        os.makedirs(self.path("devel/knot_utm/msg"))
        write(self.path("devel/knot_utm/__init__.py"), "")
        write(self.path("devel/knot_utm/msg/__init__.py"), "Crosshead = 'a message'")
        path = os.pathsep.join([os.path.join(ROOT, "python"), self.path("devel")])
        asks = ("import sys, knot_utm.msg; print(knot_utm.msg.Crosshead, 'pandas' in sys.modules, knot_utm.read, "
                "'pandas' in sys.modules)")
        said = subprocess.run([sys.executable, "-Bc", asks], env={**os.environ, "PYTHONPATH": path}, check=True, text=True,
                              stdout=subprocess.PIPE).stdout
        self.assertRegex(said, "^a message False <function read .*> True$", "they need no pandas")

    def test_has_the_names_that_it_lists(self):
        for name in knot_utm.__all__:
            self.assertTrue(callable(getattr(knot_utm, name)), name)
            self.assertIn(name, dir(knot_utm))
        with self.assertRaisesRegex(AttributeError, "no attribute 'pull'"):
            knot_utm.pull
        self.assertIn(f"<version>{knot_utm.__version__}</version>", read(ROOT, "package.xml"))
        self.assertEqual(tool.version(), knot_utm.__version__)

    def test_a_sweep_gives_its_table(self):
        table = knot_utm.sweep(self.study, self.path("out"), jobs=1)
        self.assertEqual(list(table["specimen.length"]), LENGTHS)
        self.assertEqual(table.attrs["units"]["specimen.length"], "m")
        self.assertTrue((table["peak_force"] > 0).all())


class ABatch(Sweeps):
    SCATTER = {"specimens.scatter": {"specimen.length": {"normal": 0.1}, "material.breaking_force": {"normal": 0.1}}}

    def batch(self, out, specimens=4, **overrides):
        return knot_utm.batch("straight", self.path(out), specimens, **DRAFT, **self.SCATTER, **overrides)

    def test_has_the_statistics_that_tensile_test_wrote_with_units(self):
        batch = self.batch("out")
        told = load(self.path("out", "statistics.yaml"))
        of_peak = batch.statistics.loc["peak_force"]
        self.assertEqual(of_peak.to_dict(), told["peak_force"])
        self.assertEqual(of_peak["n"], 4)
        self.assertGreater(of_peak["sd"], 0)
        self.assertEqual(batch.statistics.attrs["units"]["peak_force"], "N")
        self.assertEqual(set(batch.statistics.index), {key for key, value in told.items() if isinstance(value, dict) and "mean" in value})
        self.assertTrue(np.isnan(batch.statistics.loc["lock_extension", "mean"]), "no specimen has it")
        self.assertEqual(batch.rejected, {})
        self.assertEqual(batch.method["specimens"]["count"], 4)

    def test_has_a_row_and_a_run_for_each_specimen(self):
        batch = self.batch("out")
        self.assertEqual(list(batch.specimens.index), [1, 2, 3, 4])
        self.assertEqual(batch.specimens.attrs["units"]["specimen.length"], "m")
        self.assertEqual(batch.specimens["specimen.length"].nunique(), 4)
        self.assertFalse(batch.specimens["rejected"].any())
        self.assertEqual(list(batch.specimens["peak_force"]), [run.results["peak_force"] for run in batch.runs])
        self.assertEqual(list(batch.specimens["specimen.length"]), [run.method["specimen"]["length"] for run in batch.runs])
        self.assertAlmostEqual(batch.specimens["peak_force"].std(ddof=1), batch.statistics.loc["peak_force", "sd"])

    def test_tells_why_a_specimen_does_not_count(self):
        with self.assertRaisesRegex(knot_utm.RunFailed, "came undone") as raised, self.assertWarns(knot_utm.RunWarning):
            knot_utm.batch("tighten", self.path("out"), 2, **DRAFT, **SLIPPERY)
        batch = raised.exception.run
        self.assertEqual(list(batch.rejected), [1, 2])
        for number, why in batch.rejected.items():
            self.assertTrue(batch.specimens.loc[number, "rejected"])
            self.assertIn("came undone", why)
        self.assertEqual(batch.statistics.loc["peak_force", "n"], 0)

    def test_is_refused_where_its_folder_holds_something_or_it_is_none(self):
        self.batch("out", 2)
        with self.assertRaisesRegex(knot_utm.WrongInput, "holds a run already"):
            self.batch("out", 2)
        again = self.batch("out", 2, overwrite=True)
        self.assertRegex(repr(again), "^<Batch .*/out: 2 of 2 specimens count, mean largest load .* N>$")
        self.assertEqual((len(again.plot().get_lines()), again.warnings), (2, {}))
        self.assertEqual(again["peak_force"]["n"], 2)
        with self.assertRaisesRegex(knot_utm.WrongInput, "specimens is 1, but must be a whole number from 2: knot_utm.run tests one"):
            self.batch("other", 1)
        with self.assertRaisesRegex(knot_utm.WrongInput, "specimen.length"):
            self.batch("other", **{"specimen.length": -1})
        with self.assertRaisesRegex(knot_utm.WrongInput, "statistics.yaml: no such file"):
            knot_utm.read_batch(self.path("out", "specimen_001"))
        self.assertFalse(os.path.exists(self.path("other")))


class Arguments(Sweeps):
    def test_of_a_wrong_kind_are_refused_in_a_line(self):
        out = self.path("none")
        for name, value in (("specimens", "3"), ("specimens", True), ("jobs", "x"), ("jobs", 0)):
            with self.assertRaisesRegex(knot_utm.WrongInput, rf"^{name} is .*, but must be [^\n]*$", msg=(name, value)):
                knot_utm.batch("straight", out, **{name: value})
        with self.assertRaisesRegex(knot_utm.WrongInput, "^free is .*, but must be a list of words"):
            knot_utm.fit("curve.csv", "straight", "material.radius", out)
        with self.assertRaisesRegex(knot_utm.WrongInput, r"\(object\) cannot be the value of a key"):
            knot_utm.run("straight", out, **{"specimen.length": object()})
        with self.assertRaisesRegex(knot_utm.WrongInput, "^cannot make the folder /"):
            knot_utm.sweep(self.study, "/proc/x")
        self.assertFalse(os.path.exists(out))


if __name__ == "__main__":
    unittest.main()
