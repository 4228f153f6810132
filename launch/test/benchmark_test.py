#!/usr/bin/env python3
"""The main job from end to end: launch file, server, registration_node, and the minimal clients."""
import csv
import os
import statistics
import sys

import rospy
import rostest
from pcrb_msgs.msg import Summary

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, Launch, TestCase, executable, row_key, rows, wait_until

NAMESPACE = '/pcrb'


class BenchmarkTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'))
        self.summaries = []
        subscriber = rospy.Subscriber(f'{NAMESPACE}/summary', Summary, self.summaries.append)
        self.addCleanup(subscriber.unregister)

    def registration_node(self, **parameters):
        name = f'{NAMESPACE}/registration_node'
        rospy.set_param(name, parameters)
        self.addCleanup(rospy.delete_param, name)
        return self.start(Child([executable('pcrb_tools', 'registration_node')], NAMESPACE))

    def finished_summary(self):
        return wait_until(lambda: self.summaries and self.summaries[-1], 'the summary comes')

    def assert_scores_are_those_of_the_formula(self, run):
        for row in rows(run):
            problem = self.data.by_id(row['problem_id'])
            points, P = self.data.source_points(problem), self.data.local_P(problem)
            reply = maths.from_quaternion([row[c] for c in 'xyz'], [row[f'q{c}'] for c in 'xyzw'])
            self.assertAlmostEqual(row['error'], maths.error(points, reply @ P), delta=1e-5)
            self.assertAlmostEqual(row['initial_misalignment'], maths.error(points, P), delta=1e-5)

    def assert_exports_agree(self, run, summary):
        stored = rows(run)
        with open(os.path.join(run, 'results.csv'), newline='') as file:
            exported = list(csv.DictReader(file))
        self.assertEqual(sorted(map(row_key, exported)), sorted(map(row_key, stored)))
        with open(os.path.join(run, 'summary.txt')) as file:
            text = file.read()
        total = summary.sequences[-1]
        self.assertEqual((total.name, total.count, total.replied), ('total', len(stored), len(stored)))
        self.assertAlmostEqual(total.median, statistics.median(row['error'] for row in stored), places=9)
        for name in 'kitchen', 'hall', 'total':
            self.assertIn(name, text)
            self.assertIn(name, [sequence.name for sequence in summary.sequences])

    def test_the_launch_file_gives_every_problem_one_scored_row(self):
        run = self.path('run')
        launch = self.start(Launch('benchmark.launch', root=self.data.root, run=run, kind='local', method='gicp'))
        summary = self.finished_summary()
        launch.wait()
        self.assertNotIn('exit code', launch.output())  # server and client: exit status 0
        self.assertNotIn('has died', launch.output())
        self.assertTrue(summary.finished)
        self.assert_rows_of(run, self.data.of('local'))
        self.assert_scores_are_those_of_the_formula(run)
        self.assert_exports_agree(run, summary)
        self.assertLess(summary.sequences[-1].q95, 0.05)

    def test_server_and_registration_node_started_by_hand_both_end_with_status_0(self):
        server = self.server(self.data, namespace=NAMESPACE, sequences='hall', kind='both', summary_hold_time=60.0)
        client = self.registration_node(method='icp')
        self.assert_ends_well(client)
        self.finished_summary()
        server.interrupt()
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, [p for p in self.data.problems if p.sequence == 'hall'])

    def test_registration_node_lists_its_mistakes(self):
        node = self.registration_node(method='gucp', colour='red')
        self.assert_fails(node, '2 mistakes', "method: found 'gucp', expected one of do_nothing, fgr, gicp, gicp_pcl, icp",
                          '~colour: no parameter of this node')

    def test_a_method_that_does_not_exist_ends_the_launch_at_once_and_locks_no_run(self):
        arguments = {'root': self.data.root, 'run': self.path('run'), 'sequences': 'kitchen'}
        launch = self.start(Launch('benchmark.launch', **arguments, method='gipc'))
        launch.wait()
        self.assertRegex(launch.output(), r"found 'gipc', expected one of do_nothing, fgr, gicp, gicp_pcl, icp")
        self.assertNotIn('no client called', launch.output())
        launch = self.start(Launch('benchmark.launch', **arguments, method='icp'))
        launch.wait()
        self.assert_rows_of(self.path('run'), self.data.of('local', 'kitchen'))

    def check_minimal_client(self, name):
        server = self.server(self.data, namespace=NAMESPACE, kind='both', summary_hold_time=60.0)
        client = self.start(Child([executable('pcrb_tools', name)]))
        self.assert_ends_well(client)
        server.interrupt()
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.data.problems)
        for row in server.rows():
            self.assertEqual((row['outcome'], row['replies_rejected']), ('replied', 0))
            self.assertAlmostEqual(row['error'], row['initial_misalignment'], delta=1e-9)

    def test_the_minimal_client_in_cpp_completes_a_run(self):
        self.check_minimal_client('minimal_client')

    def test_the_minimal_client_in_python_completes_a_run(self):
        self.check_minimal_client('minimal_client.py')


if __name__ == '__main__':
    rospy.init_node('benchmark_test')
    rostest.rosrun('pcrb_launch', 'benchmark', BenchmarkTest)
