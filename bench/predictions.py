"""What is said of one thing that people measured: measured, predicted, and whether both agree."""
from dataclasses import dataclass

from runs import known, mean, standard_error
from table import Gate, Table

STARTS = (0.99, 1.0, 1.01)  # by which a length of the specimen differs from start to start: one start is no reading
CPU_LIMIT = 200             # [s] of a run
NOTHING = "nothing"         # was fitted


@dataclass(frozen=True)
class Row:
    """`what` begins with its number. `why`: the likeliest reason, said where the gate fails."""

    what: str
    measured: str
    predicted: object
    error: object = ""      # standard error of the prediction, over its starts
    factor: object = ""     # predicted over measured
    gate: Gate = Gate("a value", lambda value: True)
    source: str = ""
    fitted: str = NOTHING
    why: str = ""


def table_of(rows, title="Predictions against measurements"):
    table = Table(title, ["measured", "predicted", "standard error", "fitted", "factor", "source", "likeliest reason of a failure"])
    for row in rows:
        failed = table.verdict(row.predicted, row.gate) == "FAIL"
        table.add(row.what, "-", [row.measured, row.predicted, row.error, row.fitted, row.factor, row.source,
                                  row.why if failed else ""], [None, row.gate, None, None, None, None, None], ".3g")
    return table


def mean_of_all(values):
    """Their mean and its standard error; nothing where one of the starts has no value."""
    if len(known(values)) < len(values):
        return None, None
    return mean(values), standard_error(values)


def text_of_mean(value, error):
    return "missing" if value is None else f"{value:.3g} +/- {error:.2g}"
