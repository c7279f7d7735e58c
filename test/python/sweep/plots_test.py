#!/usr/bin/python3
"""What the pictures of a study show and the numbers beside them say, on made-up tables. Skipped, with exit code
77, where a module is not installed."""
import math
import os
import tempfile
import unittest

from head import ROOT

import numpy as np
import pandas as pd
from scipy import stats

from knot_utm import axes, pattern_plots, plots, trends
from knot_utm.groups import dimensionless
from knot_utm.study import load_study

UNITS = {"specimen.preload": "N", "specimen.knot_distance": "m", "material.friction_coefficient": "-",
         "material.stretching_stiffness": "N", "plateau_force": "N", "locked_stiffness": "N/m"}


def table_of(**columns):
    """A table with those columns, and with what all tables have."""
    count = len(next(iter(columns.values())))
    rest = {"motion_pattern": ["sliding"] * count, "ended_by": ["extension"] * count, "jump_force": [np.nan] * count,
            "opened_when_mounted": [np.nan] * count, "untangled_at": [np.nan] * count, "run": [str(i) for i in range(count)]}
    names = {"mu": "material.friction_coefficient", "preload": "specimen.preload", "e": "specimen.knot_distance",
             "k_s": "material.stretching_stiffness"}
    frame = pd.DataFrame({**rest, **{names.get(name, name): values for name, values in columns.items()}})
    frame.attrs["units"] = {column: UNITS.get(column, "-") for column in frame}
    return frame


class MadeUpRuns:
    """Curves in which the knots come nearer to each other by 1 mm in a second."""

    def curve(self, _run):
        time = np.linspace(10.0, 40.0, 61)
        phase = np.where(time < 12.0, "tie", np.where(time < 30.0, "release", "pull"))
        return pd.DataFrame({"time": time, "extension": np.maximum(0.0, time - 30.0) * 1e-3, "load": time, "phase": phase,
                             "knot_distance": 0.15 - 1e-3 * (time - 12.0)})

    def rod(self, _run):
        return 2e-5, 2e-3  # k_b/h^2 is 5 N


class Axes(unittest.TestCase):
    def test_that_are_logarithmic_name_two_numbers_at_least(self):
        for low, high in ((2.0, 50.0), (1.5, 60.0), (0.15, 38.4), (3.0, 2900.0)):
            values = pd.Series([low, high])
            panel = axes.panels(1)[1][0]
            panel.plot(values, values, "o")
            for name in ("x", "y"):
                axes.scale_axis(panel, name, values)
            panel.figure.canvas.draw()
            for axis, (first, last) in ((panel.xaxis, panel.get_xlim()), (panel.yaxis, panel.get_ylim())):
                named = [tick for tick, label in zip(axis.get_majorticklocs(), axis.get_majorticklabels())
                         if first <= tick <= last and label.get_text()]
                self.assertGreaterEqual(len(named), 2, (low, high))


class Trends(unittest.TestCase):
    def test_the_exponent_of_a_power(self):
        x = np.geomspace(1, 100, 9)
        noise = np.random.default_rng(1).normal(0.0, 0.1, 9)
        exponent, error = trends.power(x, 3.0 * x**0.4 * np.exp(noise))
        self.assertLess(abs(exponent - 0.4), 3 * error)
        self.assertLess(error, 0.05)
        self.assertIsNone(trends.power([1, 1, 2], [1, 2, 3]))

    def test_the_exponents_of_a_product(self):
        draw = np.random.default_rng(2)
        table = table_of(mu=draw.uniform(0.4, 0.8, 50), preload=draw.uniform(1, 9, 50))
        table["plateau_force"] = 2.0 * table["material.friction_coefficient"]**1.5 * table["specimen.preload"]**0.3
        found = trends.powers(table, ["material.friction_coefficient", "specimen.preload"], "plateau_force")
        np.testing.assert_allclose(found["exponent"], [1.5, 0.3], rtol=1e-9)
        self.assertTrue((found["standard_error"] < 1e-9).all())
        self.assertIsNone(trends.powers(table[:3], ["material.friction_coefficient", "specimen.preload"], "plateau_force"))

    def test_a_threshold_is_inside_its_interval_as_often_as_it_says(self):
        draw, inside = np.random.default_rng(3), 0
        x = np.repeat(np.geomspace(0.1, 10, 12), 8)
        for _ in range(100):
            happened = draw.random(x.size) < 1 / (1 + (x / 1.3) ** 3)
            found = trends.threshold(x, happened)
            inside += found.low <= 1.3 <= found.high
        self.assertGreaterEqual(inside, stats.binom.ppf(0.001, 100, 0.95))

    def test_a_threshold_without_overlap_is_the_gap(self):
        found = trends.threshold([1.0, 2.0, 8.0, 9.0], [True, True, False, False])
        np.testing.assert_allclose((found.value, found.low, found.high), (4.0, 2.0, 8.0))
        self.assertIsNone(trends.threshold([1.0, 2.0], [True, True]))

    def test_differences_are_those_of_the_same_specimen(self):
        table = pd.DataFrame({"case": ["a"] * 9 + ["b"] * 3, "x": [1] * 3 + [2] * 3 + [1] * 3 + [1] * 3,
                              "y": [5] * 6 + [6] * 3 + [5] * 3, "f": [1.0, 2.0, 3.0, 1.1, 2.1, 3.4, 2.0, 3.0, np.nan, 9, 9, 9]})
        found = trends.differences(table, ["case", "x", "y"], ["case"], "f")
        self.assertEqual(list(zip(found["case"], found["key"], found["value"], found["n"])), [("a", "x", 2, 3), ("a", "y", 6, 2)])
        np.testing.assert_allclose(found["difference"], [0.2, 1.0])
        np.testing.assert_allclose(found["standard_error"], [np.std([0.1, 0.1, 0.4], ddof=1) / math.sqrt(3), 0.0], atol=1e-12)


