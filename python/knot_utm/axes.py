"""What plots with several panels share: panels, names of axes, which key makes what."""
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from knot_utm.report.style import new_figure

FAR = 20  # times the smallest value: the axis is then logarithmic
ENOUGH_DECADES = 1e3  # times the smallest value: two powers of ten or more lie between, which are ticks enough
MOST_COLUMNS = 4


def panels(count, width=4.5, height=4.0, columns=MOST_COLUMNS):
    """A figure and its panels, row by row."""
    columns = min(count, columns)
    rows = -(-count // columns)
    drawn = new_figure(2 + width * columns, height * rows)
    drawn.set_layout_engine("constrained")
    places = list(drawn.subplots(rows, columns, squeeze=False).flat)
    for unused in places[count:]:
        unused.set_visible(False)
    return drawn, places[:count]


def numbers_and_words(table, keys, cases=()):
    """(keys of numbers, other keys) of those that were varied; keys of for_each (`cases`) are of the latter."""
    varied = [key for key in keys if table[key].nunique() > 1]
    numbers = [key for key in varied if table[key].dtype.kind in "if" and key not in cases]
    return numbers, [key for key in varied if key not in numbers]


def combinations(table, keys):
    """[(values, rows)] of each combination of the values of the keys."""
    if not keys:
        return [((), table)]
    groups = table.groupby(list(keys) if len(keys) > 1 else keys[0], sort=False)
    return [(values if isinstance(values, tuple) else (values,), rows) for values, rows in groups]


def parts(table, words):
    """[(label, rows)] of each combination of the words: words as they are, a number with the last part of its key."""
    return [(", ".join(f"{word.split('.')[-1]} {value:g}" if table[word].dtype.kind in "if" else str(value)
                       for word, value in zip(words, values)), rows) for values, rows in combinations(table, words)]


def with_unit(column, table):
    unit = table.attrs["units"][column]
    return column if unit == "-" else f"{column} [{unit}]"


def spans_far(values):
    return values.dtype.kind in "if" and values.min() > 0 and values.max() > FAR * values.min()


def name_axes(panel, table, x, y):
    """Names both axes by their columns, and lets them be logarithmic."""
    for name, column in (("x", x), ("y", y)):
        panel.set(**{f"{name}label": with_unit(column, table)})
        scale_axis(panel, name, table[column])


def scales(values):
    """How their axis counts, and back."""
    return (np.log, np.exp) if spans_far(values) else (np.asarray, np.asarray)


def scale_axis(panel, name, values):
    """`name`: x or y."""
    if not spans_far(values):
        return
    panel.set(**{f"{name}scale": "log"})
    if values.max() < ENOUGH_DECADES * values.min():
        axis = getattr(panel, f"{name}axis")
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())


def edges(values):
    """The edges of cells around values, half-way to the next, as the axis counts."""
    ahead, back = scales(values)
    places = ahead(values.to_numpy(float))
    middles = 0.5 * (places[1:] + places[:-1])
    return back(np.concatenate([[2 * places[0] - middles[0]], middles, [2 * places[-1] - middles[-1]]]))
