"""The picture of the panel: readings as a table, the force-extension curve, or beside a record without travel the loads over time, and the
colour bar of the rod. Where large loads hide those of sliding, the curve is drawn once more with these alone."""
import math

import numpy
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

UNPULLED = 10.0, 1.0  # ends of the axes before anything is pulled [mm or s, N]
WIDTH, HEIGHT, DPI = 430, 786, 100  # of the picture [px, px, px/in]
BACKGROUND, FAINT, NAME, VALUE = '#26282e', '#4a4d55', '#a9adb7', '#f4f4f6'
EXTENSION, TIME = 'extension [mm]', 'time since the pull began [s]'
OURS, MEASURED = '#ffc531', '#59d5f2'
NOT_KNOWN = 'grey: of a rod that has parted no tension is known'
ROWS = 10  # of the table, at most
TOP, ROW = 0.976, 0.0342  # of the table, in heights of the picture
LEFT, RIGHT, UNIT = 0.05, 0.84, 0.865  # where names begin, values end and units begin, in widths of the picture


def limit(value, of_nothing=1.0):
    """1, 1.5, 2, 3, 5 or 7 times a power of ten, a twentieth beyond the value at least: an axis then seldom changes."""
    value = 1.05 * value
    if not value > 0.0:
        return of_nothing
    power = 10.0 ** math.floor(math.log10(value))
    return next(digit * power for digit in (1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0) if value <= digit * power * (1 + 1e-9))


# Where axes stand in the picture, in its widths and heights: alone, and all loads above the small ones.
ALONE, UPPER, LOWER = ([0.165, low, 0.785, high] for low, high in ((0.235, 0.365), (0.435, 0.165), (0.235, 0.175)))


class Chart:
    """Loads over the extension or the time, of this test and of those beside it."""

    def __init__(self, figure, name):
        self.axes = figure.add_axes(ALONE, facecolor=BACKGROUND)
        self.measured, = self.axes.plot([], [], color=MEASURED, linewidth=1.4, animated=True, zorder=2)
        self.curve, = self.axes.plot([], [], color=OURS, linewidth=1.8, animated=True, zorder=3)
        self.now, = self.axes.plot([], [], 'o', color=OURS, markersize=6, animated=True, zorder=4)
        self.axes.set_xlabel(EXTENSION, color=NAME, fontsize=10)
        self.axes.set_ylabel(name, color=NAME, fontsize=10)
        self.axes.yaxis.set_label_coords(-0.15, 0.5)
        self.axes.ticklabel_format(axis='y', scilimits=(-2, 5))
        self.axes.grid(color=FAINT, linewidth=0.6)
        self.axes.xaxis.set_major_locator(MaxNLocator(6))
        in_grey(self.axes)

    def place(self, box, ticks, is_lowest, along):
        self.axes.xaxis.label.set_text(along)
        self.axes.set_position(box)
        self.axes.yaxis.set_major_locator(MaxNLocator(ticks))
        self.axes.xaxis.label.set_visible(is_lowest)
        self.axes.tick_params(labelbottom=is_lowest)

    def draw(self, curve, measured):
        for line, points in ((self.measured, measured), (self.curve, curve), (self.now, curve[-1:])):
            line.set_data(points.T)
            self.axes.draw_artist(line)


def in_grey(axes):
    axes.tick_params(colors=NAME, labelsize=9)
    for spine in axes.spines.values():
        spine.set_color(FAINT)


