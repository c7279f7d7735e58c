#!/usr/bin/python3
"""The parts of a fit against closed forms: means and their errors, polynomials of runs, intervals."""
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import head  # noqa: F401

import numpy as np
import pandas as pd
from scipy import stats

from knot_utm.errors import WrongInput
from knot_utm.fitting.found import Fitted
from knot_utm.fitting.keys import FreeKey, method_key, offset_key, parse_free, value_at
from knot_utm.fitting.pulls import Model, Pull, pull_of_table
from knot_utm.fitting.records import MOST_BINS, Record, covariance
from knot_utm.fitting.search import Search
from knot_utm.fitting.surface import Surface, scatter_of

EXTENSION = np.linspace(0.0, 1.0, 12)
FRICTION = FreeKey("friction", 0.0, 1.0)


def record(load, cell=None, extension=EXTENSION, **method):
    return Record("made.csv", Pull(extension, np.asarray(load, float)), {}, {"machine": {"load_cell": cell or {}}, **method})


def searched(records, keys, load):
    """A search that has ended, of a load over the values of the keys and the number of the specimen."""
    def run(places, first):
        values = [[key.value(at) for key, at in zip(keys, place) if not key.offset] for place in places]
        return [[Model(Pull(one.extension, load(*of, first + i)), {}) for i, of in enumerate(values)] for one in records]
    return Search(records, keys, run).go()


def fitted(measured, keys, load):
    return Fitted(searched([measured], keys, load))


def sliding(friction, *_):
    return (1.0 + friction) * EXTENSION


class Errors(unittest.TestCase):
    def test_have_the_class_of_the_cell(self):
        means = 100.0 * EXTENSION
        np.testing.assert_allclose(record(means, {"accuracy": 0.01}).cell_mode(means, {}), 0.01 * means / np.sqrt(3.0))
        # Below the floor, which is of the true load, the accuracy does not hold.
        floored = record(means, {"accuracy": 0.01, "floor": 0.1, "capacity": 500.0}).cell_mode(means, {"balance_offset": 20.0})
        np.testing.assert_allclose(floored * np.sqrt(3.0), np.where(means + 20.0 < 50.0, 50.0, 0.01 * means))

    def test_have_noise_of_each_reading_and_the_cell_in_all_records_of_that_cell(self):
        many = np.linspace(0.0, 1.0, 240)
        for seed, shared in ((1, True), (2, False)):
            cells = [{"noise": 0.2, "accuracy": 0.01, "seed": one} for one in (1, seed)]
            records = [record(many, cell, many) for cell in cells]
            means = np.concatenate([one.measured for one in records])
            one = np.diag(0.2**2 / records[0].counts) + 0.01**2 / 3.0 * np.outer(means[:12], means[:12])
            both = covariance(records, means, [{}, {}])
            np.testing.assert_allclose(both[:12, :12], one, rtol=1e-4)
            np.testing.assert_allclose(both[:12, 12:], shared * 0.01**2 / 3.0 * np.outer(means[:12], means[:12]), atol=1e-12)

    def test_have_the_numerical_errors_of_the_result(self):
        means = np.ones(12)
        result = {"plateau_force": 10.0, "plateau_force_error": 1.0, "lock_extension": 0.5}
        matrix = covariance([record(means)], means, [result])
        before = np.flatnonzero(EXTENSION < 0.5)
        self.assertAlmostEqual(matrix[before[0], before[1]], 0.05**2)
        self.assertAlmostEqual(matrix[before[0], 11], 0.0)

    def test_must_be_known(self):
        with self.assertRaisesRegex(WrongInput, "machine.load_cell.accuracy"):
            record(EXTENSION, {"accuracy": 0, "noise": 0, "resolution": 0}).require_errors()

    def test_scatter_of_a_few_specimens_does_not_promise_too_much(self):
        """Means weighted by it are as far off as they are said to be, where they move together and where they do not."""
        random = np.random.default_rng(4)
        truth = 0.8 + 0.2 * np.exp(-np.abs(EXTENSION[:, None] - EXTENSION[None, :]) / 0.1)
        slope, off = 1.0 + EXTENSION, []
        for _ in range(300):
            drawn = random.multivariate_normal(np.zeros(12), truth, 31)
            inverse = np.linalg.inv(scatter_of(drawn[1:] - drawn[1:].mean(axis=0), 29) * (1.0 + 1.0 / 30.0))
            off.append(slope @ inverse @ (drawn[0] - drawn[1:].mean(axis=0)) / np.sqrt(slope @ inverse @ slope))
        self.assertLess(np.mean(np.abs(off) > 1.96), 0.05 + 3.0 * np.sqrt(0.05 * 0.95 / 300))


