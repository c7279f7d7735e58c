"""The figures of a fit: the curves, what is left of them, and the profiles of the keys."""
import matplotlib.pyplot as plt
import numpy as np

from knot_utm.report.comparison_figures import short
from knot_utm.report.style import BLUE, GREEN, GREY, INK, ORANGE, as_svg

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
