#!/usr/bin/python3
"""The parts of a fit against closed forms: the emulator, the covariance, the profiles."""
import os
import sys
import unittest
from unittest import mock

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import head  # noqa: F401

import numpy as np
import pandas as pd
from scipy import special, stats

from knot_utm.errors import WrongInput
from knot_utm.fitting import ends, errors, found, kinds, profiles
from knot_utm.fitting.curves import Pull, pull_of_table
from knot_utm.fitting.emulator import Emulator
from knot_utm.fitting.keys import FreeKey, method_key, offset_key, parse_free, value_at
from knot_utm.fitting.likelihood import Likelihood, RecordLikelihood
from knot_utm.fitting.records import MOST_BINS, Record
from knot_utm.fitting.runs import Model
from knot_utm.fitting.scatter import covariance_of, left_over
from knot_utm.fitting.search import Case, Search

EXTENSION = np.linspace(0.0, 1.0, 12)
LOW, HIGH = np.zeros(2), np.ones(2)
FRICTION = FreeKey("friction", 0.0, 1.0)


def record(load, extension=EXTENSION):
    return Record("made.csv", Pull(extension, np.asarray(load, float)), {})


def searched(measured, keys, load, cell):
    """A search that has ended, of a load over the values of the keys."""
    def run(places, _):
        return [[Model(Pull(measured.extension, load(*(key.value(at) for key, at in zip(keys, place)))), {}) for place in places]]
    search = Search([Case(measured, 1, keys, cell, None)], keys, run, lambda best: None)
    search.go()
    return search


def sliding(friction, _density=0.0):
    return (1.0 + friction) * EXTENSION


class Quadratic:
    """-2 log L of a normal distribution about a place."""

    def __init__(self, middle, covariance):
        self.middle, self.inverse = np.array(middle), np.linalg.inv(covariance)

    def at(self, places):
        return np.einsum("ni,ij,nj->n", places - self.middle, self.inverse, places - self.middle)


class Profiles(unittest.TestCase):
    sd, correlation = np.array([0.03, 0.05]), 0.6

    def setUp(self):
        covariance = np.outer(self.sd, self.sd) * np.array([[1.0, self.correlation], [self.correlation, 1.0]])
        self.likelihood = Quadratic([0.4, 0.6], covariance)
        self.best, self.value = profiles.best_of(self.likelihood, LOW, HIGH, 1)

    def test_of_a_normal_distribution_have_its_intervals(self):
        np.testing.assert_allclose(self.best, [0.4, 0.6], atol=1e-5)
        for key in (0, 1):
            found = profiles.profile(self.likelihood, key, LOW, HIGH, self.best, self.value, 2)
            half = stats.norm.ppf(0.975) * self.sd[key]
            np.testing.assert_allclose([found.low, found.high], self.best[key] + np.array([-half, half]), atol=1e-3)

    def test_correlation_is_that_of_the_distribution(self):
        found = profiles.correlations(self.likelihood, self.best, LOW, HIGH)
        self.assertAlmostEqual(found[0, 1], self.correlation, places=1)
        np.testing.assert_allclose(np.diag(found), 1.0)

    def test_that_do_not_rise_tell_no_interval(self):
        flat = Quadratic([0.4, 0.6], np.diag([0.03**2, 10.0**2]))
        best, value = profiles.best_of(flat, LOW, HIGH, 1)
        found = [profiles.profile(flat, key, LOW, HIGH, best, value, 2) for key in (0, 1)]
        self.assertNotIn(None, (found[0].low, found[0].high))
        self.assertEqual((found[1].low, found[1].high), (None, None))


