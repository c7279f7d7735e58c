"""The picture of the panel: readings as a table, the force-extension curve, and the colour bar of the rod."""
import math

import numpy
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

UNPULLED = 0.01, 1.0  # ends of the axes before anything is pulled [m, N]
WIDTH, HEIGHT, DPI = 430, 786, 100  # of the picture [px, px, px/in]
BACKGROUND, FAINT, NAME, VALUE = '#26282e', '#4a4d55', '#a9adb7', '#f4f4f6'
OURS, EARLIER, MEASURED = '#ffc531', '#8d7434', '#59d5f2'
ROWS = 9  # of the table, at most
TOP, ROW = 0.972, 0.0365  # of the table, in heights of the picture
LEFT, RIGHT, UNIT = 0.05, 0.84, 0.865  # where names begin, values end and units begin, in widths of the picture


def limit(value, of_nothing=1.0):
    """1, 1.5, 2, 3, 5 or 7 times a power of ten, a twentieth beyond the value at least: an axis then seldom changes."""
    value = 1.05 * value
    if not value > 0.0:
        return of_nothing
    power = 10.0 ** math.floor(math.log10(value))
    return next(digit * power for digit in (1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0) if value <= digit * power * (1 + 1e-9))


class Drawing:
    """Draws readings again and again. What stays the same from picture to picture is drawn once."""

    def __init__(self):
        self.figure = Figure(figsize=(WIDTH / DPI, HEIGHT / DPI), dpi=DPI, facecolor=BACKGROUND)
        self.canvas = FigureCanvasAgg(self.figure)
        self._cells = [self._row(index) for index in range(ROWS)]
        self._axes = self.figure.add_axes([0.165, 0.235, 0.785, 0.365], facecolor=BACKGROUND)
        self._bar = self.figure.add_axes([0.08, 0.075, 0.84, 0.026])
        self._curve, = self._axes.plot([], [], color=OURS, linewidth=1.8, animated=True, zorder=3)
        self._earlier, = self._axes.plot([], [], color=EARLIER, linewidth=1.2, animated=True, zorder=1)
        self._now, = self._axes.plot([], [], 'o', color=OURS, markersize=6, animated=True, zorder=4)
        self._measured, = self._axes.plot([], [], color=MEASURED, linewidth=1.4, animated=True, zorder=2)
        self._style()
        self._kept = None  # what the part that stays was drawn for
        self._background = None

    def _row(self, index):
        height = TOP - ROW * (index + 0.5)
        places = ((LEFT, 'left', NAME, 'normal'), (RIGHT, 'right', VALUE, 'bold'), (UNIT, 'left', NAME, 'normal'))
        return [self.figure.text(x, height, '', ha=side, va='center_baseline', color=color, fontsize=10.5,
                                 fontweight=weight, animated=True) for x, side, color, weight in places]

    def _style(self):
        self._axes.set_xlabel('extension [mm]', color=NAME, fontsize=10)
        self._axes.set_ylabel('load [N]', color=NAME, fontsize=10)
        self._axes.yaxis.set_label_coords(-0.15, 0.5)
        self._axes.ticklabel_format(axis='y', scilimits=(-2, 5))
        self._axes.grid(color=FAINT, linewidth=0.6)
        self._axes.xaxis.set_major_locator(MaxNLocator(6))
        self._axes.yaxis.set_major_locator(MaxNLocator(7))
        for axes in (self._axes, self._bar):
            axes.tick_params(colors=NAME, labelsize=9)
            for spine in axes.spines.values():
                spine.set_color(FAINT)

    def draw(self, readings):
        """The picture as an array of bytes: height, width, red green blue."""
        curve = numpy.array(readings.curve()).reshape(-1, 2)
        measured = numpy.array(readings.measured()).reshape(-1, 2)
        earlier = joined(readings.earlier())
        beside = [line for line, points in ((self._earlier, earlier), (self._measured, measured)) if len(points) > 0]
        self._draw_background(numpy.vstack([curve, measured, earlier]), beside, readings.bar)
        self.canvas.restore_region(self._background)
        self._fill_table(readings.table())
        self._curve.set_data(1e3 * curve[:, 0], curve[:, 1])
        self._now.set_data(1e3 * curve[-1:, 0], curve[-1:, 1])
        self._measured.set_data(1e3 * measured[:, 0], measured[:, 1])
        self._earlier.set_data(1e3 * earlier[:, 0], earlier[:, 1])
        for artist in (self._earlier, self._measured, self._curve, self._now):
            self._axes.draw_artist(artist)
        for cell in self.cells():
            self.figure.draw_artist(cell)
        return numpy.asarray(self.canvas.buffer_rgba())[:, :, :3]

    def cells(self):
        return [cell for row in self._cells for cell in row]

    def texts(self):
        """All texts of the picture that are to be read."""
        axes = [text for axes in (self._axes, self._bar) for axis in (axes.xaxis, axes.yaxis)
                for text in (*axis.get_ticklabels(), axis.label, axis.get_offset_text()) if shown(axis, text)]
        legend = self._axes.get_legend()
        return [text for text in (*self.cells(), *axes, self._bar.title, *(legend.get_texts() if legend else ()))
                if text.get_visible() and text.get_text()]

    def _fill_table(self, table):
        for index, row in enumerate(self._cells):
            for cell, text in zip(row, table[index] if index < len(table) else ('', '', '')):
                cell.set_text(text)
            row[1].set_x(RIGHT if index < len(table) and table[index][2] else 0.95)

    def _draw_background(self, points, beside, bar):
        """beside: the lines that are drawn beside the curve of this test."""
        points = points[~numpy.isnan(points).any(axis=1)]
        low, high = points.min(axis=0, initial=0.0), points.max(axis=0, initial=0.0)
        limits = [(-limit(-low[i]) if low[i] < -1e-3 * high[i] else 0.0, limit(high[i], UNPULLED[i]))
                  for i in (0, 1)]
        keep = (limits, beside, bar)
        if keep == self._kept:
            return
        self._kept = keep
        self._axes.set_xlim(1e3 * limits[0][0], 1e3 * limits[0][1])
        self._axes.set_ylim(*limits[1])
        self._draw_legend(beside)
        self._draw_bar(bar)
        self.canvas.draw()
        self._background = self.canvas.copy_from_bbox(self.figure.bbox)

    def _draw_legend(self, beside):
        if self._axes.get_legend() is not None:
            self._axes.get_legend().remove()
        if not beside:
            return
        names = {self._curve: 'simulated' if self._measured in beside else 'this test',
                 self._earlier: 'earlier tests', self._measured: 'measured'}
        lines = [self._curve, *beside]
        self._axes.legend(lines, [names[line] for line in lines], loc='lower center', ncol=3, columnspacing=1.2,
                          bbox_to_anchor=(0.5, 1.0), frameon=False, labelcolor=NAME, fontsize=9)

    def _draw_bar(self, bar):
        self._bar.clear()
        self._bar.set_visible(bar is not None)
        if bar is None:
            return
        colors = numpy.array([[(color.r, color.g, color.b) for color in bar.colors]])
        self._bar.imshow(colors, aspect='auto', extent=(0.0, 1.0, 0.0, 1.0))
        self._bar.set_yticks([])
        self._bar.set_xticks(bar.places, ['%g' % tick for tick in bar.ticks])
        self._bar.set_title('%s of the rod [%s]' % (bar.quantity, bar.unit), color=NAME, fontsize=10, pad=6)


def joined(curves):
    """Points of several curves, with a gap behind each."""
    gap = numpy.full((1, 2), numpy.nan)
    return numpy.vstack([numpy.empty((0, 2)), *(part for curve in curves for part in (numpy.array(curve), gap))])


def shown(axis, text):
    """Whether a label of an axis stands within its limits: matplotlib keeps some that do not."""
    if text is axis.label or text is axis.get_offset_text():
        return True
    low, high = sorted(axis.get_view_interval())
    place = text.get_position()[0 if axis.axis_name == 'x' else 1]
    return low - 1e-9 <= place <= high + 1e-9
