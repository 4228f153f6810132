"""Looks for answers in what a run shows on ROS interfaces.

A run is recorded as Records: numbers and texts with the place where they were seen. A LeakDetector
knows the transforms and the words that nobody may see, and reports where it sees them.

A single number within 1e-6 of one of the hundreds that are secret is no proof: in a run it happens
by chance now and then. So a leak is
- a run of numbers that spells a secret transform in one of the usual ways (translation, quaternion,
  pose, matrix, angles), anywhere, once; or
- three numbers in one record that belong to problems; or
- one number at the same place that belongs to the problem in flight, for two problems or more: what
  leaks, leaks for more than one; or
- a secret word, anywhere, once.

Clouds are published by design. What a client that remembers them can compute of them, which only an audit
keeps from it, is in relations().
"""
import collections
import re
import typing

import genpy
import numpy as np
from pcrb_testing_data import moved, points_of, rigid_fit, shifted, to_quaternion
from sensor_msgs.msg import PointCloud2

TOLERANCE = 1e-6
NUMBER = re.compile(r'[-+]?(?:\d+\.\d*|\.\d+|\d+)(?:[eE][-+]?\d+)?')


class Record(typing.NamedTuple):
    place: str            # topic, parameter, …
    moment: int           # index of the problem that was announced last, -1 before the first
    numbers: list         # (place within the record, number)
    texts: list
    raw: bytes = b''
    points: typing.Optional[np.ndarray] = None  # of a cloud, n x 3


def flatten(value, place=''):
    """Yields (place, number or text) of everything in a message, a parameter, or a text's numbers."""
    if isinstance(value, genpy.Message):
        for slot in value.__slots__:
            if (value._type, slot) != ('sensor_msgs/PointCloud2', 'data'):  # clouds are handed out by design
                yield from flatten(getattr(value, slot), f'{place}.{slot}')
    elif isinstance(value, genpy.TVal):
        yield place, value.to_sec()
    elif isinstance(value, dict):
        for key, entry in value.items():
            yield place, str(key)
            yield from flatten(entry, f'{place}/{key}')
    elif isinstance(value, (list, tuple)):
        for i, entry in enumerate(value):
            yield from flatten(entry, f'{place}[{i}]')
    elif isinstance(value, (str, bytes)):
        text = value if isinstance(value, str) else value.decode('latin-1')
        yield place, text
        for i, number in enumerate(NUMBER.findall(text)):
            yield f'{place}#{i}', float(number)
    else:
        yield place, float(value)


def record(place, moment, value, raw=b''):
    parts = list(flatten(value))
    numbers = [(where, part) for where, part in parts if not isinstance(part, str)]
    points = points_of(value) if getattr(value, '_type', '') == PointCloud2._type else None
    return Record(place, moment, numbers, [part for _, part in parts if isinstance(part, str)], raw, points)


def relations(records):
    """Records of what clouds tell beside each other: their middles, and the motions between clouds of one scan."""
    clouds = [seen for seen in records if seen.points is not None and len(seen.points)]
    for i, seen in enumerate(clouds):
        points = seen.points
        middles = {'centroid': points.mean(axis=0), 'middle': (points.min(axis=0) + points.max(axis=0)) / 2,
                   'first point': points[0], 'last point': points[-1]}
        for name, point in middles.items():
            yield record(f'{name} of {seen.place}', seen.moment, point.tolist())
        for earlier in clouds[:i]:
            if len(earlier.points) == len(points):
                T = rigid_fit(earlier.points, points)
                if np.abs(moved(T, earlier.points) - points).max() < 1e-3:
                    numbers = [*T[:3, 3], *to_quaternion(T), *T[:3].ravel()]
                    yield record(f'{earlier.place} onto {seen.place}', seen.moment, [float(number) for number in numbers])


def angles(R):
    """Rotation vector; roll, pitch, yaw."""
    angle = np.arccos(np.clip((np.trace(R) - 1) / 2, -1, 1))
    axis = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / (2 * np.sin(angle))
    return axis * angle, [np.arctan2(R[2, 1], R[2, 2]), -np.arcsin(R[2, 0]), np.arctan2(R[1, 0], R[0, 0])]


