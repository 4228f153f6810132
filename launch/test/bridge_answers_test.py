#!/usr/bin/env python3
"""localization_bridge: types and frames of answers, slow nodes, the sensor's mounting, silence."""
import os
import sys
import time

import numpy as np
import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
from std_msgs.msg import String

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing_bridge import MOTION, AnsweringTestCase, SlowRobot, link, make_answer

DRIFT = maths.transform(maths.axis_angle([0, 0, 1], 1.0), [3.0, 2.0, 0.0])
MOUNTING = maths.transform(maths.axis_angle([0, 0, 1], np.pi) @ maths.axis_angle([0, 1, 0], np.radians(10)),
                           [1.0, 0.0, 1.9])  # T_base_sensor

IMPATIENT = {'answer_limit': 0.2, 'deadline_fraction': 0.1}  # gives up after 6 s of the server's 60


def moved_covariance(covariance, arm):
    """Of x y z rx ry rz of a point that a turn moves since it lies away by `arm`."""
    x, y, z = arm
    J = np.eye(6)
    J[:3, 3:] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]
    return J @ covariance @ J.T


class BridgeAnswersTest(AnsweringTestCase):

    def test_answers_of_four_types(self):
        for kind in PoseStamped, PoseWithCovarianceStamped, Odometry, TransformStamped:
            server = self.localization(run=kind.__name__, subset=3)
            robot = self.answering(server, kind)
            self.assert_motion_is_scored(self.scores(server, map_settle=0.0))
            robot.close()

    def test_a_scan_that_a_slow_node_still_has_is_finished_before_the_next_problem(self):
        """It is slower than answer_limit, so that it has one more scan when its first answer comes."""
        server = self.localization(subset=3)
        self.answering(server, make=SlowRobot, work=3.0)
        self.assert_motion_is_scored(self.scores(server, answer_limit=1.5))

    def test_a_scan_that_a_node_has_at_the_deadline_is_finished_before_the_next_problem(self):
        server = self.localization(subset=3, time_limit=80.0)
        self.answering(server, make=SlowRobot, work=1.0)
        rows = self.scores(server, settle='deadline', deadline_fraction=0.1)
        self.assert_motion_is_scored(rows, times=lambda row: row['scans_used'])

    def test_answers_on_tf_are_composed_through_odom_in_either_order(self):
        broadcaster = tf2_ros.TransformBroadcaster()
        for step in 1, -1:
            server = self.localization(run=f'step{step}', subset=5)

            def publish(stamp, T, step=step):
                """As a filter beside the robot's own odometry does."""
                broadcaster.sendTransform([link('odom', 'base_link', DRIFT, stamp),
                                           link('map', 'odom', T @ np.linalg.inv(DRIFT), stamp)][::step])

            robot = self.robot(server, publish, MOTION)
            self.assert_motion_is_scored(self.scores(server, pose_topic='tf', tf_odom_base='none'))
            robot.close()

    def test_a_robot_that_moves_is_scored_where_it_was_at_the_first_scan(self):
        """Its localizer knows its way from tf; the scans are of the same walls, from where the sensor is by then."""
        server = self.localization(subset=3)
        tf = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(tf)
        self.addCleanup(listener.unregister)
        publisher = self.publisher(f'{server.namespace}/robot/pose', PoseStamped)
        starts, ways = {}, []

        def publish(stamp, T):
            link = tf.lookup_transform('odom', 'base_link', stamp, rospy.Duration(20)).transform
            odometry = maths.transform(np.eye(3), [link.translation.x, link.translation.y, link.translation.z])
            way = np.linalg.inv(starts.setdefault(robot.initial.header.stamp.to_nsec(), odometry)) @ odometry
            ways.append((odometry[0, 3], way[0, 3], maths.moved(way, maths.points_of(robot.scans[-1]))))
            self.say(publisher, make_answer(PoseStamped, stamp, T @ way))

        robot = self.robot(server, publish, MOTION, moves=True)
        self.assert_motion_is_scored(self.scores(server, settle='nth', settle_count=8, speed=0.5,
                                                 initialpose_settle=0.5))
        self.assertGreater(min(way for _, way, _ in ways[7::8]), 0.05)
        for i, (position, _, points) in enumerate(ways):
            np.testing.assert_allclose(points, ways[i // 8 * 8][2], atol=1e-4)
            self.assertGreaterEqual(position, ways[max(0, i - 1)][0])  # odometry goes on from problem to problem

    def test_an_answer_may_come_before_the_transform_that_it_needs(self):
        server = self.localization(subset=5)
        broadcaster = tf2_ros.TransformBroadcaster()
        publisher = self.publisher(f'{server.namespace}/robot/pose', Odometry)

        def publish(stamp, T):
            odometry = make_answer(Odometry, stamp, DRIFT)
            odometry.header.frame_id = 'odom'
            self.say(publisher, odometry)
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

    def test_a_silent_node_times_out_with_the_reason(self):
        server = self.localization(sequences='kitchen', subset=1)
        self.publisher(f'{server.namespace}/robot/pose', PoseStamped)
        self.robot(server, lambda stamp, T: None)
        rows = self.rows_of_bridge(server, self.bridge(server, **IMPATIENT))
        for row in rows.values():
            self.assertEqual(row['outcome'], 'timed_out')
            self.assertRegex(row['reason'], r'the node said nothing to \d+ scans')
            self.assertEqual(row['error'], row['initial_misalignment'])

    def test_answers_of_a_type_that_is_no_pose_are_refused_before_a_problem_counts(self):
        server = self.localization(sequences='kitchen', subset=1)
        self.publisher(f'{server.namespace}/robot/pose', String)
        self.robot(server, lambda stamp, T: None)
        self.assert_fails(self.bridge(server), f'{server.namespace}/robot/pose .*: found messages of type std_msgs/String, expected')
        self.assertEqual(server.rows(), [])

    def test_such_answers_on_a_topic_that_comes_with_the_first_scan_time_out_with_the_reason(self):
        server = self.localization(sequences='kitchen', subset=1)
        publishers = []

        def say(stamp, T):
            if not publishers:
                publishers.append(self.publisher(f'{server.namespace}/robot/pose', String))
            self.say(publishers[0], 'here')

        self.robot(server, say)
        row, = self.rows_of_bridge(server, self.bridge(server, settle='first', **IMPATIENT)).values()
        self.assertEqual(row['outcome'], 'timed_out')
        self.assertRegex(row['reason'], f'{server.namespace}/robot/pose: found messages of type std_msgs/String, expected')

    def test_a_node_that_only_echoes_times_out_with_the_reason(self):
        server = self.localization(sequences='kitchen', subset=1)
        publisher = self.publisher(f'{server.namespace}/robot/pose', PoseStamped)
        answered = []

        def once(stamp, T):
            if not answered:
                answered.append(self.say(publisher, make_answer(PoseStamped, stamp, T)))

        self.robot(server, once)
        row, = self.rows_of_bridge(server, self.bridge(server, settle='first', **IMPATIENT)).values()
        self.assertEqual(row['outcome'], 'timed_out')
        self.assertIn('nothing but the initial pose', row['reason'])


if __name__ == '__main__':
    rospy.init_node('bridge_answers_test')
    rostest.rosrun('pcrb_launch', 'bridge_answers', BridgeAnswersTest)