class Emulators(unittest.TestCase):
    grid = np.linspace(0.0, 1.0, 50)

    def curves(self, places):
        return np.exp(places[:, :1]) * self.grid + np.sin(3.0 * places[:, 1:]) * self.grid**2

    def test_learn_smooth_curves_and_know_what_they_do_not_know(self):
        places, unseen = profiles.sobol(2, 32, 1), profiles.sobol(2, 16, 2)
        emulator = Emulator(places, self.curves(places), np.full(50, 1e-3))
        told, _ = emulator.weights(unseen)
        np.testing.assert_allclose(emulator.mean + told @ emulator.components, self.curves(unseen), atol=2e-2)
        _, variances = emulator.weights(np.array([[0.5, 0.5], [3.0, 3.0]]))
        self.assertGreater(variances[1].sum(), 100.0 * variances[0].sum())

    def test_average_over_scatter(self):
        """Of n runs that scatter by sigma about a line, the line is known to about sigma sqrt(2/n)."""
        random = np.random.default_rng(5)
        sigma, count = 0.05, 64
        places = profiles.sobol(1, count, 1)
        scatter = sigma * random.standard_normal((count, 1)) * np.ones(50)
        emulator = Emulator(places, 1.0 + places * self.grid + scatter, np.full(50, sigma), sigma**2 * np.ones((50, 50)))
        weights, variances = emulator.weights(np.array([[0.5]]))
        error = emulator.mean + weights[0] @ emulator.components - (1.0 + 0.5 * self.grid)
        self.assertLess(np.max(np.abs(error)), 3.0 * sigma * np.sqrt(2.0 / count))
        self.assertLess((variances[0] * (emulator.components**2).mean(axis=1)).sum(), sigma**2 * 4.0 / count)

    def test_slopes_of_the_marginal_likelihood_are_its_differences(self):
        places = profiles.sobol(2, 12, 1)
        process = Emulator(places, self.curves(places), np.full(50, 1e-2)).processes[0]
        at = np.array([-0.3, -6.0, -0.4, 0.2])
        _, slopes = process._unlikely(at)
        for k, step in enumerate(1e-5 * np.eye(4)):
            difference = (process._unlikely(at + step)[0] - process._unlikely(at - step)[0]) / 2e-5
            self.assertAlmostEqual(slopes[k], difference, delta=1e-4 * max(1.0, abs(difference)))


class Likelihoods(unittest.TestCase):
    """Of a line through zero, F = k s, over k and the offsets of the record."""
    keys = [FreeKey("k", 1.0, 3.0), FreeKey("record.force_offset", -1.0, 1.0), FreeKey("record.extension_offset", -0.1, 0.1)]

    def test_is_the_sum_of_squares_over_the_errors(self):
        measured = record(2.0 * EXTENSION + 0.3)
        grid = np.linspace(-0.1, 1.1, 100)
        places = profiles.sobol(1, 8, 1)
        curves = self.keys[0].value(places) * grid
        sigma = 0.1
        covariance = np.diag(np.full(12, sigma**2))
        emulator = Emulator(places, curves, np.full(100, sigma))
        one = RecordLikelihood(measured, 1, self.keys, np.array([0]), emulator, grid, covariance, np.zeros(12), "cell")
        all_ = Likelihood([one])
        for k, force, shift in ((2.0, 0.3, 0.0), (2.3, -0.2, 0.05), (1.5, 0.0, -0.1), (2.9, 0.9, 0.013)):
            place = np.array([[(k - 1.0) / 2.0, (force + 1.0) / 2.0, (shift + 0.1) / 0.2]])
            residual = measured.measured - (k * (measured.centres - shift) + force)
            expected = float((residual**2).sum()) / sigma**2
            self.assertAlmostEqual(all_.chi_square(place[0]), expected, delta=1e-2 * (1.0 + expected))
            np.testing.assert_allclose(one.simulated(place[0]), measured.measured - residual, atol=1e-3)

    def test_has_the_error_of_a_cell_in_all_records_of_that_cell(self):
        """Beside the whole matrix, written out."""
        places, sigma, gain = profiles.sobol(1, 8, 1), 0.1, 0.2
        grid = np.linspace(0.0, 1.0, 100)
        emulator = Emulator(places, self.keys[0].value(places) * grid, np.full(100, sigma))
        covariance = np.diag(np.full(12, sigma**2))
        measured = [record(slope * EXTENSION) for slope in (2.2, 2.1)]
        place = np.array([[0.6]])
        told = {}
        for cells in (("a", "a"), ("a", "b")):
            records = [RecordLikelihood(of, 1, self.keys[:1], np.array([0]), emulator, grid, covariance, gain * of.measured, cell)
                       for of, cell in zip(measured, cells)]
            residual = np.concatenate([of.measured - one.simulated(place[0]) for of, one in zip(measured, records)])
            common = np.concatenate([gain * of.measured for of in measured])
            parts = [common] if cells[0] == cells[1] else [np.where(np.arange(24) < 12, common, 0.0),
                                                           np.where(np.arange(24) < 12, 0.0, common)]
            whole = sigma**2 * np.eye(24) + sum(np.outer(part, part) for part in parts)
            likelihood = Likelihood(records)
            told[cells] = likelihood.chi_square(place[0])
            self.assertAlmostEqual(told[cells], residual @ np.linalg.solve(whole, residual), delta=1e-3 * told[cells])
            logarithm = np.linalg.slogdet(whole)[1] - 24 * np.log(sigma**2)
            self.assertAlmostEqual(likelihood.at(place)[0] - told[cells], logarithm, delta=1e-2)
        self.assertNotAlmostEqual(told["a", "a"], told["a", "b"], places=2)


