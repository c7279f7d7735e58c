#!/usr/bin/python3
"""scripts/sweep on small studies: what its table holds, what it does when it is cut short, and what it refuses. Skipped, with
exit code 77, where a module is not installed."""
import contextlib
import csv
import errno
import io
import json
import os
import re
import resource
import signal
import subprocess
import unittest

from sweeps import CONFIG, LENGTHS, REAL, STRAIGHT, Sweeps, read, rows, write  # first: it finds the packages

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

from knot_utm import command_line, table
from knot_utm.address import addresses
from knot_utm.yaml_text import load

OF_THE_MACHINE = {"wall_time", "real_time_factor", "peak_memory"}


class TheTable(Sweeps):
    def test_has_names_and_units_and_what_each_run_would_have_alone(self):
        self.sweep("out")
        names, units, *runs = rows(self.table("out"))
        listed = subprocess.run([REAL, "--list-results"], check=True, text=True, stdout=subprocess.PIPE).stdout
        expected = [["physics.accuracy", "-"], ["specimen.length", "m"], ["exit_code", "-"], ["error", "-"]]
        for row in csv.DictReader(listed.splitlines()):
            ends = (".0", ".1") if row["kind"] == "pair" else ("",)
            expected += [[row["key"] + end, row["unit"]] for end in ends if row["key"] not in OF_THE_MACHINE]
        self.assertEqual([list(pair) for pair in zip(names, units)], expected + [["run", "-"]])
        self.assertEqual([run[:4] for run in runs], [["draft", str(length), "0", ""] for length in LENGTHS])
        for run in runs:
            alone = self.path("alone", run[1])
            subprocess.run([REAL, CONFIG + "/straight.yaml", "--quiet", "--out", alone, "--set", "physics.accuracy=draft",
                            "--set", "specimen.length=" + run[1]], check=True)
            self.assertEqual(read(alone, "curve_full.csv"), read(self.path("out/runs"), run[-1], "curve_full.csv"))
            result = load(os.path.join(alone, "result.yaml"))
            for name, shown in zip(names[4:-1], run[4:-1]):
                value = result.get(name)
                if isinstance(value, float):
                    self.assertEqual(float(shown), value, name)
                elif isinstance(value, bool):
                    self.assertEqual(shown, str(value).lower(), name)
                else:
                    self.assertEqual(shown, "" if value in (None, []) else str(value), name)

    def test_in_hdf5_is_that_of_csv(self):
        self.sweep("out")
        file = self.path("out", "table.h5")
        stored = pd.read_hdf(file)
        read = pd.read_csv(self.path("out", "table.csv"), skiprows=[1], float_precision="round_trip")
        self.assertEqual(list(stored.columns), list(read.columns))
        for name in stored.columns:
            if pd.api.types.is_numeric_dtype(stored[name]):
                np.testing.assert_array_equal(stored[name], read[name].astype(float), name)
            else:
                self.assertEqual(list(stored[name]), list(read[name].fillna("").astype(str)), name)
        self.assertEqual(stored["specimen.length"].dtype, float)
        with pd.HDFStore(file, "r") as store:
            units = json.loads(store.get_storer("runs").attrs.units)
        self.assertEqual(list(units.items()), list(zip(*rows(self.table("out"))[:2])))

    def test_in_hdf5_is_no_larger_than_csv_for_one_long_message(self):
        made = table.Table({"specimen.length": "m"})
        for number in range(2000):
            made.add({"specimen.length": 0.1 * number}, f"run{number}", 1, "x" * 1500 if number == 7 else "", {"peak_force": 0.3 * number})
        stored = made.hdf()
        self.assertLess(len(stored), len(made.csv()))
        with open(self.path("long.h5"), "wb") as file:
            file.write(stored)
        pd.testing.assert_frame_equal(pd.read_hdf(self.path("long.h5")), made.frame())
        with pd.HDFStore(self.path("long.h5"), "r") as store:
            self.assertEqual(store.get_node("runs/table").colnames[1:], list(made.units), "for others' readers")

    def test_has_a_row_for_runs_that_fail_and_says_why(self):
        write(self.study, f"""
            method: {CONFIG}/tighten.yaml
            vary: {{material.bending_law: [elastic], material.friction_couple: [0], physics.accuracy: [draft],
                    material.friction_coefficient: [0.05]}}""")
        self.sweep("out")
        names, _, run = rows(self.table("out"))
        run = dict(zip(names, run))
        self.assertEqual((run["exit_code"], run["ended_by"]), ("1", "untangled"))
        self.assertEqual(run["error"], run["reason"])
        self.assertTrue(run["error"])

    def test_has_a_row_for_runs_that_crash_or_that_others_interrupt_which_are_tried_again(self):
        self.sweep("whole", "--jobs", "2")
        for how, row in (("KILL_AT", ["139", "killed by SIGSEGV"]), ("INTERRUPT_AT", ["1", "interrupted"])):
            self.sweep(how, "--jobs", "1", **{how: f"specimen.length={LENGTHS[1]}"})
            _, _, *runs = rows(self.table(how))
            self.assertEqual([run[2:4] for run in runs], [["0", ""], row, ["0", ""], ["0", ""]])
            self.sweep(how)
            self.assertEqual(self.table(how), self.table("whole"))
        self.assertEqual(sorted(self.started()), sorted(3 * LENGTHS + 2 * LENGTHS[1:2]))

    def test_has_a_row_a_point_where_points_are_the_same_run(self):
        write(self.study, f"method: {CONFIG}/straight.yaml\nvary: {{physics.accuracy: [draft], specimen.length: [0.2, 0.2]}}")
        self.sweep("out")
        _, _, one, other = rows(self.table("out"))
        self.assertEqual(one, other)
        self.assertEqual(self.started(), [0.2])


