"""A small data set in the common layout, made of rooms, and the benchmark's maths on its problems.

Same arguments, same bytes. Sequence `kitchen` lies near the origin and has no viewpoints; `hall`
has viewpoints and lies where a map projection would put it, some 10^6 m away.
"""
import os
import typing
import zlib

import numpy as np

HEADER = 'id source target overlap ' + ' '.join(f't{i}' for i in range(1, 13))
SEQUENCES = {'kitchen': ('k_0417.pcd', 'k_0528.pcd', 'k_0963.pcd'), 'hall': ('h_2741.pcd', 'h_3852.pcd', 'h_9074.pcd')}
OFFSETS = {'kitchen': np.zeros(3), 'hall': np.array([332417.25, 4151360.5, 41.75])}
PAIRS = ((0, 1), (2, 1), (1, 2))
PERTURBATIONS_PER_PAIR = 31  # as in the published lists: 30 local ones and a global one


class Problem(typing.NamedTuple):
    """One row of a problem file; P is 4 x 4, in the frame of the clouds' files."""
    sequence: str
    kind: str
    id: str
    source: str
    target: str
    P: np.ndarray

    @property
    def key(self):
        return self.sequence, self.kind, self.id


def transform(rotation, translation):
    T = np.eye(4)
    T[:3, :3] = rotation
    T[:3, 3] = translation
    return T


def axis_angle(axis, angle):
    """Rotation matrix (Rodrigues)."""
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def from_pose(pose):
    """4 x 4 of a geometry_msgs/Pose."""
    q, p = pose.orientation, pose.position
    return from_quaternion([p.x, p.y, p.z], [q.x, q.y, q.z, q.w])


def from_quaternion(translation, quaternion):
    x, y, z, w = np.asarray(quaternion) / np.linalg.norm(quaternion)
    return transform([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]], translation)


def to_quaternion(T):
    """x y z w with w >= 0 of the rotation of a 4 x 4: the eigenvector of Bar-Itzhack's matrix."""
    R = T[:3, :3]
    K = np.array([[R[0, 0] - R[1, 1] - R[2, 2], 0, 0, 0],
                  [R[0, 1] + R[1, 0], R[1, 1] - R[0, 0] - R[2, 2], 0, 0],
                  [R[0, 2] + R[2, 0], R[1, 2] + R[2, 1], R[2, 2] - R[0, 0] - R[1, 1], 0],
                  [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], R.trace()]])
    q = np.linalg.eigh(K, UPLO='L')[1][:, 3]
    return q if q[3] >= 0 else -q


def fill_pose(pose, T):
    """Writes a 4 x 4 into a geometry_msgs/Pose, which is returned."""
    q = pose.orientation
    pose.position.x, pose.position.y, pose.position.z = (float(t) for t in T[:3, 3])
    q.x, q.y, q.z, q.w = (float(entry) for entry in to_quaternion(T))
    return pose


def moved(T, points):
    return points @ T[:3, :3].T + T[:3, 3]


def points_of(message):
    """x y z of a sensor_msgs/PointCloud2 of this suite, n x 3."""
    return np.frombuffer(message.data, np.float32).reshape(message.width, -1)[:, :3].astype(float)


def rigid_fit(points, images):
    """The 4 x 4 that takes points to images best (Kabsch)."""
    a, b = points.mean(axis=0), images.mean(axis=0)
    u, _, vt = np.linalg.svd((points - a).T @ (images - b))
    R = vt.T @ np.diag([1, 1, np.linalg.det(vt.T @ u.T)]) @ u.T
    return transform(R, b - R @ a)


def error(points, T_residual):
    """Equation 1 of Fontana et al. 2021, as it is written."""
    p = moved(T_residual, points)
    return float(np.mean(np.linalg.norm(p - points, axis=1) / np.linalg.norm(p - p.mean(axis=0), axis=1)))


def shifted(T, origin):
    """The same motion in a frame whose origin lies at `origin`: Trans(-o) T Trans(o)."""
    return transform(T[:3, :3], T[:3, 3] + (T[:3, :3] - np.eye(3)) @ origin)


def shifted_pose(T, origin):
    """A pose in a frame whose origin lies at `origin`."""
    return transform(T[:3, :3], T[:3, 3] - origin)


def local_origin(target_points):
    """What the server takes for a target: the centre of its box, on a grid of 100 m."""
    center = (target_points.min(axis=0) + target_points.max(axis=0)) / 2
    return np.round(center / 100) * 100


class DataSet:
    """Files below `root`, data set `rooms`; see make_data_set()."""

    def __init__(self, root):
        self.root = root
        self.problems = []  # in the order of the files
        self.clouds = {}    # (sequence, file) -> points as the file has them, n x 3
        self.viewpoints = {}

    def folder(self, *path):
        return os.path.join(self.root, 'rooms', *path)

    def by_id(self, official_id):
        return next(problem for problem in self.problems if problem.id == official_id)

    def of(self, kind, sequence=None):
        return [p for p in self.problems if p.kind == kind and sequence in (None, p.sequence)]

    def source_points(self, problem):
        """In the problem's local frame."""
        return self.clouds[problem.sequence, problem.source] - self.origin(problem)

    def origin(self, problem):
        return local_origin(self.clouds[problem.sequence, problem.target])

    def local_P(self, problem):
        return shifted(problem.P, self.origin(problem))

    def write_problems(self, sequence, kind):
        with open(self.folder(f'{sequence}_{kind}.txt'), 'w') as file:
            print(HEADER, file=file)
            for p in self.of(kind, sequence):
                entries = ' '.join(repr(float(entry)) for entry in p.P[:3].ravel())
                print(f'{p.id} {p.source} {p.target} 0.7500 {entries}', file=file)


