"""What the tied state owes to drag, speed and time step: nothing, if the knot is tied to equilibrium."""
import plots
import runs
from table import REFERENCE, Report, Table, at_most, is_

MATERIALS = ["polypropylene"]
PRELOAD = 50.0            # [N] on each overhand
DRAG = 1.2e-7             # c h^4/k_b that physics.drag: auto stands for [s]
EXCESS_GATE = at_most(0.005)
PLATEAU_GATE = at_most(0.03)


def report(runner, materials):
    tables, curves = [], {}
    for material in materials:
        base = {"material": material, "specimen.preload": PRELOAD}
        all_runs = {"as shipped": runner.run(material + "/as_shipped", base)}
        first = all_runs["as shipped"]
        for name, key, value in variants(first):
            all_runs[name] = runner.run(material + "/" + name.replace(" ", "_"), {**base, key: value}) \
                if value is not None else None
        tables.append(table_of(material, all_runs))
        for name, run in all_runs.items():
            if run:
                pull = run.phase("pull")
                curves[f"{material}, {name}"] = ([1e3 * s for s in pull.get("extension", [])], pull.get("load", []))
    return Report("Tying: drag, speed and time step",
                  f"`config/tighten.yaml` with F_p = {PRELOAD:g} N, against the same with more drag, faster tying and "
                  "shorter steps.", tables,
                  lambda file: plots.curves_together(file, curves, "extension s [mm]", "load F [N]", log=True))


def variants(first):
    """Name, key and value, each from what the first run itself used."""
    material = first.method.get("material")
    drag = material and DRAG * material["bending_stiffness"] / material["radius"] ** 4
    speed = next((step["tie"].get("speed") for step in first.method.get("program", []) if "tie" in step), None)
    times = first.curve.get("time", [])
    longest = max((after - before for before, after in zip(times, times[1:])), default=None)
    yield "drag x10", "physics.drag", None if drag is None else 10.0 * drag
    yield "tying speed x2", "program.tie.speed", None if speed is None else 2.0 * speed
    # The longest step that was taken: what `auto` stood for.
    yield "longest step halved", "physics.max_step", None if longest is None else 0.5 * longest


def excess_length(run, knot):
    both = run.value("excess_length") if run else None
    return both[knot] if both else None


def table_of(material, all_runs):
    first = all_runs["as shipped"]
    each = list(all_runs.values())

    def values(read):
        return [read(run) if run else None for run in each]

    def changes(read):
        return [REFERENCE] + [runs.relative_change(read(run) if run else None, read(first)) for run in each[1:]]

    def not_first(gate):
        return [None] + [gate] * (len(each) - 1)

    table = Table(f"{material}, F_p = {PRELOAD:g} N", list(all_runs))
    table.add("exit code", "-", values(lambda run: run.exit_code), is_(0))
    table.add("time until pulled", "s", values(lambda run: next(iter(run.phase("pull").get("time", [])), None)))
    table.add("CPU time", "s", values(lambda run: run.cpu_time))
    for knot, where in enumerate(["lower", "upper"]):
        table.add(f"excess length of the {where} knot, tied", "m", values(lambda run: excess_length(run, knot)), None,
                  ".5g")
        table.add(f"relative change of the {where} knot's excess length", "-",
                  changes(lambda run: excess_length(run, knot)), not_first(EXCESS_GATE), ".2g")
    table.add("knot distance, tied", "m", values(lambda run: run.value("tied_knot_distance")))
    table.add("plateau force", "N", values(lambda run: run.value("true_plateau_force")))
    table.add("relative change of the plateau force", "-", changes(lambda run: run.value("true_plateau_force")),
              not_first(PLATEAU_GATE), ".2g")
    return table