class OfThePlateauAlone(Sweeps):
    STUDY = f"""
        method: {CONFIG}/tighten.yaml
        vary:
          physics.accuracy: [draft]
          material: [polypropylene]
          program.pull.speed: [3.3e-3, 4e-3]"""

    def setUp(self):
        super().setUp()
        write(self.study, self.STUDY)

    def words(self):
        return [line for line in read(self.log).splitlines() if "--readings plateau" in line]

    def test_every_run_ends_with_it_and_the_table_goes_on_so(self):
        self.sweep("out", "--readings", "plateau")
        names, _, *runs = rows(self.table("out"))
        for run in (dict(zip(names, run)) for run in runs):
            self.assertEqual((run["exit_code"], run["ended_by"], run["peak_force"]), ("0", "plateau", ""))
            self.assertTrue(run["plateau_force"])
            self.assertEqual(load(self.path("out/runs", run["run"], "run.yaml"))["readings"], "plateau")
        self.assertEqual(len(self.words()), 2, "both")
        before = self.table("out")
        self.sweep("out", "--readings", "plateau")
        self.assertEqual((self.table("out"), len(self.words())), (before, 2))
        said = self.sweep("out", code=2)
        self.assertIn("were made with --readings plateau: give it again, or choose another folder", said)
        self.assertEqual(said.count("\n"), 1)
        self.assertEqual(self.table("out"), before)

    def test_others_are_refused_before_anything_is_written(self):
        for word, why in (("locks", "--readings is locks, but must be plateau"), ("plateau", "this test has no plateau")):
            if word == "plateau":
                write(self.study, STRAIGHT)
            self.assertIn(why, self.sweep("out", "--readings", word, code=2))
            self.assertFalse(os.path.exists(self.path("out")))


class Plots(Sweeps):
    def test_are_written_beside_the_table(self):
        self.sweep("out", "--plot", "peak_force")
        self.assertEqual(plt.imread(self.path("out/peak_force.png")).ndim, 3)

    def test_of_what_is_no_number_are_refused(self):
        for name in ("reason", "peak"):
            said = self.sweep("out", "--plot", name, code=2)
            self.assertIn(f"--plot is {name}", said)
            self.assertFalse(os.path.exists(self.path("out")))


