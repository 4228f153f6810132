#!/usr/bin/env python3
"""From logs in the original formats to scored problems, and what stops a preparation on its way."""
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

import numpy as np
import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, Launch, Server, TestCase, executable, wait_until


def run(tool, *arguments):
    subprocess.run([executable('pcrb_tools', tool), *arguments], check=True, stdout=subprocess.DEVNULL)


def read_points(path):
    """x y z of an ASCII PCD file of this suite."""
    return np.loadtxt(path, skiprows=11, usecols=(0, 1, 2), ndmin=2)


def read_perturbations(path):
    """4 x 4 by id."""
    with open(path) as file:
        rows = [line.split() for line in file][1:]
    return {row[0]: np.vstack([np.array(row[4:], float).reshape(3, 4), [0, 0, 0, 1]]) for row in rows}


def files_below(root):
    """Paths relative to a folder; the one that records times is left out."""
    paths = (os.path.join(folder, name) for folder, _, names in os.walk(root) for name in names)
    return [os.path.relpath(path, root) for path in paths if os.path.basename(path) != '.conversion']


def tree(root):
    """Bytes of the files below a folder, side files without the times of writing of the inputs."""
    files = {}
    for name in files_below(root):
        with open(os.path.join(root, name), 'rb') as file:
            files[name] = file.read()
        if name.endswith('.yaml'):
            files[name] = re.sub(rb"(?m)^(  '.*': \d+) \d+\.\d+$", rb'\1', files[name])
    return files


class PreparationTest(TestCase):

    @classmethod
    def setUpClass(cls):
        folder = tempfile.mkdtemp(prefix='pcrb_rostest_')
        cls.addClassCleanup(shutil.rmtree, folder)
        cls.logs, cls.root = os.path.join(folder, 'logs'), os.path.join(folder, 'root')
        run('make_sample_logs', '--output', cls.logs)
        run('prepare_dataset', '--logs', cls.logs, '--root', cls.root)

    def scored_rows(self, data_set, problems=6):
        server = self.start(Server(root=self.root, run=self.path('run'), sequences=data_set, kind='local',
                                   subset=problems, time_limit=60.0, summary_hold_time=60.0))
        name = f'{server.namespace}/registration_node'
        rospy.set_param(name, {'method': 'gicp'})
        self.addCleanup(rospy.delete_param, name)
        client = self.start(Child([executable('pcrb_tools', 'registration_node')], server.namespace))
        self.assert_ends_well(client)
        server.interrupt()
        self.assert_ends_well(server)
        self.assertEqual(len(server.rows()), problems)
        return server.rows()

    def assert_score_is_that_of_the_formula(self, data_set, row):
        """Computed from the files of the preparation alone."""
        def path(name):
            return os.path.join(self.root, data_set, name)
        folder = path('p2at_met' if row['sequence'] == 'planetary_map' else row['sequence'])
        source, target = (read_points(os.path.join(folder, row[name])) for name in ('source', 'target'))
        origin = maths.local_origin(target)
        P = maths.shifted(read_perturbations(path(f'{row["sequence"]}_local.txt'))[row['problem_id']], origin)
        reply = maths.from_quaternion([row[c] for c in 'xyz'], [row[f'q{c}'] for c in 'xyzw'])
        self.assertAlmostEqual(row['initial_misalignment'], maths.error(source - origin, P), delta=1e-5)
        self.assertAlmostEqual(row['error'], maths.error(source - origin, reply @ P), delta=1e-5)

    def check_format(self, data_set):
        rows = self.scored_rows(data_set)
        for row in rows:
            self.assertEqual((row['data_set'], row['outcome']), (data_set, 'replied'))
            self.assert_score_is_that_of_the_formula(data_set, row)
        self.assertLess(statistics.median(row['error'] for row in rows),
                        statistics.median(row['initial_misalignment'] for row in rows))

    def test_eth_logs_become_scored_problems(self):
        self.check_format('eth')

    def test_planetary_logs_become_scored_problems(self):
        self.check_format('planetary')

    def test_tum_logs_become_scored_problems(self):
        self.check_format('tum')

    def test_kaist_logs_become_scored_problems(self):
        self.check_format('kaist')

    def test_a_preparation_that_is_killed_again_and_again_ends_like_an_uninterrupted_one(self):
        root = self.path('root')
        command = [executable('pcrb_tools', 'prepare_dataset'), '--logs', self.logs, '--root', root, 'planetary']
        complete = {name: data for name, data in tree(self.root).items() if name.startswith('planetary/')}
        kills = 0
        for files in range(1, len(complete), max(1, len(complete) // 12)):
            preparation = self.start(Child(command))
            wait_until(lambda: preparation.ended() or len(files_below(root)) >= files, f'there are {files} files')
            kills += not preparation.ended()
            preparation.kill()
        self.assertGreater(kills, 5)
        self.assert_ends_well(self.start(Child(command)))
        prepared = tree(root)
        self.assertEqual(sorted(prepared), sorted(complete))
        for name, data in complete.items():
            self.assertEqual(prepared[name], data, name)

    def test_the_launch_file_keeps_what_is_prepared(self):
        before = tree(self.root)
        launch = self.start(Launch('prepare.launch', logs=self.logs, root=self.root, sequences='apartment kaist'))
        self.assert_ends_well(launch)
        self.assertRegex(launch.output(), r'(?m)^\d+ problem files, \d+ clouds: 0 errors')
        self.assertRegex(launch.output(), r'apartment: (\d+) scans read, \1 written \(\1 kept')
        self.assertEqual(tree(self.root), before)

    def test_a_defective_log_ends_it_with_status_1_and_one_line(self):
        logs = self.path('logs', 'planetary', 'box_met')
        os.makedirs(logs)
        for name, text in ('box_met_000.xyz', '1 2 3\n'), ('box_met_000.gt', '1 0 0 0\n0 1 0\n'):
            with open(os.path.join(logs, name), 'w') as file:
                file.write(text)
        preparation = self.start(Child([executable('pcrb_tools', 'prepare_dataset'), '--logs', self.path('logs'),
                                        '--root', self.path('root')]))
        self.assertEqual(preparation.wait(), 1)
        complaints = [line for line in preparation.output().splitlines() if line.startswith('prepare_dataset: ')]
        self.assertEqual(len(complaints), 1, preparation.output())
        self.assertIn('box_met_000.gt:2: ', complaints[0])


if __name__ == '__main__':
    rospy.init_node('preparation_test')
    rostest.rosrun('pcrb_launch', 'preparation', PreparationTest)
