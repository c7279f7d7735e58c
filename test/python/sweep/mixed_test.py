#!/usr/bin/python3
"""Runs of two accuracies: which are made, the mean that they tell, against closed forms, and what is refused. Skipped, with exit code
77, where a module is not installed."""
import unittest

from sweeps import CONFIG, Sweeps, content, rows, write  # first: it finds the packages

import numpy as np
import pandas as pd
from scipy import stats

from knot_utm import WrongInput
from knot_utm import mixed
from knot_utm.mixed import ACCURACY, usual_pairs
from knot_utm.study import load_study


def drawn(seed, runs, pairs, correlation, slope=2.0, offset=5.0):
    """Draft, normally distributed with mean 3 and sd 1, and normal, slope times that and an offset, with this correlation."""
    random = np.random.default_rng(seed)
    x = 3.0 + random.standard_normal(runs)
    noise = slope * np.sqrt(1.0 / correlation**2 - 1.0) if correlation else 1.0
    y = (slope if correlation else 0.0) * x[:pairs] + offset + noise * random.standard_normal(pairs)
    return pd.Series(x), pd.Series(y)


def mean(draft, normal):
    return mixed.mean(draft, normal, "normal")


class TheMean(unittest.TestCase):
    def test_is_that_of_the_line_through_the_pairs_at_the_mean_of_all(self):
        x, y = drawn(2, 24, 8, 0.9)
        told = mean(x, y)
        slope, offset = np.polyfit(x[:8], y, 1)
        self.assertAlmostEqual(told["mean"], slope * x.mean() + offset)
        self.assertAlmostEqual(told["beta"], np.cov(x[:8], y)[0, 1] / np.var(x[:8], ddof=1))
        self.assertAlmostEqual(told["correlation"], np.corrcoef(x[:8], y)[0, 1])
        self.assertEqual((told["pairs"], told["draft_runs"], told["note"]), (8, 24, ""))
        self.assertAlmostEqual(told["normal_mean"], y.mean())
        self.assertAlmostEqual(told["normal_standard_error"], y.std() / np.sqrt(8))
        self.assertAlmostEqual(told["draft_standard_error"], x.std() / np.sqrt(24))

    def test_of_an_exact_line_has_the_error_of_the_draft_runs_alone(self):
        x = drawn(1, 24, 8, 0.9)[0]
        told = mean(x, 5.0 + 2.0 * x[:8])
        self.assertAlmostEqual(told["mean"], 5.0 + 2.0 * x.mean())
        self.assertAlmostEqual(told["standard_error"], 2.0 * x.std() / np.sqrt(24))
        self.assertAlmostEqual(told["high"] - told["mean"], stats.t.ppf(0.975, 23) * told["standard_error"])

    def test_pairs_are_told_by_the_index(self):
        x, y = drawn(2, 24, 8, 0.9)
        in_order, in_none = mean(x, y), mean(x.sample(frac=1.0, random_state=1), y[::-1])
        self.assertEqual(in_order.pop("note"), in_none.pop("note"))
        np.testing.assert_allclose(list(in_none.values()), list(in_order.values()))

    def test_has_an_interval_that_covers_the_truth_as_often_as_it_says(self):
        trials = 1000
        for runs, pairs, correlation in ((24, 8, 0.95), (100, 10, 0.8), (400, 8, 0.99), (40, 20, 0.0)):
            truth = 5.0 + (6.0 if correlation else 0.0)
            told = [mean(*drawn(seed, runs, pairs, correlation)) for seed in range(trials)]
            covered = np.mean([one["low"] <= truth <= one["high"] for one in told])
            self.assertLess(abs(covered - 0.95), 0.02, (runs, pairs, correlation, covered))
            spread = np.std([one["mean"] for one in told])
            self.assertLess(abs(np.sqrt(np.mean([one["standard_error"]**2 for one in told])) / spread - 1.0), 0.1,
                            (runs, pairs, correlation))

    def test_is_as_certain_as_the_closed_form_says(self):
        """Var = s_y^2 ((1 - r^2)/n + r^2/N), and (n - 2)/(n - 3) of the first for beta, which is not known."""
        n, runs, r = 12, 60, 0.95
        found = np.var([mean(*drawn(seed, runs, n, r))["mean"] for seed in range(2000)])
        of_normal = (2.0 / r)**2
        self.assertLess(abs(found / (of_normal * ((1 - r**2) / n * (n - 2) / (n - 3) + r**2 / runs)) - 1.0), 0.1)

    def test_is_of_normal_alone_where_draft_tells_nothing(self):
        x, y = drawn(1, 24, 8, 0.0)
        for draft, normal, note in ((x, y, "no correlation"), (x * 0.0, y, "no correlation"),
                                    (x, y[:3], "fewer than 4 pairs"), (x[3:], y[:6], "fewer than 4 pairs")):
            told = mean(draft, normal)
            self.assertEqual(told["note"], "normal alone: " + note)
            self.assertAlmostEqual(told["mean"], normal.mean())
            self.assertAlmostEqual(told["standard_error"], normal.sem())
            self.assertAlmostEqual(told["high"] - told["mean"], stats.t.ppf(0.975, len(normal) - 1) * normal.sem())

    def test_leaves_out_runs_without_the_reading(self):
        x, y = drawn(1, 24, 8, 0.95)
        x[2], x[20], y[5] = np.nan, np.nan, np.nan
        told = mean(x, y)
        self.assertEqual((told["pairs"], told["draft_runs"]), (6, 22))


