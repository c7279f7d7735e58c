#!/usr/bin/python3
"""On a terminal scripts/tighten shows the progress line of tensile_test, and none elsewhere."""
import os
import pty
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import LAST_RESORT, METHOD, ROOT, TOOL, free_port

LINE = re.compile(r'\r(\w+) +[\d.]+ %  s +[-\d.]+ mm  F +\S+ N +\S+ x real time +\S+ s left ')


def on_terminal(*command, **environment):
    """What a command says on one."""
    ours, its = pty.openpty()
    process = subprocess.Popen(command, stdin=its, stdout=its, stderr=its, env=dict(os.environ, **environment), start_new_session=True)
    os.close(its)
    said = b''
    while True:
        try:
            part = os.read(ours, 65536)
        except OSError:  # so ends a terminal
            break
        said += part
        if not part:
            break
    os.close(ours)
    process.wait(LAST_RESORT)
    return said.decode('utf-8', 'replace')


class ProgressTest(unittest.TestCase):

    def test_the_line_is_that_of_tensile_test(self):
        with tempfile.TemporaryDirectory() as folder:
            words = ['method:=' + METHOD, "overrides:='program.hold.duration=2'", 'rviz:=false', 'out:=' + folder + '/live']
            said = on_terminal(os.path.join(ROOT, 'scripts/tighten'), *words, '-p', str(free_port()), KNOT_UTM_SKIP_BUILD='1',
                               ROS_HOME=folder)
            headless = on_terminal(TOOL, METHOD, '--set', 'program.hold.duration=2000', '--out', folder + '/headless')
            for one in said, headless:
                self.assertIn('hold', LINE.findall(one), one)
            self.assertIn('scripts/tighten: the files are in %s/live' % folder, said)


if __name__ == '__main__':
    unittest.main()
