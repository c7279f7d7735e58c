"""How far a result may be trusted, and whether it is what the user asked for: each check with value, limit and verdict.

The limits of trust are those at which the program itself warns (`tensile_test --list-limits`). What has no limit has no verdict,
and stands among the results alone.
"""
from knot_utm import tool
from knot_utm.report.quantities import is_number, number, quantity_of


class Check:
    """`kept`: whether the limit is; None: no limit is set, or no value is known. `keys`: of result.yaml.
    `value`: empty where the test has none."""

    def __init__(self, words, keys, value, limit, kept):
        self.words, self.keys, self.value, self.limit = words, keys, value, limit
        self.verdict = "" if kept is None else "pass" if kept else "fail"


def at_most(words, key, value, limit):
    there = is_number(value)
    return Check(words, [key], number(value) if there else "", f"at most {limit:g}", value <= limit if there else None)


def so_it_is(words, key, is_so):
    """`is_so`: None where it is not known."""
    return Check(words, [key], "" if is_so is None else "yes" if is_so else "no", "yes", is_so)


def certificate(result, has_knot=True, soft=False):
    """What is known of this test."""
    return [check for check in checks_of(result, has_knot, soft) if check.value]


def checks_of(result, has_knot=True, soft=False):
    limits = {row["name"]: float(row["limit"]) for row in tool.listing("limits")}
    value, ended_by, moved, jump = result.get, result.get("ended_by"), result.get("not_equilibrated"), jumped(result)
    return [
        so_it_is("The physics solved every time step", "ended_by", None if ended_by is None else ended_by != "solver"),
        so_it_is("The knot remained the same knot", "knot_type_preserved", value("knot_type_preserved") if has_knot else None),
        so_it_is("The specimen was at rest as its pull began", "not_equilibrated", None if moved is None else not moved),
        at_most("Deepest contact, in radii", "max_penetration", value("max_penetration"),
                limits["deep_soft_contact" if soft else "deep_contact"]),
        so_it_is("No knot jumped open", "jump_force", None if jump is None else not jump),
        *(at_most(quantity_of(key).label, key, value(key), limits[name])
          for key, name in (("energy_balance_error", "energies_differ"), ("force_balance_error", "forces_differ"))),
        at_most("Estimated numerical error of the plateau force, as a share of it", "plateau_force_error",
                share_of_plateau(result), limits["plateau_unsure"]),
    ]


def jumped(result):
    """None: there are no two knots, of which one could."""
    found = is_number(result.get("jump_force"))
    return found if found or is_number(result.get("tied_knot_distance")) else None


def share_of_plateau(result):
    """The error of the plateau force over the true one."""
    value, error = result.get("true_plateau_force"), result.get("plateau_force_error")
    return abs(error / value) if is_number(value) and is_number(error) and value else None


def stiffness_name(result):
    """Where nothing locks locked_stiffness is that of the whole pull."""
    return "stiffness of the pull" if result.get("lock_extension") is None else "locked stiffness"


def verdict(checks):
    limited = [check for check in checks if check.verdict]
    missed = [check for check in limited if check.verdict == "fail"]
    words = f"{len(limited) - len(missed)} of {len(limited)} limits are kept."
    return words, not missed


def specification_checks(method, result, units):
    """The requirements of the user, in the order of the method."""
    return [requirement(key, limits or {}, result.get(key), units)
            for key, limits in (method.get("specification") or {}).items()]


def requirement(key, limits, value, units):
    quantity = quantity_of(key)
    unit = units.of(quantity.kind)
    least, most = limits.get("min"), limits.get("max")
    ends = [f"{words} {number(end * unit.scale)}" for words, end in (("at least", least), ("at most", most))
            if is_number(end)]
    kept = is_number(value) and not (is_number(least) and value < least) and not (is_number(most) and value > most)
    shown = f"{number(value * unit.scale)} {unit.name}".strip() if is_number(value) else "not measured"
    return Check(quantity.label.split(",")[0], [key], shown, f"{' and '.join(ends)} {unit.name}".strip(), kept)


def specification_verdict(result, checks):
    """(words, whether it passed) as result.yaml says it; None where nothing was asked for."""
    passed = result.get("specification_passed")
    if passed is None:
        return None
    missed = sum(check.verdict == "fail" for check in checks)
    if passed:
        return "The test meets its specification.", True
    return f"The test does not meet its specification: {missed} of {len(checks)} requirements are not met.", False
