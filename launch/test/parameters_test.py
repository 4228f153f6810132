#!/usr/bin/env python3
"""What benchmark_server refuses: parameters, run folders, data. Each time with a message that tells all."""
import contextlib
import os
import re
import sqlite3
import sys

import numpy as np
import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, Launch, TestCase, executable, forget_results, rows, run_info, wait_until


class ParametersTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=200)

    def finished(self, server):
        self.client(server).serve(server)
        self.assert_ends_well(server)
        return server

    def registration_node(self, server, **parameters):
        rospy.set_param(f'{server.namespace}/registration_node', {'method': 'icp', **parameters})
        return self.start(Child([executable('pcrb_tools', 'registration_node')], server.namespace))

    def test_all_mistakes_are_listed_at_once(self):
        server = self.server(
            self.data, root='/nowhere', run='', sequences=' ', kind='locl', presentation='both', subset=-1, seed=1.5,
            shard='3/3', time_limit=0.0, connect_limit='long', handshake='maybe', global_guess='yes', summary_hold_time=-1,
            map_frame='pcrb_scan', load_threads=0, colour='red', nested={'name': 1})
        self.assert_fails(
            server, r'17 mistakes', r'~root: found `/nowhere`, expected an existing folder', r'~run: must be given',
            r'~sequences: names no sequence', r'~kind: .*`locl`.* `local` or `global` or `both`',
            r'~presentation: .*`both`', r'~subset: found `-1`', r'~seed: found `1\.5`', r'~shard: found `3/3`',
            r'~time_limit: found `0', r'~connect_limit: found `long`, expected a number', r'~handshake: found `maybe`',
            r'~global_guess: found `yes`, expected true or false', r'~summary_hold_time: found `-1`',
            r'~map_frame and ~scan_frame', r'~load_threads: found `0`', r'~colour: no parameter',
            r'~nested: no parameter')

    def test_relative_paths_are_refused_since_roslaunch_starts_nodes_elsewhere(self):
        good = {'root': self.data.root, 'run': self.path('run')}
        for file, refused, others in (
                ('benchmark.launch', {'root': '~root', 'run': '~run'}, {}),
                ('benchmark.launch', {'parameters': '~parameters', 'plugin': '~plugin'}, good),
                ('localization.launch', {'node_launch': '~launch'}, good),
                ('replay.launch', {'root': '~root', 'run': '~run'}, {'rviz': 'false'}),
                ('paper.launch', {'root': '--root'}, {'run': self.path('run')})):
            launch = self.start(Launch(file, **others, **{argument: 'my/bench' for argument in refused}))
            launch.wait()
            for argument, name in refused.items():
                self.assertIn(f'{name}: found `my/bench`, expected an absolute path: roslaunch starts programs in '
                              f'another folder; write {argument}:=$PWD/my/bench', launch.output())

    def test_arguments_that_a_launch_file_does_not_have_are_refused(self):
        """roslaunch takes them without a word, and would start all problems in place of five."""
        good = {'root': self.path('root'), 'run': self.path('run')}
        for file, others in (('benchmark.launch', good), ('localization.launch', {**good, 'node_launch': '/x.launch'}),
                             ('replay.launch', {**good, 'rviz': 'false'}), ('paper.launch', good),
                             ('prepare.launch', {'root': self.path('root'), 'logs': '/l'})):
            launch = self.start(Launch(file, **others, subst='5'))
            launch.wait()
            self.assertRegex(launch.output(), rf'found `subst:=5`, expected arguments of \S*/{file}: .*\broot\b')
            self.assertEqual(launch.output().count('expected arguments of'), 1, 'said once, not by each node')
        self.assertFalse(os.path.exists(self.path('run')))

    def test_arguments_that_look_like_numbers_are_text_in_every_launch_file(self):
        """0 would be false: replay would show the ground truth."""
        for file, arguments, pattern in (
                ('replay.launch', {'root': '/r', 'sequence': '00', 'truth': 'false', 'rviz': 'false'},
                 r'/pcrb/replay/publish_ground_truth: false'),
                ('localization.launch', {'root': '/r', 'run': '/run', 'node_launch': '/x.launch', 'node_args': '5'},
                 r'/pcrb/benchmark_server/under_test: /x.launch 5'),
                ('paper.launch', {'root': '/r', 'run': '/run', 'methods': '0'}, r'\{\}')):
            dump = self.start(Child(['roslaunch', '--dump-params', 'pcrb_launch', file,
                                     *(f'{name}:={value}' for name, value in arguments.items())]))
            self.assert_ends_well(dump)
            self.assertRegex(dump.output(), pattern)

    def test_it_says_at_the_start_and_at_the_end_where_the_results_are(self):
        server = self.finished(self.server(self.data, sequences='kitchen hall', subset=3, shard='0/2'))
        self.assertRegex(server.output(), rf'results: {server.run}\nproblems: {self.data.root}, sequences hall kitchen, '
                                          r'kind local, subset 3, shard 0/2\n')
        self.assertRegex(server.output(), rf'total .*\nresults: {server.run}\n')

    def test_folders_and_sequences_may_have_numbers_for_their_names(self):
        """roslaunch and rosrun turn such text into a number."""
        os.rename(self.data.folder('kitchen'), self.data.folder('1984'))
        os.rename(self.data.folder('kitchen_local.txt'), self.data.folder('1984_local.txt'))
        server = self.server(self.data, run=self.path('2026'), sequences=1984)
        self.client(server).serve(server)
        self.assert_ends_well(server)
        self.assertEqual({row['sequence'] for row in rows(self.path('2026'))}, {'1984'})

    def test_unknown_sequences_are_refused_and_the_known_ones_named(self):
        self.assert_fails(self.server(self.data, sequences='kitchen attic'),
                          r'sequences: found `attic`', r'rooms/hall rooms/kitchen')

    def test_a_root_without_problems_is_refused(self):
        os.makedirs(self.path('empty'))
        self.assert_fails(self.server(self.data, root=self.path('empty')), r'sequences: found `all`', 'there is none')
        self.assert_fails(self.server(self.data, root=self.data.folder()), r'sequences: found `all`', 'there is none')

    def test_a_shard_without_problems_is_refused(self):
        self.assert_fails(self.server(self.data, shard='99/100'), 'no problem is left')

    def test_a_run_of_another_configuration_is_refused_with_the_differences_named(self):
        server = self.finished(self.server(self.data, subset=2))
        other = self.start(server.again(subset=3, time_limit=5.0, debug=True, sequences='kitchen', under_test='icp'))
        self.assert_fails(
            other, 'holds a run of another configuration', r'subset: the run has `2`, asked for `3`',
            r'time_limit: the run has `30`, asked for `5`', r'debug: the run has `false`, asked for `true`',
            r'sequences: the run has `all`, asked for `kitchen`', r'hall_local.txt: not selected',
            r'under_test: the run has ``, asked for `icp`')
        self.assert_ends_well(self.start(server.again()))

    def test_a_run_without_a_result_takes_another_configuration(self):
        server = self.server(self.data, under_test='gipc', sequences='kitchen', connect_limit=0.1)
        self.assert_fails(server, 'no client called')
        before = run_info(server.run)
        server = self.start(server.again(under_test='icp', sequences='hall', connect_limit=60.0))
        self.client(server).serve(server)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.data.of('local', 'hall'))
        after = run_info(server.run)
        self.assertEqual((after['under_test'], after['secret']), ('icp', before['secret']))
        self.assertNotIn('problem_file rooms/kitchen_local.txt', after)

    def test_a_run_goes_on_only_with_the_same_parameters_of_the_client(self):
        self.addCleanup(rospy.delete_param, rospy.get_name())
        rospy.set_param(rospy.get_name(), {'method': 'icp'})
        server = self.server(self.data, sequences='kitchen')
        client = self.client(server)
        client.serve(server, limit=5)
        server.kill()
        rospy.set_param(rospy.get_name(), {'method': 'gicp'})
        server = self.start(server.again())
        client.serve(server)
        self.assert_fails(server, r'client_parameters: the run has `method: icp`, asked for `method: gicp`')
        rospy.set_param(rospy.get_name(), {'method': 'icp'})
        server = self.start(server.again())
        client.serve(server)
        self.assert_ends_well(server)

    def play(self, server, max_iterations):
        """A registration_node whose parameter file says so, and a server with the run's configuration."""
        with open(self.path('icp.yaml'), 'w') as file:
            file.write(f'max_iterations: {max_iterations}\nrooms: {{max_iterations: {max_iterations + 1}}}\n')
        server = self.start(server.again())
        return server, self.registration_node(server, parameters=self.path('icp.yaml'))

    def assert_goes_on_with_the_same_file_only(self, first):
        server, node = self.play(first, max_iterations=1)
        self.assert_fails(server, r'holds results of another client', r'client_parameters: the run has `max_iterations: 35, '
                          r'rooms/max_iterations: 36`, asked for `max_iterations: 1, rooms/max_iterations: 2`')
        node.kill()
        server, node = self.play(first, max_iterations=35)
        self.assert_ends_well(node)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.data.of('local'))

    def test_a_run_goes_on_only_with_the_same_content_of_the_methods_file(self):
        """As finished, when no problem is put to the method any more, and as interrupted."""
        server = self.server(self.data, time_limit=60.0, summary_hold_time=60.0, autostart=False)
        server.wait_for_output('problems')
        server.interrupt()
        server.wait()
        server.parameters['autostart'] = True
        first, node = self.play(server, max_iterations=35)
        self.assert_ends_well(node)
        self.assert_ends_well(first)
        self.assert_goes_on_with_the_same_file_only(first)
        forget_results(first.run, "sequence = 'hall'")
        self.assertEqual(len(first.rows()), len(self.data.of('local', 'kitchen')))
        self.assert_goes_on_with_the_same_file_only(first)

    def test_a_run_goes_on_only_with_the_pcl_that_its_results_are_from(self):
        first = self.server(self.data, sequences='kitchen', summary_hold_time=60.0)
        node = self.registration_node(first)
        self.assert_ends_well(node)
        self.assert_ends_well(first)
        parameters = run_info(first.run)['client_parameters']
        pcl = re.search(r'^pcl: \d+\.\d+\.\d+, (float|double)$', parameters, re.MULTILINE)
        self.assertTrue(pcl, parameters)
        with contextlib.closing(sqlite3.connect(os.path.join(first.run, 'results.sqlite'))) as store, store:
            store.execute("UPDATE run SET value = ? WHERE key = 'client_parameters'",
                          [parameters.replace(pcl[0], 'pcl: 1.9.0, float')])
        server = self.start(first.again())
        self.start(Child(node.command, server.namespace))
        self.assert_fails(server, f'client_parameters: the run has `pcl: 1.9.0, float`, asked for `{pcl[0]}`')

    def test_what_a_node_set_itself_is_no_mistake_when_it_starts_again(self):
        server = self.server(self.data, sequences='kitchen', summary_hold_time=60.0)
        node = self.registration_node(server)
        self.assert_ends_well(node)
        self.assertTrue(rospy.has_param(f'{server.namespace}/registration_node/in_effect'))
        self.assert_ends_well(server)
        server = self.start(server.again(run=self.path('another')))
        self.assert_ends_well(self.start(Child(node.command, server.namespace)))
        self.assert_ends_well(server)

    def test_a_run_goes_on_only_with_the_client_that_its_results_are_from(self):
        server = self.server(self.data, sequences='kitchen', namespace='/pcrb')
        self.client(server).serve(server, limit=2)
        server.kill()
        server = self.start(server.again())
        self.start(Child([executable('pcrb_tools', 'minimal_client'), '__name:=beta']))
        self.assert_fails(server, f'client: the run has `{rospy.get_name()}`, asked for `/beta`')
        self.assertEqual(len(server.rows()), 2)

    def test_without_a_handshake_those_who_listen_are_recorded_as_clients(self):
        server = self.server(self.data, sequences='kitchen', handshake='none')
        client = self.client(server)
        for _ in self.data.of('local', 'kitchen'):
            problem = client.next_problem()
            wait_until(lambda: client.has('source', problem.header.stamp), 'the source comes')
            client.submit(problem)
        self.assert_ends_well(server)
        self.assertEqual(run_info(server.run)['client'], rospy.get_name())
        self.assertEqual(run_info(server.run)['client_parameters'], '')

    def test_frames_may_begin_with_a_slash_and_not_be_empty(self):
        server = self.server(self.data, sequences='kitchen', map_frame='/world')
        self.client(server).serve(server)
        self.assert_ends_well(server)
        self.assertEqual({(row['outcome'], row['replies_rejected']) for row in server.rows()}, {('replied', 0)})
        self.assert_fails(self.server(self.data, map_frame='/', scan_frame=''), '~map_frame: expected a name',
                          '~scan_frame: expected a name', '3 mistakes')
        self.assert_fails(self.server(self.data, map_frame='/scan', scan_frame='scan'), 'two different names')

    def test_a_run_whose_problem_file_has_changed_is_refused(self):
        server = self.finished(self.server(self.data, subset=2))
        path = self.data.folder('kitchen_local.txt')
        with open(path) as file:
            text = file.read()
        with open(path, 'w') as file:
            file.write(text.replace('0.7500', '0.7600', 1))
        self.assert_fails(self.start(server.again()), r'problem_file rooms/kitchen_local.txt: the run has')

    def test_a_run_whose_clouds_have_changed_is_refused(self):
        server = self.server(self.data, sequences='kitchen')
        self.client(server).serve(server, limit=5)
        server.kill()
        for name in maths.SEQUENCES['kitchen']:
            with open(self.data.folder('kitchen', name)) as file:
                text = file.read()
            with open(self.data.folder('kitchen', name), 'w') as file:
                file.write('# touched\n' + text)
        self.assert_fails(self.start(server.again()), r'cloud rooms/kitchen/k_\d+.pcd.* changed since this run used it')

    def test_a_run_folder_that_cannot_be_made_is_an_error(self):
        with open(self.path('file'), 'w'):
            pass
        self.assert_fails(self.server(self.data, run=self.path('file', 'run')), self.path('file', 'run'))

    def test_a_store_that_is_no_database_is_refused(self):
        os.makedirs(self.path('run'))
        with open(self.path('run', 'results.sqlite'), 'w') as file:
            file.write('not a database ' * 100)
        self.assert_fails(self.server(self.data), 'results.sqlite: .*not a database')

    def test_a_corrupt_cloud_is_an_error_that_names_file_and_line(self):
        path = self.data.folder('kitchen', 'k_0963.pcd')
        with open(path) as file:
            lines = file.readlines()
        lines[40] = '1.0 2.0 abc\n'
        with open(path, 'w') as file:
            file.writelines(lines)
        server = self.server(self.data)
        self.client(server).serve(server)
        self.assert_fails(server, r'k_0963.pcd:41: .*abc')
        for row in server.rows():
            self.assertNotIn('k_0963.pcd', (row['source'], row['target']))

    def test_a_missing_cloud_is_an_error_that_names_the_row(self):
        os.remove(self.data.folder('hall', 'h_2741.pcd'))
        self.assert_fails(self.server(self.data), r'hall_local.txt:2: .*h_2741.pcd')

    def test_a_perturbation_that_is_not_rigid_is_an_error_that_names_the_row(self):
        problem = self.data.of('local', 'kitchen')[2]
        problem.P[:3, :3] *= 1.00001
        self.data.write_problems('kitchen', 'local')
        self.assert_fails(self.server(self.data), r'kitchen_local.txt:4: .*rigid')

    def test_clouds_in_another_frame_are_an_error_that_explains_it(self):
        for name in maths.SEQUENCES['kitchen']:
            points = self.data.clouds['kitchen', name] + np.array([300.0, 0.0, 0.0])
            maths.write_cloud(self.data.folder('kitchen', name), points)
        server = self.server(self.data)
        self.assert_fails(server, 'rooms/kitchen', "in another frame than the problem file's", 'check_dataset')
        self.assertEqual(server.rows(), [])

    def test_arguments_and_masters(self):
        server = executable('pcrb_server', 'benchmark_server')
        nobody = 'http://127.0.0.1:9'
        self.assert_fails(self.start(Child([server], ROS_MASTER_URI=nobody)), f'no ROS master at {nobody}')
        self.assert_fails(self.start(Child([server, 'surplus'])), 'surplus')
        for package, name in ('pcrb_server', 'benchmark_server'), ('pcrb_tools', 'registration_node'):
            node = self.start(Child([executable(package, name), '--help'], ROS_MASTER_URI=nobody))
            self.assert_ends_well(node)
            self.assertIn('Private parameters', node.output())


if __name__ == '__main__':
    rospy.init_node('parameters_test')
    rostest.rosrun('pcrb_launch', 'parameters', ParametersTest)