class Errors(unittest.TestCase):
    def test_have_the_class_of_the_cell(self):
        means = 100.0 * EXTENSION
        np.testing.assert_allclose(errors.of_the_cell({"accuracy": 0.01}, means, {}), 0.01 * means / np.sqrt(3.0))
        # Below the floor, which is of the true load, the accuracy does not hold.
        floored = errors.of_the_cell({"accuracy": 0.01, "floor": 0.1, "capacity": 500.0}, means, {"balance_offset": 20.0})
        np.testing.assert_allclose(floored * np.sqrt(3.0), np.where(means + 20.0 < 50.0, 50.0, 0.01 * means))

    def test_have_noise_of_each_reading(self):
        many = np.linspace(0.0, 1.0, 240)
        measured = record(many, many)
        none = np.zeros((len(measured.centres), len(measured.centres)))
        found = errors.covariance(measured, {"noise": 0.2, "resolution": 0.0}, measured.measured, {}, none)
        np.testing.assert_allclose(np.diag(found), 0.2**2 / measured.counts, rtol=1e-4)

    def test_have_the_numerical_errors_of_the_result(self):
        means = np.ones(12)
        result = {"plateau_force": 10.0, "plateau_force_error": 1.0, "lock_extension": 0.5}
        found = errors.covariance(record(means), {}, means, result, np.zeros((12, 12)))
        before = np.flatnonzero(EXTENSION < 0.5)
        self.assertAlmostEqual(found[before[0], before[1]], 0.05**2)
        self.assertAlmostEqual(found[before[0], 11], 0.0)

    def test_must_be_known(self):
        with self.assertRaisesRegex(WrongInput, "machine.load_cell.accuracy"):
            errors.require_known(record(EXTENSION), {"accuracy": 0, "noise": 0, "resolution": 0}, np.zeros((12, 12)))

    def test_scatter_of_a_few_specimens_does_not_promise_too_much(self):
        """Means weighted by it are as far off as they are said to be, where they move together and where they do not."""
        random = np.random.default_rng(4)
        s = np.linspace(0.0, 1.0, 12)
        truth = 0.8 + 0.2 * np.exp(-np.abs(s[:, None] - s[None, :]) / 0.1)
        slope = 1.0 + s
        off = []
        np.testing.assert_array_equal(covariance_of(np.ones((8, 3))), np.zeros((3, 3)))
        for _ in range(300):
            drawn = random.multivariate_normal(np.zeros(12), truth, 31)
            inverse = np.linalg.inv(covariance_of(drawn[1:]))
            off.append(slope @ inverse @ (drawn[0] - drawn[1:].mean(axis=0)) / np.sqrt(slope @ inverse @ slope))
        self.assertLess(np.mean(np.abs(off) > 1.96), 0.05 + 3.0 * np.sqrt(0.05 * 0.95 / 300))

    def test_scatter_of_runs_is_what_no_polynomial_of_their_places_has(self):
        random = np.random.default_rng(6)
        places = profiles.sobol(2, 64, 1)
        smooth = (1.0 + places[:, :1] - places[:, :1] * places[:, 1:]) * EXTENSION
        np.testing.assert_allclose(left_over(places, smooth), 0.0, atol=1e-12)
        rest = left_over(places, smooth + 0.1 * random.standard_normal((64, 12)))
        self.assertAlmostEqual(np.sqrt(np.mean(rest**2)), 0.1, delta=0.1 * 4.0 / np.sqrt(2.0 * 64 * 12))
        self.assertEqual(len(left_over(places[:8], smooth[:8])), 0)


