"""Knots in one rope, pulled alike, and what each of them bears: one table, the strongest first."""
import os
import re
from collections.abc import Iterable, Mapping

import numpy as np
import pandas as pd

from knot_utm import tool
from knot_utm.arguments import folder_of, jobs_of, method_of, settings_map, shown, whole
from knot_utm.errors import WrongInput
from knot_utm.groups import rod_of
from knot_utm.study import Study
from knot_utm.sweeping import Sweep
from knot_utm.yaml_text import described, text_of, value_of

METHOD = "knot"
KNOT, MATERIAL = "specimen.knot", "material"
# What says these keys, so that no setting may: an argument, and how the command line calls it.
SAID_BY = {KNOT: ("knots", "KNOT"), MATERIAL: ("material", "--material"), tool.COUNT: ("specimens", "--specimens")}
STILL_RISES = 0.98  # of the pull's extension: a largest load beyond it was none that the knot slipped at
COLUMNS = {"knot": "-", "specimens": "-", "failed": "-", "broke": "-", "still_rose": "-", "slip_load": "N", "slip_load_error": "N", "break_load": "N",
           "break_load_error": "N", "efficiency": "of the strength without a knot", "efficiency_error": "of the strength without a knot",
           "tail_slip": "h", "tail_slip_error": "h", "material": "-", "method": "-", "settings": "-"}


def rank(knots, material, specimens=3, out=None, jobs=None, method=METHOD, settings=None):
    """A pandas.DataFrame with a row for each knot, in the order of the largest load that it bore, and its units in
    `.attrs["units"]`.

    `knots`: names of config/knots/, or paths of files. `material`: a name, or a map. `specimens`: of each knot, which differ as
    tied ones do (specimens.scatter of the method). `out`: the folder of the runs, unless given out/rank/ and the name of the
    material; what is there is not run again. `settings`: {key: value} of the method besides, which every row names, too. Raises
    WrongInput where an argument, the method, a knot or a setting is refused.

    still_rose         specimens that did not break and bore most at the end of the pull: those may hold more
    slip_load          largest load, within the pull, of the specimens that did not break, whether or not they slipped; not a number
                       where all broke
    break_load         that of those that broke; efficiency is their knot_efficiency, where the material's law of breaking predicts it
    tail_slip          the most that ran into the knot from a free end, in radii of the rod
    ..._error          standard errors of these means; not a number of fewer than two specimens
    """
    knots, about = _knots(knots), about_of(material, method, settings)
    sweep = Sweep(_study(knots, material, specimens, method, settings_map(settings)), folder_of(out, usual_folder(material)))
    table = sweep.all(jobs_of(jobs))
    pulled = value_of(tool.resolved(sweep.study.method, sweep.study.points[0]))
    _, radius = rod_of(pulled)
    ranked = pd.DataFrame([about | _row(knot, table[table[KNOT] == _found(knot)], radius, _extension_of(pulled)) for knot in knots],
                          columns=list(COLUMNS))
    best = ranked[["slip_load", "break_load"]].max(axis=1)
    ranked = ranked.loc[best.sort_values(ascending=False).index].reset_index(drop=True)
    ranked.attrs["units"] = COLUMNS
    return ranked


def usual_folder(material):
    """One for each material: knots in another rope are another ranking."""
    return os.path.join("out", "rank", re.sub(r"[^\w.-]+", "_", os.path.splitext(os.path.basename(_name(material)))[0]).lstrip("."))


def about_of(material, method, settings):
    """{column: text} of what is the same for all knots of a ranking."""
    return {"material": _name(material), "method": method_of(method), "settings": described(settings_map(settings))}


def _name(material):
    """What a person calls it."""
    if isinstance(material, Mapping):
        return str(material.get("name", "own material"))
    if not isinstance(material, (str, os.PathLike)) or not str(material):
        raise WrongInput(f"material is {shown(material)}, but must be the name of a material, its file, or a dict of its values")
    return str(material)


def _knots(knots):
    """A list of names and paths."""
    listed = [] if isinstance(knots, (str, Mapping)) or not isinstance(knots, Iterable) else list(knots)
    if not listed or not all(isinstance(knot, (str, os.PathLike)) and str(knot) for knot in listed) or len(set(map(str, listed))) < len(listed):
        raise WrongInput(f"knots is {shown(knots)}, but must be a list of different knots: names or files")
    return list(map(str, listed))


def _study(knots, material, specimens, method, settings):
    """The study that these runs are."""
    whole("specimens", specimens, 2, ": one start is no reading")
    for key in settings:
        for said, (argument, option) in SAID_BY.items():
            if said == key or said.startswith(key + "."):
                raise WrongInput(f"{key} cannot be a setting of a ranking: {said} is told by {option} (in Python by {argument})")
    points = [{KNOT: _found(knot), MATERIAL: dict(material) if isinstance(material, Mapping) else _found(str(material)), **settings}
              for knot in knots]
    return Study("the ranking", tool.find_method(method_of(method), os.getcwd()), points, int(specimens), (), "list", {})


def _found(knot):
    """The file of a knot or a material as seen from here, where there is one; a method would look for it from its own folder."""
    return os.path.abspath(knot) if os.path.isfile(knot) else knot


def _extension_of(method):
    """That of the last pull [m]; without end where it has none."""
    pulls = [step["pull"] for step in method["program"] if "pull" in step]
    return float(pulls[-1]["until"].get("extension", np.inf)) if pulls else np.inf


def _row(knot, runs, radius, extension):
    done = runs[runs["exit_code"] == 0]
    broke = done["ended_by"] == "break"
    row = {"knot": knot, "specimens": len(runs), "failed": len(runs) - len(done), "broke": int(broke.sum()),
           "still_rose": int((pd.to_numeric(done["peak_extension"][~broke], errors="coerce") > STILL_RISES * extension).sum())}
    slips = [max(_list(tails), default=np.nan) / radius for tails in done["tail_slip"]]
    for name, values in (("slip_load", done["peak_force"][~broke]), ("break_load", done["peak_force"][broke]),
                         ("efficiency", done["knot_efficiency"][broke]), ("tail_slip", pd.Series(slips, dtype=float))):
        values = pd.to_numeric(values, errors="coerce").dropna()
        row[name] = values.mean() if len(values) else np.nan
        row[name + "_error"] = values.std(ddof=1) / np.sqrt(len(values)) if len(values) > 1 else np.nan
    return row


def _list(text):
    """The numbers of a list of result.yaml as a table has it."""
    values = text.strip("[]").split(",") if isinstance(text, str) else []
    return [float(value) for value in values if value and value.strip() not in ("nan", ".nan", "null")]