def spellings(T):
    """The usual ways to write a 4 x 4 down, as lists of 3, 4, 7, 9, 12 or 16 numbers."""
    R, t, q = T[:3, :3], T[:3, 3], to_quaternion(T)
    yield from (t, *angles(R))
    for sign in 1, -1:
        for quaternion in sign * q, sign * np.roll(q, 1):
            yield quaternion
            yield np.concatenate([t, quaternion])
            yield np.concatenate([quaternion, t])
    for matrix in R, T[:3], T:
        yield matrix.ravel()
        yield matrix.T.ravel()


def is_telling(number):
    """Not one that occurs by itself, as 0, 1 or 0.5 do."""
    return abs(number - round(2 * number) / 2) > 1e-3


class Secrets:
    """What must not be seen of one problem: transforms, in the local frame and in the clouds' own."""

    def __init__(self, transforms, origin=np.zeros(3)):
        """@param transforms  name -> 4 x 4 in the local frame."""
        self.spellings = collections.defaultdict(list)  # length -> [(name, numbers)]
        self.numbers = []
        for name, T in transforms.items():
            moved = T.copy()
            moved[:3, 3] += origin
            frames = {'': T, ', data set frame': shifted(T, -origin), ', moved by the origin': moved}
            for frame, X in frames.items() if origin.any() else [('', T)]:
                for inverse, Y in ('', X), ('^-1', np.linalg.inv(X)):
                    for numbers in spellings(Y):
                        if sum(map(is_telling, numbers)) >= 2:
                            self.spellings[len(numbers)].append((f'{name}{inverse}{frame}', numbers))
                        self.numbers.extend(filter(is_telling, numbers))
        self.numbers = np.unique(np.round(self.numbers, 9))

    def holds(self, numbers):
        """Which of the numbers belong to this problem."""
        i = np.clip(np.searchsorted(self.numbers, numbers), 1, len(self.numbers) - 1)
        distance = np.minimum(np.abs(self.numbers[i] - numbers), np.abs(self.numbers[i - 1] - numbers))
        return distance <= TOLERANCE


class LeakDetector:

    def __init__(self, secrets, words):
        """@param secrets  one Secrets per problem, in the order in which they were served."""
        self.secrets = secrets
        self.words = words

    def leaks(self, records):
        """One line per leak; none if nothing is given away."""
        found = []
        at_place = collections.defaultdict(set)  # place of a number -> problems that it belonged to
        for seen in records:
            found += self._words(seen)
            places = [place for place, number in seen.numbers if np.isfinite(number)]
            numbers = np.array([number for _, number in seen.numbers if np.isfinite(number)])
            if len(numbers) == 0:
                continue
            hits = np.array([secret.holds(numbers) for secret in self.secrets])
            if hits.any(axis=0).sum() >= 2:  # every spelling has two telling numbers
                found += self._spellings(seen, numbers)
            if len(set(numbers[hits.any(axis=0)])) >= 3:
                found.append(f'{seen.place}: {sorted(set(numbers[hits.any(axis=0)]))} belong to problems')
            for k, i in np.argwhere(hits):
                if k in (seen.moment, seen.moment + 1):
                    at_place[seen.place + places[i]].add(int(k))
        found += [f'{place}: a number of problems {sorted(problems)} each'
                  for place, problems in at_place.items() if len(problems) >= 2]
        return found

    def _words(self, seen):
        texts = [seen.place, *seen.texts]
        for word in self.words:
            if any(word in text for text in texts) or word.encode() in seen.raw:
                yield f'{seen.place}: `{word}`'

    def _spellings(self, seen, numbers):
        for k, secret in enumerate(self.secrets):
            for length, candidates in secret.spellings.items():
                if length > len(numbers):
                    continue
                windows = numbers[np.arange(len(numbers) - length + 1)[:, None] + np.arange(length)]
                for name, spelling in candidates:
                    if (np.abs(windows - spelling) <= TOLERANCE).all(axis=1).any():
                        yield f'{seen.place}: {length} numbers spell {name} of problem {k}'