class Jumps(unittest.TestCase):
    """A load that all but vanishes below a critical value, as of knots that open."""

    def test_beside_the_true_value_do_not_move_its_interval(self):
        def load(friction):
            return sliding(friction) if friction > 0.5 else 1e-3 * EXTENSION
        search = searched(record(load(0.53)), [FRICTION], load, {"accuracy": 0.005, "noise": 0.01})
        fitted = found.judge(search)
        one = fitted.found["friction"]
        self.assertTrue(fitted.fits and one.identifiable)
        self.assertTrue(one.low < 0.53 < one.high < one.low + 0.05, one)
        self.assertIn("left loads of quite another size", " ".join(fitted.notes))
        case = search.cases[0]
        self.assertEqual(case.is_right(search.low, search.high).tolist(), [FRICTION.value(place[0]) > 0.5 for place in case.tried])


class Kinds(unittest.TestCase):
    def test_are_apart_where_sizes_leave_a_gap(self):
        even = np.linspace(-1.0, 1.0, 12)
        self.assertFalse(kinds.beyond_a_gap(even, slice(None)).any())
        self.assertFalse(kinds.beyond_a_gap(10.0 * even + 0.9, slice(None)).any(), "a wide range has wide gaps")
        both = np.concatenate([even - 5.0, 0.5 * even, even + 5.0])
        found = kinds.beyond_a_gap(both, slice(None))
        self.assertEqual(found.tolist(), 12 * [True] + 12 * [False] + 12 * [True])
        found = kinds.beyond_a_gap(both, np.arange(36) < 24)
        self.assertEqual(found.tolist(), 12 * [True] + 24 * [False], "a gap among some of them")

    def test_share_is_that_of_many_runs(self):
        random = np.random.default_rng(8)
        places = random.random((4000, 2))
        odds = 8.0 * (places[:, 0] - 0.6 + 0.5 * (places[:, 1] - 0.5)**2)
        found = kinds.Share(places, random.random(4000) < special.expit(odds))
        asked = np.array([[0.2, 0.5], [0.6, 0.5], [0.6, 0.0], [0.8, 0.8]])
        truth = 2.0 * np.logaddexp(0.0, 8.0 * (asked[:, 0] - 0.6 + 0.5 * (asked[:, 1] - 0.5)**2))
        np.testing.assert_allclose(found.rarity(asked), truth, rtol=0.2)

    def test_share_of_a_few_runs_speaks_against_what_is_far_beyond_them_only(self):
        places = np.linspace(0.0, 1.0, 11)[:, None]
        found = kinds.Share(places, places[:, 0] < 0.45)
        beside, beyond, right = found.rarity(np.array([[0.44], [0.0], [0.9]]))
        self.assertLess(beside, profiles.RISE)
        self.assertGreater(beyond, 2.0 * profiles.RISE)
        self.assertLess(right, 0.1)
        self.assertEqual(kinds.Share(places, np.zeros(11, bool)).rarity(places).tolist(), 11 * [0.0])


