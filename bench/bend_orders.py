"""Bends in the order of the force that pulls them, rope by rope, against a published order."""
from bends import load_of, pulls, slipping_load_of
from predictions import Row, mean_of_all, text_of_mean
from table import Table, at_least, is_

SLIPPING = "Load at which a bend slips, with its standard error"


def found(runner, facts):
    """{rope: {knot: (mean, standard error)}} of the load that each bears [k_b/h^2]."""
    return {rope: {knot: mean_of_all([load_of(run) for run in pulls(runner, f"order/{rope}_{knot}", knot, rope, {})])
                   for knot in facts["order"]} for rope in facts["ropes"]}


def rows(loads, facts):
    wanted, alike = " < ".join(facts["order"]), facts["alike_below"]
    return [Row(f"{facts['what']}, {rope}", wanted, in_order(of_rope, facts["order"], alike), "",
                rank_correlation(of_rope, facts["order"], alike), is_(wanted), facts["source"], why=facts["if_it_fails"]) for rope, of_rope in loads.items()]


def slipping(runner, facts):
    """{knot: (mean, standard error)} of the load at which each slips [k_b/h^2]."""
    settings = {"material.friction_coefficient": facts["friction"], "program.3.pull.until.extension": facts["extension"],
                "machine.load_cell": {"capacity": facts["capacity"], "sampling_rate": 3},
                "ends.break_at_fraction_of_peak": facts["fallen_to"]}
    return {knot: mean_of_all([slipping_load_of(run) for run in pulls(runner, f"slipping/{knot}", knot, facts["rope"], settings)])
            for knot in facts["order"]}


def slipping_row(loads, facts):
    return Row(facts["what"], " < ".join(facts["order"]), rank_correlation(loads, facts["order"]), "", "", at_least(facts["rank"]),
               facts["source"], f"friction of {facts['rope']}: {facts['friction']:g}", why=facts["if_it_fails"])


def in_order(of_rope, order, alike_below=0.0):
    """"grief < thief", or None where one bears no load that was read. Loads below `alike_below` are as good as none: among themselves
    such bends stay as `order` has them."""
    if any(value is None for value, _ in of_rope.values()):
        return None
    return " < ".join(sorted(order, key=lambda knot: max(of_rope[knot][0], alike_below)))


def rank_correlation(of_rope, order, alike_below=0.0):
    """Spearman's, of the loads with the order."""
    found_order = in_order(of_rope, order, alike_below)
    if found_order is None:
        return None
    count = len(order)
    ranks = found_order.split(" < ")
    return 1.0 - 6.0 * sum((ranks.index(knot) - place) ** 2 for place, knot in enumerate(order)) / (count * (count ** 2 - 1))


def table_of(loads, facts, title="Largest load in the pull, with its standard error"):
    table = Table(title, facts["order"])
    for rope, of_rope in loads.items():
        table.add(rope, "k_b/h^2", [text_of_mean(*of_rope[knot]) for knot in facts["order"]])
    return table
