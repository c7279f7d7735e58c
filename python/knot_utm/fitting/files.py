"""What a fit leaves in its folder."""
import os

import yaml

from knot_utm.fitting.verdict import short


def write_fit(folder, fitted, methods, command=None):
    """fit.yaml, and method.yaml, of further records method_2.yaml and so on. `methods`: their texts."""
    os.makedirs(folder, exist_ok=True)
    _replace(folder, "fit.yaml", yaml.safe_dump(summary(fitted), sort_keys=False, allow_unicode=True, width=1000))
    for number, text in enumerate(methods, start=1):
        _replace(folder, "method.yaml" if number == 1 else f"method_{number}.yaml", text)


def summary(fitted):
    """The map of fit.yaml."""
    found = {key: {"value": one.value, "low": one.low, "high": one.high, "identifiable": one.identifiable}
             for key, one in fitted.found.items()}
    return {**found, "rms": short(fitted.rms),
            "correlation": {key: {other: round(value, 4) for other, value in row.items()} for key, row in fitted.correlation.items()},
            "fits": fitted.fits, "chi_square": short(fitted.chi_square), "degrees_of_freedom": fitted.degrees_of_freedom,
            "notes": fitted.notes}


def _replace(folder, name, text):
    path = os.path.join(folder, name)
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)
