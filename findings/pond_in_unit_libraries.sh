#!/bin/bash
# Units in which ropes, yarns and old machines state their force, in five libraries of units.
#
# The pond is the weight of a gram, 0.00980665 N; the kilopond that of a kilogram. Older European load cells and catalogues state them.
# A yarn's strength is in grams per denier (of force; 1 den = 1 g in 9 km), webbing's in pounds per inch of width (pli).
#
# Guessed: whoever knows the pond has 0.0098 N; the ton-force is the same or unknown; g/denier and pli are unknown, and said to be.
# Seen: pint 0.19.2 calls a pond 9.80665 N, so that its kilopond is 9,806.65 N: a thousand times too much. GNU units 2.22 and UDUNITS 2.2.28 have
# it right; mathjs 15.2.0 and js-quantities 1.8.0 do not know it. "pli" is a picolink in pint, a length of 2.0e-13 m, and a mass per length in
# GNU units, whose lb is no force. "g/denier" is a length of 9 km in all that know it, not 88,260 N m/kg. tonf is the American short one,
# 8,896.44 N, in GNU units and unknown elsewhere, while pint's tf is the metric one, 9,806.65 N.
# Why it matters: a record in kiloponds read with pint is wrong by 1,000 without a word. Convert forces by kgf and lbf, on which all agree that
# know them.
#
# usage: findings/pond_in_unit_libraries.sh
# It loads Debian and npm packages into a temporary folder, needs node, installs nothing, and ends with 1 where one of them does otherwise.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get -qq download units=2.22-2 python3-pint=0.19.2-1 udunits-bin=2.2.28-5 libudunits2-0=2.2.28-5 libudunits2-data=2.2.28-5 2>/dev/null
for package in *.deb; do dpkg -x "$package" tree; done
npm install --silent --no-audit --no-fund --prefix . mathjs@15.2.0 js-quantities@1.8.0
cp tree/usr/share/units/definitions.units .
touch currency.units cpi.units
export LD_LIBRARY_PATH=tree/usr/lib/x86_64-linux-gnu
cat > javascript.mjs <<'JS'
import { unit } from "mathjs";
import Qty from "js-quantities";
const values = {};
for (const name of process.argv.slice(2)) {
  for (const base of ["N", "m", "kg/m"]) {
    try { values[`mathjs ${name} ${base}`] = unit(1, name).toNumber(base); } catch { /* unknown, or of another dimension */ }
    try { values[`js-quantities ${name} ${base}`] = Qty(`1 ${name}`).to(base).scalar; } catch { /* likewise */ }
  }
}
console.log(JSON.stringify(values));
JS
PYTHONPATH=tree/usr/lib/python3/dist-packages /usr/bin/python3 -W ignore - <<'PYTHON'
import json
import re
import subprocess
import pint

registry = pint.UnitRegistry()


def said(*command):
    return subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False).stdout


asked = ("pond", "kilopond", "kgf", "lbf", "tonf", "tf", "pli", "g/denier")
by_javascript = json.loads(said("node", "javascript.mjs", *asked))
libraries = {
    f"pint {pint.__version__}": lambda name, base: registry.parse_expression(name).to(base).magnitude,
    "GNU units 2.22": lambda name, base: said("tree/usr/bin/units", "-t", "-o%.10g", "-f", "definitions.units", name, base),
    "UDUNITS 2.2.28": lambda name, base: re.search(r"= ([-+.\de]+) ", said(
        "tree/usr/bin/udunits2", "-A", "-H", name, "-W", base, "tree/usr/share/xml/udunits/udunits2.xml"))[1],
    "mathjs 15.2.0": lambda name, base: by_javascript[f"mathjs {name} {base}"],
    "js-quantities 1.8.0": lambda name, base: by_javascript[f"js-quantities {name} {base}"],
}


def in_base(library, name):
    """The unit in the first base that the library converts it to."""
    for base in ("N", "m", "kg/m"):
        try:
            return f"{float(libraries[library](name, base)):.6g} {base}"
        except (KeyError, ValueError, TypeError, pint.errors.PintError):
            pass
    return "unknown"


seen = {name: [in_base(library, name) for library in libraries] for name in asked}
unknown = "unknown"
expected = {
    "pond": ["9.80665 N", "0.00980665 N", "0.00980665 N", unknown, unknown],
    "kilopond": ["9806.65 N", "9.80665 N", "9.80665 N", unknown, unknown],
    "kgf": ["9.80665 N", "9.80665 N", "9.80665 N", "9.80665 N", unknown],
    "lbf": ["4.44822 N"] * 5,
    "tonf": [unknown, "8896.44 N", unknown, unknown, unknown],
    "tf": ["9806.65 N", unknown, unknown, unknown, unknown],
    "pli": ["2.01168e-13 m", "17.858 kg/m", unknown, unknown, unknown],
    "g/denier": ["9000 m", "9000 m", "9000 m", unknown, unknown],
}
print(" | ".join(libraries))
for name, values in seen.items():
    print(f"{name}: {' | '.join(values)}" + ("" if values == expected.get(name) else f"   expected {expected.get(name)}"))
raise SystemExit(seen != expected)
PYTHON