class Chosen(Sweeps):
    def points(self, more, vary="specimen.length: {from: 0.1, to: 0.3}", method="straight", finer="normal"):
        write(self.study, f"method: {method}\naccuracy: mixed\n{more}\nvary: {{{vary}}}")
        study = load_study(self.study)
        self.assertEqual(study.mixed, finer)
        return [[point for point in study.points if point[ACCURACY] == name] for name in ("draft", finer)]

    def test_are_all_points_as_draft_and_some_of_them_as_normal(self):
        for design in ("list", "sobol"):
            draft, normal = self.points(f"design: {design}\nruns: 32\npairs: 5")
            self.assertEqual((len(draft), len(normal)), (32, 5))
            lengths = [point["specimen.length"] for point in normal]
            self.assertEqual(len(set(lengths)), 5)
            self.assertLessEqual(set(lengths), {point["specimen.length"] for point in draft})
            more = self.points(f"design: {design}\nruns: 32\npairs: 9")[1]
            self.assertLess(set(lengths), {point["specimen.length"] for point in more}, "runs are kept")
            self.assertNotEqual(normal, self.points(f"design: {design}\nruns: 32\npairs: 5\nseed: 2")[1])

    def test_are_a_tenth_but_no_fewer_than_eight_unless_given(self):
        self.assertEqual([usual_pairs(runs) for runs in (5, 8, 80, 81, 1000)], [5, 8, 8, 9, 100])
        self.assertEqual(len(self.points("design: list\nruns: 90")[1]), 9)

    def test_are_as_many_of_each_case(self):
        normal = self.points("design: list\nruns: 10\npairs: 4\nfor_each: {material: [nylon, polypropylene]}")[1]
        self.assertEqual([point["material"] for point in normal], ["nylon"] * 4 + ["polypropylene"] * 4)

    def test_have_the_accuracy_that_the_study_or_its_method_says(self):
        fine = write(self.path("fine.yaml"), content(CONFIG, "straight.yaml").decode() + "physics: {accuracy: fine}\n")
        length = "specimen.length: {from: 0.1, to: 0.3}"
        for asked in ({"method": fine}, {"vary": "physics.accuracy: [fine], " + length}):
            draft, finer = self.points("design: list\nruns: 10", finer="fine", **asked)
            self.assertEqual((len(draft), len(finer)), (10, 8))
        self.points("design: list\nruns: 10", "physics.accuracy: [normal], " + length, fine)

    def test_what_tells_no_mean_is_refused(self):
        for more, vary, why in (
                ("runs: 8\ndesign: list\naccuracy: fine", "specimen.length: {from: 0.1, to: 0.3}",
                 "accuracy is fine, but must be mixed; one accuracy is a value of physics.accuracy in vary"),
                ("accuracy: mixed", "specimen.length: [0.1, 0.2]", "accuracy is mixed, but must have a design of draws, whose mean it "
                 "tells: this one is a grid"),
                ("design: list\naccuracy: mixed", "specimen.length: [0.1, 0.2, 0.3, 0.4]", "vary.specimen.length of this list is not "
                 "drawn"),
                ("design: list\nruns: 8\naccuracy: mixed", "physics.accuracy: [draft], specimen.length: {from: 0.1, to: 0.3}",
                 "physics.accuracy is draft already"),
                ("design: sobol\nruns: 8\naccuracy: mixed", "physics.accuracy: [draft, fine]",
                 "physics.accuracy is varied: give physics.accuracy one value"),
                ("design: list\nruns: 8\naccuracy: mixed\nfor_each: {physics: [{accuracy: fine}]}",
                 "specimen.length: {from: 0.1, to: 0.3}", "physics is varied"),
                ("design: list\nruns: 8\nrepeat: 2\naccuracy: mixed", "specimen.length: {from: 0.1, to: 0.3}",
                 "accuracy is mixed, but repeat is 2"),
                ("design: list\nruns: 3\naccuracy: mixed", "specimen.length: {from: 0.1, to: 0.3}", "at least 4 runs, and here are 3"),
                ("design: list\nruns: 8\naccuracy: mixed\npairs: 9", "specimen.length: {from: 0.1, to: 0.3}",
                 "pairs is 9, but must be an integer from 4 to 8"),
                ("design: list\nruns: 8\npairs: 4", "specimen.length: {from: 0.1, to: 0.3}",
                 "pairs is 4, but has no effect without accuracy: mixed")):
            write(self.study, f"method: straight\n{more}\nvary: {{{vary}}}")
            with self.assertRaises(WrongInput) as caught:
                load_study(self.study)
            self.assertIn(why, str(caught.exception))
            self.assertTrue(str(caught.exception).startswith(self.study))
            self.assertNotIn("\n", str(caught.exception))


