"""What the program says in sentences, in the units of a page: it speaks of newtons and metres."""
import re

from knot_utm.report.quantities import number

KINDS = {"N": "force", "m": "length", "N/m": "stiffness", "m/s": "speed"}
NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
# "0.41 N", "from 5 to 2.5 N", "0.41 and 0.067 N"; no number that is a part of a word, and no unit that goes on.
VALUES = re.compile(rf"(?<![\w.])({NUMBER})(?:( and | to )({NUMBER}))? (N/m|m/s|N|m)(?![\w/²³^])")


def in_units(text, units):
    def replaced(found):
        unit = units.of(KINDS[found[4]])
        values = [number(float(value) * unit.scale) for value in (found[1], found[3]) if value]
        return f"{(found[2] or '').join(values)} {unit.name}"

    return VALUES.sub(replaced, text)


def all_in_units(texts, units):
    return [in_units(text, units) for text in texts]
