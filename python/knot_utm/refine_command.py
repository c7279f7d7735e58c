"""More runs of a study where its result changes from one word to another; scripts/refine has the words of its command line."""
import os
import sys

import numpy as np
import yaml
from scipy.stats import qmc

from knot_utm import axes, pattern_plots, tool
from knot_utm.command_line import exit_code_of, WordsParser
from knot_utm.errors import WrongInput
from knot_utm.sweeping import Sweep
from knot_utm.trends import Neighbours

PROGRAM = tool.program("refine")
CANDIDATES = 32  # times as many as are chosen


def refine(study, out, runs, seed=1):
    """Makes a study of the runs of another one, whose sweep is in `out`, and as many more where the motion pattern of the nearest
    runs is least certain. Returns the path of the study, `out`/refined.yaml, or refined-2.yaml and so on where that is taken. Raises WrongInput where it varies no two numbers."""
    sweep = Sweep(study, out)
    table = sweep.table()
    numbers, words = axes.numbers_and_words(table, sweep.study.keys, sweep.study.cases)
    if len(numbers) < 2 or words or sweep.study.repeat > 1 or sweep.study.cases:
        raise WrongInput(f"{study}: refined are studies that vary two numbers or more, without words, for_each or repeat")
    chosen = more_points(table, numbers, runs, seed, sweep.study.below)
    path = _free(os.path.join(sweep.folder.path, "refined"))
    with open(path, "x", encoding="utf-8") as file:
        yaml.safe_dump(_as_study(sweep, numbers, chosen), file, sort_keys=False, default_flow_style=None, width=120)
    return path


def more_points(table, numbers, count, seed, below=()):
    """{number: values} of points that lie where the shares of the patterns are most even, among the points of a Sobol sequence
    over the range of each number; drawn with a probability in proportion to the share of all but the most frequent pattern."""
    names = pattern_plots.outcomes(table)
    known = [name != pattern_plots.FAILED for name in names]
    near = Neighbours(table[known], numbers, [name for name in names if name != pattern_plots.FAILED])
    candidates = qmc.Sobol(len(numbers), seed=seed).random(1 << int(np.ceil(np.log2(CANDIDATES * count))))
    values = near.values(candidates)
    doubt = 1.0 - near.shares(candidates).max(axis=1)
    for low in below:
        doubt[values[:, numbers.index(low)] >= values[:, numbers.index(below[low])]] = 0.0
    if np.count_nonzero(doubt) < count:
        raise WrongInput(f"the pattern changes too seldom for {count} more runs: at most {np.count_nonzero(doubt)}")
    chosen = np.random.default_rng(seed).choice(len(candidates), count, replace=False, p=doubt / doubt.sum())
    return dict(zip(numbers, values[np.sort(chosen)].T))


def _free(stem):
    """The first name that is not taken: a refined study may be refined again."""
    number = 1
    while os.path.lexists(path := stem + (".yaml" if number == 1 else f"-{number}.yaml")):
        number += 1
    return path


def _as_study(sweep, numbers, chosen):
    """A list of all points; what was the same in all runs is one value."""
    points = sweep.study.points
    vary = {key: [point[key] for point in points] + np.asarray(chosen[key]).tolist() if key in numbers else [points[0][key]]
            for key in sweep.study.keys}
    method = os.path.relpath(sweep.study.method, sweep.folder.path)
    return {"method": method, "design": "list", **({"below": sweep.study.below} if sweep.study.below else {}), "vary": vary}


def main(words):
    parser = WordsParser(prog=PROGRAM)
    parser.add_argument("study")
    parser.add_argument("--out", required=True)
    parser.add_argument("--runs", type=int, required=True)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args(words)
    for name, value, least in (("runs", asked.runs, 1), ("seed", asked.seed, 0)):
        if value < least:
            parser.error(f"--{name} is {value}, but must be at least {least}")
    return exit_code_of(PROGRAM, lambda: _refine(asked))


def _refine(asked):
    print(refine(asked.study, asked.out, asked.runs, asked.seed))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
