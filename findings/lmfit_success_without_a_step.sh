#!/bin/bash
# A stiffness fitted by lmfit to a record that another program wrote with six digits, or from a start that lies on its bound.
#
# The record is a straight line of slope 3 with a small ripple, the one free parameter its slope, the start 1.
#
# Guessed: both fits end near 3; conf_interval gives the range of the one parameter.
# Seen, with Debian 12's python3-lmfit 1.1.0-1 (and SciPy 1.10.1), the default method leastsq: as soon as the model's values have six digits,
# as those read from a file do, the fit ends after 2 runs at its start, 1, and `success` is True; only `errorbars` is False, and the message
# says that a variable did not affect the fit. Its steps for derivatives are 1.5e-8 of the value, less than a digit. The same where the start
# lies on a lower bound (min=1): the bound is taken in by a square root whose slope is 0 there. With a bound on both sides it gets to 3.
# With epsfcn=1e-4, or with method="least_squares" for the bound, both are well. conf_interval refuses a fit with one parameter: fewer than 2.
# Why it matters: friction and stiffness are fitted with min=0 and simulations are read from files. Whoever checks `success` alone reports the
# start as the result. Check `errorbars` as well, begin off the bound, and make epsfcn as large as the digits ask for.
#
# usage: findings/lmfit_success_without_a_step.sh
# It loads Debian packages into a temporary folder, needs python3-scipy, installs nothing, and ends with 1 where lmfit does otherwise.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get -qq download python3-lmfit=1.1.0-1 python3-asteval=0.9.28-1 python3-uncertainties=3.1.6-1 python3-future 2>/dev/null
for package in *.deb; do dpkg -x "$package" tree; done
PYTHONPATH=tree/usr/lib/python3/dist-packages /usr/bin/python3 -W ignore - <<'PYTHON'
import lmfit
import numpy
import scipy

x = numpy.linspace(0, 1, 20)
measured = 3 * x + 0.01 * numpy.sin(50 * x)


def exact(params):
    return params["slope"] * x - measured


def six_digits(params):
    return numpy.array([float(f"{value:.6g}") for value in params["slope"] * x]) - measured


def fit(model, limits=None, **how):
    params = lmfit.Parameters()
    params.add("slope", value=1.0, **(limits or {}))
    result = lmfit.minimize(model, params, **how)
    return round(result.params["slope"].value, 1), result.success, result.errorbars


def interval(model):
    params = lmfit.Parameters()
    params.add("slope", value=1.0)
    minimizer = lmfit.Minimizer(model, params)
    try:
        return lmfit.conf_interval(minimizer, minimizer.minimize())
    except Exception as error:
        return f"{type(error).__name__}: {error}"


seen = {
    "version": lmfit.__version__,
    "exact": fit(exact),
    "six digits": fit(six_digits),
    "six digits, epsfcn=1e-4": fit(six_digits, epsfcn=1e-4),
    "start on min": fit(exact, {"min": 1.0}),
    "start on min, max too": fit(exact, {"min": 1.0, "max": 10.0}),
    "start on min, least_squares": fit(exact, {"min": 1.0}, method="least_squares"),
    "conf_interval of one": interval(exact),
}
expected = {
    "version": "1.1.0",
    "exact": (3.0, True, True),
    "six digits": (1.0, True, False),
    "six digits, epsfcn=1e-4": (3.0, True, True),
    "start on min": (1.0, True, False),
    "start on min, max too": (3.0, True, True),
    "start on min, least_squares": (3.0, True, True),
    "conf_interval of one": "MinimizerException: Cannot determine Confidence Intervals with < 2 variables",
}
print(f"SciPy {scipy.__version__}; each fit: slope (3 is right), success, errorbars")
for key, value in seen.items():
    print(f"{key}: {value}" + ("" if value == expected[key] else f"   expected {expected[key]}"))
raise SystemExit(seen != expected)
PYTHON
