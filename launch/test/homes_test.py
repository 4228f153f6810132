#!/usr/bin/env python3
"""Strange homes: what is around a program works, or one line says what is wrong with it."""
import os
import sys

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, Launch, TestCase, executable, front_door, rows
from pcrb_testing_client import Client

LATIN_1 = os.fsdecode(b'caf\xe9')
NO_UTF_8 = 'expected UTF-8: roslaunch takes no other bytes in a path'


class HomesTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=300, perturbations=2)

    def tool(self, name, *words, **variables):
        program = front_door() if name == 'pcrb' else executable('pcrb_tools', name)
        return self.start(Child([program, *words], **variables))

    def assert_works(self, name, *words, **variables):
        child = self.tool(name, *words, **variables)
        self.assert_ends_well(child)
        return child

    def assert_run_of(self, command, **variables):
        """A run of two problems, and its report."""
        run = self.path('run')
        self.assert_works('pcrb', *command, '--run', run, '--root', self.data.root, '--method', 'icp', '--subset', '2', **variables)
        self.assertEqual([row['outcome'] for row in rows(run)], ['replied'] * 2)
        self.assert_works('pcrb', 'report', run, '--output', self.path('report'), **variables)
        self.assertTrue(os.path.isfile(self.path('report', 'index.html')))

    def test_without_a_home_folder_a_run_and_its_report_are_made(self):
        self.assert_run_of(['run'], HOME='/proc/nowhere', ROS_HOME='')

    def test_with_another_python_first_in_path_the_systems_is_taken(self):
        """As conda and pyenv have it; theirs lacks ROS."""
        os.mkdir(self.path('bin'))
        for name in ('python', 'python3'):
            with open(self.path('bin', name), 'w', encoding='utf-8') as file:
                file.write('#!/bin/sh\necho "no module named rospy" >&2\nexit 1\n')
            os.chmod(file.name, 0o755)
        self.assert_run_of(['run'], PATH=self.path('bin') + os.pathsep + os.environ['PATH'])

    def test_a_folder_for_temporary_files_that_is_missing_is_named(self):
        tool = self.tool('evaluate_batch', '--run', self.path('run'), f'root:={self.data.root}', TMPDIR='/nowhere/tmp')
        self.assert_fails(tool, 'evaluate_batch: TMPDIR: found `/nowhere/tmp`, expected a folder that exists')

    def test_a_namespace_in_the_environment_does_not_part_a_server_from_its_client(self):
        """The clients of the documents have the server's absolute names."""
        run = self.path('run')
        launch = self.start(Child(['roslaunch', 'pcrb_launch', 'benchmark.launch', f'root:={self.data.root}', f'run:={run}',
                                   'client:=false', 'sequences:=kitchen'], '/robot1'))
        client = Client('/pcrb')
        self.addCleanup(client.close)
        client.serve(launch)
        self.assert_ends_well(launch)
        self.assert_rows_of(run, self.data.of('local', 'kitchen'))

    def test_a_client_in_another_namespace_is_named(self):
        client = Client('/pcrb')
        self.addCleanup(client.close)
        server = self.server(self.data, connect_limit=0.5)
        self.assert_fails(server, rf'no client called `{server.namespace}/ready`.*nobody; '
                                  rf'but {rospy.get_name()} subscribes to /pcrb/problem')

    def test_a_tilde_that_the_shell_left_alone_is_the_home_folder(self):
        self.assert_works('compute_overlap', '~/root/rooms/kitchen', HOME=self.folder)
        self.assert_works('evaluate_batch', '--run=~/run', 'root:=~/root', 'method:=icp', 'subset:=2', HOME=self.folder)
        self.assertEqual(len(rows(self.path('run'))), 2)
        launch = self.start(Launch('benchmark.launch', root=self.data.root, run='~/runs/a'))
        launch.wait()
        self.assertIn('write run:=$HOME/runs/a', launch.output())

    def test_tools_take_a_path_that_is_no_utf_8(self):
        old = self.path(LATIN_1)
        os.rename(self.data.root, old)
        sequence = os.path.join(old, 'rooms', 'kitchen')
        for name, *words in (('compute_overlap', sequence),
                             ('build_map', sequence, '-o', os.path.join(old, 'map.pcd')),
                             ('sequence_to_bag', sequence, '-o', os.path.join(old, 'a.bag')),
                             ('problems_to_bag', f'{sequence}_local.txt', '-o', os.path.join(old, 'b.bag')),
                             ('make_sample_logs', '--output', os.path.join(old, 'logs')),
                             ('prepare_dataset', '--logs', os.path.join(old, 'logs'), '--root', os.path.join(old, 'made'), 'eth')):
            self.assert_works(name, *words)
        self.assert_works('pcrb', 'check', '--root', os.path.join(old, 'made'))
        self.assert_works('pcrb', 'doctor', '--root', old, PYTHONIOENCODING='utf-8:strict')

    def test_a_report_of_a_run_whose_path_is_no_utf_8_is_made(self):
        self.assert_run_of(['run'])
        run = self.path(LATIN_1)
        os.rename(self.path('run'), run)
        self.assert_works('report', run, '--output', os.path.join(run, 'report'))
        self.assertIn('index.html', os.listdir(os.path.join(run, 'report')))

    def test_a_run_refuses_a_path_that_is_no_utf_8_since_roslaunch_cannot_pass_it_on(self):
        run = self.path(LATIN_1)
        for words in (['evaluate_batch', '--run', run, f'root:={self.data.root}'],
                      ['run_paper', '--run', run, '--root', self.data.root],
                      ['pcrb', 'run', '--run', run, '--root', self.data.root]):
            child = self.tool(*words)
            self.assert_fails(child, NO_UTF_8)
            self.assertEqual(child.output().count('found'), 1, child.output())
            self.assertNotIn('Traceback', child.output())
        node = Child([executable('pcrb_server', 'benchmark_server'), f'_run:={run}', f'_root:={self.data.root}'])
        self.assert_fails(self.start(node), 'found `_run:=.*`, expected UTF-8: a ROS master takes no other bytes')


if __name__ == '__main__':
    rospy.init_node('homes_test')
    rostest.rosrun('pcrb_launch', 'homes', HomesTest)
