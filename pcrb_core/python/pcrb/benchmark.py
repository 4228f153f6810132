"""Problems one by one, and runs of a Python function: the server's problems, scores and files without ROS."""
import csv
import itertools
import math
import os
import time

import numpy as np

from . import _pcrb

KINDS = {'local': ['local'], 'global': ['global'], 'both': ['local', 'global']}


class Problem:
    """A registration problem as a client of the server sees it: both clouds in the target's local frame, m.

    id, data_set, sequence, kind: text, the official names
    target, source: (n, 3) float32; for the presentation `localization` the source is in its sensor's frame
    target_intensity, source_intensity: (n,) float32, or None where the clouds have none
    guess: (4, 4), T_target_source to start from; has_guess is False for global problems, whose guess means nothing
    voxel_leaf: m, edge of a voxel grid's cells that suits the data set's clouds
    index, count: which problem of how many this is
    """

    def __init__(self, run, fields, index):
        self.__dict__.update(fields)
        self.index, self.count, self._run = index, len(run), run

    def __repr__(self):
        return f'<pcrb.Problem {self.data_set}/{self.sequence} {self.kind} {self.id}, {self.index + 1} of {self.count}>'

    def score(self, pose):
        """What the benchmark says of a pose T_target_source, as long as no further problem was asked for.

        pose: (4, 4) or (3, 4), or a pair of position (3,) and quaternion (4,) as x y z w; or a pair of such a pose and its
            covariance (6, 6)
        Returns a dict: outcome, error, initial_misalignment, rotation_error_rad, translation_error_m and more, as a row of
        read_results.
        """
        return self._run.score(_submission(pose), 0.0)


def _submission(answer):
    """A pose as what a client submits; a matrix becomes the quaternion that a client in C++ sends for it."""
    if isinstance(answer, tuple) and len(answer) == 2:
        if np.shape(answer[1]) == (6, 6):
            return _pcrb.with_covariance(_submission(answer[0]), np.ravel(np.asarray(answer[1], dtype=np.float64)))
        position, orientation = (np.asarray(part, dtype=np.float64) for part in answer)
        if position.shape != (3,) or orientation.shape != (4,):
            raise ValueError(f'pose: found shapes {position.shape} and {orientation.shape}, expected (3,) and (4,)')
        return _pcrb.pose(position, orientation)
    rows = np.asarray(answer, dtype=np.float64)
    if rows.shape not in ((3, 4), (4, 4)):
        raise ValueError(f'pose: found shape {rows.shape}, expected (4, 4), (3, 4), or a pair of position and quaternion')
    return _pcrb.pose(*_pcrb.position_and_orientation(rows[:3]))


def selected(sequences, kind):
    """Words of a selection as a list, and the kinds that a word names."""
    if kind not in KINDS:
        raise _pcrb.InvalidParameter(f'kind: found `{kind}`, expected local, global or both')
    words = sequences.split() if isinstance(sequences, str) else sequences
    return [os.fsencode(word) for word in words], KINDS[kind]


def _open(root, sequences, kind, subset, seed, presentation, time_limit=math.inf, folder='', name=''):
    words, kinds = selected(sequences, kind)
    if not time_limit > 0:
        raise _pcrb.InvalidParameter(f'time_limit: found {time_limit}, expected more than 0 s')
    return _pcrb.Run(os.fsencode(root), words, kinds, subset, seed, presentation, time_limit, os.fsencode(folder), name)


def _problems(run):
    for index in itertools.count(run.done()):
        fields = run.next()
        if fields is None:
            return
        yield Problem(run, fields, index)


def problems(root, sequences='all', kind='local', subset=0, seed=1, presentation='registration'):
    """The problems below a root in the common layout, one by one, in the order of their files.

    sequences: words of a selection (see select_sequences), as text or as a list; kind: local, global or both
    subset: a stratified random draw of so many with the seed; 0 = all
    presentation: registration, or localization
    Returns an iterator over Problem. Nothing is kept: for a run with results see run().
    Raises InvalidFile, InvalidProblem, InvalidParameter, as the benchmark server does.
    """
    return _problems(_open(root, sequences, kind, subset, seed, presentation))


