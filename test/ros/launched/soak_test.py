#!/usr/bin/python3
"""Thirty tests one after the other, each on a new specimen: the same files each time, /clock goes on, memory does not
grow. The soak itself says so, of as many samples as it is asked for."""
import csv
import os
import subprocess
import sys
import tempfile
import unittest

SOAK = os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench/soak.py')


class SoakTest(unittest.TestCase):

    def soak(self, *words):
        return subprocess.run([sys.executable, '-B', SOAK] + list(words), check=False, universal_newlines=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=900)

    def test_thirty_resets(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.soak('resets=30', 'samples=30000', 'busy=0', 'results=' + folder)
            self.assertEqual(done.returncode, 0, done.stdout)
            with open(os.path.join(folder, 'soak.csv'), encoding='utf-8', newline='') as file:
                table = {row['quantity']: row['value'] for row in csv.DictReader(file)}
            self.assertEqual(table['tests, each on a new specimen'], '30')
            self.assertEqual(table['published by the machine (sequence numbers)'], '30000')
            self.assertEqual(table['recorded'], '30000')

    def test_wrong_words(self):
        for word in ('samples=many', 'sample=10', 'resets=0'):
            self.assertEqual(self.soak(word).returncode, 2)


if __name__ == '__main__':
    unittest.main()
