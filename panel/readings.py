"""What the panel shows, as it comes in messages: the latest readings, the curve, and beside it those of earlier tests and
of a record."""
import collections
import math

KEPT = 1000  # states that wait for the reading of the load cell of the same stamp, and the other way round
CURVES = 20  # that are shown, this one among them


class Pairs:
    """Two coordinates of a point that come in two messages of the same stamp, in any order."""

    def __init__(self):
        self._waiting = ({}, {})
        self._order = collections.deque()

    def add(self, which, stamp, value):
        """which: 0 for the coordinate along the curve, 1 for the other. Both, where this one was the second; else None."""
        other = self._waiting[1 - which].pop(stamp, None)
        if other is not None:
            return (value, other) if which == 0 else (other, value)
        self._waiting[which][stamp] = value
        self._order.append((which, stamp))
        while len(self._order) > KEPT:
            old_which, old_stamp = self._order.popleft()
            self._waiting[old_which].pop(old_stamp, None)
        return None


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
        self._pairs = Pairs()
        self._curves = {}  # number of the test -> points, in the order of the tests
        self._begin_test()

    def _begin_test(self):
        self.load = math.nan
        self._measured_pairs = Pairs()
        self._measured = []
        self._measured_from = None  # its first extension, and ours at the same stamp

    def take_method(self, method):
        """method: the method of the test as a map."""
        self.material = str(method.get('material', {}).get('name', ''))
        self.knot = str(method.get('specimen', {}).get('knot', ''))

    def take_state(self, stamp, state):
        """state: a KnotState, or what has its fields. With an earlier stamp everything begins anew, as where a bag is played
        again."""
        if stamp < self.stamp:
            self._begin()
        elif self.state is not None and state.run != self.state.run:
            self._begin_test()
        self.stamp = stamp
        self.state = state
        self._take_point(self._pairs.add(0, stamp, (state.run, state.extension)))

    def take_load(self, stamp, load):
        self.load = load
        self._take_point(self._pairs.add(1, stamp, load))

    def _take_point(self, point):
        if point is None:
            return
        (run, extension), load = point
        self._curves.setdefault(run, []).append((extension, load))
        if len(self._curves) > CURVES:
            del self._curves[next(iter(self._curves))]

    def take_measured_extension(self, stamp, extension):
        if self._measured_from is None:
            ours = self.state.extension if self.state else 0.0
            self._measured_from = (extension, ours)
        self._take_measured(self._measured_pairs.add(0, stamp, extension))

    def take_measured_load(self, stamp, load):
        self._take_measured(self._measured_pairs.add(1, stamp, load))

    def _take_measured(self, point):
        if point is not None:
            self._measured.append(point)

    def curve(self):
        """Extension and load at each reading of the load cell in this test."""
        return list(self._curves.get(self.state.run, [])) if self.state else []

    def earlier(self):
        """The curves of the tests before this one."""
        return [list(points) for run, points in self._curves.items() if self.state and run != self.state.run]

    def measured(self):
        """The same of the experiment. Its extension is that of the test where its record begins."""
        if self._measured_from is None:
            return []
        first, ours = self._measured_from
        return [(extension - first + ours, load) for extension, load in self._measured]

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
