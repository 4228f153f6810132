"""The bridge and the stand-ins as children of a test, and the stand-ins' algorithms as direct clients."""
import shutil
import time
import xmlrpc.client

import numpy as np
import pcrb_testing_data as maths
import rosgraph
import rospy
from geometry_msgs.msg import Pose, PoseStamped, PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
from pcrb_testing import Child, Launch, Server, TestCase, executable, wait_until
from pcrb_testing import rows as rows_of
from sensor_msgs.msg import PointCloud2

SCAN_PERIOD = 0.05  # s
MOTION = maths.transform(maths.axis_angle([0.1, -0.3, 1], 0.05), [0.2, -0.1, 0.05])


def fill_transform(transform, T):
    """Writes a 4 x 4 into a geometry_msgs/Transform."""
    pose = maths.fill_pose(PoseStamped().pose, T)
    t = transform.translation
    t.x, t.y, t.z = pose.position.x, pose.position.y, pose.position.z
    transform.rotation = pose.orientation


def link(parent, child, T, stamp):
    message = TransformStamped()
    message.header.frame_id, message.header.stamp, message.child_frame_id = parent, stamp, child
    fill_transform(message.transform, T)
    return message


def make_answer(kind, stamp, T):
    """A message of one of the types that nodes publish."""
    if kind is TransformStamped:
        return link('map', 'base_link', T, stamp)
    message = kind()
    message.header.frame_id, message.header.stamp = 'map', stamp
    pose = message.pose if kind is PoseStamped else message.pose.pose
    maths.fill_pose(pose, T)
    if kind is Odometry:
        message.child_frame_id = 'base_link'
    return message


class Bridge(Child):
    """localization_bridge with private parameters, beside a server."""

    def __init__(self, server, **parameters):
        name = f'{server.namespace}/localization_bridge'
        if rospy.has_param(name):
            rospy.delete_param(name)
        topics = {f'{kind}_topic': f'{server.namespace}/robot/{kind}'
                  for kind in ('map', 'scan', 'initialpose', 'pose')}
        fast = {'map_settle': 0.3, 'initialpose_settle': 0.05, 'scan_period': SCAN_PERIOD}
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
        """Its summary stays up until the bridge, which ends by it, has read it."""
        return self.server(self.data, run=self.path(run), presentation='localization',
                           **{'sequences': 'hall', 'time_limit': 60.0, 'summary_hold_time': 60.0, **parameters})

    def twin_servers(self, **parameters):
        """Two runs of the same secret, so that both put the very same problems; to be started one after the other."""
        server = self.localization(autostart=False, **parameters)
        server.wait_for_output('problems')
        server.interrupt()
        server.wait()
        shutil.copytree(self.path('run'), self.path('twin'))
        twin = {**server.parameters, 'autostart': True, 'run': self.path('twin')}
        return (lambda: self.start(server.again(autostart=True)),
                lambda **changes: self.start(Server(**{**twin, **changes})))

    def bridge(self, server, **parameters):
        return self.start(Bridge(server, **parameters))

    def robot(self, server, publish, motion=np.eye(4), make=None, **options):
        robot = (make or Robot)(server, publish, motion, **options)
        self.addCleanup(robot.close)
        return robot

    def standin(self, server, name, answers):
        return self.start(Standin(server, name, answers))

    def rows_of_bridge(self, server, bridge):
        """Rows by problem id, after both have ended well."""
        self.assert_ends_well(bridge)
        self.assert_ends_well(server)
        return {row['problem_id']: row for row in server.rows()}

    def rows_of_algorithm(self, server, algorithm, stamps, covariance):
        """The same algorithm as a client of its own: initialised with the guess, given each problem's scan at its stamps (s)."""
        def answer(client, problem):
            localizer = algorithm(maths.points_of(client.newest['target']))
            scan = maths.points_of(client.newest['source'])
            of_problem = stamps[problem.index]
            localizer.initialise(maths.from_pose(problem.initial_guess), covariance, of_problem[0])
            for stamp in of_problem:
                pose = localizer.update(scan, stamp)
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
        ratios = [row['error'] / row['initial_misalignment'] for row in rows.values()]
        self.assertLess(np.median(ratios), 0.6)


