#!/usr/bin/env python3
"""Nothing on ROS interfaces gives a problem's answer away; with ~debug, the same detector finds it."""
import math
import os
import sys

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import Pose, PoseStamped
from pcrb_msgs.msg import Summary
from pcrb_msgs.srv import SubmitPoseRequest as Request
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import PointCloud2

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from leak_detector import LeakDetector, Secrets, angles, record, relations
from leak_recorder import Recorder
from pcrb_testing import wait_until
from pcrb_testing_adversaries import same_part
from pcrb_testing_bridge import BridgeTestCase


class LeakTest(BridgeTestCase):

    def setUp(self):
        super().setUp()
        files = {name for _, name in self.data.clouds}
        self.words = [*files, *(name[:-4] for name in files), *(problem.id for problem in self.data.problems)]

    def answer(self, client, problem):
        """A reply of every kind, none of them near the truth; what the server says is recorded, too."""
        recorder = self.recorder
        recorder.moment = problem.index
        recorder.look()
        self.handed_out.append(maths.points_of(client.newest['source']))
        wrong = Pose()
        wrong.position.x = math.nan
        nowhere = PoseStamped()
        nowhere.header.frame_id, nowhere.pose.orientation.w = 'nowhere', 1.0
        first = {0: {'pose': wrong}, 1: {'status': Request.FAILED, 'reason': 'no idea'}, 2: {'pose': nowhere}}
        for fields in first.get(problem.index, {}), {'cpu_time': 0.25, 'peak_memory': 1 << 20}:
            recorder.add('reply', client.submit(problem, **fields))
        recorder.add('ready', client.ready(problem))

    def play(self, **parameters):
        """Runs all problems with everything recorded; returns the leaks that are found."""
        self.handed_out = []
        self.recorder = recorder = Recorder()
        self.addCleanup(recorder.close)
        recorder.look()
        server = self.server(self.data, kind='both', global_guess=True, summary_hold_time=60.0, **parameters)
        client = self.client(server)
        wait_until(client.has_new_problem, 'the first problem is announced')
        recorder.attach(f'{server.namespace}/benchmark_server')
        client.serve(server, self.answer, limit=len(self.data.problems))
        return self.leaks_of(server, parameters['presentation'])

    def leaks_of(self, server, presentation, *others):
        """What is found in the records of a run that has been played, and in other processes of it."""
        recorder = self.recorder
        wait_until(lambda: f'{server.namespace}/summary' in recorder.recorded_topics(), 'the summary comes')
        recorder.look()
        for process in (server, *others):
            recorder.add_process(process)
        server.interrupt()
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.data.problems)
        self.assertEqual(recorder.unreadable, set())
        for topic in 'target', 'source', 'problem', 'initialpose', 'result', 'summary':
            self.assertIn(f'{server.namespace}/{topic}', recorder.recorded_topics())
        self.assertLessEqual({'/tf', '/tf_static', 'parameters', 'graph', 'cmdline'}, recorder.recorded_topics())
        detector = LeakDetector(self.secrets(server, presentation), self.words)
        self.leaks_of_memory = detector.leaks(list(relations(recorder.records)))
        return detector.leaks(recorder.records)

    def take_source(self, message):
        """Each problem has one."""
        self.recorder.moment = len(self.handed_out)
        self.handed_out.append(maths.points_of(message))

    def play_through_bridge(self, **parameters):
        """As play(), with a localization node behind the bridge, which sends all that it can."""
        self.handed_out = []
        self.recorder = recorder = Recorder()
        self.addCleanup(recorder.close)
        server = self.localization(sequences='all', kind='both', global_guess=True, summary_hold_time=60.0, **parameters)
        wait_until(lambda: f'{server.namespace}/source' in dict(rospy.get_published_topics()), 'the server is there')
        sources = rospy.Subscriber(f'{server.namespace}/source', PointCloud2, self.take_source)
        self.addCleanup(sources.unregister)
        publisher = rospy.Publisher(f'{server.namespace}/robot/pose', PoseStamped, queue_size=10)
        self.addCleanup(publisher.unregister)

        def answer(stamp, T):
            reply = PoseStamped()
            reply.header.frame_id, reply.header.stamp = 'map', stamp
            maths.fill_pose(reply.pose, T)
            publisher.publish(reply)

        self.robot(server, answer, maths.transform(maths.axis_angle([0, 0, 1], 0.05), [0.2, -0.1, 0.05]))
        wait_until(sources.get_num_connections, 'sources will be seen')
        recorder.attach(f'{server.namespace}/benchmark_server')
        robot = f'{server.namespace}/robot'
        bridge = self.bridge(server, settle='nth', settle_count=2, map_file=self.path('map.pcd'),
                             tf_odom_base='dynamic', imu_topic=f'{robot}/imu', odometry_topic=f'{robot}/odometry')
        wait_until(lambda: f'{robot}/odometry' in dict(rospy.get_published_topics()), 'the bridge is there')
        recorder.attach(f'{server.namespace}/localization_bridge')
        leaks = self.leaks_of(server, 'localization', bridge)
        self.assert_ends_well(bridge)
        for topic in 'map', 'scan', 'initialpose', 'imu', 'odometry':
            self.assertIn(f'{robot}/{topic}', recorder.recorded_topics())
        return leaks

    def secrets(self, server, presentation):
        """Of each problem, in serving order; V is seen in the clouds, since no interface tells it."""
        secrets = []
        for row, handed_out in zip(server.rows(), self.handed_out):
            problem = self.data.by_id(row['problem_id'])
            P, points = self.data.local_P(problem), self.data.source_points(problem)
            transforms = {'P': P}
            if server.parameters.get('audit'):
                secrets.append(Secrets(self.audited(problem, handed_out, presentation), self.data.origin(problem)))
                continue
            if presentation == 'localization':
                V = transforms['V'] = maths.rigid_fit(handed_out, points)
                viewpoint = self.data.viewpoints[problem.sequence, problem.source].copy()
                if not np.array_equal(viewpoint, np.eye(4)):
                    viewpoint[:3, 3] -= self.data.origin(problem)
                    transforms['viewpoint'] = viewpoint
            applied = np.linalg.inv(V) if presentation == 'localization' else P
            self.assertLess(np.abs(maths.moved(applied, points) - handed_out).max(), 1e-4)
            secrets.append(Secrets(transforms, self.data.origin(problem)))
        return secrets

    def audited(self, problem, handed_out, presentation):
        """What must not be seen of a problem of an audit; its motion is seen in the clouds, with the files' at hand."""
        P, points = self.data.local_P(problem), self.data.source_points(problem)
        kept = same_part(handed_out, points)
        if presentation == 'registration':  # A P; the ideal reply is A (A P)^-1
            return {'P': P, 'ideal': kept @ np.linalg.inv(P) @ np.linalg.inv(kept), 'A': kept @ np.linalg.inv(P)}
        return {'P': P, 'V': np.linalg.inv(kept)}

    def test_clouds_tell_a_client_with_memory_the_truth_unless_the_run_is_an_audit(self):
        self.data = maths.make_data_set(self.path('small'), points=300, perturbations=1)
        for presentation, truth in (('registration', 'P'), ('localization', 'V')):
            self.assertEqual(self.play(presentation=presentation, run=self.path(f'plain {presentation}')), [])
            self.assertRegex('\n'.join(self.leaks_of_memory), rf'(target onto .*source|source onto .*target): 7 numbers spell {truth}\b')
            self.assertEqual(self.play(presentation=presentation, run=self.path(f'audit {presentation}'), audit=True,
                                       results='end'), [])
            self.assertEqual(self.leaks_of_memory, [])

    def test_registration_gives_nothing_away(self):
        self.assertEqual(self.play(presentation='registration'), [])

    def test_localization_gives_nothing_away(self):
        self.assertEqual(self.play(presentation='localization'), [])

    def test_the_bridge_gives_nothing_away(self):
        self.assertEqual(self.play_through_bridge(), [])

    def test_debug_gives_it_away_beside_the_bridge(self):
        leaks = '\n'.join(self.play_through_bridge(debug=True))
        self.assertRegex(leaks, r'debug/truth: 7 numbers spell V of problem 0\b')

    def assert_finds_what_debug_shows(self, presentation, ideal):
        leaks = '\n'.join(self.play(presentation=presentation, debug=True))
        count = len(self.data.problems)
        for k in range(count):
            self.assertRegex(leaks, rf'debug/truth: 7 numbers spell {ideal} of problem {k}\b')
            self.assertRegex(leaks, rf'debug/perturbation: 7 numbers spell P of problem {k}\b')

    def test_debug_gives_it_away_in_registration(self):
        self.assert_finds_what_debug_shows('registration', r'P\^-1')

    def test_debug_gives_it_away_in_localization(self):
        self.assert_finds_what_debug_shows('localization', 'V')

    def detector(self):
        """Of the problems of the data set in their order, registration."""
        return LeakDetector([Secrets({'P': self.data.local_P(problem)}, self.data.origin(problem))
                             for problem in self.data.problems], self.words)

    def test_the_detector_sees_transforms_however_they_are_written(self):
        problem = next(p for p in self.data.problems if p.sequence == 'hall')
        P = self.data.local_P(problem)
        ideal = np.linalg.inv(P)
        pose = maths.fill_pose(Pose(), ideal)
        pose.orientation.w *= -1
        pose.orientation.x *= -1
        pose.orientation.y *= -1
        pose.orientation.z *= -1
        written = [pose, P[:3, :3].T.ravel().tolist(), P[:3].ravel().tolist(), ideal.ravel().tolist(),
                   problem.P[:3, 3].tolist(), list(angles(ideal[:3, :3])[0]), list(angles(P[:3, :3])[1]),
                   Log(msg=f'quaternion {maths.to_quaternion(P)}'), {'P': ' '.join(f'{x:.8f}' for x in P.ravel())}]
        for value in written:
            self.assertTrue(self.detector().leaks([record('here', 0, value)]), value)

    def test_the_detector_sees_single_numbers_and_words(self):
        detector = self.detector()
        x = [self.data.local_P(problem)[0, 3] for problem in self.data.problems]
        self.assertEqual(len(detector.leaks([record('/pcrb/x', k, Summary()) for k in range(3)])), 0)
        self.assertTrue(detector.leaks([record('/pcrb/x', k, [1.0, x[k] + 5e-7]) for k in range(2)]))
        self.assertTrue(detector.leaks([record('/pcrb/x', -1, [0.1, 7, *x])]))
        for word in 'k_0417.pcd', self.data.problems[0].id, 'h_9074':
            self.assertTrue(detector.leaks([record('/pcrb/x', 0, Log(msg=f'loading {word}'))]))
            self.assertTrue(detector.leaks([record('/pcrb/x', 0, [], raw=b'\1' + word.encode())]))

    def test_the_detector_takes_chance_for_chance(self):
        random = np.random.default_rng(3)
        records = [record(f'/topic{i % 5}', i % 18, random.uniform(-1, 1, 20).tolist() + [0, 1, 0.5, 10])
                   for i in range(200)]
        self.assertEqual(self.detector().leaks(records), [])


if __name__ == '__main__':
    rospy.init_node('leak_test')
    rostest.rosrun('pcrb_launch', 'leak', LeakTest)
