"""Tests of the Python package pcrb; run by catkin, by ctest, and after an installation by pip."""
import os
import pathlib
import sqlite3
import tempfile
import unittest

import numpy as np
import pcrb

SHARED_DATA = pathlib.Path(os.environ.get('PCRB_SHARED_DATA', os.environ.get('PCRB_SHARED_DATA_DEFAULT', '/nowhere')))
UTM = np.array([702000.0, 8045000.0, 100.0])


class VectorLike:
    """What open3d.utility.Vector3dVector is to numpy: a sequence of triples with an array interface."""

    def __init__(self, rows):
        self._rows = np.asarray(rows, dtype=np.float64)

    def __array__(self, dtype=None):
        return self._rows if dtype is None else self._rows.astype(dtype)


class CloudLike:
    """Stands for open3d.geometry.PointCloud."""

    def __init__(self, rows):
        self.points = VectorLike(rows)


def some_points(count=200, offset=0.0):
    return np.random.default_rng(1).uniform(-20.0, 20.0, (count, 3)) + offset


def some_rotation(angle=0.3):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def paper_error(aligned, truth):
    weights = np.linalg.norm(aligned - aligned.mean(axis=0), axis=1)
    return float(np.mean(np.linalg.norm(aligned - truth, axis=1) / weights))


class ErrorTest(unittest.TestCase):
    def test_is_equation_1(self):
        truth = some_points()
        aligned = truth @ some_rotation().T + [0.1, 0.2, 0.3]
        self.assertAlmostEqual(pcrb.error(aligned, truth), paper_error(aligned, truth), places=12)
        self.assertEqual(pcrb.error(truth, truth), 0.0)

    def test_takes_clouds_with_points_and_lists_and_single_precision(self):
        truth = some_points(offset=1.0)
        aligned = truth + [0.5, 0.0, 0.0]
        expected = pcrb.error(aligned, truth)
        self.assertEqual(pcrb.error(CloudLike(aligned), CloudLike(truth)), expected)
        self.assertEqual(pcrb.error(aligned.tolist(), np.asfortranarray(truth)), expected)
        self.assertAlmostEqual(pcrb.error(aligned.astype(np.float32), truth.astype(np.float32)), expected, places=5)

    def test_refuses_what_does_not_correspond(self):
        truth = some_points()
        with self.assertRaisesRegex(pcrb.InvalidProblem, '199 aligned points and 200'):
            pcrb.error(truth[1:], truth)
        with self.assertRaisesRegex(ValueError, r'aligned: found shape \(200, 2\)'):
            pcrb.error(truth[:, :2], truth)
        truth[7, 1] = np.nan
        with self.assertRaisesRegex(pcrb.Error, 'point 7'):
            pcrb.error(truth, truth)

    def test_evaluate_gives_the_same_from_the_pose_alone_even_in_utm(self):
        truth = some_points(offset=UTM)
        P = pcrb.make_perturbation(truth, [0.3, 0.4, 0.0], some_rotation())
        score = pcrb.evaluate(CloudLike(truth), P)
        self.assertAlmostEqual(score['error'], pcrb.error(pcrb.perturb(truth, P), truth), places=7)
        self.assertAlmostEqual(score['rotation_error_rad'], 0.3, places=9)
        self.assertAlmostEqual(score['translation_error_m'], 0.5, places=7)
        self.assertGreater(score['mean_distance_m'], 0.5)

    def test_evaluate_refuses_a_pose_that_is_not_rigid(self):
        with self.assertRaises(pcrb.InvalidProblem):
            pcrb.evaluate(some_points(), 2.0 * np.eye(4)[:3])
        with self.assertRaisesRegex(ValueError, 'last row'):
            pcrb.evaluate(some_points(), np.ones((4, 4)))


