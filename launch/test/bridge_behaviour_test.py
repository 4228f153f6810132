#!/usr/bin/env python3
"""localization_bridge: what it gives a node, services, who takes its scans beside the node, rivals, parameters."""
import os
import subprocess
import sys

import rosgraph
import rospkg
import rospy
import rostest
import tf2_ros
import yaml
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, PointCloud2
from std_srvs.srv import Empty, Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from pcrb_testing import Child, executable, run_info, select, wait_until
from pcrb_testing_bridge import MOTION, AnsweringTestCase, link, make_answer

NODES = os.path.join(rospkg.RosPack().get_path('pcrb_launch'), 'config', 'nodes')


class BridgeBehaviourTest(AnsweringTestCase):

    def test_what_a_node_gets(self):
        server = self.localization(sequences='kitchen', subset=2)
        imus, odometry, subscribers = [], [], []
        for topic, kind, messages in ('imu', Imu, imus), ('odometry', Odometry, odometry):
            subscribers.append(rospy.Subscriber(f'{server.namespace}/robot/{topic}', kind, messages.append))
            self.addCleanup(subscribers[-1].unregister)

        def answer(kind, stamp, T):
            """The first scan once all that comes beside the next ones will be seen."""
            wait_until(lambda: all(subscriber.get_num_connections() for subscriber in subscribers), 'IMU and odometry are taken')
            return make_answer(kind, stamp, T)

        robot = self.answering(server, answer=answer)
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

    def test_a_service_may_be_called_when_the_first_scan_was_taken(self):
        server = self.localization(subset=3)
        publisher = self.publisher(f'{server.namespace}/robot/pose', PoseStamped)
        calls = []
        believed = PoseWithCovarianceStamped()
        believed.pose.pose.orientation.w = 1.0

        def locate(_):
            """The last scan that came, as nodes do that need one: it has been sent, and so it comes."""
            wait_until(lambda: robot.scans, 'a scan comes')
            calls.append(len(robot.scans))
            robot.initial = believed
            return True, ''

        def publish(stamp, T):
            self.say(publisher, make_answer(PoseStamped, stamp, T))

        robot = self.robot(server, publish, MOTION)
        service = rospy.Service(f'{server.namespace}/locate', Trigger, locate)
        self.addCleanup(service.shutdown)
        rows = self.scores(server, send_initialpose=False, after_first_scan=f'{server.namespace}/locate', first_scan_settle=0.2)
        self.assertEqual(len(calls), len(rows))

    def test_answers_to_all_scans_are_stored_with_their_errors_unless_they_are_not_wanted(self):
        for is_wanted in True, False:
            server = self.localization(run=f'stored{is_wanted}', sequences='kitchen', subset=2)
            robot = self.answering(server)
            rows = self.scores(server, settle='nth', settle_count=4, store_scans=is_wanted)
            robot.close()
            stored = select(server.run, 'scan', 'SELECT * FROM scan ORDER BY problem_id, scan')
            if not is_wanted:
                self.assertEqual(stored, [])
                continue
            for row in rows.values():
                scans = [scan for scan in stored if scan['problem_id'] == row['problem_id']]
                self.assertEqual([scan['scan'] for scan in scans], [1, 2, 3, 4])
                self.assertEqual([scan['is_echo'] for scan in scans], [0] * 4)
                self.assertEqual(scans[-1]['error'], row['error'])
                for scan in scans:
                    self.assertGreater(scan['answered_s'], scan['sent_s'])

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
                self.say(publisher, make_answer(PoseStamped, stamp, T))

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
        bridge.wait_for_output(r'there was none within 0.5 s \(start_limit\)')
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

        publisher = self.publisher(f'{server.namespace}/robot/pose', PoseStamped)

        def publish(stamp, T):
            """The transform that the first scan has brought is there before an answer to the third one is."""
            broadcaster.sendTransform(link('map', 'base_link', T, stamp))
            if len(robot.scans) > 2:
                self.say(publisher, make_answer(PoseStamped, stamp, T))

        robot = self.robot(server, publish, MOTION)
        self.assert_fails(self.bridge(server, settle='first'),
                          rf'{rospy.get_name()} publishes the tf frame base_link \(in map\); or set `tf_odom_base: none` in bridge_parameters')
        self.assertEqual(server.rows(), [])  # so that the run goes on with other parameters
        self.assert_motion_is_scored(self.scores(server, tf_odom_base='none'))

    def test_it_lists_its_mistakes(self):
        server = self.localization()
        bridge = self.bridge(server, settle='soon', scan_period=0.001, map_file='/nowhere/map.pcd', colour='red')
        self.assert_fails(bridge, '4 mistakes', '~settle: found `soon`', '~scan_period: found',
                          '/nowhere', '~colour')

    def test_a_file_of_parameters_counts_where_the_arguments_have_their_defaults_and_slashes_of_frames_do_not(self):
        server = self.localization(subset=2)
        self.answering(server)
        bridge = self.bridge(server, settle='stable', map_frame='/map', base_frame='/base_link', answer_limit=20.0,
                             bridge_parameters={'settle': 'first', 'scan_frame': '/lidar'})
        rows = self.rows_of_bridge(server, bridge)
        self.assert_motion_is_scored(rows)
        self.assertEqual({row['scans_used'] for row in rows.values()}, {1})

    def test_a_recipe_counts_where_neither_an_argument_nor_a_file_says_otherwise(self):
        server = self.localization(subset=2)
        self.answering(server)
        recipe = {'repository': 'somewhere', 'bridge': {'settle': 'nth', 'settle_count': 4, 'max_scans': 30, 'scan_frame': 'lidar'}}
        bridge = self.bridge(server, settle='stable', settle_count=5, scan_frame='sensor', recipe=recipe,
                             answer_limit=20.0, bridge_parameters={'max_scans': 5})
        rows = self.rows_of_bridge(server, bridge)
        self.assertEqual({row['scans_used'] for row in rows.values()}, {5})  # of the argument, by the rule of the recipe
        noted = run_info(server.run)['client_parameters']
        self.assertIn('recipe/bridge/scan_frame: lidar\n', noted)
        self.assertNotIn('somewhere', noted)  # words about a recipe may change

    def test_each_recipe_names_parameters_of_the_bridge_and_a_launch_file(self):
        known = subprocess.run([executable('pcrb_server', 'localization_bridge'), '--help'], check=True, stdout=subprocess.PIPE,
                               encoding='utf-8').stdout
        for name in os.listdir(NODES):
            if not name.endswith('.yaml'):
                continue
            with open(os.path.join(NODES, name), encoding='utf-8') as file:
                recipe = yaml.safe_load(file)
            for key in 'repository', 'commit', 'leave_out', 'parameters', 'cost', 'answers':
                self.assertTrue(recipe[key], f'{name}: {key}')
            for parameter in recipe['bridge']:
                self.assertRegex(known, rf'\n *~?{parameter}\b')
            self.assertTrue(os.path.isfile(os.path.join(NODES, name.replace('.yaml', '.launch'))), name)
            arguments = ['root:=/r', 'run:=/r', f'node:={name[:-5]}', 'settle:=nth']
            text = subprocess.run(['roslaunch', '--dump-params', 'pcrb_launch', 'localization.launch', *arguments], check=True,
                                  stdout=subprocess.PIPE, encoding='utf-8').stdout
            parameters = yaml.safe_load(text)
            self.assertEqual(parameters['/pcrb/localization_bridge/settle'], 'nth')
            self.assertEqual(parameters['/pcrb/localization_bridge/recipe/bridge/map_topic'], recipe['bridge']['map_topic'])
            self.assertEqual(parameters['/pcrb/node_supervisor/launch'], os.path.join(NODES, name.replace('.yaml', '.launch')))
            self.assertEqual(parameters['/pcrb/benchmark_server/under_test'], name[:-5])

    def test_it_refuses_a_file_that_contradicts_an_argument(self):
        bridge = self.bridge(self.localization(), settle='nth', max_scans=9,
                             bridge_parameters={'settle': 'deadline', 'max_scans': 9, 'colour': 'red'})
        self.assert_fails(bridge, '2 mistakes', '~settle: found `nth` as an argument and `deadline` in the file of '
                          'bridge_parameters, expected one of the two', '~colour: no parameter')


if __name__ == '__main__':
    rospy.init_node('bridge_behaviour_test')
    rostest.rosrun('pcrb_launch', 'bridge_behaviour', BridgeBehaviourTest)
