#!/usr/bin/env python3
"""An existing localization node scores through the bridge as its algorithm does as a client of its own."""
import os
import sys

import numpy as np
import rospy
import rostest
from localization_standins.algorithms import NdtLocalizer, ParticleLocalizer, SmoothingLocalizer

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from pcrb_testing import run_info, select
from pcrb_testing_bridge import SCAN_PERIOD, BridgeTestCase

DEVIATIONS = 0.2, 0.14  # m, rad
COVARIANCE = np.diag(np.repeat(np.square(DEVIATIONS), 3))


class BridgeTest(BridgeTestCase):

    def check(self, name, answers, algorithm, updates, **parameters):
        """Through the bridge and directly, on the very same problems."""
        first, second = self.twin_servers()
        server = first()
        self.standin(server, name, answers)
        patient = {'answer_limit': 5.0, 'map_settle': 1.0, 'initialpose_settle': 1.0}  # on a busy machine, too, each is seen in its turn
        bridge = self.bridge(server, settle='nth', settle_count=updates, **{**patient, **parameters})
        rows = self.rows_of_bridge(server, bridge)
        stamps = [self.stamps_of_answered(server, row) for row in server.rows()]
        self.assertEqual([len(of_problem) for of_problem in stamps], [updates] * len(rows))
        self.assert_same_scores(rows, self.rows_of_algorithm(second(summary_hold_time=0.0), algorithm, stamps, COVARIANCE), 0.05)
        return server, rows

    @staticmethod
    def stamps_of_answered(server, row):
        """Of a problem's scans up to the one that counted, from its first: where others use the machine, too, one may have no
        answer, and the node's next step is of twice the time."""
        scans = select(server.run, 'scan', 'SELECT * FROM scan WHERE answered_s IS NOT NULL AND NOT is_echo ORDER BY scan')
        return [SCAN_PERIOD * (scan['scan'] - 1) for scan in scans
                if scan['problem_id'] == row['problem_id'] and scan['scan'] <= row['scans_used']]

    def test_an_ndt_localizer(self):
        server, rows = self.check('ndt', 'ndt_pose', NdtLocalizer, 3)
        self.assert_improves(rows)
        info = run_info(server.run)
        self.assertGreater(float(info['node_cpu_time_s']), 0.01)
        self.assertGreater(int(info['node_peak_memory_bytes']), 1 << 24)  # Python and numpy

    def test_a_filter_that_echoes_the_initial_pose_and_goes_half_of_the_way(self):
        _, rows = self.check('smoothing', 'odom', SmoothingLocalizer, 12)
        self.assert_improves(rows)
        for row in rows.values():
            self.assertEqual(len(row['covariance'].split()), 36)

    def test_a_particle_filter_that_answers_a_scan_when_the_next_comes(self):
        self.check('particle', 'unused', ParticleLocalizer, 8, pose_topic='tf', tf_odom_base='dynamic',
                   initialpose_covariance='6dof', initialpose_translation=DEVIATIONS[0],
                   initialpose_rotation=DEVIATIONS[1], answer_limit=0.5)


if __name__ == '__main__':
    rospy.init_node('bridge_test')
    rostest.rosrun('pcrb_launch', 'bridge', BridgeTest)
