#!/usr/bin/env python3
"""What SIGKILL leaves: programs that are started again end with the same bytes, and no file is ever half of one.

Prints how many kills there were, for docs/trust.md; PCRB_LONG_TESTS=1 makes them many more.
"""
import contextlib
import functools
import http.server
import os
import random
import re
import shutil
import socket
import sys
import tarfile
import threading
import time

import rospy
import rostest
from geometry_msgs.msg import PoseStamped

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, executable, rows, wait_until
from pcrb_testing_bridge import BridgeTestCase, make_answer
from pcrb_testing_ports import free_ports
from pcrb_testing_processes import command_lines
from survival_test import without_times

LONG = os.environ.get('PCRB_LONG_TESTS') == '1'
TEMPORARY = re.compile(r'\.(partial|part|lock|tmp)\b|(^|/)\.[^/]*$|-(wal|shm|journal)$|\.log$')
TIMES = {'report.json', 'index.html', 'SHA256SUMS'}  # may have paths or times in them


class QuietHandler(http.server.SimpleHTTPRequestHandler):

    def log_message(self, *_):
        pass


def files_below(folder):
    """Contents by path, side files with times and what is temporary left out."""
    found = {}
    for base, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(base, name)
            if not TEMPORARY.search(os.path.relpath(path, folder)) and not name.endswith(('.yaml', '.sqlite', '.unpacked')):
                with open(path, 'rb') as file:
                    found[os.path.relpath(path, folder)] = file.read()
    return found


