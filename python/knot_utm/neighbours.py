"""What a table says of points between its runs: by those that are nearest."""
import numpy as np
from scipy import spatial

from knot_utm import axes, trends

NEAREST = 15


class Neighbours:
    """Runs as points in a unit cube: each key from its smallest to its largest value, as its axis counts."""

    def __init__(self, table, keys, outcomes):
        self.keys = keys
        self.scales = [np.log if axes.spans_far(table[key]) else np.asarray for key in keys]
        columns = [scale(table[key].to_numpy(float)) for scale, key in zip(self.scales, keys)]
        self.low = np.array([column.min() for column in columns])
        self.width = np.array([np.ptp(column) for column in columns])
        self.names = sorted(set(outcomes))
        self.outcomes = np.array([self.names.index(outcome) for outcome in outcomes])
        self.tree = spatial.cKDTree((np.stack(columns, axis=1) - self.low) / self.width)
        self.count = min(NEAREST, len(table) - 1)

    def shares(self, places):
        """[the share of each name among the nearest runs] of places in the cube."""
        _, found = self.tree.query(places, self.count)
        return self._shares(np.asarray(found).reshape(len(places), self.count))

    def hits(self):
        """How many of the runs are as most of the runs nearest to them, and how many runs there are."""
        _, found = self.tree.query(self.tree.data, self.count + 1)
        others = np.array([[run for run in row if run != own][:self.count] for own, row in enumerate(found)])
        return int((self._shares(others).argmax(axis=1) == self.outcomes).sum()), len(self.outcomes)

    def values(self, places):
        """The values of the keys at places in the cube."""
        back = [np.exp if scale is np.log else np.asarray for scale in self.scales]
        return np.stack([one(low + width * column) for one, low, width, column
                         in zip(back, self.low, self.width, np.asarray(places).T)], axis=1)

    def majority(self, places):
        """(name, share, low, high) of the most frequent outcome near each place, with Wilson's 95 % interval."""
        shares = self.shares(places)
        most = shares.argmax(axis=1)
        return [(self.names[name], *trends.share(round(row[name] * self.count), self.count)) for name, row in zip(most, shares)]

    def _shares(self, found):
        return (self.outcomes[found][:, :, None] == np.arange(len(self.names))).mean(axis=1)
