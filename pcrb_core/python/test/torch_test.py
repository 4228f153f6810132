"""Tests of pcrb.torch, with PyTorch where it is installed, else with numpy in its place."""
import csv
import os
import pathlib
import pickle
import tempfile
import unittest

import numpy as np
import pcrb
import pcrb.torch

UTM = np.array([702000.0, 8045000.0, 100.0])


def turned(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def as_numpy(value):
    return value.numpy() if hasattr(value, 'numpy') else value


class DatasetTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        clouds = self.root / 'mine' / 'yard'
        clouds.mkdir(parents=True)
        (self.root / 'mine' / 'dataset.yaml').write_text('voxel_leaf: 0.1\n')
        random = np.random.default_rng(1)
        self.points = {name: random.uniform(-20.0, 20.0, (300, 3)) + UTM for name in ('a.pcd', 'b.pcd', 'c.pcd')}
        for name, points in self.points.items():
            pcrb.write_pcd(clouds / name, points)
        problems = []
        for i, (source, target) in enumerate([('a.pcd', 'b.pcd'), ('b.pcd', 'c.pcd'), ('c.pcd', 'a.pcd')]):
            P = pcrb.make_perturbation(self.points[source], [0.3, -0.2, 0.1 * i], turned(0.2))
            problems.append({'id': str(100 + i), 'source': source, 'target': target, 'overlap': 0.5, 'perturbation': P})
        self.problems = problems
        pcrb.write_problems(self.root / 'mine' / 'yard_local.txt', problems)
        self.data = pcrb.torch.RegistrationDataset(self.root)

    def test_a_sample_has_clouds_guess_and_truth_in_the_targets_local_frame(self):
        self.assertEqual(len(self.data), 3)
        sample = self.data[1]
        self.assertEqual([sample[name] for name in ('id', 'data_set', 'sequence', 'kind', 'overlap', 'voxel_leaf')],
                         ['101', 'mine', 'yard', 'local', 0.5, 0.1])
        source, target, truth = (as_numpy(sample[name]) for name in ('source', 'target', 'truth'))
        self.assertEqual((source.dtype, target.dtype, source.shape), (np.float32, np.float32, (300, 3)))
        origin = self.points['c.pcd'][0] - target[0]
        np.testing.assert_allclose(target + origin, self.points['c.pcd'], atol=1e-4)
        aligned = source @ truth[:3, :3].T + truth[:3, 3] + origin
        np.testing.assert_allclose(aligned, self.points['b.pcd'], atol=1e-4)
        np.testing.assert_array_equal(as_numpy(sample['guess']), np.eye(4))

    def test_samples_are_the_same_again_and_in_another_process(self):
        there = pickle.loads(pickle.dumps(self.data))
        for name in ('source', 'target', 'truth'):
            np.testing.assert_array_equal(as_numpy(self.data[2][name]), as_numpy(there[2][name]))

    def test_takes_a_transform_a_subset_and_a_selection(self):
        data = pcrb.torch.RegistrationDataset(self.root, sequences='mine/yard', subset=2, seed=3,
                                              transform=lambda sample: {'points': len(sample['source'])})
        self.assertEqual([data[i] for i in range(len(data))], [{'points': 300}] * 2)
        with self.assertRaises(pcrb.InvalidParameter):
            pcrb.torch.RegistrationDataset(self.root, sequences='garden')
        with self.assertRaisesRegex(pcrb.InvalidParameter, 'expected local, global or both'):
            pcrb.torch.RegistrationDataset(self.root, kind='Local')

    def test_a_batch_has_stacked_poses_and_lists_of_clouds(self):
        batch = pcrb.torch.collate([self.data[0], self.data[1]])
        self.assertEqual(tuple(batch['truth'].shape), (2, 4, 4))
        self.assertEqual([len(cloud) for cloud in batch['source']], [300, 300])

    def test_the_truth_scores_nothing_and_the_guess_the_initial_misalignment(self):
        rows = pcrb.torch.score_model(lambda sample: sample['truth'], self.data)
        self.assertLess(max(row['error'] for row in rows), 1e-6)
        self.assertEqual({row['outcome'] for row in rows}, {'replied'})
        rows = pcrb.torch.score_model(lambda sample: sample['guess'], self.data)
        for row, problem in zip(rows, self.problems):
            expected = pcrb.evaluate(self.points[problem['source']], problem['perturbation'])
            self.assertAlmostEqual(row['error'], expected['error'], places=7)
            self.assertEqual(row['error'], row['initial_misalignment'])
            self.assertAlmostEqual(row['rotation_error_rad'], 0.2, places=6)

    def test_a_pose_in_single_precision_counts(self):
        rows = pcrb.torch.score_model(lambda sample: as_numpy(sample['truth']).astype(np.float32), self.data)
        self.assertLess(max(row['error'] for row in rows), 1e-5)

    def test_a_model_that_fails_has_failed_and_is_written_for_the_report(self):
        def model(sample):
            if sample['id'] == '100':
                return None
            if sample['id'] == '101':
                raise RuntimeError('out of memory, "really"')
            return np.eye(3)
        path = self.root / 'model_yard_local.csv'
        rows = pcrb.torch.score_model(model, self.data, path=path)
        self.assertEqual([row['outcome'] for row in rows], ['failed'] * 3)
        self.assertEqual(rows[1]['reason'], 'RuntimeError: out of memory, "really"')
        self.assertIn('found shape (3, 3)', rows[2]['reason'])
        self.assertEqual(rows[0]['error'], rows[0]['initial_misalignment'])
        with open(path, newline='') as file:
            written = list(csv.DictReader(file))
        self.assertEqual([row['reason'] for row in written], [row['reason'] for row in rows])
        self.assertEqual(float(written[1]['error']), rows[1]['error'])

    def test_evaluates_a_module_of_torch_without_gradients(self):
        if pcrb.torch.torch is None:
            self.skipTest('PyTorch is not installed')
        torch = pcrb.torch.torch

        class Model(torch.nn.Module):
            def forward(self, sample):
                assert not torch.is_grad_enabled() and not self.training
                return sample['truth'].float()
        rows = pcrb.torch.score_model(Model(), self.data)
        self.assertLess(max(row['error'] for row in rows), 1e-5)

    def test_the_package_itself_does_not_import_torch(self):
        for name in '__init__.py', 'benchmark.py':
            with open(os.path.join(os.path.dirname(pcrb.__file__), name)) as file:
                self.assertNotIn('import torch', file.read())


if __name__ == '__main__':
    unittest.main()
