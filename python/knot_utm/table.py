"""The table of a study: one row a run."""
import csv
import functools
import io
import json
import os
import warnings

import pandas as pd

from knot_utm import tool
from knot_utm.arguments import write_whole
from knot_utm.yaml_text import text_of

# What the machine was, and not the test: it would differ each time.
NOT_OF_THE_TEST = ("wall_time", "real_time_factor", "peak_memory")
NUMBERS = ("number", "count", "flag")
SPECIMEN = "specimen"  # the column that tells repeats apart


class Table:
    """Columns: the varied keys, `exit_code`, `error`, the keys of result.yaml, and `run`, the folder in runs/."""

    def __init__(self, key_units):
        """`key_units`: {varied key: unit}."""
        self.keys = key_units
        self.results = result_columns()
        self.units = {**key_units, "exit_code": "-", "error": "-",
                      **{name: unit for name, unit, _ in self.results.values()}, "run": "-"}
        self.rows = []

    def add(self, point, run, exit_code, error, result):
        """`result`: of result.yaml; empty where the run left none."""
        row = {**point, "exit_code": exit_code, "error": error, "run": run}
        for (key, part), (name, _, _) in self.results.items():
            value = result.get(key)
            row[name] = value[part] if part is not None and value is not None else value
        self.rows.append([row[name] for name in self.units])

    def csv(self):
        """Row 1 names, row 2 units. What is not there is empty."""
        out = io.StringIO()
        csv.writer(out, lineterminator="\n").writerows(map(shown, row) for row in (self.units, self.units.values(), *self.rows))
        return out.getvalue()

    def frame(self):
        """For pandas: numbers are numbers, a flag is 1 or 0, what is not there is NaN or an empty text."""
        numbers = {name for name, _, kind in self.results.values() if kind in NUMBERS}
        frame = pd.DataFrame(self.rows, columns=list(self.units), dtype=object)
        numbers |= {name for name in self.keys if set(map(type, frame[name])) <= {int, float}}
        for name in frame:
            kind = int if name == "exit_code" else float if name in numbers else None
            frame[name] = frame[name].astype(kind) if kind else frame[name].map(shown)
        frame.attrs["units"] = self.units
        return frame

    def write(self, folder):
        """table.csv and table.h5, each there whole or as it was; none of no runs."""
        if not self.rows:
            return
        write_whole(os.path.join(folder, "table.csv"), self.csv().encode())
        write_whole(os.path.join(folder, "table.h5"), self.hdf())

    def hdf(self):
        """The bytes of an HDF5 file: made in memory, so that a full disk is one error and not HDF5's many."""
        with pd.HDFStore("runs.h5", "w", driver="H5FD_CORE", driver_core_backing_store=0) as store, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of dots in the names of columns, which pandas stores all the same
            # Each column by its name: in pandas' own blocks every text is as long as the longest of all columns.
            store.put("runs", self.frame(), format="table", data_columns=True, index=False, complib="zlib", complevel=5)
            store.get_storer("runs").attrs.units = json.dumps(self.units)
            store.flush()
            return store._handle.get_file_image()


@functools.cache
def result_columns():
    """{(key of result.yaml, place in a pair): (column, unit, kind)}."""
    columns = {}
    for row in tool.listing("results"):
        key, unit, kind = row["key"], row["unit"], row["kind"]
        if kind == "pair":
            columns.update({(key, i): (f"{key}.{i}", unit, "number") for i in (0, 1)})
        elif key not in NOT_OF_THE_TEST:
            columns[key, None] = (key, unit, kind)
    return columns


def shown(value):
    """As it stands in table.csv."""
    if isinstance(value, (str, type(None))):
        return value or ""
    if isinstance(value, list) and all(isinstance(entry, str) for entry in value):
        return "; ".join(value)
    return repr(value) if isinstance(value, float) else text_of(value)
