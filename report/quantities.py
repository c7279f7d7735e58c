"""Numbers as a person reads them: label, unit and digits of every key of result.yaml, also of those not known here."""
import math

from run import is_number


class Quantity:
    """How a key is shown: its value times `scale` has `unit`."""

    def __init__(self, label, unit="", scale=1.0):
        self.label, self.unit, self.scale = label, unit, scale


def force(label):
    return Quantity(label, "N")


def length(label):
    return Quantity(label, "mm", 1e3)


def stiffness(label):
    return Quantity(label, "N/mm", 1e-3)


def energy(label):
    return Quantity(label, "J")


# The groups of the results table, in its order.
GROUPS = [
    ("What happened", {
        "motion_pattern": Quantity("Motion pattern"),
        "motion_pattern_confidence": Quantity("Confidence in it, 0 to 1"),
        "failure_mode": Quantity("Failure mode"),
        "ended_by": Quantity("Ended by"),
        "reason": Quantity("Reason"),
        "untangled_at": Quantity("Untangled at", "s"),
    }),
    ("Force and extension", {
        "plateau_force": force("Plateau force, mean while the knots slide"),
        "plateau_slope": Quantity("Slope de/ds of the knot distance there; –2: rigid sliding"),
        "breakaway_force": force("Breakaway force, largest before the plateau"),
        "lock_extension": length("Lock extension, where sliding turns into stretching"),
        "locked_stiffness": stiffness("Locked stiffness; of the whole pull where nothing locks"),
        "peak_force": force("Peak force"),
        "load_cell_error": force("How far the cell may be off at the peak"),
        "plateau_load_cell_error": force("How far the cell may be off in the plateau"),
        "break_force": force("Force at break"),
        "break_extension": length("Extension at break"),
        "break_edge": Quantity("Edge that broke, counted along the rod"),
        "break_arclength": length("Place of the break, along the rod"),
        "break_place": Quantity("What that place touched"),
        "energy_to_peak": energy("Energy to the peak"),
        "energy_to_break": energy("Energy to break"),
        "chord_stiffness": stiffness("Chord stiffness"),
        "secant_stiffness": stiffness("Secant stiffness"),
        "tangent_stiffness": stiffness("Tangent stiffness"),
        "hysteresis": energy("Hysteresis of a cycle"),
        "hold_force_begin": force("Force where the last hold begins"),
        "hold_force_end": force("Force where it ends"),
        "relaxation": Quantity("Relaxation: share of the force lost in it"),
        "balance_offset": force("Balance offset: true force = load + this"),
    }),
    ("The knots", {
        "preload": force("Pre-load on each overhand"),
        "tied_knot_distance": length("Knot distance once tied"),
        "excess_length": length("Rod hidden in each knot once tied"),
        "final_excess_length": length("Rod hidden in each knot at the end"),
    }),
    ("Energy of the pull", {
        "work": energy("Work of the grips"),
        "stored_energy": energy("Stored in rod and contacts"),
        "kinetic_energy": energy("Kinetic"),
        "friction_loss": energy("Lost to friction"),
        "drag_loss": energy("Lost to drag"),
        "numerical_dissipation": energy("Lost in the time steps"),
        "reweighting_loss": energy("Lost as weights of contacts change"),
    }),
    ("The computation", {
        "steps": Quantity("Time steps"),
        "rejected_steps": Quantity("Time steps thrown away"),
        "newton_iterations": Quantity("Iterations of Newton's method"),
        "simulated_time": Quantity("Time of the test", "s"),
        "wall_time": Quantity("Time of the machine", "s"),
        "real_time_factor": Quantity("Their ratio"),
        "peak_memory": Quantity("Memory at most", "MB", 1e-6),
        "seed": Quantity("Seed of the load cell's noise"),
        "version": Quantity("Version of knot_utm"),
    }),
]
KNOWN = {key: quantity for _, group in GROUPS for key, quantity in group.items()}

# The unit of a key that is not known here, by how it ends: names of quantities are the field's.
ENDINGS = [("_force", "N", 1.0), ("_load", "N", 1.0), ("_extension", "mm", 1e3), ("_distance", "mm", 1e3),
           ("_length", "mm", 1e3), ("_displacement", "mm", 1e3), ("_stiffness", "N/mm", 1e-3), ("_energy", "J", 1.0),
           ("_work", "J", 1.0), ("_loss", "J", 1.0), ("_time", "s", 1.0), ("_at", "s", 1.0), ("_duration", "s", 1.0)]


def quantity_of(key):
    if key in KNOWN:
        return KNOWN[key]
    label = key.replace("_", " ").capitalize()
    for ending, unit, scale in ENDINGS:
        if ("_" + key).endswith(ending):
            return Quantity(label, unit, scale)
    return Quantity(label)


def shown(value, scale=1.0, error=None):
    """A value of any kind as text. Of a number four digits, or as many as its error leaves sense to."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int) and scale == 1.0:
        return str(value)
    if isinstance(value, (int, float)):
        return number(value * scale, None if error is None else error * scale)
    if isinstance(value, dict):
        return ", ".join(f"{name.replace('_', ' ')} {shown(part, quantity_of(name).scale)} "
                         f"{quantity_of(name).unit}".strip() for name, part in value.items()) or "–"
    if isinstance(value, (list, tuple)):
        return "; ".join(shown(part, scale) for part in value) or "–"
    return str(value)


def number(value, error=None):
    if not math.isfinite(value):
        return "–"
    if value == 0.0:
        return "0"
    decimals = 3 - math.floor(math.log10(abs(value)))
    if error is not None and is_number(error) and error > 0.0:
        decimals = 1 - math.floor(math.log10(error))
    if -3 < decimals <= 7 or (error is not None and decimals <= 7):
        text = f"{value:.{max(decimals, 0)}f}"
        text = text.rstrip("0").rstrip(".") if error is None and "." in text else text
        return text.replace("-", "–")
    mantissa, exponent = f"{value:.3e}".split("e")
    return f"{mantissa.rstrip('0').rstrip('.')} · 10{superscript(int(exponent))}".replace("-", "–")


def superscript(exponent):
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def error_shown(error, scale):
    """Two digits."""
    return number(float(f"{error * scale:.1e}")) if is_number(error) else ""