class Groups(unittest.TestCase):
    def test_are_the_units_of_each_row(self):
        table = table_of(preload=[5.0, 5.0], e=[0.1, 0.1], mu=[0.5, 0.5], locked_stiffness=[1.0, 1.0])
        found = dimensionless(table, [(2e-5, 2e-3), (1e-4, 1e-2)])
        np.testing.assert_allclose(found["specimen.preload"], [1.0, 5.0])
        np.testing.assert_allclose(found["specimen.knot_distance"], [50.0, 10.0])
        np.testing.assert_allclose(found["locked_stiffness"], [4e-4, 1e-2])
        np.testing.assert_allclose(found["material.friction_coefficient"], [0.5, 0.5])
        self.assertEqual([found.attrs["units"][key] for key in UNITS if key in found], ["k_b/h2", "h", "-", "k_b/h3"])
        self.assertEqual(table.attrs["units"]["specimen.preload"], "N")


class Patterns(unittest.TestCase):
    def test_tell_apart_what_jumped_open_and_what_has_no_result(self):
        # Earlier tables have another pattern where a knot opened.
        table = table_of(motion_pattern=["sliding", "sliding", "untangling", "untangling", "none"],
                         jump_force=[np.nan, 0.1, np.nan, np.nan, np.nan], opened_when_mounted=[np.nan, np.nan, 0.01, 0.01, np.nan],
                         untangled_at=[np.nan, np.nan, np.nan, 3.0, np.nan],
                         ended_by=["break", "extension", "extension", "untangled", "solver"])
        self.assertEqual(pattern_plots.outcomes(table), ["sliding", "jumped open", "jumped open", "untangling", "no result"])

    def test_shares_of_one_number(self):
        table = table_of(material=["nylon"] * 8 + ["pink_vps"] * 8, preload=[1.0, 1.0, 2.0, 2.0, 40.0, 40.0, 90.0, 90.0] * 2,
                         motion_pattern=["untangling"] * 4 + ["sliding"] * 4 + ["stretching"] * 8)
        keys = ["material", "specimen.preload"]
        found = pattern_plots.numbers_of(table, keys, ("material",))
        nylon = found[found["case"] == "nylon"]
        self.assertEqual(list(nylon["outcome"]), ["untangling"] * 2 + ["sliding"] * 2)
        np.testing.assert_allclose(nylon[["threshold", "threshold_low", "threshold_high"]].iloc[0], [math.sqrt(80.0), 2.0, 40.0])
        self.assertTrue(found[found["case"] == "pink_vps"]["threshold"].isna().all())
        panels = pattern_plots.figure(table, keys, ("material",)).axes
        self.assertEqual([panel.get_title() for panel in panels], ["nylon", "pink_vps"])
        for panel in panels:
            heights = np.array([bar.get_height() for bar in panel.patches[:24]]).reshape(-1, 4)
            np.testing.assert_allclose(heights.sum(axis=0), 1.0)

    BORDER = 0.5

    def map(self, count=400):
        """Knots come undone below a friction of 0.5, of frictions from 0.2 to 0.8."""
        draw = np.random.default_rng(4)
        mu, e = draw.uniform(0.2, 0.8, count), draw.uniform(30, 60, count)
        preload, k_s = 10 ** draw.uniform(-1, 2, count), 10 ** draw.uniform(1, 3, count)
        return table_of(mu=mu, k_s=k_s, e=e, preload=preload, motion_pattern=np.where(mu < self.BORDER, "untangling", "sliding"))

    KEYS = ["material.friction_coefficient", "material.stretching_stiffness", "specimen.knot_distance", "specimen.preload"]

    def test_cells_of_a_map_have_the_pattern_of_their_side(self):
        found = pattern_plots.cells(self.map(), self.KEYS)
        self.assertEqual(len(found), 8 * 3 * 3 * 8)
        sure = found[abs(found[self.KEYS[0]] - self.BORDER) > 0.2]
        self.assertGreater(np.mean(np.where(sure[self.KEYS[0]] < self.BORDER, "untangling", "sliding") == sure["outcome"]), 0.98)
        self.assertTrue(((found["low"] <= found["share"]) & (found["share"] <= found["high"])).all())
        self.assertLess(found[abs(found[self.KEYS[0]] - self.BORDER) < 0.1]["share"].mean(), sure["share"].mean())

    def test_a_map_has_slices_with_the_runs_in_them(self):
        table = self.map()
        panels = pattern_plots.figure(table, self.KEYS).axes
        self.assertEqual(len(panels), 6)
        self.assertEqual({(panel.get_xlabel(), panel.get_xscale(), panel.get_ylabel()) for panel in panels},
                         {("specimen.preload [N]", "log", "material.friction_coefficient")})
        shown = sum(len(panel.collections[-1].get_offsets()) for panel in panels)
        self.assertEqual(shown, len(table))


