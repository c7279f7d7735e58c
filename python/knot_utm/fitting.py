"""The parts of a fit: what was measured, how far off it may be, what runs say of it, and the search, whose least squares are lmfit's.

A fit compares the means of the load over equal parts of the extension. The covariance of their difference, but for scatter, is

    C = diag(noise^2/n + resolution^2/12 + rounding^2) + c c^T + d d^T     c = accuracy F/sqrt(3), d = F error/2

Noise is of each of the n readings of a mean F. c is the systematic error of the cell, a bound, with its floor, and the same in all
records; d is the numerical error of the plateau in result.yaml, which is meant to hold 19 of 20 readings.

The search goes in waves: runs over a box of the free keys, polynomials through their means, the best place on them by lmfit, and
 a smaller box, of the places that may still be the best (history matching: Craig and others 1997). What the polynomials miss is
scatter S, from specimen to specimen and of stick-slip. The residuals are those of A = C + (1 + h) S, where h S is what is not known of the
polynomials: a place where nothing was run is not believed to be unlikely. An interval of 95 % is where their sum of squares has risen by
3.84 with all other keys at their best. Reference: Myers, Montgomery and Anderson-Cook, Response Surface Methodology (2016), chapters 2, 3 and 6."""
import itertools
from collections import defaultdict

import lmfit
import numpy as np
import pandas as pd
from scipy import linalg
from scipy.stats import chi2, qmc

from knot_utm.errors import refuse_if, WrongInput
from knot_utm.runs import PULLS
from knot_utm.yaml_text import is_number, value_at

SAME_ZERO = 1e-9  # [m]
AT_ONCE = 0.03    # of the extension, within which a rod that parts lets go of its load
MOST_BINS = 12    # so many that some dozens of runs tell how they scatter together
FAR = 300.0       # loads or extensions so many times as large as the method's are in other units
WHOLE = 0.9       # of the measured extension, which a run must reach to be compared
BROKEN = 0.02     # the same of one whose rod parted: beyond it the curve goes on with its slope
ROUNDING, ROUNDING_OF_LARGEST = 1e-4, 1e-6  # of a load, of the largest load: of curves straight from point to point
RISE = chi2.ppf(0.95, 1)
MOST_WAVES, CANDIDATES, SHRUNK = 12, 2048, 0.8  # a side of the box that shrinks by less has settled
KEPT, LEAST_KEPT, LEARNT_OF = 16.0, 48, 64.0    # rise within which candidates are kept for the next wave, and how many; of runs learnt of
GROWN, LOOK = 0.05, 0.25  # of the box: by which it is larger than what is kept; beyond which nothing is looked for
HIGHEST_ORDER, LEARNT = 4, 0.1  # of a surface; its errors over all, at the best place, which are small enough
POINTS, NEAR = 41, 0.15  # of a profile; of the range of the runs: how far a run tells of what kind others are
ALIKE = np.log(2.0)  # of the ratio of loads within which runs are of the record's kind


class Pull:
    """Rows that reach a new largest extension of the crosshead, up to the break."""

    def __init__(self, extension, load):
        """Both in order of time; [m], [N]."""
        rows = np.flatnonzero(extension > np.maximum.accumulate(np.concatenate([[-np.inf], extension]))[:-1])
        s, force = extension[rows], load[rows]
        peak = int(np.argmax(force)) if len(rows) else 0
        if len(rows) and s[-1] - s[peak] < AT_ONCE * (s[-1] - s[0]) and force[-1] < 0.5 * force[peak]:
            s, force = s[:peak + 1], force[:peak + 1]
        self.extension, self.load = s, force

    def at(self, extension):
        """Load there, straight from point to point; beyond the last one with the slope of the last tenth."""
        s = self.extension
        last = s >= s[-1] - 0.1 * (s[-1] - s[0])
        slope = np.polyfit(s[last], self.load[last], 1)[0] if last.sum() > 1 else 0.0
        return np.interp(extension, s, self.load) + np.maximum(extension - s[-1], 0.0) * slope


