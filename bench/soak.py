#!/usr/bin/python3
"""Soak of the launched system at full speed, on a machine that is kept busy: scripts/soak [KEY=VALUE]...

    samples=N   in all [10000000, or as many as resets and minutes say]
    resets=N    tests that they are spread over, each on a new specimen [one for 100000 samples]
    minutes=N   no further test begins after so many [no limit]
    busy=N      loops that take the processors from it [2]
    results=DIR where soak.md and soak.csv go [bench/results]

Every sample is counted: those that the machine published by their sequence numbers, those that the recorder wrote, the
rows on disk. Every curve is held against the first one and that against the headless tool, byte for byte. Exit code 1:
a gate failed.
"""
import filecmp
import math
import os
import shutil
import subprocess
import sys
import time

import launched
from table import Report, Table, at_most, is_

METHOD = """# A short rod, pulled slowly, read at every command.
specimen: {{knot: straight, length: 0.03, edge_length: 0.006}}
material: nylon
machine: {{grips: clamps, load_cell: {{capacity: 50e3, sampling_rate: 1000}}}}
program:
  - balance: {{}}
  - pull: {{speed: 1.0e-6, until: {{time: {0}}}}}
"""
NODES = ["utm_node", "knot_node", "recorder_node"]
SAMPLES_A_TEST = 100000
BESIDE = 2  # samples of a test that are not of its pull: the first, and balance


def refuse(why):
    print("scripts/soak: " + why, file=sys.stderr)
    sys.exit(2)


class Wishes:
    """What the command line asks for."""

    def __init__(self, words):
        self.samples = self.resets = self.minutes = None
        self.busy, self.results = 2, os.path.join(launched.ROOT, "bench/results")
        for word in words:
            key, _, value = word.partition("=")
            if key == "results":
                self.results = value
            elif key in ("samples", "resets", "minutes", "busy") and value.isdigit():
                setattr(self, key, int(value))
            else:
                refuse(f"{word} is not allowed: samples=N, resets=N, minutes=N, busy=N or results=DIR")
        if self.samples is None and self.resets is None:
            self.samples = 10**7 if self.minutes is None else 10**9
        if self.samples is None:
            self.samples = 1000 * self.resets
        if self.resets is None:
            self.resets = math.ceil(self.samples / SAMPLES_A_TEST)
        if min(self.samples, self.resets) < 1 or self.samples < 10 * self.resets:
            refuse("samples must be at least 10 for each of resets, and that at least 1")
        self.samples_a_test = math.ceil(self.samples / self.resets)


class Machine:
    """The operator's side of a launched system."""

    def __init__(self, launch):
        os.environ.update(launch.environment)
        # They take the master's address when they are loaded.
        import rospy
        from knot_utm.msg import RecorderStatus, TestStatus
        from rosgraph_msgs.msg import Clock
        from knot_utm.srv import StartTest
        from std_srvs.srv import Trigger
        self.rospy, self.trigger, self.start = rospy, Trigger, StartTest
        rospy.init_node("soak", disable_signals=True)
        self.recorder, self.test, self.clock, self.clock_went_back = None, None, None, 0
        rospy.Subscriber("recorder/status", RecorderStatus, lambda m: setattr(self, "recorder", m), queue_size=1)
        rospy.Subscriber("utm/status", TestStatus, lambda m: setattr(self, "test", m), queue_size=1)
        rospy.Subscriber("/clock", Clock, self.on_clock)
        self.pids = {node: launch.pid(node) for node in NODES}
        self.alive = lambda: launch.process.poll() is None

    def on_clock(self, message):
        if self.clock is not None and message.clock < self.clock:
            self.clock_went_back += 1
        self.clock = message.clock

    def call(self, service, kind):
        self.rospy.wait_for_service(service, timeout=60.0)
        return self.rospy.ServiceProxy(service, kind)()

    def run(self, number, look):
        """A test on a new specimen to its end; `look()` now and then. Returns the recorder's last status
        and the machine's."""
        self.call("knot/reset", self.trigger)
        launched.wait_for("start", lambda: self.call("utm/start_test", self.start).accepted)
        while True:
            said, ended = self.recorder, self.test
            if said is not None and said.run == number:
                look()
                if said.complete and ended.run == number and ended.sequence + 1 >= said.recorded and ended.ended_by:
                    return said, ended
                if said.error:
                    sys.exit("scripts/soak: " + said.error)
            if not self.alive():
                sys.exit("scripts/soak: the launch ended")
            time.sleep(0.1)


def rows(file):
    with open(file, "rb") as data:
        return sum(block.count(b"\n") for block in iter(lambda: data.read(1 << 20), b"")) - 2


