#!/usr/bin/env python3
"""pcrb localize: the terminal says what keeps a node from being benchmarked, and what to type, before a problem counts."""
import os
import re
import sys

import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import TestCase, front_door, rows
from pcrb_testing_terminal import CTRL_C, Terminal
from pcrb_testing_wait import LIMIT

NDT = 'localization_standins ndt_localizer.launch'
RIGHT = 'map_topic=/map scan_topic=/scan'
ILL = """<launch>
  <include file="$(find localization_standins)/launch/ill_mannered_localizer.launch">
    <arg name="manner" value="{}"/> <arg name="map_topic" value="/map"/> <arg name="scan_topic" value="/scan"/>
  </include>
</launch>"""
DYING = """<launch>
  <node name="mine" pkg="localization_standins" type="ndt_localizer" launch-prefix="sh -c 'echo &quot;[FATAL] [1.5]: found no map_path&quot; >&amp;2; exit 3'"/>
</launch>"""
UNBUILT = '<launch> <node name="mine" pkg="localization_standins" type="not_built"/> </launch>'
HALF = """<launch>
  <node name="other" pkg="localization_standins" type="not_built"/>
  <node name="ndt_localizer" pkg="localization_standins" type="ndt_localizer"/>
</launch>"""


class ConsoleTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=400, perturbations=4)

    def localize(self, *words, node=NDT, node_args=None):
        arguments = ['--node-args', node_args] if node_args else []
        return Terminal([front_door(), 'localize', '--root', self.data.root, '--run', self.path('run'), '--sequences', 'kitchen',
                         '--subset', '4', '--node', node, *arguments, *words], TERM='dumb')

    def launch_file(self, text):
        self.write('mine.launch', text)
        return self.path('mine.launch')

    def parameters(self, text):
        self.write('parameters.yaml', text)
        return ['--bridge-parameters', self.path('parameters.yaml')]

    def assert_shown_before_a_result(self, terminal, *patterns):
        for pattern in patterns:
            terminal.wait_for(pattern)
        terminal.press(CTRL_C)
        self.assertEqual(terminal.wait(), 130, terminal.text)
        self.assert_no_result()

    def assert_ends_saying(self, terminal, *patterns):
        self.assertEqual(terminal.wait(2 * LIMIT), 1, terminal.text)  # on a busy machine a node dies slowly, and ~connect_limit ends the run
        text = ' '.join(terminal.text.split())
        for pattern in patterns:
            self.assertRegex(text, pattern)
        self.assert_no_result()

    def assert_no_result(self):
        shard = self.path('run', 'shards', '0')
        self.assertEqual(rows(shard) if os.path.exists(os.path.join(shard, 'results.sqlite')) else [], [])

    def test_other_topics_of_the_node_are_named_with_what_to_type_and_the_advice_helps(self):
        self.assert_shown_before_a_result(
            self.localize(), r'localization_bridge: waiting for a node that subscribes to /scan\s+'
            r'no node subscribes to /scan \(scan_topic\); nodes wait for sensor_msgs/PointCloud2 on /map_cloud \(by /ndt_localizer\), '
            r'/scan_cloud \(by /ndt_localizer\): set scan_topic:=/scan_cloud or so',
            r'no node subscribes to /map \(map_topic\); .*: set map_topic:=/map_cloud or so', 'pcrb recipes lists')
        self.assert_shown_before_a_result(
            self.localize('scan_topic:=/scan_cloud', 'map_topic:=/map_cloud'),
            r'no node publishes /pose \(pose_topic\) so far; poses are published on /ndt_pose \(geometry_msgs/PoseStamped by '
            r'/ndt_localizer\): set pose_topic:=/ndt_pose')
        terminal = self.localize('scan_topic:=/scan_cloud', 'map_topic:=/map_cloud', 'pose_topic:=/ndt_pose', '--settle', 'first')
        self.assertEqual(terminal.wait(), 0, terminal.text)
        self.assertNotIn('nodes wait for', terminal.text)

    def test_a_map_that_no_node_takes_is_told(self):
        self.assert_shown_before_a_result(
            self.localize(node_args='scan_topic=/scan'),
            r'localization_bridge: no node subscribes to /map \(map_topic\); nodes wait .* on /map_cloud \(by /ndt_localizer\): '
            'set map_topic:=/map_cloud')

    def test_answers_of_a_type_that_is_no_pose_end_the_run_at_once(self):
        self.assert_ends_saying(
            self.localize('pose_topic:=/rosout', node_args=RIGHT),
            r'/rosout \(pose_topic\): found messages of type rosgraph_msgs/Log, expected PoseStamped, .*set pose_topic:=/ndt_pose')

    def test_a_link_of_tf_that_nobody_sends_is_told_with_the_frames_that_are_there(self):
        self.assert_shown_before_a_result(
            self.localize('--scan-frame', 'velodyne', *self.parameters('tf_base_scan: none'), node_args=RIGHT),
            r'localization_bridge: waiting for tf from base_link to velodyne; on tf are base_link [^:]*odom: start what publishes the link, '
            r'set `tf_base_scan: static` in bridge_parameters if velodyne is where base_link is')

    def test_a_rival_on_tf_ends_the_run_and_is_named(self):
        self.assert_ends_saying(
            self.localize('map_topic:=/another_map', node=self.launch_file(ILL.format('owner'))),  # its map alone would end the run, too
            'another node does what the bridge does',
            r'ill_mannered_localizer publishes the tf frame sensor \(in base_link\); or set `tf_base_scan: none` in bridge_parameters')

    def test_what_a_dying_node_printed_is_shown_and_that_it_is_started_anew(self):
        """In any order: these are the words of three processes."""
        self.assert_ends_saying(
            self.localize(node=self.launch_file(DYING)), r'node under test: \[FATAL\] found no map_path',
            r'node under test: \[mine-1\] process has died, exit code 3', 'node_supervisor: the node under test has ended: it is started anew')

    def test_what_is_wrong_with_a_launch_file_is_shown(self):
        for text, reason in ((UNBUILT, 'found no program not_built of package localization_standins: is it built?'),
                             ('<launch> <node name="a"/> </launch>', 'node.*pkg'), ('<launch> <node', '([Xx][Mm][Ll]|token)'),
                             ('<launch> <arg name="map"/> </launch>', r'mine\.launch: argument `map` must be given')):
            self.assert_ends_saying(self.localize(node=self.launch_file(text)),
                                    f'the node\'s launch file cannot be started as asked;? .*{reason}')

    def test_a_node_of_a_launch_file_whose_program_is_not_there_is_named(self):
        self.assert_shown_before_a_result(
            self.localize(node=self.launch_file(HALF)), 'node_supervisor: the node\'s launch file goes on without one of its nodes: '
            'found no program not_built of package localization_standins')

    def test_the_second_problem_that_fails_alike_and_the_table_at_the_end_are_shown(self):
        terminal = self.localize('--time-limit', '40', *self.parameters('{deadline_fraction: 0.2, answer_limit: 0.3, restart_after: 0}'),
                                 node=self.launch_file(ILL.format('now')))
        terminal.wait()
        self.assertEqual(len(re.findall('localization_bridge: two problems without an answer, alike: ', terminal.text)), 1, terminal.text)
        self.assertRegex(terminal.text, r'problems without an answer, by cause .*\s+[2-4] × stamp: \d+ poses? with the stamp of no scan')


if __name__ == '__main__':
    rostest.rosrun('pcrb_launch', 'console', ConsoleTest)
