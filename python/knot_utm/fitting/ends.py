"""The ends of the intervals, each looked at by runs beyond it.

An emulator is smooth, and a model may jump. So, where -2 log L has clearly risen, some specimens are run as they are. Where the mean
of those fits the record, the end is doubted, and the search goes on with these runs. The rise that they tell is

    chi^2 of their mean - chi^2 of the best place - 2 log(share of those of the record's kind),

with what their mean does not tell of the scatter, S/n, as one more error. An open end needs no runs: nothing beyond it is told to be
wrong."""
from dataclasses import dataclass

import numpy as np

from knot_utm.fitting import profiles
from knot_utm.fitting.likelihood import Likelihood
from knot_utm.fitting.profiles import RISE

CHECKS = 3             # after which the search goes on where an end is doubted; one more has the last word
SPECIMENS = 4          # beyond each end; one, where they do not scatter
CLEARLY = 2.0 * RISE   # rise of -2 log L that is clearly beyond the end


@dataclass(frozen=True)
class Ends:
    """`profiles`: of all keys; `unconfirmed`: {(key, side): place}, of the ends that runs do not confirm: a place beyond the end
    where runs fit, or None where the end is no longer within the runs that were to confirm it."""

    profiles: list
    unconfirmed: dict


def checked(search, wave):
    """The Ends of a search that has settled."""
    for check in range(CHECKS + 1):
        found = _profiles(search)
        looked = _beyond(found)
        if not looked:
            return Ends(found, {})
        doubted = doubtful(search, looked)
        search.learn(wave + check)
        if not doubted:
            break
        if check < CHECKS:
            search.wave(wave + check)
    found = _profiles(search)
    return Ends(found, unconfirmed(found, looked, doubted))


def unconfirmed(found, looked, doubted):
    """Of Ends, after a last look. `found`: the profiles, which the runs of that look have moved; `looked`: {(key, side): place}."""
    left = {}
    for end in {**looked, **_beyond(found)}:
        key, side = end
        at, place = found[key].end(side), looked.get(end)
        is_within = at is not None and place is not None and side * (place[key] - at) >= 0.0
        if at is not None and (end in doubted or not is_within):
            left[end] = place[key] if is_within else None
    return left


def _profiles(search):
    low, high = search.around()
    return [profiles.profile(search.likelihood, key, low, high, search.best, search.value, 50 + key)
            for key in range(len(search.keys))]


def _beyond(found):
    """{(key, side): the nearest place on the profile of a key that is clearly beyond its end}. An open end, which the record does
    not tell, has none, nor has one behind which the range ends at once."""
    places = {}
    for key, one in enumerate(found):
        for side in (-1, 1):
            at, rises = one.outwards(side)
            clear = np.flatnonzero(rises >= CLEARLY)
            if len(clear):
                places[key, side] = at[clear[0]]
            elif one.end(side) is not None and at[-1][key] not in (0.0, 1.0):
                places[key, side] = at[-1]
    return places


def doubtful(search, beyond):
    """Those of {(key, side): place} beyond whose ends runs fit."""
    specimens = SPECIMENS if any(case.batch for case in search.cases) else 1
    first = search.count
    search.add(np.repeat(list(beyond.values()), specimens, axis=0))
    least = search.likelihood.chi_square(search.best)
    doubted = []
    for number, (end, place) in enumerate(beyond.items()):
        tried = range(first + number * specimens, first + (number + 1) * specimens)
        seen = [case.seen(tried, search.low, search.high) for case in search.cases]
        if None in seen:
            continue
        likelihoods, shares = zip(*seen)
        rise = Likelihood(likelihoods).chi_square(place) - least - 2.0 * np.log(shares).sum()
        if rise < RISE:
            doubted.append(end)
    return doubted
