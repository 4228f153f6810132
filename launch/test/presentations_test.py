#!/usr/bin/env python3
"""Registration and localization are one problem in two presentations, and neither can be answered blindly."""
import os
import sys

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import Pose

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import TestCase, row_key


class PresentationsTest(TestCase):

    def make_data(self, perturbations):
        self.data = maths.make_data_set(self.path('root'), points=300, perturbations=perturbations)

    def play(self, answer, run='run', **parameters):
        """Answers all problems with answer(problem, points handed out) -> Pose; rows in serving order."""
        server = self.server(self.data, run=self.path(run), global_guess=True, **parameters)
        self.client(server).serve(server, lambda client, problem: client.submit(
            problem, answer(problem, maths.points_of(client.newest['source']))))
        self.assert_ends_well(server)
        self.assertEqual({row['outcome'] for row in server.rows()}, {'replied'})
        return server.rows()

    def official(self, problem, handed_out):
        """Which problem of the files it is, seen from its clouds and the guess."""
        guess = maths.from_pose(problem.initial_guess)
        fits = []
        for candidate in self.data.of(['local', 'global'][problem.kind]):
            points = self.data.source_points(candidate)
            if len(points) == len(handed_out):
                applied = maths.rigid_fit(points, handed_out)  # P, or V^-1 with guess P V
                P = applied if problem.presentation == problem.REGISTRATION else guess @ applied
                fits.append((np.abs(P - self.data.local_P(candidate)).max(), candidate))
        difference, found = min(fits, key=lambda fit: fit[0])
        self.assertLess(difference, 1e-4)
        return found

    def some_error(self, problem, handed_out):
        """A motion of its own for every official problem."""
        random = np.random.default_rng(int(self.official(problem, handed_out).id))
        return maths.transform(maths.axis_angle(random.normal(size=3), random.uniform(0, 1)), random.normal(size=3))

    def test_equivalent_replies_score_the_same_in_both_presentations(self):
        self.make_data(perturbations=2)
        tables = []
        for presentation in 'registration', 'localization':
            # The guess is 1 or P V, so that E and E P V are equivalent replies.
            rows = self.play(lambda problem, handed_out: maths.fill_pose(
                Pose(), self.some_error(problem, handed_out) @ maths.from_pose(problem.initial_guess)),
                run=presentation, presentation=presentation, kind='both')
            tables.append({row_key(row): row for row in rows})
        self.assertEqual(*map(set, tables))
        self.assertEqual(len(tables[0]), len(self.data.problems))
        for key, row in tables[0].items():
            for column in 'error', 'initial_misalignment', 'translation_error_m', 'rotation_error_rad':
                other = tables[1][key][column]
                self.assertLessEqual(abs(row[column] - other), 1e-9 * abs(other), f'{key}: {column}')
            self.assertGreater(abs(row['error'] - row['initial_misalignment']), 1e-6)

    def test_an_echo_of_the_guess_scores_the_initial_misalignment(self):
        self.make_data(perturbations=2)
        for presentation in 'registration', 'localization':
            for row in self.play(lambda problem, _: problem.initial_guess, run=presentation,
                                 presentation=presentation, kind='both'):
                self.assertAlmostEqual(row['error'] / row['initial_misalignment'], 1, delta=1e-9)

    def assert_blind(self, rows):
        """No better than the initial guess for 95 % of the problems at least."""
        better = sum(row['error'] < row['initial_misalignment'] * (1 - 1e-9) for row in rows)
        self.assertLessEqual(better, 0.05 * len(rows))

    def test_repeating_the_last_pose_is_no_better_than_the_guess(self):
        self.make_data(perturbations=20)
        truth = {}

        def last_true_pose(problem, handed_out):
            """Even if it was the right one."""
            points = self.data.source_points(self.official(problem, handed_out))
            answer = truth.get('last', problem.initial_guess)
            truth['last'] = maths.fill_pose(Pose(), maths.rigid_fit(handed_out, points))
            return answer

        self.assert_blind(self.play(last_true_pose, presentation='localization'))

    def test_always_saying_identity_is_no_better_than_the_guess(self):
        self.make_data(perturbations=20)
        identity = maths.fill_pose(Pose(), np.eye(4))
        self.assert_blind(self.play(lambda *_: identity, presentation='localization'))

    def test_scans_without_a_viewpoint_are_turned_about_z_alone_if_upright(self):
        self.make_data(perturbations=2)
        tilts = {}
        for upright in True, False:
            tilts[upright] = []

            def answer(problem, handed_out):
                points = self.data.source_points(self.official(problem, handed_out))
                tilts[upright].append(maths.rigid_fit(handed_out, points)[2, 2])
                return problem.initial_guess

            self.play(answer, run=f'upright {upright}', presentation='localization', sequences='kitchen',
                      upright=upright)
        self.assertGreater(min(tilts[True]), 1 - 1e-9)
        self.assertLess(min(tilts[False]), 0.99)


if __name__ == '__main__':
    rospy.init_node('presentations_test')
    rostest.rosrun('pcrb_launch', 'presentations', PresentationsTest)
