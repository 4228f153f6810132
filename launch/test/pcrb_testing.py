"""What the rostests share: child processes, the benchmark server as one, its store, a test case.

Everything waits on a condition and up to a limit that only a hanging program reaches; children are
ended by their own process id. Executables are found in the devel and in the install space.
"""
import contextlib
import itertools
import os
import re
import shlex
import shutil
import signal
import sqlite3
import subprocess
import tempfile
import unittest

import roslib.packages
import rospy
from pcrb_testing_client import Client
from pcrb_testing_wait import LIMIT, wait_until

TIME_COLUMNS = ('runtime_s', 'solver_time_s', 'finished')

_namespaces = itertools.count(1)


def executable(package, name):
    found = roslib.packages.find_node(package, name)
    if not found:
        raise AssertionError(f'{package} has no executable {name}: is it built?')
    return found[0]


def front_door():
    """pcrb lies in the bin of the space whose lib has the programs."""
    return os.path.join(os.path.dirname(executable('pcrb_tools', 'report')), '..', '..', 'bin', 'pcrb')


def gated_client(gate):
    """Command of a client that gives one reply and no other until the file `gate` exists."""
    return ' '.join(shlex.quote(word) for word in ('python3', executable('pcrb_launch', 'gated_client.py'), gate))


def open_gate(gate):
    with open(gate, 'w'):
        pass


class Child:
    """A process of a test, in a session of its own; its output goes to one file.

    It gets SIGTERM if the test dies first, as when rostest ends one that hangs.
    """

    def __init__(self, command, namespace='/', **environment):
        self.command = command
        self._output = tempfile.TemporaryFile(mode='w+')
        variables = {**os.environ, 'ROS_NAMESPACE': namespace, **environment}
        self.process = subprocess.Popen(
            ['setpriv', '--pdeathsig', 'TERM', *command], stdout=self._output, stderr=subprocess.STDOUT,
            env=variables, start_new_session=True)

    def output(self):
        size = os.fstat(self._output.fileno()).st_size
        return os.pread(self._output.fileno(), size, 0).decode(errors='replace')

    def ended(self):
        return self.process.poll() is not None

    def wait(self, limit=LIMIT):
        """Exit status; negative for a signal."""
        try:
            return self.process.wait(limit)
        except subprocess.TimeoutExpired:
            raise AssertionError(f'{self.command[0]} did not end within {limit:g} s:\n{self.output()}') from None

    def wait_for_output(self, pattern, limit=LIMIT):
        """The first match of a regular expression, which must come before the process ends."""
        def found():
            has_ended = self.ended()
            match = re.search(pattern, self.output())
            if not match and has_ended:
                raise AssertionError(f'{self.command[0]} ended without printing {pattern}:\n{self.output()}')
            return match
        return wait_until(found, f'{self.command[0]} prints {pattern}', limit)

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)

    def kill(self):
        """SIGKILL at once to it and to what it started; does nothing to processes that have ended."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()


class Launch(Child):
    """A launch file of this package with its arguments, run by the test's master."""

    def __init__(self, file, **arguments):
        super().__init__(['roslaunch', 'pcrb_launch', file, *(f'{name}:={value}' for name, value in arguments.items())])

    def kill(self):
        """Ends the nodes, too."""
        if not self.ended():
            self.interrupt()
            self.wait()


class Server(Child):
    """benchmark_server with private parameters, in a namespace of its own unless one is given."""

    def __init__(self, namespace=None, node='benchmark_server', **parameters):
        self.namespace = namespace or f'/server{next(_namespaces)}'
        name = f'{self.namespace}/{node}'
        if rospy.has_param(name):
            rospy.delete_param(name)
        rospy.set_param(name, {'summary_hold_time': 0.0, 'results': 'live', **parameters})
        self.parameters = parameters
        self.run = parameters.get('run')
        super().__init__([executable('pcrb_server', 'benchmark_server'), f'__name:={node}'], self.namespace)

    def again(self, **changes):
        """Another one with the same parameters but for the changes."""
        return Server(self.namespace, **{**self.parameters, **changes})

    def rows(self):
        return rows(self.run)

    def call(self, service, kind, *request):
        name = f'{self.namespace}/{service}'
        rospy.wait_for_service(name, LIMIT)
        return rospy.ServiceProxy(name, kind)(*request)


def select(run, table, query):
    """Rows of a run's store as dictionaries; none before the table is there."""
    path = os.path.join(run, 'results.sqlite')
    if not os.path.exists(path):
        return []
    with contextlib.closing(sqlite3.connect(f'file:{path}?mode=ro', uri=True, timeout=LIMIT)) as store:
        store.row_factory = sqlite3.Row
        if not store.execute('SELECT 1 FROM sqlite_master WHERE name = ?', [table]).fetchone():
            return []
        return [dict(row) for row in store.execute(query)]


def forget_results(run, condition):
    """So that a run has problems to go on with."""
    with contextlib.closing(sqlite3.connect(os.path.join(run, 'results.sqlite'))) as store, store:
        store.execute(f'DELETE FROM result WHERE {condition}')


def rows(run):
    """The result table, in the order in which it was filled."""
    return select(run, 'result', 'SELECT * FROM result ORDER BY finished')


def run_info(run):
    return {row['key']: row['value'] for row in select(run, 'run', 'SELECT key, value FROM run')}


def sessions(run):
    return select(run, 'session', 'SELECT * FROM session ORDER BY started')


def row_key(row):
    return row['sequence'], row['kind'], row['problem_id']


class TestCase(unittest.TestCase):
    """A test with a folder; its processes and clients are ended with it."""

    longMessage = True

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix='pcrb_rostest_')
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def write(self, name, text):
        """A file of the test's folder, as its path."""
        path = self.path(name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)
        return path

    def start(self, child):
        self.addCleanup(child.kill)
        return child

    def server(self, data, **parameters):
        return self.start(Server(**{'root': data.root, 'run': self.path('run'), **parameters}))

    def client(self, server):
        client = Client(server.namespace)
        self.addCleanup(client.close)
        return client

    def assert_ends_well(self, child):
        self.assertEqual(child.wait(), 0, child.output())

    def assert_fails(self, child, *patterns):
        """Ends with a status that is an error's, not a signal's, and says why."""
        self.assertGreater(child.wait(), 0, child.output())
        for pattern in patterns:
            self.assertRegex(child.output(), pattern)

    def assert_rows_of(self, run, problems):
        """Exactly one row per problem."""
        self.assertEqual(sorted(row_key(row) for row in rows(run)), sorted(problem.key for problem in problems))

