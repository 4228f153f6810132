"""Localization in a map, without ROS: each class is told an initial pose and takes scan after scan.

Poses are T_map_base, scans are n x 3 in the base's frame, stamps are in seconds.
"""
import numpy as np
from localization_standins.geometry import difference, rotation, rotation_vector, shifted, transform
from localization_standins.ndt import NdtMap, align

CELLS = 1.6, 0.8  # m, coarse to fine


class NdtLocalizer:
    """Aligns some points of each scan from the pose of the scan before."""

    POINTS = 400

    def __init__(self, points):
        self.maps = [NdtMap(points, cell) for cell in CELLS]
        self.pose = None

    def initialise(self, pose, covariance=None, stamp=0.0):
        self.pose = pose

    def measure(self, scan, pose):
        scan = scan[::max(1, len(scan) // self.POINTS)]
        converged = True
        for ndt_map in self.maps:
            pose, converged = align(ndt_map, scan, pose)
        return pose, converged

    def update(self, scan, stamp):
        """The pose, or None if the alignment does not converge."""
        pose, converged = self.measure(scan, self.pose)
        if not converged:
            return None
        self.pose = pose
        return pose


class SmoothingLocalizer(NdtLocalizer):
    """A filter with constant velocity: goes half of the way to what it measures, at a rate of 10 Hz.

    Its gain grows with the time between scans; without any it averages (1/k), and after a long gap
    its velocity has carried it away.
    """

    NOISE = 0.01        # m^2, of a measurement
    GROWTH = 0.05       # m^2/s, of the state
    VELOCITY_GAIN = 0.05

    def initialise(self, pose, covariance=None, stamp=0.0):
        self.pose, self.stamp = pose, stamp
        self.variance = self.NOISE
        self.velocity = np.zeros(3)

    def update(self, scan, stamp):
        dt = max(0.0, stamp - self.stamp)
        self.stamp = stamp
        predicted = shifted(self.pose, self.velocity * dt, np.zeros(3))
        variance = self.variance + self.GROWTH * dt
        measured, converged = self.measure(scan, predicted)
        if not converged:
            return None
        gain = variance / (variance + self.NOISE)
        translation, rotated = difference(predicted, measured)
        self.pose = shifted(predicted, gain * translation, gain * rotated)
        self.variance = (1 - gain) * variance
        if dt > 0:
            self.velocity = self.velocity + self.VELOCITY_GAIN * gain * translation / dt
        return self.pose


class RunawayLocalizer(NdtLocalizer):
    """A filter whose velocity takes more than all of a correction for motion: it swings ever wider about a robot that stands still.

    It counts scans, not time, so that it swings alike on a machine that is busy.
    """

    POSITION_GAIN, VELOCITY_GAIN = 0.5, 3.2  # 2 a + b < 4 would be stable

    def initialise(self, pose, covariance=None, stamp=0.0):
        self.pose = self.measured = pose
        self.velocity = np.zeros(3)  # m per scan

    def update(self, scan, stamp):
        self.measured, _ = self.measure(scan, self.measured)
        predicted = self.pose[:3, 3] + self.velocity
        residual = self.measured[:3, 3] - predicted
        self.velocity = self.velocity + self.VELOCITY_GAIN * residual
        self.pose = transform(self.measured[:3, :3], predicted + self.POSITION_GAIN * residual)
        return self.pose


class ParticleLocalizer:
    """Particles drawn from the covariance of the initial pose, weighed by how well the scan fits.

    The same random numbers after every initial pose.
    """

    COUNT, POINTS = 300, 80
    SHRINK = 0.7  # of the spread from scan to scan

    def __init__(self, points):
        self.map = NdtMap(points, 1.0)
        self.poses = None

    def initialise(self, pose, covariance, stamp=0.0):
        self.random = np.random.default_rng(7)
        self.spread = np.sqrt(np.diag(covariance))
        self.poses = self._scattered(np.repeat(pose[None], self.COUNT, axis=0))
        self.poses[0] = pose

    def _scattered(self, poses):
        noise = self.random.normal(size=(len(poses), 6)) * self.spread
        poses = poses.copy()
        poses[:, :3, :3] = rotation(noise[:, 3:]) @ poses[:, :3, :3]
        poses[:, :3, 3] += noise[:, :3]
        return poses

    def _fits(self, scan):
        at = np.einsum('kij,nj->kni', self.poses[:, :3, :3], scan) + self.poses[:, None, :3, 3]
        which, _, _, scores = self.map.residuals(at.reshape(-1, 3))
        return np.bincount(which // len(scan), scores, minlength=len(self.poses))

    def update(self, scan, stamp):
        sample = scan[self.random.choice(len(scan), min(self.POINTS, len(scan)), replace=False)]
        fits = self._fits(sample)
        weights = np.exp((fits - fits.max()) / max(0.05 * fits.max(), 1e-9))
        weights /= weights.sum()
        best = self.poses[np.argmax(weights)]
        shifts = self.poses[:, :3, 3] - best[:3, 3]
        turns = np.array([rotation_vector(R @ best[:3, :3].T) for R in self.poses[:, :3, :3]])
        mean = transform(rotation(weights @ turns) @ best[:3, :3], best[:3, 3] + weights @ shifts)
        drawn = self.random.choice(self.COUNT, self.COUNT, p=weights)
        self.spread = self.spread * self.SHRINK
        self.poses = self._scattered(self.poses[drawn])
        self.poses[0] = mean
        return mean
