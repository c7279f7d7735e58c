"""What the tests share in which a process is killed."""
import os
import signal
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import METHOD, ROOT, Launch


class Dying(unittest.TestCase):

    def dies(self, victim, ended_by, reason):
        """A process is killed in the middle of a test that a script runs."""
        with Launch('method:=' + METHOD, 'rviz:=false', command=[os.path.join(ROOT, 'scripts/tighten')]) as launch:
            launch.wait_for_rows(3)
            os.kill(launch.pid(victim), signal.SIGKILL)
            self.assertEqual(launch.end(), 1)
            console = launch.console()
            self.assertIn('files are in %s\n' % launch.out, console)
            # Once, and not what ended for that reason.
            self.assertEqual(console.count('process has died'), 1, console)
            self.assertRegex(console, r'\[%s(-\d+)?\] (has died!\n)?process has died \[.*exit code -9' % victim)
            self.assertEqual((launch.result('ended_by'), launch.result('reason')), (ended_by, reason), console)
            lines = launch.text('curve.csv').split('\n')
            self.assertEqual(lines[-1], '')
            self.assertGreaterEqual(len(lines), 2 + 3 + 1)
            self.assertEqual({len(line.split(',')) for line in lines[:-1]}, {len(lines[0].split(','))})