class Ends(unittest.TestCase):
    """Of a load (1 + friction) s."""
    truth = 0.5

    def setUp(self):
        self.search = searched(record(sliding(self.truth)), [FRICTION], sliding, {"noise": 0.1})
        one = found.judge(self.search).found["friction"]
        self.low, self.high = one.low, one.high

    def test_are_confirmed_where_runs_beyond_them_do_not_fit(self):
        self.assertEqual(self.search.ends.unconfirmed, {})
        half = stats.norm.ppf(0.975) * 0.1 / np.sqrt(np.sum(EXTENSION**2))
        np.testing.assert_allclose([self.low, self.high], [self.truth - half, self.truth + half], rtol=0.05)
        within, beyond = np.array([0.9 * self.high + 0.1 * self.truth]), np.array([1.3 * self.high - 0.3 * self.truth])
        self.assertEqual(ends.doubtful(self.search, {(0, -1): beyond, (0, 1): within}), [(0, 1)])

    def test_that_are_doubted_in_the_last_look_go_on_to_those_runs_and_are_told(self):
        looks = []

        def doubtful(_, beyond):
            looks.append(beyond)
            return [(0, 1)]
        with mock.patch.object(ends, "doubtful", doubtful):
            self.search.ends = ends.checked(self.search, 9)
        self.assertEqual(len(looks), ends.CHECKS + 1)
        self.assertEqual(self.search.ends.unconfirmed, {(0, 1): looks[-1][0, 1][0]})
        fitted = found.judge(self.search)
        high = found.short(looks[-1][0, 1][0])
        self.assertEqual((fitted.found["friction"].high, fitted.summary()["friction"]["unconfirmed"]), (high, ["high"]))
        self.assertEqual(sum(f"do not confirm that its interval ends at {high:.4g}" in note for note in fitted.notes), 1)

    def test_are_unconfirmed_where_the_last_look_moved_them(self):
        of, end = self.search.ends.profiles, (0, 1)
        within, beyond = (np.array([0.5 * (self.truth + at)]) for at in (self.high, 1.0))
        low = {(0, -1): np.zeros(1)}
        self.assertEqual(ends.unconfirmed(of, {**low, end: beyond}, []), {})
        self.assertEqual(ends.unconfirmed(of, {**low, end: beyond}, [end]), {end: beyond[0]})
        self.assertEqual(ends.unconfirmed(of, {**low, end: within}, []), {end: None}, "it is beyond the runs")
        self.assertEqual(ends.unconfirmed(of, low, []), {end: None}, "it was open when the runs were made")

    def test_of_a_range_that_the_value_is_not_in_ask_for_a_wider_one(self):
        for low, high, words in ((0.6, 1.0, "lower end of its range: the data only tell that it is below 0.6"),
                                 (0.0, 0.4, "upper end of its range: the data only tell that it is above 0.")):
            fitted = found.judge(searched(record(sliding(0.5)), [FreeKey("friction", low, high)], sliding, {"noise": 1e-3}))
            self.assertFalse(fitted.fits)
            self.assertIn("friction is at the " + words, " ".join(fitted.notes))
            self.assertIn("give a wider range", " ".join(fitted.notes))

    def test_given_up_too_early_come_back(self):
        self.search.low, self.search.high = np.array([0.65]), np.array([0.8])
        self.search.learn(0)
        for number in range(6):
            self.search.wave(number)
        self.assertLess(self.search.low[0], self.low)

    def test_that_are_open_cost_no_runs_and_stay_open_wherever_the_box_ends(self):
        search = searched(record(sliding(0.5)), [FRICTION, FreeKey("density", 0.0, 1.0)], sliding, {"noise": 0.1})
        search.low[1], search.high[1] = 0.4, 0.6
        search.learn(1)
        before = search.count
        search.ends = ends.checked(search, 9)
        self.assertEqual(search.count - before, 2, "one beyond each end of friction")
        of = found.judge(search).found
        self.assertTrue(of["friction"].identifiable)
        self.assertEqual((of["density"].low, of["density"].high, of["density"].unconfirmed), (None, None, []))

    def test_know_corners_between_few_readings(self):
        """A load that rises at once and then slides: the second of a few readings is a corner."""
        s = np.linspace(0.0, 1.0, 32)

        def load(friction):
            return (1.0 + friction) * np.where(s > 0.0, 1.0, 0.1)
        fitted = found.judge(searched(record(load(0.4), s), [FRICTION], load, {"noise": 1e-3}))
        self.assertLess(fitted.chi_square, 1.0)
        self.assertAlmostEqual(fitted.found["friction"].value, 0.4, delta=1e-3)


