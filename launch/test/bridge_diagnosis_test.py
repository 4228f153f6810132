#!/usr/bin/env python3
"""localization_bridge: each bad manner of a node gets the diagnosis that is its own."""
import os
import sys

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from pcrb_testing import Child, executable, select
from pcrb_testing_bridge import MOTION, AnsweringTestCase

STAMP = r'^stamp: \d+ poses? with the stamp of no scan, \d+\.\d+ s later'
GIVES_UP = {'deadline_fraction': 0.2}  # after 8 s of the server's 40
# An answer 0.2 s ahead has the stamp of no other scan, however late it comes.
BETWEEN = {'scan_period': 0.3, 'answer_limit': 0.3}
DIAGNOSES = {
    'now': STAMP,
    'ahead': r'^stamp: \d+ poses? with the stamp of no scan, 0\.200 s later: set `answer_delay: 0\.200` in bridge_parameters$',
    'frame': r'^frame: \d+ poses?: tf does not connect the pose of `` in `world` with `base_link` and `map`$',
    'nan': r'^invalid: \d+ poses?: \S+/pose: .*(finite|quaternion)',
    'silent': r'^silent: the node said nothing to \d+ scans?, and worked for \d+\.\d s of \d+\.\d s: .*see what it printed$'}
TOPIC = (r'the node said nothing to \d+ scans?: no node publishes \S+/robot/pose; poses are published on .*'
         r'/robot/somewhere \(geometry_msgs/PoseStamped by \S+/ill_mannered_localizer\).*: set pose_topic:=/')


class BridgeDiagnosisTest(AnsweringTestCase):

    def ill_mannered(self, server, manner):
        robot = f'{server.namespace}/robot'
        remaps = {'map_cloud': 'map', 'scan_cloud': 'scan'}
        return self.start(Child([executable('localization_standins', 'ill_mannered_localizer'), f'_manner:={manner}',
                                 *(f'{own}:={robot}/{topic}' for own, topic in remaps.items())], robot))

    def run_with(self, manner, subset=1, time_limit=40.0, **parameters):
        """Rows of a run with the node, and what the bridge printed."""
        server = self.localization(run=manner, sequences='kitchen', subset=subset, time_limit=time_limit)
        node = self.ill_mannered(server, manner)
        bridge = self.bridge(server, **{'answer_limit': 0.2, **GIVES_UP, **parameters})
        rows = list(self.rows_of_bridge(server, bridge).values())
        node.interrupt()  # in order: the master forgets what it published
        node.wait()
        return rows, bridge.output()

    def test_each_bad_manner_has_its_diagnosis_as_the_reason_and_at_the_end(self):
        for manner, diagnosis in DIAGNOSES.items():
            (row,), output = self.run_with(manner, **BETWEEN)
            self.assertEqual(row['outcome'], 'timed_out', manner)
            self.assertRegex(row['reason'], diagnosis)
            code = row['reason'].split(':')[0]
            self.assertRegex(output, rf'problems without an answer, by cause .*\n  1 × {code}: ')

    def test_a_wrong_topic_is_refused_before_a_problem_counts(self):
        server = self.localization(run='elsewhere', sequences='kitchen', subset=2, time_limit=40.0)
        self.ill_mannered(server, 'elsewhere')
        self.assert_fails(self.bridge(server, answer_limit=0.2, **GIVES_UP), TOPIC)
        self.assertEqual(server.rows(), [])
        somewhere = f'{server.namespace}/robot/somewhere'
        rows = self.rows_of_bridge(server, self.bridge(server, settle='first', pose_topic=somewhere))
        # A server that goes on alone, as here and in no launch file, may wait for the first problem in vain.
        outcomes = [row['outcome'] for row in rows.values()]
        self.assertEqual((len(outcomes), set(outcomes) - {'timed_out'}), (2, {'replied'}))

    def test_a_node_that_brings_a_map_and_tf_of_its_own_is_refused_before_a_problem_counts(self):
        server = self.localization(run='owner', sequences='kitchen', subset=1)
        self.ill_mannered(server, 'owner')
        self.assert_fails(self.bridge(server), r'ill_mannered_localizer publishes \S+/robot/map')
        elsewhere = {'map_topic': f'{server.namespace}/another_map', **GIVES_UP}  # what is sent on tf is known later than topics are
        self.assert_fails(self.bridge(server, **elsewhere), r'ill_mannered_localizer publishes the tf frame sensor \(in base_link\); '
                          'or set `tf_base_scan: none` in bridge_parameters')
        self.assertEqual(server.rows(), [])

    def test_a_node_that_dies_of_its_first_scan_has_left(self):
        (row,), output = self.run_with('crash')
        self.assertEqual((row['outcome'], row['reason']), ('failed', 'the node under test left while it had the problem'))
        self.assertIn('the node under test has left', output)

    def test_a_node_that_takes_the_correction_for_motion_shows_which_answer_was_good(self):
        rows, output = self.run_with('velocity', subset=2, settle='nth', settle_count=20, answer_limit=5.0,
                                     deadline_fraction=0.9, initialpose_settle=1.0)
        for row in rows:
            self.assertGreater(row['error'], row['initial_misalignment'])
            first = select(self.path('velocity'), 'scan', f"SELECT * FROM scan WHERE problem_id = '{row['problem_id']}' "
                           'AND error IS NOT NULL ORDER BY scan')
            self.assertLess(first[0]['error'], row['initial_misalignment'])
        self.assertIn('warning: the median error of', output)
        with open(self.path('velocity', 'summary.txt'), encoding='utf-8') as file:
            self.assertRegex(file.read(), r'worse than that: 2 of 2 replies.*\nwarning: the replies are worse than doing nothing')

    def test_the_advice_helps(self):
        (row,), _ = self.run_with('ahead', answer_delay=0.2, settle='first', deadline_fraction=0.9, **BETWEEN)
        self.assertEqual(row['outcome'], 'replied', row)

    def test_the_second_problem_that_fails_alike_is_told_at_once(self):
        rows, output = self.run_with('silent', subset=3, deadline_fraction=0.05)
        self.assertEqual(len(rows), 3)
        self.assertEqual(output.count('two problems without an answer, alike: the node said nothing to'), 1, output)
        self.assertRegex(output, r'\n  3 × silent: ')

    def test_a_run_that_is_worse_than_its_initial_guesses_is_warned_of(self):
        far = MOTION.copy()
        far[:3, 3] = [20.0, 0.0, 0.0]
        server = self.localization(sequences='kitchen', subset=2)
        self.answering(server, motion=far)
        bridge = self.bridge(server, settle='first')
        self.rows_of_bridge(server, bridge)
        self.assertRegex(bridge.output(), r'warning: the median error of .* is worse than that of the initial guesses')


if __name__ == '__main__':
    rospy.init_node('bridge_diagnosis_test')
    rostest.rosrun('pcrb_launch', 'bridge_diagnosis', BridgeDiagnosisTest)
