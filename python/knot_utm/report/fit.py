"""A fit, as scripts/fit left it in a folder: what it found, its figures, its page."""
import os

import numpy as np

from knot_utm import axes
from knot_utm.report.curves import load_axes
from knot_utm.report.page import Box, figure, render, Row, Table, verdict_box
from knot_utm.report.quantities import is_number, number, Units
from knot_utm.report.run import read_table, read_yaml
from knot_utm.report.style import BLUE, GREEN, GREY, INK, ORANGE, short
from knot_utm.yaml_text import printable

NOT_KEYS = ("rms", "correlation", "fits", "chi_square", "degrees_of_freedom", "notes", "records")
RISE = 3.84  # of -2 log L, which bounds an interval of 95 %
HIGHEST = 12.0


def read(file, first, wanted):
    """{what stands in the first column: the wanted ones, as numbers}."""
    columns = read_table(file, wanted, (first,))
    return {str(one): tuple(columns[name][columns[first] == one] for name in wanted) for one in dict.fromkeys(columns[first])}


def curve(name, extension, measured, simulated, error):
    """Measured and simulated means of the load over parts of the extension, and their difference over its error."""
    drawn, (above, below) = load_axes(Units(), None, [1.3], above=0.15)
    s = 1e3 * extension
    above.fill_between(s, simulated - 2.0 * error, simulated + 2.0 * error, color=BLUE, alpha=0.18, lw=0, label="twice the error")
    above.plot(s, simulated, color=BLUE, lw=1.4, label="fitted")
    above.plot(s, measured, "o", color=ORANGE, ms=3.5, label="measured: " + short(name))
    above.legend(loc="upper left")
    below.axhline(0.0, color=INK, lw=0.8)
    below.axhspan(-2.0, 2.0, color=BLUE, alpha=0.12, lw=0)
    below.plot(s, (measured - simulated) / error, "o-", color=GREEN, ms=3.0, lw=0.8)
    below.set_ylabel("difference / error")
    drawn.align_ylabels((above, below))
    return drawn


def profiles(keys, found):
    """How much less likely other values of each key are. `found`: {key: (values, rises)}."""
    drawn, panels = axes.panels(len(keys), 3.0, 2.5, 2)
    for panel, (name, key) in zip(panels, keys.items()):
        places, rises = found.get(name, (np.zeros(0), np.zeros(0)))
        panel.axhline(RISE, color=GREY, lw=0.8, ls=(0, (4, 3)))
        panel.plot(places, rises, color=BLUE, lw=1.4)
        for end in filter(is_number, (key.get("low"), key.get("high"))):
            panel.axvline(end, color=BLUE, lw=0.7, ls=":")
        near = places[rises <= 1.5 * HIGHEST]
        if len(near) > 1 and np.ptp(near) > 0:
            panel.set_xlim(near[0], near[-1])
        panel.set(ylim=(0.0, HIGHEST), xlabel=name, ylabel="rise of –2 log L")
        panel.locator_params(axis="x", nbins=4)
    return drawn


def report_on_fit(folder, command, version):
    facts = read_yaml(os.path.join(folder, "fit.yaml"))
    keys = {name: found for name, found in facts.items() if name not in NOT_KEYS and isinstance(found, dict)}
    records = {str(number): printable(str(name)) for number, name in enumerate(facts.get("records") or [], start=1)}
    means = read(os.path.join(folder, "curves.csv"), "record", ("extension", "measured", "simulated", "error"))
    correlation, notes = facts.get("correlation") or {}, [printable(str(note)) for note in facts.get("notes") or []]
    fits = facts.get("fits")
    names = list(keys)
    pairs = [Row(f"{one}, {other}", (), [shown(correlation.get(one, {}).get(other))]) for i, one in enumerate(names) for other in names[i + 1:]]
    return render(
        folder, command, version, "Fit", "Fit of " + ("/".join(records["1"].split("/")[-2:]) if records else "a curve"), [
            ("Values", [
                Table(("Key", "Value", "From", "To", "Identifiable"), [
                    Row(name, [name], [*(shown(key.get(part)) for part in ("value", "low", "high")), "yes" if key.get("identifiable") else "no"])
                    for name, key in keys.items()], "keys"),
                "The interval is one of 95 %. Where an end is open, the data do not bound the key within its range. Values are in the units of "
                "the method: m, kg, s, N."]),
            *(("Curve" if len(records) == 1 else name, [number in means and figure(
                curve(name, *means[number]), "The measured and the fitted curve, and their difference over its error",
                "Each point is the mean of the readings in a part of the extension. The error is one standard deviation of the difference: of "
                "the load cell, of the computation, and of the scatter from specimen to specimen. Errors of neighbouring points go together, so "
                "that many points on one side are no contradiction. Offsets of the record, where they are free, are a part of the fitted "
                "curve.")]) for number, name in records.items()),
            ("Profiles", keys and [figure(
                profiles(keys, read(os.path.join(folder, "profiles.csv"), "key", ("value", "rise"))), "The profile of each key",
                "How much less likely the record is with another value of one key, while the other keys take the values that suit it best. The "
                "interval ends where the profile passes 3.84, the dashed line.")]),
            ("Correlations", pairs and [Table(("Keys", "Correlation"), pairs)])],
        " · ".join(records.values()), boxes=[
            verdict_box((f"The curve fits within the errors: the sum of squares over them is {shown(facts.get('chi_square'))} with "
                          f"{facts.get('degrees_of_freedom')} degrees of freedom." if fits else
                          "Nothing fits within the errors, so that the values and their intervals mean little.") +
                         f" The RMS difference is {shown(facts.get('rms'))} N.", fits),
            notes and Box("warnings", notes)])


def shown(value):
    return number(value) if is_number(value) else "open"
