#!/usr/bin/env python3
"""A recording of a replay goes in as a log of one's own, and comes out as what was replayed."""
import glob
import os
import subprocess
import sys

import numpy as np
import rosbag
import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path
from sensor_msgs.msg import PointCloud2
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from pcrb_testing import Child, TestCase, executable, wait_until

TOPICS = {'/replayed/scan': PointCloud2, '/replayed/map': PointCloud2, '/replayed/sensor': PoseStamped,
          '/replayed/path': Path, '/tf': TFMessage, '/tf_static': TFMessage}
MICROMETRE = 1e-6


def read_cloud(path):
    """VIEWPOINT, and x y z of an ASCII PCD file of this suite."""
    with open(path, encoding='utf-8') as file:
        viewpoint = next(line for line in file if line.startswith('VIEWPOINT')).split()[1:]
        next(line for line in file if line.startswith('DATA'))
        return np.array(viewpoint, float), np.loadtxt(file, usecols=(0, 1, 2), ndmin=2)


class OwnDataTest(TestCase):

    def tool(self, name, *arguments):
        result = subprocess.run([executable('pcrb_tools', name), *arguments], stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, encoding='utf-8')
        return result.returncode, result.stdout

    def assert_succeeds(self, name, *arguments):
        status, output = self.tool(name, *arguments)
        self.assertEqual(status, 0, output)
        return output

    def record(self, root, bag, count):
        """Every message of a replay that is stepped through."""
        messages = []
        subscribers = [rospy.Subscriber(topic, kind, lambda message, topic=topic: messages.append((topic, message)))
                       for topic, kind in TOPICS.items()]
        rospy.set_param('/replayed/replay', {'root': root, 'sequence': 'eth/apartment', 'autostart': False, 'rate': 100,
                                             'keep_alive': True})
        replay = self.start(Child([executable('pcrb_server', 'replay')], '/replayed'))
        rospy.wait_for_service('/replayed/replay/step', 60)
        step = rospy.ServiceProxy('/replayed/replay/step', Trigger)

        def number_of(wanted):
            return len({message.header.stamp for topic, message in list(messages) if topic == wanted})

        for i in range(count):
            self.assertTrue(step().success)
            for topic in '/replayed/scan', '/replayed/sensor':
                wait_until(lambda topic=topic, wanted=i + 1: number_of(topic) >= wanted, f'{i + 1} messages on {topic}')
        for subscriber in subscribers:
            subscriber.unregister()
        replay.interrupt()
        self.assert_ends_well(replay)
        with rosbag.Bag(bag, 'w') as file:
            for topic, message in messages:
                stamp = message.header.stamp if hasattr(message, 'header') else message.transforms[0].header.stamp
                file.write(topic, message, stamp)

    def test_a_recorded_replay_gives_the_clouds_that_it_replayed(self):
        logs, root, own, bag = (self.path(name) for name in ('logs', 'root', 'own', 'walk.bag'))
        self.assert_succeeds('make_sample_logs', '--output', logs, '--data-set', 'eth')
        self.assert_succeeds('eth_to_pcd', f'{logs}/eth/apartment', '--root', root)
        replayed = sorted(glob.glob(f'{root}/eth/apartment/*.pcd'), key=lambda path: int(path[:-4].split('PointCloud')[1]))
        self.record(root, bag, len(replayed))

        status, output = self.tool('convert_log', bag, '--root', own, '--data-set', 'mine')
        self.assertEqual(status, 1)
        self.assertRegex(output, r'found clouds on /replayed/map, /replayed/scan, expected one topic .*--cloud-topic')
        output = self.assert_succeeds('convert_log', bag, '--root', own, '--data-set', 'mine', '--cloud-topic', '/replayed/scan')
        self.assertRegex(output, r'note: poses: /replayed/sensor, in the frame `map`')
        self.assertRegex(output, r'0 errors')

        found = sorted(glob.glob(f'{own}/mine/walk/*.pcd'))  # their names are their stamps
        self.assertEqual(len(found), len(replayed))
        for ours, theirs in zip(found, replayed):
            (viewpoint, points), (true_viewpoint, true_points) = read_cloud(ours), read_cloud(theirs)
            self.assertEqual(points.shape, true_points.shape)
            self.assertLess(np.abs(points - true_points).max(), MICROMETRE)
            self.assertLess(np.abs(viewpoint - true_viewpoint).max(), MICROMETRE)
        for name in 'dataset.yaml', 'walk_map.pcd', 'walk_overlap.txt', 'walk_local.txt', 'walk_global.txt':
            self.assertTrue(os.path.isfile(f'{own}/mine/{name}'), name)


if __name__ == '__main__':
    rospy.init_node('own_data_test')
    rostest.rosrun('pcrb_launch', 'own_data', OwnDataTest)