class PerturbationTest(unittest.TestCase):
    def test_turns_about_the_centroid(self):
        points = some_points(offset=UTM)
        P = pcrb.make_perturbation(points, [1.0, 2.0, 3.0], some_rotation())
        self.assertEqual(P.shape, (4, 4))
        moved = pcrb.perturb(points, P).mean(axis=0) - points.mean(axis=0)
        np.testing.assert_allclose(moved, [1.0, 2.0, 3.0], atol=1e-6)

    def test_refuses_a_matrix_that_is_no_rotation(self):
        with self.assertRaises(pcrb.InvalidProblem):
            pcrb.make_perturbation(some_points(), [0, 0, 0], np.diag([1.0, 1.0, -1.0]))


class FileTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_pcd_reads_back_to_the_same_doubles(self):
        points = some_points(offset=UTM)
        viewpoint = np.eye(4)
        viewpoint[:3, 3] = [1.0, 2.0, 3.0]
        pcrb.write_pcd(self.folder / 'a.pcd', CloudLike(points), viewpoint)
        read = pcrb.read_pcd(self.folder / 'a.pcd', threads=2)
        np.testing.assert_array_equal(read['points'], points)
        np.testing.assert_array_equal(read['viewpoint'], viewpoint)
        self.assertIsNone(read['intensity'])
        self.assertEqual(read['dropped_non_finite'], 0)

    def test_a_viewpoint_that_is_the_identity_is_known_and_none_is_not(self):
        pcrb.write_pcd(self.folder / 'a.pcd', some_points(), np.eye(4))
        np.testing.assert_array_equal(pcrb.read_pcd(self.folder / 'a.pcd')['viewpoint'], np.eye(4))
        pcrb.write_pcd(self.folder / 'b.pcd', some_points())
        self.assertIsNone(pcrb.read_pcd(self.folder / 'b.pcd')['viewpoint'])

    def test_a_defect_names_file_and_line(self):
        path = self.folder / 'broken.pcd'
        path.write_text('VERSION 0.7\nFIELDS x y z\nSIZE 4 4\n')
        with self.assertRaisesRegex(pcrb.InvalidFile, 'broken.pcd:3'):
            pcrb.read_pcd(path)

    def test_problems_read_back_as_they_were(self):
        P = pcrb.make_perturbation(some_points(), [1.0, 0.5, 0.25], some_rotation())
        problems = [{'id': '12340', 'source': 'a.pcd', 'target': 'b.pcd', 'overlap': 0.5, 'perturbation': P}]
        pcrb.write_problems(self.folder / 'p.txt', problems)
        (read,) = pcrb.read_problems(self.folder / 'p.txt')
        np.testing.assert_array_equal(read.pop('perturbation'), P)
        self.assertEqual(read, {key: value for key, value in problems[0].items() if key != 'perturbation'})
        problems[0]['source'] = 'a/b.pcd'
        with self.assertRaises(pcrb.InvalidProblem):
            pcrb.write_problems(self.folder / 'p.txt', problems)

    def test_results_need_a_store(self):
        with self.assertRaises(pcrb.StoreError):
            pcrb.read_results(self.folder / 'nothing')

    def test_published_problems_pose_what_they_say(self):
        if not SHARED_DATA.is_dir():
            self.skipTest('no shared data beside the checkout')
        folder = SHARED_DATA / 'benchmark' / 'automotive'
        problem = pcrb.read_problems(folder / 'street_local.txt')[0]
        source = pcrb.read_pcd(folder / 'street' / problem['source'])['points']
        score = pcrb.evaluate(source, problem['perturbation'])
        handed_out = pcrb.perturb(source, problem['perturbation'])
        self.assertAlmostEqual(score['error'], paper_error(handed_out, source), places=6)


