#!/usr/bin/python3
"""scripts/fit: hidden values are found within the intervals that it gives, as often as it says; what cannot be told is told so, and what
cannot be fitted is refused. Skipped, with exit code 77, where a module is not installed."""
import contextlib
import io
import os
import sys
import tempfile
import unittest

from head import read, write

import numpy as np
import pandas as pd
from scipy import stats

try:
    import lmfit  # noqa: F401
except ModuleNotFoundError as absent:
    print(f"skipped: {absent} (scripts/fit installs it)")
    sys.exit(77)

import knot_utm
from knot_utm import fit_command
from knot_utm.finding import Fitted, FreeKey
from knot_utm.fitting import Pull, Record, Search, covariance, pull_of_table, scatter_of
from knot_utm.yaml_text import load, text_of

STRETCH, ROLLER = "material.stretching_stiffness", "machine.roller_friction"
CELL = {"machine.load_cell.accuracy": 0.005, "machine.load_cell.noise": 1.0}
PULLED = {"program.pull.until.extension": 0.008, **CELL}  # the rod does not part
EXTENSION = np.linspace(0.0, 1.0, 12)
FRICTION = FreeKey("friction", 0.0, 1.0)


def record(load, cell=None, extension=EXTENSION, **method):
    return Record("made.csv", Pull(extension, np.asarray(load, float)), {}, {"machine": {"load_cell": cell or {}}, **method})


def searched(measured, keys, load):
    """A search that has ended, of a load over the values of the keys and the number of the specimen."""
    def run(places, first):
        values = [[key.value(at) for key, at in zip(keys, place) if not key.offset] for place in places]
        return [[(Pull(measured.extension, load(*of, first + i)), {}) for i, of in enumerate(values)]]
    return Search([measured], keys, run).go()


def fitted(measured, keys, load):
    return Fitted(searched(measured, keys, load))


def sliding(friction, *_):
    return (1.0 + friction) * EXTENSION


class Errors(unittest.TestCase):
    def test_are_those_of_the_cell_and_shared_by_all_records(self):
        many = np.linspace(0.0, 1.0, 240)
        records = [record(many, {"noise": 0.2, "accuracy": 0.01}, many) for _ in range(2)]
        means = np.concatenate([one.measured for one in records])
        both, mode = covariance(records, means, [{}, {}]), 0.01**2 / 3.0 * np.outer(means[:12], means[:12])
        np.testing.assert_allclose(both[:12, :12], np.diag(0.2**2 / records[0].counts) + mode, rtol=1e-4)
        np.testing.assert_allclose(both[:12, 12:], mode, atol=1e-12)
        # Below the floor, which is of the true load, the accuracy does not hold.
        _, floored, numerical = record(EXTENSION, {"accuracy": 0.01, "floor": 0.1, "capacity": 500.0}).errors(
            100.0 * EXTENSION, {"balance_offset": 20.0, "plateau_force": 10.0, "plateau_force_error": 1.0})
        np.testing.assert_allclose(floored * np.sqrt(3.0), np.where(100.0 * EXTENSION + 20.0 < 50.0, 50.0, EXTENSION))
        np.testing.assert_allclose(numerical, 5.0 * EXTENSION)

    def test_of_the_scatter_of_a_few_specimens_do_not_promise_too_much(self):
        """Means weighted by it are as far off as they are said to be."""
        random, off = np.random.default_rng(4), []
        truth = 0.8 + 0.2 * np.exp(-np.abs(EXTENSION[:, None] - EXTENSION[None, :]) / 0.1)
        for _ in range(300):
            drawn = random.multivariate_normal(np.zeros(12), truth, 31)
            inverse = np.linalg.inv(scatter_of(drawn[1:] - drawn[1:].mean(axis=0), 29) * (1.0 + 1.0 / 30.0))
            slope = 1.0 + EXTENSION
            off.append(slope @ inverse @ (drawn[0] - drawn[1:].mean(axis=0)) / np.sqrt(slope @ inverse @ slope))
        self.assertLess(np.mean(np.abs(off) > 1.96), 0.05 + 3.0 * np.sqrt(0.05 * 0.95 / 300))

    def test_specimens_differ_as_the_method_says(self):
        laws = {"specimen.tail": {"normal": 0.05}, "material.radius": {"log_normal": 0.5}, "specimen.preload": {"uniform": 0.2}}
        one = record(EXTENSION, specimens={"scatter": laws}, specimen={"tail": 0.03, "preload": 10.0}, material={"radius": 0.002})
        drawn = pd.DataFrame([one.run_settings({"specimen.preload": 20.0}, number) for number in range(2000)])
        spreads = drawn["specimen.tail"].std() / 0.03, np.log(drawn["material.radius"] / 0.002).std(), drawn["specimen.preload"].min() / 20.0
        np.testing.assert_allclose(spreads, (0.05, 0.5, 0.8), rtol=0.08)


