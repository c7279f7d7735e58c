"""What the couple of friction at the surface of strands does to the four materials of the source paper."""
import concurrent.futures
import statistics

from specimens import specimens
from table import Report, Table, is_, is_missing

MATERIALS = ["nylon", "polypropylene", "pink_vps", "green_vps"]
COUPLES = (0.0, 0.1, 0.25, 0.5, 1.0)       # eta
PRELOADS = (0.25, 0.5, 1.0, 2.0)           # of the material's own
TWISTING = (0.1, 10.0)                     # of the material's own k_t
TWISTED_COUPLES = (0.1, 0.25, 1.0)
SETS = (0.3, 0.6)                          # material.bending_set, of ropes
SET_COUPLES = (0.0, 0.25, 1.0)
ROPES = ["nylon", "polypropylene"]
MANY = 12                                  # specimens, but for sets
JOBS = 2


def report(runner, materials, seeds=3):
    tables = []
    for material in materials:
        own = own_values(runner, material)
        for key, factors, couples in (("tying_preload", PRELOADS, COUPLES), ("twisting_stiffness", TWISTING, TWISTED_COUPLES)):
            for factor in factors:
                tables.append(study(runner, f"{material}: {key} {factor:g} times its own", material, max(seeds, MANY),
                                    [(f"eta {couple:g}", {f"material.{key}": factor * own[key],
                                                          "material.friction_couple": couple}) for couple in couples]))
        if material in ROPES:
            for share in SETS:
                tables.append(study(runner, f"{material}: a bend that sets by {share:g}", material, seeds,
                                    [(f"eta {couple:g}", {"material.bending_set": share,
                                                          "material.friction_couple": couple}) for couple in SET_COUPLES]))
    return Report("The couple of friction",
                  f"`config/tighten.yaml`, {MANY} specimens, {seeds} where a bend sets, whose knot "
                  "distance (1 %), tails (5 %) and tying speed (10 %) are drawn, in brackets the standard deviation. eta "
                  "is `material.friction_couple`. A test keeps its knots where neither opened as the loop was mounted, "
                  "none jumped open and none came undone. Plateaus are means over the specimens that have one, with their "
                  "standard deviation; the peak force is that of all. Runs must end without an error of the program: a "
                  "knot that comes undone as it is let go is told by exit code 1.", tables)


def own_values(runner, material):
    """Of the shipped material."""
    import yaml
    with open(f"{runner.root}/config/materials/{material}.yaml", encoding="utf-8") as file:
        return yaml.safe_load(file)


def study(runner, title, material, count, rows):
    drawn = specimens(count)

    def run(row, k):
        name = title.replace(": ", "/").replace(" ", "_") + "_" + row[0].replace(" ", "_")
        return runner.start(f"{name}_{k}", {"material": material, **row[1], **drawn[k]}, "config/tighten.yaml",
                            None).wait()

    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        jobs = [[pool.submit(run, row, k) for k in range(count)] for row in rows]
        each = [[job.result() for job in row] for row in jobs]
    table = Table(title, [name for name, _ in rows])
    table.add("specimens that crashed", "-", [sum(run.exit_code not in (0, 1) for run in starts) for starts in each],
              [is_(0)] * len(rows))
    table.add("specimens that keep their knots", "-", [f"{sum(keeps(run) for run in starts)} of {count}" for starts in each])
    table.add("plateau force", "N", [text(values(starts, "true_plateau_force")) for starts in each])
    table.add("lock extension", "m", [text(values(starts, "lock_extension")) for starts in each])
    table.add("peak force", "N", [text(values(starts, "true_peak_force")) for starts in each])
    table.add("motion patterns", "-", [", ".join(sorted({str(run.value("motion_pattern")) for run in starts}))
                                       for starts in each])
    table.add("CPU time of a test", "s", [statistics.mean(run.cpu_time for run in starts) for starts in each], None, ".2g")
    return table


def keeps(run):
    """Whether both knots held: none opened as the loop was mounted, jumped open or came undone."""
    opened = any("opened as the loop was mounted" in warning for warning in run.value("warnings") or [])
    return (run.exit_code == 0 and not opened and is_missing(run.value("jump_force"))
            and is_missing(run.value("untangled_at")) and run.value("knot_type_preserved") is True)


def values(starts, key):
    known = [run.value(key) for run in starts]
    return [value for value in known if not is_missing(value)]


def text(known):
    if not known:
        return "none"
    if len(known) == 1:
        return f"{known[0]:.3g} (1)"
    return f"{statistics.mean(known):.3g} +- {statistics.stdev(known):.2g} ({len(known)})"
