"""Normal distributions transform: the map as one Gaussian per cell, and alignment to it."""
import numpy as np
from localization_standins.geometry import cross_matrix, moved, shifted

NEIGHBOURS = np.array([[0, 0, 0], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])


class NdtMap:
    """Gaussians of the points in the cells of a grid."""

    def __init__(self, points, cell, min_points=5):
        self.cell = cell
        self.low = np.floor(points.min(axis=0) / cell).astype(int) - 2
        self.size = np.floor(points.max(axis=0) / cell).astype(int) + 3 - self.low
        keys = self._keys(points)
        order = np.argsort(keys, kind='stable')
        unique, start, count = np.unique(keys[order], return_index=True, return_counts=True)
        sums = np.add.reduceat(points[order], start)
        means = sums / count[:, None]
        centred = points[order] - np.repeat(means, count, axis=0)
        outer = np.add.reduceat(centred[:, :, None] * centred[:, None, :], start)
        kept = count >= min_points
        covariances = outer[kept] / count[kept, None, None]
        values, vectors = np.linalg.eigh(covariances)
        values = np.maximum(values, np.maximum(0.01 * values[:, 2:], 1e-4 * cell ** 2))
        self.keys, self.means = unique[kept], means[kept]
        self.information = (vectors / values[:, None, :]) @ np.swapaxes(vectors, 1, 2)

    def _keys(self, points, offset=(0, 0, 0)):
        index = np.floor(points / self.cell).astype(int) + offset - self.low
        index = np.where(np.all((index >= 0) & (index < self.size), axis=-1)[..., None], index, 0)
        return (index[..., 0] * self.size[1] + index[..., 1]) * self.size[2] + index[..., 2]

    def matches(self, points):
        """Indices of points, and of the Gaussians of their cells and the cells beside them."""
        which, cells = [], []
        for offset in NEIGHBOURS:
            keys = self._keys(points, offset)
            found = np.minimum(np.searchsorted(self.keys, keys), len(self.keys) - 1)
            hit = np.flatnonzero(self.keys[found] == keys)
            which.append(hit)
            cells.append(found[hit])
        return np.concatenate(which), np.concatenate(cells)

    def residuals(self, points):
        """Points matched, their offsets from the means, weighted information matrices, scores in (0, 1]."""
        which, cells = self.matches(points)
        offsets = points[which] - self.means[cells]
        weighted = (self.information[cells] @ offsets[:, :, None])[:, :, 0]
        scores = np.exp(-0.5 * np.minimum(np.einsum('ni,ni->n', offsets, weighted), 1400.0))
        return which, cells, weighted, scores


def align(ndt_map, points, T, iterations=12):
    """Gauss-Newton steps on the sum of the scores from pose T; pose and whether it came to rest.

    Points change their cells now and then, so that the last steps are small, but not arbitrarily so.
    """
    length = np.inf
    for _ in range(iterations):
        at = moved(T, points)
        which, cells, weighted, scores = ndt_map.residuals(at)
        if len(which) < 10:
            return T, False
        arms = at[which] - T[:3, 3]
        J = np.concatenate([np.broadcast_to(np.eye(3), (len(which), 3, 3)), -cross_matrix(arms)], axis=2)
        WJ = (ndt_map.information[cells] * scores[:, None, None]) @ J
        H = J.reshape(-1, 6).T @ WJ.reshape(-1, 6)
        g = J.reshape(-1, 6).T @ (weighted * scores[:, None]).reshape(-1)
        step = -np.linalg.solve(H + 1e-6 * np.trace(H) * np.eye(6), g)
        T = shifted(T, step[:3], step[3:])
        length = np.linalg.norm(step)
        if length < 1e-4:
            break
    return T, length < 0.02
