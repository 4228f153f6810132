"""The benchmark's metric and files, in Python: a thin layer over the C++ library pcrb_core.

Clouds are anything that numpy makes an array of shape (n, 3) of, or that has such a thing as its attribute `points`
(an open3d.geometry.PointCloud, for instance); in m, in one frame. Poses and perturbations are arrays of shape (4, 4) or
(3, 4), p_new = R p + t, rigid to 1e-6. What a function returns is numpy in double precision.

Errors are subclasses of pcrb.Error and say what was found and what was expected: InvalidFile (with file and line),
InvalidProblem, InvalidParameter, StoreError. An argument of the wrong shape is a ValueError.
"""
import os

import numpy as np

from . import _pcrb
from ._pcrb import Error, InvalidFile, InvalidParameter, InvalidProblem, StoreError

__all__ = ['Error', 'InvalidFile', 'InvalidParameter', 'InvalidProblem', 'StoreError', 'error', 'evaluate',
           'Problem', 'find_sequences', 'make_perturbation', 'methods', 'perturb', 'problems', 'read_pcd', 'read_problems', 'read_results', 'read_run_info',
           'run', 'select_sequences', 'write_pcd', 'write_problems', 'write_results']


def _points(cloud, name):
    points = np.ascontiguousarray(getattr(cloud, 'points', cloud), dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f'{name}: found shape {points.shape}, expected (n, 3)')
    return points


def _rows(transform, name):
    rows = np.asarray(transform, dtype=np.float64)
    if rows.shape not in ((3, 4), (4, 4)):
        raise ValueError(f'{name}: found shape {rows.shape}, expected (4, 4) or (3, 4)')
    if rows.shape == (4, 4) and not np.array_equal(rows[3], [0, 0, 0, 1]):
        raise ValueError(f'{name}: found the last row {rows[3]}, expected 0 0 0 1')
    return rows[:3]


def _matrix(transform, name):
    return np.vstack([_rows(transform, name), [0, 0, 0, 1]])


def error(aligned, ground_truth):
    """The benchmark's error of corresponding clouds: Fontana et al. 2021, eq. 1.

    The mean, over the points, of |p_i - g_i| / |p_i - centroid of all p_i|. Points within 1e-9 m of the centroid are
    left out.

    aligned: cloud, p_i, where a registration put the points, m
    ground_truth: cloud, g_i, where they belong, m, same frame, same length
    Returns a float: dimensionless, >= 0, 0 is perfect.
    Raises InvalidProblem if the lengths differ, a coordinate is not finite, or no point carries weight.
    """
    return _pcrb.error(_points(aligned, 'aligned'), _points(ground_truth, 'ground_truth'))


def evaluate(source, T_residual):
    """Scores a pose, as the benchmark server does.

    source: cloud at ground truth, m
    T_residual: what is left of the perturbation, in the source's frame: estimated pose @ what was applied, for a problem
        reply @ perturbation; the identity is perfect
    Returns a dict: error (eq. 1, dimensionless), rotation_error_rad (rad, 0 to pi), translation_error_m (m, at the
    source's centroid), mean_distance_m (m, mean distance between each point and its image).
    Points are float32 near a local origin, as the server has them: errors differ from those in double by about 1e-9.
    Raises InvalidProblem if T_residual is not rigid, or no point carries weight.
    """
    return _pcrb.evaluate(_points(source, 'source'), _rows(T_residual, 'T_residual'))


def make_perturbation(source, translation, rotation):
    """A rotation about the source's centroid, then a translation: Fontana et al. 2021, section 3.1.

    source: cloud, m
    translation: (3,), m
    rotation: (3, 3), a rotation matrix
    Returns P, (4, 4), in the source's frame.
    Raises InvalidProblem if the rotation is none, or the cloud is empty.
    """
    translation = np.asarray(translation, dtype=np.float64)
    rotation = np.asarray(rotation, dtype=np.float64)
    if translation.shape != (3,) or rotation.shape != (3, 3):
        raise ValueError(f'found shapes {translation.shape} and {rotation.shape}, expected (3,) and (3, 3)')
    return _pcrb.perturbation_about(_points(source, 'source'), translation, rotation)


def perturb(source, perturbation):
    """The source as a problem hands it out: P p for each of its points.

    source: cloud at ground truth, m; perturbation: P, (4, 4), e.g. of read_problems
    Returns an array of shape (n, 3), m.
    Raises InvalidProblem if P is not rigid or a coordinate is not finite.
    """
    return _pcrb.move(_points(source, 'source'), _rows(perturbation, 'perturbation'))


