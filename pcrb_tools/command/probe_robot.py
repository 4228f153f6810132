"""The robot of pcrb probe: it shows a localization node a map and ten scans, and notes all that the node says to them."""
import dataclasses
import sys
import threading
import time

import numpy as np
import probe_recipe
import rosgraph
import rospy
import tf2_msgs.msg
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
from probe_room import GUESS, TRUTH, cloud_message, fill_pose, position_of, room, scan_at_truth, write_pcd
from sensor_msgs.msg import Imu

CLOUD, INITIAL_POSE = 'sensor_msgs/PointCloud2', 'geometry_msgs/PoseWithCovarianceStamped'
POSES = {'geometry_msgs/PoseStamped': PoseStamped, INITIAL_POSE: PoseWithCovarianceStamped, 'nav_msgs/Odometry': Odometry,
         'geometry_msgs/TransformStamped': TransformStamped}
SCANS, PERIOD, ANSWER_LIMIT = 10, 0.1, 3.0  # s
PATIENCE = 10.0  # s, in place of ANSWER_LIMIT for a node that has answered a scan, and may have to wait for a processor
MASTER_LIMIT = 120.0  # s
CONNECT_LIMIT = 20.0  # s
SENSOR = 'sensor'
OWN = '/pcrb_probe'
if not hasattr(threading.Thread, 'isAlive'):  # by which Debian 11's rospy ends, and which its Python has no more
    threading.Thread.isAlive = threading.Thread.is_alive


@dataclasses.dataclass
class Hints:
    map_topic: str = ''
    scan_topic: str = ''
    pose_topic: str = ''
    map_file: str = ''
    start_limit: float = 60.0


@dataclasses.dataclass
class Answer:
    """A pose that the node published after a scan."""
    scan: int  # from 0, the newest one then
    delay: float  # s from that scan until it came
    lateness: float  # s from that scan's stamp to the pose's
    parent: str
    error: float  # m from the truth
    is_echo: bool
    is_valid: bool


@dataclasses.dataclass
class Observation:
    subscriptions: dict = dataclasses.field(default_factory=dict)  # topic: type
    publications: dict = dataclasses.field(default_factory=dict)
    parameters: dict = dataclasses.field(default_factory=dict)
    services: list = dataclasses.field(default_factory=list)
    links: dict = dataclasses.field(default_factory=dict)  # (parent, child): whether it is static
    answers: dict = dataclasses.field(default_factory=dict)  # topic, or (parent, child) of tf: list of Answer
    map_topics: list = dataclasses.field(default_factory=list)
    scan_topics: list = dataclasses.field(default_factory=list)
    base_frame: str = 'base_link'
    map_frame: str = 'map'
    has_died: bool = False
    map_file: str = ''


