"""result.yaml as a table: every key has its place, also those that this file has never heard of."""
from certificate import CERTIFIED
from quantities import GROUPS, error_shown, quantity_of, shown

ELSEWHERE = ("warnings",)  # the page says them above


class Row:
    """`keys`: of result.yaml, that this row shows."""

    def __init__(self, result, key):
        quantity = quantity_of(key)
        self.label, self.unit = quantity.label, quantity.unit
        self.is_text = isinstance(result[key], str)
        self.keys = [key] + [key + "_" + part for part in ("error", "sd") if key + "_" + part in result]
        error = result.get(key + "_error")
        self.value = shown(result[key], quantity.scale, error)
        self.error = error_shown(error, quantity.scale)
        self.sd = error_shown(result.get(key + "_sd"), quantity.scale)
        if result[key] is None or isinstance(result[key], (str, bool, dict)):
            self.unit = ""


def results_table(result):
    """[(group, rows)]; first those with a label, in their order, then the rest."""
    placed = set(ELSEWHERE) | set(CERTIFIED)
    groups = []
    for title, known in GROUPS:
        rows = [Row(result, key) for key in known if key in result]
        groups.append((title, rows))
        placed.update(key for row in rows for key in row.keys)
    folded = {key + "_" + part for key in result for part in ("error", "sd")}
    rest = [Row(result, key) for key in result if key not in placed and key not in folded]
    groups.append(("Further", rest))
    return [(title, rows) for title, rows in groups if rows]
