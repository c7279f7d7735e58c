#!/usr/bin/python3
"""python/knot_utm/workflow/Snakefile, by its profile for this machine and by that for Slurm, on a Slurm of one node that the test starts
itself. Skipped, with exit code 77, where Snakemake, Slurm or a module is not installed."""
import contextlib
import os
import re
import shutil
import socket
import subprocess
import sys
import unittest

from sweeps import CONFIG, LENGTHS, ROOT, Sweeps, content, write

COMMANDS = ("snakemake", "slurmctld", "slurmd", "sbatch")

SLURM = """
ClusterName=knot_utm_test
SlurmctldHost=localhost
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/none
CredType=cred/none
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0
MpiDefault=none
SwitchType=switch/none
NodeName=localhost NodeAddr=localhost CPUs={cores} State=UNKNOWN
PartitionName=all Nodes=localhost Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("localhost", 0))
        return [one.getsockname()[1] for one in sockets]


class Workflow(Sweeps):
    def snakemake(self, profile, out, *more, code=0, **environment):
        """What it said; `more`: words of its config."""
        done = subprocess.run(["snakemake", "--snakefile", os.path.join(ROOT, "python/knot_utm/workflow/Snakefile"), "--profile",
                               os.path.join(ROOT, "python/knot_utm/workflow/profiles", profile), "--config", "study=" + self.study,
                               "out=" + self.path(out), *more], env={**self.environment, **environment}, cwd=self.folder, check=False,
                              text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, code, done.stdout)
        return done.stdout

    def jobs(self):
        """Slurm's number of the job by which each run was made; empty of one that was made without."""
        return re.findall(r"job=(\d*)$", content(self.log).decode(), re.MULTILINE)


class OnThisMachine(Workflow):
    def test_makes_the_runs_and_the_table_of_a_sweep(self):
        self.snakemake("local", "flow")
        self.assertEqual(sorted(self.started()), LENGTHS)
        self.sweep("alone")
        self.assertEqual(self.table("flow"), self.table("alone"))
        self.assertEqual(sorted(self.whole_runs("flow")), sorted(self.whole_runs("alone")))
        self.assertIn("Nothing to be done", self.snakemake("local", "flow"))

    def test_goes_on_with_what_a_sweep_has_made(self):
        self.sweep("out")
        write(self.study, content(self.study).decode().replace("[0.1, ", "[0.25, 0.1, "))
        self.snakemake("local", "out", KILL_AT="specimen.length=0.25")
        self.assertEqual(sorted(self.started()), sorted(LENGTHS + [0.25]))
        self.assertIn("killed by SIGSEGV", self.table("out").decode().splitlines()[2])

    def test_ends_each_run_with_its_plateau_where_asked(self):
        write(self.study, f"""
            method: {CONFIG}/tighten.yaml
            vary: {{physics.accuracy: [draft], material: [polypropylene], program.pull.speed: [3.3e-3, 4e-3]}}""")
        self.assertIn("--readings is locks, but must be plateau", self.snakemake("local", "flow", "readings=locks", code=1))
        self.assertFalse(os.path.exists(self.log), "nothing was started")
        self.snakemake("local", "flow", "readings=plateau")
        self.sweep("alone", "--readings", "plateau")
        self.assertEqual(content(self.log).decode().count("--readings plateau"), 4)
        self.assertEqual(self.table("flow"), self.table("alone"))

    def test_starts_nothing_of_a_study_that_would_be_refused(self):
        write(self.study, f"method: {CONFIG}/straight.yaml\nvary: {{specimen.length: [0.2, -1]}}")
        self.assertIn("specimen.length is -1", self.snakemake("local", "out", code=1))
        self.assertEqual(self.started(), [])
        write(self.study, f"method: {CONFIG}/straight.yaml\nvary: {{specimen.length: 0.2}}")
        self.assertIn("vary.specimen.length is 0.2", self.snakemake("local", "out", code=1))


class OnSlurm(Workflow):
    def setUp(self):
        super().setUp()
        folder = self.path("slurm")
        for name in ("state", "spool"):
            os.makedirs(os.path.join(folder, name))
        user = subprocess.run(["id", "-un"], check=True, text=True, stdout=subprocess.PIPE).stdout.strip()
        text = SLURM.format(user=user, ports=free_ports(2), folder=folder, cores=len(os.sched_getaffinity(0)))
        self.environment["SLURM_CONF"] = write(os.path.join(folder, "slurm.conf"), text)
        controller = self.daemon("slurmctld", "-D")
        while subprocess.run(["scontrol", "show", "config"], env=self.environment, check=False, stdout=subprocess.DEVNULL,
                             stderr=subprocess.DEVNULL).returncode:
            self.assertIsNone(controller.poll(), content(folder, "slurmctld.log").decode())
        self.daemon("slurmd", "-D", "-N", "localhost")
        subprocess.run(["srun", "--quiet", "true"], env=self.environment, check=True)  # waits for the node

    def daemon(self, *command):
        with open(self.path("slurm", command[0] + ".log"), "wb") as log:
            process = subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)
        return process

    def test_makes_the_runs_and_the_table_of_a_sweep(self):
        write(self.study, content(self.study).decode().replace(str(LENGTHS), str(LENGTHS[:2])))
        self.snakemake("slurm", "flow", KILL_AT=f"specimen.length={LENGTHS[1]}")
        self.assertEqual(len(set(self.jobs()) - {""}), 2, "each run was a job")
        self.sweep("alone", KILL_AT=f"specimen.length={LENGTHS[1]}")
        self.assertEqual(self.table("flow"), self.table("alone"))


if __name__ == "__main__":
    for command in COMMANDS:
        if not shutil.which(command, path="/usr/sbin:/usr/bin:/sbin:/bin"):
            print(f"skipped: {command} is not installed (knot_utm_tests=1 scripts/setup installs it)")
            sys.exit(77)
    unittest.main()