class Surfaces(unittest.TestCase):
    def test_have_the_order_that_the_runs_tell_and_the_scatter_that_is_left(self):
        random = np.random.default_rng(6)
        places, sigma = random.random((64, 2)), 0.1
        smooth = (1.0 + places[:, :1] - places[:, :1] * places[:, 1:]) * (1.0 + EXTENSION)
        surface = Surface(places, smooth + sigma * random.standard_normal((64, 12)), np.full(12, sigma))
        self.assertEqual((surface.order, surface.freedom), (2, 58))
        self.assertAlmostEqual(np.sqrt((surface.left**2).sum(axis=0).mean() / surface.freedom), sigma, delta=4.0 * sigma / np.sqrt(2 * 58 * 12))
        told, unknown = surface.at(np.array([[0.5, 0.5], [3.0, 3.0]]))
        self.assertLess(np.abs(told[0] - 1.25 * (1.0 + EXTENSION)).max(), 4.0 * sigma * np.sqrt(unknown[0]))
        self.assertGreater(unknown[1], 100.0 * unknown[0])


class Intervals(unittest.TestCase):
    def test_of_a_linear_load_are_those_of_least_squares(self):
        """They hold 19 of 20 hidden values; the correlation is that of the inverse of the normal equations."""
        random, sigma = np.random.default_rng(0), 0.1
        terms = 3.0 * np.stack([1.0 + EXTENSION, 1.0 + EXTENSION + 0.8 * EXTENSION**2], axis=1)
        spread = sigma**2 * np.linalg.inv(terms.T @ terms)
        keys, held = [FreeKey("a", 0.0, 3.0), FreeKey("b", 0.0, 3.0)], 0
        for _ in range(10):
            truth = random.uniform(1.0, 2.0, 2)
            load = terms @ truth + sigma * random.standard_normal(12)
            told = fitted(record(load, {"noise": sigma}), keys, lambda a, b, _: terms @ [a, b])
            self.assertAlmostEqual(told.correlation["a"]["b"], spread[0, 1] / np.sqrt(spread[0, 0] * spread[1, 1]), delta=0.002)
            best = spread @ terms.T @ load / sigma**2
            for i, one in enumerate(told.found.values()):
                half = stats.norm.ppf(0.975) * np.sqrt(spread[i, i])
                np.testing.assert_allclose([one.low, one.value, one.high], best[i] + half * np.array([-1, 0, 1]), atol=0.02 * half)
                held += one.low < truth[i] < one.high
        self.assertGreaterEqual(held, 17)

    def test_have_the_offsets_of_the_record(self):
        keys = [FreeKey("k", 1.0, 3.0), FreeKey("record.force_offset", -1.0, 1.0), FreeKey("record.extension_offset", -0.1, 0.1)]
        load = 2.0 * (EXTENSION - 0.05)**2 + 0.3
        told = fitted(record(load, {"noise": 0.01}), keys, lambda k, _: k * EXTENSION**2).found
        for key, truth in zip(keys, (2.0, 0.3, 0.05)):
            self.assertTrue(told[key.name].low < truth < told[key.name].high, told)

    def test_are_open_where_the_load_does_not_tell_them(self):
        told = fitted(record(sliding(0.5), {"noise": 0.1}), [FRICTION, FreeKey("density", 0.0, 1.0)], sliding)
        half = stats.norm.ppf(0.975) * 0.1 / np.sqrt(np.sum(EXTENSION**2))
        np.testing.assert_allclose([told.found["friction"].low, told.found["friction"].high], [0.5 - half, 0.5 + half], rtol=0.05)
        self.assertEqual((told.found["density"].low, told.found["density"].high), (None, None))
        self.assertLess(abs(told.correlation["friction"]["density"]), 0.5)

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
            self.assertIn("give a wider range", " ".join(told.notes))


