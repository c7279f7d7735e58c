"""What no machine measured: single readings far off, a zero that was set within the record, and numbers that a spreadsheet spoilt."""
from statistics import median

from knot_utm.importing.text import GROUPED, number

WINDOW = 6         # readings on each side by which one is judged
FAR = 8.0          # times the usual speed or step there: beyond noise
FASTER = 5.0       # than both neighbours move: no turn of a cycle
IMPOSSIBLE = 20.0  # times as fast as all that is near it
SEEN = 0.005       # of all travel: what is less far off changes no reading
JUMP = 0.1         # of all travel: no slip of an extensometer
FALL = 0.1         # of all load: it breaks or slips
STRAY = 0.02       # of all load: another one than that which its neighbours lead to
LIGHT = 0.2        # of the load that follows: it may have been zeroed
ROUGHER = 3.0      # than with its decimals where they were: the column is spoilt


def spikes(times, s, load):
    """Indices of single readings whose extension goes off and comes back as no crosshead does: farther than noise, and faster than its
    neighbours move. So a turn of a cycle is none. The last reading before a fall of the load is none either, nor one whose load goes
    off with it, unless all else in the record is much slower, or its neighbours on their steady way."""
    n, speed, found = len(s), _speeds(times, s), set()
    for i in range(1, n - 1) if n > 4 else ():
        before, behind = s[i] - s[i - 1], s[i] - s[i + 1]
        if before * behind > 0.0 and min(abs(before), abs(behind)) > 2.0 * abs(before - behind):
            low, high = max(i - WINDOW, 0), min(i + WINDOW, n - 1)
            middle = median(s[low:high + 1])
            if (min(speed[i - 1], speed[i]) > FAR * median(speed[low:i - 1] + speed[i + 1:high])
                    and abs(s[i] - middle) > max(abs(s[i - 1] - middle), abs(s[i + 1] - middle))):
                found.add(i)
    kept = [i for i in range(n) if i not in found]
    at = {i: place for place, i in enumerate(kept)}
    calm, loads = [s[i] for i in kept], [load[i] for i in kept]
    between = _speeds([times[i] for i in kept], calm)
    noise = median([abs(a - 2.0 * b + c) for a, b, c in zip(calm, calm[1:], calm[2:])] or [0.0])
    quantum = min(filter(None, _steps(s)), default=0.0)
    far, all_load = max(SEEN * (max(calm) - min(calm)), FASTER * noise, FAR * quantum), max(loads) - min(loads)

    def is_spike(i):
        own, left, right = min(speed[i - 1], speed[i]), at.get(i - 1, 0), at.get(i + 1, 0)
        beside = between[max(left - 1, 0):left] + between[right:right + 1]
        if min(abs(s[i] - s[i - 1]), abs(s[i] - s[i + 1])) <= far or own <= FASTER * max(beside, default=0.0):
            return False
        fall = abs(load[i]) - abs(load[i + 1])
        if fall > FALL * all_load and abs(load[i] - load[min(i + 2, n - 1)]) > 0.5 * fall:
            return False
        near = load[i - 1], load[i + 1]
        stray = max(load[i] - max(near), min(near) - load[i])
        usual = median(_steps(load[max(i - WINDOW, 0):i]) or [0.0])
        moves = [b - a for a, b in zip(calm[max(left - 1, 0):right + 2], calm[max(left, 1):right + 2])]
        is_steady = min(moves) > 0.0 or max(moves) < 0.0
        return stray <= max(FAR * usual, STRAY * all_load) or own > IMPOSSIBLE * max(beside if is_steady else between)

    return [i for i in sorted(found) if is_spike(i)]


def zero_set(times, s, load):
    """[(i, by how much the extension jumps, and the load)]: the zero of the crosshead was set between the readings i - 1 and i. That is a
    jump that no machine makes, while time goes on and the load does, or is zeroed with it where it is light. Jumps of like sizes are
    steps of a test."""
    n, speed, found = len(s), _speeds(times, s), []
    usual, travel = median([b - a for a, b in zip(times, times[1:])] or [0.0]), max(s) - min(s)
    for i in range(3, n - 2):
        by, other, low = s[i] - s[i - 1], load[i] - load[i - 1], max(i - WINDOW, 0)
        if speed[i - 1] <= IMPOSSIBLE * max(speed[low:i - 1] + speed[i:i + WINDOW - 1]) or abs(by) <= SEEN * travel:
            continue
        follows, step = max(map(abs, load[i + 1:])), FASTER * median(_steps(load[low:i]))
        is_zero = abs(s[i]) <= 2.0 * max(_steps(s[i:i + WINDOW])) + 0.001 * abs(by)
        zeroed = abs(load[i]) <= 0.001 * follows and step < abs(other) <= LIGHT * follows
        if ((is_zero or abs(by) > JUMP * travel and times[i] - times[i - 1] <= 3.0 * usual)
                and (zeroed or abs(other) <= max(step, 0.5 * STRAY * follows))):
            found.append((i, by - 0.5 * (s[i - 1] - s[i - 2] + s[i + 1] - s[i]), other if zeroed else 0.0))
    sizes = [abs(by) for _, by, _ in found]
    return [] if len(found) > 1 and min(sizes) > 0.5 * max(sizes) else found


def spoilt(cells, mark):
    """(place, number meant) of the first cell of a column whose decimals a spreadsheet took for thousands: it read 1,0272 as 10272, and
    shows 10,272. None of a sound column, and of one with three digits behind every mark, which does not tell. It shows where digits
    behind a 0 are more than three and all other cells have lost theirs, or where the column is smoother with its decimals back."""
    digits = [len(cell.partition(mark)[2]) for cell in cells]
    bare = [bool(GROUPED[mark].fullmatch(cell)) or (cell.isdigit() and len(cell) > 3 and cell[0] != "0") for cell in cells]
    plain = [int(cell.replace(mark, "")) if own else 0 for cell, own in zip(cells, bare)]
    read = [a / 1e3 if own and mark in cell else number(cell, mark) for cell, own, a in zip(cells, bare, plain)]
    whole = [value is not None and abs(value) >= 1.0 for value in read]
    if None in read or not any(bare) or {0, 3} >= {*digits} or any(n > 3 and b > a for n, a, b in zip(digits, bare, whole)):
        return None
    meant = []
    for value, lost in zip(read, plain):
        may = [lost / 10.0**k for k in range(len(str(abs(lost))))] if lost else []
        meant.append(min([value, *may], key=lambda other: abs(other - (meant[-1] if meant else value))))
    least = 10 ** max((n for n, big in zip(digits, whole) if not big), default=0)
    lost = least > 1000 and all(abs(value) >= least for value, big in zip(plain, whole) if big)
    rough, smooth = (sum(_steps(column)) / (max(column) - min(column) or 1.0) for column in (read, meant))
    if not lost and rough <= ROUGHER * smooth:
        return None
    return next(((i, b) for i, (a, b) in enumerate(zip(read, meant)) if not 0.5 * abs(b) < abs(a) < 2.0 * abs(b) and a != b), None)


def _speeds(times, values):
    """Between one value and the next, per second, or per reading where there are no times. Readings of one time are a little apart."""
    apart = [b - a if b > a else 0.0 for a, b in zip(times, times[1:])]
    least = 0.1 * median(list(filter(None, apart)) or [10.0])
    return [step / max(passed, least) for step, passed in zip(_steps(values), apart)]


def _steps(values):
    return [abs(b - a) for a, b in zip(values, values[1:])]