class Specimens:
    """A batch of loops that slide, with a load that goes with friction and pre-load, and that open below a critical pre-load, where
    their load is a fifth. They scatter."""
    extension = np.linspace(0.0, 0.104, 60)

    def __init__(self, friction, preload):
        self.drawn = np.random.default_rng(0).standard_normal((12, 3))
        self.models = [self.model(friction, preload, z) for z in self.drawn]

    @classmethod
    def model(cls, friction, preload, drawn):
        s, preload = cls.extension, preload * (1.0 + 0.02 * drawn[0])
        begins = 1.0 - np.exp(-s / 0.004)
        if preload < 140.0 * np.exp(-(friction - 0.41) / 0.06):
            return Model(Pull(s, 0.6 * (preload / 180.0)**0.7 * begins + 1e5 * np.maximum(s - 0.09, 0.0)), {})
        slides = 3.3 * (preload / 180.0)**0.7 * np.exp(6.0 * (friction - 0.41)) * (0.5 + s / 0.06) * (1.0 + 0.02 * drawn[2])
        locks = 2e5 * np.maximum(s - 0.083 - 6e-4 * drawn[1], 0.0) * (0.59 + friction)
        return Model(Pull(s, slides * begins + locks), {})


class TwoKinds(unittest.TestCase):
    """Friction and pre-load of a loop whose neighbours open."""
    keys = [FreeKey("friction", 0.3, 0.6), FreeKey("preload", 50.0, 500.0)]
    truth = {"friction": 0.42, "preload": 170.0}

    def test_do_not_move_intervals(self):
        random = np.random.default_rng(1)
        true = Specimens.model(*self.truth.values(), random.standard_normal(3)).pull.load
        case = Case(record(1.002 * true + 0.5 * random.standard_normal(len(true)), Specimens.extension), 1, self.keys,
                    {"accuracy": 0.005, "noise": 0.5}, Specimens(0.5, 120.0))

        def of(place):
            return [key.value(at) for key, at in zip(self.keys, place)]

        def run(places, first):
            drawn = case.batch.drawn
            return [[Specimens.model(*of(place), drawn[(first + i) % len(drawn)]) for i, place in enumerate(places)]]
        search = Search([case], self.keys, run, lambda best: case.renew(Specimens(*of(best))))
        search.go()
        for key, one in found.judge(search).found.items():
            self.assertTrue(one.identifiable, key)
            self.assertTrue(one.low < self.truth[key] < one.high, (key, one))
        unlike = case.unlike(search.low, search.high)
        for place, is_unlike in zip(case.places, unlike):
            friction, preload = of(place)
            if abs(preload / (140.0 * np.exp(-(friction - 0.41) / 0.06)) - 1.0) > 0.06:  # three standard deviations
                self.assertEqual(is_unlike, preload < 140.0 * np.exp(-(friction - 0.41) / 0.06))


class Records(unittest.TestCase):
    def test_have_means_of_equal_parts(self):
        s = np.concatenate([np.linspace(0.0, 0.5, 90), [1.0]])
        measured = record(s, s)
        self.assertEqual(measured.counts.sum(), len(s))
        np.testing.assert_allclose(measured.measured, measured.centres)
        self.assertLess(len(measured.counts), MOST_BINS, "no part without readings")

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
