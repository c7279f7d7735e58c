"""Bends of slippery rope that slip, and that hold until it breaks, at every friction of a scan."""
from bends import SPEEDS, pulls
from predictions import Row
from table import Table, at_least


def found(runner, facts):
    """{friction: {knot: how many starts hold until the rope breaks}}; None where one gave up."""
    return {friction: {knot: count_of_breaks(pulls(runner, f"greased/{knot}_{friction:g}", knot, facts["rope"],
                                                   {"material.friction_coefficient": friction}))
                       for knot in facts["slip"] + facts["hold"]} for friction in facts["friction"]}


def count_of_breaks(runs):
    ends = [run.value("ended_by") if run.exit_code == 0 else None for run in runs]
    return None if None in ends else ends.count("break")


def right(holding, facts):
    """How many do as they did in the measurement, in every start."""
    return sum(holding[knot] == wanted for knots, wanted in ((facts["slip"], 0), (facts["hold"], len(SPEEDS))) for knot in knots)


def row(holding, facts):
    best = max(holding, key=lambda friction: right(holding[friction], facts))
    count = right(holding[best], facts)
    everyone = len(facts["slip"] + facts["hold"])
    return Row(facts["what"], f"{everyone} of {everyone}", count, "", count / everyone, at_least(facts["right"]), facts["source"],
               f"friction of {facts['rope']}: {best:g}", facts["if_it_fails"])


def table_of(holding, facts):
    table = Table(f"Starts, of {len(SPEEDS)}, that hold until the line breaks, by its friction coefficient",
                  ["measured"] + [f"{friction:g}" for friction in holding])
    for knot in facts["slip"] + facts["hold"]:
        table.add(knot, "-", ["holds" if knot in facts["hold"] else "slips"] + [of_knots[knot] for of_knots in holding.values()])
    table.add("as measured", "-", [""] + [right(of_knots, facts) for of_knots in holding.values()])
    return table
