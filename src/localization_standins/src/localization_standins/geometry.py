"""Rigid transforms as 4 x 4 matrices."""
import numpy as np


def rotation(vector):
    """Rotation matrices of rotation vectors, ... x 3 -> ... x 3 x 3."""
    vector = np.asarray(vector, float)
    angle = np.linalg.norm(vector, axis=-1)[..., None, None]
    K = cross_matrix(vector)
    with np.errstate(invalid='ignore', divide='ignore'):
        a = np.where(angle < 1e-8, 1.0, np.sin(angle) / angle)
        b = np.where(angle < 1e-8, 0.5, (1 - np.cos(angle)) / angle ** 2)
    return np.eye(3) + a * K + b * K @ K


def rotation_vector(R):
    """Of one rotation matrix, angle below pi."""
    axis = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine = np.linalg.norm(axis)
    angle = np.arctan2(sine, (np.trace(R) - 1) / 2)
    return axis if sine < 1e-12 else axis * (angle / sine)


def cross_matrix(v):
    """Skew-symmetric matrices of vectors, ... x 3 -> ... x 3 x 3."""
    x, y, z = np.moveaxis(v, -1, 0)
    o = np.zeros_like(x)
    return np.stack([np.stack([o, -z, y], -1), np.stack([z, o, -x], -1), np.stack([-y, x, o], -1)], -2)


def transform(R, t):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, t
    return T


def moved(T, points):
    return points @ T[:3, :3].T + T[:3, 3]


def inverse(T):
    return transform(T[:3, :3].T, -T[:3, :3].T @ T[:3, 3])


def difference(a, b):
    """What takes pose a to pose b: translation and rotation vector in the map's axes."""
    return b[:3, 3] - a[:3, 3], rotation_vector(b[:3, :3] @ a[:3, :3].T)


def shifted(T, translation, rotated):
    """The inverse of difference(): pose T moved by that much."""
    return transform(rotation(rotated) @ T[:3, :3], T[:3, 3] + translation)


def from_quaternion(t, q):
    x, y, z, w = np.asarray(q) / np.linalg.norm(q)
    return transform([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]], t)


def to_quaternion(T):
    """x y z w: the eigenvector of Bar-Itzhack's matrix to its largest eigenvalue."""
    R = T[:3, :3]
    K = np.array([[R[0, 0] - R[1, 1] - R[2, 2], 0, 0, 0],
                  [R[0, 1] + R[1, 0], R[1, 1] - R[0, 0] - R[2, 2], 0, 0],
                  [R[0, 2] + R[2, 0], R[1, 2] + R[2, 1], R[2, 2] - R[0, 0] - R[1, 1], 0],
                  [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], np.trace(R)]])
    return np.linalg.eigh(K, UPLO='L')[1][:, 3]