class Robot:
    """A localization node inside the test: says that it is where the initial pose moved by `motion` is.

    @param publish  called with the scan's stamp and the pose's 4 x 4.
    @param moves    whether each scan of a problem has other points.
    """

    def __init__(self, server, publish, motion=np.eye(4), moves=False):
        robot = f'{server.namespace}/robot'
        self.publish, self.motion, self.moves = publish, motion, moves
        self.initial = None
        self._newest_scan = PointCloud2()
        self.scans = []
        self.maps = 0
        self._subscribers = [rospy.Subscriber(f'{robot}/scan', PointCloud2, self._take_scan, tcp_nodelay=True),
                             rospy.Subscriber(f'{robot}/map', PointCloud2, self._take_map),
                             rospy.Subscriber(f'{robot}/initialpose', PoseWithCovarianceStamped, self._take_pose)]

    def close(self):
        for subscriber in self._subscribers:
            subscriber.unregister()

    def _take_map(self, cloud):
        self.maps += 1

    def _take_pose(self, message):
        self.initial = message

    def _take_scan(self, cloud):
        self.scans.append(cloud)
        self._wait_for_initial_pose(cloud)
        self.publish(cloud.header.stamp, self.motion @ maths.from_pose(self.initial.pose.pose))

    def _wait_for_initial_pose(self, cloud):
        """A problem's initial pose is sent before its first scan, but over another connection: that scan may come first.
        One that a test has set has no stamp, and is as good for all problems."""
        before = self._newest_scan
        self._newest_scan = cloud

        def is_there():
            stamp = self.initial and self.initial.header.stamp
            return stamp is not None and (stamp.is_zero() or stamp > before.header.stamp)
        is_first = self.initial is None or (not self.moves and cloud.data != before.data)
        if is_first:
            wait_until(is_there, 'the initial pose comes')


class SlowRobot(Robot):
    """A tracker that works for `work` s on a scan: `motion` moves its pose on from where the scan before left it.

    An initial pose that comes meanwhile is lost, as in nodes that keep their pose in one variable.
    """

    def __init__(self, server, publish, motion=np.eye(4), work=0.0):
        self.work = work
        self.pose = None
        super().__init__(server, publish, motion)

    def _take_pose(self, message):
        self.pose = maths.from_pose(message.pose.pose)
        super()._take_pose(message)

    def _take_scan(self, cloud):
        self._wait_for_initial_pose(cloud)
        pose = self.motion @ self.pose
        time.sleep(self.work)
        self.pose = pose
        self.publish(cloud.header.stamp, pose)


class AnsweringTestCase(BridgeTestCase):
    """Runs through the bridge with a robot that answers."""

    def publisher(self, name, kind, **options):
        publisher = rospy.Publisher(name, kind, queue_size=10, **options)
        self.addCleanup(publisher.unregister)
        return publisher

    def answering(self, server, kind=PoseStamped, motion=MOTION, answer=make_answer, **options):
        """A robot whose answers are of that type."""
        publisher = self.publisher(f'{server.namespace}/robot/pose', kind)
        return self.robot(server, lambda stamp, T: self.say(publisher, answer(kind, stamp, T)), motion, **options)

    @staticmethod
    def say(publisher, message):
        """Once somebody listens: what is said before is lost."""
        wait_until(publisher.get_num_connections, f'somebody takes {publisher.name}')
        publisher.publish(message)

    def scores(self, server, **parameters):
        """Of a run through the bridge; the robot has been made, and answers every scan, be it late."""
        rows = self.rows_of_bridge(server, self.bridge(server, **{'settle': 'first', 'answer_limit': 20.0, **parameters}))
        self.assertEqual({row['outcome'] for row in rows.values()}, {'replied'}, rows)
        return rows

    def assert_motion_is_scored(self, rows, times=lambda row: 1):
        """What is left is MOTION P, once or for each scan: the guess is P V, and V is the truth."""
        for row in rows.values():
            problem = self.data.by_id(row['problem_id'])
            motion = np.linalg.matrix_power(MOTION, times(row))
            error = maths.error(self.data.source_points(problem), motion @ self.data.local_P(problem))
            self.assertAlmostEqual(row['error'] / error, 1, delta=1e-5, msg=row)


class SupervisedTestCase(BridgeTestCase):
    """Runs of localization.launch with a node of its own: NODE, unless a test gives another launch file."""

    NODE = '/ndt_localizer'

    def launch(self, **arguments):
        defaults = {'root': self.data.root, 'run': self.path('run'), 'sequences': 'hall', 'time_limit': 30.0,
                    'node_launch': 'localization_standins ndt_localizer.launch',
                    'node_args': 'map_topic=/points_map scan_topic=/points_raw', 'map_topic': '/points_map',
                    'scan_topic': '/points_raw', 'pose_topic': '/ndt_pose', 'settle': 'first'}
        return self.start(Launch('localization.launch', **{**defaults, **arguments}))

    def node_process(self):
        """The process id of the node under test, None while it is not there."""
        try:
            return xmlrpc.client.ServerProxy(rosgraph.Master('/test').lookupNode(self.NODE)).getPid('/test')[2]
        except (rosgraph.MasterException, OSError):
            return None

    def assert_finished(self, launch, least_replied):
        launch.wait()
        rows = rows_of(self.path('run'))
        self.assert_rows_of(self.path('run'), self.data.of('local', 'hall'))
        self.assertGreaterEqual([row['outcome'] for row in rows].count('replied'), least_replied, rows)
