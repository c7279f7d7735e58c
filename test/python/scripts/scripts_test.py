#!/usr/bin/python3
"""scripts/: each answers --help before it sets up or builds, in one style, and refuses what it does not know; set-up says
what it will do; a build folder that was moved is built anew."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../.."))
SCRIPTS = sorted(name for name in os.listdir(os.path.join(ROOT, "scripts"))
                 if os.access(os.path.join(ROOT, "scripts", name), os.X_OK)
                 and os.path.isfile(os.path.join(ROOT, "scripts", name)))


def text(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8", errors="replace") as file:
        return file.read()


def run(*command, **options):
    return subprocess.run(command, check=False, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, **options)


def tree(folder):
    return sorted(os.path.join(where, name) for where, folders, files in os.walk(folder) for name in folders + files)


class Help(unittest.TestCase):
    def test_every_script_answers_before_it_does_anything(self):
        self.assertGreater(len(SCRIPTS), 13)
        with tempfile.TemporaryDirectory() as folder:
            # Nothing to build, and nothing that could be needed for it.
            for part in ("scripts", "launch"):
                shutil.copytree(os.path.join(ROOT, part), os.path.join(folder, part))
            tools = os.path.join(folder, "tools")
            os.mkdir(tools)
            for tool in ("bash", "basename", "dirname", "readlink", "sed"):
                os.symlink(shutil.which(tool), os.path.join(tools, tool))
            before = tree(folder)
            for name in SCRIPTS:
                script = os.path.join(folder, "scripts", name)
                with open(script, encoding="utf-8") as file:
                    # Without the modules that set-up installs.
                    interpreter = ["/usr/bin/python3", "-S"] if "python3" in file.readline() else ["/bin/bash"]
                for words in (["--help"], ["-h"], ["word", "--help"]):
                    if words[0] == "word" and "python3" in interpreter[0]:
                        continue
                    said = run(*interpreter, script, *words, cwd=folder, env={"PATH": tools})
                    self.assertEqual((said.returncode, said.stderr), (0, ""), name)
                    self.assertTrue(said.stdout.startswith(f"usage: scripts/{name}"), said.stdout)
                    self.assertRegex(said.stdout, r"(?m)^examples:\n +", name)
                    self.assertRegex(said.stdout, r"(?m)^exit codes: 0 ", name)
            self.assertEqual(tree(folder), before)

    def test_tighten_names_every_argument(self):
        said = run(os.path.join(ROOT, "scripts/tighten"), "--help").stdout
        for name in re.findall(r'<arg name="(\w+)"', text("launch/tighten.launch")):
            self.assertRegex(said, rf"(?m)^  {name} \[", name)

    def test_unknown_options_are_refused(self):
        for name in SCRIPTS:
            said = run(os.path.join(ROOT, "scripts", name), "--nonsense", "x",
                       env={**os.environ, "KNOT_UTM_SKIP_BUILD": "1"})
            self.assertEqual(said.returncode, 2, f"{name}: {said.stdout}{said.stderr}")
            self.assertTrue(said.stderr.strip(), name)

    def test_wrong_words_are_refused_in_a_line_that_says_where_all_are_told(self):
        for name in ("fit", "knot", "rank", "sweep"):
            for words in ((), ("--nonsense", "x")):
                said = run(os.path.join(ROOT, "scripts", name), *words, env={**os.environ, "KNOT_UTM_SKIP_BUILD": "1"})
                self.assertRegex(said.stderr, rf"^{name}: .* \(\S*scripts/{name} --help\)\n$")


class Size(unittest.TestCase):
    def test_no_room_is_larger_than_it_may_be(self):
        said = run(os.path.join(ROOT, "scripts/size"), "--check")
        if said.returncode == 2:
            self.skipTest(said.stderr)
        self.assertEqual(said.returncode, 0, said.stdout)


class Setup(unittest.TestCase):
    # Instead of what would change the machine.
    INSTEAD = r"""
        dpkg-query() { :; }
        env() {
          case $* in
            *" update") if [ -n "$LOCK" ] && mkdir "$LOCK" 2>/dev/null; then echo "E: Could not get lock $LOCK." >&2; return 100; fi ;;
            *) echo "0 upgraded, 424 newly installed" ;;
          esac
        }
        sleep() { :; }
        id() { echo 0; }
        getent() { return "$NO_LOCALHOST"; }
        tee() { sed "s|^|to $2: |" >&2; }
        . "$0/scripts/setup" """

    def said(self, no_localhost=0, lock=""):
        done = run("/bin/bash", "-euc", self.INSTEAD, ROOT,
                   env={**os.environ, "NO_LOCALHOST": str(no_localhost), "DISPLAY": "", "LOCK": lock})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, done.stderr

    def test_waits_for_another_program_that_installs(self):
        with tempfile.TemporaryDirectory() as folder:
            said, errors = self.said(lock=os.path.join(folder, "lock"))
        self.assertRegex(said, r"installing these packages, and what they need: g\+\+ .* rosbash ")
        self.assertEqual(said.count("another program installs packages: waiting for it to end"), 1, said)
        self.assertEqual(errors, "")
        self.assertIn("424 newly installed", said)

    def test_says_what_it_changes(self):
        said, changed = self.said(no_localhost=2)
        self.assertIn("/etc/hosts", said)
        self.assertEqual(changed, "to /etc/hosts: 127.0.0.1 localhost\n")
        self.assertNotIn("/etc/hosts", "".join(self.said()))


class BuildFolder(unittest.TestCase):
    def build(self, root):
        done = run(os.path.join(root, "scripts/build"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue(os.path.exists(os.path.join(root, "build/made")))
        return done.stdout.count("it is built anew")

    def test_that_was_moved_or_copied_is_built_anew(self):
        with tempfile.TemporaryDirectory() as folder:
            one, other, copy = (os.path.join(folder, name) for name in ("one", "other", "copy"))
            os.mkdir(one)
            shutil.copytree(os.path.join(ROOT, "scripts"), os.path.join(one, "scripts"))
            with open(os.path.join(one, "CMakeLists.txt"), "w", encoding="utf-8") as file:
                file.write("cmake_minimum_required(VERSION 3.18)\nproject(one NONE)\n"
                           "add_custom_target(make ALL touch ${CMAKE_BINARY_DIR}/made)\n")
            self.assertEqual(self.build(one), 0)
            self.assertEqual(self.build(one), 0)
            os.rename(one, other)
            self.assertEqual(self.build(other), 1)
            self.assertEqual(self.build(other), 0)
            shutil.copytree(other, copy)
            self.assertEqual(self.build(copy), 1)
            os.symlink(copy, one)
            self.assertEqual(self.build(one), 0, "another name of the same folder")

    def test_of_every_script_is_looked_at(self):
        for name in SCRIPTS:
            for folder in re.findall(r'cmake -S "\$root" -B ("[^"]*")', text("scripts", name)):
                self.assertIn(f"forget_moved {folder} \"$root\"", text("scripts", name), name)


class Output(unittest.TestCase):
    def test_of_a_script_has_nothing_of_what_was_installed_and_built(self):
        """A table may be sent into a file."""
        prepared = {name: found[1] for name in SCRIPTS
                    if (found := re.search(r"^prepare .*\nrun_module ([\w.]+)", text("scripts", name), re.MULTILINE))}
        self.assertLessEqual({"fit", "knot", "movie", "rank", "sweep"}, set(prepared))
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(os.path.join(ROOT, "scripts"), os.path.join(folder, "scripts"))
            for file, content in (("scripts/setup", "echo installed\n"), ("scripts/build", "#!/bin/bash\necho built $*\n")):
                with open(os.path.join(folder, file), "w", encoding="utf-8") as out:
                    out.write(content)
            for module in prepared.values():
                file = os.path.join(folder, "python/knot_utm", module.replace(".", "/") + ".py")
                os.makedirs(os.path.dirname(file), exist_ok=True)
                with open(file, "w", encoding="utf-8") as out:
                    out.write("print('the table')\n")
            for name in prepared:
                said = run(os.path.join(folder, "scripts", name), "word",
                           env={key: value for key, value in os.environ.items() if key != "KNOT_UTM_SKIP_BUILD"})
                self.assertEqual((said.returncode, said.stdout), (0, "the table\n"), name)
                self.assertTrue(said.stderr.startswith("installed\n"), name)


if __name__ == "__main__":
    unittest.main()