class ResultsTest(unittest.TestCase):
    """On a store with one reply, and one problem that nobody answered."""

    COLUMNS = ('data_set, sequence, kind, problem_id, source, target, overlap, outcome, reason, error, '
               'initial_misalignment, rotation_error_rad, translation_error_m, runtime_s, solver_time_s, scans_used, '
               'target_changed, replies_rejected, x, y, z, qx, qy, qz, qw, covariance, finished')
    REPLIED = ('eth', 'plain', 'local', '12340', 'a.pcd', 'b.pcd', 0.5, 'replied', '', 0.01, 0.2, 0.001, 0.02, 0.3, 0.1,
               None, 0, 0, 1.0, 2.0, 3.0, 0.0, 0.0, 0.6, 0.8, None, 5.0)
    TIMED_OUT = ('eth', 'plain', 'local', '12341', 'a.pcd', 'b.pcd', 0.5, 'timed_out', '', 0.2, 0.2, 0.1, 0.3, None, None,
                 None, 0, 0, None, None, None, None, None, None, None, None, 6.0)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.run_folder = folder.name
        store = sqlite3.connect(os.path.join(folder.name, 'results.sqlite'))
        store.executescript(f'PRAGMA journal_mode = WAL; PRAGMA user_version = 1; CREATE TABLE run(key, value);'
                            f'CREATE TABLE session(started, ended, host, pid); CREATE TABLE result({self.COLUMNS});')
        store.execute("INSERT INTO run VALUES ('seed', '1')")
        marks = ', '.join('?' * len(self.REPLIED))
        store.executemany(f'INSERT INTO result VALUES ({marks})', [self.REPLIED, self.TIMED_OUT])
        store.commit()
        store.close()

    def test_columns_are_arrays_with_nan_where_unknown(self):
        results = pcrb.read_results(self.run_folder)
        self.assertEqual(results['problem_id'].tolist(), ['12340', '12341'])
        self.assertEqual(results['outcome'].tolist(), ['replied', 'timed_out'])
        np.testing.assert_array_equal(results['error'], [0.01, 0.2])
        np.testing.assert_array_equal(results['runtime_s'], [0.3, np.nan])
        np.testing.assert_array_equal(results['position'], [[1.0, 2.0, 3.0], [np.nan] * 3])
        np.testing.assert_array_equal(results['orientation'], [[0.0, 0.0, 0.6, 0.8], [np.nan] * 4])
        self.assertEqual(results['overlap'].dtype, np.float64)

    def test_the_runs_table_is_a_dict(self):
        self.assertEqual(pcrb.read_run_info(self.run_folder), {'seed': '1'})