class ASweep(Sweeps):
    def test_leaves_the_means_beside_the_table(self):
        write(self.study, f"""
            method: {CONFIG}/straight.yaml
            design: list
            runs: 10
            accuracy: mixed
            pairs: 4
            for_each: {{material: [nylon, polypropylene]}}
            vary: {{specimen.length: {{from: 0.1, to: 0.3}}}}""")
        self.sweep("out")
        names, _, *runs = rows(self.table("out"))
        accuracy = [run[names.index(ACCURACY)] for run in runs]
        self.assertEqual((accuracy.count("draft"), accuracy.count("normal")), (20, 8))
        table = pd.read_csv(self.path("out/table.csv"), skiprows=[1], float_precision="round_trip")
        told = pd.read_csv(self.path("out/mixed.csv"), float_precision="round_trip")
        self.assertEqual(list(told["material"].unique()), ["nylon", "polypropylene"])
        own = table[table["material"] == "nylon"]
        row = told[(told["material"] == "nylon") & (told["reading"] == "peak_force")].iloc[0]
        self.assertEqual((row["unit"], row["pairs"], row["draft_runs"]), ("N", 4, 10))
        self.assertEqual(row["normal_mean"], own[own[ACCURACY] == "normal"]["peak_force"].mean())
        self.assertEqual(row["draft_mean"], own[own[ACCURACY] == "draft"]["peak_force"].mean())
        before = content(self.path("out/mixed.csv"))
        self.sweep("out")
        self.assertEqual((content(self.path("out/mixed.csv")), len(self.started())), (before, 28))


if __name__ == "__main__":
    unittest.main()
