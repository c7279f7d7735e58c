"""Many runs as draft, corrected by a few of the accuracy that is asked for: the study's key `accuracy: mixed`.

Each of N points is run as draft (x), and n of them, chosen at random, with that accuracy, too (y). The mean of y is estimated by a
control variate (Glasserman, Monte Carlo Methods in Financial Engineering, 2003, section 4.1). Where the mean of x is told by more
draws, as here, that is double sampling with a regression (Cochran, Sampling Techniques, 1977, chapter 12):

    mean = mean_n(y) + beta (mean_N(x) - mean_n(x)),    beta = s_xy / s_x^2 of the n pairs

Points are independent draws, so that there are two errors. The line through the pairs is told at mean_N(x) as that of any regression
is, and mean_N(x) is itself the mean of N draws:

    standard_error^2 = s_e^2 (1/n + (mean_N(x) - mean_n(x))^2 / S_xx) + beta^2 s_x^2 / N

s_e^2 is the sum of squares about the line over n - 2, S_xx that of x about mean_n(x), and s_x the standard deviation of all N. The
first error has n - 2 degrees of freedom, the second N - 1, and their sum as many as Welch (1947) says. The points of a Sobol sequence
lie more evenly than draws, so that the second error is an upper bound for them."""
import os

import numpy as np
import pandas as pd
from scipy import stats

from knot_utm.table import result_columns

ACCURACY = "physics.accuracy"
DRAFT, USUAL = "draft", "normal"
FEWEST = 4       # pairs that tell of a correlation
CERTAIN = 0.05   # a correlation counts where chance makes it more seldom
FILE = "mixed.csv"


def usual_pairs(runs):
    """How many of these runs are made with both accuracies, unless that is given."""
    return min(runs, max(8, -(-runs // 10)))


def both(points, cases, accuracy, count, seed):
    """All points as draft, and `count` points of each case, which are drawn, with `accuracy`. The choice of more has that of
    fewer."""
    of_case = {}
    for point in points:
        of_case.setdefault(tuple(str(point[key]) for key in cases), []).append(point)
    draw = np.random.default_rng([1, seed])  # not the numbers that the points were drawn with
    chosen = [own[i] for own in of_case.values() for i in sorted(draw.permutation(len(own))[:count])]
    return [{**point, ACCURACY: DRAFT} for point in points] + [{**point, ACCURACY: accuracy} for point in chosen]


def write(table, study, folder):
    """mixed.csv, of a sweep's table."""
    means(table, study.keys, list(study.cases), study.mixed).to_csv(os.path.join(folder, FILE), index=False)


def means(table, keys, cases, accuracy):
    """The mean of each number of result.yaml that is there, a row for each, or for each of them and each case."""
    rows = []
    points = [key for key in keys if key != ACCURACY]
    table = table.drop_duplicates("run")
    for case, part in table.groupby(cases, sort=False) if cases else [((), table)]:
        named = dict(zip(cases, case if isinstance(case, tuple) else (case,)))
        draft, finer = (part[part[ACCURACY] == word].set_index(points) for word in (DRAFT, accuracy))
        for column, unit, kind in result_columns().values():
            if kind == "number" and finer[column].notna().any():
                rows.append({**named, "reading": column, "unit": unit, **mean(draft[column], finer[column], accuracy)})
    return pd.DataFrame(rows)


def mean(draft, finer, accuracy):
    """The mean of one number at an accuracy, with its error and a 95 % interval. `draft`, `finer`: pandas.Series of draft and of
    that accuracy, whose index says which of their values are of one point."""
    draft, finer = draft.dropna(), finer.dropna()
    pairs = pd.concat([draft, finer], axis=1, join="inner", keys=("x", "y"))
    told = {"pairs": len(pairs), "draft_runs": len(draft), "beta": np.nan, "correlation": np.nan}
    alone = {"draft_mean": draft.mean(), "draft_standard_error": draft.sem(), f"{accuracy}_mean": finer.mean(),
             f"{accuracy}_standard_error": finer.sem()}
    if len(pairs) < FEWEST:
        return {**_estimate(finer.mean(), finer.sem(), len(finer) - 1), **told, **alone,
                "note": f"{accuracy} alone: fewer than {FEWEST} pairs"}
    line = stats.linregress(pairs["x"], pairs["y"]) if pairs["x"].nunique() > 1 else None
    if line is not None:
        told.update(beta=line.slope, correlation=line.rvalue)
    if line is None or not line.pvalue < CERTAIN:
        return {**_estimate(finer.mean(), finer.sem(), len(finer) - 1), **told, **alone, "note": f"{accuracy} alone: no correlation"}
    return {**_corrected(pairs["x"], pairs["y"], draft, line), **told, **alone, "note": ""}


def _corrected(x, y, draft, line):
    n, away = len(x), draft.mean() - x.mean()
    about_line = np.sum((y - line.intercept - line.slope * x) ** 2) / (n - 2)
    of_pairs = about_line * (1.0 / n + away**2 / np.sum((x - x.mean()) ** 2))
    of_draft = line.slope**2 * draft.var() / len(draft)
    variance = of_pairs + of_draft
    free = variance**2 / (of_pairs**2 / (n - 2) + of_draft**2 / (len(draft) - 1))
    return _estimate(y.mean() + line.slope * away, np.sqrt(variance), free)


def _estimate(value, error, free):
    half = stats.t.ppf(0.975, free) * error if free > 0 else np.nan
    return {"mean": value, "standard_error": error, "low": value - half, "high": value + half}
