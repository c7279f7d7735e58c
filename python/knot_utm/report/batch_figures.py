"""The curves of a batch: every specimen that counts, and their mean with its band."""
import numpy as np

from knot_utm.report.curve_figures import small_loads
from knot_utm.report.few_points import few_points
from knot_utm.report.style import BLUE, GREY, INK, ORANGE, as_svg, stacked

IN_ALL = 60000  # points of all curves together: more of them make a page that is slow to open
FEWEST = 60     # points of one curve


def curves(batch, mean, look):
    """`mean`: a MeanCurve, or None. The loads once more where they are small beside the peak."""
    pulls = [one.pull for one in batch.tested if len(one.pull[0])]
    force, length = batch.units.force, batch.units.length
    closer = small_loads(batch.common_mean, np.concatenate([load for _, load in pulls]), force.scale)
    figure, all_axes, tall = stacked(look, [2.7] + ([1.8] if closer else []))
    for axes in all_axes:
        draw(axes, pulls, mean, force.scale, length.scale)
    all_axes[0].set_ylim(*load_limits(pulls, force.scale))
    all_axes[0].set_ylabel(f"load F [{force.name}]")
    place_legend(all_axes[0], look)
    if closer:
        all_axes[1].set_ylim(*closer)
        all_axes[1].set_ylabel(f"small loads [{force.name}]")
    every = length.scale * np.concatenate([s for s, _ in pulls])
    all_axes[-1].set_xlim(min(0.0, every.min()), every.max() + 0.015 * (np.ptp(every) or length.scale))
    all_axes[-1].set_xlabel(f"extension s [{length.name}]")
    figure.align_ylabels(all_axes)
    figure.subplots_adjust(**look.room(tall, 0.5, 0.5 if look.is_narrow else 0.3))
    return as_svg(figure)


def place_legend(axes, look):
    """Above the axes, as curves and bands may be anywhere in them."""
    if look.is_narrow:
        legend = axes.legend(loc="lower left", bbox_to_anchor=(-0.22, 1.0), ncol=2, columnspacing=0.8, handlelength=1.2,
                             borderpad=0.2)
    else:
        legend = axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncol=4, borderpad=0.2)
    for line in legend.get_lines():
        line.set_alpha(1.0)


def draw(axes, pulls, mean, force, length):
    most = max(FEWEST, IN_ALL // len(pulls))
    faint = min(0.6, max(0.1, 6.0 / len(pulls)))  # so that many do not hide the band
    label = "the specimen" if len(pulls) == 1 else f"{len(pulls)} specimens"
    for s, load in pulls:
        rows = few_points(load, most=most)
        axes.plot(length * s[rows], force * load[rows], color=BLUE, lw=0.8, alpha=faint, label=label)
        label = None
    if mean is None:
        return
    s, middle = length * mean.extension, force * mean.mean
    low, high = mean.about(mean.sd)
    axes.fill_between(s, force * low, force * high, color=ORANGE, alpha=0.28, lw=0, zorder=3,
                      label="mean ± standard deviation")
    axes.plot(s, middle, color=ORANGE, lw=1.5, zorder=5, label="mean")
    for end, name in zip(mean.about(mean.half), ("95 % interval of the mean", None)):
        axes.plot(s, force * end, color=INK, lw=0.7, ls=(0, (3, 2)), zorder=4, label=name)
    for end in (s[0], s[-1]):
        axes.axvline(end, color=GREY, lw=0.6, ls=":")


def load_limits(pulls, force):
    low = force * min(0.0, *(load.min() for _, load in pulls))
    high = force * max(load.max() for _, load in pulls)
    room = 0.05 * ((high - low) or 1.0)
    return low - room if low < 0.0 else 0.0, high + room
