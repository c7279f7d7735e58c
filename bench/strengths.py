"""What knots leave of a rope's strength, with the one number of the law of breaking fitted to an overhand."""
from bends import pulls
from predictions import Row, mean_of_all
from runs import divide, mean
from table import within

EDGES = 0.5  # of the automatic edge length, for bends that part a rope: at the whole one strengths are up to 5 % too high


def rows(runner, facts):
    kept = {knot: strengths(runner, facts, knot) for knot in facts["knots"]}
    return rows_of(kept, strengths(runner, facts["loop"], "overhand_tied"), strengths(runner, facts["loop"], "dropper_loop"), facts)


def strengths(runner, facts, knot):
    """knot_efficiency of each start; None where it did not part, or gave up."""
    settings = {"material.breaking": {"law": "tension_and_bending", "bending_share": facts["share"]}, **facts["settings"]}
    name = f"strength/{facts['rope']}_{knot}"
    return [run.reading("knot_efficiency") for run in pulls(runner, name, knot, facts["rope"], settings)]


def rows_of(kept, overhand, loop, facts):
    fitted = f"bending_share of {facts['rope']}: {facts['share']:g}, to an overhand that keeps {facts['overhand']:g}"
    out = []
    for knot, measured in facts["knots"].items():
        value, error = mean_of_all(kept[knot])
        out.append(Row(f"{facts['what']}: {knot}", measured["words"], value, error, divide(value, measured["middle"]),
                       within(*measured["within"]), facts["source"], fitted, facts["if_it_fails"]))
    facts = facts["loop"]
    ratio = divide(mean_of_all(overhand)[0], mean_of_all(loop)[0])
    return out + [Row(facts["what"], facts["words"], ratio, "", divide(ratio, mean(facts["within"])), within(*facts["within"]),
                      facts["source"], f"bending_share of {facts['rope']}: {facts['share']:g}", facts["if_it_fails"])]
