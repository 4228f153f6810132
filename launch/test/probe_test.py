#!/usr/bin/env python3
"""pcrb probe: what a node takes and says becomes the recipe that fits; what cannot be told is said."""
import concurrent.futures
import os
import signal
import subprocess
import sys

import rostest
import yaml

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from pcrb_testing import Child, TestCase, front_door, wait_until
from pcrb_testing_processes import marked_processes
from pcrb_testing_terminal import CTRL_C, Terminal

SILENT = [front_door(), 'probe', '--node', 'localization_standins ill_mannered_localizer.launch', '--node-args', 'manner=silent']


def wait_for_node(mark):
    """And for the master that it was started with."""
    for name in 'rosmaster', '__name:=ill_mannered_localizer':
        wait_until(lambda n=name: any(n in line for line in marked_processes(mark).values()), f'{name} is there')


class ProbeTest(TestCase):

    def probe(self, node, *words):
        """Exit status, parameters, and what was printed."""
        result = subprocess.run([front_door(), 'probe', '--node', f'localization_standins {node}_localizer.launch', *words],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding='utf-8', check=False)
        text = ' '.join(line.lstrip('# ') for line in result.stdout.splitlines()) + result.stderr
        return result.returncode, yaml.safe_load(result.stdout), text

    def probes(self, arguments):
        """Several at once, each with a master of its own: a probe waits for most of its time."""
        with concurrent.futures.ThreadPoolExecutor(3) as pool:
            return list(pool.map(lambda words: self.probe(*words), arguments))

    def test_topics_links_and_the_rule_are_found_out(self):
        (_, ndt, text), (_, particle, _), (_, smoothing, of_smoothing) = self.probes(
            [('ndt',), ('particle',), ('smoothing', '--output', self.path('recipe.yaml'))])
        self.assertEqual(ndt, {'map_topic': '/map_cloud', 'scan_topic': '/scan_cloud', 'pose_topic': '/ndt_pose', 'settle': 'first'})
        self.assertIn('10 of 10 scans were answered', text)
        self.assertEqual((particle['pose_topic'], particle['tf_odom_base']), ('tf', 'dynamic'))
        self.assertEqual((smoothing['pose_topic'], smoothing['settle']), ('/odom', 'stable'))
        self.assertIn('its first answer repeats the initial pose', of_smoothing)
        with open(self.path('recipe.yaml'), encoding='utf-8') as file:
            self.assertEqual(yaml.safe_load(file), smoothing)

    def test_looks_at_the_poses_that_it_is_told_to(self):
        status, _, text = self.probe('smoothing', '--pose-topic', '/nobody')
        self.assertEqual(status, 1, text)
        self.assertIn('the node answered none of ten scans', text)

    def test_bad_manners_are_named(self):
        expected = {'now': ({'match': 'arrival'}, 'stamp of no scan'), 'ahead': ({'answer_delay': 0.2}, '0.2000 s after their scans'),
                    'frame': ({}, 'answers are in frame world'), 'nan': ({}, 'poses are no pose'),
                    'silent': ({}, r'the node answered none of ten scans'), 'crash': ({}, 'the node died during the probe'),
                    'owner': ({}, 'another node publishes /map_cloud, which the bridge does'),
                    'velocity': ({'settle': 'first'}, 'a motion model takes the correction for motion')}
        probed = self.probes([('ill_mannered', '--node-args', f'manner={manner}') for manner in expected])
        for (manner, (parameters, words)), (_, found, text) in zip(expected.items(), probed):
            self.assertIn(words, text, manner)
            for name, value in parameters.items():
                self.assertEqual(found.get(name), value, text)

    def test_a_node_that_reads_its_map_from_a_file_gets_one_and_no_topic(self):
        file = self.path('map.pcd')
        words = '--node-args', f'map={file}', '--map-file', file
        _, found, text = self.probe('map_file', *words)
        self.assertEqual(found, {'map_file': file, 'restart': 'target', 'map_settle': 3, 'scan_topic': '/scan_cloud',
                                 'pose_topic': '/ndt_pose', 'settle': 'first'})
        self.assertNotIn('another node', text)
        _, _, text = self.probe('map_file', *words[:2])
        self.assertIn('another node publishes /map_cloud, which the bridge does: leave it out of the launch file; if it reads the map '
                      'from a file when it starts, give --map-file', text)

    def test_a_probe_that_is_killed_leaves_no_process(self):
        mark = self.path('of this probe')
        probe = self.start(Child(SILENT, PCRB_MARK=mark))
        wait_for_node(mark)
        os.kill(probe.process.pid, signal.SIGKILL)
        wait_until(lambda: not marked_processes(mark), 'nothing is left')

    def test_ctrl_c_ends_a_probe_with_one_line_and_leaves_no_process(self):
        mark = self.path('of this probe')
        terminal = Terminal(SILENT, PCRB_MARK=mark, NO_COLOR='1')
        wait_for_node(mark)
        terminal.press(CTRL_C)
        self.assertEqual(terminal.wait(), 130, terminal.text)
        self.assertEqual(terminal.text.split(), ['^C', 'pcrb:', 'interrupted'])
        self.assertEqual(marked_processes(mark), {})

    def test_a_launch_file_that_fails_is_an_error_with_what_it_printed(self):
        status, _, text = self.probe('no_such')
        self.assertEqual(status, 1)
        self.assertIn('no_such_localizer.launch', text)


if __name__ == '__main__':
    rostest.rosrun('pcrb_launch', 'probe', ProbeTest)