def pull_of_table(table):
    """The pull of a curve.csv or curve_full.csv, with the row before the first pull as origin: a balance makes it zero. None where nothing is
    pulled."""
    rows = np.flatnonzero(table["phase"].isin(PULLS)) if "phase" in table else np.arange(len(table))
    if len(rows) < 2:
        return None
    taken = table.iloc[rows if rows[0] == 0 else [rows[0] - 1, *rows]]
    extension, load = (taken[name].to_numpy(float, copy=True)
                       for name in ("crosshead_travel" if "crosshead_travel" in table else "extension", "load"))
    if rows[0] > 0 and "end_to_end" in table:
        zeros = (taken["end_to_end"] - taken["extension"]).to_numpy(float)
        if abs(zeros[1] - zeros[0]) > SAME_ZERO:
            extension[0] = load[0] = 0.0
    finite = np.isfinite(extension) & np.isfinite(load)
    pull = Pull(extension[finite], load[finite])
    return pull if len(pull.extension) > 1 else None


def read_pull(file):
    """The pull of a curve.csv, as tensile_test or import_instron wrote it. Raises WrongInput."""
    try:
        table = pd.read_csv(file, skiprows=[1])
        pull = pull_of_table(table.astype({name: float for name in table if name != "phase"}))
    except OSError as error:
        raise WrongInput(f"{file}: {error.strerror.lower()}") from error
    except KeyError as error:
        raise WrongInput(f"{file}: it has no column {error.args[0]}, but must be a curve.csv, which import_instron makes of raw data") from error
    except ValueError as error:
        raise WrongInput(f"{file}: {' '.join(str(error).split())}, but it must be a curve.csv, which import_instron makes of raw data") from error
    refuse_if(pull is None, f"{file}: nothing is pulled in it, or it has fewer than two readings of a pull")
    return pull


class Record:
    """One measured curve, and the method that is to produce it."""

    def __init__(self, name, pull, settings, method):
        """`settings`: over the method; `method`: with every value."""
        self.name, self.settings, self.method = name, settings, method
        self.cell = _numbers(method["machine"]["load_cell"])
        scatter = method.get("specimens", {}).get("scatter")
        self.scatter = scatter if isinstance(scatter, dict) else {}
        self.extension, self.load = s, load = pull.extension, pull.load
        self.largest = {"extension": float(s[-1]), "force": float(np.max(np.abs(load)))}
        # Readings in equal parts of the extension; parts without readings are left out.
        count = min(MOST_BINS, len(s))
        part = np.minimum((count * (s - s[0]) / (s[-1] - s[0])).astype(int), count - 1)
        self.parts = np.unique(part, return_inverse=True)[1]
        self.counts = np.bincount(self.parts)
        self.centres, self.measured = self.means(s), self.means(load)

    def means(self, readings):
        """The means of values at the readings, part by part."""
        return np.bincount(self.parts, readings) / self.counts

    def simulated(self, pull, result, offsets):
        """The means of a run, as they would have been recorded; not a number where it leaves no whole curve."""
        if not self.is_reached(pull, result):
            return np.full(len(self.centres), np.nan)
        return self.means(pull.at(self.extension - offsets.get("extension", 0.0))) + offsets.get("force", 0.0)

    def run_settings(self, free, number):
        """The settings of a run with values of the free keys: one more specimen, which is drawn as tensile_test draws them."""
        settings, random = {**self.settings, **free}, np.random.default_rng(number)
        for key, law in self.scatter.items():
            (name, spread), = law.items()
            z = spread * (random.uniform(-1.0, 1.0) if name == "uniform" else np.clip(random.standard_normal(), -3.0, 3.0))
            settings[key] = float((np.exp(z) if name == "log_normal" else 1.0 + z) * settings.get(key, value_at(self.method, key)))
        return settings

    def is_reached(self, pull, result):
        """Whether a run says something of nearly all of the curve."""
        share = BROKEN if result.get("ended_by") == "break" else WHOLE
        return pull is not None and pull.extension[-1] >= share * self.largest["extension"]

    def require_producible(self, pull, result):
        """Raises WrongInput where nothing is known of the errors of the readings, or the method, as it stands, pulls otherwise."""
        refuse_if(pull is None, f"{self.name}: the method as it stands leaves no curve: {result.get('reason') or 'its run failed'}")
        measured, made = (float(max(load, key=abs)) for load in (self.load, pull.load))
        end = float(pull.extension[-1])
        for one, other, unit in ((self.largest["extension"], end, "m"), (measured, made, "N")):
            refuse_if(not 1.0 / FAR < one / (other or np.inf) < FAR,
                      f"{self.name}: the measured curve goes to {one:.4g} {unit}, and the method's to {other:.4g} {unit}: one of "
                      "them is in other units, has another sign, or is of another test")
        refuse_if(not self.is_reached(pull, result),
                  f"{self.name}: the measured curve goes to an extension of {self.extension[-1]:.4g} m, but the method's pull "
                  f"ends at {end:.4g} m ({result.get('ended_by')}): let it go on, as by --set program.pull.until.extension")
        refuse_if(not self.scatter and not any(self.cell[key] for key in ("noise", "resolution", "accuracy", "floor")),
                  f"{self.name}: nothing says how far a reading may be off: the load cell of the method has no errors; give its "
                  "class, as by --set machine.load_cell.accuracy=0.005, or resolution or noise")

    def errors(self, means, result):
        """(variances of single means, c, d) for simulated means, of the run that left `result`."""
        of, cell = _numbers(result), self.cell
        rounding = ROUNDING * np.abs(means) + ROUNDING_OF_LARGEST * np.max(np.abs(means)) + 1e-150
        floor = cell["floor"] * cell["capacity"]
        systematic = np.where(np.abs(means + of["balance_offset"]) < floor, floor, cell["accuracy"] * means) / np.sqrt(3.0)
        numerical = 0.5 * of["plateau_force_error"] / (of["plateau_force"] or np.inf) * means
        return cell["noise"]**2 / self.counts + cell["resolution"]**2 / 12.0 + rounding**2, systematic, numerical


