#!/usr/bin/env python3
"""Bags of sequences and problems, and the poses that come back: scored as the server would have."""
import csv
import os
import subprocess
import sys
import zlib

import numpy as np
import pcrb
import rosbag
import rospy
import rostest
from geometry_msgs.msg import Pose, PoseStamped
from nav_msgs.msg import Path
from sensor_msgs.msg import PointCloud2

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import TIME_COLUMNS, Child, TestCase, executable, row_key, rows

# Columns that depend on the order in which problems were served.
OTHER_COLUMNS = (*TIME_COLUMNS, 'target_changed')


def scored(row):
    return {name: value for name, value in row.items() if name not in OTHER_COLUMNS}


def tum(label, pose):
    p, q = pose.position, pose.orientation
    return ' '.join([label, *(repr(number) for number in (p.x, p.y, p.z, q.x, q.y, q.z, q.w))]) + '\n'


class OfflineTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'))

    def tool(self, name, *arguments):
        """Runs one of pcrb_tools; its output."""
        done = subprocess.run([executable('pcrb_tools', name), *arguments], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def assert_tool_fails(self, pattern, name, *arguments):
        done = subprocess.run([executable('pcrb_tools', name), *arguments], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True)
        self.assertGreater(done.returncode, 0)
        self.assertRegex(done.stdout, pattern)

    def read(self, name):
        with open(self.path(name)) as file:
            return file.read()

    def online(self, sequence):
        """A run whose client sends poses of all kinds; its rows, and the poses in their order."""
        server = self.server(self.data, sequences=sequence)
        random = np.random.default_rng(3)
        sent = []

        def answer(client, problem):
            pose = problem.initial_guess
            maths.fill_pose(pose, maths.transform(maths.axis_angle(random.normal(size=3), 0.2), random.normal(size=3)))
            pose.orientation.w *= 1.0005  # accepted, and normalised
            if len(sent) == 2:
                pose.position.x = float('nan')
            sent.append(pose)
            response = client.submit(problem, pose)
            if not response.accepted:
                client.submit(problem, status=1)

        self.client(server).serve(server, answer)
        self.assert_ends_well(server)
        return server.rows(), sent

    def test_offline_and_online_scores_are_the_same_bits(self):
        for sequence in 'kitchen', 'hall':
            online, sent = self.online(f'rooms/{sequence}')
            text = ''.join(tum(row['problem_id'], pose) for row, pose in zip(online, sent))
            self.tool('score_poses', self.data.folder(f'{sequence}_local.txt'), '--poses', self.write('poses.txt', text),
                      '--frame', 'map', '--run', self.path('offline', sequence))
            offline = {row_key(row): scored(row) for row in rows(self.path('offline', sequence))}
            self.assertEqual(len(offline), len(online))
            for row, pose in zip(online, sent):
                found = offline[row_key(row)]
                if np.isnan(pose.position.x):
                    self.assertEqual(found['outcome'], 'rejected')
                    self.assertEqual(found['error'], row['initial_misalignment'])
                else:
                    self.assertEqual(found, scored(row))
            os.rename(self.path('run'), self.path(f'run_{sequence}'))

    def test_a_python_function_gets_the_servers_bits_and_its_run_the_same_scores(self):
        """A method that depends on every bit of the clouds, as a node of the server's and as a function without ROS."""
        def align(source, target):
            random = np.random.default_rng(zlib.crc32(source.astype(np.float32).tobytes() + target.astype(np.float32).tobytes()))
            pose = Pose()
            maths.fill_pose(pose, maths.transform(maths.axis_angle(random.normal(size=3), 0.2), random.normal(size=3)))
            return pose

        def answer(client, problem):
            source, target = (maths.points_of(client.newest[topic]) for topic in ('source', 'target'))
            client.submit(problem, align(source, target))

        def function(problem):
            p, q = (lambda pose: (pose.position, pose.orientation))(align(problem.source, problem.target))
            return (p.x, p.y, p.z), (q.x, q.y, q.z, q.w)

        server = self.server(self.data, kind='both')
        self.client(server).serve(server, answer)
        self.assert_ends_well(server)
        results = pcrb.run(function, self.data.root, self.path('function'), kind='both')
        self.assertEqual(len(results['error']), len(server.rows()))
        self.assertEqual({row_key(row): scored(row) for row in rows(self.path('function'))},
                         {row_key(row): scored(row) for row in server.rows()})

    def test_matrices_are_in_the_frame_of_the_clouds_files(self):
        for sequence in 'kitchen', 'hall':
            lines = []
            for problem in self.data.of('local', sequence):
                T = np.linalg.inv(problem.P)
                lines.append(' '.join([problem.id, *(repr(float(n)) for n in T[:3].ravel())]))
            lines[1] = ' '.join([lines[1].split()[0], *['0.5'] * 12])
            run = self.path('run', sequence)
            summary = self.tool('score_poses', self.data.folder(f'{sequence}_local.txt'), '--run', run,
                                '--poses', self.write('matrices.txt', '# id and matrix\n' + '\n'.join(lines[:-1])))
            self.assertRegex(summary, fr'{sequence} +local +6 +4 +0 +1 +1 +0 ')
            for row in rows(run):
                outcome = {lines[1].split()[0]: 'rejected', lines[-1].split()[0]: 'timed_out'}
                self.assertEqual(row['outcome'], outcome.get(row['problem_id'], 'replied'))
                if row['outcome'] == 'replied':
                    self.assertLess(row['error'], 1e-8)
                else:
                    self.assertEqual(row['error'], row['initial_misalignment'])
            self.assertTrue(os.path.exists(os.path.join(run, 'results.csv')))

    def test_problems_that_are_given_away_keep_their_truth(self):
        for presentation in 'registration', 'localization':
            bag, key = self.path(f'{presentation}.bag'), self.path(f'{presentation}.key')
            self.tool('problems_to_bag', self.data.folder('hall_local.txt'), '-o', bag, '--no-truth', '--key', key,
                      '--presentation', presentation)
            answers = self.path(f'{presentation}_answers.bag')
            self.solve(bag, answers, presentation)
            run = self.path('run', presentation)
            scoring = ('score_poses', self.data.folder('hall_local.txt'), '--poses', answers, '--key', key, '--run', run)
            self.assertRegex(self.tool(*scoring, '--topic', '/answer'), r'(?m)^2 poses at other times ignored$')
            self.assert_tool_fails('expected the id or timestamp of a problem', *scoring, '--topic', '/between')
            self.assertEqual({row['outcome'] for row in rows(run)}, {'replied'})
            self.assertLess(max(row['error'] for row in rows(run)), 1e-5)

    def solve(self, bag, answers, presentation):
        """Finds the poses by knowing the clouds, from nothing but what a player of the bag gives."""
        self.assertNotIn(b'h_2741', open(bag, 'rb').read())
        newest = {}
        with rosbag.Bag(bag) as played, rosbag.Bag(answers, 'w') as written:
            self.assertEqual(set(played.get_type_and_topic_info().topics), {
                '/tf_static', *(f'/pcrb/{name}' for name in ('problem', 'target', 'source', 'initialpose'))})
            for topic, message, _ in played.read_messages():
                newest[topic] = message
                if topic != '/pcrb/source':
                    continue
                problem, points = newest['/pcrb/problem'], maths.points_of(message)
                self.assertRegex(problem.problem_id, '^[0-9a-f]{32}$')
                self.assertEqual(message.header.frame_id, 'map' if presentation == 'registration' else 'pcrb_scan')
                source = next(p for p in self.data.of('local', 'hall')
                              if len(self.data.source_points(p)) == len(points))
                answer = PoseStamped(header=problem.header)
                for wrong in True, False:  # the last one counts
                    pose = maths.rigid_fit(points, self.data.source_points(source) + float(wrong))
                    maths.fill_pose(answer.pose, pose)
                    written.write('/answer', answer, message.header.stamp)
            answer.header.stamp += rospy.Duration(0, 1)
            for topic in '/answer', '/answer', '/between':  # as nodes publish between scans
                written.write(topic, answer, answer.header.stamp)

    def test_bags_are_the_same_bytes_again_and_kept_when_complete(self):
        texts = []
        for name in 'one.bag', 'two.bag':
            self.tool('sequence_to_bag', self.data.folder('hall'), '-o', self.path(name))
            with open(self.path(name), 'rb') as file:
                texts.append(file.read())
        self.assertEqual(*texts)
        self.assertIn('complete and unchanged', self.tool(
            'sequence_to_bag', self.data.folder('hall'), '-o', self.path('one.bag')))
        self.write('mine.bag', 'mine')
        self.assert_tool_fails('was not made by this tool', 'sequence_to_bag', self.data.folder('hall'),
                               '-o', self.path('mine.bag'))
        self.assertEqual(self.read('mine.bag'), 'mine')

    def test_a_played_bag_is_there_for_who_comes_late(self):
        self.tool('sequence_to_bag', self.data.folder('hall'), '-o', self.path('hall.bag'), '--rate', '10')
        player = self.start(Child(['rosbag', 'play', '--clock', '--keep-alive', '-q', '-r', '10', self.path('hall.bag')]))
        origin = maths.local_origin(self.data.clouds['hall', maths.SEQUENCES['hall'][0]])
        last = self.data.clouds['hall', maths.SEQUENCES['hall'][2]] - origin
        path = None
        while path is None or len(path.poses) < 3:
            path = rospy.wait_for_message('/pcrb/path', Path, 60)
        scan = rospy.wait_for_message('/pcrb/scan', PointCloud2, 60)
        np.testing.assert_allclose(maths.points_of(scan), last, atol=2e-5)
        self.assertGreater(rospy.wait_for_message('/pcrb/map', PointCloud2, 60).width, 0)
        player.interrupt()
        player.wait()

    def test_a_trajectory_is_scored_scan_by_scan(self):
        self.tool('sequence_to_bag', self.data.folder('hall'), '-o', self.path('hall.bag'), '--no-truth',
                  '--map', self.data.folder('hall', 'h_2741.pcd'), '--scans', self.path('scans.txt'))
        scans = [line.split() for line in self.read('scans.txt').splitlines() if not line.startswith('#')]
        self.assertEqual([name for _, name in scans], ['h_3852.pcd', 'h_9074.pcd'])  # the map is no scan
        origin = maths.local_origin(self.data.clouds['hall', 'h_2741.pcd'])
        offset = maths.transform(maths.axis_angle([0, 0, 1], np.radians(2)), [0.3, 0, 0.4])
        pose, text, expected = PoseStamped().pose, '', []
        for stamp, name in scans:
            truth = maths.shifted_pose(self.data.viewpoints['hall', name], origin)
            text += tum(stamp, maths.fill_pose(pose, truth @ offset))
            points = self.data.clouds['hall', name] - origin
            expected.append(maths.error(points, truth @ offset @ np.linalg.inv(truth)))
        summary = self.tool('score_poses', '--sequence', self.data.folder('hall'), '--scans', self.path('scans.txt'),
                            '--poses', self.write('est.tum', text), '--output', self.path('tracking'))
        self.assertRegex(summary, 'scans 2, with a pose 2')
        self.assertRegex(summary, r'APE translation m +2 +0.500000')
        self.assertRegex(summary, r'APE rotation deg +2 +2.000000')
        self.assertNotIn('lost 0', summary)
        self.assertIn('verdict: complete\n', summary)
        self.assertGreater(len(self.read('tracking/map.csv').splitlines()), 10)
        first_only = self.write('first.tum', text.splitlines()[0] + '\n')
        arguments = ('score_poses', '--sequence', self.data.folder('hall'), '--scans', self.path('scans.txt'), '--poses',
                     first_only, '--output', self.path('lost'))
        self.assert_tool_fails('more scans were lost than --max-lost 0 allows', *arguments)
        self.assertRegex(self.tool(*arguments, '--max-lost', '0.5'),
                         r'lost 1 of 2 scans(.|\n)*verdict: complete enough: no more lost than --max-lost 0.5')
        with open(self.path('lost', 'scans.csv'), newline='') as file:
            rows = list(csv.DictReader(file))
        held = maths.shifted_pose(self.data.viewpoints['hall', scans[0][1]], origin) @ offset
        truth = maths.shifted_pose(self.data.viewpoints['hall', scans[1][1]], origin)
        points = self.data.clouds['hall', scans[1][1]] - origin
        self.assertEqual(rows[1]['error'], '')
        self.assertAlmostEqual(float(rows[1]['error_or_last_pose']), maths.error(points, held @ np.linalg.inv(truth)), places=5)
        self.assert_tool_fails('more scans were lost than --max-lost 0.4 allows', *arguments, '--max-lost', '0.4')
        self.assertIn('verdict: incomplete: more lost than --max-lost 0.4', self.read('lost/summary.txt'))
        with open(self.path('tracking', 'scans.csv'), newline='') as file:
            found = [float(row['error']) for row in csv.DictReader(file)]
        np.testing.assert_allclose(found, expected, atol=1e-6)
        self.assertEqual(self.read('tracking/summary.txt'), summary[summary.index('scans 2'):])
        exported = np.array([line.split() for line in self.read('tracking/truth.tum').splitlines()], float)
        np.testing.assert_allclose(
            exported[:, 1:4], [self.data.viewpoints['hall', name][:3, 3] - origin for _, name in scans], atol=1e-6)

    def test_says_what_is_wrong(self):
        problems, poses = self.data.folder('hall_local.txt'), self.path('poses.txt')
        first = self.data.of('local', 'hall')[0].id
        arguments = 'score_poses', problems, '--poses', poses, '--run', self.path('run')
        for text, pattern in ((f'{first} 0 0 0 0 0 1\n', r'poses.txt:1: found 7 words'),
                              (f'{first} 0 0 0 0 0 0 1\n' * 2, r'poses.txt:2: found another pose'),
                              ('17 0 0 0 0 0 0 1\n', r'found `17`, expected the id of a problem'),
                              (f'{first} 0 0 0 0 0 x 1\n', r"found 'x', expected a number")):
            self.write('poses.txt', text)
            self.assert_tool_fails(pattern, *arguments)
        self.write('poses.txt', f'{first} 0 0 0 0 0 0 1\n')
        self.tool(*arguments)
        self.write('poses.txt', f'{first} 0 0 0 0 0 0 -1\n')
        self.assert_tool_fails('give another folder', *arguments)
        self.assert_tool_fails('found no --key', 'problems_to_bag', problems, '-o', self.path('b.bag'), '--no-truth')
        self.assert_tool_fails('found no problem file', 'problems_to_bag', poses, '-o', self.path('b.bag'))
        self.assert_tool_fails('a name without a timestamp', 'score_poses', '--sequence', self.data.folder('hall'),
                               '--poses', poses, '--output', self.path('tracking'))


if __name__ == '__main__':
    rospy.init_node('offline_test')
    rostest.rosrun('pcrb_launch', 'offline', OfflineTest)
