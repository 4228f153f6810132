#!/usr/bin/env python3
"""What replay publishes of a sequence, of its problems and of a run: every cloud where it belongs."""
import os
import subprocess
import sys

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Path
from pcrb_msgs.msg import Problem
from sensor_msgs.msg import PointCloud2
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, Launch, TestCase, executable, rows, wait_until

TOPICS = {
    'map': PointCloud2, 'scan': PointCloud2, 'sensor': PoseStamped, 'path': Path, 'target': PointCloud2,
    'source': PointCloud2, 'source_true': PointCloud2, 'source_aligned': PointCloud2, 'problem': Problem,
    'initialpose': PoseWithCovarianceStamped, 'markers': MarkerArray}
FLOAT32 = 2e-5  # m, of coordinates up to 100 m


class Viewer:
    """Keeps every message of every topic by its stamp."""

    def __init__(self, namespace):
        self.messages = {topic: {} for topic in TOPICS}
        self.transforms = {}
        self._namespace = namespace
        self._subscribers = {topic: self._subscribe(topic) for topic in TOPICS}
        self._transform_subscribers = [
            rospy.Subscriber(name, TFMessage, self._take_tf) for name in ('/tf', '/tf_static')]

    def _subscribe(self, topic):
        return rospy.Subscriber(f'{self._namespace}/{topic}', TOPICS[topic], self._take, topic)

    def wait_for_more(self, topic, count):
        """A message beyond the first `count`. All topics are latched: when none comes, the connection is made anew,
        because a master does not repeat the news of a publisher that a busy node missed."""
        def has_come():
            return len(self.messages[topic]) > count
        try:
            wait_until(has_come, f'{topic} comes', limit=20)
        except AssertionError:
            self._subscribers[topic].unregister()
            self._subscribers[topic] = self._subscribe(topic)
            wait_until(has_come, f'{topic} comes over a new connection')

    def _take(self, message, topic):
        header = message.markers[0].header if topic == 'markers' else message.header
        self.messages[topic][header.stamp] = message

    def _take_tf(self, message):
        for transform in message.transforms:
            self.transforms[transform.header.frame_id, transform.child_frame_id] = transform.transform

    def of(self, topic):
        """In the order of their stamps."""
        return [message for _, message in sorted(self.messages[topic].items())]

    def wait_for_transform(self, parent, child, translation):
        def has_come():
            newest = self.transforms.get((parent, child))
            found = newest and [newest.translation.x, newest.translation.y, newest.translation.z]
            return found and np.allclose(found, translation, rtol=0, atol=1e-9)
        wait_until(has_come, f'{child} is at {translation} in {parent}')

    def close(self):
        for subscriber in [*self._subscribers.values(), *self._transform_subscribers]:
            subscriber.unregister()


class ReplayTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'))
        self.viewer = Viewer('/replayed')
        self.addCleanup(self.viewer.close)

    def replay(self, **parameters):
        """Paused before the first scene."""
        name = '/replayed/replay'
        if rospy.has_param(name):
            rospy.delete_param(name)
        rospy.set_param(name, {'autostart': False, 'rate': 100, **parameters})
        self.player = self.start(Child([executable('pcrb_server', 'replay')], '/replayed'))
        self.addCleanup(self.player.wait)
        self.addCleanup(self.player.interrupt)
        return self.player

    def call(self, service):
        rospy.wait_for_service(f'/replayed/replay/{service}', 60)
        self.assertTrue(rospy.ServiceProxy(f'/replayed/replay/{service}', Trigger)().success)

    def step(self, *topics):
        """The next scene: its messages of some topics."""
        before = {topic: len(self.viewer.messages[topic]) for topic in topics}
        self.call('step')
        for topic in topics:
            try:
                self.viewer.wait_for_more(topic, before[topic])
            except AssertionError as error:
                self.fail(f'{error}; replay printed:\n{self.player.output()}')
        return [self.viewer.of(topic)[-1] for topic in topics]

    def assert_points(self, message, expected):
        self.assertEqual(message.header.frame_id, 'map')
        np.testing.assert_allclose(maths.points_of(message), expected, atol=FLOAT32)

    def assert_pose(self, pose, expected, tolerance=1e-9):
        np.testing.assert_allclose(maths.from_pose(pose), expected, atol=tolerance)

    def hall(self):
        names = maths.SEQUENCES['hall']
        origin = maths.local_origin(self.data.clouds['hall', names[0]])
        poses = [maths.transform(np.eye(3), -origin) @ self.data.viewpoints['hall', name] for name in names]
        return [self.data.clouds['hall', name] - origin for name in names], poses, origin

    def test_a_sequence_shows_scans_sensor_path_and_a_growing_map(self):
        scans, poses, origin = self.hall()
        self.replay(root=self.data.root, sequence='hall', map_leaf=0.1, keep_alive=True)
        sizes = []
        for i, (points, pose) in enumerate(zip(scans, poses)):
            scan, sensor, path, grown = self.step('scan', 'sensor', 'path', 'map')
            self.assert_points(scan, points)
            self.assert_pose(sensor.pose, pose)
            self.assertEqual(len(path.poses), i + 1)
            self.assert_pose(path.poses[0].pose, poses[0])
            sizes.append(grown.width)
            self.assertLess(np.abs(maths.points_of(grown)).max(), 100)
        self.assertEqual(sizes, sorted(set(sizes)))
        self.viewer.wait_for_transform('earth', 'map', origin)
        self.viewer.wait_for_transform('map', 'pcrb_sensor', poses[-1][:3, 3])

    def test_the_growing_map_keeps_its_limit(self):
        self.replay(root=self.data.root, sequence='rooms/kitchen', map_leaf=0.05, map_points=700, keep_alive=True)
        for _ in range(3):
            grown, = self.step('map')
            self.assertLessEqual(grown.width, 700)
            self.assertGreater(grown.width, 50)

    def test_a_player_gives_a_node_scans_in_their_sensors_frame_and_nothing_else(self):
        scans, poses, _ = self.hall()
        stamps = self.path('scans.txt')
        replay = self.replay(root=self.data.root, sequence='hall', truth=False, map_file=maths.SEQUENCES['hall'][1],
                             stamps_file=stamps, map_settle=0.2, keep_alive=True)
        for i in (0, 2):
            scan, = self.step('scan')
            for topic in 'map', 'initialpose':  # sent before the first scan, as their stamps say below
                self.viewer.wait_for_more(topic, 0)
            wait_until(lambda: ('base_link', 'pcrb_scan') in self.viewer.transforms, 'the mounting comes')
            self.assertEqual(scan.header.frame_id, 'pcrb_scan')
            np.testing.assert_allclose(maths.moved(poses[i], maths.points_of(scan)), scans[i], atol=FLOAT32)
        replay.wait_for_output('at the end')
        replay.interrupt()
        self.assert_ends_well(replay)
        self.assertEqual(len(self.viewer.of('initialpose')), 1)
        initial, first_map, first_scan = (self.viewer.of(topic)[0] for topic in ('initialpose', 'map', 'scan'))
        self.assert_pose(initial.pose.pose, poses[0])
        self.assertEqual([initial.pose.covariance[i] for i in (0, 7, 14, 35)], [0.25, 0.25, 0.0, 0.26 ** 2])
        self.assert_points(first_map, scans[1])
        self.assertEqual((initial.header.stamp - first_map.header.stamp).to_sec(), 0.2)
        self.assertEqual((first_scan.header.stamp - initial.header.stamp).to_sec(), 0.1)
        self.assertEqual({'intensity'} & {field.name for field in first_scan.fields}, {'intensity'})
        for topic in 'sensor', 'path', 'markers':
            self.assertEqual(self.viewer.of(topic), [])
        self.assertNotIn(('map', 'pcrb_sensor'), self.viewer.transforms)
        with open(stamps) as file:
            listed = [line.split() for line in file if not line.startswith('#')]
        self.assertEqual([name for _, name in listed], [maths.SEQUENCES['hall'][i] for i in (0, 2)])
        self.assertEqual([stamp for stamp, _ in listed],
                         [f'{s.header.stamp.secs}.{s.header.stamp.nsecs:09}' for s in self.viewer.of('scan')])

    def test_a_player_needs_viewpoints(self):
        self.assert_fails(self.replay(root=self.data.root, sequence='kitchen', truth=False), 'found no VIEWPOINT')

    def test_problems_show_the_source_as_perturbed_and_where_it_belongs(self):
        self.replay(root=self.data.root, sequence='hall', problems='local', keep_alive=True)
        for problem in self.data.of('local', 'hall'):
            announced, source, truth, markers = self.step('problem', 'source', 'source_true', 'markers')
            points = self.data.source_points(problem)
            self.assertEqual(announced.problem_id, problem.id)
            self.assert_points(source, maths.moved(self.data.local_P(problem), points))
            self.assert_points(truth, points)
            self.assertIn('overlap 0.75', markers.markers[0].text)
            target = wait_until(lambda: self.viewer.messages['target'].get(announced.target_stamp), 'its target comes')
            self.assert_points(target, self.data.clouds['hall', problem.target] - self.data.origin(problem))

    def run_of_guesses(self, presentation, **parameters):
        """The results of a run whose client moves the guess a bit."""
        server = self.server(self.data, presentation=presentation, **parameters)

        def answer(client, problem):
            pose = maths.from_pose(problem.initial_guess)
            pose[:3, 3] += [0.3, -0.2, 0.1]
            client.submit(problem, maths.fill_pose(problem.initial_guess, pose))

        self.client(server).serve(server, answer)
        self.assert_ends_well(server)
        return {row['problem_id']: row for row in rows(server.run)}

    def assert_run_is_shown(self, results):
        self.replay(run=self.path('run'), order='worst', keep_alive=True)
        for row in sorted(results.values(), key=lambda row: -row['error']):
            source, aligned, markers = self.step('source', 'source_aligned', 'markers')
            shown = float(markers.markers[0].text.split()[1])
            self.assertAlmostEqual(shown, row['error'], delta=0.006 * row['error'])
            problem = self.data.by_id(row['problem_id'])
            points = self.data.source_points(problem)
            self.assert_points(source, maths.moved(self.data.local_P(problem), points))
            self.assertAlmostEqual(
                maths.error(points, maths.rigid_fit(points, maths.points_of(aligned))), row['error'], delta=1e-4)

    def test_a_run_of_registration_is_shown_worst_first(self):
        self.assert_run_is_shown(self.run_of_guesses('registration'))

    def test_a_run_of_localization_is_shown_in_the_maps_frame(self):
        self.assert_run_is_shown(self.run_of_guesses('localization'))

    def test_an_audited_run_is_shown_as_one_without(self):
        self.assert_run_is_shown(self.run_of_guesses('registration', audit=True))

    def test_merged_shards_are_shown_though_each_put_its_scans_elsewhere(self):
        shards = [self.path(f'shard_{i}') for i in range(2)]
        results = {}
        for i, run in enumerate(shards):
            results.update(self.run_of_guesses('localization', audit=True, run=run, shard=f'{i}/2'))
        subprocess.run([executable('pcrb_tools', 'merge_runs'), *shards, '-o', self.path('run')], check=True)
        self.assert_run_is_shown(results)

    def test_changed_data_are_no_run(self):
        self.run_of_guesses('registration')
        self.data.problems.reverse()
        self.data.write_problems('hall', 'local')
        self.assert_fails(self.replay(run=self.path('run')), 'hall_local.txt has changed since the run used it')

    def test_plays_pauses_steps_and_loops(self):
        replay = self.replay(root=self.data.root, sequence='kitchen', loop=True, rate=1)  # it pauses between two scenes, not while it reads one
        self.step('scan')
        self.step('scan')
        self.assertEqual(len(self.viewer.of('scan')), 2)
        self.call('start')
        replay.wait_for_output(r'3/3(.*\n)+.*3/3')
        self.call('pause')
        wait_until(lambda: len(self.viewer.of('scan')) == replay.output().count('/3 kitchen'), 'all scenes are seen')
        before = len(self.viewer.of('scan'))
        self.step('scan')
        self.assertEqual(len(self.viewer.of('scan')), before + 1)
        replay.interrupt()
        self.assert_ends_well(replay)

    def test_shows_the_problems_that_are_asked_for_and_steps_back(self):
        first, second = (problem.id for problem in self.data.of('local', 'hall')[:2])
        self.replay(root=self.data.root, sequence='hall', problems='local', problem=f'{second} {first}', loop=True)  # it would end behind the last one
        shown = [self.step('problem')[0].problem_id for _ in range(2)]
        self.assertEqual(set(shown), {first, second})
        for expected in reversed(shown):
            before = len(self.viewer.messages['problem'])
            self.call('back')
            wait_until(lambda: len(self.viewer.messages['problem']) > before, 'the scene before comes')
            self.assertEqual(self.viewer.of('problem')[-1].problem_id, shown[shown.index(expected) - 1])

    def test_one_problem_of_a_run_is_shown_with_the_truth(self):
        row = max(self.run_of_guesses('registration').values(), key=lambda row: row['error'])
        self.replay(run=self.path('run'), problems=row['kind'], sequences=f"{row['data_set']}/{row['sequence']}",
                    problem=row['problem_id'], loop=True)  # it would end behind the only one
        truth, markers = self.step('source_true', 'markers')
        self.assert_points(truth, self.data.source_points(self.data.by_id(row['problem_id'])))
        self.assertEqual(float(markers.markers[0].text.split()[1]), float(f"{row['error']:.3g}"))

    def test_stays_for_who_comes_late(self):
        replay = self.replay(root=self.data.root, sequence='hall', autostart=True, keep_alive=True)
        replay.wait_for_output('at the end')
        for topic in 'map', 'scan', 'sensor', 'path':
            late = rospy.wait_for_message(f'/replayed/{topic}', TOPICS[topic], 60)
            self.assertEqual(late.header.frame_id, 'map')
        self.call('step')
        replay.wait_for_output('at the end(.*\n)+1/3')

    def test_the_launch_file_shows_sequences_problems_and_runs(self):
        self.run_of_guesses('registration')
        sequence = {'root': self.data.root, 'sequence': 'rooms/kitchen'}
        for arguments in sequence, {**sequence, 'problems': 'global'}, {'run': self.path('run'), 'order': 'best'}:
            launch = self.start(Launch('replay.launch', rviz='false', rate=100, **arguments))
            launch.wait()
            self.assertRegex(launch.output(), r'(?m)^(\d+)/\1 ')

    def test_says_every_mistake(self):
        self.assert_fails(self.replay(root=self.data.root, sequence='hal', rate=0, colour='red'),
                          '3 mistakes', 'found `hal`', '~rate', '~colour: no parameter')
        self.assert_fails(self.replay(root=self.data.root), '~sequence or ~run')
        self.assert_fails(self.replay(run=self.path('nothing')), 'nothing')
        self.assert_fails(self.replay(root=self.data.root, sequence='hall', problems='local', problem='x7'), 'no problem x7')


if __name__ == '__main__':
    rospy.init_node('replay_test')
    rostest.rosrun('pcrb_launch', 'replay', ReplayTest)
