"""Overhands that invert as they are pulled: how far apart their ends are then, against photographs."""
from predictions import CPU_LIMIT, STARTS, Row, mean_of_all
from runs import read_yaml
from table import within


def rows(runner, facts):
    return [row_of(name, photographs, facts, [inverted_at(run_of(runner, name, factor)) for factor in STARTS])
            for name, photographs in facts["photographs"].items()]


def run_of(runner, name, factor):
    method = f"config/validation/{name}.yaml"
    apart = read_yaml(method)["specimen"]["end_to_end"]
    return runner.run(f"{name}/{factor:g}", {"specimen.end_to_end": round(apart * factor, 9)}, method, cpu_limit=CPU_LIMIT)


def inverted_at(run):
    """Distance of the ends at the snap over the length of the rod; None where nothing snapped."""
    snapped, apart = run.reading("snap_extension"), run.reading("gauge_length")
    return None if snapped is None or apart is None else (apart + snapped) / run.method["specimen"]["length"]


def row_of(name, photographs, facts, values):
    low, high = photographs
    value, error = mean_of_all(values)
    middle = (low + high) / 2
    return Row(f"{facts['what']}: {name.split('_')[-1]} turns", f"{low:g} to {high:g}", value, error,
               None if value is None else value / middle, within(low - facts["margin"], high + facts["margin"]), facts["source"])