class Intervals(unittest.TestCase):
    def test_of_a_linear_load_are_those_of_least_squares(self):
        """They hold 19 of 20 hidden values; the correlation is that of the inverse of the normal equations."""
        random, sigma, held = np.random.default_rng(0), 0.1, 0
        terms = 3.0 * np.stack([1.0 + EXTENSION, 1.0 + EXTENSION + 0.8 * EXTENSION**2], axis=1)
        spread = sigma**2 * np.linalg.inv(terms.T @ terms)
        for _ in range(10):
            truth = random.uniform(1.0, 2.0, 2)
            load = terms @ truth + sigma * random.standard_normal(12)
            told = fitted(record(load, {"noise": sigma}), [FreeKey("a", 0.0, 3.0), FreeKey("b", 0.0, 3.0)], lambda a, b, _: terms @ [a, b])
            self.assertAlmostEqual(told.correlation["a"]["b"], spread[0, 1] / np.sqrt(spread[0, 0] * spread[1, 1]), delta=0.002)
            best = spread @ terms.T @ load / sigma**2
            for i, one in enumerate(told.found.values()):
                half = stats.norm.ppf(0.975) * np.sqrt(spread[i, i])
                np.testing.assert_allclose([one.low, one.value, one.high], best[i] + half * np.array([-1, 0, 1]), atol=0.02 * half)
                held += one.low < truth[i] < one.high
        self.assertGreaterEqual(held, 17)

    def test_have_the_offsets_of_the_record(self):
        keys = [FreeKey("k", 1.0, 3.0), FreeKey("record.force_offset", -1.0, 1.0), FreeKey("record.extension_offset", -0.1, 0.1)]
        told = fitted(record(2.0 * (EXTENSION - 0.05)**2 + 0.3, {"noise": 0.01}), keys, lambda k, _: k * EXTENSION**2).found
        for key, truth in zip(keys, (2.0, 0.3, 0.05)):
            self.assertTrue(told[key.name].low < truth < told[key.name].high, told)

    def test_are_open_where_the_load_does_not_tell_them(self):
        told = fitted(record(sliding(0.5), {"noise": 0.1}), [FRICTION, FreeKey("density", 0.0, 1.0)], sliding)
        half = stats.norm.ppf(0.975) * 0.1 / np.sqrt(np.sum(EXTENSION**2))
        np.testing.assert_allclose([told.found["friction"].low, told.found["friction"].high], [0.5 - half, 0.5 + half], rtol=0.05)
        self.assertEqual((told.found["density"].low, told.found["density"].high), (None, None))

    def test_of_two_springs_in_a_row_are_open(self):
        """One of them is rigid. All pairs with the same sum of compliances fit, which lie along a bend in the ranges."""
        keys = [FreeKey("rod", 2e4, 1.8e5), FreeKey("frame", 1e5, 1e8)]
        for seed in (1, 2, 6):
            load = 0.008 * EXTENSION * 4.0 * 6.1e4 + np.random.default_rng(seed).standard_normal(12)
            told = fitted(record(load, {"noise": 1.0, "accuracy": 0.005}), keys,
                          lambda rod, frame, _: 0.008 * EXTENSION / (0.25 / rod + 1.0 / frame))
            for one, least in zip(told.found.values(), (6.1e4, 3.7e5)):
                self.assertIsNone(one.high)
                self.assertAlmostEqual(one.low / least, 1.0, delta=0.2)
            self.assertLess(told.correlation["rod"]["frame"], -0.9)
            self.assertIn("rod and frame are only known together", " ".join(told.notes))

    def test_of_a_range_that_the_value_is_not_in_ask_for_a_wider_one(self):
        for low, high, words in ((0.6, 1.0, "lower end of its range: the data only tell that it is below 0.6"),
                                 (0.0, 0.4, "upper end of its range: the data only tell that it is above 0.")):
            told = fitted(record(sliding(0.5), {"noise": 1e-3}), [FreeKey("friction", low, high)], sliding)
            self.assertFalse(told.fits)
            self.assertIn("friction is at the " + words, " ".join(told.notes))

    def test_do_not_move_where_knots_open_beside_the_true_values(self):
        """A loop of specimens that scatter, with a load that goes with friction and pre-load, and that opens below a critical pre-load."""
        keys, truth, s = [FreeKey("friction", 0.3, 0.6), FreeKey("preload", 50.0, 500.0)], (0.42, 170.0), np.linspace(0.0, 0.104, 60)

        def load(friction, preload, number):
            drawn = np.random.default_rng(number).standard_normal(3)
            preload, begins = preload * (1.0 + 0.02 * drawn[0]), 1.0 - np.exp(-s / 0.004)
            if preload < 140.0 * np.exp(-(friction - 0.41) / 0.06):
                return 0.6 * (preload / 180.0)**0.7 * begins + 1e5 * np.maximum(s - 0.09, 0.0)
            slides = 3.3 * (preload / 180.0)**0.7 * np.exp(6.0 * (friction - 0.41)) * (0.5 + s / 0.06) * (1.0 + 0.02 * drawn[2])
            return slides * begins + 2e5 * np.maximum(s - 0.083 - 6e-4 * drawn[1], 0.0) * (0.59 + friction)
        noise = 0.5 * np.random.default_rng(1).standard_normal(60)
        told = fitted(record(1.002 * load(*truth, 10**6) + noise, {"accuracy": 0.005, "noise": 0.5}, s), keys, load)
        for value, (key, one) in zip(truth, told.found.items()):
            self.assertTrue(one.identifiable and one.low < value < one.high, (key, one))


