#!/usr/bin/env python3
"""localization_bridge: types of answers, the sensor's mounting, silence, rivals, services, parameters."""
import os
import sys
import time

import numpy as np
import rosgraph
import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, PointCloud2
from std_msgs.msg import String
from std_srvs.srv import Empty, Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, executable, wait_until
from pcrb_testing_bridge import BridgeTestCase, SlowRobot

MOTION = maths.transform(maths.axis_angle([0.1, -0.3, 1], 0.05), [0.2, -0.1, 0.05])
DRIFT = maths.transform(maths.axis_angle([0, 0, 1], 1.0), [3.0, 2.0, 0.0])
MOUNTING = maths.transform(maths.axis_angle([0, 0, 1], np.pi) @ maths.axis_angle([0, 1, 0], np.radians(10)),
                           [1.0, 0.0, 1.9])  # T_base_sensor


def fill_transform(transform, T):
    """Writes a 4 x 4 into a geometry_msgs/Transform."""
    pose = maths.fill_pose(PoseStamped().pose, T)
    t = transform.translation
    t.x, t.y, t.z = pose.position.x, pose.position.y, pose.position.z
    transform.rotation = pose.orientation


def link(parent, child, T, stamp):
    message = TransformStamped()
    message.header.frame_id, message.header.stamp, message.child_frame_id = parent, stamp, child
    fill_transform(message.transform, T)
    return message


def make_answer(kind, stamp, T):
    """A message of one of the types that nodes publish."""
    if kind is TransformStamped:
        return link('map', 'base_link', T, stamp)
    message = kind()
    message.header.frame_id, message.header.stamp = 'map', stamp
    pose = message.pose if kind is PoseStamped else message.pose.pose
    maths.fill_pose(pose, T)
    if kind is Odometry:
        message.child_frame_id = 'base_link'
    return message


def moved_covariance(covariance, arm):
    """Of x y z rx ry rz of a point that a turn moves since it lies away by `arm`."""
    x, y, z = arm
    J = np.eye(6)
    J[:3, 3:] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]
    return J @ covariance @ J.T


