#!/usr/bin/env python3
"""benchmark.launch with G-ICP over scans of a car's lidar, of a handheld one, and of an RGB-D camera."""
import os
import statistics
import sys

import roslib.packages
import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from pcrb_testing import Launch, TestCase, rows


def shared_data():
    """Where the other tests find it, too; perhaps no folder."""
    beside = os.path.join(os.path.realpath(roslib.packages.get_pkg_dir('pcrb_launch')), '..', '..', 'shared', 'data')
    return os.environ.get('PCRB_SHARED_DATA', os.path.normpath(beside))


def ids(*path):
    """Of a problem file."""
    with open(os.path.join(*path)) as file:
        return [line.split()[0] for line in file][1:]


class RealScansTest(TestCase):

    def setUp(self):
        super().setUp()
        self.root = os.path.join(shared_data(), 'benchmark')
        if not os.path.isdir(self.root):
            print(f'skipped: no shared data, {self.root} does not exist', flush=True)
            self.skipTest(f'no shared data: {self.root} does not exist')

    def play(self, **arguments):
        """The rows of a run by sequence."""
        run = self.path('run')
        launch = self.start(Launch('benchmark.launch', root=self.root, run=run, method='gicp', time_limit=60, **arguments))
        launch.wait(limit=1200.0)
        self.assertTrue(os.path.exists(os.path.join(run, 'summary.txt')), launch.output())
        by_sequence = {}
        for row in rows(run):
            by_sequence.setdefault(row['sequence'], []).append(row)
        return by_sequence

    def assert_solved(self, table):
        self.assertEqual({row['outcome'] for row in table}, {'replied'})
        self.assertLess(statistics.median(row['error'] for row in table), 0.05)
        self.assertGreater(statistics.median(row['initial_misalignment'] for row in table), 0.05)

    def test_every_problem_of_the_street_has_one_row_and_the_median_is_below_0_05(self):
        street, = self.play(sequences='street').values()
        expected = ids(self.root, 'automotive', 'street_local.txt')
        self.assertEqual(sorted(row['problem_id'] for row in street), sorted(expected))
        self.assert_solved(street)

    def test_a_draw_of_the_other_sequences_is_solved_too(self):
        tables = self.play(sequences='car livingroom', subset=16)
        self.assertEqual(sum(map(len, tables.values())), 16)
        for name, data_set in ('car', 'handheld'), ('livingroom', 'rgbd'):
            drawn = [row['problem_id'] for row in tables[name]]
            self.assertEqual(len(set(drawn)), len(drawn))
            self.assertLessEqual(set(drawn), set(ids(self.root, data_set, f'{name}_local.txt')))
            self.assert_solved(tables[name])


if __name__ == '__main__':
    rospy.init_node('real_scans_test')
    rostest.rosrun('pcrb_launch', 'real_scans', RealScansTest)
