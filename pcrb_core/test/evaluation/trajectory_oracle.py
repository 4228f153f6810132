#!/usr/bin/python3
"""Recomputes the numbers of trajectory_error_test.cpp by quaternions and numpy, from the definitions that
evo documents (metrics.py and geometry.py of evo 1.x): evo itself is no Debian package. Prints the
statistics rmse, mean, median, std, min, max, sse of each error.

Usage: trajectory_oracle.py TRUTH.tum ESTIMATE.tum [DELTA]
"""
import sys

import numpy as np


def product(p, q):
    """Hamilton product of quaternions x y z w."""
    v, u = p[:3], q[:3]
    return np.append(p[3] * u + q[3] * v + np.cross(v, u), p[3] * q[3] - v @ u)


def conjugate(q):
    return q * [-1, -1, -1, 1]


def rotate(q, v):
    return product(product(q, np.append(v, 0)), conjugate(q))[:3]


def relative(a, b):
    """a^-1 b of poses (t, q)."""
    return rotate(conjugate(a[1]), b[0] - a[0]), product(conjugate(a[1]), b[1])


def angle_deg(q):
    return np.degrees(2 * np.arctan2(np.linalg.norm(q[:3]), abs(q[3])))


def read(path):
    rows = np.loadtxt(path)
    return [(row[1:4], row[4:8] / np.linalg.norm(row[4:8])) for row in rows]


def aligned_positions(truth, estimate):
    """Horn's quaternion method: another way to the least squares of Umeyama."""
    y, x = np.array([t for t, _ in truth]), np.array([t for t, _ in estimate])
    S = (x - x.mean(axis=0)).T @ (y - y.mean(axis=0))
    d = np.array([S[1, 2] - S[2, 1], S[2, 0] - S[0, 2], S[0, 1] - S[1, 0]])
    N = np.block([[S + S.T - np.trace(S) * np.eye(3), d[:, None]], [d[None], np.array([[np.trace(S)]])]])
    q = np.linalg.eigh(N)[1][:, -1]
    return [rotate(q, t - x.mean(axis=0)) + y.mean(axis=0) for t in x]


def show(name, errors):
    e = np.array(errors)
    values = np.sqrt(np.mean(e**2)), e.mean(), np.median(e), e.std(), e.min(), e.max(), np.sum(e**2)
    print(name, ', '.join(f'{value:.15g}' for value in values))


truth, estimate = read(sys.argv[1]), read(sys.argv[2])
delta = int(sys.argv[3]) if len(sys.argv) > 3 else 1
show('APE translation', [np.linalg.norm(b[0] - a[0]) for a, b in zip(truth, estimate)])
show('APE rotation deg', [angle_deg(relative(b, a)[1]) for a, b in zip(truth, estimate)])
show('APE translation, aligned',
     [np.linalg.norm(b - a[0]) for a, b in zip(truth, aligned_positions(truth, estimate))])
pairs = [(i, i + delta) for i in range(0, len(truth) - delta, delta)]
errors = [relative(relative(truth[i], truth[j]), relative(estimate[i], estimate[j])) for i, j in pairs]
show('RPE translation', [np.linalg.norm(t) for t, _ in errors])
show('RPE rotation deg', [angle_deg(q) for _, q in errors])
