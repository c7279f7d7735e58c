"""Pulls of a bend of two ropes, as config/knot.yaml has it, from a few starts."""
from predictions import CPU_LIMIT
from runs import divide, read_yaml

METHOD = "config/knot.yaml"
TYING_SPEED = 3.15        # [radii/s] the default
SPEEDS = (0.9, 1.0, 1.1)  # times it, from start to start: what a person cannot repeat (specimens.scatter: auto)


def pulls(runner, name, knot, rope, settings):
    """One a start. `rope`: of config/materials/."""
    radius = read_yaml(f"config/materials/{rope}.yaml")["radius"]
    return [runner.run(f"{name}/{speed:g}", {"specimen.knot": knot, "material": rope,
                                             "program.0.tie.speed": round(TYING_SPEED * radius * speed, 9), **settings},
                       METHOD, cpu_limit=CPU_LIMIT) for speed in SPEEDS]


def load_of(run):
    """Largest load in the pull [k_b/h^2], whether it slipped or not; None where the run gave up."""
    if run.exit_code != 0:
        return None
    rod = run.method["material"]
    return divide(max(run.pulled()[1]), float(rod["bending_stiffness"]) / rod["radius"] ** 2)


def slipping_load_of(run):
    """The same; None, too, where it has not fallen to less than half in the end."""
    load = load_of(run)
    return None if load is None or run.pulled()[1][-1] > 0.5 * max(run.pulled()[1]) else load