def covariance(records, means, results):
    """C [N^2]. `means`: simulated ones of all records, one after another; `results`: of the runs that left them."""
    single, systematic, numerical = zip(*(record.errors(part, result) for record, part, result
                                          in zip(records, split(records, means), results)))
    shared = np.concatenate(systematic)
    return np.diag(np.concatenate(single)) + np.outer(shared, shared) + linalg.block_diag(*(np.outer(mode, mode) for mode in numerical))


def split(records, means):
    """Values of all means, record by record; they are the last axis."""
    return np.split(means, np.cumsum([len(record.centres) for record in records])[:-1], axis=-1)


class Surface:
    """A polynomial through the means of runs, one run a row, at places; its order is the one that best predicts runs left out one at a time."""

    def __init__(self, places, means, scale):
        self.low, self.width = places.min(axis=0), np.maximum(np.ptp(places, axis=0), 1e-12)
        self.order = min(range(1, HIGHEST_ORDER + 1), key=lambda order: self._missed(order, places, means / scale))
        terms = self._terms(places, self.order)
        q, self.root = np.linalg.qr(terms)
        self.weights = linalg.solve_triangular(self.root, q.T @ means)
        self.left, self.freedom = means - terms @ self.weights, len(terms) - terms.shape[1]

    def at(self, places):
        """(means, h), one place a row."""
        terms = self._terms(places, self.order)
        return terms @ self.weights, (linalg.solve_triangular(self.root, terms.T, trans="T")**2).sum(axis=0)

    def _missed(self, order, places, means):
        terms = self._terms(places, order)
        if order > 1 and len(terms) < 2 * terms.shape[1]:
            return np.inf
        q, _ = np.linalg.qr(terms)
        return np.mean(((means - q @ (q.T @ means)) / np.maximum(1.0 - (q**2).sum(axis=1), 1e-6)[:, None])**2)

    def _terms(self, places, order):
        u = 2.0 * (places - self.low) / self.width - 1.0
        powers = [keys for n in range(order + 1) for keys in itertools.combinations_with_replacement(range(u.shape[1]), n)]
        return np.stack([np.prod(u[:, list(keys)], axis=1) for keys in powers], axis=1)


def scatter_of(rows, freedom):
    """S, of residuals, one a row. Their correlation is that of the sample, drawn towards none by oracle approximating shrinkage (Chen,
    Wiesel, Eldar and Hero 2010), and the variance has the factor of Student's t: a few runs tell little."""
    size, sd = rows.shape[1], np.sqrt((rows**2).sum(axis=0) / freedom)
    scaled = rows / np.where(sd > 0, sd, 1.0)
    sample = scaled.T @ scaled / freedom
    square, trace = np.sum(sample**2), np.trace(sample)
    apart = (freedom + 1.0 - 2.0 / size) * (square - trace**2 / size)
    shrinkage = min(1.0, ((1.0 - 2.0 / size) * square + trace**2) / apart) if apart > 0 else 1.0
    correlation = (1.0 - shrinkage) * sample + shrinkage * np.diag(np.diag(sample))
    return freedom / max(freedom - 2.0, 1.0) * np.outer(sd, sd) * correlation


