"""Pictures of curves, drawn without a display."""
import math
import statistics

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def force_and_knot_distance(file, runs):
    """One panel a run: load and knot distance over extension while it is pulled."""
    figure, panels = plt.subplots(1, len(runs), figsize=(4.2 * len(runs), 3.4), squeeze=False)
    for axes, (name, run) in zip(panels[0], runs.items()):
        pull = run.phase("pull")
        s = [1e3 * value for value in pull.get("extension", [])]
        axes.plot(s, pull.get("load", []), color="tab:blue")
        axes.set_title(name)
        axes.set_xlabel("extension s [mm]")
        axes.set_ylabel("load F [N]", color="tab:blue")
        logarithmic(axes, pull.get("load", []))
        other = axes.twinx()
        other.plot(s, [1e3 * value for value in pull.get("knot_distance", [])], color="tab:orange")
        other.set_ylabel("knot distance e [mm]", color="tab:orange")
    save(figure, file)


def curves_together(file, curves, x_label, y_label, log=False):
    """`curves`: name -> (x, y)."""
    figure, axes = plt.subplots(figsize=(7.0, 4.2))
    for name, (x, y) in curves.items():
        axes.plot(x, y, label=name)
    if log:
        logarithmic(axes, [value for _, y in curves.values() for value in y])
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.legend()
    save(figure, file)


def curves_and_shapes(file, curves, shapes, x_label, y_label):
    """`curves`: name -> (x, y); beside them rods as seen from two sides. `shapes`: name -> points, around the origin."""
    figure, all_axes = plt.subplots(1, 1 + 2 * len(shapes), figsize=(6.4 + 2.6 * 2 * len(shapes), 4.4),
                                    gridspec_kw={"width_ratios": [2.6] + [1.0] * 2 * len(shapes)})
    for name, (x, y) in curves.items():
        all_axes[0].plot(x, y, label=name, linewidth=0.9)
    all_axes[0].set_xlabel(x_label)
    all_axes[0].set_ylabel(y_label)
    all_axes[0].legend(fontsize="x-small")
    views = [(name, points, side) for name, points in shapes.items() for side in ("x", "y")]
    for axes, (name, points, side) in zip(all_axes[1:], views):
        for a, b in far_to_near(points or [], side):
            axes.plot([a[0], b[0]], [a[1], b[1]], color="black", linewidth=13.5, solid_capstyle="round")
            axes.plot([a[0], b[0]], [a[1], b[1]], color=plt.cm.viridis(a[3]), linewidth=11.0, solid_capstyle="round")
        axes.set_xlim(-9.0, 9.0)
        axes.set_ylim(-8.0, 22.0)
        axes.set_aspect("equal")
        axes.set_title(f"{name}, {side} to the right", fontsize="small")
    save(figure, file)


def far_to_near(points, side):
    """Edges as pairs of (across, up, away, share of the rod's length), the furthest ones first."""
    across, away, towards = (0, 1, 1.0) if side == "x" else (1, 0, -1.0)
    placed = [(p[across], p[2], towards * p[away], i / len(points)) for i, p in enumerate(points)]
    return sorted(zip(placed, placed[1:]), key=lambda edge: -(edge[0][2] + edge[1][2]))


def panels(file, curves, x_label, y_label):
    """One panel a group of curves. `curves`: group -> name -> (x, y)."""
    figure, all_axes = plt.subplots(1, len(curves), figsize=(4.6 * len(curves), 4.2), squeeze=False)
    for axes, (group, lines) in zip(all_axes[0], curves.items()):
        for name, (x, y) in lines.items():
            axes.plot(x, y, label=name, linewidth=0.9)
        logarithmic(axes, [value for _, y in lines.values() for value in y])
        axes.set_title(group)
        axes.set_xlabel(x_label)
        axes.set_ylabel(y_label)
        axes.legend(fontsize="x-small")
    save(figure, file)


def ratios(file, groups, x_label, y_label, band):
    """One panel a group of points that should all be one. `groups`: group -> name -> (x, ratios); `band` shows how far
    off they may be."""
    figure, all_axes = plt.subplots(1, len(groups), figsize=(4.6 * len(groups), 3.6), squeeze=False, sharey=True)
    for axes, (group, points) in zip(all_axes[0], groups.items()):
        axes.axhspan(1.0 - band, 1.0 + band, color="0.92")
        for (name, (x, y)), marker in zip(points.items(), "o^sv"):
            axes.plot(x, y, marker, label=name, markerfacecolor="none")
        axes.set_xscale("log")
        axes.set_title(group)
        axes.set_xlabel(x_label)
        axes.legend(fontsize="x-small")
    all_axes[0][0].set_ylim(1.0 - 2.0 * band, 1.0 + 2.0 * band)
    all_axes[0][0].set_ylabel(y_label)
    save(figure, file)


def strips(file, groups, label):
    """One panel a group: every value over its name, beside it their mean and its standard error. `groups`: group ->
    name -> values."""
    figure, all_axes = plt.subplots(1, len(groups), figsize=(3.4 * len(groups), 3.8), squeeze=False)
    for axes, (group, columns) in zip(all_axes[0], groups.items()):
        for place, values in enumerate(columns.values()):
            axes.plot([place - 0.1] * len(values), values, "o", color="tab:blue", markersize=4, alpha=0.6)
            if len(values) > 1:
                error = statistics.stdev(values) / math.sqrt(len(values))
                axes.errorbar([place + 0.15], [statistics.fmean(values)], [error], fmt="s", color="tab:orange", capsize=3)
        axes.set_xticks(range(len(columns)), columns, fontsize="small")
        axes.set_xlim(-0.5, len(columns) - 0.5)
        axes.set_title(group)
        axes.set_ylabel(label)
    save(figure, file)