class KillsTest(BridgeTestCase):

    total = 0

    @classmethod
    def tearDownClass(cls):
        print(f'{cls.total} kills in all', flush=True)

    def count(self, program, kills):
        type(self).total += kills
        print(f'{program:22} {kills:4} kills', flush=True)

    def play(self, command, output):
        """Runs a program to its end; how long it took, and what it made."""
        start = time.monotonic()
        child = self.start(Child(command))
        self.assert_ends_well(child)
        return time.monotonic() - start, files_below(output)

    def check_kills(self, program, command_to, kills):
        """Kills a program at random moments of its work, in several folders; then lets it end.

        @param command_to  the command line that makes its output in a folder.
        """
        whole = self.path(program, 'whole')
        os.makedirs(whole)
        duration, expected = self.play(command_to(whole), whole)
        self.assertTrue(expected, f'{program} makes something')
        moments = random.Random(program)
        done, again = 0, 0
        while done < kills:
            again += 1
            folder = self.path(program, f'killed{again}')
            os.makedirs(folder)
            for _ in range(min(kills - done, 5)):
                start = time.monotonic()
                child = self.start(Child(command_to(folder)))
                end = start + moments.uniform(0, 1.1 * duration)
                wait_until(lambda c=child, e=end: c.ended() or time.monotonic() > e, 'the moment comes')
                if child.ended():
                    self.assert_ends_well(child)
                    duration = min(duration, time.monotonic() - start)  # the first run may have waited for a processor
                    break
                child.kill()
                done += 1
                for name, content in files_below(folder).items():
                    if os.path.basename(name) not in TIMES:
                        self.assertEqual(content, expected.get(name), f'{program} left half of {name}')
            self.assert_ends_well(self.start(Child(command_to(folder))))
            made = files_below(folder)
            self.assertEqual(set(made), set(expected), program)
            for name in set(made) - TIMES:
                self.assertEqual(made[name], expected[name], f'{program}: {name}')
        self.count(program, done)

    def test_tools(self):
        kills = 100 if LONG else 3
        data = maths.make_data_set(self.path('rooms'), points=1500)
        tool = functools.partial(executable, 'pcrb_tools')
        scans = data.folder('kitchen')
        self.check_kills('build_map', lambda folder: [tool('build_map'), scans, '-o', f'{folder}/map.pcd', '--leaf', '0.05'],
                         kills)
        self.check_kills('compute_overlap', lambda folder: [
            tool('compute_overlap'), scans, '-o', f'{folder}/kitchen_overlap.txt', '--distance', '0.2'], kills)
        logs = self.path('logs')
        self.play([tool('make_sample_logs'), '--output', logs], logs)
        for data_set in 'eth', 'planetary', 'tum', 'kaist':
            inputs = [os.path.join(logs, data_set, name) for name in sorted(os.listdir(os.path.join(logs, data_set)))]
            inputs = [path for path in inputs if os.path.isdir(path) or path.endswith(('.tgz', '.zip', '.tar.gz', '.bag'))][:1]
            self.check_kills(f'{data_set}_to_pcd', lambda folder, d=data_set, i=inputs: [tool(f'{d}_to_pcd'), *i, '--root', folder],
                             kills)
        self.check_kills('prepare_dataset', lambda folder: [tool('prepare_dataset'), 'eth', '--logs', logs, '--root', folder,
                                                            '--overlap-pairs', '2'], kills)

    def test_fetch_datasets(self):
        data = maths.make_data_set(self.path('rooms'), points=4000)
        served = self.path('served')
        os.makedirs(served)
        with tarfile.open(os.path.join(served, 'kitchen.tgz'), 'w:gz') as archive:
            archive.add(data.folder('kitchen'), 'kitchen')
        shutil.copy(data.folder('kitchen_local.txt'), served)
        handler = functools.partial(QuietHandler, directory=served)
        server = http.server.ThreadingHTTPServer(('127.0.0.1', 0), handler)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.shutdown)
        url = f'http://127.0.0.1:{server.server_port}'
        sources = self.path('sources.yaml')
        with open(sources, 'w') as file:
            file.write('sources:\n'
                       '  - {data_set: rooms, sequence: kitchen, set: published, kind: clouds, file: published/kitchen.tgz,'
                       f' url: "{url}/kitchen.tgz"}}\n'
                       '  - {data_set: rooms, sequence: kitchen, set: published, kind: problems, file: problems/kitchen_local.txt,'
                       f' url: "{url}/kitchen_local.txt"}}\n')
        self.check_kills('fetch_datasets', lambda folder: [
            executable('pcrb_tools', 'fetch_datasets'), 'kitchen', '--logs', f'{folder}/logs', '--root', f'{folder}/root',
            '--sources', sources, '--fetch-only'], 100 if LONG else 3)

    def finished_run(self):
        """A run with results, made by a client that says the guess."""
        server = self.server(maths.make_data_set(self.path('rooms'), points=300, perturbations=4))
        self.client(server).serve(server)
        self.assert_ends_well(server)
        return server

    def test_report(self):
        run = self.finished_run().run
        self.check_kills('report', lambda folder: [executable('pcrb_tools', 'report'), f'mine={run}', '--output', folder,
                                                   '--no-figures', '--resamples', '50'], 100 if LONG else 3)

    def test_run_paper(self):
        """The processes that it started end with it, and a rerun goes on."""
        data = maths.make_data_set(self.path('rooms'), points=300)
        run = self.path('paper')
        command = [executable('pcrb_tools', 'run_paper'), '--root', data.root, '--run', run, '--methods', 'icp', '--no-figures']
        moments, kills = random.Random(5), 0
        for _ in range(20 if LONG else 2):
            child = self.start(Child(command))
            end = time.monotonic() + moments.uniform(0.2, 8)
            wait_until(lambda c=child, e=end: c.ended() or time.monotonic() > e, 'the moment comes')
            if child.ended():
                self.assert_ends_well(child)
                shutil.rmtree(run)
                continue
            child.kill()
            kills += 1
            wait_until(lambda: not self.left_of(run), 'what it started has ended')
        self.assert_ends_well(self.start(Child(command)))
        self.assert_rows_of(os.path.join(run, 'icp'), data.of('local'))
        self.count('run_paper', kills)

    def left_of(self, run):
        """Processes of a run, its master and rosout among them: their logs are in its folder."""
        return [line for line in command_lines().values() if run in line]

    def test_bridge(self):
        server = self.localization(sequences='all', time_limit=20.0)
        poses = rospy.Publisher(f'{server.namespace}/robot/pose', PoseStamped, queue_size=10)
        self.addCleanup(poses.unregister)
        self.robot(server, lambda stamp, pose: poses.publish(make_answer(PoseStamped, stamp, pose)))
        bridge, kills = self.bridge(server), 0
        moments = random.Random(3)
        while kills < (40 if LONG else 2) and len(server.rows()) < len(self.data.of('local')) - 1:
            count = len(server.rows()) + moments.randint(0, 1)
            end = time.monotonic() + 20
            wait_until(lambda c=count, e=end: len(server.rows()) >= c or time.monotonic() > e, 'some more problems are done')
            if bridge.ended():
                break
            bridge.kill()
            kills += 1
            bridge = self.bridge(server)
        self.assert_ends_well(bridge)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.data.of('local'))
        self.count('localization_bridge', kills)

    def test_a_master_that_dies_costs_no_result_and_the_run_goes_on_with_another(self):
        port, = free_ports(1)
        environment = {'ROS_MASTER_URI': f'http://127.0.0.1:{port}'}
        data = maths.make_data_set(self.path('rooms'), points=300, perturbations=10)
        run = self.path('run')

        def answers():
            with contextlib.suppress(OSError), socket.create_connection(('127.0.0.1', port), timeout=5):
                return True

        def master():  # roscore would keep it in a process of its own, which survives
            child = self.start(Child(['rosmaster', '--core', '-p', str(port)], **environment))
            wait_until(answers, 'the master answers')
            return child

        def start(package, program, *words):
            return self.start(Child([executable(package, program), *words], '/pcrb', **environment))

        def start_server(ready_limit):
            return start('pcrb_server', 'benchmark_server', f'_root:={data.root}', f'_run:={run}', '_connect_limit:=60',
                         f'_ready_limit:={ready_limit}', '_time_limit:=10', '_summary_hold_time:=60')
        first = master()
        server, client = start_server(10), start('pcrb_tools', 'minimal_client')
        wait_until(lambda: len(rows(run)) >= 5, 'five problems are done')
        first.kill()
        self.assertFalse(answers())
        status = server.wait()
        stored = without_times(run)
        self.assertGreaterEqual(len(stored), 5)
        if status:
            self.assertRegex(server.output(), 'no client called .* the ROS master does not answer.*; results so far are kept')
        self.assertEqual(status, 0 if len(stored) == len(data.of('local')) else 1, server.output())
        client.kill()
        master()
        server, client = start_server(60), start('pcrb_tools', 'minimal_client')
        self.assert_ends_well(client)
        self.assert_ends_well(server)
        self.assert_rows_of(run, data.of('local'))
        after = without_times(run)
        self.assertEqual({key: after[key] for key in stored}, stored)


if __name__ == '__main__':
    rospy.init_node('kills_test')
    rostest.rosrun('pcrb_launch', 'kills', KillsTest)
