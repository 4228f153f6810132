#!/usr/bin/env python3
"""localization.launch with a node that dies or hangs: its problems may be lost, the run is not."""
import os
import signal
import sys

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from pcrb_testing import rows, wait_until
from pcrb_testing_bridge import SupervisedTestCase


class DeathsTest(SupervisedTestCase):

    def disturbed(self, number):
        """A run whose node gets a signal after its first result, when others are due; ended well, with at most two problems lost."""
        launch = self.launch(settle='nth', bridge_parameters=self.write('slow.yaml', 'settle_count: 20\n'), time_limit=10.0)
        wait_until(lambda: rows(self.path('run')), 'the first result')
        os.kill(wait_until(self.node_process, 'the node is there'), number)
        self.assert_finished(launch, len(self.data.of('local', 'hall')) - 2)
        return launch

    def test_a_node_that_dies_is_started_anew(self):
        self.assertIn('it is started anew', self.disturbed(signal.SIGKILL).output())

    def test_a_node_that_hangs_is_started_anew(self):
        self.assertIn('the node under test hangs', self.disturbed(signal.SIGSTOP).output())

    def assert_every_problem_fails(self, **arguments):
        """Whatever the node dies of."""
        file = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'crashing_localizer.launch')
        robot = {f'{topic}_topic': f'/{topic}' for topic in ('map', 'scan')}
        launch = self.launch(node_launch=file, **robot, **arguments)
        launch.wait()
        self.assertEqual([(row['outcome'], row['reason']) for row in rows(self.path('run'))],
                         [('failed', 'the node under test left while it had the problem')] * arguments['subset'],
                         launch.output())

    def test_a_node_that_dies_of_every_scan_costs_its_problems_and_not_the_run(self):
        self.assert_every_problem_fails(node_args='at=scan', subset=4)

    def test_a_node_that_dies_of_every_initial_pose_does_so_too_beside_another_that_stays(self):
        self.assert_every_problem_fails(node_args='at=initialpose beside=true', subset=2)

    def test_so_does_a_localizer_behind_a_filter_of_its_scans(self):
        self.assert_every_problem_fails(node_args='at=initialpose filtered=true', subset=2)


if __name__ == '__main__':
    rospy.init_node('deaths_test')
    rostest.rosrun('pcrb_launch', 'deaths', DeathsTest)
