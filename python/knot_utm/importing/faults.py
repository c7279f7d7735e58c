"""What no machine measured: single readings far off, a zero that was set within the record, and numbers that a spreadsheet spoilt."""
import math

from knot_utm.importing.text import GROUPED, number

WINDOW = 6         # readings on each side by which one is judged
FAR = 8.0          # times the usual speed or step there: beyond noise
FASTER = 5.0       # than both neighbours move: no turn of a cycle
IMPOSSIBLE = 20.0  # times as fast as all that is near it
SEEN = 0.005       # of all travel: what is less far off changes no reading
FELL = 0.1         # of all load: it breaks or slips
STRAY = 0.02       # of all load: another one than that which its neighbours lead to
MOVED = 0.1        # of all travel: a jump that is no slip of an extensometer
LIGHT = 0.2        # of the load that follows: it may have been zeroed
ROUGHER = 3.0      # than with its decimals where they were: the column is spoilt


def spikes(times, s, load):
    """Indices of single readings whose extension goes off and comes back as no crosshead does: farther than noise, and faster than its
    neighbours move. So a turn of a cycle is none. The last reading before a fall of the load is none either, nor one whose load goes
    off with it, unless all else in the record is much slower."""
    n, speed = len(s), _speeds(times, s)
    quantum = _quantum(s)
    found = set()
    for i in range(1, n - 1) if n > 4 else ():
        before, behind = s[i] - s[i - 1], s[i] - s[i + 1]
        if before * behind <= 0.0 or min(abs(before), abs(behind)) <= max(FAR * quantum, 2.0 * abs(before - behind)):
            continue
        low, high = max(i - WINDOW, 0), min(i + WINDOW, n - 1)
        middle = _median(s[low:high + 1])
        if (min(speed[i - 1], speed[i]) > FAR * _median(speed[low:i - 1] + speed[i + 1:high])
                and abs(s[i] - middle) > max(abs(s[i - 1] - middle), abs(s[i + 1] - middle))):
            found.add(i)
    if not found:
        return []
    kept = [i for i in range(n) if i not in found]
    at = {i: place for place, i in enumerate(kept)}
    calm = [s[i] for i in kept]
    between, noise = _speeds([times[i] for i in kept], calm), _median([abs(a - 2.0 * b + c) for a, b, c in zip(calm, calm[1:], calm[2:])])
    travel, loads = (max(column[i] for i in kept) - min(column[i] for i in kept) for column in (s, load))

    def is_spike(i):
        own, left, right = min(speed[i - 1], speed[i]), at.get(i - 1, 0), at.get(i + 1, 0)
        beside = between[max(left - 1, 0):left] + between[right:right + 1]
        if min(abs(s[i] - s[i - 1]), abs(s[i] - s[i + 1])) <= max(SEEN * travel, FASTER * noise) or own <= FASTER * max(beside, default=0.0):
            return False
        fall = load[i] - load[i + 1]
        if abs(fall) > FELL * loads and abs(load[i] - load[min(i + 2, n - 1)]) > 0.5 * abs(fall):
            return False
        usual = _median([abs(b - a) for a, b in zip(load[max(i - WINDOW, 0):i], load[max(i - WINDOW, 0) + 1:i])])
        stray = abs(load[i] - 0.5 * (load[i - 1] + load[i + 1]))
        return stray <= max(FAR * usual, STRAY * loads) or own > IMPOSSIBLE * max(between)

    return [i for i in sorted(found) if is_spike(i)]


def zero_set(times, s, load):
    """[(i, by how much the extension jumps, and the load)]: the zero of the crosshead was set between the readings i - 1 and i. That is a
    jump that no machine makes, alone in its neighbourhood, while time goes on and the load does, or is zeroed with it where it is
    light. Steps up and down, or of one size, are those of a test."""
    n, speed, found = len(s), _speeds(times, s), []
    usual = _median([b - a for a, b in zip(times, times[1:])])
    for i in range(3, n - 2):
        by, low = s[i] - s[i - 1], max(i - WINDOW, 0)
        near = speed[low:i - 1] + speed[i:i + WINDOW - 1]
        if speed[i - 1] <= IMPOSSIBLE * max(near) or abs(by) <= FAR * _quantum(s[low:i + WINDOW]):
            continue
        behind = [abs(b - a) for a, b in zip(s[i:i + WINDOW], s[i + 1:i + WINDOW])]
        step = [abs(b - a) for a, b in zip(load[low:i], load[low + 1:i])]
        at_zero = abs(s[i]) <= 2.0 * max(behind) + 0.001 * abs(by)
        travel = max(max(s[:i]) - min(s[:i]), max(s[i:]) - min(s[i:]))
        follows = max(map(abs, load[i:]))
        other = load[i] - load[i - 1]
        zeroed = abs(load[i]) <= 0.001 * follows and abs(other) > FASTER * max(step) and abs(other) <= LIGHT * follows
        if not (at_zero or (abs(by) > MOVED * travel and times[i] - times[i - 1] <= 3.0 * usual)):
            continue
        if zeroed or abs(other) <= max(FASTER * max(step), 0.5 * STRAY * follows):
            found.append((i, by - 0.5 * (s[i - 1] - s[i - 2] + s[i + 1] - s[i]), other if zeroed else 0.0))
    sizes = [abs(by) for _, by, _ in found]
    return [] if len(found) > 1 and min(sizes) > 0.5 * max(sizes) else found


def spoilt(cells, mark):
    """(place, number meant) of the first cell whose decimals a spreadsheet took for thousands: it read 1,0272 as 10272 and shows 10,272.
    None where the column is sound, or has none with other than three digits behind the mark that would tell."""
    digits = [len(cell.partition(mark)[2]) for cell in cells]
    whole = [cell.lstrip("+-")[:1] not in ("0", mark, "") for cell in cells]
    bare = [GROUPED[mark].fullmatch(cell) or (mark not in cell and whole[i] and len(cell.lstrip("+-")) > 3) for i, cell in enumerate(cells)]
    if not any(bare) or any(more > 3 and not bare[i] for i, more in enumerate(digits) if whole[i]) or {3} >= set(filter(None, digits)):
        return None
    read, meant = [], []
    for i, cell in enumerate(cells):
        value = number(cell, mark)
        if value is None and not bare[i]:
            return None
        plain = cell.replace(mark, "")
        may = [number(plain[:k] + "." + plain[k:], ".") for k in range(len(plain), 0, -1)] if bare[i] else []
        may = [value, *(other for other in may if other is not None and abs(other) >= 1.0)] if value is not None else may
        near = meant[-1] if meant else may[0] if bare[i] else value
        meant.append(min(may, key=lambda other: abs(other - near)) if bare[i] else value)
        read.append(math.inf if value is None else value)
    rough, smooth = (sum(abs(b - a) for a, b in zip(column, column[1:])) for column in (read, meant))
    return next(((i, meant[i]) for i, value in enumerate(read) if not 0.5 < abs(value / meant[i] if meant[i] else 1.0) < 2.0), None) \
        if rough > ROUGHER * smooth else None


def _speeds(times, values):
    """Between one value and the next, per second, or per reading where there are no times. Readings of one time are a little apart."""
    apart = [b - a if b > a else 0.0 for a, b in zip(times, times[1:])]
    least = 0.1 * _median(list(filter(None, apart))) or 1.0
    return [abs(b - a) / max(passed, least) for a, b, passed in zip(values, values[1:], apart)]


def _quantum(values):
    return min((abs(b - a) for a, b in zip(values, values[1:]) if a != b), default=0.0)


def _median(values):
    return sorted(values)[len(values) // 2] if values else 0.0
