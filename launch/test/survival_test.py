#!/usr/bin/env python3
"""What is left of a run whose server is killed, interrupted, or runs out of disk: all but the problem in flight."""
import os
import random
import shutil
import signal
import subprocess
import sys
import time

import rospy
import rostest
from pcrb_msgs.srv import SubmitPoseResponse

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import TIME_COLUMNS, Child, TestCase, executable, row_key, rows, run_info, sessions, wait_until

KILLS = 120 if os.environ.get('PCRB_LONG_TESTS') == '1' else 6
NAMESPACE = '/pcrb'


def without_times(run):
    """The result table by problem, but for what says when and how long."""
    return {row_key(row): {name: value for name, value in row.items() if name not in TIME_COLUMNS}
            for row in rows(run)}


class SurvivalTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=300, perturbations=10)
        self.problems = self.data.of('local')

    def minimal_client(self):
        return self.start(Child([executable('pcrb_tools', 'minimal_client')]))

    def prepared_run(self, name):
        """A run folder whose secret is drawn, and none of whose problems is done."""
        server = self.server(self.data, namespace=NAMESPACE, run=self.path(name), autostart=False, summary_hold_time=30.0)
        server.wait_for_output('0/60 problems')
        server.kill()
        return server

    def copy_of(self, server, name):
        shutil.copytree(server.run, self.path(name))
        return self.path(name)

    def wait_for_a_random_moment(self, server, moments, is_over, least=0):
        """Some time after the server's start, or after some more problems, `least` or more; or until it is over."""
        delay = moments.uniform(0, 0.4)
        if least > 0 or moments.random() < 0.7:
            count = len(server.rows()) + moments.randint(least, 4)
            wait_until(lambda: is_over() or len(server.rows()) >= count, 'some more problems are done')
            delay /= 20
        end = time.monotonic() + delay
        wait_until(lambda: is_over() or time.monotonic() > end, 'the moment comes')

    def play_with_kills(self, fresh, run, moments, kills):
        """Plays a run to its end, killing the server up to `kills` times; numbers of rows at the kills."""
        client = self.minimal_client()
        killed_at = []
        server = self.start(fresh.again(autostart=True, run=run, summary_hold_time=60.0))
        while len(killed_at) < kills and not client.ended():
            # The first one of a run comes when some problems are done and most are not.
            self.wait_for_a_random_moment(server, moments, client.ended, least=0 if killed_at else 1)
            server.kill()
            killed_at.append(len(rows(run)))
            server = self.start(server.again())
        self.assert_ends_well(client)
        server.wait_for_output('60/60 problems')
        server.interrupt()
        self.assert_ends_well(server)
        self.assertLessEqual(len(sessions(run)), len(killed_at) + 2)  # the first one made the fresh run
        return killed_at

    def test_a_run_with_kills_equals_one_without(self):
        fresh = self.prepared_run('fresh')
        moments = random.Random(7)
        whole = self.copy_of(fresh, 'whole')
        self.play_with_kills(fresh, whole, moments, 0)
        expected = without_times(whole)
        self.assertEqual(len(expected), len(self.problems))
        killed_at, runs = [], 0
        while len(killed_at) < KILLS:
            runs += 1
            run = self.copy_of(fresh, f'killed{runs}')
            killed_at += self.play_with_kills(fresh, run, moments, KILLS - len(killed_at))
            self.assertEqual(without_times(run), expected)
            self.assertEqual(run_info(run), run_info(whole))
        midway = sum(0 < count < len(expected) for count in killed_at)
        self.assertGreaterEqual(midway, 1)
        print(f'{KILLS} kills in {runs} runs, {midway} of them with some but not all problems done', flush=True)

    def test_registration_node_goes_on_with_a_server_that_was_killed(self):
        rospy.set_param(f'{NAMESPACE}/registration_node', {'method': 'icp'})
        client = self.start(Child([executable('pcrb_tools', 'registration_node')], NAMESPACE))
        server = self.server(self.data, namespace=NAMESPACE, summary_hold_time=60.0)
        for count in 3, 10, 20:
            wait_until(lambda: len(server.rows()) >= count, f'{count} problems are done')
            server.kill()
            server = self.start(server.again())
        self.assert_ends_well(client)
        server.wait_for_output(f'{len(self.problems)}/{len(self.problems)} problems')
        server.interrupt()
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.problems)
        self.assertEqual({row['outcome'] for row in server.rows()}, {'replied'})

    def check_interrupted(self, server, patterns, number=signal.SIGINT):
        server.process.send_signal(number)
        self.assertEqual(server.wait(), 1, server.output())
        for pattern in patterns:
            self.assertRegex(server.output(), pattern)
        self.assertIsNotNone(sessions(server.run)[-1]['ended'])  # the session was closed

    def test_an_interrupt_ends_in_order_wherever_it_comes_and_the_run_goes_on(self):
        server = self.server(self.data, autostart=False)
        server.wait_for_output('0/60 problems')
        self.check_interrupted(server, ['0 of 60 problems have a result'])
        server = self.start(server.again(autostart=True))
        client = self.client(server)
        client.next_problem()  # announced, and no client comes
        self.check_interrupted(server, ['0 of 60'], signal.SIGTERM)
        server = self.start(server.again())
        client.serve(server, limit=3)
        client.take_source(client.next_problem())  # handed out, and no reply comes
        self.check_interrupted(server, ['3 of 60 .* again with the same ~run', 'total'])
        server = self.start(server.again())
        client.serve(server)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.problems)

    def test_a_second_server_is_kept_out_of_a_run_folder_and_the_first_goes_on(self):
        first = self.server(self.data)
        client = self.client(first)
        client.serve(first, limit=2)
        self.assert_fails(self.server(self.data), 'found another writer', f'process {first.process.pid}')
        client.serve(first)
        self.assert_ends_well(first)
        self.assert_rows_of(first.run, self.problems)

    def test_a_second_server_of_the_same_name_is_refused_and_the_first_goes_on(self):
        first = self.server(self.data, sequences='kitchen')
        client = self.client(first)
        client.serve(first, limit=2)
        self.assert_fails(self.start(first.again()), f'already runs as {first.namespace}/benchmark_server',
                          f'pid {first.process.pid}')
        client.serve(first)
        self.assert_ends_well(first)
        self.assert_rows_of(first.run, self.data.of('local', 'kitchen'))

    def test_a_reply_to_a_server_that_was_killed_is_to_an_unknown_problem_of_the_next(self):
        server = self.server(self.data, sequences='kitchen')
        client = self.client(server)
        slow = client.next_problem()
        client.take_source(slow)
        server.kill()
        server = self.start(server.again())
        again = client.next_problem()  # the same one
        self.assertEqual(client.submit(slow).code, SubmitPoseResponse.UNKNOWN_PROBLEM)
        client.take_source(again)
        client.submit(again)
        client.serve(server)
        self.assert_ends_well(server)
        self.assertEqual({(row['outcome'], row['replies_rejected']) for row in server.rows()}, {('replied', 0)})

    def mount_small_disk(self):
        """A folder that holds 1 MB."""
        folder = self.path('disk')
        os.mkdir(folder)
        mounted = os.geteuid() == 0 and subprocess.run(
            ['mount', '-t', 'tmpfs', '-o', 'size=1m', 'tmpfs', folder], stderr=subprocess.DEVNULL).returncode == 0
        if not mounted:
            self.skipTest('cannot mount a small disk here (that takes root and CAP_SYS_ADMIN)')
        self.addCleanup(subprocess.run, ['umount', folder], check=True)
        return folder

    def test_a_full_disk_is_a_clear_error_and_nothing_that_was_committed_is_lost(self):
        disk = self.mount_small_disk()
        server = self.server(self.data, run=os.path.join(disk, 'run'))
        client = self.client(server)
        client.serve(server, limit=5)
        before = server.rows()
        with self.assertRaises(OSError), open(os.path.join(disk, 'filler'), 'wb', buffering=0) as filler:
            while True:
                filler.write(b'x' * 4096)
        client.serve(server)
        self.assert_fails(server, r'(?i)disk.*full|full.*disk|no space', 'results.sqlite')
        os.remove(os.path.join(disk, 'filler'))
        self.assertEqual(server.rows()[:5], before)
        server = self.start(server.again())
        client.serve(server)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.problems)
        self.assertEqual(server.rows()[:5], before)


if __name__ == '__main__':
    rospy.init_node('survival_test')
    rostest.rosrun('pcrb_launch', 'survival', SurvivalTest)
