#!/usr/bin/env python3
"""Which problems are served and when: ~start, ~pause, ~skip, shards, subsets, handshake, time."""
import os
import sys

import rosgraph
import rospy
import rostest
from pcrb_msgs.msg import Problem, Summary
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import PointCloud2
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, TestCase, executable, row_key, run_info, wait_until


class ControlTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=300, perturbations=3)

    def done(self, server):
        """Serves a run to its end; keys of its problems, in serving order."""
        self.client(server).serve(server)
        self.assert_ends_well(server)
        return [row_key(row) for row in server.rows()]

    def start_and_next_problem(self, server, client):
        """Starts a paused server; the problem must not have been announced before."""
        answer = server.call('benchmark_server/skip', Trigger)
        self.assertEqual((answer.success, answer.message), (False, 'no problem is in flight'))
        start = rospy.Time.now()
        self.assertTrue(server.call('benchmark_server/start', Trigger).success)
        problem = client.next_problem()
        self.assertGreater(problem.header.stamp, start)
        return problem

    def test_a_problem_skipped_before_a_client_came_is_nobodys(self):
        server = self.server(self.data, sequences='kitchen', allow_skipped=True)
        client = self.client(server)
        client.next_problem()
        self.assertTrue(server.call('benchmark_server/skip', Trigger).success)
        wait_until(server.rows, 'the problem is skipped')
        self.assertNotIn('client', run_info(server.run))
        client.serve(server)
        self.assert_ends_well(server)
        self.assertEqual(run_info(server.run)['client'], rospy.get_name())

    def test_start_pause_and_skip(self):
        server = self.server(self.data, autostart=False, time_limit=60.0, allow_skipped=True)
        client = self.client(server)
        server.wait_for_output(f'waiting for the service {server.namespace}/benchmark_server/start: ~autostart is false')
        problem = self.start_and_next_problem(server, client)
        client.take_source(problem)
        self.assertTrue(server.call('benchmark_server/pause', Trigger).success)
        self.assertTrue(client.submit(problem).accepted)  # the one in flight goes on
        client.result_of(problem)
        announced = self.start_and_next_problem(server, client)
        self.assertTrue(server.call('benchmark_server/skip', Trigger).success)  # before its source is out
        self.assertEqual(client.result_of(announced).outcome, client.result_of(announced).SKIPPED)
        handed_out = client.next_problem()
        client.take_source(handed_out)
        self.assertTrue(server.call('benchmark_server/skip', Trigger).success)
        self.assertEqual(client.result_of(handed_out).reason, 'skipped on request')
        client.serve(server)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.data.of('local'))
        outcomes = [row['outcome'] for row in server.rows()]
        self.assertEqual(outcomes[:4], ['replied', 'skipped', 'skipped', 'replied'])
        for row in server.rows()[1:3]:
            self.assertEqual(row['error'], row['initial_misalignment'])

    def test_shards_are_disjoint_and_together_complete(self):
        servers = [self.server(self.data, run=self.path(f'run{i}'), kind='both', shard=f'{i}/3') for i in range(3)]
        shards = [self.done(server) for server in servers]
        self.assertEqual(sorted(sum(shards, [])), sorted(problem.key for problem in self.data.problems))
        self.assertLessEqual(max(map(len, shards)) - min(map(len, shards)), 1)

    def test_a_subset_is_the_same_for_the_same_seed(self):
        runs = [self.done(self.server(self.data, run=self.path(f'run{i}'), subset=10, seed=seed))
                for i, seed in enumerate((5, 5, 6))]
        self.assertEqual([len(set(run)) for run in runs], [10, 10, 10])
        self.assertEqual(sorted(runs[0]), sorted(runs[1]))
        self.assertNotEqual(sorted(runs[0]), sorted(runs[2]))

    def test_ids_and_order_are_new_for_every_run(self):
        servers = [self.server(self.data, run=self.path(f'run{i}')) for i in range(2)]
        ids = []
        for server in servers:
            client = self.client(server)
            client.serve(server, lambda client, problem: ids.append(problem.problem_id) or client.submit(problem))
            self.assert_ends_well(server)
        self.assertEqual(len(set(ids)), 2 * len(self.data.of('local')))
        orders = [[row_key(row) for row in server.rows()] for server in servers]
        self.assertEqual(*map(sorted, orders))
        self.assertNotEqual(*orders)  # there are some 700000

    def test_latched_topics_reach_who_comes_late(self):
        server = self.server(self.data, summary_hold_time=240.0, time_limit=240.0)
        early = self.client(server)
        problem = early.next_problem()
        early.take_source(problem)
        for topic, kind in ('problem', Problem), ('target', PointCloud2), ('source', PointCloud2):
            late = rospy.wait_for_message(f'{server.namespace}/{topic}', kind, 60)
            self.assertEqual(late.header.stamp, problem.target_stamp if topic == 'target' else problem.header.stamp)
        early.submit(problem)
        early.serve(server, limit=len(self.data.of('local')) - 1)
        wait_until(lambda: 'summary' in early.newest, 'the summary comes')
        self.assertTrue(rospy.wait_for_message(f'{server.namespace}/summary', Summary, 60).finished)
        server.interrupt()
        self.assert_ends_well(server)

    def test_without_handshake_who_only_watches_is_no_client(self):
        server = self.server(self.data, handshake='none', connect_limit=0.5, time_limit=0.1, autostart=False)
        topic = f'{server.namespace}/problem'
        server.wait_for_output('problems')
        for command in ['rostopic', 'echo', topic], ['rosbag', 'record', '-O', self.path('bag'), topic]:
            self.start(Child(command))
        master = rosgraph.Master(rospy.get_name())
        wait_until(lambda: len(dict(master.getSystemState()[1]).get(topic, [])) == 2, 'both watch')
        server.call('benchmark_server/start', Trigger)
        self.assert_fails(server, f'no client subscribed to `{topic}` within 0.5', 'rostopic')
        self.assertEqual(server.rows(), [])

    def test_without_handshake_a_client_may_have_a_watchers_name(self):
        server = self.server(self.data, namespace='/pcrb', handshake='none', time_limit=60.0)
        self.start(Child([executable('pcrb_tools', 'minimal_client'), '__name:=record_breaker']))
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.data.of('local'))

    def test_without_handshake_who_subscribes_is_a_client(self):
        server = self.server(self.data, handshake='none', time_limit=60.0)
        client = self.client(server)
        client.ready = lambda problem: None
        client.serve(server)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.data.of('local'))
        self.assertEqual({row['outcome'] for row in server.rows()}, {'replied'})

    def test_the_earth_frame_follows_the_target(self):
        origins = []  # of the map in earth, as they were broadcast
        subscriber = rospy.Subscriber('/tf_static', TFMessage, lambda message: origins.extend(
            t.transform.translation for t in message.transforms if t.header.frame_id == 'earth'))
        self.addCleanup(subscriber.unregister)
        server = self.server(self.data)
        seen = []

        def answer(client, problem):
            is_hall = client.newest['source'].width % 10 == 5
            x, y = (332400.0, 4151400.0) if is_hall else (0.0, 0.0)
            wait_until(lambda: origins and (origins[-1].x, origins[-1].y) == (x, y), f'earth -> map is {x} {y}')
            seen.append(is_hall)
            client.submit(problem)

        self.client(server).serve(server, answer)
        self.assert_ends_well(server)
        self.assertEqual(sorted(seen, reverse=True), seen)  # the hall first, so that it must be withdrawn

    def use_sim_time(self):
        rospy.set_param('/use_sim_time', True)
        self.addCleanup(rospy.set_param, '/use_sim_time', False)

    def test_sim_time_without_a_clock_is_an_error(self):
        self.use_sim_time()
        self.assert_fails(self.server(self.data), 'use_sim_time is set, but nothing was published on /clock')

    def test_sim_time_that_stands_still_does_not_stop_a_run(self):
        self.use_sim_time()
        clock = rospy.Publisher('/clock', Clock, queue_size=1, latch=True)
        self.addCleanup(clock.unregister)
        clock.publish(rospy.Time(1000))
        server = self.server(self.data, sequences='kitchen', time_limit=0.2)
        client = self.client(server)
        stamps = []

        def answer(client, problem):
            stamps.append(problem.header.stamp)
            if problem.index != 3:  # which times out: limits are on a clock that does go on
                client.submit(problem)

        client.serve(server, answer)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.data.of('local', 'kitchen'))
        self.assertEqual(server.rows()[3]['outcome'], 'timed_out')
        self.assertEqual(stamps, sorted(set(stamps)))
        self.assertLess(abs(stamps[-1].to_sec() - 1000), 1)


if __name__ == '__main__':
    rospy.init_node('control_test')
    rostest.rosrun('pcrb_launch', 'control', ControlTest)
