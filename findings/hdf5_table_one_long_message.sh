#!/bin/bash
# A table of 20,000 runs of a study in HDF5, of which one run left a message of 1,500 characters.
#
# Guessed: the file is about as large as the CSV (0.5 MB), whatever one row holds; columns bear their names; a longer message can be added.
# Seen, with Debian 12's pandas 1.5.3 and PyTables 3.7.0 and format="table": a column of text is as wide as its longest text in every row. With
# messages of up to 20 characters the file has 0.94 MB; one message of 1,500 makes it 30.6 MB, 59 times the CSV, and writing takes 90 MB of memory
# instead of 3. complevel=1 brings the file to 0.35 MB, not the memory. A later run with a longer message than the first table's is refused.
# Outside pandas columns are called values_block_0, values_block_1, ... by kind, not by name; with data_columns=True they bear their names.
# Why it matters: studies append a row a run, and it is the runs that fail that have long messages. Set min_itemsize at the start, cut
# messages, compress, and write with data_columns=True what HDFView, MATLAB or Julia are to read.
#
# usage: findings/hdf5_table_one_long_message.sh
# It loads Debian packages into a temporary folder, needs python3-pandas, installs nothing, and ends with 1 where they do otherwise.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get -qq download python3-tables=3.7.0-5 python3-tables-lib=3.7.0-5+b1 python3-numexpr libblosc1 libhdf5-103-1 liblzo2-2 libsz2 libaec0 2>/dev/null
for package in *.deb; do dpkg -x "$package" tree; done
PYTHONPATH=tree/usr/lib/python3/dist-packages LD_LIBRARY_PATH=tree/usr/lib/x86_64-linux-gnu /usr/bin/python3 -W ignore - <<'PYTHON'
import os
import numpy
import pandas
import tables


def runs(longest):
    table = pandas.DataFrame({"run": range(20000), "peak_force": numpy.linspace(0, 1, 20000), "message": ""})
    table.loc[17, "message"] = "x" * longest
    return table


def written(table, **how):
    """The size of its file over that of its CSV."""
    table.to_csv("table.csv", index=False)
    table.to_hdf("table.h5", "runs", mode="w", format="table", **how)
    return round(os.path.getsize("table.h5") / os.path.getsize("table.csv"), 1)


def names():
    with tables.open_file("table.h5") as file:
        return file.root.runs.table.colnames


seen = {
    "versions": (pandas.__version__, tables.__version__),
    "message of 20": written(runs(20)),
    "message of 1500": written(runs(1500)),
    "names": names(),
    "message of 1500, complevel=1": written(runs(1500), complevel=1),
    "names, data_columns=True": [written(runs(20), data_columns=True), names()][1],
}
try:
    seen["a longer one appended"] = runs(21).to_hdf("table.h5", "runs", mode="a", format="table", append=True, data_columns=True)
except ValueError as error:
    seen["a longer one appended"] = str(error).splitlines()[0]
expected = {
    "versions": ("1.5.3", "3.7.0"),
    "message of 20": 1.8,
    "message of 1500": 59.3,
    "names": ["index", "values_block_0", "values_block_1", "values_block_2"],
    "message of 1500, complevel=1": 0.7,
    "names, data_columns=True": ["index", "run", "peak_force", "message"],
    "a longer one appended": "Trying to store a string with len [21] in [message] column but",
}
for key, value in seen.items():
    print(f"{key}: {value}" + ("" if value == expected[key] else f"   expected {expected[key]}"))
raise SystemExit(seen != expected)
PYTHON
