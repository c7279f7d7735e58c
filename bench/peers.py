"""What other simulators took for the scene of bench/open_overhand.yaml, as it is on record: an independent measurement in which
all programs ran on one machine, each at several steps, and all errors are against one tight reference."""
from collections import namedtuple

# `cost`: CPU seconds a simulated second; `error`: of the force, from the reference.
Figure = namedtuple("Figure", ["cost", "error"])

MACHINE, DATE = "AMD EPYC (Zen 4), 2 cores", "2026-11-25"
PEERS = {
    "DisMech, step of 2.5 ms": Figure(3.37, 0.0050),
    "DisMech, step of 10 ms": Figure(0.88, 0.0075),
    "DisMech, step of 25 ms": Figure(0.38, 0.0117),
    "DisMech, step of 0.1 s": Figure(0.107, 0.0175),
    "DisMech, adaptive step of 0.2 s": Figure(0.071, 0.0209),
    "DisMech, step of 0.4 s": Figure(0.083, 0.0274),
    "imc-der, step of 2.5 ms": Figure(4.97, 0.0),
    "imc-der, step of 10 ms": Figure(1.96, 0.0061),
}
OURS = {"draft": Figure(0.0105, 0.026), "normal": Figure(0.0140, 0.026), "fine": Figure(0.016, 0.026)}