def work_precision(file, scenes):
    """Cost over error, one panel a scene. `scenes`: title -> {"points": {name: (error, cost)},
    "others": the same, of other simulators}."""
    figure, all_axes = plt.subplots(1, len(scenes), figsize=(5.6 * len(scenes), 6.8), squeeze=False)
    for axes, (title, scene) in zip(all_axes[0], scenes.items()):
        marked = [(name, point, "o") for name, point in scene["points"].items()]
        marked += [(name, point, "s") for name, point in scene.get("others", {}).items()]
        for i, (name, (error, cost), marker) in enumerate(marked):
            if error and cost:  # none is known, or there is none to be seen
                axes.plot([error], [cost], marker, color=plt.cm.tab20(i % 20), label=name)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.margins(0.15)
        axes.legend(fontsize="xx-small", ncol=2, loc="upper center", bbox_to_anchor=(0.5, -0.12))
        axes.set_title(title, fontsize="small")
        axes.set_xlabel("error")
        axes.set_ylabel("CPU seconds a simulated second")
    save(figure, file)


def bars(file, values, label):
    """`values`: name -> value; 1 is marked."""
    figure, axes = plt.subplots(figsize=(7.0, 0.5 * len(values) + 1.0))
    known = {name: value for name, value in values.items() if value is not None}
    axes.barh(list(known), list(known.values()), color="tab:blue")
    axes.axvline(1.0, color="black", linewidth=0.8)
    axes.invert_yaxis()
    axes.set_xlabel(label)
    save(figure, file)


def statuses(file, colours, maps, histograms, linear=()):
    """Above, runs over two values of each, coloured by status; below, how readings are spread. `maps`: (x label, y
    label) -> status -> points; `histograms`: label -> values; `linear`: y labels of axes that are not logarithmic."""
    figure, all_axes = plt.subplots(2, len(maps), figsize=(4.6 * len(maps), 8.0), squeeze=False)
    for axes, ((x_label, y_label), groups) in zip(all_axes[0], maps.items()):
        for status, points in groups.items():
            axes.plot(*zip(*points), "o", markersize=4, alpha=0.8, color=colours[status],
                      label=f"{status} ({len(points)})")
        axes.set_xscale("log")
        if y_label not in linear:
            axes.set_yscale("log")
        axes.set_xlabel(x_label)
        axes.set_ylabel(y_label)
    all_axes[0][0].legend(fontsize="x-small")
    for axes, (label, values) in zip(all_axes[1], histograms.items()):
        known = [value for value in values if value]
        if known:
            low, high = math.floor(math.log10(min(known))), math.ceil(math.log10(max(known)))
            steps = max(20, 4 * (high - low))
            axes.hist(known, [10.0 ** (low + (high - low) * i / steps) for i in range(steps + 1)] if high > low else 20)
            axes.set_xscale("log")
        axes.set_xlabel(label)
        axes.set_ylabel("runs")
    save(figure, file)


def error_against_difference(file, panels_of):
    """Error given over true difference, one panel a reading: what lies above the line holds. `panels_of`: title ->
    [(difference, error, whether it holds)]."""
    figure, all_axes = plt.subplots(1, len(panels_of), figsize=(4.6 * len(panels_of), 4.2), squeeze=False)
    for axes, (title, points) in zip(all_axes[0], panels_of.items()):
        known = [(difference, error, holds) for difference, error, holds in points if difference and error]
        for difference, error, holds in known:
            axes.plot([difference], [error], "o", markersize=4, color="tab:blue" if holds else "tab:red")
        if known:
            ends = [min(point[0] for point in known), max(point[0] for point in known)]
            axes.plot(ends, ends, color="black", linewidth=0.8)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_title(title)
        axes.set_xlabel("true difference")
        axes.set_ylabel("error given")
    save(figure, file)


def intervals(file, rows):
    """Values with their intervals, [(name, value, low, high)], each over the truth."""
    figure, axes = plt.subplots(figsize=(7.0, 0.3 * len(rows) + 1.0))
    axes.axvline(1.0, color="black", linewidth=0.8)
    for place, (_, value, low, high) in enumerate(rows):
        colour = "tab:blue" if low <= 1.0 <= high else "tab:red"
        axes.plot([low, high], [place, place], color=colour)
        axes.plot([value], [place], "o", color=colour, markersize=4)
    axes.set_yticks(range(len(rows)), [name for name, *_ in rows], fontsize=8)
    axes.invert_yaxis()
    axes.set_xlabel("value and 95 % interval over the truth")
    save(figure, file)


def logarithmic(axes, values):
    """Logarithmic, and linear around zero: below a tenth of what is usual."""
    sizes = sorted(abs(value) for value in values)
    usual = sizes[len(sizes) // 2] if sizes else 0.0
    if usual > 0.0:
        axes.set_yscale("symlog", linthresh=10.0 ** math.floor(math.log10(0.1 * usual)))


def save(figure, file):
    figure.tight_layout()
    figure.savefig(file, dpi=110, metadata={"Software": None})
    plt.close(figure)