class Robot:

    def __init__(self, hints):
        self.hints, self.seen, self.lock = hints, Observation(map_file=hints.map_file or ''), threading.Lock()
        self.master = rosgraph.Master(OWN)
        self.stamps, self.sent = [], []
        self.listening = {}
        self.publishers = {}

    def write_map(self):
        if self.hints.map_file:
            write_pcd(self.hints.map_file, room())

    def probe(self, is_running):
        """All that was seen; None if the launch file ended or no node takes clouds."""
        if not wait_for(self.master.is_online, MASTER_LIMIT):
            sys.exit(f'pcrb probe: its ROS master did not answer within {MASTER_LIMIT:g} s')  # rospy would wait for ever
        rospy.init_node(OWN[1:], anonymous=False, disable_signals=True)
        for topic in '/tf', '/tf_static':
            rospy.Subscriber(topic, tf2_msgs.msg.TFMessage, self.take_tf, topic == '/tf_static', queue_size=100)
        if not wait_for(lambda: self.look() or not is_running(), self.hints.start_limit) or not is_running():
            return None
        self.settle_down()
        self.choose()
        self.play(is_running)
        self.keep_wanted()
        self.seen.has_died = not is_running() or not self.look()
        return self.seen

    def keep_wanted(self):
        """Of all poses those that were asked for: of a topic, or of tf."""
        wanted = self.hints.pose_topic
        with self.lock:
            self.seen.answers = {channel: answers for channel, answers in self.seen.answers.items()
                                 if not wanted or channel == wanted or wanted == 'tf' and isinstance(channel, tuple)}

    def look(self):
        """Notes what nodes take and say; whether one takes clouds."""
        publishers, subscribers, services = self.master.getSystemState()
        types = dict(self.master.getTopicTypes())
        for pairs, noted in ((subscribers, self.seen.subscriptions), (publishers, self.seen.publications)):
            noted.clear()
            noted.update({topic: types.get(topic, '') for topic, nodes in pairs if set(nodes) - {OWN, '/rosout'}})
        self.seen.services = [name for name, nodes in services if set(nodes) - {OWN, '/rosout'}]
        for topic, kind in self.seen.publications.items():
            if kind in POSES and topic not in self.listening:
                self.listening[topic] = rospy.Subscriber(topic, POSES[kind], self.take_pose, topic, queue_size=100, tcp_nodelay=True)
        return CLOUD in self.seen.subscriptions.values()

    def settle_down(self):
        """Until nothing new has come for two seconds: subscriptions of a new node come one by one."""
        before, seen = None, (dict(self.seen.subscriptions), dict(self.seen.publications))
        while before != seen:
            time.sleep(2.0)
            self.look()
            before, seen = seen, (dict(self.seen.subscriptions), dict(self.seen.publications))

    def choose(self):
        clouds = sorted(topic for topic, kind in self.seen.subscriptions.items() if kind == CLOUD)
        maps = [topic for topic in clouds if any(word in topic.lower() for word in ('map', 'target', 'reference', 'prior'))]
        maps = [self.hints.map_topic] if self.hints.map_topic else maps
        scans = [self.hints.scan_topic] if self.hints.scan_topic else [topic for topic in clouds if topic not in maps]
        if len(scans) > 1 and not maps:
            maps, scans = [scans[0]], scans[1:]  # a guess, which the recipe says
        if self.hints.map_file:  # what the node's own loader publishes is no input of the node
            maps = [topic for topic in maps if topic not in self.seen.publications]
        self.seen.map_topics, self.seen.scan_topics = maps, scans
        for name in self.node_names():
            for key, value in self.parameters_of(name).items():
                self.seen.parameters[f'{name}/{key}'] = value
        for name, value in self.seen.parameters.items():
            key = name.rpartition('/')[2]
            if isinstance(value, str) and key in ('base_frame', 'robot_frame', 'base_frame_id', 'base_link_frame', 'odom_child_frame_id'):
                self.seen.base_frame = value.strip('/')
            if isinstance(value, str) and key in ('map_frame', 'global_frame', 'map_frame_id', 'global_frame_id'):
                self.seen.map_frame = value.strip('/')

    def node_names(self):
        return {name for pairs in self.master.getSystemState()[:2] for _, nodes in pairs for name in nodes} - {OWN, '/rosout'}

    def parameters_of(self, name):
        try:
            found = self.master.getParam(name)
        except rosgraph.MasterError:
            return {}
        return {key: value for key, value in found.items() if not isinstance(value, dict)} if isinstance(found, dict) else {}

    def play(self, is_running):
        now = rospy.Time.now()
        self.send_links(now)
        for topic in self.seen.map_topics:
            self.send(topic, cloud_message(room(), self.seen.map_frame, now), latch=True)
        time.sleep(2.0)
        self.send_initial_pose()
        time.sleep(1.0)
        scan = scan_at_truth()
        for _ in range(SCANS):
            if not is_running():
                return
            self.play_scan(scan)
        time.sleep(0.5)

    def play_scan(self, scan):
        stamp = rospy.Time.now()
        self.send_motion(stamp)
        with self.lock:
            self.stamps.append(stamp.to_sec())
            self.sent.append(time.monotonic())
            before = self.count()
        for topic in self.seen.scan_topics:
            self.send(topic, cloud_message(scan, SENSOR, stamp))
        wait_for(lambda: self.count() > before, PATIENCE if before else ANSWER_LIMIT, 0.01)
        time.sleep(PERIOD)

    def count(self):
        return sum(len(answers) for answers in self.seen.answers.values())

    def send(self, topic, message, latch=False):
        if topic not in self.publishers:
            self.publishers[topic] = rospy.Publisher(topic, type(message), queue_size=10, latch=latch, tcp_nodelay=True)
            wait_for(lambda: self.publishers[topic].get_num_connections() > 0, CONNECT_LIMIT)
        self.publishers[topic].publish(message)

    def send_links(self, stamp):
        message = tf2_msgs.msg.TFMessage()
        if SENSOR not in {child for _, child in self.seen.links}:
            link = TransformStamped(child_frame_id=SENSOR)
            link.header.frame_id, link.header.stamp = self.seen.base_frame, stamp
            link.transform.rotation.w = 1.0
            message.transforms.append(link)
        self.send('/tf_static', message, latch=True)

    def send_initial_pose(self):
        message = PoseWithCovarianceStamped()
        message.header.frame_id, message.header.stamp = self.seen.map_frame, rospy.Time.now()
        fill_pose(message.pose.pose, GUESS)
        for i, deviation in enumerate((0.5, 0.5, 0.1, 0.05, 0.05, 0.26)):
            message.pose.covariance[7 * i] = deviation ** 2
        for topic, kind in self.seen.subscriptions.items():
            if kind == INITIAL_POSE:
                self.send(topic, message)

    def send_motion(self, stamp):
        """Odometry that stands still, an IMU that feels gravity, tf odom -> base where the node does not say it."""
        for topic, kind in list(self.seen.subscriptions.items()):
            if kind == 'nav_msgs/Odometry':
                message = Odometry(child_frame_id=self.seen.base_frame)
                message.header.frame_id, message.header.stamp = 'odom', stamp
                message.pose.pose.orientation.w = 1.0
                self.send(topic, message)
            elif kind == 'sensor_msgs/Imu':
                message = Imu()
                message.header.frame_id, message.header.stamp = self.seen.base_frame, stamp
                message.orientation.w, message.linear_acceleration.z = 1.0, 9.80665
                self.send(topic, message)
        if self.seen.base_frame not in {child for _, child in self.seen.links}:
            link = TransformStamped(child_frame_id=self.seen.base_frame)
            link.header.frame_id, link.header.stamp, link.transform.rotation.w = 'odom', stamp, 1.0
            self.send('/tf', tf2_msgs.msg.TFMessage([link]))

    def take_pose(self, message, topic):
        self.note(topic, message.header, position_of(message))

    def take_tf(self, message, is_static):
        if message._connection_header.get('callerid') == OWN:
            return
        for link in message.transforms:
            pair = link.header.frame_id.strip('/'), link.child_frame_id.strip('/')
            with self.lock:
                self.seen.links[pair] = is_static
            if not is_static and pair[0] == self.seen.map_frame:
                self.note(pair, link.header, position_of(link))

    def note(self, channel, header, numbers):
        with self.lock:
            if not self.stamps:
                return
            scan = self.scan_of(header.stamp.to_sec())
            is_valid = bool(np.isfinite(numbers).all() and abs(np.linalg.norm(numbers[3:]) - 1) < 1e-2)
            self.seen.answers.setdefault(channel, []).append(Answer(
                scan=scan, delay=time.monotonic() - self.sent[scan], lateness=header.stamp.to_sec() - self.stamps[scan],
                parent=header.frame_id.strip('/'),
                error=float(np.linalg.norm(numbers[:3] - TRUTH[:3, 3])),
                is_echo=bool(np.linalg.norm(numbers[:3] - GUESS[:3, 3]) < 1e-4), is_valid=is_valid))

    def scan_of(self, stamp):
        """The scan that a stamp is of, else the newest one that is not after it, else the newest one."""
        before = [scan for scan, sent in enumerate(self.stamps) if sent < stamp + probe_recipe.EXACT]
        return before[-1] if before else len(self.stamps) - 1


def wait_for(condition, limit, period=0.1):
    """Whether it held within `limit` s."""
    end = time.monotonic() + limit
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(period)
    return False