def read_pcd(path, threads=1):
    """Reads a PCD file (ascii, binary, binary_compressed), coordinates in double.

    Returns a dict: points (n, 3) in m, finite; intensity (n,) float32 or None; viewpoint (4, 4), the sensor's pose, or
    None where the file has none; dropped_non_finite, the number of points that were left out.
    Raises InvalidFile with file and line.
    """
    return _pcrb.read_pcd(os.fsencode(path), threads)


def write_pcd(path, cloud, viewpoint=None):
    """Writes a cloud (m) as an ASCII PCD file that reads back to the same doubles; viewpoint is the sensor's pose.

    Raises InvalidFile if it cannot be written completely, InvalidProblem for a point that is not finite.
    """
    rows = None if viewpoint is None else _rows(viewpoint, 'viewpoint')
    _pcrb.write_pcd(os.fsencode(path), _points(cloud, 'cloud'), rows)


def read_problems(path):
    """Reads a problem file.

    Returns a list of dicts, in the file's order: id (str), source and target (file names), overlap (0 to 1),
    perturbation (4, 4), in the data set's frame.
    Raises InvalidFile with file and line.
    """
    return _pcrb.read_problems(os.fsencode(path))


def write_problems(path, problems):
    """Writes dicts as read_problems returns them; the published files come out byte for byte.

    Raises InvalidProblem for a row that read_problems would refuse, InvalidFile if the file cannot be written.
    """
    rows = [dict(problem, perturbation=_matrix(problem['perturbation'], 'perturbation'),
                 **{name: os.fsencode(problem[name]) for name in ('id', 'source', 'target')}) for problem in problems]
    _pcrb.write_problems(os.fsencode(path), rows)


def find_sequences(root):
    """The problem files below a root in the common layout.

    Returns a list of tuples: data set, sequence, kind (`local` or `global`), path; sorted.
    Raises InvalidFile if the root is no readable folder.
    """
    return _pcrb.find_sequences(os.fsencode(root))


def select_sequences(known, words):
    """Those of known sequences that words name: `all`, a sequence, a data set, or `data_set/sequence`; the rule of all programs.

    known: pairs (data set, sequence)
    Returns a list of them, in their order.
    Raises InvalidParameter for a word that names none.
    """
    known = [tuple(pair) for pair in known]
    names = [tuple(map(os.fsencode, pair)) for pair in known]
    return [known[i] for i in _pcrb.select_sequences(names, [os.fsencode(word) for word in words])]


def methods():
    """Returns the names of the suite's registration methods, sorted."""
    return _pcrb.methods()


def read_results(run):
    """The results of a run, column by column.

    run: a run's folder (the one with results.sqlite), finished or not
    Returns a dict of arrays of one length: data_set, sequence, kind, problem_id, source, target, outcome, reason (text);
    overlap, error, initial_misalignment (dimensionless), rotation_error_rad, translation_error_m, runtime_s,
    solver_time_s (nan where unknown); position (n, 3) in m and orientation (n, 4) as x y z w, the accepted reply
    T_target_source (nan where there is none); covariance (n, 6, 6), that of the reply, x y z rx ry rz in m and rad (nan where
    there is none).
    Raises StoreError if there is no store that can be read.
    """
    rows = _pcrb.read_results(os.fsencode(run))
    texts = ('data_set', 'sequence', 'kind', 'problem_id', 'source', 'target', 'outcome', 'reason')
    numbers = ('overlap', 'error', 'initial_misalignment', 'rotation_error_rad', 'translation_error_m', 'runtime_s',
               'solver_time_s')
    columns = {name: np.array([row[name] for row in rows], dtype=np.str_) for name in texts}
    columns.update({name: np.array([np.nan if row[name] is None else row[name] for row in rows], dtype=np.float64)
                    for name in numbers})
    for name, shape in (('position', (3,)), ('orientation', (4,)), ('covariance', (6, 6))):
        unknown = np.full(shape, np.nan)
        values = [unknown if row[name] is None else np.reshape(row[name], shape) for row in rows]
        columns[name] = np.array(values, dtype=np.float64).reshape(len(rows), *shape)
    return columns


def read_run_info(run):
    """The table `run` of a run's store: a dict of text. It has the run's secret bits: not for a node under test."""
    return _pcrb.read_run_info(os.fsencode(run))


from .benchmark import Problem, problems, run, write_results  # noqa: E402  (they use what is above)