def run(function, root, folder, sequences='all', kind='local', subset=0, seed=1, presentation='registration', time_limit=30.0,
        name=None, progress=None):
    """Benchmarks a function, in the folder of a run like the server's: results.sqlite, results.csv, summary.txt.

    function: takes a Problem and returns T_target_source, (4, 4) or (3, 4), or a pair of position (3,) and quaternion (4,) as
        x y z w; or a pair of such a pose and its covariance, (6, 6), x y z rx ry rz in m and rad in the target's frame, which
        the report judges. An exception, or None, is the outcome `failed`, with its text as the reason; an answer after time_limit (s)
        counts as none.
    folder: of the run; each result is on the disk before the next problem is shown, so that an interrupted run goes on. It
        takes one configuration only, and one name (default: the function's).
    progress: is called with each row
    Other arguments: as of problems(), in a secret order.
    Returns the results of all problems, as read_results does.
    Raises as problems(), and StoreError if the folder holds another run.
    """
    opened = _open(root, sequences, kind, subset, seed, presentation, time_limit, folder,
                   name or getattr(function, '__name__', type(function).__name__))
    for problem in _problems(opened):
        start = time.perf_counter()
        submission = _answer(function, problem)
        row = opened.submit(submission, time.perf_counter() - start)
        if progress is not None:
            progress(row)
    opened.finish()
    from . import read_results
    return read_results(folder)


def _answer(function, problem):
    try:
        answer = function(problem)
        return _pcrb.failure('the function returned None') if answer is None else _submission(answer)
    except Exception as error:  # whatever a method of the user's ends in is its outcome
        return _pcrb.failure(os.fsencode(f'{type(error).__name__}: {error}'))


# What pcrb report --import takes of a file, and results.csv has, in this order.
COLUMNS = ('data_set', 'sequence', 'kind', 'problem_id', 'source', 'target', 'overlap', 'outcome', 'reason', 'error',
           'initial_misalignment', 'rotation_error_rad', 'translation_error_m', 'runtime_s', 'solver_time_s')
NEEDED = ('sequence', 'kind', 'problem_id', 'error')


def write_results(path, rows):
    """Writes results that were computed elsewhere as a file for `pcrb report --import`: columns of results.csv.

    rows: dicts. sequence, kind (local or global), problem_id and error (>= 0) must be there; data_set, source, target, overlap,
        outcome (replied, failed, timed_out, rejected, skipped), reason, initial_misalignment, rotation_error_rad,
        translation_error_m, runtime_s and solver_time_s may be, the same in all rows. None and nan are empty fields.
    Writes RFC 4180 with a header, numbers so that they read back to the same doubles.
    Raises InvalidParameter for a column that is not known or missing, or an error that is no number >= 0.
    """
    rows = [dict(row) for row in rows]
    given = {name for row in rows for name in row}
    unknown = sorted(given - set(COLUMNS))
    if unknown:
        raise _pcrb.InvalidParameter(f'found column `{unknown[0]}`, expected some of {", ".join(COLUMNS)}')
    for number, row in enumerate(rows):
        missing = [name for name in NEEDED if row.get(name) in (None, '')]
        if missing:
            raise _pcrb.InvalidParameter(f'row {number}: found no {missing[0]}')
        if not (math.isfinite(row['error']) and row['error'] >= 0):
            raise _pcrb.InvalidParameter(f'row {number}: found error {row["error"]}, expected a number >= 0')
    columns = [name for name in COLUMNS if name in given or name in NEEDED]
    with open(path, 'w', encoding='utf-8', errors='surrogateescape', newline='') as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows([_text(row.get(name)) for name in columns] for row in rows)


def _text(value):
    if value is None or (isinstance(value, (float, np.floating)) and math.isnan(value)):
        return ''
    return repr(float(value)) if isinstance(value, (float, np.floating)) else str(value)
