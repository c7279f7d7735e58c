"""What a processor without AVX2 costs: the same tests by a program for it."""
import os
import statistics
import subprocess
import sys

import runs
from table import Report, Table, at_most, is_

MATERIALS = ["nylon", "polypropylene", "pink_vps", "green_vps"]
PAIRS = 5
MOST = 1.8  # times the CPU time


def report(runner, materials):
    narrow = runs.Runner(runner.root, build_without_avx2(runner), runner.core, runner.folder + "/narrow",
                         runner.overrides)
    columns = {material: pairs_of(runner, narrow, material) for material in materials}
    table = Table("Whole tests", list(columns))
    table.add("exit code, both", "-", [max(run.exit_code for pair in pairs for run in pair)
                                       for pairs in columns.values()], is_(0))
    for name, side in (("with AVX2", 0), ("without", 1)):
        table.add(f"CPU time, {name}, median", "s",
                  [statistics.median(pair[side].cpu_time for pair in pairs) for pairs in columns.values()], None, ".3g")
        table.add(f"Newton iterations, {name}", "-", [pairs[0][side].value("newton_iterations")
                                                      for pairs in columns.values()])
    table.add("ratio, median of the pairs", "-",
              [statistics.median(pair[1].cpu_time / pair[0].cpu_time for pair in pairs)
               for pairs in columns.values()], at_most(MOST), ".2f")
    table.add("same curve in every run without", "-",
              [all(same_curve(pairs[0][1], pair[1]) for pair in pairs) for pairs in columns.values()], is_(True))
    return Report("A processor without AVX2",
                  "The program as it was built here, and one for any x86-64 processor (`KNOT_UTM_X86_64_V3=OFF`), in "
                  f"which four numbers take two registers of two: {PAIRS} pairs of whole tests, one right after the "
                  "other. Both fuse additions into multiplications differently, so that their bits differ.", [table])


def build_without_avx2(runner):
    """Built in out/bench/registers/build, by the commands that README gives."""
    build = os.path.join(runner.folder, "build")
    print("building without AVX2 in " + os.path.relpath(build, runner.root), file=sys.stderr, flush=True)
    for command in (["cmake", "-S", runner.root, "-B", build, "-DKNOT_UTM_X86_64_V3=OFF"],
                    ["cmake", "--build", build, "-j2", "--target", "tensile_test"]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return os.path.join(build, "devel/lib/knot_utm/tensile_test")


def pairs_of(wide, narrow, material):
    settings = {"material": material}
    return [(wide.run(f"{material}/{k}", settings), narrow.run(f"{material}/{k}", settings)) for k in range(PAIRS)]


def same_curve(first, second):
    both = []
    for run in (first, second):
        with open(os.path.join(run.folder, "curve_full.csv"), encoding="utf-8") as file:
            both.append(file.read())
    return both[0] == both[1]