class Jumps(unittest.TestCase):
    """Loads that are several times smaller below a critical value, as of knots that open."""

    def test_beside_the_true_value_do_not_move_its_interval(self):
        def load(friction, _):
            return sliding(friction) if friction > 0.5 else 1e-3 * EXTENSION
        search = searched([record(load(0.53, 0), {"accuracy": 0.005, "noise": 0.01})], [FRICTION], load)
        told = Fitted(search)
        one = told.found["friction"]
        self.assertTrue(told.fits and one.identifiable)
        self.assertTrue(one.low < 0.53 < one.high < one.low + 0.05, one)
        self.assertEqual(search.likelihood.is_right.tolist(), (search.places[:, 0] > 0.5).tolist())

    def test_of_specimens_that_scatter_do_not_move_intervals(self):
        """A loop that slides, with a load that goes with friction and pre-load, and that opens below a critical pre-load."""
        keys, truth, s = [FreeKey("friction", 0.3, 0.6), FreeKey("preload", 50.0, 500.0)], (0.42, 170.0), np.linspace(0.0, 0.104, 60)

        def load(friction, preload, number):
            drawn = np.random.default_rng(number).standard_normal(3)
            preload, begins = preload * (1.0 + 0.02 * drawn[0]), 1.0 - np.exp(-s / 0.004)
            if preload < 140.0 * np.exp(-(friction - 0.41) / 0.06):
                return 0.6 * (preload / 180.0)**0.7 * begins + 1e5 * np.maximum(s - 0.09, 0.0)
            slides = 3.3 * (preload / 180.0)**0.7 * np.exp(6.0 * (friction - 0.41)) * (0.5 + s / 0.06) * (1.0 + 0.02 * drawn[2])
            return slides * begins + 2e5 * np.maximum(s - 0.083 - 6e-4 * drawn[1], 0.0) * (0.59 + friction)
        noise = 0.5 * np.random.default_rng(1).standard_normal(60)
        search = searched([record(1.002 * load(*truth, 10**6) + noise, {"accuracy": 0.005, "noise": 0.5}, s)], keys, load)
        for value, (key, one) in zip(truth, Fitted(search).found.items()):
            self.assertTrue(one.identifiable, key)
            self.assertTrue(one.low < value < one.high, (key, one))


class Records(unittest.TestCase):
    def test_have_means_of_equal_parts(self):
        s = np.concatenate([np.linspace(0.0, 0.5, 90), [1.0]])
        measured = record(s, extension=s)
        self.assertEqual(measured.counts.sum(), len(s))
        np.testing.assert_allclose(measured.measured, measured.centres)
        self.assertLess(len(measured.counts), MOST_BINS, "no part without readings")

    def test_have_specimens_that_differ_as_the_method_says(self):
        laws = {"specimen.tail": {"normal": 0.05}, "material.radius": {"log_normal": 0.5}, "specimen.preload": {"uniform": 0.2}}
        one = record(EXTENSION, specimens={"scatter": laws}, specimen={"tail": 0.03, "preload": 10.0}, material={"radius": 0.002})
        drawn = pd.DataFrame([one.run_settings({"specimen.preload": 20.0}, number) for number in range(2000)])
        self.assertAlmostEqual(drawn["specimen.tail"].std() / 0.03, 0.05, delta=0.004)
        self.assertAlmostEqual(np.log(drawn["material.radius"] / 0.002).std(), 0.5, delta=0.04)
        self.assertAlmostEqual(drawn["specimen.preload"].min(), 16.0, delta=0.1)
        self.assertAlmostEqual(drawn["specimen.preload"].max(), 24.0, delta=0.1)
        self.assertEqual(one.run_settings({}, 3), one.run_settings({}, 3))
        self.assertEqual(record(EXTENSION, specimens={"scatter": "none"}).run_settings({"a": 1.0}, 3), {"a": 1.0})

    def test_of_other_units_or_another_range_are_refused(self):
        def model(extension, load, **result):
            return Model(Pull(np.array([0.0, extension]), np.array([0.0, load])), result)
        measured = record(EXTENSION)
        measured.require_producible(model(1.0, 5.0, ended_by="extension"))
        measured.require_producible(model(0.3, 5.0, ended_by="break"))
        for wrong, words in ((model(1000.0, 1.0), "other units"), (model(1.0, 1e3), "other units"), (model(1.0, -1.0), "--invert"),
                             (model(0.5, 1.0, ended_by="extension"), "let it go on"),
                             (Model(None, {"reason": "it gave up"}), "it gave up")):
            with self.assertRaisesRegex(WrongInput, words):
                measured.require_producible(wrong)


