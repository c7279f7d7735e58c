"""The units of a page: files are in SI, a page is in what its reader measures with."""
FORCES = {"N": 1.0, "kN": 1e-3, "lbf": 1.0 / 4.4482216152605}
LENGTHS = {"mm": 1e3, "in": 1.0 / 0.0254, "m": 1.0}


class Unit:
    """A value in SI times `scale` has the unit `name`."""

    def __init__(self, name, scale=1.0):
        self.name, self.scale = name, scale


class Units:
    def __init__(self, force="N", length="mm"):
        self.force, self.length = Unit(force, FORCES[force]), Unit(length, LENGTHS[length])
        self.stiffness = Unit(f"{force}/{length}", self.force.scale / self.length.scale)
        self.speed = Unit(f"{length}/s", self.length.scale)
        self.force_rate = Unit(f"{force}/s", self.force.scale)
        self.rate = Unit(f"{length}/min", 60.0 * self.length.scale)
        self.memory = Unit("MB", 1e-6)
        self.percent = Unit("%", 100.0)
        self.are_default = (force, length) == ("N", "mm")

    def of(self, kind):
        """`kind`: one of the quantities above, else the name of a unit that every page uses."""
        return getattr(self, kind) if kind in ("force", "length", "stiffness", "speed", "force_rate", "memory",
                                               "percent") else Unit(kind)


def units_of(report):
    """Those that `report` of a method asks for."""
    asked = report.get("units") or {}
    return Units(asked.get("force", "N"), asked.get("length", "mm"))
