#!/usr/bin/env python3
"""evaluate.sbatch on a real Slurm: one node, several tasks; preempted, killed, failed."""
import csv
import os
import re
import signal
import sys

import roslib.packages
import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, TestCase, gated_client, open_gate, rows, run_info, sessions, wait_until
from pcrb_testing_processes import command_lines
from pcrb_testing_slurm import Cluster, missing_programs
from pcrb_testing_wait import LIMIT


class SlurmTest(TestCase):

    def setUp(self):
        super().setUp()
        if missing_programs():
            self.skipTest(f'Slurm is not installed (Debian: slurm-wlm, munge): no {", ".join(missing_programs())}')
        self.cluster = Cluster(self, Child)
        self.run = self.path('run')

    def submit(self, data, *options, **arguments):
        """Job ids of the array and of the merge."""
        script = os.path.join(roslib.packages.get_pkg_dir('pcrb_launch'), 'slurm', 'evaluate.sbatch')
        submission = self.start(Child([script, '--run', self.run, *options, f'root:={data.root}', *(
            f'{name}:={value}' for name, value in arguments.items())], **self.cluster.environment))
        self.assert_ends_well(submission)
        return re.search(r'job (\d+): .*job (\d+) merges', submission.output()).groups()

    def shard(self, number):
        return os.path.join(self.run, 'shards', str(number))

    def log(self, name):
        with open(os.path.join(self.run, 'slurm', name)) as file:
            return file.read()

    def wait_for_jobs(self):
        def all_done():
            self.cluster.skip_requeue_delay()
            return not self.cluster.queue()
        try:
            wait_until(all_done, 'all jobs are done', 2 * LIMIT, period=0.3)  # three shards, a merge, a report
        except AssertionError as error:
            logs = [f'{name}:\n{self.log(name)}' for name in os.listdir(os.path.join(self.run, 'slurm'))]
            raise AssertionError('\n'.join([str(error), str(self.cluster.queue()), *logs])) from None

    def batch_process(self, number):
        """Id of the evaluate_batch of a shard."""
        for pid, line in command_lines().items():
            words = line.split('\0')
            is_batch = words[0].endswith('/evaluate_batch') and self.run in words
            if is_batch and words[words.index('--only') + 1] == str(number):
                return pid
        return None

    def test_preempted_and_killed_tasks_go_on_and_the_last_job_merges_and_reports(self):
        data, gate = maths.make_data_set(self.path('root'), points=300, perturbations=10), self.path('gate')
        array, _ = self.submit(data, '--shards', '3', client_command=gated_client(gate), ready_limit=1000)
        wait_until(lambda: rows(self.shard(0)), 'shard 0 has a result')
        self.cluster.call('scontrol', 'requeue', f'{array}_0')
        wait_until(lambda: rows(self.shard(1)), 'shard 1 has a result')
        os.kill(self.batch_process(1), signal.SIGKILL)
        open_gate(gate)
        self.wait_for_jobs()

        self.assert_rows_of(self.run, data.of('local'))
        for number in 0, 1:
            self.assertEqual(len(sessions(self.shard(number))), 2)
            self.assertIn('start 2', self.log(f'shard_{number}.log'))
        self.assertIn('task 1: failed; requeued', self.log('shard_1.log'))
        self.assertRegex(self.log('merge.log'), 'total +local +60')
        self.assertTrue(os.path.exists(os.path.join(self.run, 'report', 'index.html')))

    def test_a_sweep_is_a_run_for_each_value_and_one_report(self):
        data = maths.make_data_set(self.path('root'), points=300)
        self.submit(data, '--shards', '2', '--sweep', 'voxel_leaf=0.1,0.2', method='icp', sequences='hall')
        self.wait_for_jobs()
        for value in '0.1', '0.2':
            run = os.path.join(self.run, f'voxel_leaf={value}')
            self.assert_rows_of(run, data.of('local', 'hall'))
            self.assertIn(f'\nvoxel_leaf: {value}\n', run_info(run)['client_parameters'])
        with open(os.path.join(self.run, 'report', 'tables', 'local_sweeps.csv')) as file:
            self.assertEqual([row['value'] for row in csv.DictReader(file)], ['0.1', '0.2'])

    def test_a_task_that_keeps_failing_is_given_up_and_the_last_job_names_it(self):
        data = maths.make_data_set(self.path('root'), points=300)
        _, merge = self.submit(data, '--shards', '1', '--attempts', '2', sequences='attic')
        self.wait_for_jobs()
        self.assertIn('task 0: failed 2 times, given up', self.log('shard_0.log'))
        self.assertIn('found `attic`', self.log('shard_0.log'))
        self.assertRegex(self.log('merge.log'), 'shards/0')
        self.assertIn('JobState=FAILED', self.cluster.call('scontrol', 'show', 'job', merge))


if __name__ == '__main__':
    rospy.init_node('slurm_test')
    rostest.rosrun('pcrb_launch', 'slurm', SlurmTest)
