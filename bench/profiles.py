"""Shares of the CPU time of the shipped test, by what is computed: samples of perf, sorted by the names of functions."""
import collections
import os
import re
import shutil
import subprocess
import sys

from runs import METHOD, divide, mean
from table import Report, Table, at_most

MATERIALS = ["nylon", "polypropylene", "pink_vps", "green_vps"]
RATE = 4000         # [Hz] of samples, by a clock that virtual machines have, too
MOST_UNKNOWN = 5.0  # [%] of the samples that may belong to no group
NAMED = 10          # functions of no group that are named, the most frequent ones
RECORD = ["perf", "record", "--quiet", "--event", "cpu-clock", "--freq", str(RATE)]
REPORT = ["perf", "report", "--stdio", "--quiet", "--no-children", "--fields", "sample,dso,symbol", "--field-separator", "|"]
OTHER = "other"
FILES = "bag, files, loader and kernel"
ELASTIC = "elastic terms and inertia"

# A function belongs to the first group that has an expression for the beginning of its name. The name begins with the class, or
# with the function where there is none; the namespaces of the package are left out.
FUNCTIONS = [
    ("factorisation and back substitution", r"BlockMatrix<"),
    ("matrix order and pattern",
     r"amd_|BlockPattern::|EliminationSets::|SortingSet|Neighbours|StepMatrix<\d>::(find|Sorted)|std::vector<int,"),
    ("assembly and Newton's method", r"StepMatrix<|LinearSystem<|ContactTerm<|linearise_surfaces<|newton<"),
    ("contact search and projection",
     r"Candidates\b|FootSearch::|FootSieve::|\w+Contact::find_|RisingRoots|SampledCentreline|closest_points"),
    ("contact law and linearisation",
     r"linearise\b|Four\w+|Section::|evaluate_forces|(set|add)_couples|add_shifts|NormalLaw|\w*Friction::|friction_input|rolling\b|"
     r"RollingResistance|turned_from"),
    ("contact bookkeeping",
     r"\w+Contact::|least_curvature_factor|std::vector<(SmoothContact|EdgeContact|ContactPoint|SurfacePoint)"),
    (ELASTIC, r"Frame(Bending|Terms)::|CentrelineTerms::|MotionTerm::|\w+Bend(ing)?::|\w+Stretching|transported_director|"
              r"material_directors|parallel_transport|subtract_slopes|add_curves|add_block<"),
    ("knot type, checks and readings",
     r"modular::|alexander|crossings|meet|cross\b|View\b|determinant|TunnellingSearch|TyingRig|KnotWatch|OverhandStrand|LoopTopology|"
     r"TestingMachine|TiedLoop|StepControl|StepReadings|Grips|ImplicitStep<|TimeStep|examine|smoothed\b|most_exposed|fastest_node|"
     r"nearest_places|normal_force_between|std::vector<(Crossing|Box|Piece)"),
    (FILES, r"Samples|Row(Reader|Writer)|visit_row|YAML::|CurveWriter|RunWriter|(parse|format)_number"),
]
# Functions without an expression, by the file that they are in.
LIBRARIES = [
    (ELASTIC, r"libm[.-]"),  # sines and cosines, nearly all of sections that turn
    (FILES, r"(?!libknot_utm_core)"),
]
GROUPS = [name for name, _ in FUNCTIONS] + [OTHER]


def group_of(library, function):
    name = re.sub(r"knot_utm::|\(anonymous namespace\)::", "", function)
    by_name = (group for group, expression in FUNCTIONS if re.match(expression, name))
    by_library = (group for group, expression in LIBRARIES if re.match(expression, library))
    return next(by_name, None) or next(by_library, OTHER)


def samples_of(said):
    """{(library, function): samples} of what `perf report` says."""
    found = collections.Counter()
    for line in said.splitlines():
        count, _, rest = line.partition("|")
        library, _, function = rest.partition("|")
        if count.strip().isdigit():
            found[library.strip(), re.sub(r"^\[.\] ", "", function.strip())] += int(count)
    return found


def shares_of(samples):
    """[%] of each group."""
    groups = collections.Counter()
    for (library, function), count in samples.items():
        groups[group_of(library, function)] += count
    return {group: divide(100.0 * groups[group], sum(samples.values())) for group in GROUPS}


def profile_of(runner, material):
    """What perf saw of a test: {(library, function): samples}."""
    data = os.path.join(runner.folder, material + ".perf")
    os.makedirs(runner.folder, exist_ok=True)
    run = runner.run(material, {"material": material}, under=[*RECORD, "--output", data, "--"])
    if run.exit_code != 0 or not os.path.exists(data):
        sys.exit("scripts/bench: the run under perf failed; `sudo sysctl kernel.perf_event_paranoid=2` permits perf to everybody")
    said = subprocess.run([*REPORT, "--input", data], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True).stdout
    return samples_of(said)


def report(runner, materials):
    if not shutil.which("perf"):
        sys.exit("scripts/bench: perf is not installed; `sudo apt-get install linux-perf` installs it")
    each = [profile_of(runner, material) for material in materials]
    unknown = collections.Counter()
    for samples in each:
        unknown.update({function: count for (library, function), count in samples.items() if group_of(library, function) == OTHER})
    for function, count in unknown.most_common(NAMED):
        runner.say(f"{OTHER}: {count} samples: {function}")
    return Report("Where the CPU time goes",
                  f"`config/tighten.yaml` as shipped, one run a material: shares of samples that `perf record` took at {RATE} Hz of CPU "
                  "time. Functions are sorted into groups by their names (`bench/profiles.py`). A function that the compiler builds into "
                  f"its caller counts as the caller. Functions of the C library that give, copy and clear memory count as {FILES}. A user "
                  "who may not look into the kernel gets shares without it.", [table_of(materials, each)])


def table_of(materials, each):
    table = Table("Shares of the CPU time", materials + ["mean"])
    shares = [shares_of(samples) for samples in each]
    for group in GROUPS:
        values = [one[group] for one in shares]
        table.add(group, "%", values + [mean(values)], at_most(MOST_UNKNOWN) if group == OTHER else None, ".1f")
    table.add("samples", "-", [sum(samples.values()) for samples in each] + [sum(sum(samples.values()) for samples in each)])
    return table
