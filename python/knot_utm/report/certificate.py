"""How far a result may be trusted, and whether it is what the user asked for: each check with value, limit and verdict.

The limits of trust are those at which the program itself warns (`tensile_test --list-limits`)."""
from collections import namedtuple

from knot_utm import tool
from knot_utm.report.quantities import is_number, number, quantity_of, with_unit

# `kept`: whether the limit is. `key`: of result.yaml.
Check = namedtuple("Check", "words key value limit kept")


def certificate(result, has_knot=True, soft=False):
    """What is known of this test."""
    limits = {row["name"]: float(row["limit"]) for row in tool.listing("limits")}
    value, jump = result.get, is_number(result.get("jump_force"))
    true, error, moved = value("true_plateau_force"), value("plateau_force_error"), value("not_equilibrated")
    checks = [  # (words, key, what is found, the limit; none where it is yes or no); what is not known is None, and no check
        ("The physics solved every time step", "ended_by", value("ended_by") and value("ended_by") != "solver", ""),
        ("The knot remained the same knot", "knot_type_preserved", value("knot_type_preserved") if has_knot else None, ""),
        ("The specimen was at rest as its pull began", "not_equilibrated", None if moved is None else not moved, ""),
        ("Deepest contact, in radii", "max_penetration", value("max_penetration"), "deep_soft_contact" if soft else "deep_contact"),
        # Where there are no two knots none can jump.
        ("No knot jumped open", "jump_force", not jump if jump or is_number(value("tied_knot_distance")) else None, ""),
        *((quantity_of(key).label, key, value(key), limit)
          for key, limit in (("energy_balance_error", "energies_differ"), ("force_balance_error", "forces_differ"))),
        ("Estimated numerical error of the plateau force, as a share of it", "plateau_force_error",
         abs(error / true) if is_number(true) and is_number(error) and true else None, "plateau_unsure")]
    known = []
    for words, key, found, limit in checks:
        if limit and is_number(found):
            known.append(Check(words, key, number(found), f"at most {limits[limit]:g}", found <= limits[limit]))
        elif not limit and found is not None:
            known.append(Check(words, key, "yes" if found else "no", "yes", found))
    return known


def stiffness_name(result):
    """Where nothing locks locked_stiffness is that of the whole pull."""
    return "stiffness of the pull" if result.get("lock_extension") is None else "locked stiffness"


def verdict(checks):
    """(words, whether all limits are kept)."""
    kept = sum(check.kept for check in checks)
    return f"{kept} of {len(checks)} limits are kept.", kept == len(checks)


def specification_checks(method, result, units):
    """The requirements of the user, in the order of the method."""
    checks = []
    for key, limits in (method.get("specification") or {}).items():
        value, unit = result.get(key), units.of(quantity_of(key).kind)
        least, most = ((limits or {}).get(end) for end in ("min", "max"))
        ends = [f"{words} {number(end * unit.scale)}" for words, end in (("at least", least), ("at most", most)) if is_number(end)]
        kept = is_number(value) and not (is_number(least) and value < least) and not (is_number(most) and value > most)
        checks.append(Check(quantity_of(key).label.split(",")[0], key, with_unit(value, unit) if is_number(value) else "not measured",
                            f"{' and '.join(ends)} {unit.name}".strip(), kept))
    return checks


def specification_verdict(result, checks):
    """(words, whether it passed) as result.yaml says it; None where nothing was asked for."""
    passed = result.get("specification_passed")
    if passed is None:
        return None
    missed = sum(not check.kept for check in checks)
    return ("The test meets its specification." if passed else
            f"The test does not meet its specification: {missed} of {len(checks)} requirements are not met."), passed
