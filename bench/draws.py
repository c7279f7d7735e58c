"""Tests drawn at random over everything that a method may say: what scripts/stress runs."""
import math
import random

import numpy as np

PAPER_RADIUS, PAPER_SPEED, PAPER_TYING = 3.175e-3, 3.3e-3, 0.01  # [m, m/s, m/s] of config/tighten.yaml
FASTEST = 0.5          # [m/s] that a method allows
LONGEST_PULL = 300.0   # [s] of simulated time
KNOTS = {"fisherman": 11, "overhand": 5, "file": 3, "straight": 1}  # of twenty
QUICK_KNOTS = {"fisherman": 4, "overhand": 8, "file": 6, "straight": 2}
SHAPES = ["arch", "helix", "figure_eight"]                          # of knot: file
METHODS = {"fisherman": "config/tighten.yaml", "overhand": "config/overhand.yaml", "straight": "config/straight.yaml",
           "file": "config/from_file.yaml"}


class Draw:
    """One test: the same for the same seed and number, however many others are drawn.

    All lengths are drawn in radii h. Speed x1 is the source paper's, 1.04 h/s; a pull of x0.1 and x30 takes the same
    way. Loads are drawn in k_b/h^2."""

    def __init__(self, seed, number, quick=False):
        self.seed, self.number, self.quick = seed, number, quick
        # The order of the draws is part of the seed's meaning.
        self.random = random.Random(f"{seed} {number} {quick}")
        self.values = {}
        self.settings = {}
        self.shape = None
        self.draw()

    # ---- kinds of draws, each kept for the table ---------------------------------------------------------------------

    def keep(self, name, value):
        self.values[name] = value
        return value

    def choice(self, name, options):
        return self.keep(name, self.random.choice(options))

    def uniform(self, name, low, high):
        return self.keep(name, significant(self.random.uniform(low, high)))

    def log_uniform(self, name, low, high):
        return self.keep(name, significant(math.exp(self.random.uniform(math.log(low), math.log(high)))))

    # ---- the test ----------------------------------------------------------------------------------------------------

    def draw(self):
        knots = QUICK_KNOTS if self.quick else KNOTS
        knot = self.keep("knot", self.random.choices(list(knots), knots.values())[0])
        self.draw_material()
        self.draw_physics()
        edge = self.uniform("edge_length", 0.8 if self.quick else 0.5, 2.0)
        factor = self.log_uniform("speed", 0.1, 30.0)
        self.speed = factor * PAPER_SPEED / PAPER_RADIUS * self.radius
        self.settings["specimen.edge_length"] = significant(edge * self.radius)
        {"fisherman": self.draw_fisherman, "overhand": self.draw_overhand, "straight": self.draw_straight,
         "file": self.draw_file}[knot]()
        self.settings["machine.load_cell"] = {
            "capacity": significant(500.0 * self.force), "sampling_rate": significant(2.0 * self.speed / self.radius)}
        if self.settings.get("physics.friction.law") == "smoothed":
            creep = self.log_uniform("slip_tolerance", 0.03, 1.0)
            self.settings["physics.friction.slip_tolerance"] = significant(min(max(creep * self.speed, 1e-7), 0.1))

    def draw_material(self):
        h = self.radius = self.log_uniform("radius", 0.3e-3, 6e-3)
        bending = self.log_uniform("bending_stiffness", 1e-7, 1e-3)
        stretching = self.log_uniform("stretching", 4.0, 3e4)
        density = self.uniform("density", 500.0, 2000.0)
        self.force = bending / h ** 2
        self.settings["material"] = {
            "radius": h, "density": density, "stretching_stiffness": significant(stretching * self.force),
            "bending_stiffness": bending,
            "twisting_stiffness": significant(bending * self.uniform("twisting", 0.15, 1.0)),
            "friction_coefficient": self.uniform("friction_coefficient", 0.0, 1.5)}
        # Half of them with friction at the surface: strands roll and twist.
        self.settings["material"]["friction_couple"] = 0.0
        if self.choice("friction_at_surface", [False, True]):
            self.settings["material"]["friction_couple"] = 1.0
        self.keep("bending_time", significant(h ** 2 * math.sqrt(density * math.pi * h ** 2 / bending)))

    def draw_physics(self):
        for key, options in {"friction.law": ["memory", "smoothed"], "twist": ["auto", "on", "off"],
                             "accuracy": ["draft", "normal"] if self.quick else ["draft", "normal", "fine"]}.items():
            self.settings["physics." + key] = self.choice(key, options)
        if self.settings["physics.twist"] == "off" and self.settings["material"]["friction_couple"] > 0.0:
            self.settings["physics.friction.at"] = "centreline"
        self.draw_laws()

    def draw_laws(self):
        """Those of ropes and silicones. They have random numbers of their own, so that all other draws stay as they were."""
        others, self.random = self.random, random.Random(f"laws {self.seed} {self.number} {self.quick}")
        material = self.settings["material"]
        rolls = material["friction_couple"] > 0.0 and "physics.friction.at" not in self.settings
        on_frames = self.settings["physics.twist"] != "off"
        if on_frames and self.random.random() < 0.5:
            material.update(bending_law="frictional", friction_moment=self.log_uniform("friction_moment", 0.01, 0.5),
                            stick_ratio=self.log_uniform("stick_ratio", 1.5, 60.0),
                            compaction=self.log_uniform("compaction", 1e-4, 1e-2))
        if rolls and self.random.random() < 0.5:
            material["rolling_resistance"] = self.log_uniform("rolling_resistance", 0.01, 0.5)
        if rolls and self.random.random() < 0.5:  # a silicone
            material.update(section="soft", stretching_law="neo_hookean", stretching_stiffness=significant(4.0 * self.force))
            self.keep("stretching", 4.0)
        if self.settings["physics.friction.law"] == "memory" and self.random.random() < 0.3:
            self.settings.update({"physics.friction.law": self.keep("friction.law", "rate"),
                                  "physics.friction.rate": self.log_uniform("rate", 0.01, 0.3),
                                  "physics.friction.rate_speed": self.log_uniform("rate_speed", 1e-7, 1e-3)})
        self.random = others

    def draw_fisherman(self):
        # The smallest of each do not fit, and are refused.
        distance = self.uniform("knot_distance", 24.0, 80.0)
        roller = self.uniform("roller_diameter", 5.0, 30.0)
        room = self.uniform("room", 12.0, 60.0)
        specimen = {"handedness": self.choice("handedness", ["same", "opposite"]), "knot_distance": distance,
                    "end_to_end": distance + roller + room, "tail": self.uniform("tail", 6.0, 15.0)}
        for key, value in specimen.items():
            length = key != "handedness"
            self.settings["specimen." + key] = significant(value * self.radius) if length else value
        self.settings["specimen.preload"] = significant(self.log_uniform("preload", 0.2, 8.0) * self.force)
        self.settings["machine.roller_diameter"] = significant(roller * self.radius)
        grips = self.settings["machine.grips"] = self.choice("grips", ["rollers", "nodes", "clamps"])
        if grips == "rollers":
            self.settings["machine.roller_friction"] = self.choice("roller_friction", [0.0, 0.0, 0.3])
        # As much faster than the pull as in the paper's test; a pre-load of 90 s of patience is not to be crept to.
        tying = max(self.speed * PAPER_TYING / PAPER_SPEED, PAPER_TYING / PAPER_RADIUS * self.radius)
        self.set_program([{"tie": {"speed": significant(min(tying, FASTEST))}}, {"release": {"duration": 3.0}},
                          {"mount": {"speed": significant(self.speed)}}, {"balance": {}}], 5.0, 25.0)

    def draw_overhand(self):
        turns = self.choice("turns", [1, 2, 3])
        loop = self.uniform("loop_radius", 2.0, 15.0)
        # As specimen/overhand.cpp lays it: two strands wound around each other, their ends joined by a loop.
        full_turns = turns + 0.5
        braid = full_turns * max(2.0 * math.pi * 12.0 ** 0.25 * math.sqrt(loop), 4.0 * math.pi)
        excess = 2.0 * math.hypot(braid, 2.0 * math.pi * full_turns * 1.3) + 2.0 * math.pi * loop
        end_to_end = braid + self.uniform("room", 5.0, 80.0)
        self.settings["specimen.turns"] = turns
        self.settings["specimen.length"] = significant(max((end_to_end + excess) * self.radius, 0.01))
        self.settings["specimen.end_to_end"] = significant(end_to_end * self.radius)
        self.settings["machine.grips"] = self.choice("grips", ["nodes", "clamps"])
        self.set_program([{"balance": {}}, {"hold": {"duration": 2.0}}], 0.3 * excess, 0.9 * excess)

    def draw_straight(self):
        length = max(self.uniform("length", 20.0, 100.0) * self.radius, 0.01)
        self.settings["specimen.length"] = significant(length)
        self.settings["machine.grips"] = self.choice("grips", ["nodes", "clamps"])
        self.set_program([{"balance": {}}], 0.5, 0.3 * length / self.radius)

    def draw_file(self):
        name = self.choice("shape", SHAPES)
        self.settings["machine.grips"] = self.choice("grips", ["nodes", "clamps"])
        self.shape = self.radius * {"arch": self.arch, "helix": self.helix, "figure_eight": self.figure_eight}[name]()
        self.set_program([{"balance": {}}, {"hold": {"duration": 2.0}}], 5.0, 40.0)

    def set_program(self, before, nearest, furthest):
        """Pulls by so many radii, and not for ever."""
        way = self.uniform("pull", nearest, furthest) * self.radius * (0.3 if self.quick else 1.0)
        way = significant(min(way, LONGEST_PULL * self.speed))
        self.settings["program"] = before + [
            {"pull": {"speed": significant(self.speed), "until": {"extension": way, "break": True}}}]

    # ---- shapes, in radii, one row a point ---------------------------------------------------------------------------

    def arch(self):
        rise = self.uniform("rise", 5.0, 20.0)
        z = np.linspace(0.0, 80.0, 400)
        x = rise * np.sin(math.pi * np.clip((z - 15.0) / 50.0, 0.0, 1.0)) ** 2
        return np.column_stack([x, 0.0 * z, z])

    def helix(self):
        radius, turns = self.uniform("helix_radius", 2.5, 8.0), self.choice("helix_turns", [1, 2, 3])
        rise = self.uniform("helix_rise", 3.0, 8.0)  # a turn
        t = np.linspace(0.0, 1.0, 400)
        phi = 2.0 * math.pi * turns * t
        lead = np.linspace(0.0, 20.0, 60)
        middle = np.column_stack([radius * (1.0 - np.cos(phi)), radius * np.sin(phi), 20.0 + rise * turns * t])
        below = np.column_stack([0.0 * lead, 0.0 * lead, lead])
        return joined(below, middle, below + middle[-1])

    def figure_eight(self):
        """A long knot 4_1 by polynomials (Shastri), drawn as wide as its strands then clear each other."""
        t = np.linspace(-2.1, 2.1, 800)
        knot = np.column_stack([t ** 3 - 3.0 * t, t * (t ** 2 - 1.0) * (t ** 2 - 4.0), (t ** 7 - 42.0 * t) / 12.0])
        clear = self.uniform("clearance", 1.9, 5.0)
        knot *= clear / closest_approach(knot)
        lead = np.linspace(0.0, 20.0, 60)[:, None] * np.array([[0.0, 0.0, 1.0]])
        return joined(lead - lead[-1] + knot[0], knot, lead + knot[-1])


def joined(*parts):
    """One line; where a part begins at the end of the last one, that point stands once."""
    return np.vstack([parts[0]] + [part[1:] for part in parts[1:]])


def closest_approach(points):
    """Smallest distance of places that lie further apart along the line than 3 times that distance."""
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    distance = np.linalg.norm(points[:, None] - points[None], axis=2)
    return distance[np.abs(length[:, None] - length[None]) > 3.0 * distance].min()


def significant(value):
    """Short enough to be typed again."""
    return float(f"{value:.5g}")
