"""Numbers as a person reads them: label, unit and digits of every key of result.yaml, also of those not known here."""
import math

from is_number import is_number


class Quantity:
    """How a key is shown. `kind`: of its unit, as units.Units.of takes it."""

    def __init__(self, label, kind=""):
        self.label, self.kind = label, kind


def force(label):
    return Quantity(label, "force")


def length(label):
    return Quantity(label, "length")


def stiffness(label):
    return Quantity(label, "stiffness")


def energy(label):
    return Quantity(label, "J")


# The groups of the results table, in its order.
GROUPS = [
    ("What happened", {
        "motion_pattern": Quantity("Motion pattern"),
        "motion_pattern_confidence": Quantity("Confidence in the motion pattern, from 0 to 1"),
        "failure_mode": Quantity("Failure mode"),
        "ended_by": Quantity("What ended the test"),
        "roller_touched_at": length("Extension from which a roller bore on a knot or its tail"),
        "untangled_at": Quantity("Time at which the knot came undone", "s"),
    }),
    ("Force and extension", {
        "plateau_force": force("Plateau force, the mean while the knots slide"),
        "plateau_force_sd": force("Standard deviation of the plateau force"),
        "plateau_force_low": force("Smallest force within the plateau"),
        "plateau_force_high": force("Largest force within the plateau"),
        "plateau_force_slope": stiffness("Slope of the force over the extension within the plateau"),
        "no_plateau_because": Quantity("Why there is no plateau"),
        "plateau_slope": Quantity("Slope de/ds of the knot distance within the plateau; –\u20602 is rigid sliding"),
        "breakaway_force": force("Breakaway force, the largest before the plateau"),
        "margin_friction": Quantity("Share of the friction coefficient that may be missing before the knots open"),
        "margin_preload": Quantity("Share of the pre-load that may be missing before the knots open"),
        "largest_drop": force("Largest sudden fall of the force before the lock"),
        "largest_drop_at": length("Extension at which it began"),
        "jump_force": force("Force at which a knot jumped open"),
        "jump_extension": length("Extension at which it jumped open"),
        "force_after_jump": force("Force that was left when it had jumped"),
        "first_contact_extension": length("Extension at which the two knots first touch each other"),
        "lock_extension": length("Lock extension, where the motion of the knots shows that they lock"),
        "lock_extension_by_load": length("Lock extension by the load alone, where it last rises through twice the plateau"),
        "locked_stiffness": stiffness("Locked stiffness"),
        "peak_force": force("Peak force"),
        "balance_offset": force("Balance offset, by which the true force is larger than the load"),
        "load_cell_error": force("Error of the load cell at the largest load, by its class"),
        "plateau_load_cell_error": force("Error of the load cell within the plateau, by its class"),
        "break_force": force("Force at break"),
        "break_extension": length("Extension at break"),
        "break_edge": Quantity("Edge that broke, counted along the rod"),
        "break_arclength": length("Place of the break, measured along the rod"),
        "break_place": Quantity("What touched the rod at the place of the break"),
        "energy_to_peak": energy("Energy up to the largest load"),
        "energy_to_break": energy("Energy up to the break"),
        "chord_stiffness": stiffness("Chord stiffness"),
        "secant_stiffness": stiffness("Secant stiffness"),
        "tangent_stiffness": stiffness("Tangent stiffness"),
        "cycles": Quantity("Cycles that were completed"),
        "hysteresis": energy("Energy lost in one cycle (hysteresis)"),
        "hold_force_begin": force("Force at the beginning of the last hold"),
        "hold_force_end": force("Force at the end of the last hold"),
        "relaxation": Quantity("Relaxation, the share of the force that the last hold lost"),
    }),
    ("The knots", {
        "fastest_node": Quantity("Largest speed of a node until the knots lock", "m/s"),
        "preload": force("Pre-load by which each overhand was tied"),
        "tied_knot_distance": length("Knot distance once tied"),
        "excess_length": length("Length of rod within each knot once tied"),
        "final_excess_length": length("Length of rod within each knot at the end"),
    }),
    ("Energy of the pull", {
        "work": energy("Work of the grips"),
        "stored_energy": energy("Energy stored in rod and contacts"),
        "kinetic_energy": energy("Kinetic energy"),
        "friction_loss": energy("Energy lost to friction"),
        "drag_loss": energy("Energy lost to drag"),
        "numerical_dissipation": energy("Energy lost in the time steps (numerical dissipation)"),
        "reweighting_loss": energy("Energy lost as the weights of contacts change"),
        "drag_share": Quantity("Share of drag in the force"),
        "inertia_share": Quantity("Share of inertia in the force"),
        "numerical_share": Quantity("Share of numerical dissipation in the force"),
    }),
    ("The computation", {
        "steps": Quantity("Time steps"),
        "rejected_steps": Quantity("Time steps that were made again, shorter"),
        "newton_iterations": Quantity("Iterations of Newton's method"),
        "simulated_time": Quantity("Duration of the test", "s"),
        "wall_time": Quantity("Duration of the computation", "s"),
        "real_time_factor": Quantity("Duration of the test over that of the computation"),
        "peak_memory": Quantity("Largest memory in use", "memory"),
        "seed": Quantity("Seed of the load cell's noise"),
        "version": Quantity("Version of knot_utm"),
    }),
]
KNOWN = {key: quantity for _, group in GROUPS for key, quantity in group.items()}

# The unit of a key that is not known here, by how it ends: names of quantities are the field's.
ENDINGS = [("_force", "force"), ("_load", "force"), ("_extension", "length"), ("_distance", "length"),
           ("_length", "length"), ("_displacement", "length"), ("_stiffness", "stiffness"), ("_energy", "J"),
           ("_work", "J"), ("_loss", "J"), ("_time", "s"), ("_at", "s"), ("_duration", "s")]


def quantity_of(key):
    if key in KNOWN:
        return KNOWN[key]
    label = key.replace("_", " ").capitalize()
    for ending, kind in ENDINGS:
        if ("_" + key).endswith(ending):
            return Quantity(label, kind)
    return Quantity(label)


def shown(value, scale=1.0, error=None):
    """A value of any kind as text. A number has four digits, or as many as its error leaves meaningful."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int) and scale == 1.0:
        return str(value)
    if isinstance(value, (int, float)):
        return number(value * scale, None if error is None else error * scale)
    if isinstance(value, dict):
        return ", ".join(f"{name.replace('_', ' ')} {shown(part)}" for name, part in value.items()) or "–"
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
    """With two digits."""
    return number(float(f"{error * scale:.1e}")) if is_number(error) else ""


def with_unit(value, unit, error=None):
    return f"{shown(value, unit.scale, error)} {unit.name}".strip()
