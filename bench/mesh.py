"""Three edge lengths: what the mesh moves."""
import plots
import runs
from table import REFERENCE, Report, Table, is_

MATERIALS = ["polypropylene"]
EDGE_LENGTHS = [0.0032, 0.0024, 0.0016]  # [m]
READINGS = [("plateau force", "plateau_force", "N"), ("lock extension", "lock_extension", "m"),
            ("locked stiffness", "locked_stiffness", "N/m"), ("peak force", "peak_force", "N")]


def report(runner, materials):
    tables, curves = [], {}
    for material in materials:
        each = [runner.run(f"{material}/{edge:g}", {"material": material, "specimen.edge_length": edge})
                for edge in EDGE_LENGTHS]
        table = Table(material, [f"{edge:g} m" for edge in EDGE_LENGTHS])
        table.add("exit code", "-", [run.exit_code for run in each], is_(0))
        table.add("motion pattern", "-", [run.value("motion_pattern") for run in each])
        for words, key, unit in READINGS:
            table.add(words, unit, [run.value(key) for run in each])
            table.add(f"relative change of the {words}", "-",
                      [runs.relative_change(run.value(key), each[-1].value(key)) for run in each[:-1]] + [REFERENCE],
                      None, ".2g")
        table.add("CPU time", "s", [run.cpu_time for run in each])
        table.add("real-time factor", "-", [run.real_time_factor() for run in each], None, ".1f")
        tables.append(table)
        for edge, run in zip(EDGE_LENGTHS, each):
            pull = run.phase("pull")
            curves[f"{material}, {edge:g} m"] = ([1e3 * s for s in pull.get("extension", [])], pull.get("load", []))
    return Report("Edge length", "`config/tighten.yaml` on three meshes.", tables,
                  lambda file: plots.curves_together(file, curves, "extension s [mm]", "load F [N]", log=True))
