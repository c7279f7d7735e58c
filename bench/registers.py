"""What a processor without AVX2 costs: the same tests by a program for it."""
import os
import statistics
import subprocess

import runs
from table import Report, Table, at_most, is_

MATERIALS = ["nylon", "polypropylene", "pink_vps", "green_vps"]
PAIRS = 5
MOST = 1.8  # times the CPU time


def report(runner, materials):
    """The program without AVX2 is built in out/bench/registers/build, by the commands that README gives."""
    build = os.path.join(runner.folder, "build")
    runner.say("building without AVX2 in " + os.path.relpath(build, runner.root))
    for command in (["cmake", "-S", runner.root, "-B", build, "-DKNOT_UTM_X86_64_V3=OFF"],
                    ["cmake", "--build", build, "-j2", "--target", "tensile_test"]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    narrow = runs.Runner(runner.root, os.path.join(build, "devel/lib/knot_utm/tensile_test"), runner.core,
                         runner.folder + "/narrow", runner.overrides)
    each = [[(runner.run(f"{material}/{k}", {"material": material}), narrow.run(f"{material}/{k}", {"material": material}))
             for k in range(PAIRS)] for material in materials]
    table = Table("Whole tests", materials)
    table.add("exit code, both", "-", [max(run.exit_code for pair in pairs for run in pair) for pairs in each], is_(0))
    for name, side in (("with AVX2", 0), ("without", 1)):
        table.add(f"CPU time, {name}, median", "s", [statistics.median(pair[side].cpu_time for pair in pairs) for pairs in each],
                  None, ".3g")
        table.add(f"Newton iterations, {name}", "-", [pairs[0][side].value("newton_iterations") for pairs in each])
    table.add("ratio, median of the pairs", "-",
              [statistics.median(pair[1].cpu_time / pair[0].cpu_time for pair in pairs) for pairs in each], at_most(MOST), ".2f")
    table.add("same curve in every run without", "-",
              [all(pair[1].curve == pairs[0][1].curve for pair in pairs) for pairs in each], is_(True))
    return Report("A processor without AVX2",
                  "The program as it was built here, and one for any x86-64 processor (`KNOT_UTM_X86_64_V3=OFF`), in "
                  f"which four numbers take two registers of two: {PAIRS} pairs of whole tests, one right after the "
                  "other. Both fuse additions into multiplications differently, so that their bits differ.", [table])
