#!/usr/bin/python3
"""doc/ros_in_ten_lines.md, to the letter, in shells that know nothing else: in a folder with a blank in its name, and where a
Python that knows nothing of ROS stands first on the path."""
import os
import re
import signal
import subprocess
import tempfile
import unittest
import xmlrpc.client

from launched import LAST_RESORT, ROOT, children, free_port, wait_for

PROGRAMS = ['knot_node', 'utm_node', 'recorder_node', 'panel_node', 'tensile_test', 'compare']


def blocks(page):
    """The indented blocks of a page, each a list of lines."""
    with open(os.path.join(ROOT, 'doc', page), encoding='utf-8') as file:
        return [block.replace('    ', '').strip().split('\n') for block in re.findall(r'(?:^    .+\n?)+', file.read(), re.MULTILINE)]


class Shell:
    """A bare one, which runs the lines one after the other; what it says goes to a file."""

    def __init__(self, folder, uri, name):
        environment = {'HOME': folder, 'PATH': os.path.join(folder, 'pyenv') + ':/usr/bin:/bin', 'ROS_MASTER_URI': uri}
        self.file = os.path.join(folder, name)
        with open(self.file, 'wb') as said:
            self.process = subprocess.Popen(['/bin/bash'], cwd=folder, env=environment, stdin=subprocess.PIPE, stdout=said,
                                            stderr=subprocess.STDOUT, universal_newlines=True, bufsize=1)

    def begin(self, lines):
        print(*lines, sep='\n', file=self.process.stdin, flush=True)

    def run(self, lines, name):
        """Waits until all of them have ended; returns what they said."""
        begin = len(self.said())
        self.begin(['{ %s; } </dev/null || echo failed: %s' % (line, line.split()[0]) for line in lines] + ['echo end of ' + name])
        wait_for(name, lambda: 'end of ' + name in self.said())
        return self.said()[begin:]

    def said(self):
        with open(self.file, encoding='utf-8', errors='replace') as file:
            return file.read()

    def interrupt(self):
        """What it runs, as Ctrl-C does."""
        for running in children(self.process.pid):
            os.kill(running, signal.SIGINT)

    def leave(self):
        self.interrupt()
        self.process.stdin.close()
        self.process.wait(LAST_RESORT)


class InBareShells(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix='a folder ')
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        os.symlink(os.path.join(ROOT, 'build'), os.path.join(self.folder, 'build'))
        os.mkdir(os.path.join(self.folder, 'pyenv'))
        for name in 'python', 'python3':
            shim = os.path.join(self.folder, 'pyenv', name)
            with open(shim, 'w', encoding='utf-8') as file:
                file.write('#!/bin/sh\necho "this Python knows nothing of ROS" >&2\nexit 1\n')
            os.chmod(shim, 0o755)
        self.uri = 'http://localhost:%d' % free_port()

    def shell(self, name):
        shell = Shell(self.folder, self.uri, name)
        self.addCleanup(shell.leave)
        return shell

    def master_finds(self, look_up, name):
        try:
            with xmlrpc.client.ServerProxy(self.uri) as master:
                return getattr(master, look_up)('/test', name)[0] == 1
        except OSError:
            return False


class TenLinesTest(InBareShells):

    def test_lines(self):
        launch, ask, read, stay, start, core, play = blocks('ros_in_ten_lines.md')
        self.assertEqual(len({*launch, *ask, *read, *stay, *start, *core, *play}), 10)
        first, second = self.shell('first'), self.shell('second')
        first.begin(launch + ['echo the launch has ended'])
        # As whoever types them sees that the test runs.
        wait_for('the test', lambda: self.master_finds('lookupNode', '/utm_node') and 'holds a run' not in first.said())
        said = second.run(ask, 'the questions')
        self.assertIn('progress: ', said)
        wait_for('the end', lambda: 'the launch has ended' in first.said())
        self.assertRegex(first.said(), r'readings were written to .*/out/tighten')
        for word in ('ERROR', 'has died', 'ld.so', 'knows nothing'):
            self.assertNotIn(word, first.said())
        said += second.run(read, 'the readings')
        self.assertRegex(said, r'topics: +/knot/colors|/knot/state')
        self.assertIn('plateau', said)
        said += self.nodes_that_stay(first, second, stay, start)
        first.begin(['roscore() { command roscore -p %s; }' % self.uri.rsplit(':', 1)[1]])  # else its port is always the same
        first.begin(core)
        wait_for('the master', lambda: self.master_finds('lookupNode', '/rosout'))
        said += second.run(play, 'the bag')
        self.assertIn('[RUNNING]', said)
        for word in ('failed: ', 'rror', 'not executable', 'knows nothing'):
            self.assertNotIn(word, said)

    def nodes_that_stay(self, first, second, stay, start):
        """Ends them by Ctrl-C once the test that was asked for is written; returns what the call said."""
        first.begin(stay + ['echo the nodes have ended'])
        wait_for('the service', lambda: self.master_finds('lookupNode', '/recorder_node') and
                 self.master_finds('lookupService', '/utm/start_test'))
        said = second.run(start, 'the call')
        for part in ('accepted: True', 'out/tighten-2'):
            self.assertIn(part, said)
        written = os.path.join(self.folder, 'out/tighten-2')  # the recorder makes it after the call was answered
        wait_for('the second test', lambda: os.path.exists(os.path.join(written, 'result.yaml')))
        with open(os.path.join(written, 'method.yaml'), encoding='utf-8') as file:
            self.assertRegex(file.read(), r'preload: 70\n')
        self.assertNotIn('the nodes have ended', first.said())
        first.interrupt()
        wait_for('the end of the nodes', lambda: 'the nodes have ended' in first.said())
        return said

    def test_programs_answer_without_a_master(self):
        shell = self.shell('third')
        shell.run(['source build/devel/setup.bash'], 'the environment')
        for name in PROGRAMS:
            said = shell.run(['rosrun knot_utm %s --version' % name, 'rosrun knot_utm %s --help' % name], name)
            self.assertRegex(said, r'(?i)^\d+\.\d+\.\d+\n(.*\n)*usage: ', name)
            self.assertNotIn('failed', said)
            said = shell.run(['rosrun knot_utm %s --nonsense; test $? = 2' % name], name + ' refuses')
            self.assertNotIn('failed', said, name)
            self.assertIn('--nonsense', said)


if __name__ == '__main__':
    unittest.main()
