"""What people measured on knots against what tensile_test predicts."""
import os

import bend_orders
import capstans
import fibers
import hitches
import holding
import inversions
import predictions
import strengths
import surgeons
from runs import read_yaml
from table import ROOT, Report, Table

FACTS = os.path.join(ROOT, "bench/measured.yaml")


def report(runner):
    spent = Counted(runner)
    facts = read_yaml(FACTS)
    rows = inversions.rows(spent, facts["inversions"]) + surgeons.rows(spent, facts["surgeons"])
    rows += capstans.rows(spent, facts["capstans"]) + hitches.rows(spent, facts["hitches"])
    rows += fibers.rows(spent, facts)
    loads = bend_orders.found(spent, facts["orders"])
    slipping = bend_orders.slipping(spent, facts["slipping"])
    greased = holding.scanned(spent, facts["greased"])
    ordinary = {rope: holding.found(spent, f"ordinary/{rope}", {**facts["ordinary"], "rope": rope}) for rope in facts["ordinary"]["ropes"]}
    slippery = holding.found(spent, "slippery", facts["slippery"])
    kept = strengths.found(spent, facts["strengths"])
    rows += bend_orders.rows(loads, facts["orders"]) + [bend_orders.slipping_row(slipping, facts["slipping"])]
    rows += holding.rows_of_scan(greased, facts["greased"])
    rows += [holding.row(bends, {**facts["ordinary"], "what": f"{facts['ordinary']['what']}, {rope}"}) for rope, bends in ordinary.items()]
    rows += [holding.row(slippery, facts["slippery"])]
    rows += strengths.rows_of(kept, strengths.loop_ratio(spent, facts["strengths"]["loop"]), facts["strengths"])
    return Report("What people measured on knots",
                  "Each prediction is a mean over starts that differ a little, with its standard error, and nothing is fitted but what "
                  "the column says. The factor is predicted over measured, the middle of a range; of an order it is Spearman's rank "
                  "correlation. A standard error says how starts scatter, not how far the model may be from a real rope. "
                  f"The {spent.count} runs took {spent.cpu_time / 60:.0f} minutes of CPU time. Published values and their "
                  "sources are in `bench/measured.yaml`.",
                  [predictions.table_of(rows), bend_orders.table_of(loads, facts["orders"]),
                   bend_orders.table_of({facts["slipping"]["rope"]: slipping}, facts["slipping"], bend_orders.SLIPPING),
                   holding.table_of("Greased line by its friction", greased, facts["greased"]),
                   holding.table_of("Ordinary bends", ordinary, facts["ordinary"]),
                   holding.table_of("Slippery rope", {facts["slippery"]["rope"]: slippery}, facts["slippery"]),
                   strengths.table_of(kept, facts["strengths"]), not_yet(facts["not_yet"])])


class Counted:
    """A runner, and what its runs took."""

    def __init__(self, runner):
        self.runner, self.root, self.count, self.cpu_time = runner, runner.root, 0, 0.0

    def run(self, *words, **options):
        run = self.runner.run(*words, **options)
        self.count += 1
        self.cpu_time += run.cpu_time
        return run


def not_yet(facts):
    table = Table("Not comparable yet", ["measured", "reason", "source"])
    for fact in facts:
        table.add(fact["what"], "-", [fact["measured"], fact["reason"], fact["source"]])
    return table
