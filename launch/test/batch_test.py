#!/usr/bin/env python3
"""A run in shards is the run without: merged, interrupted, killed, beside other masters, without a network."""
import os
import shutil
import signal
import subprocess
import sys

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import (TIME_COLUMNS, Child, Launch, TestCase, executable, gated_client, open_gate, row_key, rows, run_info,
                          wait_until)
from pcrb_testing_processes import processes_that_name

# target_changed depends on the secret order; the others on the moment.
OF_ONE_RUN = {'target_changed', *TIME_COLUMNS}
OF_ONE_STORE = {'secret', 'created', 'merged_from'}
ISOLATED = ['unshare', '--net', '--map-root-user', 'sh', '-c', 'ip link set lo up && exec "$@"', '-']


def without(names, dictionary):
    return {name: value for name, value in dictionary.items() if name not in names}


class BatchTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=400, perturbations=10)
        self.run = self.path('run')

    def batch(self, *options, prefix=(), **arguments):
        arguments = {'root': self.data.root, 'method': 'icp', **arguments}
        return self.start(Child([*prefix, executable('pcrb_tools', 'evaluate_batch'), '--run', self.run, *options,
                                 *(f'{name}:={value}' for name, value in arguments.items() if value is not None)]))

    def shard(self, number):
        return os.path.join(self.run, 'shards', str(number))

    def log_of_shard(self, number):
        path = os.path.join(self.shard(number), 'roslaunch.log')
        if not os.path.exists(path):
            return ''
        with open(path, encoding='utf-8', errors='replace') as file:
            return file.read()

    def wait_for_rows_of_shard(self, number, count):
        wait_until(lambda: len(rows(self.shard(number))) >= count, f'shard {number} has {count} results')

    def assert_equal_runs(self, merged, whole):
        def by_problem(run):
            return {row_key(row): without(OF_ONE_RUN, row) for row in rows(run)}
        self.assertEqual(by_problem(merged), by_problem(whole))
        self.assertEqual(without(OF_ONE_STORE, run_info(merged)), without(OF_ONE_STORE, run_info(whole)))
        for name in 'summary.txt', 'results.csv':
            self.assertGreater(os.path.getsize(os.path.join(merged, name)), 100)

    def test_merged_shards_equal_the_run_without_shards(self):
        """Beside a master with parameters that would be mistakes."""
        for node in 'benchmark_server', 'registration_node':
            rospy.set_param(f'/pcrb/{node}/colour', 'red')
        batch = self.batch('--jobs', '2', '--shards', '3', kind='both')
        whole = self.path('whole')
        launch = self.start(Launch('benchmark.launch', root=self.data.root, run=whole, method='icp', kind='both'))
        self.assert_ends_well(batch)
        launch.wait()
        self.assert_rows_of(self.run, self.data.problems)
        self.assert_equal_runs(self.run, whole)
        self.assertRegex(batch.output(), r'66/66 problems \(100 %\)')
        self.assertRegex(batch.output(), r'total +all +66')
        self.assertEqual(processes_that_name(self.run), [])
        self.assertIn('method: icp\n', run_info(self.run)['client_parameters'])

        merge = [executable('pcrb_tools', 'merge_runs'), *map(self.shard, (2, 0, 1)), '-o', self.path('merged')]
        self.assert_ends_well(self.start(Child(merge)))
        self.assert_equal_runs(self.path('merged'), whole)
        shutil.rmtree(self.path('merged'))
        self.assert_fails(self.start(Child([*merge[:3], *merge[4:]])), 'missing are 1/3')

        again = self.batch(kind='both')  # everything is there
        self.assert_ends_well(again)
        self.assertRegex(again.output(), '66 kept')
        self.assert_fails(self.batch(kind='both', method='gicp'), 'another batch: found `method:=icp`, asked for `meth')
        self.assert_fails(self.batch('--shards', '2', kind='both'), 'found `shards 3`, asked for `shards 2`')

    def test_an_interrupt_and_a_kill_end_all_and_the_next_one_goes_on(self):
        gate = self.path('gate')
        gated = {'method': None, 'client_command': gated_client(gate), 'ready_limit': 1000}
        batch = self.batch('--jobs', '2', **gated)
        self.wait_for_rows_of_shard(1, 1)
        batch.interrupt()
        self.assert_fails(batch, 'interrupted; what is complete is kept')
        self.assertEqual(processes_that_name(self.run), [])
        before = rows(self.shard(1))

        batch = self.batch('--jobs', '2', **gated)
        self.wait_for_rows_of_shard(1, len(before) + 1)
        batch.kill()
        killed = rows(self.shard(1))
        self.assertLess(len(killed), 30)
        open_gate(gate)
        batch = self.batch(**gated)
        self.assert_ends_well(batch)
        self.assert_rows_of(self.run, self.data.of('local'))
        self.assertEqual(rows(self.shard(1))[:len(killed)], killed)
        wait_until(lambda: not processes_that_name(self.run), 'all processes have ended')

    def test_nodes_whose_roslaunch_or_its_guard_was_killed_are_ended_and_the_shard_is_incomplete(self):
        gated = {'method': None, 'client_command': gated_client(self.path('gate')), 'ready_limit': 1000}
        for victim in '/roslaunch', '/guard_launch':
            done = len(rows(self.shard(0))) if os.path.exists(self.shard(0)) else 0
            batch = self.batch('--jobs', '1', **gated)
            self.wait_for_rows_of_shard(0, done + 1)
            of_shard = set(processes_that_name(f'run:={self.shard(0)}\0'))
            process, = of_shard.intersection(processes_that_name(f'{victim}\0'))
            os.kill(process, signal.SIGKILL)
            self.assert_fails(batch, r'shard 0/1: \d+ of 60 problems have a result', 'start this again')
            self.assertEqual(processes_that_name(self.run), [])

    def test_shards_have_map_files_of_their_own_or_are_refused(self):
        """A node that reads another shard's map would localize well, in the wrong place."""
        data = maths.make_data_set(self.path('rooms'), points=1000)
        file, gate = self.path('bridge.yaml'), self.path('gate')
        self.write('gated', f"""#!/bin/sh
while [ ! -e '{gate}' ]; do sleep 0.1; done
exec "$@"
""")
        os.chmod(self.path('gated'), 0o755)
        self.write('gated.launch', f"""<launch>
  <arg name="map_topic"/> <arg name="scan_topic"/>
  <node name="ndt_localizer" pkg="localization_standins" type="ndt_localizer" launch-prefix="{self.path('gated')}">
    <remap from="map_cloud" to="$(arg map_topic)"/> <remap from="scan_cloud" to="$(arg scan_topic)"/>
  </node>
</launch>
""")
        arguments = {
            'root': data.root, 'sequences': 'hall', 'subset': 2, 'settle': 'first', 'bridge_parameters': file,
            'node_launch': self.path('gated.launch'), 'pose_topic': '/ndt_pose',
            'node_args': 'map_topic=/map ${PCRB_NONE:-scan_topic=/scan}', 'method': None}

        def batch(map_file):
            self.write('bridge.yaml', f'map_file: {map_file}\n')
            return self.batch('--jobs', '2', '--launch', 'localization.launch', **arguments)

        fixed = self.path('map.pcd')
        contending = batch(fixed)
        wait_until(lambda: any('in use by' in self.log_of_shard(number) for number in range(2)), 'one has met the other')
        open_gate(gate)
        self.assert_fails(contending, fr'shard ./2: .*localization_bridge: ~map_file: found `{fixed}` in use by',
                          'the run is not complete')
        shutil.rmtree(self.run)
        self.assert_ends_well(batch('${TMPDIR}/map.pcd'))
        self.assertEqual([row['outcome'] for row in rows(self.run)], ['replied'] * 2)
        self.assertIn('${TMPDIR}/map.pcd', run_info(self.run)['client_parameters'])

    def test_a_node_that_never_answers_is_a_failure(self):
        """A thousandth of a second is too short for this method."""
        batch = self.batch('--jobs', '1', method='ransac', time_limit=0.001, subset=2, sequences='hall')
        self.assert_fails(batch, 'shard 0/1: the node under test never answered')
        self.assertEqual([row['outcome'] for row in rows(self.run)], ['timed_out'] * 2)

    def test_a_shard_without_results_is_a_failure_that_says_why(self):
        batch = self.batch('--jobs', '1', sequences='attic')
        self.assert_fails(batch, r'shard 0/1: 0 problems have a result; benchmark_server: .*`attic`', 'not complete')
        self.assertFalse(os.path.exists(os.path.join(self.run, 'summary.txt')))

    def test_a_method_that_cannot_be_loaded_is_a_failure_that_says_why(self):
        batch = self.batch('--jobs', '1', method='mine', plugin='/nowhere/libmine.so', subset=1)
        self.assert_fails(batch, 'registration_node: 1 mistake in the parameters; plugin: cannot load /nowhere/libmine.so')

    def test_needs_no_network_but_loopback(self):
        if subprocess.run([*ISOLATED, 'true'], stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest('cannot take the network away here')
        self.assert_ends_well(self.batch('--jobs', '1', prefix=ISOLATED, subset=6))
        self.assertEqual(len(rows(self.run)), 6)

    def test_needs_no_home_folder(self):
        nowhere = ['env', '-u', 'ROS_HOME', 'HOME=/proc/nowhere']
        self.assert_ends_well(self.batch('--jobs', '1', prefix=nowhere, subset=2))
        self.assertEqual(len(rows(self.run)), 2)

    def test_wrong_arguments_are_refused(self):
        self.assert_fails(self.batch(run='elsewhere'), 'found `run:=elsewhere`')
        self.assert_fails(self.batch(root='nowhere'), 'root: found `nowhere`, expected an existing folder')
        self.assert_fails(self.batch(methd='gicp'), 'found `methd:=gicp`, expected arguments of .*launch: root')
        self.assert_fails(self.batch('--launch', 'no.launch'), 'no.launch: found no text, expected a launch file')
        self.assertFalse(os.path.exists(self.run))
        self.assert_fails(self.batch('--shards', '2', '--only', '2'), 'found 2, expected a shard below 2')


if __name__ == '__main__':
    rospy.init_node('batch_test')
    rostest.rosrun('pcrb_launch', 'batch', BatchTest)
