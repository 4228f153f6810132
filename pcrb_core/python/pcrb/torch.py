"""The benchmark's problems as a data set of PyTorch, and a loop that scores a model on them.

PyTorch is imported here and nowhere else; without it samples hold numpy arrays, and all else is the same.

    data = pcrb.torch.RegistrationDataset('/data/pcrb', sequences='eth', kind='local')
    loader = torch.utils.data.DataLoader(data, batch_size=4, collate_fn=pcrb.torch.collate, num_workers=2)
    rows = pcrb.torch.score_model(model, data, path='mymodel_eth_local.csv')   # for pcrb report --import
"""
import os

import numpy as np

from . import _pcrb, evaluate, read_pcd
from .benchmark import selected, write_results

try:
    import torch
    _Base = torch.utils.data.Dataset
except ImportError:
    torch, _Base = None, object

KEPT_CLOUDS = 4  # of the files that were read last


class RegistrationDataset(_Base):
    """Problems below a root in the common layout, by number; each the same whenever it is asked for.

    root: folder of the data sets; sequences: words of a selection, as text or list; kind: local, global or both
    subset, seed: a stratified random draw of so many; 0 = all
    transform: is given each sample and returns what is used in its place (a voxel grid, a subset of the points, …)
    A sample is a dict: source (n, 3) and target (m, 3), float32, m, both in the target's local frame, the source as it is
    handed out; guess and truth (4, 4), float64, T_target_source to start from and to arrive at; id, data_set, sequence, kind
    (text); overlap, voxel_leaf (m, of the data set).
    Raises InvalidFile, InvalidProblem, InvalidParameter, as the benchmark server does.
    """

    def __init__(self, root, sequences='all', kind='local', subset=0, seed=1, transform=None):
        self._problems = _pcrb.plan(os.fsencode(root), *selected(sequences, kind), subset, seed)
        self._transform = transform
        self._clouds = {}

    def __len__(self):
        return len(self._problems)

    def __getitem__(self, index):
        sample = self._sample(index)
        return self._transform(sample) if self._transform else sample

    def _sample(self, index):
        problem = self._problems[index]
        target = self._cloud(problem['target_path'])
        origin = np.asarray(_pcrb.local_origin(target))
        P = _in_frame(problem['perturbation'], origin)
        source = (self._cloud(problem['source_path']) - origin) @ P[:3, :3].T + P[:3, 3]
        sample = {'source': source.astype(np.float32), 'target': (target - origin).astype(np.float32),
                  'guess': np.eye(4), 'truth': _inverse(P)}
        sample = {name: _array(value) for name, value in sample.items()}
        return {**sample, **{name: problem[name] for name in ('id', 'data_set', 'sequence', 'kind', 'overlap', 'voxel_leaf')}}

    def _cloud(self, path):
        points = self._clouds.pop(path, None)
        if points is None:
            points = read_pcd(path)['points']
        self._clouds[path] = points  # the newest is the last
        while len(self._clouds) > KEPT_CLOUDS:
            del self._clouds[next(iter(self._clouds))]
        return points

    def score(self, index, pose, reason=''):
        """The row of results of an answer to a problem.

        pose: T_target_source (4, 4) or (3, 4) for the sample of that index, or None: failed, for that reason, and scored with
            the initial guess.
        Returns a dict with the columns of results.csv that are known here.
        Raises InvalidProblem if the pose is not rigid to 1e-4; ValueError for another shape.
        """
        problem = self._problems[index]
        source = self._cloud(problem['source_path'])
        origin = np.asarray(_pcrb.local_origin(self._cloud(problem['target_path'])))
        P = _in_frame(problem['perturbation'], origin)
        reply = np.eye(4) if pose is None else _matrix(pose)
        initial = evaluate(source - origin, P)
        score = evaluate(source - origin, reply @ P)
        row = {name: problem[name] for name in ('data_set', 'sequence', 'kind', 'source', 'target', 'overlap')}
        row.update(problem_id=problem['id'], outcome='failed' if pose is None else 'replied', reason=reason,
                   initial_misalignment=initial['error'],
                   **{name: score[name] for name in ('error', 'rotation_error_rad', 'translation_error_m')})
        return row


def score_model(model, dataset, path=None, progress=None):
    """Scores a model on a data set, as the benchmark scores a client.

    model: takes a sample of the data set and returns T_target_source, (4, 4) or (3, 4), tensor or array; None and an
        exception are the outcome `failed`, scored with the initial guess. A torch module is put into eval mode, and no
        gradients are computed.
    path: file that the rows are written to, for pcrb report --import; progress: is called with each row
    Returns a list of rows (RegistrationDataset.score).
    """
    if hasattr(model, 'eval'):
        model.eval()
    rows = []
    for index in range(len(dataset)):
        rows.append(_row(model, dataset, index))
        if progress is not None:
            progress(rows[-1])
    if path is not None:
        write_results(path, rows)
    return rows


def _row(model, dataset, index):
    try:
        if torch is None:
            pose = model(dataset[index])
        else:
            with torch.no_grad():
                pose = model(dataset[index])
        return dataset.score(index, pose, 'the model returned None' if pose is None else '')
    except (_pcrb.InvalidFile, KeyboardInterrupt):
        raise
    except Exception as error:  # whatever a model ends in is its outcome
        return dataset.score(index, None, f'{type(error).__name__}: {error}')


def collate(samples):
    """A batch of samples: a dict of lists, since clouds have different sizes; poses (and only they) are stacked."""
    batch = {name: [sample[name] for sample in samples] for name in samples[0]}
    for name in ('guess', 'truth'):
        batch[name] = (np if torch is None else torch).stack(batch[name])
    return batch


def _array(value):
    return value if torch is None else torch.from_numpy(value)


def _matrix(pose):
    if hasattr(pose, 'detach'):
        pose = pose.detach().cpu().numpy()
    rows = np.asarray(pose, dtype=np.float64)
    if rows.shape not in ((3, 4), (4, 4)):
        raise ValueError(f'pose: found shape {rows.shape}, expected (4, 4) or (3, 4)')
    matrix = np.eye(4)
    matrix[:3] = rows[:3]
    u, s, v = np.linalg.svd(matrix[:3, :3])
    if np.linalg.det(u @ v) > 0 and np.abs(s - 1).max() < 1e-4:  # single precision is not rigid to 1e-6
        matrix[:3, :3] = u @ v
    return matrix


def _in_frame(T, origin):
    """The same transform for points relative to an origin."""
    moved = np.array(T, dtype=np.float64)
    moved[:3, 3] += moved[:3, :3] @ origin - origin
    return moved


def _inverse(T):
    inverse = np.eye(4)
    inverse[:3, :3] = T[:3, :3].T
    inverse[:3, 3] = -T[:3, :3].T @ T[:3, 3]
    return inverse