class Pulls(unittest.TestCase):
    def table(self, **changes):
        rows = {"time": [0, 1, 2, 3, 4], "extension": [0.0, 0.1, 0.2, 0.15, 0.3], "load": [0.5, 1.0, 2.0, 1.5, 3.0],
                "end_to_end": [1.0, 1.1, 1.2, 1.15, 1.3], "phase": ["balance", "pull", "pull", "pull", "pull"]}
        return pd.DataFrame({**rows, **changes})

    def test_are_what_reaches_a_new_extension_from_where_the_balance_made_zero(self):
        pull = pull_of_table(self.table())
        np.testing.assert_array_equal(pull.extension, [0.0, 0.1, 0.2, 0.3])
        np.testing.assert_array_equal(pull.load, [0.5, 1.0, 2.0, 3.0])
        pull = pull_of_table(self.table(end_to_end=[0.9, 1.1, 1.2, 1.15, 1.3]))
        self.assertEqual((pull.extension[0], pull.load[0]), (0.0, 0.0))
        self.assertIsNone(pull_of_table(self.table(phase=["hold"] * 5)))

    def test_end_where_the_rod_parts(self):
        s = np.linspace(0.0, 1.0, 101)
        load = np.where(s > 0.99, 0.0, s)
        self.assertEqual(Pull(s, load).extension[-1], 0.99)
        np.testing.assert_allclose(Pull(s, load).at(np.array([0.5, 1.1])), [0.5, 1.1])
        self.assertEqual(Pull(s, np.where(s > 0.5, 0.0, s)).extension[-1], 1.0, "a knot that jumped open is pulled on")


class Keys(unittest.TestCase):
    def test_have_ranges(self):
        self.assertEqual(parse_free("a.b=1:2e3"), ("a.b", (1.0, 2000.0)))
        self.assertEqual(parse_free("a.b"), ("a.b", None))
        method = {"a": {"b": 6.0, "none": 0, "word": "auto"}, "program": [{"tie": {"speed": 3.0}}]}
        numbers = {"a.b", "a.none", "a.absent"}
        self.assertEqual(method_key("a.b", None, method, numbers), FreeKey("a.b", 2.0, 18.0))
        self.assertEqual(value_at(method, "program.tie.speed"), 3.0)
        self.assertEqual(value_at(method, "program.0.tie.speed"), 3.0)
        self.assertAlmostEqual(FreeKey("a", 1.0, 100.0).value(0.5), 10.0)
        self.assertAlmostEqual(FreeKey("a", 1.0, 3.0).value(0.5), 2.0)
        records = [record(EXTENSION), record(4.0 * EXTENSION)]
        self.assertAlmostEqual(offset_key("record.2.force_offset", None, records).high, 0.2)
        with self.assertRaisesRegex(WrongInput, "there are 1"):
            offset_key("record.2.force_offset", None, records[:1])
        for name in ("a.none", "a.absent"):
            with self.assertRaisesRegex(WrongInput, f"give --free {name}=low:high"):
                method_key(name, None, method, numbers)
        for name, said in (("a.word", "auto"), ("a", "several values"), ("a.other", "nothing")):
            with self.assertRaisesRegex(WrongInput, f"{name} is {said}, but only a number that acts on the test may be free"):
                method_key(name, (0.0, 1.0), method, numbers)
        for word in ("", "=1:2", "a=1", "a=2:1", "a=x:y", "a=1:inf", "record.offset", "record.0.force_offset"):
            with self.assertRaises(WrongInput, msg=word):
                parse_free(word)


if __name__ == "__main__":
    unittest.main()
