"""Bends that slip, and that hold until the rope breaks, against what people found of each."""
from dataclasses import dataclass

from bend_orders import rank_correlation
from bends import SPEEDS, load_of, pulls
from predictions import NOTHING, Row, mean_of_all, text_of_mean
from table import Table, at_least


@dataclass(frozen=True)
class Bend:
    """`held`: how many starts held until the rope broke; None where one gave up. `load`: largest in the pull, and its standard error [k_b/h^2]."""

    held: object
    load: tuple = (None, None)


def found(runner, name, facts, settings=None):
    """{knot: Bend} in `facts["rope"]`."""
    each = {knot: pulls(runner, f"{name}/{knot}", knot, facts["rope"], {**facts.get("settings", {}), **(settings or {})})
            for knot in facts["slip"] + facts["hold"]}
    return {knot: Bend(count_of_breaks(runs), mean_of_all([load_of(run) for run in runs])) for knot, runs in each.items()}


def scanned(runner, facts):
    """{friction: {knot: Bend}}"""
    return {friction: found(runner, f"greased/{friction:g}", facts, {"material.friction_coefficient": friction})
            for friction in facts["friction"]}


def count_of_breaks(runs):
    ends = [run.value("ended_by") if run.exit_code == 0 else None for run in runs]
    return None if None in ends else ends.count("break")


def wrong(bends, facts):
    """Those that do not do as they did in the measurement in every start."""
    return [knot for knots, held in ((facts["slip"], 0), (facts["hold"], len(SPEEDS))) for knot in knots if bends[knot].held != held]


def right(bends, facts):
    return len(bends) - len(wrong(bends, facts))


def order_of_slips(bends, facts):
    """Spearman's rank correlation of the loads of those that slip with their published order."""
    return rank_correlation({knot: bends[knot].load for knot in facts["slip"]}, facts["slip"])


def row(bends, facts, fitted=NOTHING):
    count, everyone = right(bends, facts), len(bends)
    return Row(facts["what"], f"{everyone} of {everyone}", count, "", count / everyone, at_least(facts.get("right", everyone)),
               facts["source"], fitted, facts["if_it_fails"])


def best_of(scan, facts):
    """The friction at which most are right, and of several the one whose slips are best in order."""
    return max(scan, key=lambda friction: (right(scan[friction], facts), order_of_slips(scan[friction], facts) or -1.0))


def rows_of_scan(scan, facts):
    best = best_of(scan, facts)
    fitted = f"friction of {facts['rope']}: {best:g}"
    slips = Row(facts["what"] + ": order of those that slip, Spearman's rank correlation", " < ".join(facts["slip"]),
                order_of_slips(scan[best], facts), "", "", at_least(facts["rank"]), facts["source"], fitted, facts["if_it_fails"])
    return [row(scan[best], facts, fitted), slips]


def table_of(title, cases, facts):
    """`cases`: {column: {knot: Bend}}"""
    table = Table(f"{title}: starts, of {len(SPEEDS)}, that hold until the rope breaks, and largest load [k_b/h^2]",
                  ["measured"] + list(cases))
    for knot in facts["slip"] + facts["hold"]:
        table.add(knot, "-", ["holds" if knot in facts["hold"] else "slips"] + [text_of(bends[knot]) for bends in cases.values()])
    table.add("not as measured", "-", [""] + [", ".join(wrong(bends, facts)) or "none" for bends in cases.values()])
    return table


def text_of(bend):
    return "missing" if bend.held is None else f"{bend.held}: {text_of_mean(*bend.load)}"