class Pulls(unittest.TestCase):
    def test_are_what_reaches_a_new_extension_from_where_the_balance_made_zero_up_to_the_break(self):
        table = pd.DataFrame({"time": [0, 1, 2, 3, 4], "extension": [0.0, 0.1, 0.2, 0.15, 0.3], "load": [0.5, 1.0, 2.0, 1.5, 3.0],
                              "end_to_end": [1.0, 1.1, 1.2, 1.15, 1.3], "phase": ["balance", "pull", "pull", "pull", "pull"]})
        pull = pull_of_table(table)
        np.testing.assert_array_equal((pull.extension, pull.load), ([0.0, 0.1, 0.2, 0.3], [0.5, 1.0, 2.0, 3.0]))
        pull = pull_of_table(table.assign(end_to_end=[0.9, 1.1, 1.2, 1.15, 1.3]))
        self.assertEqual((pull.extension[0], pull.load[0]), (0.0, 0.0))
        self.assertIsNone(pull_of_table(table.assign(phase="hold")))
        s = np.linspace(0.0, 1.0, 101)
        parted = Pull(s, np.where(s > 0.99, 0.0, s))
        self.assertEqual(parted.extension[-1], 0.99)
        np.testing.assert_allclose(parted.at(np.array([0.5, 1.1])), [0.5, 1.1])
        self.assertEqual(Pull(s, np.where(s > 0.5, 0.0, s)).extension[-1], 1.0, "a knot that jumped open is pulled on")


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

    def straight(self):
        return self.measured("record", "straight", **{STRETCH: 6.1e4, **PULLED})

    def altered(self, name, file, **columns):
        """The same curve, with columns as functions of the table."""
        lines, table = read(file).splitlines(keepends=True)[:2], pd.read_csv(file, skiprows=[1])
        table = table.assign(**columns)
        return write(self.path(name), "".join(lines) + table.to_csv(index=False, header=False))

    def command(self, *words, settings=None, code=0):
        """What scripts/fit says, without a process of its own."""
        sets = [word for key, value in (settings or PULLED).items() for word in ("--set", f"{key}={text_of(value)}")]
        said = io.StringIO()
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            found = fit_command.main([*words, *sets])
        self.assertEqual(found, code, said.getvalue())
        return said.getvalue()

    def assert_found(self, found, truth):
        self.assertTrue(found["identifiable"])
        self.assertTrue(found["low"] <= truth <= found["high"] and found["low"] < found["value"] < found["high"], found)
        self.assertLess(found["high"] - found["low"], 0.1 * truth, "the interval tells something")

    def test_stiffness_of_a_straight_rod_is_found_whatever_the_jobs(self):
        words = [self.straight(), "straight", "--free", STRETCH, "record.force_offset", "--out"]
        said = self.command(*words, self.path("fit"), "--jobs", "1")
        told = load(self.path("fit/fit.yaml"))
        self.assert_found(told[STRETCH], 6.1e4)
        self.assertTrue(told["fits"])
        self.assertLess(told["rms"], 3.0)
        self.assertIn(f"{STRETCH}: ", said)
        method = load(self.path("fit/method.yaml"))
        self.assertEqual(method["material"]["stretching_stiffness"], told[STRETCH]["value"])
        self.assertEqual(method["machine"]["load_cell"]["noise"], 1.0, "the cell of the method")
        page = read(self.path("fit/report.html"))
        for word in (f'data-key="{STRETCH}"', "The curve fits within the errors", f"{STRETCH}, record.force_offset", "profiles.csv"):
            self.assertIn(word, page)
        self.assertIn("fit.yaml exists already", self.command(*words, self.path("fit"), code=2))
        self.command(*words, self.path("same"), "--no-report", "--jobs", "3")
        for name in ("fit.yaml", "method.yaml", "curves.csv", "profiles.csv"):
            self.assertEqual(read(self.path("fit", name)), read(self.path("same", name)), name)
        bent = self.altered("bent.csv", self.path("record/curve.csv"), load=lambda table: table["load"] * (0.5 + 60.0 * table["extension"]))
        said = self.command(bent, "straight", "--free", STRETCH, "--out", self.path("bent"), "--no-report", code=1)
        self.assertFalse(load(self.path("bent/fit.yaml"))["fits"])
        self.assertIn("nothing fits within the errors", said)

    def test_friction_on_a_post_is_found_from_two_records(self):
        cell = {**CELL, "machine.load_cell.noise": 0.05}
        files = [self.measured(name, "capstan", **{ROLLER: 0.23, "specimen.wrap": wrap, **cell}) for name, wrap in (("a", 6.0), ("b", 4.0))]
        self.command(files[0], "capstan", "--free", ROLLER + "=0.05:0.8", "--also", files[1], "specimen.wrap=4.0", "--out", self.path("fit"),
                     "--no-report", settings={"specimen.wrap": 6.0, **cell})
        self.assert_found(load(self.path("fit/fit.yaml"))[ROLLER], 0.23)
        for name, wrap in (("method.yaml", 6.0), ("method_2.yaml", 4.0)):
            self.assertEqual(load(self.path("fit", name))["specimen"]["wrap"], wrap)

    def test_what_cannot_be_fitted_is_refused_in_one_line_before_anything_is_written(self):
        record, free = self.straight(), ["straight", "--free"]
        milli = self.altered("milli.csv", record, load=lambda table: 1e3 * table["load"])
        empty, held = write(self.path("empty.csv"), ""), self.altered("held.csv", record, phase="hold")
        for words, says in (
                ([record, "straight"], "--free is missing"), ([record, *free, STRETCH + "=10:5"], "low:high"),
                ([record, *free, "material.stifness=1:2"], "--free: material.stifness is nothing, but only a number"),
                ([record, *free, STRETCH + "=-5:10"], "material.stretching_stiffness is -5"), ([record, *free, STRETCH, STRETCH], "twice"),
                ([record, *free, "record.force_offset"], "nothing but offsets"), ([held, *free, STRETCH], "nothing is pulled"),
                ([record, *free, "machine.stiffness"], "give --free machine.stiffness=low:high"),
                ([record, *free, "machine.load_cell.noise=0:1"], "machine.load_cell.noise is an error of the cell"),
                ([record, *free, "specimen.knot=0:1"], "specimen.knot is straight, but only a number that acts on the test may be free"),
                ([record, *free, STRETCH, "--also", record, STRETCH + "=5e4"], STRETCH + " is set, but it is free"),
                ([record, *free, STRETCH, "--also", record, "specimen.lenght=1"], "did you mean specimen.length?"),
                (["absent.csv", *free, STRETCH], "absent.csv: no such file"), ([empty, *free, STRETCH], "empty.csv"),
                ([milli, *free, STRETCH], "other units"), ([record, *free, STRETCH, "--out", os.path.dirname(record)], "holds a run")):
            said = self.command("--out", self.path("fit"), *words, code=2)
            self.assertEqual(said.count("\n"), 1, said)
            self.assertIn(says, said)
        for settings, says in (({"specimen.length": 0.2}, "machine.load_cell.accuracy"), ({**CELL, "program.pull.until.extension": 0.004},
                                                                                        "let it go on")):
            self.assertIn(says, self.command(record, *free, STRETCH, "--out", self.path("fit"), settings=settings, code=2))
        # Each end of each range alone is allowed: the strength is what the pre-load must not reach.
        said = self.command(record, "tighten", "--free", "specimen.preload=50:1000", "material.breaking_force=900:4000", "--out", self.path("fit"),
                            settings={**CELL, "physics.accuracy": "draft"}, code=2)
        self.assertIn("a run with specimen.preload=1000.0, material.breaking_force=900.0 would be refused", said)
        self.assertFalse(os.path.exists(self.path("fit")))


if __name__ == "__main__":
    unittest.main()
