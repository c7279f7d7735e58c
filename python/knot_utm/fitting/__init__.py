"""The parts of a fit (knot_utm.fit): what may move, what was measured, how far off it may be, and what the model says."""
