#!/usr/bin/env python3
"""run_paper runs each method on the kind of problems that the paper gives it, reports them, and tells the truth."""
import csv
import json
import os
import sys

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, TestCase, executable, rows


class PaperTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'))
        self.run = self.path('paper')

    def paper(self, *options):
        return self.start(Child([executable('pcrb_tools', 'run_paper'), '--root', self.data.root, '--run', self.run,
                                 '--no-figures', *options]))

    def report(self):
        with open(os.path.join(self.run, 'report', 'report.json')) as file:
            return json.load(file)

    def test_runs_each_method_on_its_kind_and_reports_them_and_keeps_what_is_complete(self):
        paper = self.paper('--methods', 'icp', 'ransac', '--jobs', '2')
        self.assert_ends_well(paper)
        self.assertIn(f'report: {self.run}/report/index.html', paper.output())
        for method, kind in (('icp', 'local'), ('ransac', 'global')):
            self.assert_rows_of(os.path.join(self.run, method), self.data.of(kind))
        methods = {s['kind']: [m['method'] for m in s['methods']] for s in self.report()['sections']}
        self.assertEqual(methods, {'local': ['icp'], 'global': ['ransac']})
        with open(os.path.join(self.run, 'report', 'summary.csv'), newline='') as file:
            summary = list(csv.DictReader(file))
        self.assertEqual(len(summary), 2 * 3)  # two sequences and the total of each method
        self.assertGreater(os.path.getsize(os.path.join(self.run, 'report', 'index.html')), 10000)
        self.check_that_it_is_kept()
        self.assertEqual([m['method'] for s in self.report()['sections'] for m in s['methods']], ['icp', 'ransac'])

    def check_that_it_is_kept(self):
        before = rows(os.path.join(self.run, 'icp'))
        again = self.paper('--methods', 'icp', 'icp', '--jobs', '2')
        self.assert_ends_well(again)
        self.assertEqual(again.output().count('icp, local problems:'), 1)
        self.assertEqual(rows(os.path.join(self.run, 'icp')), before)
        other = self.paper('--methods', 'icp', '--jobs', '2', '--seed', '2')
        self.assert_fails(other, 'seed:=1', 'seed:=2')

    def test_fails_where_a_method_cannot_be_run_and_reports_the_others(self):
        for sequence in 'kitchen', 'hall':
            os.remove(os.path.join(self.data.root, 'rooms', f'{sequence}_global.txt'))
        paper = self.paper('--methods', 'ransac', 'icp', '--jobs', '2')
        self.assert_fails(paper, 'not complete, and not in the report: ransac')
        self.assertEqual([s['kind'] for s in self.report()['sections']], ['local'])


if __name__ == '__main__':
    rospy.init_node('paper_test')
    rostest.rosrun('pcrb_launch', 'paper', PaperTest)