class CutShort(Sweeps):
    def test_by_a_kill_loses_the_runs_in_flight_only(self):
        process, held = self.held("out", f"specimen.length={LENGTHS[2]}")
        process.kill()
        process.communicate()
        self.assertEqual(held.read(), "", "the run in flight has died with the sweep")
        self.assertEqual(len(self.whole_runs("out")), 2)
        self.assertEqual(self.started(), LENGTHS[:3])
        self.sweep("out", "--jobs", "1")
        self.assertEqual(self.started(), LENGTHS[:3] + LENGTHS[2:])
        self.sweep("whole")
        self.assertEqual(self.table("out"), self.table("whole"))
        self.assertEqual(sorted(os.listdir(self.path("out/runs"))), sorted(self.whole_runs("out")), "no remains")

    def test_by_a_signal_writes_the_table_so_far_and_says_how_to_go_on(self):
        for number, code in enumerate((signal.SIGINT, signal.SIGTERM)):
            out = f"out{number}"
            process, held = self.held(out, f"specimen.length={LENGTHS[2]}")
            process.send_signal(code)
            _, said = process.communicate()
            self.assertEqual(held.read(), "", "the run in flight is stopped")
            self.assertEqual(process.returncode, 1)
            self.assertIn("it was interrupted, with 2 of 4 runs done; the same command goes on\n", said)
            self.assertEqual([run[1] for run in rows(self.table(out))[2:]], [str(length) for length in LENGTHS[:2]])
            self.assertEqual(sorted(os.listdir(self.path(out, "runs"))), sorted(self.whole_runs(out)), "no remains")
            self.sweep(out)
            self.assertEqual(len(rows(self.table(out))), 6)
            for name in ("held", "never"):
                os.remove(self.path(name))

    def test_by_what_will_not_change_is_not_said_to_go_on(self):
        for code, said in ((errno.ENOSPC, "a: no space left on device; the same command goes on"), (errno.EISDIR, "a: is a directory")):
            def fail(code=code):
                raise OSError(code, os.strerror(code), "a")
            with contextlib.redirect_stderr(io.StringIO()) as told:
                self.assertEqual(command_line.exit_code_of("scripts/sweep", fail, True), 1)
            self.assertEqual(told.getvalue(), f"sweep: {said}\n")

    def test_by_a_full_disk_goes_on_when_there_is_room(self):
        self.sweep("out", "--jobs", "1")
        write(self.study, read(self.study).replace(str(LENGTHS[-1]), f"{LENGTHS[-1]}, 0.5"))
        # As large as a file may become: enough for the method, too little for what is measured.
        said = self.sweep("out", code=1, limit=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000)))
        self.assertRegex(said, r"cannot write \S+: file too large, with 4 of 5 runs done; the same command goes on")
        self.assertEqual(len(self.whole_runs("out")), 4)
        self.sweep("out")
        self.assertEqual(self.started().count(LENGTHS[0]), 1)
        self.assertEqual([run[1] for run in rows(self.table("out"))[2:]], [str(length) for length in LENGTHS + [0.5]])

    def test_only_one_sweep_is_at_work_in_a_folder(self):
        process, _ = self.held("out", f"specimen.length={LENGTHS[0]}")
        self.assertIn("another sweep is at work in " + self.path("out"), self.sweep("out", code=2))
        process.terminate()
        process.communicate()


class Repeated(Sweeps):
    SCATTERED = """
        method: method.yaml
        vary: {physics.accuracy: [draft], specimen.length: [0.2, 0.3]}
        repeat: 3"""

    def setUp(self):
        super().setUp()
        method = read(CONFIG, "straight.yaml").replace("extension: auto", "extension: 0.02")  # on to the break
        write(self.path("method.yaml"), method + "specimens: {scatter: {material.breaking_force: {normal: 0.1}}}\n")
        write(self.study, self.SCATTERED)

    def test_a_row_is_a_specimen_of_a_batch(self):
        self.sweep("out", "--jobs", "2")
        names, units, *runs = rows(self.table("out"))
        self.assertEqual((names[:5], units[2]), (["physics.accuracy", "specimen.length", "specimen", "exit_code", "error"], "-"))
        self.assertEqual([run[1:4] for run in runs], [[length, number, "0"] for length in ("0.2", "0.3") for number in "123"])
        forces = [run[names.index("peak_force")] for run in runs]
        for length, peaks in (("0.2", forces[:3]), ("0.3", forces[3:])):
            self.assertEqual(len(set(peaks)), 3, "they scatter")
            alone = self.path("alone", length)
            subprocess.run([REAL, self.path("method.yaml"), "--quiet", "--out", alone, "--specimens", "3", "--set",
                            "physics.accuracy=draft", "--set", "specimen.length=" + length], check=True)
            self.assertEqual(list(map(float, peaks)), [load(os.path.join(alone, f"specimen_00{i}/result.yaml"))["peak_force"]
                                                       for i in (1, 2, 3)])
        self.sweep("one", "--jobs", "1")
        self.assertEqual(self.table("one"), self.table("out"))
        self.sweep("out")
        self.assertEqual(self.started().count(0.2), 2, "not run again")

    def test_a_batch_that_crashes_is_as_many_rows_and_tried_again(self):
        self.sweep("out", KILL_AT="specimen.length=0.2")
        _, _, *runs = rows(self.table("out"))
        self.assertEqual([run[3:5] for run in runs], [["139", "killed by SIGSEGV"]] * 3 + [["0", ""]] * 3)
        self.sweep("out")
        self.assertEqual([run[3:5] for run in rows(self.table("out"))[2:]], [["0", ""]] * 6)