class AnyBytesTest(unittest.TestCase):
    """A path is bytes: a Latin-1 letter of an old disk is no UTF-8."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = os.path.join(folder.name, os.fsdecode(b'caf\xe9'))
        os.mkdir(self.folder)

    def test_files_are_written_and_read(self):
        path = os.path.join(self.folder, 'a.pcd')
        points = some_points(5)
        pcrb.write_pcd(path, points)
        np.testing.assert_array_equal(pcrb.read_pcd(path)['points'], points)
        np.testing.assert_array_equal(pcrb.read_pcd(pathlib.Path(path))['points'], points)
        self.assertEqual(os.listdir(self.folder), ['a.pcd'])

    def test_sequences_are_found_and_selected(self):
        data_set, sequence = (os.fsdecode(name) for name in (b'r\xe4ume', b'k\xfcche'))
        os.mkdir(os.path.join(self.folder, data_set))
        path = os.path.join(self.folder, data_set, f'{sequence}_local.txt')
        pcrb.write_problems(path, [])
        self.assertEqual(pcrb.find_sequences(self.folder), [(data_set, sequence, 'local', path)])
        self.assertEqual(pcrb.select_sequences([(data_set, sequence), ('a', 'b')], [sequence]), [(data_set, sequence)])

    def test_a_run_of_clouds_with_such_names_is_read_back(self):
        source, sequence, run = os.fsdecode(b'h\xf6he.pcd'), os.fsdecode(b'k\xfcche'), os.path.join(self.folder, 'run')
        clouds = os.path.join(self.folder, 'rooms', sequence)
        os.makedirs(clouds)
        for name in source, 'b.pcd':
            pcrb.write_pcd(os.path.join(clouds, name), some_points())
        problems = [{'id': '10', 'source': source, 'target': 'b.pcd', 'overlap': 1.0,
                     'perturbation': pcrb.make_perturbation(some_points(), [0.1, 0, 0], some_rotation())}]
        pcrb.write_problems(f'{clouds}_local.txt', problems)
        self.assertEqual(pcrb.read_problems(f'{clouds}_local.txt')[0]['source'], source)
        self.assertEqual([problem.sequence for problem in pcrb.problems(self.folder, sequence)], [sequence])

        def method(problem):
            raise ValueError(source)
        results = pcrb.run(method, self.folder, run, sequences=sequence)
        for column, value in ('source', source), ('sequence', sequence), ('outcome', 'failed'):
            self.assertEqual(results[column].tolist(), [value])
            self.assertEqual(pcrb.read_results(run)[column].tolist(), [value])
        self.assertTrue(any(self.folder in value for value in pcrb.read_run_info(run).values()))
        pcrb.write_results(os.path.join(self.folder, 'a.csv'), [
            {'sequence': sequence, 'kind': 'local', 'problem_id': '10', 'error': 0.1}])
        with open(os.path.join(self.folder, 'a.csv'), 'rb') as table:
            self.assertIn(b'k\xfcche,local', table.read())

    def test_errors_name_the_path(self):
        for function, error in ((pcrb.read_pcd, pcrb.InvalidFile), (pcrb.read_problems, pcrb.InvalidFile),
                                (pcrb.read_results, pcrb.StoreError)):
            with self.assertRaises(error) as raised:
                function(os.path.join(self.folder, 'none'))
            self.assertIn(self.folder, str(raised.exception))


class RunTest(unittest.TestCase):
    """On one sequence of two clouds and two problems."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root, self.folder = pathlib.Path(folder.name, 'data'), pathlib.Path(folder.name, 'run')
        clouds = self.root / 'rooms' / 'hall'
        clouds.mkdir(parents=True)
        self.points = some_points(offset=UTM)
        for name in 'a.pcd', 'b.pcd':
            pcrb.write_pcd(clouds / name, self.points)
        self.P = pcrb.make_perturbation(self.points, [0.3, 0.2, 0.1], some_rotation())
        (self.root / 'rooms' / 'dataset.yaml').write_text('voxel_leaf: 0.1\n')
        pcrb.write_problems(self.root / 'rooms' / 'hall_local.txt', [
            {'id': str(number), 'source': 'a.pcd', 'target': 'b.pcd', 'overlap': 1.0, 'perturbation': self.P}
            for number in (10, 11)])

    def ideal(self, problem):
        """The paired points are known here: the transform that puts them on each other."""
        source, target = (cloud.astype(np.float64) for cloud in (problem.source, problem.target))
        u, _, vt = np.linalg.svd((source - source.mean(0)).T @ (target - target.mean(0)))
        R = vt.T @ np.diag([1, 1, np.linalg.det(vt.T @ u.T)]) @ u.T
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = R, target.mean(0) - R @ source.mean(0)
        return pose

    def test_problems_come_one_by_one_as_a_client_sees_them(self):
        problems = []
        for problem in pcrb.problems(self.root, 'rooms/hall'):
            problems.append(problem)
            self.assertEqual(problem.source.dtype, np.float32)
            self.assertLess(np.abs(problem.target).max(), 200.0)
            self.assertEqual(problem.voxel_leaf, 0.1)
            self.assertLess(problem.score(self.ideal(problem))['error'], 1e-5)
            self.assertEqual(problem.score(problem.guess)['error'], problem.score(np.eye(4))['initial_misalignment'])
        self.assertEqual([(p.id, p.index, p.count) for p in problems], [('10', 0, 2), ('11', 1, 2)])
        with self.assertRaisesRegex(pcrb.InvalidParameter, 'hal'):
            pcrb.problems(self.root, 'hal')
        with self.assertRaisesRegex(pcrb.InvalidParameter, 'found `locl`'):
            pcrb.problems(self.root, kind='locl')

    def test_a_run_is_a_folder_like_the_servers_and_goes_on(self):
        seen = []

        def method(problem):
            seen.append(problem.id)
            if len(seen) == 2:
                raise KeyboardInterrupt
            return self.ideal(problem)
        with self.assertRaises(KeyboardInterrupt):
            pcrb.run(method, self.root, self.folder)
        results = pcrb.run(method, self.root, self.folder)
        self.assertEqual(seen[1], seen[2])
        self.assertEqual(results['outcome'].tolist(), ['replied', 'replied'])
        self.assertLess(results['error'].max(), 1e-5)
        self.assertEqual(pcrb.read_run_info(self.folder)['under_test'], 'method')
        self.assertIn('total', (self.folder / 'summary.txt').read_text())
        self.assertIn('problem_id', (self.folder / 'results.csv').read_text())
        with self.assertRaisesRegex(pcrb.StoreError, 'subset'):
            pcrb.run(method, self.root, self.folder, subset=1)

    def test_what_is_no_pose_is_a_failed_problem_with_its_reason(self):
        def method(problem):
            if problem.id == '10':
                raise ValueError('too few points')
        results = pcrb.run(method, self.root, self.folder)
        self.assertEqual(results['outcome'].tolist(), ['failed', 'failed'])
        self.assertEqual(results['reason'].tolist(), ['ValueError: too few points', 'the function returned None'])
        np.testing.assert_array_equal(results['error'], results['initial_misalignment'])

    def test_a_pose_may_come_with_its_covariance(self):
        covariance = np.diag([1.0, 4.0, 9.0, 0.1, 0.2, 0.3])
        covariance[0, 5] = covariance[5, 0] = 0.05

        def method(problem):
            return (self.ideal(problem), covariance) if problem.id == '10' else ([0, 0, 0], [0, 0, 0, 1])
        results = pcrb.run(method, self.root, self.folder)
        self.assertEqual(results['outcome'].tolist(), ['replied', 'replied'])
        np.testing.assert_array_equal(results['covariance'], [covariance, np.full((6, 6), np.nan)])
        self.assertLess(results['error'][0], 1e-5)
        (pair, *_) = pcrb.problems(self.root, 'rooms/hall')
        with self.assertRaisesRegex(ValueError, r'found shapes \(4, 4\) and \(6, 5\)'):
            pair.score((np.eye(4), covariance[:, :5]))

    def test_an_answer_after_the_time_limit_counts_as_none(self):
        results = pcrb.run(self.ideal, self.root, self.folder, time_limit=1e-9)
        self.assertEqual(results['outcome'].tolist(), ['timed_out', 'timed_out'])

    def test_results_of_others_are_written_as_a_file_for_the_report(self):
        path = self.root / 'mine.csv'
        pcrb.write_results(path, [{'sequence': 'hall', 'kind': 'local', 'problem_id': '10', 'error': 0.1, 'runtime_s': np.nan,
                                   'reason': 'a, "b"'}])
        self.assertEqual(path.read_text().splitlines(), ['sequence,kind,problem_id,reason,error,runtime_s',
                                                         'hall,local,10,"a, ""b""",0.1,'])
        with self.assertRaisesRegex(pcrb.InvalidParameter, 'column `eror`'):
            pcrb.write_results(path, [{'eror': 1.0}])
        with self.assertRaisesRegex(pcrb.InvalidParameter, 'row 0: found no problem_id'):
            pcrb.write_results(path, [{'sequence': 'hall', 'kind': 'local', 'error': 0.1}])

    def test_sequences_and_methods_are_those_of_all_programs(self):
        self.assertEqual(pcrb.find_sequences(self.root), [('rooms', 'hall', 'local', str(self.root / 'rooms' / 'hall_local.txt'))])
        known = [('rooms', 'hall'), ('rooms', 'attic')]
        self.assertEqual(pcrb.select_sequences(known, ['rooms/attic']), [('rooms', 'attic')])
        with self.assertRaises(pcrb.InvalidParameter):
            pcrb.select_sequences(known, ['yard'])
        self.assertIn('gicp', pcrb.methods())


class DocumentationTest(unittest.TestCase):
    def test_every_public_function_says_what_it_returns_and_raises(self):
        for name in pcrb.__all__:
            thing = getattr(pcrb, name)
            if isinstance(thing, type):
                continue
            self.assertRegex(thing.__doc__, 'Returns|Writes|a dict', name)


if __name__ == '__main__':
    unittest.main()
