"""Small sweeps for the tests, with a tensile_test that tells what it was asked for, and may be held, or killed, at one run."""
import csv
import io
import os
import subprocess
import tempfile
import unittest

from head import ROOT, TOOLS, read, write  # noqa: F401

REAL = os.path.join(TOOLS, "tensile_test")
CONFIG = os.path.join(ROOT, "config")

# Runs of some hundredths of a second.
LENGTHS = [0.1, 0.2, 0.3, 0.4]
STRAIGHT = f"""
method: {CONFIG}/straight.yaml
vary:
  physics.accuracy: [draft]
  specimen.length: {LENGTHS}
"""

TOLD = r"""#!/bin/bash
# What the real one is only asked is no run.
case " $* " in *" --version "* | *" --list-"* | *" --check "*) exec "$REAL" "$@" ;; esac
echo "$* job=${SLURM_JOB_ID:-}" >>"$LOG"
case " $* " in
  *" ${HOLD_AT:-none} "*) exec 3>"$HELD"; echo held >&3; read -r _ <"$NEVER" ;;
  *" ${KILL_AT:-none} "*) kill -SEGV $$ ;;
  *" ${INTERRUPT_AT:-none} "*)
    "$REAL" "$@"
    for out in "$(dirname "$LOG")"/*/runs/.*/result.yaml; do sed -i 's/^reason: .*/reason: "interrupted"/' "$out"; done
    exit 1 ;;
esac
exec "$REAL" "$@"
"""


def rows(text):
    return list(csv.reader(io.StringIO(text)))


class Sweeps(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.log = self.path("log")
        os.mkdir(self.path("tools"))
        os.chmod(write(self.path("tools", "tensile_test"), TOLD), 0o755)
        self.study = write(self.path("study.yaml"), STRAIGHT)
        self.environment = {**os.environ, "KNOT_UTM_SKIP_BUILD": "1", "KNOT_UTM_TOOLS_DIR": self.path("tools"),
                            "REAL": REAL, "LOG": self.log, "HELD": self.path("held"), "NEVER": self.path("never")}

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def start(self, out, *more, limit=None, **environment):
        return subprocess.Popen([os.path.join(ROOT, "scripts/sweep"), self.study, "--out", self.path(out), *more],
                                env={**self.environment, **environment}, cwd=self.folder, text=True, preexec_fn=limit,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def sweep(self, out, *more, code=0, **options):
        """What it said on stderr."""
        process = self.start(out, *more, **options)
        _, said = process.communicate()
        self.assertEqual(process.returncode, code, said)
        return said

    def held(self, out, at, *more):
        """A sweep under way, once it has come to one run; what that run keeps open as long as it lives."""
        for name in ("held", "never"):
            os.mkfifo(self.path(name))
        process = self.start(out, "--jobs", "1", *more, HOLD_AT=at)
        pipe = open(self.path("held"), encoding="utf-8")  # waits for the other end
        self.addCleanup(pipe.close)
        self.assertEqual(pipe.readline(), "held\n")
        return process, pipe

    def started(self):
        """The lengths of the runs that were started, in order."""
        if not os.path.exists(self.log):
            return []
        return [float(word.split("=")[1]) for line in read(self.log).splitlines() for word in line.split()
                if word.startswith("specimen.length=")]

    def table(self, out):
        return read(self.path(out), "table.csv")

    def whole_runs(self, out):
        return [name for name in os.listdir(self.path(out, "runs")) if not name.startswith(".")]
