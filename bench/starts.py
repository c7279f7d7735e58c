"""Perturbed starts of the shipped test: its two knots are tied a little further apart each time."""
KNOT_DISTANCE, SHIFT = 0.15, 0.00037  # [m] of the first start, which is the shipped one, and from one to the next


def start(k):
    return {"specimen.knot_distance": round(KNOT_DISTANCE + SHIFT * k, 9)}
