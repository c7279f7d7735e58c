#!/usr/bin/python3
"""usage: test/bits_test.py [--write]

Hashes of curve.csv and of result.yaml over what the package can do, against test/bits.csv: a change that should not change results leaves
them as they are. They are those of x86-64 processors with fused multiply and add, whose mathematical functions round alike (found on Intel
Xeon and on AMD EPYC); elsewhere the test is skipped. With --write it makes the table anew, which a commit that changes results says why of.
"""
import csv
import hashlib
import os
import re
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
TABLE = os.path.join(ROOT, "test/bits.csv")
TOOLS = os.environ.get("KNOT_UTM_TOOLS_DIR", os.path.join(ROOT, "build/devel/lib/knot_utm"))
OF_THE_MACHINE = re.compile(r"(wall_time|real_time_factor|peak_memory|version):")
KNOTS = ["bowline", "carrick", "figure_eight", "overhand_stopper", "reef", "sheet_bend", "surgeon", "zeppelin"]
COARSE = ["physics.accuracy=draft", "specimen.edge_length=0.0045"]


def methods():
    """{name: words of tensile_test}"""
    out = {}
    for folder in ("config", "config/standards"):
        for name in sorted(os.listdir(os.path.join(ROOT, folder))):
            if name.endswith(".yaml") and name != "knot.yaml":
                out[name[:-5]] = [f"{folder}/{name}"]
    for knot in KNOTS:
        out[knot] = settings("config/knot.yaml", f"specimen.knot={knot}", *COARSE)
    out["friction memory"] = settings("config/tighten.yaml", *COARSE)
    out["friction power"] = settings("config/tighten.yaml", "physics.friction={law: power, exponent: 0.9, reference_pressure: 100}", *COARSE)
    out["friction rate"] = settings("config/tighten.yaml", "physics.friction={law: rate, rate: 0.02, rate_speed: 1e-4}", *COARSE)
    out["tension and bending"] = settings("config/tighten.yaml",
                                       "material.breaking={law: tension_and_bending, bending_share: 0.08, crushing_share: 0.5}", *COARSE)
    for material in ("pink_vps", "polypropylene"):
        out[material] = settings("config/tighten.yaml", f"material={material}", *COARSE)
    out["two ropes"] = settings("config/knot.yaml", "specimen.knot=reef", "other_material=polyester_cord", *COARSE)
    out["broken"] = settings("config/tighten.yaml", "material.breaking_force=500", *COARSE)
    out["batch"] = settings("config/tighten.yaml", *COARSE) + ["--specimens", "3", "--jobs", "1"]
    return out


def settings(method, *each):
    return [method] + [word for one in each for word in ("--set", one)]


STUDY = f"""method: {ROOT}/config/capstan.yaml
vary:
  machine.roller_friction: {{from: 0.1, to: 0.8, steps: 8}}
"""


def made(folder):
    """{method: (hash of its curves, of its results)}"""
    def run(name, words):
        out = os.path.join(folder, name.replace(" ", "_"))
        said = subprocess.run([os.path.join(TOOLS, "tensile_test"), *words, "--out", out, "--no-cache", "--quiet"], cwd=ROOT, check=False,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if said.returncode not in (0, 1):
            raise RuntimeError(f"{name}: {said.stderr}")
        return name, hashes(out)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = dict(pool.map(lambda item: run(*item), methods().items()))
    study = os.path.join(folder, "study.yaml")
    with open(study, "w", encoding="utf-8") as file:
        file.write(STUDY)
    subprocess.run([sys.executable, "-m", "knot_utm.sweep_command", study, "--out", os.path.join(folder, "sweep")], cwd=ROOT, check=True,
                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                   env={**os.environ, "PYTHONPATH": os.path.join(ROOT, "python"), "KNOT_UTM_TOOLS_DIR": TOOLS})
    return {**found, "sweep": hashes(os.path.join(folder, "sweep"))}


def hashes(folder):
    found = {"curve.csv": hashlib.sha256(), "result.yaml": hashlib.sha256()}
    for where, folders, files in os.walk(folder):
        folders.sort()
        for name in sorted(set(files) & set(found)):
            with open(os.path.join(where, name), encoding="utf-8") as file:
                found[name].update("".join(line for line in file if not OF_THE_MACHINE.match(line)).encode())
    return tuple(each.hexdigest()[:16] for each in found.values())


def rounds_as_the_table():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        flags = re.search(r"^flags\s*: (.*)$", file.read(), re.MULTILINE)
    return bool(flags) and {"avx2", "fma"} <= set(flags[1].split())


class Bits(unittest.TestCase):
    def test_are_those_of_the_table(self):
        with open(TABLE, encoding="utf-8") as file:
            held = {name: tuple(each) for name, *each in csv.reader(file)}
        with tempfile.TemporaryDirectory() as folder:
            found = {"method": ("curve.csv", "result.yaml"), **made(folder)}
        self.assertEqual({name: (held.get(name), found.get(name)) for name in {**held, **found} if held.get(name) != found.get(name)}, {})


def write():
    with tempfile.TemporaryDirectory() as folder:
        found = made(folder)
    with open(TABLE, "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["method", "curve.csv", "result.yaml"])
        rows.writerows([name, *each] for name, each in found.items())


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        write()
    elif not rounds_as_the_table():
        print("skipped: the table is of x86-64 processors with fused multiply and add")
        sys.exit(77)
    else:
        unittest.main()
