#!/usr/bin/env python3
"""Converters as nodes: what rosbag play publishes becomes the same files as offline."""
import collections
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import xmlrpc.client

import genpy
import rosbag
import rosgraph
import rospy
import rostest
from sensor_msgs.msg import PointCloud2, PointField

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from pcrb_testing import Child, TestCase, executable, wait_until

SECOND = 1311878220
SCANS = 8
VELODYNES = ['/ns1/velodyne_points', '/ns2/velodyne_points']

LEFT_CALIBRATION = 'RPY: 1 2 3\nR: 0 -1 0 1 0 0 0 0 1\nT: -0.5 0.25 2\n'
RIGHT_CALIBRATION = 'RPY: 1 2 3\nR: 1 0 0 0 1 0 0 0 1\nT: -0.5 -0.25 2\n'


def header(message, nanoseconds):
    message.header.stamp = genpy.Time(SECOND, nanoseconds)
    message.header.frame_id = 'sensor'
    return message


def cloud(nanoseconds, points, extra):
    """Organized like a driver's: 32 bytes a point, x y z at 0, 4, 8 and another field at 16."""
    message = header(PointCloud2(), nanoseconds)
    message.height, message.width, message.point_step = 1, len(points), 32
    for name, offset in ('x', 0), ('y', 4), ('z', 8), (extra, 16):
        message.fields.append(PointField(name, offset, PointField.FLOAT32, 1))
    message.data = b''.join(struct.pack('<3f20x', *point) for point in points)
    return message


def points_of(scan):
    return [(scan + 0.25, 0.1 * i, 1.0 + i) for i in range(50)] + [(0.0, 0.0, 0.0)]


