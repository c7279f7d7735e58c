"""Knots in one rope, pulled alike: a preset of a sweep, over specimen.knot, and what each bears; scripts/rank has the words of its
command line."""
import os
import re
import sys

import numpy as np
import pandas as pd

from knot_utm import tool
from knot_utm.arguments import folder_of, jobs_of, shown, whole
from knot_utm.command_line import exit_code_of, parsed, parser_of, settings_of
from knot_utm.errors import refuse_if, RunFailed, WrongInput
from knot_utm.groups import rod_of
from knot_utm.study import Study
from knot_utm.sweeping import Sweep
from knot_utm.yaml_text import described, value_of

PROGRAM = tool.program("rank")
STILL_RISES = 0.98  # of the pull's extension: a largest load beyond it was none that the knot slipped at
MEANS = {"slip_load": "N", "break_load": "N", "efficiency": "of the strength without a knot", "tail_slip": "radii"}


def rank(knots, material, specimens=3, out=None, jobs=None, method="knot", settings=None):
    """A pandas.DataFrame with a row for each knot, in the order of the largest mean load that it bore, as scripts/rank tells and as it is
    in rank.csv of the folder. `.attrs` has the units of its means and the folder. Raises WrongInput."""
    settings, name = dict(settings or {}), str(material)
    refuse_if(isinstance(knots, str) or not knots or len(set(map(str, knots))) < len(list(knots)),
              f"knots is {shown(knots)}, but must be a list of different knots: names or files")
    for key in {"specimen.knot", "specimen", "material", tool.COUNT, "specimens"} & set(settings):
        raise WrongInput(f"{key} cannot be a setting of a ranking: it has a word of its own")
    # A knot and a material may be files as seen from here; a method would look for them from its own folder.
    points = [{key: os.path.abspath(given) if os.path.isfile(given) else str(given)
               for key, given in (("specimen.knot", knot), ("material", name))} | settings for knot in knots]
    study = Study("the ranking", tool.find_method(os.fspath(method), os.getcwd()), points,
                  whole("specimens", specimens, 2, ": one start is no reading"), (), "list", {})
    out = folder_of(out, os.path.join("out/rank", re.sub(r"[^\w.-]+", "_", os.path.splitext(os.path.basename(name))[0])))
    runs, pulled = Sweep(study, out).all(jobs_of(jobs)), value_of(tool.resolved(study.method, points[0]))
    runs["tail_slip"] = [max(map(float, re.findall(r"-?\d\S*\b", str(tails))), default=np.nan) / rod_of(pulled)[1]
                         for tails in runs["tail_slip"]]
    reach = max((step["pull"]["until"].get("extension", np.inf) for step in pulled["program"] if "pull" in step), default=np.inf)
    table = pd.DataFrame([{"knot": str(knot), **_row(runs[runs["specimen.knot"] == point["specimen.knot"]], reach), "material": name,
                           "method": str(method), "settings": described(settings)} for knot, point in zip(knots, points)])
    table = table.loc[table[["slip_load", "break_load"]].max(axis=1).sort_values(ascending=False).index].reset_index(drop=True)
    table.to_csv(os.path.join(out, "rank.csv"), index=False)
    table.attrs.update(units=MEANS, folder=out)
    return table


def _row(runs, reach):
    done = runs[runs["exit_code"] == 0]
    broke = done["ended_by"] == "break"
    row = {"specimens": len(runs), "failed": len(runs) - len(done), "broke": int(broke.sum()),
           "still_rose": int((done["peak_extension"][~broke] > STILL_RISES * reach).sum())}
    for name, values in zip(MEANS, (done["peak_force"][~broke], done["peak_force"][broke], done["knot_efficiency"][broke], done["tail_slip"])):
        row[name], row[name + "_error"] = values.mean(), values.sem()
    return row


def main(words):
    parser = parser_of(PROGRAM)
    parser.add_argument("knots", nargs="+")
    parser.add_argument("--material", default="nylon")
    parser.add_argument("--specimens", type=int, default=3)
    parser.add_argument("--method", default="knot")
    parser.add_argument("--set", action="append", default=[])
    return exit_code_of(PROGRAM, lambda: _rank(parsed(parser, words)), goes_on=True)


def _rank(asked):
    table = rank(asked.knots, asked.material, asked.specimens, asked.out, asked.jobs, asked.method, settings_of(asked.set))
    shown_table, (with_settings, *_) = table[["knot", "broke"]].copy(), table["settings"]
    for name in MEANS:
        shown_table[name] = ["-" if mean != mean else f"{mean:.4g} ± {error:.2g}" for mean, error in zip(table[name], table[name + "_error"])]
    shown_table.loc[table["still_rose"] > 0, "slip_load"] = "at least " + shown_table["slip_load"]
    print(f"in {asked.material}, by {asked.method}" + (f" with {with_settings}" if with_settings else "") + ":")
    print(shown_table.rename(columns={"slip_load": "slip load [N]", "break_load": "break load [N]"}).to_string(index=False))
    print(f"the table is in {table.attrs['folder']}/rank.csv")
    if failed := table["failed"].sum():
        raise RunFailed(f"{failed} specimens failed: see error in {table.attrs['folder']}/table.csv")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