class TiedOnce(Sweeps):
    def test_runs_that_tie_alike_share_it_and_have_the_bits_of_runs_that_do_not(self):
        write(self.study, f"""
            method: {CONFIG}/tighten.yaml
            vary:
              physics.accuracy: [draft]
              material: [polypropylene]
              program.pull.until.extension: [0.004, 0.006]""")
        self.sweep("out", KNOT_UTM_NO_CACHE="")
        self.assertEqual(len(os.listdir(self.path("out/runs/.tied"))), 1)
        self.sweep("alone")
        self.assertEqual(self.table("out"), self.table("alone"))


class Content(Sweeps):
    def test_of_a_study_that_grows_is_kept(self):
        self.sweep("out", "--jobs", "1")
        write(self.study, read(self.study).replace("[0.1, ", "[0.25, 0.1, "))
        self.sweep("out")
        self.assertEqual(self.started(), LENGTHS + [0.25])
        self.assertEqual([run[1] for run in rows(self.table("out"))[2:]], [str(length) for length in [0.25] + LENGTHS])

    def test_that_changed_is_run_anew(self):
        os.mkdir(self.path("materials"))
        method = read(CONFIG, "straight.yaml").replace("material: nylon", "material: mine")
        material = read(CONFIG, "materials/nylon.yaml")
        write(self.path("method.yaml"), method)
        write(self.path("materials/mine.yaml"), material)
        write(self.study, "method: method.yaml\nvary: {physics.accuracy: [draft], specimen.length: [0.2]}")
        self.sweep("out")
        first = rows(self.table("out"))[2][-1]
        write(self.path("method.yaml"), "# Only said otherwise.\n" + method)
        self.sweep("out")
        self.assertEqual((self.started(), rows(self.table("out"))[2][-1]), ([0.2], first))
        write(self.path("materials/mine.yaml"), re.sub(r"(?m)^radius: \S+", "radius: 0.003", material))
        self.sweep("out")
        second = rows(self.table("out"))[2][-1]
        self.assertEqual(self.started(), [0.2, 0.2])
        write(self.path("method.yaml"), method.replace("grips: clamps", "grips: nodes"))
        self.sweep("out")
        self.assertEqual(self.started(), [0.2, 0.2, 0.2])
        self.assertEqual(len({first, second, rows(self.table("out"))[2][-1]}), 3)
        self.assertEqual(len(self.whole_runs("out")), 3)

    def test_the_file_of_the_other_ropes_counts(self):
        os.mkdir(self.path("materials"))
        write(self.path("method.yaml"), read(CONFIG, "knot.yaml") + "\nother_material: mine\n")
        names = set()
        for radius in (0.003, 0.002):
            write(self.path("materials/mine.yaml"), f"radius: {radius}\n")
            names.update(addresses(self.path("method.yaml"), [{}]))
        self.assertEqual(len(names), 2)


class Refused(Sweeps):
    def refused(self, *words):
        said = self.sweep("out", code=2)
        self.assertEqual(said.count("\n"), 1, said)
        for word in (self.study, *words):
            self.assertIn(word, said)
        self.assertFalse(os.path.exists(self.path("out")))
        self.assertEqual(self.started(), [])

    def test_before_the_first_run_starts(self):
        write(self.study, f"method: {CONFIG}/straight.yaml\nvary: {{specimen.length: [0.2, 0.3, -1, -2]}}")
        self.refused("specimen.length=-1", "specimen.length is -1", "2 of 4 runs")

    def test_a_folder_with_a_table_of_another_kind(self):
        os.makedirs(self.path("out"))
        write(self.path("out/table.csv"), "mine")
        write(self.study, f"method: {CONFIG}/straight.yaml\nvary: {{specimen.length: [0.2]}}")
        self.assertIn("table.csv exists already and is not of a sweep", self.sweep("out", code=2))
        self.assertEqual(os.listdir(self.path("out")), ["table.csv"])

    def test_no_study_and_no_place(self):
        self.study = self.path("absent.yaml")
        self.refused("no such file")
        write(self.path("out"), "a file")
        self.study = write(self.path("study.yaml"), f"method: {CONFIG}/straight.yaml\nvary: {{specimen.length: [0.2]}}")
        self.assertIn("cannot make the folder", self.sweep("out", code=2))
        self.assertIn("--jobs is 0", self.sweep("out", "--jobs", "0", code=2))
        self.assertIn("star is no run of " + self.study, self.sweep("out", "--only", "star", code=2))


if __name__ == "__main__":
    unittest.main()
