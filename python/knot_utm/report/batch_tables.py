"""The tables of a batch: a row for each specimen and rows of statistics, as the software of a testing machine prints them."""
from knot_utm.report.certificate import Check
from knot_utm.report.method_facts import label_of, place_of, sentence, unit_of
from knot_utm.report.quantities import (BESIDE, CERTIFICATE, error_shown, GROUPS, is_number, is_rounding, percent,
                                        quantity_of, shown, TABLES)
from knot_utm.report.results_table import labels_of, NOTHING, short_label

WIDEST = 5  # readings beside each other: as many as a telephone has room for
# What is looked for first, in this order, where the specimens have it.
MAIN = ("knotability", "plateau_force", "jump_force", "force_ratio", "lock_extension", "locked_stiffness", "peak_force",
        "break_extension", "knot_efficiency", "elongation_total", "elongation_at_break", "energy_to_break")
STATISTICS = (("Mean", "mean"), ("Standard deviation", "sd"), ("Coefficient of variation", "cv"), ("Minimum", "minimum"),
              ("Maximum", "maximum"), ("95 % interval of the mean, low end", "low"),
              ("95 % interval of the mean, high end", "high"), ("Readings", "n"))
FINEST = 1e-5  # of a mean: no spread is so small that more digits are shown


def main_keys(batch):
    return [key for key in MAIN if batch.statistics(key)][:WIDEST]


def named(numbers):
    """As in a sentence: "specimens 1 to 4 and 7"."""
    runs = []
    for one in sorted(numbers):
        if runs and one == runs[-1][1] + 1:
            runs[-1][1] = one
        else:
            runs.append([one, one])
    words = [str(part) for first, last in runs
             for part in ([first] if first == last else [first, last] if last == first + 1 else [f"{first} to {last}"])]
    return ("specimens " if len(numbers) > 1 else "specimen ") + " and ".join(filter(None, [", ".join(words[:-1]), words[-1]]))


class Column:
    """One reading of every specimen. Its values have as many digits as leave two of their spread."""

    def __init__(self, key, label, unit, mean, spread):
        self.key, self.label, self.unit = key, label, unit
        self.error = max(spread, FINEST * abs(mean)) if spread else None

    def text(self, value):
        return shown(value, self.unit.scale, self.error) if is_number(value) else "none"


class Table:
    """`rows`: of each specimen the number, and its values as texts; `statistics`: the same of rows of statistics."""

    def __init__(self, columns, rows, statistics):
        self.columns, self.rows, self.statistics = columns, rows, statistics


