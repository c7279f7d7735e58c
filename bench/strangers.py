"""Tests of fisherman's loops drawn at random, which nobody tuned anything on: what scripts/bench readings judges."""
import math

from draws import PAPER_RADIUS, Draw, significant

SIZES = [0.0005, PAPER_RADIUS, 0.016]  # radii of a thread, of the paper's ropes and of a hawser [m]
RODS = {"limp braid": (1e4, 5e4), "stiff braid": (1e3, 1e4), "cable": (10.0, 1e3), "solid": (4.0, 4.0)}  # k_s h^2/k_b
HARDEST = 50.0                         # pre-load [k_b/h^2]
DISTANCE = (0.11, 0.19)                # e for the paper's radius [m]
LONGEST_LOOP = 2.0                     # L for the paper's radius [m]
CLEARANCE = 26.0                       # L - e by which coils clear rollers of the default size [h]


class Stranger(Draw):
    """A loop. A rod that stretches is not tied with more than doubles its length."""

    def draw(self):
        rod = self.choice("rod", list(RODS))
        h = self.radius = self.choice("radius", SIZES)
        stretching = self.log_uniform("stretching", *RODS[rod])
        force = self.force = self.log_uniform("bending_force", 0.1, 20.0)
        self.preload = self.log_uniform("preload", 2.0, min(HARDEST, stretching))
        friction = self.uniform("friction_coefficient", 0.2, 0.9)
        bending = significant(force * h ** 2)
        self.settings["material"] = {
            "radius": h, "density": self.uniform("density", 800.0, 1400.0),
            "stretching_stiffness": significant(stretching * force), "bending_stiffness": bending,
            "twisting_stiffness": bending, "friction_coefficient": friction}
        scale = h / PAPER_RADIUS
        distance = self.uniform("knot_distance", *DISTANCE)
        length = self.log_uniform("end_to_end", distance + CLEARANCE * PAPER_RADIUS, LONGEST_LOOP)
        self.settings.update({
            "specimen.handedness": self.choice("handedness", ["same", "opposite"]),
            "specimen.preload": significant(self.preload * force),
            "specimen.knot_distance": significant(distance * scale),
            "specimen.end_to_end": significant(length * scale),
        })
        if rod == "solid":
            self.values["stretching"] = 4.0

    def unit_of(self, key):
        """In which the reading of this key does not depend on the size [N, m or N/m]."""
        return {"plateau_force": self.force, "lock_extension": self.radius}.get(key, self.force / self.radius)

    def title(self):
        v = self.values
        return (f"{self.number}: {v['rod']}, h {1e3 * v['radius']:.3g} mm, {v['handedness']} hands, mu "
                f"{v['friction_coefficient']:.2f}, F_p h^2/k_b {v['preload']:.3g}, e/h "
                f"{v['knot_distance'] / PAPER_RADIUS:.3g}, L/h {v['end_to_end'] / PAPER_RADIUS:.3g}")
