"""The bridge and the stand-ins as children of a test, and the stand-ins' algorithms as direct clients."""
import shutil

import numpy as np
import pcrb_testing_data as maths
import rospy
from geometry_msgs.msg import Pose
from pcrb_testing import Child, Server, TestCase, executable


class Bridge(Child):
    """localization_bridge with private parameters, beside a server."""

    def __init__(self, server, **parameters):
        name = f'{server.namespace}/localization_bridge'
        if rospy.has_param(name):
            rospy.delete_param(name)
        topics = {f'{kind}_topic': f'{server.namespace}/robot/{kind}' for kind in ('map', 'scan', 'initialpose', 'pose')}
        fast = {'map_settle': 0.3, 'initialpose_settle': 0.05, 'scan_period': 0.05}
        rospy.set_param(name, {**topics, **fast, **parameters})
        super().__init__([executable('pcrb_server', 'localization_bridge')], server.namespace)


class Standin(Child):
    """One of the nodes of localization_standins, in a namespace of its own, with remaps alone."""

    def __init__(self, server, name, answers):
        robot = f'{server.namespace}/robot'
        remaps = {'map_cloud': 'map', 'scan_cloud': 'scan', 'initialpose': 'initialpose', answers: 'pose'}
        super().__init__([executable('localization_standins', f'{name}_localizer'),
                          *(f'{own}:={robot}/{topic}' for own, topic in remaps.items())], robot)


class BridgeTestCase(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=1000)

    def localization(self, run='run', **parameters):
        return self.server(self.data, run=self.path(run), presentation='localization',
                           **{'sequences': 'hall', 'time_limit': 30.0, **parameters})

    def twin_servers(self, **parameters):
        """Two runs of the same secret, so that both put the very same problems; to be started one after the other."""
        server = self.localization(autostart=False, **parameters)
        server.wait_for_output('problems')
        server.interrupt()
        server.wait()
        shutil.copytree(self.path('run'), self.path('twin'))
        return (lambda: self.start(server.again(autostart=True)),
                lambda: self.start(Server(**{**server.parameters, 'autostart': True, 'run': self.path('twin')})))

    def bridge(self, server, **parameters):
        return self.start(Bridge(server, **parameters))

    def standin(self, server, name, answers):
        return self.start(Standin(server, name, answers))

    def rows_of_bridge(self, server, bridge):
        """Rows by problem id, after both have ended well."""
        self.assert_ends_well(bridge)
        self.assert_ends_well(server)
        return {row['problem_id']: row for row in server.rows()}

    def rows_of_algorithm(self, server, algorithm, updates, covariance):
        """The same algorithm as a client of its own: initialised with the guess, given the scan so many times."""
        def answer(client, problem):
            localizer = algorithm(maths.points_of(client.newest['target']))
            localizer.initialise(maths.from_pose(problem.initial_guess), covariance)
            scan = maths.points_of(client.newest['source'])
            for k in range(updates):
                pose = localizer.update(scan, 0.05 * (k + 1))
            client.submit(problem, maths.fill_pose(Pose(), pose))
        self.client(server).serve(server, answer)
        self.assert_ends_well(server)
        return {row['problem_id']: row for row in server.rows()}

    def assert_same_scores(self, rows, others, tolerance):
        self.assertEqual(sorted(rows), sorted(others))
        self.assertGreater(len(rows), 0)
        for key, row in rows.items():
            self.assertEqual(row['outcome'], 'replied', row)
            self.assertLessEqual(abs(row['error'] - others[key]['error']), tolerance * others[key]['error'], key)

    def assert_improves(self, rows):
        errors, before = (np.array([row[column] for row in rows.values()]) for column in ('error', 'initial_misalignment'))
        self.assertLess(np.median(errors / before), 0.6)