def beside_each_other(columns):
    """In as many tables as they need, of about the same width."""
    tables = -(-len(columns) // WIDEST)
    each = -(-len(columns) // max(tables, 1))
    return [columns[i:i + each] for i in range(0, len(columns), each)] if columns else []


def readings_tables(batch):
    """Of the main readings, and of those that the specification asks for."""
    keys = main_keys(batch)
    keys += [key for key in batch.method.get("specification") or {} if key not in keys and batch.statistics(key)]
    means, largest = batch.means(), batch.largest()
    columns = [Column(key, short_label(means, key, largest), batch.units.of(quantity_of(key).kind), batch.mean(key),
                      batch.statistics(key)["sd"]) for key in keys]
    return [Table(some, [(one.number, [column.text(one.readings[column.key]) for column in some]) for one in batch.counted],
                  [(name, [statistic(batch, column, part) for column in some]) for name, part in STATISTICS])
            for some in beside_each_other(columns)]


def statistic(batch, column, part):
    found = batch.statistics(column.key)
    if part == "n":
        return str(found["n"])
    if part == "sd" and found["sd"] is None and found["n"] > 1:
        return "constant"
    if part == "cv":
        return percent(found["cv"])
    return column.text(found[part]) if is_number(found[part]) else ""


def drawn_tables(batch):
    """What was drawn for each specimen, also for those that are rejected."""
    columns = [Column(key, sentence(name_of(key)), unit_of(key, batch.units), max(one.drawn[key] for one in batch.specimens),
                      batch.spread(key)) for key in batch.specimens[0].drawn]
    return [Table(some, [(one.number, [column.text(one.drawn[column.key]) for column in some]) for one in batch.specimens], [])
            for some in beside_each_other(columns)]


def name_of(key):
    """Of a dotted key of the method: a speed is that of a step."""
    *where, _ = place_of(key).split(".")
    return f"{label_of(key)}, {where[-1]}" if where[0] == "program" else label_of(key)


def scatter(batch):
    """[(what, law and spread)]"""
    laws = (batch.method.get("specimens") or {}).get("scatter")
    return [(sentence(name_of(key)), f"{name.replace('_', '-')}, {percent(spread)}")
            for key, law in (laws.items() if isinstance(laws, dict) else ()) for name, spread in law.items()]


class Row:
    """Statistics of one reading, as texts."""

    def __init__(self, batch, key, label):
        found, quantity = batch.statistics(key), quantity_of(key)
        unit = batch.units.of(quantity.kind)
        column = Column(key, label or quantity.label, unit, found["mean"], found["sd"])
        half = half_of(found)
        self.key, self.label, self.unit, self.n = key, column.label, unit.name, found["n"]
        if is_nothing(batch, key):
            self.mean, self.cv, self.half, self.sd = "0", "", "", "constant" if self.n > 1 else ""
            return
        self.mean, self.cv = column.text(found["mean"]), percent(found["cv"])
        self.sd = error_shown(found["sd"], unit.scale) if found["sd"] is not None or self.n < 2 else "constant"
        self.half = error_shown(half, unit.scale)


def is_nothing(batch, key):
    """Whether neither the mean nor the spread of the readings is more than rounding."""
    def mean_of(one):
        return (batch.statistics(one) or {}).get("mean")

    spread = batch.statistics(key)["sd"]
    return is_rounding(key, mean_of) and (
        spread is None or is_rounding(key, lambda one: spread if one == key else mean_of(one)))


def half_of(statistics):
    """Half the width of the 95 % interval of the mean."""
    return statistics["high"] - statistics["mean"] if is_number(statistics["high"]) else None


def all_readings(batch):
    """[(title, rows)] of every reading that a specimen has, and the keys that none has."""
    largest = batch.largest()
    labels = labels_of(batch.means(), short_label({}, "peak_force", largest))
    titles = [*((title, title) for title in TABLES), (BESIDE, "Numerical errors and true forces"),
              (CERTIFICATE, "Checks")]
    keys = {title: [key for key in GROUPS[group] if key in batch.facts] for group, title in titles}
    known = {"specimens", "rejected", "motion_pattern", *(key for some in keys.values() for key in some)}
    keys["Further"] = [key for key in batch.facts if key not in known]
    groups = [(title, [Row(batch, key, labels.get(key)) for key in some if has_values(batch, key)])
              for title, some in keys.items()]
    missing = [key for some in keys.values() for key in some if key != "motion_pattern" and not has_values(batch, key)]
    return [group for group in groups if group[1]], missing


def has_values(batch, key):
    mean = batch.mean(key)
    return mean is not None and NOTHING.get(key) != mean


def checks_of_all(checks):
    """Each check that has a limit, over all specimens that have its value. `checks`: [(number, [Check])]."""
    found = {}
    for number_of_specimen, some in checks:
        for check in some:
            if check.verdict:
                found.setdefault(check.words, []).append((number_of_specimen, check))
    return [over_all(words, some) for words, some in found.items()]


def over_all(words, found):
    first, missed = found[0][1], [one for one, check in found if check.verdict == "fail"]
    if 0 < len(missed) < len(found):
        words += f"; not so {named(missed)}"
    return Check(words, first.keys, f"{len(found) - len(missed)} of {len(found)} specimens", first.limit, not missed)


def verdict_of_all(checks, sentence_of):
    """(words, whether all do). `sentence_of`: "%s keep all limits." """
    good = [one for one, some in checks if not any(check.verdict == "fail" for check in some)]
    return sentence_of % f"{len(good)} of {len(checks)} specimens", len(good) == len(checks)
