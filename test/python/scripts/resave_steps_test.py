#!/usr/bin/python3
"""scripts/resave-steps: a step of an older layout becomes the same step of the present one, and nothing else is touched."""
import glob
import os
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../.."))
SCRIPT = os.path.join(ROOT, "scripts/resave-steps")
STEPS = sorted(glob.glob(os.path.join(ROOT, "test/failed_steps/*.bin")))


def text(words):
    return struct.pack("<Q", len(words)) + words.encode()


def archive(heading, payload):
    content = heading + b"\n" + struct.pack("<Q", len(payload)) + payload
    return content + struct.pack("<I", zlib.crc32(content))


def as_pro2(content):
    """The step as it was saved when the rod had all of its material and no bending law: PRO2, SET4."""
    heading, _, rest = content.partition(b"\n")
    payload = rest[8:-4]
    settings, boundary = payload.index(b"SET5"), payload.index(b"BND3")
    laws = settings - 2 * 8  # bending and twisting, which are without parameters
    counts = boundary - 5 * 8
    stiffnesses, lists = payload[4:44], payload[44:laws]
    rest_of_material = struct.pack("<d", 0.25) + struct.pack("<Qd", 1, 3e5) + 2 * struct.pack("<Q", 0) + 2 * text("cell")
    return archive(heading, b"PRO2" + text("own rope") + stiffnesses + rest_of_material + lists + b"SET4" +
                   payload[settings + 4:counts] + bytes(8) + payload[counts:])


class ResaveSteps(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, content):
        file = os.path.join(self.folder, "failed_step.bin")
        with open(file, "wb") as out:
            out.write(content)
        return file

    def resaved(self, content):
        """What becomes of the file, its exit code, and what it says."""
        file = self.write(content)
        run = subprocess.run([SCRIPT, file], capture_output=True, text=True, check=False)
        with open(file, "rb") as again:
            return again.read(), run.returncode, run.stderr

    def test_an_older_layout_becomes_the_present_one(self):
        self.assertTrue(STEPS)
        for name in STEPS:
            with open(name, "rb") as file:
                content = file.read()
            self.assertEqual(self.resaved(as_pro2(content)), (content, 0, ""), name)
            self.assertEqual(self.resaved(content), (content, 0, ""), name)

    def test_what_is_no_step_is_refused_in_one_line_and_stays(self):
        with open(STEPS[0], "rb") as file:
            step = file.read()
        unknown = step.replace(b"SET5", b"SET9")
        heading, _, rest = unknown.partition(b"\n")
        for content, why in ((b"", "no saved time step"), (step[:-1], "damaged"), (step[:99] + b"?" + step[100:], "damaged"),
                             (archive(heading, rest[8:-4]), "no section SET5")):
            kept, code, said = self.resaved(content)
            self.assertEqual((kept, code, len(said.splitlines())), (content, 2, 1))
            self.assertIn(why, said)


if __name__ == "__main__":
    unittest.main()
