#!/usr/bin/python3
"""A newcomer's first hour, step by step: scripts/first-hour."""
import filecmp
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import launched

ROOT = launched.ROOT
SAMPLE = "doc/examples/Specimen_RawData_1.csv"
STEPS = []


class Unexpected(Exception):
    """A step did not do what a newcomer expects."""


def step(name):
    """Registers a function of a Walk as a step; it returns what was seen."""
    def register(function):
        STEPS.append((name, function))
        return function
    return register


def expect(condition, why):
    if not condition:
        raise Unexpected(why)


def one_line(text, length=300):
    """The end of a text, where errors stand."""
    line = " | ".join(part.strip() for part in text.splitlines() if part.strip())
    return line if len(line) <= length else "… " + line[-length:]


def files_below(folder):
    """What a run could leave in the sources: name and time of change."""
    found = {}
    for where, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if name not in (".git", "build", "build-sanitize", "build-fuzz")]
        for name in names:
            path = os.path.join(where, name)
            found[path] = os.lstat(path).st_mtime_ns
    return found


class Walk:
    """A clean folder that looks like a clone whose programs are built, and the programs that are run in it."""

    def __init__(self, home):
        self.home = home
        self.clone = os.path.join(home, "knot_utm")
        os.mkdir(self.clone)
        for name in os.listdir(ROOT):
            if not name.startswith(".") and name != "out" and not name.startswith("build-"):
                os.symlink(os.path.join(ROOT, name), os.path.join(self.clone, name))
        self.port = launched.free_port()
        log = os.path.join(home, "ros")
        self.environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{self.port}", "ROS_HOME": log,
                            "ROS_LOG_DIR": log, "KNOT_UTM_SKIP_BUILD": "1", "KNOT_UTM_CACHE_LIMIT": "0", "DISPLAY": "",
                            "PWD": self.clone}
        self.before = files_below(ROOT)

    def start(self, *words):
        """A command in the background, in a session of its own, its output in one file."""
        output = tempfile.TemporaryFile(dir=self.home)
        process = subprocess.Popen(words, cwd=self.clone, env=self.environment, stdin=subprocess.DEVNULL,
                                   stdout=output, stderr=subprocess.STDOUT, start_new_session=True)
        process.output = output
        return process

    @staticmethod
    def end(process):
        """Waits for it. Returns exit code and output."""
        try:
            code = process.wait(1800)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            raise Unexpected("goes on after half an hour") from None
        process.output.seek(0)
        return code, process.output.read().decode("utf-8", "replace")

    def run(self, *words, code=0):
        """What a command says that ends with this exit code."""
        ended, said = self.end(self.start(*words))
        expect(ended == code, f"{' '.join(words)}: exit code {ended}, not {code}: {one_line(said)}")
        return said

    def tool(self, name, *words, code=0):
        return self.run(f"build/devel/lib/knot_utm/{name}", *words, code=code)

    def launch(self, file, *arguments, code=0):
        return self.run("roslaunch", "-p", str(self.port), "knot_utm", file, "rviz:=false", *arguments, code=code)

    def path(self, *parts):
        return os.path.join(self.clone, *parts)

    def text(self, *parts):
        expect(os.path.exists(self.path(*parts)), "/".join(parts) + " is missing")
        with open(self.path(*parts), encoding="utf-8") as file:
            return file.read()

    def result(self, folder, key):
        found = re.search(rf"^{key}: (.*)$", self.text(folder, "result.yaml"), re.MULTILINE)
        expect(found, f"{folder}/result.yaml has no {key}")
        return found[1].strip('"')

    def has(self, *parts, size=1):
        expect(os.path.exists(self.path(*parts)), "/".join(parts) + " is missing")
        expect(os.path.getsize(self.path(*parts)) >= size, "/".join(parts) + " is nearly empty")

    def same(self, one, other, names=("curve.csv", "curve_full.csv", "final_shape.csv")):
        _, different, missing = filecmp.cmpfiles(self.path(one), self.path(other), names, shallow=False)
        expect(not different + missing, f"{one} and {other} differ in {', '.join(different + missing)}")

    def reading(self, folder):
        return "plateau %.4g N, locks at %.4g mm, ended by %s" % (
            float(self.result(folder, "plateau_force")), 1e3 * float(self.result(folder, "lock_extension")),
            self.result(folder, "ended_by"))

    @step("tutorial")
    def tutorial(self):
        blocks = re.findall(r"(?:^    .*\n|^\n(?=    ))+", self.text("doc/tutorial.md"), re.MULTILINE)
        commands = [re.sub(r"^    ", "", block, flags=re.MULTILINE).strip() for block in blocks if block.strip()]
        expect(len(commands) == 5, f"the tutorial has {len(commands)} commands, not five")
        # The first one gets and builds the package; the last one opens a browser.
        page = commands[-1].split()[-1]
        for command in commands[1:-1]:
            self.run("/bin/bash", "-ec", command)
        self.has(page, size=10000)
        return f"{self.reading('out/mine')}; {page} has {os.path.getsize(self.path(page)) // 1000} kB"

    @step("a live test with ROS")
    def live(self):
        said = self.run("scripts/tighten", "real_time_factor:=0", "rviz:=false", "out:=out/live", "-p", str(self.port))
        for word in ("has died", "REQUIRED", "ERROR"):
            expect(word not in said, f"the console says {word!r} of a success")
        end = said.rpartition("the test ended by ")[2]
        expect("plateau force" in end and len(end.splitlines()) <= 11, "the result is not printed in ten lines")
        expect(os.path.samefile(self.path("out/latest"), self.path("out/live")), "out/latest is another run")
        return self.reading("out/live")

    @step("the same test without ROS")
    def headless(self):
        said = self.tool("tensile_test", "tighten", "--out", "out/headless")
        expect(len(said.splitlines()) <= 10 and "null" not in said, f"the end is no ten lines: {one_line(said)}")
        expect(os.path.samefile(self.path("out/latest"), self.path("out/headless")), "out/latest is another run")
        self.same("out/live", "out/headless")
        return "its curves and its last shape are those of the live test, byte for byte"

    @step("replay of the live test")
    def replay(self):
        said = self.launch("replay.launch", f"bag:={self.path('out/live/test.bag')}", "rate:=0", "patience:=0")
        expect("has been replayed" in said and "has died" not in said, one_line(said))
        return "played to its end, and the launch ended by itself"

    @step("a test that follows an experiment")
    def experiment(self):
        said = self.launch("experiment.launch", f"data:={self.path(SAMPLE)}", f"method:={self.path('my_test.yaml')}",
                           "real_time_factor:=0", "out:=out/followed", f"working_directory:={self.clone}")
        expect("has died" not in said, one_line(said))
        phases = {row.split(",")[6] for row in self.text("out/followed/curve.csv").splitlines()[2:]}
        expect("follow" in phases, "nothing was followed")
        return f"{len(self.text('out/followed/curve.csv').splitlines()) - 2} readings, ended by " \
               + self.result("out/followed", "ended_by")

    @step("report")
    def report(self):
        self.run("scripts/report", "out/live")
        for ending in ("html", "pdf"):
            self.has("out/live", f"report.{ending}", size=10000)
        return "report.html and report.pdf of %d and %d kB" % tuple(
            os.path.getsize(self.path("out/live", f"report.{ending}")) // 1000 for ending in ("html", "pdf"))

    @step("comparison of a curve with itself and with raw data")
    def compare(self):
        curve = "out/mine/curve.csv"
        said = self.tool("compare", curve, curve, "--balance", "--tolerance", "1e-9")
        self.tool("compare", SAMPLE, curve, "--balance")
        expect(said.strip(), "nothing is printed")
        return "with itself it differs by nothing; raw data and curve have one page and one table"

    @step("import of raw data")
    def imported(self):
        self.tool("import_instron", SAMPLE, "out/imported.bag")
        said = self.run("rosbag", "info", "out/imported.bag")
        expect("load_cell" in said, one_line(said))
        return re.search(r"messages:\s+(\d+)", said)[1] + " messages in the bag, the load cell's among them"

    @step("wrong arguments")
    def wrong(self):
        script = self.run("scripts/tighten", "matrial:=nylon", code=2)
        expect(script == "matrial is no argument of tighten.launch; did you mean material?\n", one_line(script))
        plain = self.launch("tighten.launch", "matrial:=nylon", code=1)
        expect("did you mean material?" in plain and "started with pid" not in plain, one_line(plain))
        for words in (["nosuch.yaml"], ["tighten", "--set", "material=nilon"], ["tighten", "--set", "specimen.knott=1"]):
            said = self.tool("tensile_test", *words, "--out", "out/wrong", code=2)
            expect(said.count("\n") == 1, f"not one line: {one_line(said)}")
        expect(not os.path.exists(self.path("out/wrong")), "something was written")
        return script.strip()

    @step("a value that a message allows")
    def allowed(self):
        key = "specimen.edge_length"
        said = self.tool("tensile_test", "tighten", "--check", "--set", f"{key}=7", code=2)
        most = re.search(r"and here at most .*, (\S+) m$", said.strip())
        expect(most, one_line(said))
        self.tool("tensile_test", "tighten", "--check", "--set", f"{key}={most[1]}")
        self.tool("tensile_test", "tighten", "--check", "--set", f"{key}={1.05 * float(most[1])}", code=2)
        return said.strip()

    @step("Ctrl-C in a live test")
    def interrupted_live(self):
        process = self.start("scripts/tighten", "rviz:=false", "out:=out/stopped", "-p", str(self.port))
        samples = self.path("out/stopped/samples.csv")
        launched.wait_for("the test runs", lambda: process.poll() is not None or
                          (os.path.exists(samples) and len(self.text("out/stopped/samples.csv").splitlines()) > 20))
        os.killpg(process.pid, signal.SIGINT)
        code, said = self.end(process)
        expect(code == 1, f"exit code {code}: {one_line(said)}")
        expect("has died" not in said, one_line(said))
        return f"exit code 1; what was measured is there: {self.result('out/stopped', 'reason')}"

    @step("what is left in the sources")
    def left(self):
        now = files_below(ROOT)
        changed = sorted(os.path.relpath(path, ROOT) for path in set(now) | set(self.before)
                         if now.get(path) != self.before.get(path))
        expect(not changed, ", ".join(changed))
        return "nothing"


def main():
    home = tempfile.mkdtemp(prefix="knot_utm_first_hour_")
    walk, failed, begin = Walk(home), 0, time.monotonic()
    try:
        for name, function in STEPS:
            try:
                print(f"ok      {name}: {function(walk)}", flush=True)
            except (Unexpected, AssertionError, OSError, ValueError) as error:
                failed += 1
                print(f"FAILED  {name}: {one_line(str(error))}", flush=True)
    finally:
        if "--keep" in sys.argv[1:]:
            print(f"kept in {home}")
        else:
            shutil.rmtree(home)
    print(f"{len(STEPS) - failed} of {len(STEPS)} steps, {(time.monotonic() - begin) / 60:.1f} minutes")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
