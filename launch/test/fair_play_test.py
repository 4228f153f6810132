#!/usr/bin/env python3
"""What a client gains that remembers instead of registering, and what strangers can do to a run."""
import csv
import io
import math
import os
import socket
import struct
import subprocess
import sys
from urllib.parse import urlparse

import numpy as np
import rosgraph
import rospy
import rostest
from pcrb_msgs.msg import Problem
from pcrb_msgs.srv import Ready, ReadyRequest, ReadyResponse, SubmitPose, SubmitPoseRequest, SubmitPoseResponse
from sensor_msgs.msg import PointCloud2
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing_adversaries import Rememberer, Reuser, Trilaterator
from pcrb_testing import TestCase, executable, run_info, wait_until


def call_as(caller, service, kind, request, response):
    """A service call of a node that calls itself whatever it likes."""
    address = urlparse(rosgraph.Master('/fair_play').lookupService(service))
    fields = [f'callerid={caller}', f'service={service}', f'md5sum={kind._md5sum}', f'type={kind._type}']
    header = b''.join(struct.pack('<I', len(field.encode())) + field.encode() for field in fields)
    body = io.BytesIO()
    request.serialize(body)
    with socket.create_connection((address.hostname, address.port), timeout=60) as connection:
        stream = connection.makefile('rwb')

        def read_block():
            return stream.read(struct.unpack('<I', stream.read(4))[0])
        stream.write(struct.pack('<I', len(header)) + header)
        stream.flush()
        read_block()  # the server's header
        stream.write(struct.pack('<I', len(body.getvalue())) + body.getvalue())
        stream.flush()
        if stream.read(1) != b'\x01':
            raise AssertionError(f'{service} failed: {read_block()}')
        return response.deserialize(read_block())


class FairPlayTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=300, perturbations=4)

    def attack(self, adversary, data, **parameters):
        """The rows of a run whose client is an adversary."""
        server = self.server(data, run=self.path(f'run {parameters}'), sequences='kitchen', time_limit=600.0,
                             **parameters)
        self.client(server).serve(server, adversary.answer)
        self.assert_ends_well(server)
        self.assert_rows_of(server.run, data.of('local', 'kitchen'))
        return server.rows()

    @staticmethod
    def gains(rows):
        """Of each problem, whether its error is less than its initial misalignment."""
        return [row['error'] < 0.99 * row['initial_misalignment'] for row in rows]

    def compare(self, name, before, after):
        """Prints an adversary's scores, for docs/trust.md."""
        for title, rows in (('without', before), ('with', after)):
            print(f'{name}, {title} audit: median {np.median([row["error"] for row in rows]):.2g}, '
                  f'{sum(self.gains(rows))} of {len(rows)} problems better than the guess', flush=True)

    def test_memory_of_targets_is_worth_a_score_without_an_audit_and_nothing_with_one(self):
        for presentation in 'registration', 'localization':
            plain = self.attack(Rememberer(), self.data, presentation=presentation)
            audited = self.attack(Rememberer(), self.data, presentation=presentation, audit=True, results='end')
            self.compare(f'targets remembered ({presentation})', plain, audited)
            self.assertGreaterEqual(sum(row['error'] < 1e-4 for row in plain), 4, 'what the audit is for')
            self.assertLessEqual(sum(self.gains(audited)), 0.05 * len(audited))

    def test_published_errors_are_worth_a_score_and_an_audit_publishes_none(self):
        data = maths.make_data_set(self.path('many'), points=300, perturbations=8)
        live = self.attack(Trilaterator(), data, results='live')
        audited = self.attack(Trilaterator(), data, audit=True, results='end')
        self.compare('errors trilaterated', live, audited)
        self.assertGreaterEqual(sum(row['error'] < 1e-4 for row in live), 10, 'what the audit is for')
        self.assertLessEqual(sum(self.gains(audited)), 0.05 * len(audited))

    def test_a_client_that_solves_a_pair_once_and_uses_it_again_is_reported(self):
        honest = self.server(self.data, run=self.path('honest'), sequences='kitchen')
        self.client(honest).serve(honest)
        self.assert_ends_well(honest)
        runs = [f'honest={honest.run}']
        for name, points, parameters in (('plain', 1500, {}), ('audited', 600, {'audit': True, 'results': 'end'})):
            data = maths.make_data_set(self.path(name), points=points, perturbations=8)
            rows = self.attack(Reuser(), data, **parameters)
            print(f'pairs reused, {name}: median {np.median([row["error"] for row in rows]):.2g}', flush=True)
            runs.append(f'{name}={self.path(f"run {parameters}")}')
        subprocess.run([executable('pcrb_tools', 'report'), *runs, '--output', self.path('report'), '--no-figures',
                        '--resamples', '50'], check=True)
        with open(self.path('report', 'tables', 'local_audit.csv'), newline='') as file:
            verdicts = {row['method']: row['verdict'] for row in csv.DictReader(file)}
        self.assertEqual(set(verdicts), {'honest', 'plain', 'audited'})
        self.assertNotIn('gains', verdicts.pop('honest'))
        for verdict in verdicts.values():
            self.assertRegex(verdict, r"^gains by memory: [\d.]+ on a pair's first problem, [\d.]+ on later ones$")
        with open(self.path('report', 'index.html')) as page:
            self.assertIn('plain: gains by memory', page.read())

    def test_an_audited_guess_costs_as_much(self):
        for answer in ({}, {'audit': True}):
            server = self.server(self.data, run=self.path(f'guess {answer}'), sequences='kitchen', **answer)
            self.client(server).serve(server)
            self.assert_ends_well(server)
            for row in server.rows():
                self.assertAlmostEqual(row['error'], row['initial_misalignment'], 9)
            self.assertEqual(run_info(server.run).get('audit'), 'true' if answer else None)

    def test_after_its_score_an_audited_source_shows_no_point_that_it_had_not(self):
        server = self.server(self.data, sequences='kitchen', audit=True, time_limit=60.0)
        shown = []
        viewer = rospy.Subscriber(f'{server.namespace}/source_aligned', PointCloud2, shown.append)
        self.addCleanup(viewer.unregister)
        client = self.client(server)
        problem = client.next_problem()
        client.take_source(problem)
        wait_until(viewer.get_num_connections, 'it will be seen')
        client.submit(problem)
        published = maths.points_of(client.newest['source'])
        wait_until(lambda: shown, 'the aligned source comes')
        aligned = maths.points_of(shown[0])
        self.assertLess(len(published), len(self.data.source_points(self.data.by_id(server.rows()[0]['problem_id']))))
        self.assertEqual(len(aligned), len(published))
        self.assertLess(np.abs(maths.moved(maths.rigid_fit(published, aligned), published) - aligned).max(), 1e-4)
        client.serve(server)
        self.assert_ends_well(server)

    def test_errors_are_published_when_the_run_has_ended(self):
        server = self.server(self.data, sequences='kitchen', results='end', summary_hold_time=60.0)
        client = self.client(server)
        early = []

        def answer(client, problem):
            client.submit(problem)
            early.append(client.result_of(problem))
        client.serve(server, answer, limit=len(self.data.of('local', 'kitchen')))
        for result in early:
            for value in result.error, result.initial_misalignment, result.rotation_error, result.translation_error:
                self.assertTrue(math.isnan(value))
            self.assertEqual(result.outcome, result.REPLIED)
        wait_until(lambda: 'summary' in client.newest, 'the summary comes')
        wait_until(lambda: not any(math.isnan(result.error) for result in client.results.values()), 'errors come')
        stored = sorted(row['error'] for row in server.rows())
        np.testing.assert_allclose(sorted(result.error for result in client.results.values()), stored, rtol=1e-12)
        server.interrupt()
        self.assert_ends_well(server)

    def test_a_problem_belongs_to_its_client(self):
        server = self.server(self.data, sequences='kitchen', time_limit=60.0)
        name = f'{server.namespace}/submit_pose'

        def answer(client, problem):
            request = SubmitPoseRequest(problem_id=problem.problem_id)
            request.pose.pose.orientation.w = 1.0
            response = call_as('/stranger', name, SubmitPose, request, SubmitPoseResponse())
            self.assertEqual((response.accepted, response.code), (False, SubmitPoseResponse.NOT_YOURS))
            self.assertIn(rospy.get_name(), response.message)
            self.assertTrue(client.submit(problem).accepted)
        count = self.client(server).serve(server, answer)
        self.assert_ends_well(server)
        self.assertEqual(run_info(server.run)['foreign_replies'], str(count))
        self.assertRegex(server.output(), rf'{count} replies were rejected')
        self.assertEqual({row['outcome'] for row in server.rows()}, {'replied'})

    def test_strange_names_and_long_texts_do_no_harm(self):
        server = self.server(self.data, sequences='kitchen', time_limit=60.0)
        client = self.client(server)
        problem = client.next_problem()
        for caller in '/evil node', '', '/', 'node', '/' + 'n' * 100000:
            response = call_as(caller, f'{server.namespace}/ready', Ready, ReadyRequest(problem.problem_id),
                               ReadyResponse())
            self.assertFalse(response.accepted, caller[:20])
            self.assertLess(len(response.message), 300)
        self.assertTrue(client.take_source(problem))
        self.assertTrue(client.submit(problem, status=SubmitPoseRequest.FAILED, reason='x' * 10000000).accepted)
        client.serve(server)
        self.assert_ends_well(server)
        self.assertEqual(len(server.rows()[0]['reason']), 4096)

    def test_skipped_problems_fail_the_run_unless_they_are_allowed(self):
        for allowed in False, True:
            server = self.server(self.data, run=self.path(f'run {allowed}'), sequences='kitchen', allow_skipped=allowed)
            client = self.client(server)
            client.next_problem()
            self.assertTrue(server.call('benchmark_server/skip', Trigger).success)
            client.serve(server)
            self.assertEqual(server.wait(), 0 if allowed else 1, server.output())
            self.assert_rows_of(server.run, self.data.of('local', 'kitchen'))
            self.assertEqual('1 problems were skipped on request' in server.output(), not allowed)

    def test_a_rival_of_the_server_is_named(self):
        for topic, kind in ('problem', Problem), ('source', PointCloud2):
            server = self.server(self.data, run=self.path(topic), sequences='kitchen', connect_limit=4.0, autostart=False)
            server.wait_for_output('problems')
            rival = rospy.Publisher(f'{server.namespace}/{topic}', kind, queue_size=1)
            self.addCleanup(rival.unregister)
            server.call('benchmark_server/start', Trigger)
            self.assert_fails(server, rf'{rospy.get_name()} publishes {server.namespace}/{topic}')


if __name__ == '__main__':
    rospy.init_node('fair_play_test')
    rostest.rosrun('pcrb_launch', 'fair_play', FairPlayTest)
