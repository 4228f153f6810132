"""What the nodes share: map, scans moved to base_link through tf, initial pose."""
import numpy as np
import rospy
import tf2_ros
from geometry_msgs.msg import PoseWithCovarianceStamped
from localization_standins.geometry import from_quaternion, moved, to_quaternion
from sensor_msgs.msg import PointCloud2

TF_LIMIT = rospy.Duration(5.0)  # for a link that is under way, on a busy machine, too
DTYPES = {7: np.float32, 8: np.float64}


def points_of(cloud):
    """x y z of a PointCloud2, n x 3."""
    fields = {field.name: field for field in cloud.fields}
    names = 'x', 'y', 'z'
    layout = np.dtype({'names': names, 'formats': [DTYPES[fields[name].datatype] for name in names],
                       'offsets': [fields[name].offset for name in names], 'itemsize': cloud.point_step})
    row_step = cloud.row_step if cloud.height > 1 and cloud.row_step else cloud.width * cloud.point_step
    data = np.ndarray((cloud.height, cloud.width), layout, cloud.data, strides=(row_step, cloud.point_step)).ravel()
    return np.stack([data[name].astype(float) for name in names], axis=1)


def read_pcd(path):
    """x y z of a PCD file of floats, ascii or binary, n x 3."""
    with open(path, 'rb') as file:
        header = {}
        while 'DATA' not in header:
            word, _, rest = file.readline().decode().partition(' ')
            header[word] = rest.split()
        if header['DATA'] == ['ascii']:
            return np.loadtxt(file, ndmin=2)[:, :3]
        layout = np.dtype([(name, f'<{kind.lower()}{size}') for name, kind, size in zip(header['FIELDS'], header['TYPE'], header['SIZE'])])
        data = np.fromfile(file, layout, int(header['POINTS'][0]))
        return np.stack([data[name].astype(float) for name in ('x', 'y', 'z')], axis=1)


def matrix_of(position, orientation):
    """4 x 4 of the parts of a Pose or a Transform."""
    return from_quaternion([position.x, position.y, position.z],
                           [orientation.x, orientation.y, orientation.z, orientation.w])


def fill(position, orientation, T):
    """Writes a 4 x 4 into the parts of a Pose or a Transform."""
    position.x, position.y, position.z = (float(number) for number in T[:3, 3])
    orientation.x, orientation.y, orientation.z, orientation.w = (float(number) for number in to_quaternion(T))


class Node:
    """Feeds an algorithm; publish(stamp, pose) is for those who derive from this.

    Scans that come while one is worked on are dropped but for the newest, and so are scans before
    there are a map and an initial pose, and those that tf cannot move to base_link.
    """

    def __init__(self, make_algorithm):
        self.make_algorithm = make_algorithm
        self.algorithm = None
        self.initial = None
        self.is_initialised = False
        self.base_frame = rospy.get_param('~base_frame', 'base_link')
        self.map_frame = rospy.get_param('~map_frame', 'map')
        self.tf = tf2_ros.Buffer()
        self.tf_listener = tf2_ros.TransformListener(self.tf)
        rospy.Subscriber('map_cloud', PointCloud2, self.take_map, queue_size=1, buff_size=1 << 26)
        rospy.Subscriber('initialpose', PoseWithCovarianceStamped, self.take_initial_pose, queue_size=1)
        rospy.Subscriber('scan_cloud', PointCloud2, self.take_scan, queue_size=1, buff_size=1 << 26)

    def take_map(self, cloud):
        self.algorithm = None  # the former map answers no scan of this one
        self.algorithm = self.make_algorithm(points_of(cloud))
        self.is_initialised = False

    def take_initial_pose(self, message):
        self.initial = message
        self.is_initialised = False

    def is_ready(self, stamp):
        if self.algorithm is None or self.initial is None:
            return False
        if not self.is_initialised:
            pose = self.initial.pose
            self.is_initialised = True
            self.algorithm.initialise(matrix_of(pose.pose.position, pose.pose.orientation),
                                      np.reshape(pose.covariance, (6, 6)), stamp.to_sec())
            self.start(stamp)
        return True

    def start(self, stamp):
        """Called with the stamp of the first scan after a new initial pose."""

    def take_scan(self, cloud):
        if not self.is_ready(cloud.header.stamp):
            return
        try:
            link = self.tf.lookup_transform(self.base_frame, cloud.header.frame_id, cloud.header.stamp,
                                            TF_LIMIT).transform
        except tf2_ros.TransformException as error:
            rospy.logwarn('scan dropped: %s', error)
            return
        self.work(moved(matrix_of(link.translation, link.rotation), points_of(cloud)), cloud.header.stamp)

    def work(self, scan, stamp):
        pose = self.algorithm.update(scan, stamp.to_sec())
        if pose is None:
            rospy.logwarn('no pose of a scan: its alignment does not converge')
        else:
            self.publish(stamp, pose)

    def publish(self, stamp, pose):
        raise NotImplementedError
