"""Pictures of benches, drawn without a display."""
import math

import matplotlib
from runs import deviation, known, mean, standard_error

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def row_of_axes(titles, width, height):
    figure, all_axes = plt.subplots(1, len(titles), figsize=(width * len(titles), height), squeeze=False)
    for axes, title in zip(all_axes[0], titles):
        axes.set_title(title, fontsize="small")
    return figure, all_axes[0]


def panels(file, curves, x_label, y_label):
    """One panel a group of curves. `curves`: group -> name -> (x, y)."""
    figure, all_axes = row_of_axes(curves, 4.6, 4.2)
    for axes, lines in zip(all_axes, curves.values()):
        for name, (x, y) in lines.items():
            axes.plot(x, y, label=name, linewidth=0.9)
        logarithmic(axes, [value for _, y in lines.values() for value in y])
        axes.set(xlabel=x_label, ylabel=y_label)
        axes.legend(fontsize="x-small")
    save(figure, file)


def strips(file, groups, label):
    """One panel a group: every value over its name, beside it their mean and its standard error. `groups`: group ->
    name -> values."""
    figure, all_axes = row_of_axes(groups, 3.4, 3.8)
    for axes, columns in zip(all_axes, groups.values()):
        for place, values in enumerate(columns.values()):
            axes.plot([place - 0.1] * len(values), values, "o", color="tab:blue", markersize=4, alpha=0.6)
            if deviation(values) is not None:
                axes.errorbar([place + 0.15], [mean(values)], [standard_error(values)], fmt="s", color="tab:orange", capsize=3)
        axes.set_xticks(range(len(columns)), columns, fontsize="small")
        axes.set(xlim=(-0.5, len(columns) - 0.5), ylabel=label)
    save(figure, file)


def work_precision(file, scenes):
    """Cost over error, one panel a scene. `scenes`: title -> {"points": {name: (error, cost)},
    "others": the same, of other simulators}."""
    figure, all_axes = row_of_axes(scenes, 5.6, 6.8)
    for axes, scene in zip(all_axes, scenes.values()):
        marked = [(name, point, "o") for name, point in scene["points"].items()]
        marked += [(name, point, "s") for name, point in scene.get("others", {}).items()]
        for i, (name, (error, cost), marker) in enumerate(marked):
            if error and cost:  # none is known, or there is none to be seen
                axes.plot([error], [cost], marker, color=plt.cm.tab20(i % 20), label=name)
        axes.set(xscale="log", yscale="log", xlabel="error", ylabel="CPU seconds a simulated second")
        axes.margins(0.15)
        axes.legend(fontsize="xx-small", ncol=2, loc="upper center", bbox_to_anchor=(0.5, -0.12))
    save(figure, file)


def error_against_difference(file, panels_of):
    """Error given over true difference, one panel a reading: what lies above the line holds. `panels_of`: title ->
    [(difference, error, whether it holds)]."""
    figure, all_axes = row_of_axes(panels_of, 4.6, 4.2)
    for axes, points in zip(all_axes, panels_of.values()):
        both = [(difference, error, holds) for difference, error, holds in points if difference and error]
        for difference, error, holds in both:
            axes.plot([difference], [error], "o", markersize=4, color="tab:blue" if holds else "tab:red")
        if both:
            axes.axline((both[0][0], both[0][0]), (2.0 * both[0][0], 2.0 * both[0][0]), color="black", linewidth=0.8)
        axes.set(xscale="log", yscale="log", xlabel="true difference", ylabel="error given")
    save(figure, file)


def logarithmic(axes, values):
    """Logarithmic, and linear around zero: below a tenth of what is usual."""
    sizes = sorted(abs(value) for value in known(values))
    usual = sizes[len(sizes) // 2] if sizes else 0.0
    if usual > 0.0:
        axes.set_yscale("symlog", linthresh=10.0 ** math.floor(math.log10(0.1 * usual)))


def save(figure, file):
    figure.tight_layout()
    figure.savefig(file, dpi=110, metadata={"Software": None})
    plt.close(figure)
    palette(file)


def palette(file):
    """The same picture in 128 colours, which takes a quarter of the room."""
    from PIL import Image
    with Image.open(file) as drawn:
        few = drawn.convert("RGB").quantize(128, dither=Image.Dither.NONE if hasattr(Image, "Dither") else 0)
    few.save(file, optimize=True)
