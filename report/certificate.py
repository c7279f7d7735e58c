"""How far a result may be trusted: each check with its value, its limit, and whether it keeps it.

The limits are those at which the program itself warns (src/io/run_writer.cpp, whose names they bear), and for the
balance of forces that of scripts/bench. Where nothing sets a limit none is made up here: the value stands for itself.
"""
from quantities import number
from run import is_number

LIMITS = {
    "kDeep": 0.05,        # contact [of the radius]
    "kJump": 0.1,         # node while pulled [m/s]
    "kUnbalanced": 0.01,  # energies [of the largest]
    "kUnsure": 0.1,       # plateau force [of itself]
}
BENCH_FORCE_BALANCE = 0.01  # [of the peak]

# Keys of result.yaml that stand in the certificate.
CERTIFIED = ("knot_type_preserved", "not_equilibrated", "max_penetration", "fastest_node", "force_balance_error",
             "moment_balance_error", "energy_balance_error")


class Check:
    """`verdict`: "pass", "miss", or "" where no limit is set or no value known. `keys`: of result.yaml."""

    def __init__(self, words, keys, value, limit, kept):
        self.words, self.keys, self.value, self.limit = words, keys, value, limit
        self.verdict = "" if kept is None else "pass" if kept else "miss"


def at_most(words, key, value, limit, unit=""):
    unit = " " + unit if unit else ""
    if not is_number(value):
        return Check(words, [key], "not known", f"≤ {limit:g}{unit}", None)
    return Check(words, [key], number(value) + unit, f"≤ {limit:g}{unit}", value <= limit)


def unlimited(words, keys, value, unit=""):
    text = f"{number(value)} {unit}".strip() if is_number(value) else "not known"
    return Check(words, keys, text, "none set", None)


def must_be(words, key, value, wanted, yes, no):
    return Check(words, [key], yes if value is True else no if value is False else "not known", yes if wanted else no,
                 None if value is None else value is wanted)


def certificate(result):
    def value(key):
        return result.get(key)

    ended_by = value("ended_by")
    return [
        Check("The physics made every time step", ["ended_by"], f"ended by {ended_by}", "not by solver",
              None if ended_by is None else ended_by != "solver"),
        must_be("The knot stayed the one it began as", "knot_type_preserved", value("knot_type_preserved"), True,
                "preserved", "changed"),
        must_be("Tied and released to rest", "not_equilibrated", value("not_equilibrated"), False, "still moving",
                "at rest"),
        at_most("Deepest contact", "max_penetration", value("max_penetration"), LIMITS["kDeep"], "radii"),
        at_most("Fastest node while pulled, until the lock", "fastest_node", value("fastest_node"), LIMITS["kJump"],
                "m/s"),
        at_most("Energy balance: work less losses, stored and kinetic", "energy_balance_error",
                value("energy_balance_error"), LIMITS["kUnbalanced"]),
        at_most("Force balance: upper less lower grip, of the peak", "force_balance_error",
                value("force_balance_error"), BENCH_FORCE_BALANCE),
        unlimited("Moment balance at the grips, of peak force times L", ["moment_balance_error"],
                  value("moment_balance_error")),
        *convergence(result),
    ]


def convergence(result):
    """What finer tolerances would still move, as a share of the reading."""
    checks = []
    for key, words, limit in (("plateau_force", "Convergence of the plateau force", LIMITS["kUnsure"]),
                              ("lock_extension", "Convergence of the lock extension", None),
                              ("locked_stiffness", "Convergence of the " + stiffness_name(result), None)):
        value, error = result.get(key), result.get(key + "_error")
        if not is_number(value):
            continue
        share = abs(error / value) if is_number(error) and value else None
        if limit is None:
            checks.append(unlimited(words + ", share of it", [key + "_error"], share))
        else:
            checks.append(at_most(words + ", share of it", key + "_error", share, limit))
    return checks


def stiffness_name(result):
    """Where nothing locks locked_stiffness is that of the whole pull."""
    return "stiffness of the pull" if result.get("lock_extension") is None else "locked stiffness"


def verdict(checks):
    limited = [check for check in checks if check.verdict]
    missed = [check for check in limited if check.verdict == "miss"]
    words = f"{len(limited) - len(missed)} of {len(limited)} limits kept"
    open_ones = len(checks) - len(limited)
    if open_ones:
        words += f"; {open_ones} value{'s' if open_ones > 1 else ''} without a limit or not known"
    return words, not missed
