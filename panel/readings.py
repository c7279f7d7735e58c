"""What the panel shows, as it comes in messages: the latest readings, the curve, and the recorded curve beside it."""
import collections
import math

KEPT = 1000  # states that wait for the reading of the load cell of the same stamp, and the other way round


class Pairs:
    """Points of a curve whose two coordinates come in two messages of the same stamp, in any order."""

    def __init__(self):
        self.points = []
        self._waiting = ({}, {})
        self._order = collections.deque()

    def add(self, which, stamp, value):
        """which: 0 for the coordinate along the curve, 1 for the other."""
        other = self._waiting[1 - which].pop(stamp, None)
        if other is not None:
            self.points.append((value, other) if which == 0 else (other, value))
            return
        self._waiting[which][stamp] = value
        self._order.append((which, stamp))
        while len(self._order) > KEPT:
            old_which, old_stamp = self._order.popleft()
            self._waiting[old_which].pop(old_stamp, None)


class Readings:
    """All that is known of the test that runs. Lengths in m, forces in N."""

    def __init__(self):
        self.material = ''
        self.knot = ''
        self.bar = None  # the colour bar, as the message has it
        self._begin()

    def _begin(self):
        self.stamp = -1.0
        self.state = None
        self.load = math.nan
        self._curve = Pairs()
        self._measured = Pairs()
        self._measured_from = None  # its first extension, and ours at the same stamp

    def take_method(self, method):
        """method: the method of the test as a map."""
        self.material = str(method.get('material', {}).get('name', ''))
        self.knot = str(method.get('specimen', {}).get('knot', ''))

    def take_state(self, stamp, state):
        """state: a KnotState, or what has its fields. One of an earlier stamp begins another test, or the same anew."""
        if stamp < self.stamp:
            self._begin()
        self.stamp = stamp
        self.state = state
        self._curve.add(0, stamp, state.extension)

    def take_load(self, stamp, load):
        self.load = load
        self._curve.add(1, stamp, load)

    def take_measured_extension(self, stamp, extension):
        if self._measured_from is None:
            ours = self.state.extension if self.state else 0.0
            self._measured_from = (extension, ours)
        self._measured.add(0, stamp, extension)

    def take_measured_load(self, stamp, load):
        self._measured.add(1, stamp, load)

    def curve(self):
        """Extension and load at each reading of the load cell."""
        return list(self._curve.points)

    def measured(self):
        """The same of the experiment. Its extension is that of the test where its record begins."""
        if self._measured_from is None:
            return []
        first, ours = self._measured_from
        return [(extension - first + ours, load) for extension, load in self._measured.points]

    def table(self):
        """Rows of name, value and unit."""
        state = self.state
        if state is None:
            return [('material', self.material or '–', ''), ('knot', self.knot or '–', '')]
        pattern = 'locked' if state.locked else state.motion_pattern
        return [
            ('time', '%.1f' % state.time, 's'),
            ('material', self.material or '–', ''),
            ('knot', self.knot or '–', ''),
            ('phase', state.phase or '–', ''),
            ('motion pattern', pattern or '–', ''),
            ('extension', millimetres(state.extension), 'mm'),
            ('load', number(state.load if math.isnan(self.load) else self.load), 'N'),
            ('knot distance', millimetres(state.knot_distance), 'mm'),
            ('end-to-end distance', millimetres(state.end_to_end), 'mm'),
        ]


def millimetres(metres):
    return '–' if math.isnan(metres) else '%.1f' % (1e3 * metres)


def number(value):
    """Four digits, without an exponent where they are enough."""
    if math.isnan(value):
        return '–'
    return '%.0f' % value if abs(value) >= 1e4 else '%.4g' % value
