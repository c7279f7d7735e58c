"""What a fit leaves in its folder."""
import os

import yaml

DIGITS = 6


def write_fit(folder, fitted, methods, command=None):
    """fit.yaml, and method.yaml, of further records method_2.yaml and so on. `methods`: their texts."""
    os.makedirs(folder, exist_ok=True)
    _replace(folder, "fit.yaml", yaml.safe_dump(summary(fitted), sort_keys=False, allow_unicode=True, width=1000))
    for number, text in enumerate(methods, start=1):
        _replace(folder, "method.yaml" if number == 1 else f"method_{number}.yaml", text)


def summary(fitted):
    """The map of fit.yaml. Numbers have the digits that mean something."""
    found = {key: {"value": _short(one.value), "low": _short(one.low), "high": _short(one.high), "identifiable": one.identifiable}
             for key, one in fitted.found.items()}
    return {**found, "rms": _short(fitted.rms),
            "correlation": {key: {other: round(value, 4) for other, value in row.items()} for key, row in fitted.correlation.items()},
            "fits": fitted.fits, "chi_square": _short(fitted.chi_square), "degrees_of_freedom": fitted.degrees_of_freedom,
            "notes": fitted.notes}


def _short(value):
    return None if value is None else float(f"{value:.{DIGITS}g}")


def _replace(folder, name, text):
    path = os.path.join(folder, name)
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)
