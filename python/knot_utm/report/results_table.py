"""result.yaml as a table: every key that has a value has its place, also those that this file has never heard of."""
from knot_utm.report.certificate import stiffness_name
from knot_utm.report.quantities import CERTIFICATE, error_shown, GROUPS, HEAD, in_units, is_rounding, quantity_of, shown, TABLES


class Row:
    """`keys`: of result.yaml, that this row shows: a reading, its numerical error, and the true force beside it."""

    def __init__(self, result, key, units, label, value=None):
        quantity, error, true = quantity_of(key), result.get(key + "_error"), "true_" + key
        unit = units.of(quantity.kind)
        self.label, self.is_text = label or quantity.label, isinstance(result[key], str) or value is not None
        self.keys = [name for name in (key, key + "_error", true) if name in result]
        self.value, self.error = value or shown(self.reading(result, key), unit.scale, error), error_shown(error, unit.scale)
        if isinstance(result[key], str):
            self.value = in_units(self.value, units)
        self.true = shown(result[true], unit.scale, error) if result.get(true) is not None else ""
        self.unit = "" if isinstance(result[key], (str, bool, dict)) else unit.name

    @staticmethod
    def reading(result, key):
        return 0.0 if is_rounding(key, result.get) else result[key]


class Group:
    def __init__(self, title, rows):
        self.title, self.rows = title, rows
        self.has_errors = any(row.error for row in rows)
        self.has_true_forces = any(row.true for row in rows)
        self.columns = 2 + self.has_errors + self.has_true_forces  # without the label's
        self.kind = "told" if any(row.is_text for row in rows) and self.columns == 2 else \
            "plain" if self.columns == 2 else ""


# What stands for no value where it is not null.
NOTHING = {"break_place": "none", "cycles": 0, "motion_pattern_confidence": 0}


def misses_plateau(result):
    """Whether a page says why there is no plateau. A rod without two knots never has one, which needs no reason."""
    return result.get("motion_pattern") != "none" or result.get("jump_force") is not None


def has_value(result, key):
    if key == "no_plateau_because" and not misses_plateau(result):
        return False
    return key in result and result[key] is not None and result[key] != [] and NOTHING.get(key) != result[key]


def labels_of(result, peak):
    """Labels that are of this test: where nothing locks locked_stiffness is that of the whole pull, and the largest load
    is no peak where the test was stopped while it rose. `peak`: what the largest load is called."""
    name = stiffness_name(result)
    return {"locked_stiffness": name[:1].upper() + name[1:], "peak_force": peak}


def short_label(result, key, largest):
    """For a place that has no room for the label. `largest`: the LargestLoad of the test, or None."""
    if key == "peak_force" and largest and not largest.is_peak:
        return "Largest load"
    name = stiffness_name(result) if key == "locked_stiffness" else key.replace("_", " ")
    return name[:1].upper() + name[1:]


def results_table(run, peak):
    """Groups of rows, those with a label first; the keys of which this test has no value; and those with one that needs no words."""
    result, units = run.result, run.units
    labels, words = labels_of(result, peak), {key: "not predicted" for key in run.not_predicted()}
    placed = {*GROUPS[HEAD], *GROUPS[CERTIFICATE]}  # the page says them elsewhere
    groups = []
    for title in TABLES:
        rows = [Row(result, key, units, labels.get(key), words.get(key))
                for key in GROUPS[title] if has_value(result, key) or key in words]
        groups.append(Group(title, rows))
        placed.update(key for row in rows for key in row.keys)
    folded = {name for key in result for name in (key + "_error", "true_" + key) if has_value(result, key)}
    rest = [key for key in result if key not in placed and key not in folded]
    groups.append(Group("Further", [Row(result, key, units, None) for key in rest if has_value(result, key)]))
    none = [key for key in rest if not has_value(result, key)]
    untold = [key for key in none if isinstance(result[key], str) and NOTHING.get(key) != result[key]]
    return [group for group in groups if group.rows], [key for key in none if key not in untold], untold