class Soak:
    """All tests of a run, and what was counted."""

    def __init__(self, wishes):
        self.wishes = wishes
        self.tests = self.published = self.recorded = self.dropped = self.on_disk = self.different = 0
        self.clock_went_back = 0
        self.memory, self.seconds, self.peak_of_recorder = [], 0.0, 0

    def run(self):
        begin = time.monotonic()
        with launched.Launch("autostart:=false", "exit_at_end:=false", "real_time_factor:=0",
                             "method:=soak.yaml", prepare=self.write_method) as launch:
            machine = Machine(launch)
            limit = self.wishes.minutes
            while self.tests < self.wishes.resets and (limit is None or time.monotonic() - begin < 60 * limit):
                self.one_test(launch, machine)
                self.seconds = time.monotonic() - begin
            self.clock_went_back = machine.clock_went_back
            with launched.Headless(os.path.join(launch.folder, "soak.yaml")) as headless:
                self.different += any(headless.different(self.first))

    def write_method(self, folder):
        with open(os.path.join(folder, "soak.yaml"), "w", encoding="utf-8") as file:
            file.write(METHOD.format((self.wishes.samples_a_test - BESIDE) / 1000))

    def one_test(self, launch, machine):
        def look():
            self.peak_of_recorder = max(self.peak_of_recorder, launched.memory(machine.pids["recorder_node"]))

        said, ended = machine.run(self.tests + 1, look)
        self.tests += 1
        self.published += ended.sequence + 1
        self.recorded += said.recorded
        self.dropped += said.dropped
        self.on_disk += rows(os.path.join(said.directory, "curve.csv"))
        self.memory.append([launched.memory(pid) for pid in machine.pids.values()])
        if self.tests == 1:
            self.first = said.directory
        else:
            self.different += any(filecmp.cmpfiles(self.first, said.directory, launched.FILES, shallow=False)[1:])
            shutil.rmtree(said.directory)
        print(f"test {self.tests}: {self.recorded} samples, "
              + ", ".join(f"{node} {bytes_ / 1e6:.1f} MB" for node, bytes_ in zip(NODES, self.memory[-1])),
              file=sys.stderr, flush=True)

    def growth(self, node):
        """Of the least memory that a node held after a test: from the second quarter of the tests to the third, or from
        the third to the last, whichever is less. A leak grows in both. What the heap takes once and keeps for later (up
        to a megabyte in the first quarter, and seldom after it) grows in one of them at most."""
        quarter = max(1, len(self.memory) // 4)
        held = [memory[node] for memory in self.memory]
        second, third, last = (min(held[-n * quarter:len(held) - (n - 1) * quarter] or held) for n in (3, 2, 1))
        return min(third / second, last / third) - 1

    def report(self):
        counts = Table("Samples", ["all tests"])
        counts.add("tests, each on a new specimen", "-", [self.tests])
        counts.add("published by the machine (sequence numbers)", "-", [self.published])
        counts.add("recorded", "-", [self.recorded], is_(self.published))
        counts.add("rows of curve.csv on disk", "-", [self.on_disk], is_(self.published))
        counts.add("dropped", "-", [self.dropped], is_(0))
        counts.add("tests whose files differ from the first, or that from the headless tool", "-", [self.different],
                   is_(0))
        counts.add("times that /clock went back", "-", [self.clock_went_back], is_(0))
        counts.add("samples a second", "1/s", [self.recorded / self.seconds])

        memory = Table("Memory", NODES)
        memory.add("resident after the first test", "MB", [m / 1e6 for m in self.memory[0]])
        memory.add("resident after the last test", "MB", [m / 1e6 for m in self.memory[-1]])
        memory.add("growth of the least from one quarter of the tests to the next", "-",
                   [self.growth(i) for i in range(len(NODES))], at_most(0.01))
        memory.add("largest within a test, which the recorder keeps to analyse", "MB",
                   [None, None, self.peak_of_recorder / 1e6])
        return Report("Soak of the launched system", " ".join([
            f"{self.tests} tests of {self.wishes.samples_a_test} samples through `utm_node`, `knot_node` and",
            f"`recorder_node` at full speed, {self.wishes.busy} loops beside them that take what they get of the",
            "processors. One sample is one command, one answer: the machine waits for each."]), [counts, memory])


def main():
    wishes = Wishes(sys.argv[1:])
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(wishes.busy)]
    soak = Soak(wishes)
    try:
        soak.run()
    finally:
        for loop in busy:
            loop.kill()
            loop.wait()
    report = soak.report()
    report.write(wishes.results, "soak")
    return report.finish()


if __name__ == "__main__":
    sys.exit(main())