def _room(random):
    """Points of walls, a floor and furniture, 9 x 7 x 3 m, about evenly over their surfaces."""
    boxes = [((-4.5, -3.5, 0.0), (4.5, 3.5, 3.0))]  # the room itself, then what stands in it
    for _ in range(9):
        corner = random.uniform((-4.2, -3.2, 0.0), (3.0, 2.0, 0.1))
        boxes.append((corner, corner + random.uniform((0.4, 0.4, 0.5), (1.2, 1.2, 1.8))))
    parts = []
    for low, high in boxes:
        low, size = np.array(low), np.subtract(high, low)
        for axis in range(3):
            area = np.prod(np.delete(size, axis))
            for side in (0.0, 1.0):
                points = random.uniform(0, 1, (int(area * 90), 3))
                points[:, axis] = side
                parts.append(low + points * size)
    points = np.vstack(parts)
    return points + random.normal(0, 0.005, points.shape)


def _scan(random, room, sensor, count):
    """The part of a room that a sensor sees, denser where it is near."""
    weight = 1 / (0.5 + np.sum((room - sensor) ** 2, axis=1))
    return room[random.choice(len(room), count, replace=False, p=weight / weight.sum())]


def _perturbation(random, center, kind):
    """Rotation about the centre, then a translation; no entry is a number that may occur by itself."""
    bounds = {'local': ((0.1, 0.35), (4, 12)), 'global': ((5.0, 9.0), (60, 150))}[kind]
    direction, axis = random.normal(size=3), random.normal(size=3)
    R = axis_angle(axis, np.radians(random.uniform(*bounds[1])))
    t = direction / np.linalg.norm(direction) * random.uniform(*bounds[0])
    return transform(R, t - (R - np.eye(3)) @ center)


def write_cloud(path, points, viewpoint=np.eye(4)):
    """ASCII PCD; the viewpoint is a 4 x 4."""
    x, y, z, w = (0, 0, 0, 1) if np.array_equal(viewpoint, np.eye(4)) else to_quaternion(viewpoint)
    pose = ' '.join(repr(float(number)) for number in (*viewpoint[:3, 3], w, x, y, z))
    with open(path, 'w') as file:
        file.write('# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n'
                   f'TYPE F F F\nCOUNT 1 1 1\nWIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT {pose}\n'
                   f'POINTS {len(points)}\nDATA ascii\n')
        file.writelines(f'{x!r} {y!r} {z!r}\n' for x, y, z in points.tolist())


def _add_clouds(data, random, sequence, points):
    room = _room(random)
    for i, name in enumerate(SEQUENCES[sequence]):
        sensor = np.array([-1.5 + 1.5 * i, 0.4 * i - 0.5, 1.2]) + random.normal(0, 0.05, 3)
        # Clouds differ in size, by which a recorded message tells what it shows.
        count = points + 10 * i + 5 * (sequence == 'hall')
        cloud = np.round(_scan(random, room, sensor, count) + OFFSETS[sequence], 4)
        tilt = axis_angle(random.normal(size=3), 0.1 + 0.2 * i)
        viewpoint = transform(tilt, sensor + OFFSETS[sequence]) if sequence == 'hall' else np.eye(4)
        data.clouds[sequence, name] = cloud
        data.viewpoints[sequence, name] = viewpoint
        write_cloud(data.folder(sequence, name), cloud, viewpoint)


def make_data_set(root, points=2000, perturbations=2):
    """Writes the data set `rooms` below a folder.

    For each of three pairs of a sequence there are some local perturbations and a global one; ids
    are as in the published files. Points per cloud: about `points`.
    """
    data = DataSet(root)
    random = np.random.default_rng(20210401)
    for sequence, names in SEQUENCES.items():
        os.makedirs(data.folder(sequence))
        _add_clouds(data, random, sequence, points)
        crc = zlib.crc32(sequence.encode())
        digits = len(str(PERTURBATIONS_PER_PAIR * 100 - 1))
        for k, (source, target) in enumerate(PAIRS):
            center = data.clouds[sequence, names[source]].mean(axis=0)
            for i, kind in [*((i, 'local') for i in range(perturbations)), (30, 'global')]:
                official_id = f'{crc}{PERTURBATIONS_PER_PAIR * k + i:0{digits}}'
                data.problems.append(Problem(sequence, kind, official_id, names[source], names[target],
                                             _perturbation(random, center, kind)))
        for kind in ('local', 'global'):
            data.write_problems(sequence, kind)
    return data