class BridgeBehaviourTest(BridgeTestCase):

    def publisher(self, name, kind, **options):
        publisher = rospy.Publisher(name, kind, queue_size=10, **options)
        self.addCleanup(publisher.unregister)
        return publisher

    def answering(self, server, kind=PoseStamped, motion=MOTION, answer=make_answer, **options):
        """A robot whose answers are of that type."""
        publisher = self.publisher(f'{server.namespace}/robot/pose', kind)
        return self.robot(server, lambda stamp, T: publisher.publish(answer(kind, stamp, T)), motion, **options)

    def scores(self, server, **parameters):
        """Of a run through the bridge; the robot has been made."""
        rows = self.rows_of_bridge(server, self.bridge(server, **{'settle': 'first', **parameters}))
        self.assertEqual({row['outcome'] for row in rows.values()}, {'replied'}, rows)
        return rows

    def assert_motion_is_scored(self, rows, times=lambda row: 1):
        """What is left is MOTION P, once or for each scan: the guess is P V, and V is the truth."""
        for row in rows.values():
            problem = self.data.by_id(row['problem_id'])
            motion = np.linalg.matrix_power(MOTION, times(row))
            error = maths.error(self.data.source_points(problem), motion @ self.data.local_P(problem))
            self.assertAlmostEqual(row['error'] / error, 1, delta=1e-5, msg=row)

    def test_answers_of_four_types(self):
        for kind in PoseStamped, PoseWithCovarianceStamped, Odometry, TransformStamped:
            server = self.localization(run=kind.__name__, subset=3)
            robot = self.answering(server, kind)
            self.assert_motion_is_scored(self.scores(server, map_settle=0.0))
            robot.close()

    def test_a_scan_that_a_slow_node_still_has_is_finished_before_the_next_problem(self):
        """It is slower than answer_limit, so that it has one more scan when its first answer comes."""
        server = self.localization(subset=4)
        self.answering(server, make=SlowRobot, work=0.3)
        self.assert_motion_is_scored(self.scores(server, answer_limit=0.15))

    def test_a_scan_that_a_node_has_at_the_deadline_is_finished_before_the_next_problem(self):
        server = self.localization(subset=3, time_limit=1.0)
        self.answering(server, make=SlowRobot, work=0.2)
        rows = self.scores(server, settle='deadline')
        self.assert_motion_is_scored(rows, times=lambda row: row['scans_used'])

    def test_answers_on_tf_are_composed_through_odom_in_either_order(self):
        broadcaster = tf2_ros.TransformBroadcaster()
        for step in 1, -1:
            server = self.localization(run=f'step{step}', subset=5, time_limit=5.0)

            def publish(stamp, T, step=step):
                """As a filter beside the robot's own odometry does."""
                broadcaster.sendTransform([link('odom', 'base_link', DRIFT, stamp),
                                           link('map', 'odom', T @ np.linalg.inv(DRIFT), stamp)][::step])

            robot = self.robot(server, publish, MOTION)
            self.assert_motion_is_scored(self.scores(server, pose_topic='tf', tf_odom_base='none'))
            robot.close()

    def test_an_answer_may_come_before_the_transform_that_it_needs(self):
        server = self.localization(subset=5, time_limit=5.0)
        broadcaster = tf2_ros.TransformBroadcaster()
        publisher = self.publisher(f'{server.namespace}/robot/pose', Odometry)

        def publish(stamp, T):
            odometry = make_answer(Odometry, stamp, DRIFT)
            odometry.header.frame_id = 'odom'
            publisher.publish(odometry)
            time.sleep(0.02)  # as long as this node takes for the rest of its work
            broadcaster.sendTransform(link('map', 'odom', T @ np.linalg.inv(DRIFT), stamp))

        self.robot(server, publish, MOTION)
        self.assert_motion_is_scored(self.scores(server))

    def test_a_covariance_is_that_of_the_sensor_in_the_map_whatever_pose_the_node_tells(self):
        C = np.diag([1, 2, 3, 4, 5, 6]) * 1e-4
        R = np.kron(np.eye(2), DRIFT[:3, :3])

        def of_body(T):
            return moved_covariance(C, -T[:3, :3] @ MOUNTING[:3, 3])

        nodes = {'body': ('map', lambda T: (T, of_body(T)), {}),
                 'sensor': ('map', lambda T: (T @ MOUNTING, C), {'answer_frame': 'lidar'}),
                 'turned': ('drifted', lambda T: (np.linalg.inv(DRIFT) @ T, R.T @ of_body(T) @ R), {})}
        now = rospy.Time.now()
        broadcaster = tf2_ros.StaticTransformBroadcaster()
        broadcaster.sendTransform([link('base_link', 'lidar', MOUNTING, now), link('map', 'drifted', DRIFT, now)])
        for name, (parent, tell, parameters) in nodes.items():
            def answer(kind, stamp, T, parent=parent, tell=tell):
                pose, covariance = tell(T)
                message = make_answer(kind, stamp, pose)
                message.header.frame_id = parent
                message.pose.covariance = covariance.ravel().tolist()
                return message

            server = self.localization(run=name, subset=2)
            robot = self.answering(server, PoseWithCovarianceStamped, answer=answer)
            rows = self.scores(server, tf_base_scan='none', scan_frame='lidar', **parameters)
            robot.close()
            for row in rows.values():
                stored = np.reshape([float(entry) for entry in row['covariance'].split()], (6, 6))
                np.testing.assert_allclose(stored, C, rtol=0, atol=1e-9, err_msg=name)

    def test_the_sensors_mounting_leaves_the_scores_unchanged(self):
        first, second = self.twin_servers()
        server = first()
        self.answering(server)
        rows = self.scores(server)
        server = second()
        self.answering(server)
        broadcaster = tf2_ros.StaticTransformBroadcaster()
        broadcaster.sendTransform(link('base_link', 'lidar', MOUNTING, rospy.Time.now()))
        bridge = self.bridge(server, settle='first', tf_base_scan='none', scan_frame='lidar')
        others = self.rows_of_bridge(server, bridge)
        self.assert_same_scores(rows, others, 1e-9)
        initial = [row['initial_misalignment'] for row in rows.values()]
        self.assertGreater(min(abs(row['error'] - before) for row, before in zip(rows.values(), initial)), 1e-6)

    def test_what_a_node_gets(self):
        server = self.localization(sequences='kitchen', subset=2)
        imus, odometry = [], []
        robot = self.answering(server)
        for topic, kind, messages in ('imu', Imu, imus), ('odometry', Odometry, odometry):
            subscriber = rospy.Subscriber(f'{server.namespace}/robot/{topic}', kind, messages.append)
            self.addCleanup(subscriber.unregister)
        calls = []
        service = rospy.Service(f'{server.namespace}/relocalize', Empty, lambda _: calls.append(1) or [])
        self.addCleanup(service.shutdown)
        map_file = self.path('the_map.pcd')
        rows = self.scores(server, settle='nth', settle_count=4, max_scans=9, map_file=map_file,
                           before_problem=f'{server.namespace}/relocalize',
                           imu_topic=f'{server.namespace}/robot/imu',
                           odometry_topic=f'{server.namespace}/robot/odometry')
        self.assertEqual({row['scans_used'] for row in rows.values()}, {4})
        self.assertEqual(len(calls), 2)
        stamps = [scan.header.stamp.to_nsec() for scan in robot.scans]
        self.assertEqual(stamps, sorted(set(stamps)))
        self.assertEqual({b - a for a, b in zip(stamps[:4], stamps[1:4])}, {50000000})
        for scan in robot.scans:
            self.assertEqual([field.name for field in scan.fields], ['x', 'y', 'z', 'intensity'])
            self.assertEqual(scan.header.frame_id, 'sensor')
        self.assertAlmostEqual(robot.initial.pose.covariance[0], 0.25)
        self.assertEqual(robot.initial.pose.covariance[14], 0.0)
        wait_until(lambda: imus and odometry, 'IMU and odometry come')
        self.assertTrue(all(imu.linear_acceleration.z == 9.80665 for imu in imus))
        self.assertTrue(all(odom.pose.pose.position.x == 0 for odom in odometry))
        with open(map_file) as file:
            self.assertIn('DATA ascii', file.read())

    def test_a_global_problem_has_no_initial_pose_but_a_call_that_is_made_until_it_succeeds(self):
        server = self.localization(kind='global')
        robot = self.answering(server)
        believed = PoseWithCovarianceStamped()
        believed.pose.pose.orientation.w = 1.0
        calls = []

        def localize_globally(_):
            calls.append(len(robot.scans))
            robot.initial = believed
            return len(calls) > 1, 'the first one is in vain'

        service = rospy.Service(f'{server.namespace}/localize', Trigger, localize_globally)
        self.addCleanup(service.shutdown)
        rows = self.scores(server, send_initialpose=False, before_problem=f'{server.namespace}/localize')
        self.assertIs(robot.initial, believed)
        self.assertEqual(len(calls), len(rows) + 1)
        self.assertEqual(calls[:2], [0, 0])
        self.assertEqual(len(set(calls)), len(rows))

    def test_a_silent_node_times_out_with_the_reason(self):
        server = self.localization(time_limit=1.0, sequences='kitchen', subset=1)
        self.robot(server, lambda stamp, T: None)
        rows = self.rows_of_bridge(server, self.bridge(server, answer_limit=0.2))
        for row in rows.values():
            self.assertEqual(row['outcome'], 'timed_out')
            self.assertRegex(row['reason'], r'the node said nothing to \d+ scans')
            self.assertEqual(row['error'], row['initial_misalignment'])

    def test_answers_of_an_unknown_type_time_out_with_the_reason(self):
        server = self.localization(time_limit=1.0, sequences='kitchen', subset=1)
        publisher = self.publisher(f'{server.namespace}/robot/pose', String)
        self.robot(server, lambda stamp, T: publisher.publish('here'))
        row, = self.rows_of_bridge(server, self.bridge(server, settle='first', answer_limit=0.2)).values()
        self.assertEqual(row['outcome'], 'timed_out')
        self.assertRegex(row['reason'], f'{server.namespace}/robot/pose: found messages of type std_msgs/String, expected')

    def test_a_node_that_only_echoes_times_out_with_the_reason(self):
        server = self.localization(time_limit=1.0, sequences='kitchen', subset=1)
        publisher = self.publisher(f'{server.namespace}/robot/pose', PoseStamped)
        answered = []

        def once(stamp, T):
            if not answered:
                answered.append(publisher.publish(make_answer(PoseStamped, stamp, T)))

        self.robot(server, once)
        row, = self.rows_of_bridge(server, self.bridge(server, settle='first', answer_limit=0.2)).values()
        self.assertEqual(row['outcome'], 'timed_out')
        self.assertIn('nothing but the initial pose', row['reason'])

    def spectator(self, server):
        """Somebody who takes the scans and nothing else."""
        scan = f'{server.namespace}/robot/scan'
        relay = Child([executable('topic_tools', 'relay'), scan, f'{scan}_elsewhere', '__name:=spectator'],
                      server.namespace)
        self.start(relay)
        wait_until(lambda: [scan, [f'{server.namespace}/spectator']] in rosgraph.Master('/test').getSystemState()[1],
                   'the spectator has subscribed')
        return relay

    def rows_with_a_spectator_who_leaves(self, server, **parameters):
        """It does so at the first scan, and the robot answers some scans later."""
        spectator = self.spectator(server)
        publisher = self.publisher(f'{server.namespace}/robot/pose', PoseStamped)

        def publish(stamp, T):
            if not spectator.ended():
                spectator.kill()
            if len(robot.scans) > 5:
                publisher.publish(make_answer(PoseStamped, stamp, T))

        robot = self.robot(server, publish, MOTION)
        robot.initial = PoseWithCovarianceStamped()
        robot.initial.pose.pose.orientation.w = 1.0
        rows = self.scores(server, answer_limit=0.2, **parameters)
        self.assertTrue(spectator.ended())
        robot.close()
        return rows

    def test_who_takes_scans_but_no_initial_pose_beside_one_that_takes_both_may_leave(self):
        self.rows_with_a_spectator_who_leaves(self.localization(sequences='kitchen', subset=1))

    def test_who_is_called_an_observer_may_leave_a_node_that_takes_no_initial_pose(self):
        server = self.localization(sequences='kitchen', subset=1)
        self.rows_with_a_spectator_who_leaves(server, send_initialpose=False, observers='rviz spec',
                                              initialpose_topic=f'{server.namespace}/unused')

    def test_a_node_may_take_longer_than_its_limit_where_nobody_can_restart_it(self):
        server = self.localization(sequences='kitchen', subset=1)
        bridge = self.bridge(server, settle='first', start_limit=0.5)
        bridge.wait_for_output(r'there was none within 0.5 s \(~start_limit\)')
        self.answering(server)
        self.assert_motion_is_scored(self.rows_of_bridge(server, bridge))

    def test_it_refuses_a_map_file_that_another_bridge_writes(self):
        first, second = self.localization(), self.localization(run='second')
        bridge = self.bridge(first, map_file=self.path('map.pcd'))
        bridge.wait_for_output('waiting for a node')
        self.assert_fails(self.bridge(second, map_file=self.path('map.pcd')),
                          f'~map_file: found `.*/map.pcd` in use by process {bridge.process.pid} on')

    def test_it_refuses_rivals_and_names_them(self):
        server = self.localization()
        self.publisher(f'{server.namespace}/robot/map', PointCloud2, latch=True)
        self.assert_fails(self.bridge(server), 'another node does what the bridge does',
                          f'{rospy.get_name()} publishes {server.namespace}/robot/map')

    def test_it_refuses_a_rival_of_the_initial_pose_at_the_start(self):
        server = self.localization()
        self.publisher(f'{server.namespace}/robot/initialpose', PoseWithCovarianceStamped)
        self.assert_fails(self.bridge(server), f'{rospy.get_name()} publishes {server.namespace}/robot/initialpose')

    def test_rviz_may_advertise_the_initial_pose_and_during_the_run_anybody(self):
        server = self.localization(subset=3)
        topic = f'{server.namespace}/robot/initialpose'
        rviz = self.start(Child([sys.executable, '-c', f"""
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
rospy.init_node('rviz', anonymous=True)
rospy.Publisher('{topic}', PoseWithCovarianceStamped, queue_size=1)
print('advertised', flush=True)
rospy.spin()
"""]))
        rviz.wait_for_output('advertised')

        def answer(kind, stamp, T):
            self.publisher(topic, PoseWithCovarianceStamped)
            return make_answer(kind, stamp, T)

        self.answering(server, answer=answer)
        bridge = self.bridge(server, settle='first')
        self.assert_motion_is_scored(self.rows_of_bridge(server, bridge))
        self.assertEqual(bridge.output().count('advertises'), 1, bridge.output())
        self.assertIn(f'{rospy.get_name()} advertises {topic}', bridge.output())

    def test_it_refuses_a_rival_on_tf_and_names_the_switch_for_a_node_that_publishes_its_body(self):
        server = self.localization(subset=3)
        broadcaster = tf2_ros.TransformBroadcaster()

        def answer(kind, stamp, T):
            broadcaster.sendTransform(link('map', 'base_link', T, stamp))
            return make_answer(kind, stamp, T)

        self.answering(server, answer=answer)
        self.assert_fails(self.bridge(server, settle='first'),
                          f'{rospy.get_name()} publishes the tf frame base_link; or set ~tf_odom_base:=none')
        self.assert_motion_is_scored(self.scores(server, tf_odom_base='none'))

    def test_it_lists_its_mistakes(self):
        server = self.localization()
        bridge = self.bridge(server, settle='soon', scan_period=0.001, map_file='/nowhere/map.pcd', colour='red')
        self.assert_fails(bridge, '4 mistakes', '~settle: found `soon`', '~scan_period: found',
                          '/nowhere', '~colour')


if __name__ == '__main__':
    rospy.init_node('bridge_behaviour_test')
    rostest.rosrun('pcrb_launch', 'bridge_behaviour', BridgeBehaviourTest)
