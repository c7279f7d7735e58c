"""What mesh, step, tolerances and contact stiffness move: the whole test, tying included, with one of them changed."""
import plots
import runs
from table import REFERENCE, Report, Table, is_

MATERIALS = ["nylon", "polypropylene", "pink_vps", "green_vps"]
CONTACT_STIFFNESS = 300.0  # [k_b/h^4] what `material.contact_stiffness: auto` stands for
VARIANTS = {
    "edges x3/4": {"specimen.edge_length": 0.0024},
    "edges x1/2": {"specimen.edge_length": 0.0016},
    "longest step halved": {"physics.max_step": 0.085},
    "residual /10": {"physics.residual": 2e-6},
    "contact tolerance halved": {"physics.contact.tolerance": 0.0225},
    "presliding halved": {"physics.friction.presliding": 1e-3},
    "accuracy draft": {"physics.accuracy": "draft"},
    "accuracy fine": {"physics.accuracy": "fine"},
}
READINGS = [("plateau force", "plateau_force", "N"), ("lock extension", "lock_extension", "m"),
            ("locked stiffness", "locked_stiffness", "N/m"), ("peak force", "peak_force", "N")]


def report(runner, materials):
    tables, curves = [], {}
    for material in materials:
        all_runs = {"as shipped": runner.run(f"{material}/as_shipped", {"material": material})}
        shipped = all_runs["as shipped"]
        for name, settings in {**VARIANTS, **stiffer(shipped)}.items():
            file_name = name.replace(" ", "_").replace("/", "_")
            all_runs[name] = runner.run(f"{material}/{file_name}", {"material": material, **settings})
        tables.append(table_of(material, shipped, all_runs))
        for name, run in all_runs.items():
            pull = run.phase("pull")
            curves.setdefault(material, {})[name] = ([1e3 * s for s in pull.get("extension", [])], pull.get("load", []))
    return Report("What moves the readings",
                  "`config/tighten.yaml` from tying to the end of the pull, one setting changed at a time. Reported, not "
                  "gated: the next version's task is to bring the changes down. Each run ties its own knot, so the "
                  "scatter of the tied state is part of every change.", tables,
                  lambda file: plots.panels(file, curves, "extension s [mm]", "load F [N]"))


def stiffer(shipped):
    """The material as it was resolved, with three times the contact stiffness."""
    material = shipped.method.get("material")
    if not isinstance(material, dict):
        return {}
    stiffness = 3.0 * CONTACT_STIFFNESS * material["bending_stiffness"] / material["radius"] ** 4
    return {"contact stiffness x3": {"material": {**material, "contact_stiffness": stiffness}}}


def table_of(material, shipped, all_runs):
    each = list(all_runs.values())
    table = Table(material, list(all_runs))
    table.add("exit code", "-", [run.exit_code for run in each], is_(0))
    table.add("motion pattern", "-", [run.value("motion_pattern") for run in each])
    for words, key, unit in READINGS:
        if shipped.value(key) is None:
            continue
        table.add(words, unit, [run.value(key) for run in each])
        table.add(f"relative change of the {words}", "-",
                  [REFERENCE] + [runs.relative_change(run.value(key), shipped.value(key)) for run in each[1:]], None,
                  ".2g")
    table.add("largest penetration / radius", "-", [run.value("max_penetration") for run in each], None, ".3f")
    table.add("CPU time", "s", [run.cpu_time for run in each], None, ".2f")
    table.add("real-time factor", "-", [run.real_time_factor() for run in each], None, ".1f")
    return table