class Search:
    """The search for the best places, which go from 0 to 1 in the range of each key. `run(places, first)`: of each record [(pull, result)] of runs
    there, of specimens counted from `first`."""

    def __init__(self, records, keys, run):
        self.records, self.keys, self.run = records, keys, run
        self.measured = np.concatenate([record.measured for record in records])
        self.low, self.high = np.zeros(len(keys)), np.ones(len(keys))
        self.best, self.value, self.surface, self.misfit = np.full(len(keys), 0.5), 0.0, None, 1.0
        self.places, self.means, self.results = np.zeros((0, len(keys))), np.zeros((0, len(self.measured))), []

    def go(self):
        count = len(self.keys)
        self.add(_sobol(count, 8 * count + 2, 1))
        self.learn(0)
        for wave in range(1, MOST_WAVES + 1):
            has_settled = self.wave(wave, 4 * count + 2)
            # Where specimens do not differ, all that the polynomials miss is their own error.
            h = self.surface.at(self.best[None])[1] + all(not record.scatter for record in self.records)
            if has_settled and np.sum(h * self.sizes / (1.0 + self.sizes)) <= LEARNT * len(self.measured):
                break
        self.profiles = [self.profile(key) for key in range(count)]
        return self

    def wave(self, number, more):
        """More runs, in a new box; whether it is neither smaller than the last one nor cut off where nothing was looked for."""
        around, tried = self._around(), self._candidates(100 + number)
        rises = self.squares(tried) - self.value
        kept = np.concatenate([self.best[None], tried[rises <= max(KEPT * self.misfit, np.sort(rises)[LEAST_KEPT - 1])]])
        width = GROWN * np.maximum(np.ptp(kept, axis=0), 1e-6)
        low, high = np.maximum(kept.min(axis=0) - width, around[0]), np.minimum(kept.max(axis=0) + width, around[1])
        is_cut = (low == around[0]) & (low > 0.0) | (high == around[1]) & (high < 1.0)
        has_settled = np.all(high - low >= SHRUNK * (self.high - self.low)) and not np.any(is_cut)
        self.low, self.high = low, high
        # The best one, the last ones on each side, which are beyond the ends of the intervals, and others that lie evenly.
        chosen = dict.fromkeys([0, *kept.argmin(axis=0), *kept.argmax(axis=0), *range(1, len(kept))])
        self.add(kept[list(chosen)[:more]])
        self.learn(number)
        return has_settled

    def _around(self):
        """The box, and what is beside it, as far as the range goes: what an earlier wave gave up may come back."""
        beside = LOOK * (self.high - self.low)
        return np.maximum(self.low - beside, 0.0), np.minimum(self.high + beside, 1.0)

    def _candidates(self, seed):
        low, high = self._around()
        return low + (high - low) * _sobol(len(self.keys), CANDIDATES, seed)

    def add(self, places):
        """Runs there. A run that leaves no whole curve has no means."""
        for place, made in zip(places, zip(*self.run(places, len(self.places)))):
            offsets = [{key.offset[1]: key.value(at) for key, at in zip(self.keys, place) if key.offset and key.offset[0] == number}
                       for number in range(1, len(self.records) + 1)]
            means = [record.simulated(*one, off) for record, one, off in zip(self.records, made, offsets)]
            self.means = np.vstack([self.means, np.concatenate(means)])
            self.results.append([result for _, result in made])
        self.places = np.vstack([self.places, places])

    def learn(self, seed):
        """Surface and scatter, of the runs that are not far from the record, and the best place."""
        self.is_lost = np.isnan(self.means).any(axis=1)
        least = 3 * (len(self.keys) + 1)
        refuse_if((~self.is_lost).sum() < least,
                  f"{self.records[0].name}: {(~self.is_lost).sum()} of {len(self.places)} runs in the ranges of the free keys "
                  "reach as far as the record: narrow the ranges")
        # Runs with loads of another size, as where knots open, tell nothing of the others, unless these are too few.
        error = np.concatenate([np.sqrt(record.errors(record.measured, {})[0]) for record in self.records])
        ratio = np.log((np.abs(self.means) + error) / (np.abs(self.measured) + error))
        size = np.max([np.abs(part.mean(axis=1)) for part in split(self.records, ratio)], axis=0)
        self.is_right = right = ~self.is_lost & (size <= max(ALIKE, np.sort(size[~self.is_lost])[least - 1]))
        self.is_unlike = ~self.is_lost & ~right & np.all((self.places >= self.low) & (self.places <= self.high), axis=1)
        away = np.zeros(len(self.places))
        if self.surface:
            own = ((self.measured - self.means) @ self.vectors)**2 / (1.0 + self.sizes)
            away = np.fmin(self.squares(self.places) - self.value, own.sum(axis=1))
        used = np.flatnonzero(right & (away <= max(LEARNT_OF * self.misfit, np.sort(away[right])[:least][-1])))
        for _ in range(2):  # the errors are those at the best place, which is known afterwards
            nearest = used[np.argmin(np.sum((self.places[used] - self.best)**2, axis=1))]
            known = covariance(self.records, self.means[nearest], self.results[nearest])
            self.surface = Surface(self.places[used], self.means[used], np.sqrt(np.diag(known)))
            scatter = linalg.block_diag(*(scatter_of(rows, self.surface.freedom) for rows in split(self.records, self.surface.left)))
            sizes, self.vectors = linalg.eigh(scatter, known)
            self.sizes, self.errors = np.maximum(sizes, 0.0), np.sqrt(np.diag(known + scatter))
            tried = self._candidates(seed)
            starts = tried[np.argsort(self.squares(tried), kind="stable")[:3]]
            self.solved = min((self.solve(start) for start in starts), key=lambda solved: solved.chisqr)
            self.best, self.value = place_of(self.solved), self.solved.chisqr
        # Where nothing fits as yet, a rise cannot be relied on.
        self.chi_square = float((self.residuals(self.best[None])[0, :len(self.measured)]**2).sum())
        self.misfit = max(1.0, self.chi_square / len(self.measured))

    def residuals(self, places):
        """One place a row: those of the means, and the roots of the two other terms of -2 log L, which are log det A - log det C and
        -2 log q; q is the share of the runs around a place whose loads are of the record's size."""
        means, h = self.surface.at(places)
        spread = 1.0 + (1.0 + h)[:, None] * self.sizes
        weight = np.exp(-0.5 * (((places[:, None] - self.places) / (NEAR * self.surface.width))**2).sum(axis=2))
        share = (1.0 + weight @ self.is_right) / (1.0 + weight.sum(axis=1))
        return np.hstack([((self.measured - means) @ self.vectors) / np.sqrt(spread), np.sqrt(np.log(spread)),
                          np.sqrt(-2.0 * np.log(np.minimum(share, 1.0)))[:, None]])

    def squares(self, places):
        return (self.residuals(places)**2).sum(axis=1)

    def solve(self, start, fixed=None):
        """lmfit's result from a start; `fixed`: a key that keeps its place."""
        params, (low, high) = lmfit.Parameters(), self._around()
        for i, at in enumerate(start):
            params.add(f"key_{i}", value=at, min=low[i], max=high[i], vary=i != fixed)
        return lmfit.minimize(lambda now: self.residuals(place_of(now)[None])[0], params, method="least_squares",
                              scale_covar=False, calc_covar=fixed is None)

    def profile(self, key):
        """(places, rises, ends): along a key, how much the squares rise with the other keys at their best, and where they pass RISE on
        each side; None where they do not."""
        low, high = self._around()
        at = np.unique(np.append(np.linspace(low[key], high[key], POINTS), self.best[key]))
        mine, rises, ends = int(np.searchsorted(at, self.best[key])), np.zeros(len(at)), []
        for way in (-1, 1):
            place = self.best.copy()
            for i in range(mine + way, len(at) if way > 0 else -1, way):
                place[key] = at[i]
                if len(place) > 1:
                    place = place_of(self.solve(place, key))
                rises[i] = max(self.squares(place[None])[0] - self.value, 0.0)
            along, roots = at[mine::way], np.sqrt(rises[mine::way])  # straight from point to point, as the root of a parabola is
            over = np.flatnonzero(roots**2 > RISE)[:1]
            ends.append(float(np.interp(np.sqrt(RISE), roots[over[0] - 1:over[0] + 1], along[over[0] - 1:over[0] + 1])) if len(over) else None)
        return at, rises, ends


def _sobol(keys, count, seed):
    """Places from 0 to 1 that lie evenly, one a row."""
    return qmc.Sobol(keys, seed=seed).random(1 << (count - 1).bit_length())[:count]  # only a power of two is even in every key


def place_of(solved):
    """The place that lmfit's parameters or its result have."""
    return np.array(list(getattr(solved, "params", solved).valuesdict().values()))


def _numbers(result):
    return defaultdict(float, {key: value for key, value in result.items() if is_number(value)})
