"""What knots leave of a rope's strength, with the one number of the law of breaking fitted to an overhand."""
from bends import pulls
from predictions import NOTHING, Row, mean_of_all, text_of_mean
from runs import divide, mean
from table import Table, at_least, within

OVERHAND, BOWLINE = "overhand_tied", "bowline"


def found(runner, facts):
    """{knot: (mean, standard error)} of what each keeps."""
    return {knot: mean_of_all(strengths(runner, facts, knot)) for knot in [OVERHAND, *facts["knots"]]}


def strengths(runner, facts, knot):
    """knot_efficiency of each start; None where it did not part, or gave up."""
    settings = {"material.breaking": {"law": "tension_and_bending", **facts["shares"]}, **facts["settings"]}
    name = f"strength/{facts['rope']}_{knot}"
    return [run.reading("knot_efficiency") for run in pulls(runner, name, knot, facts["rope"], settings)]


def loop_ratio(runner, facts):
    """Of an overhand over a dropper loop."""
    return divide(*(mean_of_all(strengths(runner, facts, knot))[0] for knot in (OVERHAND, "dropper_loop")))


def rows_of(kept, ratio, facts):
    fitted, knots = fitted_words(facts), facts["knots"]
    near = [knot for knot in knots if is_near(kept[knot][0], knots[knot], facts["near"])]
    out = [Row(f"{facts['what']}: {knot}", published_words(ranges), kept[knot][0], kept[knot][1], "",
               within(min(map(min, ranges)), max(map(max, ranges))), source, fitted, facts["if_it_fails"])
           for knot, ranges, source in ((OVERHAND, [facts["overhand"]], facts["source"]), (BOWLINE, facts["bowlines"], facts["bowlines_source"]))]
    out.append(Row(f"{facts['count']} within {facts['near']:g} of a published range", f"{len(knots)} of {len(knots)}", len(near), "",
                   len(near) / len(knots), at_least(facts["right"]), facts["source"], fitted, facts["if_it_fails"]))
    loop = facts["loop"]
    return out + [Row(loop["what"], loop["words"], ratio, "", divide(ratio, mean(loop["within"])), within(*loop["within"]),
                      loop["source"], fitted_words(loop), loop["if_it_fails"])]


def fitted_words(facts):
    return ", ".join(f"{share} of {facts['rope']}: {value:g}" for share, value in facts["shares"].items()) or NOTHING


def published_words(ranges):
    return ", ".join(" to ".join(f"{end:g}" for end in one) for one in ranges)


def is_near(value, ranges, near):
    """`ranges`: [lowest, highest] or [value] of each source."""
    return value is not None and any(one[0] - near <= value <= one[-1] + near for one in ranges)


def table_of(kept, facts):
    table = Table(f"{facts['count']}, of the straight rope's in {facts['rope']}, with its standard error",
                  ["published", "predicted", f"within {facts['near']:g}", "likeliest reason of a miss"])
    for knot, ranges in facts["knots"].items():
        near = is_near(kept[knot][0], ranges, facts["near"])
        table.add(knot, "-", [published_words(ranges), text_of_mean(*kept[knot]), near, "" if near else facts["reasons"].get(knot, "not looked for")])
    return table
