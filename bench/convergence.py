"""What moves the readings beside mesh, step and tolerances: what is reported only, over a few specimens of the shipped test."""
import plots
from specimens import EDGE, introduction, tables_of
from tighten import MATERIALS, SLIDES  # noqa: F401
from table import Report


def others(material):
    residual = 1e-4 if SLIDES.get(material, True) else 2e-4  # of `normal` [k_b/h^2]
    return {"edges x3/4": {"specimen.edge_length": 0.75 * EDGE}, "residual /10": {"physics.residual": residual / 10},
            "draft": {"physics.accuracy": "draft"}, "fine": {"physics.accuracy": "fine"}}


def report(runner, materials, seeds=3):
    cases = {material: (material, {"material": material}) for material in materials}
    tables, pictures = tables_of(runner, cases, seeds, others)
    return Report("Convergence of the readings", introduction(seeds), tables,
                  lambda file: plots.strips(file, pictures, "plateau or peak force [N]"))
