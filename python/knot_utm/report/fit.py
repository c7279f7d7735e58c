"""A fit, as scripts/fit left it in a folder: what it found, its figures, its page."""
import os
from collections import namedtuple

import matplotlib.pyplot as plt
import numpy as np

from knot_utm.report.commands import CannotReport
from knot_utm.report.page import files_of, render
from knot_utm.report.quantities import is_number, number
from knot_utm.report.run import numbers, printable, read_columns, read_yaml
from knot_utm.report.style import as_svg, BLUE, GREEN, GREY, INK, LOOKS, ORANGE, short

NOT_KEYS = ("rms", "correlation", "fits", "chi_square", "degrees_of_freedom", "notes", "records")


class Key:
    """A free key. `low`, `high`: None where the data do not tell that end."""

    def __init__(self, name, found, places, rises):
        self.name = name
        self.value, self.low, self.high = (found.get(part) if is_number(found.get(part)) else None
                                           for part in ("value", "low", "high"))
        self.is_identifiable = bool(found.get("identifiable"))
        self.places, self.rises = places, rises


# A record: means of the load over parts of the extension, measured and simulated, and the error of their difference.
Curve = namedtuple("Curve", "name extension measured simulated error")


class Fit:
    def __init__(self, folder):
        self.facts = read_yaml(os.path.join(folder, "fit.yaml"))
        self.correlation = self.facts.get("correlation") or {}
        self.notes = [printable(str(note)) for note in self.facts.get("notes") or []]
        profiles = read(folder, "profiles.csv", ("value", "rise"))
        curves = read(folder, "curves.csv", ("extension", "measured", "simulated", "error"))
        self.keys = [Key(name, found, *profiles.get(name, (np.zeros(0), np.zeros(0))))
                     for name, found in self.facts.items() if name not in NOT_KEYS and isinstance(found, dict)]
        self.curves = [Curve(printable(str(name)), *curves.get(str(number), [np.zeros(0)] * 4))
                       for number, name in enumerate(self.facts.get("records") or [], start=1)]


def read(folder, name, wanted):
    """{first column: the wanted ones, as numbers}."""
    file = os.path.join(folder, name)
    columns = read_columns(file)
    first = next(iter(columns))
    for column in wanted:
        if column not in columns:
            raise CannotReport(f"{file}: no column {column}")
    values = [numbers(file, column, columns[column]) for column in wanted]
    of = np.array(columns[first])
    return {str(one): tuple(column[of == one] for column in values) for one in dict.fromkeys(columns[first])}


RISE = 3.84  # of -2 log L, which bounds an interval of 95 %
HIGHEST = 12.0


def curve(one, look):
    """Measured and simulated, and their difference over its error."""
    tall = 4.6
    figure, (above, below) = plt.subplots(2, 1, figsize=(look.width, tall), sharex=True,
                                          gridspec_kw={"height_ratios": [2.4, 1.2], "hspace": 0.12})
    s = 1e3 * one.extension
    above.fill_between(s, one.simulated - 2.0 * one.error, one.simulated + 2.0 * one.error, color=BLUE, alpha=0.18, lw=0,
                       label="twice the error")
    above.plot(s, one.simulated, color=BLUE, lw=1.4, label="fitted")
    above.plot(s, one.measured, "o", color=ORANGE, ms=3.5, label="measured: " + short(one.name, 34 if look.is_narrow else 60))
    above.set_ylabel("load F [N]")
    above.legend(loc="upper left")
    below.axhline(0.0, color=INK, lw=0.8)
    below.axhspan(-2.0, 2.0, color=BLUE, alpha=0.12, lw=0)
    below.plot(s, (one.measured - one.simulated) / one.error, "o-", color=GREEN, ms=3.0, lw=0.8)
    below.set_ylabel("difference / error")
    below.set_xlabel("extension s [mm]")
    figure.align_ylabels((above, below))
    figure.subplots_adjust(**look.room(tall, 0.45, 0.12))
    return as_svg(figure)


def profiles(keys, look):
    """How much less likely other values of each key are."""
    across = 1 if look.is_narrow else 2
    down = -(-len(keys) // across)
    tall = 2.5 * down
    figure, panels = plt.subplots(down, across, figsize=(look.width, tall), squeeze=False, sharey=True)
    for panel in panels.ravel()[len(keys):]:
        panel.set_visible(False)
    for panel, key in zip(panels.ravel(), keys):
        panel.axhline(RISE, color=GREY, lw=0.8, ls=(0, (4, 3)))
        panel.plot(key.places, key.rises, color=BLUE, lw=1.4)
        for end in (key.low, key.high):
            if end is not None:
                panel.axvline(end, color=BLUE, lw=0.7, ls=":")
        near = key.places[key.rises <= 1.5 * HIGHEST]
        if len(near) > 1 and np.ptp(near) > 0:
            panel.set_xlim(near[0], near[-1])
        panel.set_ylim(0.0, HIGHEST)
        panel.set_xlabel(key.name)
        panel.xaxis.set_major_locator(plt.MaxNLocator(4))
    for row in panels:
        row[0].set_ylabel("rise of –2 log L")
    figure.subplots_adjust(**look.room(tall, 0.55, 0.12), wspace=0.1, hspace=0.45)
    return as_svg(figure)


def report_on_fit(folder, command, version):
    fit = Fit(folder)
    return render("fit.html.j2", {
        "title": "Fit of " + ("/".join(fit.curves[0].name.split("/")[-2:]) if fit.curves else "a curve"),
        "records": [(one.name, [curve(one, look) for look in LOOKS] if len(one.extension) else None) for one in fit.curves],
        "profiles": [profiles(fit.keys, look) for look in LOOKS] if fit.keys else None,
        "rows": [(key.name, told(key.value), told(key.low), told(key.high), "yes" if key.is_identifiable else "no")
                 for key in fit.keys],
        "correlation": [(one.name, other.name, told(fit.correlation.get(one.name, {}).get(other.name)))
                        for i, one in enumerate(fit.keys) for other in fit.keys[i + 1:]],
        "rms": told(fit.facts.get("rms")), "fits": fit.facts.get("fits"), "chi_square": told(fit.facts.get("chi_square")),
        "degrees": fit.facts.get("degrees_of_freedom"), "notes": fit.notes, "files": files_of(folder), "command": printable(command),
        "version": version, "folder": printable(folder)})


def told(value):
    return "open" if value is None else number(value)