class ShippedStudies(unittest.TestCase):
    """Each with a made-up table of its keys."""

    RESULTS = {"preload": ("plateau_force",), "speed": ("plateau_force",), "groups": ("plateau_force",),
               "does_not_matter": ("plateau_force",), "motion_patterns": ("motion_pattern", "load", "knot_distance"),
               "untangling": ("motion_pattern", "knot_distance"), "pattern_map": ("motion_pattern",),
               "rope_laws": ("plateau_force",), "silicone_laws": ("motion_pattern",), "soft_sections": ("motion_pattern",),
               "sensitivities": ("plateau_force",)}

    def test_all_are_drawn(self):
        names = [os.path.splitext(name)[0] for name in os.listdir(os.path.join(ROOT, "config/studies"))]
        self.assertEqual(sorted(names), sorted(self.RESULTS))
        for name, results in self.RESULTS.items():
            study = load_study(os.path.join(ROOT, f"config/studies/{name}.yaml"))
            with tempfile.TemporaryDirectory() as folder, self.subTest(name):
                table = self.table(study)
                for result in results:
                    plots.write_plots(table, study, result, folder, MadeUpRuns())
                written = [end for result in results for end in (result + ".png", result + "_in_groups.png")]
                self.assertLessEqual(set(written), set(os.listdir(folder)))
                for result in results:
                    if result != "load":
                        self.assertGreater(len(pd.read_csv(os.path.join(folder, result + ".csv"))), 0, result)

    @staticmethod
    def table(study):
        """Two specimens where the study repeats; of large studies a part."""
        points = study.points[::max(1, len(study.points) // 24)]
        draw = np.random.default_rng(6)
        rows = [{**{key: str(value) if isinstance(value, (list, dict)) else value for key, value in point.items()},
                 **({"specimen": number} if study.repeat > 1 else {})}
                for point in points for number in range(1, 1 + min(2, study.repeat))]
        columns = pd.DataFrame(rows)
        return table_of(**{column: columns[column] for column in columns}, plateau_force=draw.uniform(1, 9, len(rows)),
                        motion_pattern=draw.choice(["sliding", "untangling"], len(rows)))

    def test_positions_are_those_at_the_papers_instants(self):
        study = load_study(os.path.join(ROOT, "config/studies/motion_patterns.yaml"))
        found = plots.numbers_of_curves(self.table(study), study.keys, study.cases, MadeUpRuns())
        self.assertEqual(list(found["time"][:4]), [0.0, 5.0, 10.0, 15.0])
        np.testing.assert_allclose(found["mean"][:4], [0.15, 0.145, 0.14, 0.135])


if __name__ == "__main__":
    unittest.main()
