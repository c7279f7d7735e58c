"""The ends of the intervals, each looked at by runs beyond it.

An emulator is smooth, and a model may jump. So, where -2 log L has clearly risen, some specimens are run as they are. Where the mean
of those fits the record, the end is doubted, and the search goes on with these runs. The rise that they tell is

    chi^2 of their mean - chi^2 of the best place - 2 log(share of those of the record's kind),

with what their mean does not tell of the scatter, S/n, as one more error."""
import numpy as np

from knot_utm.fitting import profiles
from knot_utm.fitting.likelihood import Likelihood
from knot_utm.fitting.profiles import RISE

CHECKS = 3
SPECIMENS = 4          # beyond each end; one, where they do not scatter
CLEARLY = 2.0 * RISE   # rise of -2 log L that is clearly beyond the end


def checked(search, wave):
    """([Profile] of all keys, [(key, place)] beyond ends that are doubted still)."""
    for check in range(CHECKS):
        found = _profiles(search)
        beyond = [(key, place) for key, one in enumerate(found) for side in (-1, 1)
                  for place in [_beyond(one, side, key, search)] if place is not None]
        if not beyond:
            return found, []
        doubted = doubtful(search, beyond)
        search.learn(wave + check)
        if not doubted:
            break
        search.wave(wave + check)
    return _profiles(search), doubted


def _profiles(search):
    low, high = search.around()
    return [profiles.profile(search.likelihood, key, low, high, search.best, search.value, 50 + key)
            for key in range(len(search.keys))]


def _beyond(profile, side, key, search):
    """The nearest place on a profile that is clearly beyond its end; None where the range ends before."""
    places, rises = profile.outwards(side)
    clear = np.flatnonzero(rises >= CLEARLY)
    if len(clear):
        return places[clear[0]]
    return None if places[-1][key] in (0.0, 1.0) else places[-1]


def doubtful(search, beyond):
    """Those of the places beyond ends, [(key, place)], where runs fit."""
    specimens = SPECIMENS if any(case.batch for case in search.cases) else 1
    first = search.count
    search.add(np.repeat([place for _, place in beyond], specimens, axis=0))
    least = search.likelihood.chi_square(search.best)
    doubted = []
    for number, (key, place) in enumerate(beyond):
        tried = range(first + number * specimens, first + (number + 1) * specimens)
        seen = [case.seen(tried, search.low, search.high) for case in search.cases]
        if None in seen:
            continue
        likelihoods, shares = zip(*seen)
        rise = Likelihood(likelihoods).chi_square(place) - least - 2.0 * np.log(shares).sum()
        if rise < RISE:
            doubted.append((key, place))
    return doubted
