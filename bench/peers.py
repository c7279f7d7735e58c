"""What other simulators took for the scene of bench/open_overhand.yaml, as it is on record. No figure is scaled to another
machine: what was measured elsewhere is compared with what this program took there, where that is on record."""
from collections import namedtuple

# `cost`: CPU seconds a simulated second; `error`: mean difference of the force from the same program's own default, whose
# error nobody knows (None for the default itself, and where it was not recorded). A figure of ours: from our fine run.
Figure = namedtuple("Figure", ["cost", "error"])
Occasion = namedtuple("Occasion", ["machine", "date", "edges", "peers", "ours", "ours_edges"])

FIRST = Occasion("AMD EPYC, 2 cores", "2026-11-21", 300, {
    "imc-der, step of 2.5 ms": Figure(3.82, None),
    "imc-der, step x4": Figure(1.36, 0.03),
    "imc-der, step x10, gives up at 98 %": Figure(0.73, 0.03),
    "DisMech, its default step": Figure(2.08, None),
    "DisMech, step x10, force doubled": Figure(0.18, 1.0),
}, None, "")

# The friction coefficient of both, 0.3, is this scene's; our run solved for twist at `physics.accuracy: normal`.
SECOND = Occasion("an Intel machine, one core", "2026-11-22", 300, {
    "imc-der, step of 2.5 ms": Figure(4.97, None),
    "imc-der, step x4": Figure(2.06, None),
    "DisMech, its default step": Figure(1.95, None),
    "DisMech, step x4": Figure(0.48, 0.021),
    "DisMech, step x10": Figure(0.21, 0.036),
}, Figure(0.0212, 0.016), "300 as drawn, laid anew by edge_length")

OCCASIONS = [FIRST, SECOND]
