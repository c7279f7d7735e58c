"""What the panel shows, as it comes in messages: the latest readings, the curve, and beside it that of a record."""
import collections
import math
import statistics

# Phases before the zero of the pull (tensile_test --list-phases, prepares): the balance is the zero.
PREPARATION = {'', 'idle', 'tie', 'release', 'mount', 'preload', 'done'}
BROKEN, FAILED = 3, 4  # status of a KnotState
KEPT, CROSSED = 0, 2   # its knot_type
PAUSED, ENDED = 2, 3               # of a TestStatus
MANY = 8.0  # loads above this many of those of sliding hide them: these get axes of their own, also in a report
ENDS = {'break': 'broke', 'untangled': 'came undone', 'solver': 'the physics gave up',
        'operator': 'ended by the operator', 'program': 'ended with its program'}
MOST_WAITING = 1000  # states that wait for the reading of the load cell of the same stamp, and the other way round


class Pairs:
    """Two coordinates of a point that come in two messages of the same stamp, in any order; `take` gets both of them."""

    def __init__(self, take):
        self._take = take
        self._waiting = ({}, {})
        self._order = collections.deque()

    def add(self, which, stamp, value):
        """which: 0 for the coordinate along the curve, 1 for the other."""
        other = self._waiting[1 - which].pop(stamp, None)
        if other is not None:
            self._take((value, other) if which == 0 else (other, value))
            return
        self._waiting[which][stamp] = value
        self._order.append((which, stamp))
        while len(self._order) > MOST_WAITING:
            old_which, old_stamp = self._order.popleft()
            self._waiting[old_which].pop(old_stamp, None)


class Readings:
    """All that is known of the test that runs. Lengths in m, forces in N."""

    def __init__(self):
        self.material = ''
        self.knot = ''
        self.bar = None  # the colour bar, as the message has it
        self._status = None  # of the test, as the message has it
        self._begin()

    def _begin(self):
        self.stamp = -1.0
        self.state = None
        self._pairs = Pairs(self._take_point)
        self._begin_test()

    def _begin_test(self):
        self.parted = False
        self._shown = None  # the last state with the load that was read at its stamp
        self.curve = []  # extension and load at each reading of the load cell
        self.loads = []  # time and load at each of them
        self._zero = None  # balance offset of the curve
        self._sliding = []  # loads while the knots slid
        self.measured = []  # the same of the experiment, as its topics have it
        self.measured_pairs = Pairs(self.measured.append)
        self.measured_loads = []  # time and load

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
        if state.status == BROKEN:
            self._take_break(state)
        else:
            self._pairs.add(0, stamp, state)

    def take_status(self, status):
        """status: a TestStatus, or what has its fields."""
        self._status = status

    def take_load(self, stamp, load):
        self._pairs.add(1, stamp, load)

    def take_measured_load(self, stamp, load):
        self.measured_loads.append((stamp, load))
        self.measured_pairs.add(1, stamp, load)

    def over_time(self):
        """This test and a record without travel as loads over the time since each began to pull; None: it has travel, or there is none."""
        if self.measured or not self.measured_loads:
            return None
        return [[(time - loads[0][0], load) for time, load in loads] for loads in (self.loads, self.measured_loads)]

    def _take_break(self, state):
        """The largest load of the command in which the rod parts is that of the break; it has none behind that."""
        if not self.parted:
            self._take_point((state, state.highest_load))
            self.parted = True

    def _take_point(self, point):
        """Nothing that was read before the zero belongs to the curve: neither tying and mounting nor another zero."""
        state, load = point
        if self.parted or self.state is None or state.run != self.state.run:
            return
        self._shown = point
        if state.phase in PREPARATION:
            return
        if state.balance_offset != self._zero:
            self.curve, self.loads, self._sliding = [], [], []
        self._zero = state.balance_offset
        if state.motion_pattern == 'sliding' and not state.locked:
            self._sliding.append(load)
        self.curve.append((state.extension, load))
        self.loads.append((state.time, load))

    def small_load(self):
        """A load [N] up to which the loads are to be shown once more, because larger ones hide those of sliding; else
        None."""
        if not self._sliding:
            return None
        usual = statistics.median(self._sliding)
        largest = max(load for _, load in self.curve)
        return 2.5 * usual if 0.0 < MANY * usual < largest else None

    def colours_are_known(self):
        """What the colours of a rod show that has parted is not known, where it is a force."""
        return not self.parted or self.bar is None or self.bar.quantity != 'tension'

    def how_it_stands(self):
        """The state of the test in words."""
        state, status = self.state, self._status
        is_of_this = status is not None and status.run == state.run
        ended_by = status.ended_by if is_of_this and status.state == ENDED else None
        words = []
        if state.status == BROKEN:
            words.append(ENDS['break'])
        elif state.status == FAILED:
            words.append(ENDS['solver'])
        elif state.knot_type == CROSSED:
            words.append('ran through itself')
        elif state.motion_pattern == 'untangling':
            words.append('a knot opened' if state.knot_type == KEPT else ENDS['untangled'])
        if ended_by is not None:
            end = ENDS.get(ended_by, 'ended by ' + ended_by if ended_by else 'ended')
            words.append('ended' if end in words else end)
        return ', '.join(words) or ('paused' if is_of_this and status.state == PAUSED else 'running')

    def table(self):
        """Rows of name, value and unit. All values are of one time: of the last reading of the load cell, once there is one."""
        if self.state is None:
            return [('material', self.material or '–', ''), ('knot', self.knot or '–', '')]
        state, load = self._shown or (self.state, self.state.load)
        pattern = 'locked' if state.locked else state.motion_pattern
        return [
            ('time', shown('%.1f', state.time), 's'),
            ('material', self.material or '–', ''),
            ('knot', self.knot or '–', ''),
            ('state', self.how_it_stands(), ''),
            ('phase', state.phase or '–', ''),
            ('motion pattern', pattern or '–', ''),
            ('extension', millimetres(state.extension), 'mm'),
            ('load at the break' if self.parted else 'load', shown('%.0f' if abs(load) >= 1e4 else '%.4g', load), 'N'),
            ('knot distance', millimetres(state.knot_distance), 'mm'),
            ('end-to-end distance', millimetres(state.end_to_end), 'mm'),
        ]


def millimetres(metres):
    return shown('%.1f', 1e3 * metres)


def shown(form, value):
    """– where there is none, and no minus before a zero."""
    if math.isnan(value):
        return '–'
    text = form % value
    return text.lstrip('-') if float(text) == 0.0 else text