class Drawing:
    """Draws readings again and again. What stays the same from picture to picture is drawn once."""

    def __init__(self):
        self.figure = Figure(figsize=(WIDTH / DPI, HEIGHT / DPI), dpi=DPI, facecolor=BACKGROUND)
        self.canvas = FigureCanvasAgg(self.figure)
        self._cells = [self._row(index) for index in range(ROWS)]
        self._all, self._small = Chart(self.figure, 'load [N]'), Chart(self.figure, 'small loads [N]')
        self._legend = self._all.axes.legend([self._all.curve, self._all.measured], ['simulated', 'measured'], loc='lower center', ncol=2,
                                             columnspacing=1.2, bbox_to_anchor=(0.5, 1.0), frameon=False, labelcolor=NAME, fontsize=9)
        self._bar = self.figure.add_axes([0.08, 0.075, 0.84, 0.026])
        in_grey(self._bar)
        self._kept = None  # what the part that stays was drawn for
        self._background = None

    def _row(self, index):
        height = TOP - ROW * (index + 0.5)
        places = ((LEFT, 'left', NAME, 'normal'), (RIGHT, 'right', VALUE, 'bold'), (UNIT, 'left', NAME, 'normal'))
        return [self.figure.text(x, height, '', ha=side, va='center_baseline', color=color, fontsize=10.5,
                                 fontweight=weight, animated=True) for x, side, color, weight in places]

    def draw(self, readings):
        """The picture as an array of bytes: height, width, red green blue."""
        over_time = readings.over_time()
        curve, measured = (numpy.array(points).reshape(-1, 2) * (1.0 if over_time else 1e3, 1.0)
                           for points in over_time or (readings.curve, readings.measured))
        small = readings.small_load()
        self._draw_background(numpy.vstack([curve, measured]), None if small is None else limit(small), len(measured) > 0,
                              TIME if over_time else EXTENSION, (readings.bar, readings.colours_are_known()))
        self.canvas.restore_region(self._background)
        self._fill_table(readings.table())
        self._all.draw(curve, measured)
        if small is not None:
            self._small.draw(curve, measured)
        for cell in (cell for row in self._cells for cell in row):
            self.figure.draw_artist(cell)
        return numpy.asarray(self.canvas.buffer_rgba())[:, :, :3]

    def _fill_table(self, table):
        for cells, texts in zip(self._cells, table + [('', '', '')] * ROWS):
            for cell, text in zip(cells, texts):
                cell.set_text(text)
            cells[1].set_x(RIGHT if texts[2] else 0.95)

    def _draw_background(self, points, small, beside, along, bar):
        """small: where the axes of the small loads end [N]; None: there are none. beside: whether a measured curve is drawn beside
        that of this test. along: what the loads are drawn over. bar: the colour bar, and whether the colours mean anything."""
        points = points[~numpy.isnan(points).any(axis=1)]
        low, high = points.min(axis=0, initial=0.0), points.max(axis=0, initial=0.0)
        limits = [(-limit(-low[i]) if low[i] < -1e-3 * high[i] else 0.0, limit(high[i], UNPULLED[i]))
                  for i in (0, 1)]
        keep = (limits, small, beside, along, bar)
        if keep == self._kept:
            return
        self._kept = keep
        self._all.place(ALONE if small is None else UPPER, 7 if small is None else 4, small is None, along)
        self._small.place(LOWER, 4, True, along)
        self._small.axes.set_visible(small is not None)
        for chart in (self._all, self._small):
            chart.axes.set_xlim(*limits[0])
        self._all.axes.set_ylim(*limits[1])
        if small is not None:
            self._small.axes.set_ylim(max(limits[1][0], -0.3 * small), small)
        self._legend.set_visible(beside)
        self._draw_bar(*bar)
        self.canvas.draw()
        self._background = self.canvas.copy_from_bbox(self.figure.bbox)

    def _draw_bar(self, bar, is_known):
        self._bar.clear()
        self._bar.set_visible(bar is not None)
        if bar is None:
            return
        colors = numpy.array([[(color.r, color.g, color.b) for color in bar.colors]])
        self._bar.imshow(colors, aspect='auto', extent=(0.0, 1.0, 0.0, 1.0))
        self._bar.set_yticks([])
        self._bar.set_xticks(bar.places, ['%g' % tick for tick in bar.ticks])
        title = '%s of the rod [%s]' % (bar.quantity, bar.unit) if is_known else NOT_KNOWN
        self._bar.set_title(title, color=NAME, fontsize=10, pad=6)
