"""The whole system launched as a user does it, each time with a master and a folder of its own."""
import filecmp
import os
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import xmlrpc.client

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), '..'))
METHOD = os.path.join(ROOT, 'test/ros/pull_and_hold.yaml')
TOOL = os.path.join(ROOT, 'build/devel/lib/knot_utm/tensile_test')
FILES = ['curve.csv', 'curve_full.csv', 'final_shape.csv', 'method.yaml', 'test.bag']
LAST_RESORT = 180.0  # [s] on a machine however busy: whoever waits does so for what is to happen, not for time


GIVEN = set()  # ports: one stays free until the master that got it has begun to listen, and may be offered again


def free_port():
    while True:
        with socket.socket() as probe:
            probe.bind(('127.0.0.1', 0))
            port = probe.getsockname()[1]
        if port not in GIVEN:
            GIVEN.add(port)
            return port


def wait_for(what, condition):
    """The first true value of condition()."""
    end = time.monotonic() + LAST_RESORT
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError('timed out: ' + what)
        time.sleep(0.05)


def words(pid):
    """The command line of a process."""
    try:
        with open('/proc/%d/cmdline' % pid, encoding='utf-8') as file:
            return file.read().split('\0')
    except OSError:
        return []


def children(pid):
    found = []
    for entry in filter(str.isdigit, os.listdir('/proc')):
        try:
            with open('/proc/%s/stat' % entry, encoding='utf-8') as file:
                if int(file.read().rsplit(')', 1)[1].split()[1]) == pid:
                    found.append(int(entry))
        except OSError:
            pass
    return found


def reading_times(folder):
    """When the load cell was read so far [s], by samples.csv in a folder; none where it is not there."""
    try:
        with open(os.path.join(folder, 'samples.csv'), encoding='utf-8') as file:
            names, *rows = (line.split(',') for line in file.read().splitlines(keepends=True) if line.endswith('\n'))
    except (OSError, ValueError):
        return []
    read, time_ = names.index('command_read_cell'), names.index('command_time')
    return [float(row[time_]) for row in rows if row[0].startswith('answer') and row[read] == '1']


class Launch:
    """tighten.launch, or another one that `command` starts, under way in a folder of its own; `with` ends it."""

    def __init__(self, *arguments, command=None, environment=None, prepare=None, port=None):
        self.folder = tempfile.mkdtemp(prefix='knot_utm_')
        if prepare:
            prepare(self.folder)
        self.out = os.path.join(self.folder, 'out')
        self.port = port or free_port()
        self.uri = 'http://localhost:%d' % self.port
        self.environment = dict(os.environ, ROS_MASTER_URI=self.uri, ROS_HOME=os.path.join(self.folder, 'log'),
                                ROS_LOG_DIR=os.path.join(self.folder, 'log'),
                                KNOT_UTM_SKIP_BUILD='1', KNOT_UTM_NO_CACHE='1', **(environment or {}))
        command = command or ['roslaunch', 'knot_utm', 'tighten.launch']
        with open(os.path.join(self.folder, 'console'), 'wb') as console:
            self.process = subprocess.Popen(
                command + ['-p', str(self.port), 'working_directory:=' + self.folder, 'out:=out'] + list(arguments),
                stdout=console, stderr=subprocess.STDOUT, env=self.environment, cwd=self.folder, start_new_session=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            for pid in self.processes().values():
                os.kill(pid, signal.SIGCONT)
            # roslaunch itself, not the script that started it.
            os.kill(self.roslaunch() or self.process.pid, signal.SIGINT)
            try:
                self.process.wait(LAST_RESORT)
            except subprocess.TimeoutExpired:
                os.killpg(self.process.pid, signal.SIGKILL)
                self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def roslaunch(self):
        """Its process: the one started, or one that a script started."""
        for pid in [self.process.pid] + children(self.process.pid):
            if any(word.endswith('/roslaunch') for word in words(pid)):
                return pid
        return None

    def processes(self):
        """Node (or master) -> process."""
        parent = self.roslaunch()
        found = {}
        for pid in children(parent) if parent else []:
            for word in words(pid):
                if word.startswith('__name:='):
                    found[word[len('__name:='):]] = pid
                elif word.endswith('/rosmaster'):
                    found['master'] = pid
        return found

    def pid(self, node):
        return wait_for(node, lambda: self.processes().get(node))

    def answers(self, node):
        """Whether the master is there and knows the node."""
        try:
            with xmlrpc.client.ServerProxy(self.uri) as master:
                return master.lookupNode('/test', '/' + node)[0] == 1
        except OSError:
            return False

    def rows(self):
        """Readings of the load cell so far, in samples.csv."""
        return len(reading_times(self.out))

    def wait_for_rows(self, rows):
        def are_there():
            ended = self.process.poll() is not None
            if self.rows() >= rows:
                return True
            if ended:
                raise AssertionError('it ended before it had %d rows; the console: %s' % (rows, self.console()))
            return False
        wait_for('%d rows' % rows, are_there)

    def end(self):
        """Waits for it to end by itself. Returns its exit code."""
        try:
            return self.process.wait(LAST_RESORT)
        except subprocess.TimeoutExpired:
            raise AssertionError('goes on after %g s; the console: %s' % (LAST_RESORT, self.console())) from None

    def console(self):
        with open(os.path.join(self.folder, 'console'), encoding='utf-8', errors='replace') as file:
            return file.read()

    def text(self, name):
        with open(os.path.join(self.out, name), encoding='utf-8') as file:
            return file.read()

    def result(self, key):
        return re.search('^%s: (.*)$' % key, self.text('result.yaml'), re.MULTILINE)[1].strip('"')


class Headless:
    """The files that the same test leaves without ROS."""

    def __init__(self, method, *overrides):
        self.folder = tempfile.mkdtemp(prefix='knot_utm_')
        command = [TOOL, method, '--quiet', '--bag', '--out', self.folder]
        for override in overrides:
            command += ['--set', override]
        subprocess.run(command, check=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.folder)

    def different(self, folder):
        """Files that are not the same, byte for byte."""
        return filecmp.cmpfiles(self.folder, folder, FILES, shallow=False)[1:]
