#!/usr/bin/env python3
"""What benchmark_server makes of replies that are wrong, late, many, or in another frame."""
import math
import os
import re
import sys
import threading
import time

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import Pose, PoseStamped, TransformStamped
from pcrb_msgs.srv import SubmitPoseRequest as Request
from pcrb_msgs.srv import SubmitPoseResponse as Code
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, TestCase, executable, wait_until


def pose(x=0.0, w=1.0):
    message = Pose()
    message.position.x, message.orientation.w = x, w
    return message


def stamped(frame, T=np.eye(4), stamp=rospy.Time()):
    message = PoseStamped(pose=maths.fill_pose(Pose(), T))
    message.header.frame_id, message.header.stamp = frame, stamp
    return message


def transform_message(parent, child, stamp, T):
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id, message.header.stamp = parent, stamp
    placed = maths.fill_pose(Pose(), T)
    for axis in 'xyz':
        setattr(message.transform.translation, axis, getattr(placed.position, axis))
    message.transform.rotation = placed.orientation
    return message


class RepliesTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=300)
        # Six local problems near the origin.
        self.problems = self.data.of('local', 'kitchen')

    def kitchen(self, **parameters):
        server = self.server(self.data, sequences='kitchen', **parameters)
        return server, self.client(server)

    def perfect_reply(self, client, problem):
        """P^-1, found by what the cloud and the handed out one have in common."""
        handed_out = maths.points_of(client.newest['source'])
        fits = []
        for candidate in self.problems:
            points = self.data.source_points(candidate)
            if len(points) == len(handed_out):
                P = self.data.local_P(candidate)
                fits.append((np.abs(maths.moved(P, points) - handed_out).max(), P))
        distance, P = min(fits, key=lambda fit: fit[0])
        self.assertLess(distance, 1e-4)
        return np.linalg.inv(P)

    def assert_code(self, response, code, message=''):
        self.assertEqual((response.code, response.accepted), (code, code == Code.OK), response.message)
        self.assertIn(message, response.message)

    def accepted(self, client, problem, pose):
        """The response to a reply whose frame is on its way: the server waits up to 0.5 s for it, which a busy machine exceeds."""
        def response():
            answer = client.submit(problem, pose)
            return answer if answer.code != Code.NO_TRANSFORM else None
        return wait_until(response, 'the server knows the frame')

    def test_each_wrong_reply_has_its_code_and_ends_nothing(self):
        server, client = self.kitchen(time_limit=60.0)
        first = client.next_problem()
        self.assert_code(client.submit(first), Code.NOT_RUNNING, 'call `ready` first')
        client.take_source(first)
        self.assertFalse(client.ready(first).accepted)
        unknown = Request(problem_id='123', pose=stamped('map'))
        self.assert_code(client._submit(unknown), Code.UNKNOWN_PROBLEM, "'123'")
        wrong = [
            ({'pose': pose(x=math.nan)}, Code.NOT_FINITE, 'NaN'),
            ({'pose': pose(x=math.inf)}, Code.NOT_FINITE, 'infinite'),
            ({'pose': pose(x=1e308)}, Code.NOT_FINITE, 'huge'),
            ({'has_covariance': True, 'covariance': [math.nan] * 36}, Code.NOT_FINITE, 'NaN'),
            ({'solver_time': -1.0}, Code.NOT_FINITE, 'solver_time'),
            ({'solver_time': math.inf}, Code.NOT_FINITE, 'solver_time'),
            ({'status': 7}, Code.NOT_FINITE, 'status 7'),
            ({'pose': pose(w=1.0011)}, Code.NOT_UNIT_QUATERNION, 'norm 1.0011'),
            ({'pose': pose(w=0.0)}, Code.NOT_UNIT_QUATERNION, 'norm 0'),
            ({'pose': stamped('nowhere')}, Code.NO_TRANSFORM, "'nowhere'")]
        for fields, code, message in wrong:
            self.assert_code(client.submit(first, **fields), code, message)
        self.assert_code(client.submit(first, pose(w=1.0009)), Code.OK)
        self.assert_code(client.submit(first), Code.DUPLICATE, 'answered already')
        self.assertEqual(client.result_of(first).outcome, client.result_of(first).REPLIED)
        client.next_problem()
        self.assert_code(client.submit(first), Code.DUPLICATE, 'answered already')
        # Not the one before `ready`, which came from nobody's client, nor the one to another problem, nor the duplicates.
        self.assertEqual(server.rows()[0]['replies_rejected'], len(wrong))

    def test_a_transform_that_is_not_finite_connects_nothing_and_ends_nothing(self):
        server, client = self.kitchen()
        static = rospy.Publisher('/tf_static', TFMessage, queue_size=10, latch=True)
        wait_until(static.get_num_connections, 'the server listens to tf')
        static.publish([transform_message('map', frame, rospy.Time(), maths.transform(np.eye(3), [x, 0, 0]))
                        for frame, x in (('near', 1), ('far', math.inf))])

        def answer(client, problem):
            """Once `near` is known to the server, so is `far`."""
            if problem.index > 0:
                self.assert_code(client.submit(problem, stamped('far')), Code.NO_TRANSFORM, "'far'")
            wait_until(lambda: client.submit(problem, stamped('near')).accepted, 'the server knows the frame')

        client.serve(server, answer)
        self.assert_ends_well(server)
        self.assertEqual([(row['outcome'], row['replies_rejected']) for row in server.rows()][1:], [('replied', 1)] * 5)

    def test_a_problem_without_a_valid_reply_is_scored_with_the_guess_and_counted_apart(self):
        server, client = self.kitchen(time_limit=10.0)  # which a reply takes on no machine

        def answer(client, problem):
            if problem.index == 0:
                result = client.result_of(problem)
                self.assert_code(client.submit(problem), Code.LATE, 'has ended')
                self.assertEqual(result.outcome, result.TIMED_OUT)
            elif problem.index == 1:
                client.submit(problem, pose(x=math.nan))
            elif problem.index == 2:
                client.submit(problem, status=Request.FAILED, reason='no features')
            elif problem.index == 3:
                client.submit(problem, status=Request.TIMED_OUT, reason='gave up')
            else:
                client.submit(problem)

        client.serve(server, answer)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.problems)
        table = server.rows()
        self.assertEqual([row['outcome'] for row in table],
                         ['timed_out', 'rejected', 'failed', 'timed_out', 'replied', 'replied'])
        for row, reason in zip(table, ['no reply', 'NaN', 'no features', 'gave up']):
            self.assertIn(reason, row['reason'])
            self.assertEqual(row['error'], row['initial_misalignment'])
            self.assertIsNone(row['x'])
        self.assertEqual([row['runtime_s'] is None for row in table], [True] * 2 + [False] * 4)

    def test_finite_but_absurd_replies_do_not_end_the_run(self):
        server, client = self.kitchen()
        reasons = ['two\nlines, "quoted"', 'NUL \0 inside', 'long ' * 100000]

        def answer(client, problem):
            reason = reasons[problem.index % len(reasons)]
            x = [1e3, 1e50, 1e100][problem.index % 3]
            self.assert_code(client.submit(problem, pose(x), reason=reason, scans_used=2**32 - 1), Code.OK)

        client.serve(server, answer)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.problems)

    def test_a_flood_of_wrong_replies_changes_nothing(self):
        server, client = self.kitchen(time_limit=60.0)
        flood = self.start(Child([executable('pcrb_server', 'flooding_client')], server.namespace))
        flood.wait_for_output('flooding')

        def answer_in_the_flood(client, problem):
            flood.wait_for_output(rf'\b{200 * (problem.index + 1)} so far')
            client.submit(problem, maths.fill_pose(Pose(), self.perfect_reply(client, problem)))

        client.serve(server, answer_in_the_flood)
        self.assert_ends_well(server)
        self.assert_ends_well(flood)
        rejected, accepted = map(int, re.search(r'(\d+) rejected, (\d+) accepted', flood.output()).groups())
        self.assertGreaterEqual(rejected, 200 * len(self.problems))
        self.assertEqual(accepted, 0)
        self.assert_rows_of(server.run, self.problems)
        for row in server.rows():
            self.assertEqual(row['outcome'], 'replied')
            self.assertLess(row['error'], 1e-5)

    def test_a_reply_may_be_in_any_frame_that_tf_connects(self):
        server, client = self.kitchen(time_limit=60.0)
        static = rospy.Publisher('/tf_static', TFMessage, queue_size=10, latch=True)
        moving = rospy.Publisher('/tf', TFMessage, queue_size=10)
        wait_until(lambda: static.get_num_connections() and moving.get_num_connections(), 'the server listens to tf')
        T_map_odom = maths.transform(maths.axis_angle([1, 2, 3], 0.7), [10, -4, 2])
        in_odom = lambda T: np.linalg.inv(T_map_odom) @ T

        def in_a_static_frame(problem, T_map_source):
            static.publish([transform_message('map', 'odom', rospy.Time(), T_map_odom)])
            return self.accepted(client, problem, stamped('odom', in_odom(T_map_source)))

        def in_a_frame_that_moves(problem, T_map_source):
            """Asks for the problem's stamp, half-way between the two that are known."""
            ahead, behind = T_map_odom.copy(), T_map_odom.copy()
            ahead[:3, 3] += [1, 1, 1]
            behind[:3, 3] -= [1, 1, 1]
            second, frame = rospy.Duration(1), f'robot_{problem.index}'
            moving.publish([transform_message('map', frame, problem.header.stamp - second, behind),
                            transform_message('map', frame, problem.header.stamp + second, ahead)])
            return self.accepted(client, problem, stamped(f'/{frame}', in_odom(T_map_source)))

        def in_a_frame_that_comes_late(problem, T_map_source):
            """The server waits up to 0.5 s for it; a busy machine may need a second try."""
            for n in range(10):
                frame = f'late_{problem.index}_{n}'
                timer = threading.Timer(0.1, static.publish, [
                    [transform_message('map', frame, rospy.Time(), T_map_odom)]])
                start = time.monotonic()
                timer.start()
                response = client.submit(problem, stamped(frame, in_odom(T_map_source)))
                self.assertGreaterEqual(time.monotonic() - start, 0.1)
                timer.join()
                if response.accepted:
                    break
            return response

        ways = [in_a_static_frame, in_a_frame_that_moves, in_a_frame_that_comes_late]
        client.serve(server, lambda client, problem: self.assert_code(
            ways[problem.index % 3](problem, self.perfect_reply(client, problem)), Code.OK))
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.problems)
        for row in server.rows():
            self.assertLess(row['error'], 1e-5)


if __name__ == '__main__':
    rospy.init_node('replies_test')
    rostest.rosrun('pcrb_launch', 'replies', RepliesTest)
