"""What pcrb probe shows a localization node: a room, its map and scans, the true pose and a guess of it."""
import numpy as np
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import PointCloud2, PointField

OFFSET = (0.3, -0.2, 0.05, 0.08)  # x y z in m and yaw in rad: of the initial pose from the truth


def room(count=6000):
    """Points on floor, four walls and two boxes of a room of 12 x 8 x 3 m, the same each time."""
    random = np.random.RandomState(7)
    sides = [((-6, -4, 0), (12, 0, 0), (0, 8, 0)), ((-6, -4, 0), (12, 0, 0), (0, 0, 3)), ((-6, 4, 0), (12, 0, 0), (0, 0, 3)),
             ((-6, -4, 0), (0, 8, 0), (0, 0, 3)), ((6, -4, 0), (0, 8, 0), (0, 0, 3)), ((2, 1, 0), (1.5, 0, 0), (0, 0, 1.8)),
             ((2, 1, 0), (0, 2, 0), (0, 0, 1.8)), ((-4, -2.5, 0), (0, 1.2, 0), (0, 0, 1.2)), ((-4, -2.5, 0), (2, 0, 0), (0, 0, 1.2))]
    areas = np.array([np.linalg.norm(np.cross(a, b)) for _, a, b in sides])
    chosen = random.choice(len(sides), count, p=areas / areas.sum())
    corner, a, b = (np.array([side[i] for side in sides], float)[chosen] for i in range(3))
    return corner + a * random.rand(count, 1) + b * random.rand(count, 1)


def planar(x, y, z, yaw):
    T = np.eye(4)
    T[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
    T[:3, 3] = x, y, z
    return T


TRUTH = planar(-1.0, 0.5, 1.2, 0.4)  # T_map_base
GUESS = TRUTH @ planar(*OFFSET)


def scan_at_truth():
    """Half of the points within 9 m, in the sensor's frame."""
    points = room()
    near = points[np.linalg.norm(points - TRUTH[:3, 3], axis=1) < 9.0][::2]
    return (near - TRUTH[:3, 3]) @ TRUTH[:3, :3]


def cloud_message(points, frame, stamp):
    message = PointCloud2(height=1, width=len(points), point_step=16, row_step=16 * len(points), is_dense=True)
    message.header.frame_id, message.header.stamp = frame, stamp
    message.fields = [PointField(name, 4 * i, PointField.FLOAT32, 1) for i, name in enumerate(('x', 'y', 'z', 'intensity'))]
    message.data = np.hstack([points, np.zeros((len(points), 1))]).astype('<f4').tobytes()
    return message


def fill_pose(pose, T):
    yaw = np.arctan2(T[1, 0], T[0, 0])
    pose.position.x, pose.position.y, pose.position.z = T[:3, 3]
    pose.orientation.z, pose.orientation.w = np.sin(yaw / 2), np.cos(yaw / 2)


def position_of(message):
    """Position and orientation of any of the types of poses, as seven numbers."""
    pose = message.transform if isinstance(message, TransformStamped) else message.pose
    pose = pose.pose if hasattr(pose, 'pose') else pose
    p = pose.translation if hasattr(pose, 'translation') else pose.position
    q = pose.rotation if hasattr(pose, 'rotation') else pose.orientation
    return np.array([p.x, p.y, p.z, q.x, q.y, q.z, q.w])


def write_pcd(path, points):
    with open(path, 'w', encoding='ascii') as file:
        file.write('# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n'
                   f'WIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA ascii\n')
        file.writelines(f'{x:.4f} {y:.4f} {z:.4f}\n' for x, y, z in points)
