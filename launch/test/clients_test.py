#!/usr/bin/env python3
"""Clients that die, hang, come back, or never come."""
import os
import sys

import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, TestCase, executable, wait_until
from pcrb_testing_client import Client


class ClientsTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=300, perturbations=10)

    def registration_node(self, server, **parameters):
        name = f'{server.namespace}/registration_node'
        rospy.set_param(name, {'method': 'icp', **parameters})
        return self.start(Child([executable('pcrb_tools', 'registration_node')], server.namespace))

    def test_a_client_that_dies_and_comes_back_costs_at_most_the_problem_in_flight(self):
        data = maths.make_data_set(self.path('large'), points=8000, perturbations=28)  # all are not done before the client dies
        server = self.server(data, time_limit=15.0)
        client = self.registration_node(server)
        wait_until(lambda: len(server.rows()) >= 3, 'three problems are done')
        client.kill()
        server.wait_for_output('waiting for a client to call')
        self.registration_node(server)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, data.of('local'))
        outcomes = [row['outcome'] for row in server.rows()]
        self.assertGreaterEqual(outcomes.count('replied'), len(outcomes) - 1)

    def test_a_method_that_throws_fails_those_problems_only_and_is_made_anew(self):
        server = self.server(self.data, time_limit=60.0)
        parameters = self.path('none.yaml')
        with open(parameters, 'w') as file:
            file.write('{}\n')
        self.registration_node(server, method='throwing_method', plugin='libpcrb_test_throwing_method.so',
                               parameters=parameters)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.data.of('local'))
        reasons = {row['reason'] for row in server.rows() if row['outcome'] == 'failed'}
        self.assertEqual(reasons, {'the method threw std::bad_alloc', "the method threw a library's message",
                                   'the method threw what is no std::exception'})
        self.assertEqual({row['outcome'] for row in server.rows()}, {'failed', 'replied'})

    def replies(self, name, **parameters):
        """ICP's replies in a run of its own, exact, by problem."""
        server = self.server(self.data, sequences='kitchen', run=self.path(name))
        self.registration_node(server, **parameters)
        self.assert_ends_well(server)
        return {row['problem_id']: (row['x'], row['y'], row['z']) for row in server.rows()}

    def test_the_voxel_leaf_of_dataset_yaml_reaches_the_method(self):
        folder = os.path.join(self.path('root'), 'rooms')
        with open(os.path.join(folder, 'dataset.yaml'), 'a') as file:
            file.write('voxel_leaf: 0.7\n')
        with open(self.path('fixed.yaml'), 'w') as file:
            file.write('voxel_leaf: 0.7\n')
        with open(self.path('other.yaml'), 'w') as file:
            file.write('voxel_leaf: 0.2\n')
        of_the_data_set = self.replies('of_the_data_set')
        self.assertEqual(of_the_data_set, self.replies('fixed', parameters=self.path('fixed.yaml')))
        self.assertNotEqual(of_the_data_set, self.replies('other', parameters=self.path('other.yaml')))

    def test_a_client_that_comes_while_a_problem_is_out_may_still_answer_it(self):
        server = self.server(self.data, time_limit=60.0, sequences='kitchen')
        early = self.client(server)
        problem = early.next_problem()
        early.take_source(problem)
        late = self.client(server)
        self.assertEqual(late.next_problem().problem_id, problem.problem_id)
        wait_until(lambda: late.has('source', problem.header.stamp), 'the source is handed to the late one, too')
        self.assertFalse(late.ready(problem).accepted)
        self.assertTrue(late.submit(problem).accepted)

    def test_a_client_that_hangs_times_out_at_every_problem(self):
        server = self.server(self.data, time_limit=0.02, sequences='kitchen')
        client = self.client(server)
        client.serve(server, lambda client, problem: None)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.data.of('local', 'kitchen'))
        for row in server.rows():
            self.assertEqual((row['outcome'], row['runtime_s']), ('timed_out', None))
            self.assertEqual(row['error'], row['initial_misalignment'])

    def test_a_client_that_never_comes_is_an_error_that_names_the_service_and_who_listens(self):
        client = Client('/listened')  # subscribes, and does not call ready
        self.addCleanup(client.close)
        server = self.server(self.data, namespace='/listened', connect_limit=10.0)
        wait_until(client.has_new_problem, 'the client listens')
        self.assert_fails(server, f'no client called `{server.namespace}/ready` within 10 s', rospy.get_name())
        self.assertEqual(server.rows(), [])

    def test_a_client_that_leaves_for_good_is_an_error_and_what_was_done_is_kept(self):
        server = self.server(self.data, ready_limit=10.0)
        client = self.client(server)
        client.serve(server, limit=3)
        self.assert_fails(server, 'within 10 s', 'start again with the same ~run')
        self.assertEqual(len(server.rows()), 3)
        server = self.start(server.again(ready_limit=60.0))
        client.serve(server)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, self.data.of('local'))


if __name__ == '__main__':
    rospy.init_node('clients_test')
    rostest.rosrun('pcrb_launch', 'clients', ClientsTest)
