"""The rod's own units: with its radius h and its bending stiffness k_b every quantity is a number, as the source paper's groups
are (doc/studies.md).

    unit      of            groups
    h         lengths       e/h
    k_b/h2    forces        F_p h^2/k_b, k_s h^2/k_b, F h^2/k_b
    k_b/h3    stiffnesses   of a loop, N/m
    k_b       bending       k_t/k_b
    k_b/h     energies
"""
import json

from knot_utm import tool
from knot_utm.errors import refuse_if, WrongInput
from knot_utm.yaml_text import is_number, require, value_of

# {unit of the rod: (SI unit, powers of k_b and h)}
UNITS = {"h": ("m", 0, 1), "k_b/h2": ("N", 1, -2), "k_b/h3": ("N/m", 1, -3), "k_b": ("N m2", 1, 0), "k_b/h": ("J", 1, -1)}
OF_THE_ROD = ("material.radius", "material.bending_stiffness")  # what the units are made of


def asked(vary):
    """{key: unit} of the keys whose values a study gives in a unit of the rod. Raises WrongInput."""
    units = {key: values["unit"] for key, values in vary.items() if isinstance(values, dict) and "unit" in values}
    for key, unit in units.items():
        require(isinstance(unit, str) and unit in UNITS, f"vary.{key}.unit", unit, ", ".join(UNITS))
        refuse_if(key in OF_THE_ROD, f"vary.{key}.unit is {unit}, but the units of a rod follow from this key")
    return units


def in_si(method, points, units):
    """The points, with the values of `units` in the units of the method, which follow from the rod of each point."""
    if not units:
        return points
    known = tool.key_units(method, {key: value for key, value in points[0].items() if key not in units})
    for key, unit in units.items():
        if known.get(key, "-") not in ("-", UNITS[unit][0]):
            raise WrongInput(f"vary.{key}.unit is {unit}, but this key is in {known[key]}")
    rods, found = {}, []
    for point in points:
        material = {key: value for key, value in point.items() if key.split(".")[0] == "material" and key not in units}
        name = json.dumps(material, sort_keys=True, default=str)
        if name not in rods:
            given = [material.get(key) for key in reversed(OF_THE_ROD)]
            rods[name] = given if all(map(is_number, given)) else rod_of(value_of(tool.resolved(method, material)))
        found.append({key: value * scale(units[key], rods[name]) if key in units and is_number(value) else value
                      for key, value in point.items()})
    return found


def rod_of(method):
    """(k_b, h) of a method with every value."""
    return method["material"]["bending_stiffness"], method["material"]["radius"]


def scale(unit, rod):
    """How much one unit of a rod (k_b, h) is in SI units."""
    _, of_stiffness, of_radius = UNITS[unit]
    return rod[0] ** of_stiffness * rod[1] ** of_radius


def dimensionless(table, rods):
    """A table in the units of each row's rod. `table`: of knot_utm.sweep; `rods`: (k_b, h) of its rows. What has another
    dimension stays, and so do k_b and h themselves."""
    out = table.copy()
    out.attrs["units"] = dict(table.attrs["units"])
    for unit, (si, _, _) in UNITS.items():
        scales = [scale(unit, rod) for rod in rods]
        for column in out:
            if column not in OF_THE_ROD and table.attrs["units"][column] == si and out[column].dtype.kind in "if":
                out[column] = out[column] / scales
                out.attrs["units"][column] = unit
    return out
