#!/usr/bin/python3
"""python/knot_utm/workflow/Snakefile, by its profile for this machine and by that for Slurm: on a Slurm of one node that the test starts
itself, and on one of small scripts that speak as the manuals of its commands say, where a job has to end in a way of its own. Skipped,
with exit code 77, where Snakemake, Slurm or a module is not installed."""
import contextlib
import os
import re
import shutil
import socket
import subprocess
import sys
import unittest
from collections import Counter

from sweeps import CONFIG, LENGTHS, ROOT, Sweeps, read, write

WORKFLOW = os.path.join(ROOT, "python/knot_utm/workflow")
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

# In the time of the first job, ten times what Snakemake took to start at least, there is room for one run and the beginning of another.
TIMEOUT = """#!/bin/bash
[ "$1" -ge $((10 * $(ps -o etimes= -p $(ps -o ppid= -p $PPID)))) ] || exit 1
sweep=("${@:2:$#-2}")
"${sweep[@]}" "..$("${sweep[@]}" names | sort | head -n 1)"
exit 124
"""

# $JOBS/NUMBER holds what scontrol says of a job, which begins at once; the one that is $CUT_SHORT ends before its runs.
STATE = "JobId=1 JobName=knot_utm-job UserId=me(1) JobState=%s Reason=None ExitCode=0:0"
FORGOTTEN = "slurm_load_jobs error: Invalid job id specified"
SLURM_COMMANDS = {"scontrol": '#!/bin/sh\ncat "$JOBS/$4"', "sacct": '#!/bin/sh\necho "$ACCOUNTS"', "sbatch": f"""#!/bin/bash
number=$(($(ls "$JOBS" | wc -l) + 1))
file=$JOBS/$number
echo "{STATE % 'RUNNING'}" >"$file"
(
  exec 9>"$ALIVE"
  if [ "$number" != "$CUT_SHORT" ]; then SLURM_JOB_ID=$number sh "${{@: -1}}"; fi
  echo "$ENDS_AS" >"$file"
) >".snakemake/slurm-$number.log" 2>&1 </dev/null &
echo "$number"
"""}


def free_ports(count):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("localhost", 0))
        return [one.getsockname()[1] for one in sockets]


class Workflow(Sweeps):
    def started_snakemake(self, profile, out, *more, **environment):
        """`more`: words of its config, and options."""
        return subprocess.Popen(["snakemake", "--snakefile", os.path.join(WORKFLOW, "Snakefile"), "--profile",
                                 os.path.join(WORKFLOW, "profiles", profile), "--config", "study=" + self.study, "out=" + self.path(out),
                                 *more], env={**self.environment, **environment}, cwd=self.folder, text=True,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def snakemake(self, *words, code=0, **environment):
        """What it said."""
        process = self.started_snakemake(*words, **environment)
        said, _ = process.communicate()
        self.assertEqual(process.returncode, code, said)
        return said

    def command(self, name, text):
        """A command that is found before any other of its name."""
        folder = self.path("commands")
        os.makedirs(folder, exist_ok=True)
        os.chmod(write(os.path.join(folder, name), text), 0o755)
        self.environment["PATH"] = folder + os.pathsep + os.environ["PATH"]

    def jobs(self):
        """Slurm's number of the job by which each run was made; empty of one that was made without."""
        return re.findall(r"job=(\d*)$", read(self.log), re.MULTILINE)


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
        write(self.study, read(self.study).replace("[0.1, ", "[0.25, 0.1, "))
        self.snakemake("local", "out", KILL_AT="specimen.length=0.25")
        self.assertEqual(sorted(self.started()), sorted(LENGTHS + [0.25]))
        self.assertIn("killed by SIGSEGV", self.table("out").splitlines()[2])

    def test_ends_each_run_with_its_plateau_where_asked(self):
        write(self.study, f"""
            method: {CONFIG}/tighten.yaml
            vary: {{physics.accuracy: [draft], material: [polypropylene], program.pull.speed: [3.3e-3, 4e-3]}}""")
        self.assertIn("--readings is locks, but must be plateau", self.snakemake("local", "flow", "readings=locks", code=1))
        self.assertFalse(os.path.exists(self.log), "nothing was started")
        self.snakemake("local", "flow", "readings=plateau")
        self.sweep("alone", "--readings", "plateau")
        self.assertEqual(read(self.log).count("--readings plateau"), 4)
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
            self.assertIsNone(controller.poll(), read(folder, "slurmctld.log"))
        self.daemon("slurmd", "-D", "-N", "localhost")
        subprocess.run(["srun", "--quiet", "true"], env=self.environment, check=True)  # waits for the node

    def daemon(self, *command):
        with open(self.path("slurm", command[0] + ".log"), "wb") as log:
            process = subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)
        return process

    def test_makes_the_runs_and_the_table_of_a_sweep(self):
        self.command("timeout", TIMEOUT)
        self.snakemake("slurm", "flow", KILL_AT=f"specimen.length={LENGTHS[1]}")
        self.assertEqual(sorted(Counter(self.jobs()).values()), [1, 1, 2], "one run in the time of the first job: two to a job")
        self.assertNotIn("", self.jobs())
        self.sweep("alone", KILL_AT=f"specimen.length={LENGTHS[1]}")
        self.assertEqual(self.table("flow"), self.table("alone"))


