"""How tight knots are tied, and what their plateau is worth at another tightness."""
import statistics


class TightnessLaw:
    """The force at which a knot slides follows the length of rod that tying leaves in it, its excess length. What moves
    that length moves the force, as the pre-load does, however little it changes about the sliding itself: the law, the
    parabola through three points (excess length, plateau force), tells the two apart. Where a value is missing, or two
    points are equally tight, there is none."""

    def __init__(self, points):
        known = sorted(point for point in points if None not in point)
        self.points = known if len({excess for excess, _ in known}) == 3 else []

    def force_at(self, excess):
        """Lagrange's polynomial; None beyond its points."""
        if excess is None or not self.points or not self.points[0][0] <= excess <= self.points[-1][0]:
            return None
        force = 0.0
        for i, (own, value) in enumerate(self.points):
            for j, (other, _) in enumerate(self.points):
                if i != j:
                    value *= (excess - other) / (own - other)
            force += value
        return force


def excess_length(run):
    """Mean of a loop's knots [m]; None where the run did not get as far."""
    lengths = run.value("excess_length")
    return statistics.fmean(lengths) if isinstance(lengths, list) and lengths else None
