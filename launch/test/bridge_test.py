#!/usr/bin/env python3
"""An existing localization node scores through the bridge as its algorithm does as a client of its own."""
import os
import sys

import numpy as np
import rospy
import rostest
from localization_standins.algorithms import NdtLocalizer

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from pcrb_testing_bridge import BridgeTestCase

COVARIANCE = np.diag([0.04] * 3 + [0.02] * 3)


class BridgeTest(BridgeTestCase):

    def test_an_ndt_localizer_scores_as_its_algorithm_does(self):
        first, second = self.twin_servers()
        server = first()
        self.standin(server, 'ndt', 'ndt_pose')
        rows = self.rows_of_bridge(server, self.bridge(server, settle='nth', settle_count=3))
        others = self.rows_of_algorithm(second(), NdtLocalizer, 3, COVARIANCE)
        self.assert_same_scores(rows, others, 0.05)
        self.assert_improves(rows)
        self.assertEqual({row['scans_used'] for row in rows.values()}, {3})


if __name__ == '__main__':
    rospy.init_node('bridge_test')
    rostest.rosrun('pcrb_launch', 'bridge', BridgeTest)
