"""A launch with a master of its own, for tests in which the launch itself ends."""
import os
import signal
import socket
import subprocess
import time
import xmlrpc.client

LAST_RESORT = 180.0  # [s] on a machine however busy: a test waits for what is to happen, not for time


def free_port():
    with socket.socket() as one:
        one.bind(('localhost', 0))
        return one.getsockname()[1]


class OwnLaunch:
    """tighten.launch in the background; `end` says how it ended."""

    def __init__(self, **arguments):
        self.uri = 'http://localhost:%d' % free_port()
        port = self.uri.rsplit(':', 1)[1]
        words = ['%s:=%s' % item for item in arguments.items()]
        self._environment = dict(os.environ, ROS_MASTER_URI=self.uri)
        self._process = subprocess.Popen(['roslaunch', '-p', port, 'knot_utm', 'tighten.launch'] + words,
                                         env=self._environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                         universal_newlines=True)

    def pid(self, node):
        """Of a node; None where there is none that answers."""
        try:
            code, _, uri = xmlrpc.client.ServerProxy(self.uri).lookupNode('/test', '/' + node)
            return xmlrpc.client.ServerProxy(uri).getPid('/test')[2] if code == 1 else None
        except (OSError, xmlrpc.client.Error):
            return None

    def is_told(self, parameter):
        """Whether a node has set it."""
        return bool(xmlrpc.client.ServerProxy(self.uri).hasParam('/test', '/' + parameter)[2])

    def kill(self, node, by=signal.SIGKILL):
        """The process that the node was."""
        process = self.pid(node)
        os.kill(process, by)
        return process

    def tool(self, *command):
        """What a tool of ROS says that ends by itself."""
        return subprocess.run(command, env=self._environment, check=True, stdout=subprocess.PIPE, timeout=LAST_RESORT,
                              universal_newlines=True).stdout

    def end(self, timeout=LAST_RESORT):
        """What it said until it ended by itself."""
        try:
            return self._process.communicate(timeout=timeout)[0]
        except subprocess.TimeoutExpired:
            self.stop()
            raise

    def stop(self):
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
            self._process.communicate(timeout=LAST_RESORT)


def wait_until(what, condition, timeout=LAST_RESORT):
    end = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > end:
            raise AssertionError('timed out: ' + what)
        time.sleep(0.02)
