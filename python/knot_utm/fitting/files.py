"""What a fit leaves in its folder."""
import csv
import io
import os
import subprocess
import sys

import yaml

from knot_utm import tool
from knot_utm.fitting.verdict import short

WRITTEN = ("fit.yaml", "curves.csv", "profiles.csv", "method.yaml", "method_2.yaml", "report.html", "report.pdf")


def write_fit(folder, fitted, methods):
    """fit.yaml, curves.csv, profiles.csv, and method.yaml, of further records method_2.yaml and so on. `methods`: their
    texts."""
    os.makedirs(folder, exist_ok=True)
    _replace(folder, "fit.yaml", yaml.safe_dump(summary(fitted), sort_keys=False, allow_unicode=True, width=1000))
    curves = [(number, *row) for number, (record, simulated, error) in enumerate(fitted.curves, start=1)
              for row in zip(record.centres, record.measured, simulated, error)]
    _replace(folder, "curves.csv",
             _table(("record", "extension", "measured", "simulated", "error"), ("-", "m", "N", "N", "N"), curves))
    profiles = [(key, *row) for key, (values, rises) in fitted.profiles.items() for row in zip(values, rises)]
    _replace(folder, "profiles.csv", _table(("key", "value", "rise"), ("-", "as the method", "-"), profiles))
    for number, text in enumerate(methods, start=1):
        _replace(folder, "method.yaml" if number == 1 else f"method_{number}.yaml", text)


def write_report(folder, command):
    """report.html and report.pdf, of the other files. Raises RuntimeError with a line where they cannot be made."""
    words = [sys.executable, "-m", "knot_utm.report", "--command", command, "--version", tool.version()]
    done = subprocess.run([*words, "--", folder], env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}, check=False, text=True, errors="replace", stdin=subprocess.DEVNULL,
                          capture_output=True)
    if done.returncode != 0:
        raise RuntimeError(tool.said_by(done.stderr) or "the report was not written")


def summary(fitted):
    """The map of fit.yaml."""
    found = {key: {"value": one.value, "low": one.low, "high": one.high, "identifiable": one.identifiable,
                   "unconfirmed": one.unconfirmed} for key, one in fitted.found.items()}
    correlation = {key: {other: round(value, 4) for other, value in row.items()} for key, row in fitted.correlation.items()}
    return {**found, "rms": short(fitted.rms), "correlation": correlation,
            "fits": fitted.fits, "chi_square": short(fitted.chi_square), "degrees_of_freedom": fitted.degrees_of_freedom,
            "records": [record.name for record, _, _ in fitted.curves], "notes": fitted.notes}


def _table(names, units, rows):
    """Text of a CSV: row 1 names, row 2 units."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerows([names, units])
    writer.writerows([value if isinstance(value, (str, int)) else repr(short(value)) for value in row] for row in rows)
    return out.getvalue()


def _replace(folder, name, text):
    path = os.path.join(folder, name)
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)