class LiveConversionTest(TestCase):

    @classmethod
    def setUpClass(cls):
        cls.logs = tempfile.mkdtemp(prefix='pcrb_rostest_')
        cls.addClassCleanup(shutil.rmtree, cls.logs)
        subprocess.run([executable('pcrb_tools', 'make_sample_logs'), '--output', cls.logs, '--data-set', 'tum'],
                       check=True)

    def sample_log(self, sequence):
        return os.path.join(self.logs, 'tum', f'rgbd_dataset_{sequence}')

    def tum_poses(self):
        rows = (f'{SECOND}.{10 * i:03d} {i} 2 3 0 0 0.6 0.8\n' for i in range(90))
        return self.write('log-groundtruth.txt', '# timestamp tx ty tz qx qy qz qw\n' + ''.join(rows))

    def kaist_poses(self):
        rows = (f'{100 * SECOND + i}0000000,0,-1,0,{332100.125 + i},1,0,0,4140500.25,0,0,1,21.5\n' for i in range(390))
        return self.write('global_pose.csv', ''.join(rows))

    def bag(self, messages):
        """A bag with (topic, message)s, recorded when they were stamped."""
        path = self.path('log.bag')
        with rosbag.Bag(path, 'w') as bag:
            for topic, message in messages:
                bag.write(topic, message, message.header.stamp)
        return path

    def convert_offline(self, converter, bag, *options):
        root = self.path('offline')
        subprocess.run([executable('pcrb_tools', converter), bag, '--root', root, '--sequence', 'log', *options],
                       check=True)
        return root

    def live(self, converter, **parameters):
        name = f'/{converter}'
        rospy.set_param(name, {'root': self.path('live'), 'sequence': 'log', **parameters})
        self.addCleanup(rospy.delete_param, name)
        return self.start(Child([executable('pcrb_tools', converter), '--live']))

    def wait_for_subscribers(self, node, topics):
        def has_subscribed():
            self.assertFalse(node.ended(), node.output())
            subscribers = dict(rosgraph.Master('/test').getSystemState()[1])
            return all(subscribers.get(topic) for topic in topics)
        wait_until(has_subscribed, 'the node subscribes')

    def play(self, bag, node, topics, *options):
        """Plays a bag once the node has subscribed. The player stays: one that ends drops what it has not sent yet."""
        self.wait_for_subscribers(node, topics)
        return self.start(Child(['rosbag', 'play', '--quiet', '--keep-alive', '--wait-for-subscribers', '--rate=4', *options, bag,
                                 '--topics', *topics]))

    def play_all(self, converter, bag, node, topics, start=0.0):
        """Plays a bag until the node has received every message from `start` s on."""
        with rosbag.Bag(bag) as played:
            messages = [(topic, stamp) for topic, _, stamp in played.read_messages(raw=True)]
        first = messages[0][1] + genpy.Duration.from_sec(start)  # in ns: a double may be later than the first message
        expected = collections.Counter(topic for topic, stamp in messages if topic in topics and stamp >= first)
        player = self.play(bag, node, topics, f'--start={start:g}')

        def received():
            """By topic, as the node itself counts. What it answers is [publications, subscriptions], not [1, '', [these]]."""
            self.assertFalse(node.ended(), node.output())
            address = rosgraph.Master('/test').lookupNode(f'/{converter}')
            answer = xmlrpc.client.ServerProxy(address).getBusStats('/test')
            subscriptions = answer[1] if isinstance(answer[1], list) else answer[2][1]
            return {topic: sum(connection[2] for connection in connections) for topic, connections in subscriptions}
        wait_until(lambda: all(received().get(topic, 0) >= count for topic, count in expected.items()), 'every message is received')
        player.interrupt()
        player.wait()

    def assert_live_equals_offline(self, node, offline, data_set, interrupt=True):
        """Waits for the clouds, ends the node or lets it end by itself, and compares bytes."""
        expected = os.path.join(offline, data_set, 'log')
        folder = os.path.join(self.path('live'), data_set, 'log')
        names = sorted(name for name in os.listdir(expected) if name.endswith('.pcd'))
        wait_until(lambda: all(os.path.exists(os.path.join(folder, name)) for name in names[:-1]),
                   'all clouds but the last, which may wait for its partner, are there')
        if interrupt:
            node.interrupt()
        self.assertEqual(node.wait(), 0, node.output())
        self.assertEqual(sorted(os.listdir(folder)), ['.conversion', *names])
        for name in names:
            with open(os.path.join(folder, name), 'rb') as live, open(os.path.join(expected, name), 'rb') as original:
                self.assertEqual(live.read(), original.read(), name)
        return names

    def test_clouds_of_a_sample_bag(self):
        log, topic = self.sample_log('freiburg2_pioneer_slam'), '/camera/rgb/points'
        bag, poses = f'{log}-2hz-with-pointclouds.bag', f'{log}-groundtruth.txt'
        offline = self.convert_offline('tum_to_pcd', bag, '--poses', poses)
        node = self.live('tum_to_pcd', data_set='tum', poses=poses)
        self.play_all('tum_to_pcd', bag, node, [topic])
        names = self.assert_live_equals_offline(node, offline, 'tum')
        self.assertGreater(len(names), 5)
        self.assertIn(f'{len(names)} written', node.output())

    def test_depth_images_of_a_sample_bag_until_nothing_comes_any_more(self):
        log = self.sample_log('freiburg3_long_office_household')
        offline = self.convert_offline('tum_to_pcd', f'{log}.bag')
        node = self.live('tum_to_pcd', poses=f'{log}-groundtruth.txt', input='depth', idle_limit=10.0)
        self.play(f'{log}.bag', node, ['/camera/depth/image', '/camera/rgb/camera_info'])
        self.assertGreater(len(self.assert_live_equals_offline(node, offline, 'tum', interrupt=False)), 5)

    def start_two_velodynes(self, scans):
        """A log of two sensors, its clouds as converted offline, and the node."""
        messages = []
        for i in range(scans):
            messages.append((VELODYNES[0], cloud(100000000 * i + 50000001, points_of(i), 'intensity')))
            messages.append((VELODYNES[1], cloud(100000000 * i + 70000003, points_of(-i), 'intensity')))
        bag = self.bag(messages)
        files = {'poses': self.kaist_poses(), 'left_calibration': self.write('left.txt', LEFT_CALIBRATION),
                 'right_calibration': self.write('right.txt', RIGHT_CALIBRATION)}
        options = [word for name, path in files.items() for word in (f'--{name.replace("_", "-")}', path)]
        offline = self.convert_offline('kaist_to_pcd', bag, '--frame-offset', '10.5', '20', '30', *options)
        return bag, offline, self.live('kaist_to_pcd', frame_offset='10.5 20 30', **files)

    def test_two_velodynes(self):
        bag, offline, node = self.start_two_velodynes(SCANS)
        self.play_all('kaist_to_pcd', bag, node, VELODYNES)
        names = self.assert_live_equals_offline(node, offline, 'kaist')
        self.assertEqual(names[0], f'log_{SECOND}050000001.pcd')
        self.assertEqual(len(names), SCANS)

    def test_two_velodynes_played_from_the_middle_and_then_wholly(self):
        bag, offline, node = self.start_two_velodynes(36)
        self.play_all('kaist_to_pcd', bag, node, VELODYNES, start=2.0)
        self.play_all('kaist_to_pcd', bag, node, VELODYNES)
        self.assertEqual(len(self.assert_live_equals_offline(node, offline, 'kaist')), 36)
        self.assertIn('the stamps went back', node.output())

    def test_all_mistakes_in_the_parameters_are_listed(self):
        node = self.live('kaist_to_pcd', root='', frame_offset='1 2', max_rate=-1, colour='red')
        self.assertNotEqual(node.wait(), 0)
        for mistake in ('7 mistakes', '~root: must be given', '~poses: must be given',
                        '~left_calibration: must be given', '~right_calibration: must be given',
                        '~frame_offset: expected 3 numbers', '~max_rate: found', '~colour: no parameter'):
            self.assertIn(mistake, node.output())

    def test_a_defective_message_ends_the_node_with_its_topic_and_stamp(self):
        topic = '/camera/rgb/points'
        defective = cloud(100000000, points_of(0), 'rgb')
        defective.width += 1
        bag = self.bag([(topic, cloud(0, points_of(0), 'rgb')), (topic, defective),
                        (topic, cloud(200000000, points_of(0), 'rgb'))])
        node = self.live('tum_to_pcd', poses=self.tum_poses(), max_rate=0)
        self.play(bag, node, [topic])
        self.assertEqual(node.wait(), 1)
        self.assertIn(f'{topic} {SECOND}.100000000.pcd: PointCloud2: found', node.output())
        folder = self.path('live', 'tum', 'log')
        self.assertEqual([name for name in os.listdir(folder) if name.endswith('.tmp')], [])

    def test_parameters_on_the_command_line_without_a_master_are_an_error_and_no_hang(self):
        node = self.start(Child([executable('pcrb_tools', 'tum_to_pcd'), '--live', '_root:=live', '_sequence:=log'],
                                ROS_MASTER_URI='http://127.0.0.1:1'))
        self.assert_fails(node, 'no ROS master at http://127.0.0.1:1')

    def test_an_interrupt_before_the_first_message_says_what_did_not_come(self):
        topic = '/camera/rgb/points'
        node = self.live('tum_to_pcd', poses=self.tum_poses())
        self.wait_for_subscribers(node, [topic])
        node.interrupt()
        self.assertEqual(node.wait(), 1)
        self.assertIn('no scan became a cloud', node.output())
        self.assertIn(f'nothing came on {topic}', node.output())


if __name__ == '__main__':
    rospy.init_node('live_conversion_test')
    rostest.rosrun('pcrb_launch', 'live_conversion', LiveConversionTest, sys.argv)