class OnSlurmOfScripts(Workflow):
    def setUp(self):
        super().setUp()
        for name, text in SLURM_COMMANDS.items():
            self.command(name, text)
        for name in ("jobs", ".snakemake"):
            os.mkdir(self.path(name))
        self.environment.update(JOBS=self.path("jobs"), ALIVE=os.devnull, ENDS_AS=FORGOTTEN, CUT_SHORT="", ACCOUNTS="")

    def says(self, scontrol, accounts="", log=None):
        """What Snakemake is told of a job."""
        write(self.path("jobs/1"), scontrol)
        if log:
            write(self.path(".snakemake/slurm-1.log"), log)
        return subprocess.check_output([os.path.join(WORKFLOW, "profiles/slurm/status.sh"), "1"], cwd=self.folder, text=True,
                                       env={**self.environment, "ACCOUNTS": accounts}).strip()

    def test_tells_by_its_state_what_became_of_a_job(self):
        for meaning, states in {
                "success": "COMPLETED",
                "running": "CONFIGURING COMPLETING PENDING RUNNING RESV_DEL_HOLD REQUEUE_FED REQUEUE_HOLD REQUEUED RESIZING SIGNALING "
                           "SPECIAL_EXIT STAGE_OUT STOPPED SUSPENDED",
                "failed": "BOOT_FAIL CANCELLED DEADLINE FAILED LAUNCH_FAILED NODE_FAIL OUT_OF_MEMORY PREEMPTED REVOKED"}.items():
            for state in states.split():
                self.assertEqual(self.says(STATE % state), meaning, state)
                self.assertEqual(self.says(FORGOTTEN, state), meaning, state)
        self.assertEqual(self.says(FORGOTTEN, "CANCELLED by 1000"), "failed")
        self.assertEqual(self.says("slurm_load_jobs error: Unable to contact slurm controller (connect failure)"), "running")

    def test_a_job_past_its_time_limit_or_forgotten_has_failed_only_where_its_log_lacks_its_end(self):
        for scontrol in (FORGOTTEN, STATE % "TIMEOUT"):
            self.assertEqual(self.says(scontrol), "success", "no log: Snakemake looks for what it made")
        for scontrol in (FORGOTTEN, STATE % "TIMEOUT"):
            self.assertEqual(self.says(scontrol, log="slurmstepd: error: *** JOB 1 ON node CANCELLED DUE TO TIME LIMIT ***"), "failed")
            self.assertEqual(self.says(scontrol, log="1 of 1 steps (100%) done"), "success")

    def test_a_job_that_was_cut_short_is_made_again_and_one_that_ended_is_not(self):
        self.snakemake("slurm", "flow", ENDS_AS=STATE % "TIMEOUT", CUT_SHORT="1")
        self.assertEqual(self.jobs(), ["2"] * len(LENGTHS))

    def test_goes_on_after_a_kill_once_it_is_unlocked(self):
        for name in ("held", "never", "alive"):
            os.mkfifo(self.path(name))
        process = self.started_snakemake("slurm", "flow", HOLD_AT=f"specimen.length={LENGTHS[1]}", ALIVE=self.path("alive"))
        with open(self.path("alive"), "rb") as alive, open(self.path("held"), "rb") as held:
            self.assertEqual(held.readline(), b"held\n")
            process.kill()
            process.communicate()
            write(self.path("never"), "\n")
            alive.read()  # until the job, which goes on, has ended
        self.assertIn("cannot be locked", self.snakemake("slurm", "flow", code=1))
        study = read(self.study)
        write(self.study, study + "nonsense: 1\n")
        self.snakemake("slurm", "flow", "--unlock")
        write(self.study, study)
        self.snakemake("slurm", "flow")
        self.assertEqual(sorted(self.started()), LENGTHS)
        self.assertEqual(len(self.whole_runs("flow")), len(LENGTHS))


if __name__ == "__main__":
    for command in COMMANDS:
        if not shutil.which(command, path="/usr/sbin:/usr/bin:/sbin:/bin"):
            print(f"skipped: {command} is not installed (knot_utm_tests=1 scripts/setup installs it)")
            sys.exit(77)
    unittest.main()
