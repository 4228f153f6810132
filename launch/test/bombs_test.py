#!/usr/bin/env python3
"""Files of every format that claim or hold more than memory has: one clear line, and little memory, is what they get.

Prints what each program took at most, for docs/trust.md.
"""
import io
import os
import resource
import sqlite3
import struct
import subprocess
import sys
import tarfile
import zipfile
import zlib

import rosbag
import rospy
import rostest
from sensor_msgs.msg import PointCloud2, PointField

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import TestCase, executable

LIMIT = 1 << 30  # bytes of address space: libraries, threads' stacks and arenas take some 500 MB of it untouched
PEAK = 350  # MB of memory


def pcd(path, points, data, body):
    with open(path, 'wb') as file:
        file.write(f'# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {points}\nHEIGHT 1\n'
                   f'VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {points}\nDATA {data}\n'.encode())
        file.write(body)


def packed_zeros(references):
    """LZF of the zeros of 1 + 22 points for each reference, which packs 264 bytes into three; with the sizes before it."""
    lzf = b'\x0b' + bytes(12) + b'\xe0\xff\0' * references
    return struct.pack('<II', len(lzf), 12 + 264 * references) + lzf


def png(width, height):
    """16 bits of grey, all 0."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    packer = zlib.compressobj(9)
    rows = b''.join(packer.compress(bytes(1 + 2 * width)) for _ in range(height)) + packer.flush()
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, 16, 0, 0, 0, 0)) +
            chunk(b'IDAT', rows) + chunk(b'IEND', b''))


def add(archive, name, data):
    entry = tarfile.TarInfo(name)
    entry.size = len(data)
    archive.addfile(entry, io.BytesIO(data))


class BombsTest(TestCase):

    def setUp(self):
        super().setUp()
        self.root = self.path('root')
        self.folder = self.path('root', 'rooms', 'yard')
        os.makedirs(self.folder)

    def run_limited(self, package, program, *arguments, address_space=LIMIT, file_size=None):
        """Exit status, standard error, and the most memory that it took, in MB."""
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (address_space, address_space))
            if file_size is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (file_size, file_size))
        with open(self.path('errors'), 'w+') as errors:
            child = subprocess.Popen([executable(package, program), *arguments], stdout=subprocess.DEVNULL, stderr=errors,
                                     preexec_fn=limit, cwd=self.folder)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = -os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)
            errors.seek(0)
            return child.returncode, errors.read(), usage.ru_maxrss / 1024

    def explode(self, name, pattern, program, *arguments):
        """The program fails and says why in its last line, whatever it has said before, with little memory."""
        size = max(os.path.getsize(os.path.join(folder, file))
                   for folder, _, files in os.walk(self.folder) for file in files)
        status, errors, peak = self.run_limited('pcrb_tools', program, *arguments)
        print(f'{name:34} {size / 1e6:8.3f} MB  {program:16} {peak:4.0f} MB at most', flush=True)
        self.assertEqual(status, 1, f'{name}: {errors}')
        last = errors.rstrip('\n').splitlines()[-1]
        self.assertRegex(last, rf'^{program}: .*{pattern}', name)
        self.assertLess(peak, PEAK, name)

    def clear(self):
        for name in os.listdir(self.folder):
            os.remove(os.path.join(self.folder, name))

    def test_clouds(self):
        for name, points, data, body, pattern in (
                ('PCD, compressed zeros', 20000000, 'binary_compressed', packed_zeros(909090), 'takes .* MB of memory, expected'),
                ('PCD, claims 10^15 points', 10**15, 'binary', bytes(1000), 'bytes of data'),
                ('PCD, claims 4 GB compressed', 3 * 10**8, 'binary_compressed', struct.pack('<II', 100, 2**32 - 8) + bytes(100),
                 'bytes claimed to be in'),
                ('PCD, 10 million rows of text', 10**7, 'ascii', b'0 0 0\n' * 10**7, 'takes .* MB of memory, expected')):
            for cloud in 'a.pcd', 'b.pcd':
                pcd(os.path.join(self.folder, cloud), points, data, body)
            self.explode(name, pattern, 'compute_overlap', self.folder, '--threads', '2', '--distance', '0.1')
            self.clear()

    def test_a_file_of_holes(self):
        pcd(os.path.join(self.folder, 'a.pcd'), 10**9, 'binary', b'')
        os.truncate(os.path.join(self.folder, 'a.pcd'), 12 * 10**9)
        self.explode('PCD of 12 GB of holes', r'found a file that takes 1200\d MB of memory, expected at most', 'build_map', self.folder, '-o',
                     self.path('map.pcd'), '--leaf', '0.1')

    def test_many_threads_have_one_budget(self):
        """What waits for its share has not been read, but for one file; holes take no disk, so each file is as large as may be."""
        for i in range(8):
            pcd(os.path.join(self.folder, f'{i}.pcd'), 20000000, 'binary', b'')
            os.truncate(os.path.join(self.folder, f'{i}.pcd'), 240000000 + os.path.getsize(os.path.join(self.folder, f'{i}.pcd')))
        self.explode('8 PCDs of 240 MB, 8 threads', 'takes .* MB of memory, expected', 'build_map', self.folder, '-o',
                     self.path('map.pcd'), '--leaf', '1', '--threads', '8')
        self.clear()
        for i in range(8):
            with open(os.path.join(self.folder, f'{1000 + i}.000000.bin'), 'wb') as file:
                file.truncate(240000000)
        with open(os.path.join(self.folder, 'poses.txt'), 'w') as poses:
            poses.writelines(f'{1000 + i}.0 0 0 0 0 0 0 1\n' for i in range(8))
        self.explode('8 scans of 240 MB, 8 threads', 'a scan that takes .* MB of memory, expected', 'convert_log', self.folder, '--root',
                     self.root, '--data-set', 'mine', '--sequence', 'yard', '--threads', '8', '--overlap-distance', '1',
                     '--voxel-leaf', '1')

    def convert(self, name, pattern):
        self.explode(name, pattern, 'convert_log', self.folder, '--root', self.root, '--data-set', 'mine', '--sequence', 'yard',
                     '--overlap-distance', '1', '--voxel-leaf', '1')
        self.clear()

    def test_data_of_ones_own(self):
        """Clouds of other formats than PCD, and what lies beside them."""
        def write(name, head, size=0, rows=b''):
            with open(os.path.join(self.folder, 'poses.txt'), 'w') as poses:
                poses.write('1000.0 0 0 0 0 0 0 1\n')
            with open(os.path.join(self.folder, name), 'wb') as file:
                file.write(head + rows)
                file.truncate(max(size, len(head) + len(rows)))
        vertices = 'ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nend_header\n'
        write('1000.000000.ply', vertices.format('binary_little_endian', 10**15).encode(), 1000)
        self.convert('PLY, claims 10^15 points', 'bytes')
        write('1000.000000.ply', vertices.format('ascii', 10**7).encode(), rows=b'0 0 0\n' * 10**7)
        self.convert('PLY, 10 million rows of text', 'takes .* MB of memory, expected')
        npy = "{'descr': '<f4', 'fortran_order': False, 'shape': (1000000000000, 3), }".ljust(117).encode() + b'\n'
        write('1000.000000.npy', b'\x93NUMPY\x01\x00' + struct.pack('<H', len(npy)) + npy, 1000)
        self.convert('npy, claims 10^12 points', 'bytes')
        write('1000.000000.bin', b'', 12 * 10**9)
        self.convert('bin of 12 GB of holes', 'takes .* MB of memory, expected')
        write('1000.000000.bin', b'', rows=bytes(16))
        with open(os.path.join(self.folder, 'poses.txt'), 'ab') as poses:
            poses.truncate(12 * 10**9)
        self.convert('trajectory of 12 GB of holes', 'takes .* MB of memory, expected')

    def test_a_yaml_of_aliases(self):
        """A text of a kilobyte that stands for 10^9 entries is none of a data set's parameters."""
        pcd(os.path.join(self.folder, 'a.pcd'), 1, 'ascii', b'0 0 0\n')
        with open(os.path.join(self.root, 'rooms', 'dataset.yaml'), 'w') as file:
            file.write('a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n')
            for i in range(1, 9):
                file.write(f'a{i}: &a{i} [{", ".join([f"*a{i - 1}"] * 10)}]\n')
            file.write('voxel_leaf: *a8\n')
        self.explode('YAML, 10^9 entries by aliases', r'dataset\.yaml', 'check_dataset', self.root)

    def test_packed_clouds_have_one_budget_for_all_threads_of_a_converter(self):
        for i in range(8):
            pcd(os.path.join(self.folder, f'{1000 + i}.000000.pcd'), 1 + 22 * 136000, 'binary_compressed', packed_zeros(136000))
        with open(os.path.join(self.folder, 'poses.txt'), 'w') as poses:
            poses.writelines(f'{1000 + i}.0 0 0 0 0 0 0 1\n' for i in range(8))
        status, errors, peak = self.run_limited('pcrb_tools', 'convert_log', self.folder, '--root', self.root, '--data-set', 'mine',
                                                '--sequence', 'yard', '--threads', '8', '--overlap-distance', '1', '--voxel-leaf', '1',
                                                '--memory', '250', '--until', 'convert', address_space=4 * LIMIT)
        print(f'{"8 packed PCDs of 180 MB, 8 threads":34} {0.4:8.3f} MB  {"convert_log":16} {peak:4.0f} MB at most', flush=True)
        self.assertEqual(status, 0, errors)
        self.assertLess(peak, PEAK)

    def test_archives(self):
        archive = os.path.join(self.folder, 'yard.tgz')
        with tarfile.open(archive, 'w:gz') as tgz:
            add(tgz, 'yard/csv_global/PointCloud0.csv', bytes(300000000))
        self.explode('tgz of 300 MB of zeros', 'at most 100 times the size of the archive', 'eth_to_pcd', archive,
                     '--root', self.root, '--sequence', 'yard', '--threads', '2')
        self.clear()
        archive = os.path.join(self.folder, 'yard.zip')
        with zipfile.ZipFile(archive, 'w', zipfile.ZIP_DEFLATED, compresslevel=9) as file:
            file.writestr('yard/csv_global/PointCloud0.csv', bytes(300000000))
        self.explode('zip of 300 MB of zeros', 'at most 100 times the size of the archive', 'eth_to_pcd', archive,
                     '--root', self.root, '--sequence', 'yard', '--threads', '2')
        self.clear()
        archive = os.path.join(self.folder, 'yard.tgz')
        image = png(8192, 8192)
        with tarfile.open(archive, 'w:gz') as tgz:
            names = [f'{1311867000 + i}.000000' for i in range(2)]
            add(tgz, 'yard/depth.txt', ''.join(f'{name} depth/{name}.png\n' for name in names).encode())
            add(tgz, 'yard/groundtruth.txt', ''.join(f'{1311866000 + i} 0 0 0 0 0 0 1\n' for i in range(2000)).encode())
            for name in names:
                add(tgz, f'yard/depth/{name}.png', image)
        self.explode('tgz of two PNGs of 8192 x 8192', 'pixels in .* bytes, expected at most', 'tum_to_pcd', archive, '--root', self.root,
                     '--sequence', 'yard', '--threads', '2')

    def bag(self, points, claim=None):
        """A bag of one cloud of zeros, packed; or not packed, and with another number of bytes said to be there."""
        path = os.path.join(self.folder, 'yard.bag')
        size = 16 * points
        cloud = PointCloud2(height=1, width=points, point_step=16, row_step=size, data=bytes(size))
        cloud.fields = [PointField(name, 4 * i, PointField.FLOAT32, 1) for i, name in enumerate('xyz')]
        cloud.header.stamp = rospy.Time(1311867000)
        with rosbag.Bag(path, 'w', compression='none' if claim else 'bz2') as bag:
            bag.write('/cloud', cloud, cloud.header.stamp)
        if claim:
            with open(path, 'r+b') as file:
                before = struct.pack('<III', 16, size, size)  # point_step, row_step, length of the data
                content = file.read()
                file.seek(content.index(before) + 8)
                file.write(struct.pack('<I', claim))
        with open(os.path.join(self.folder, 'poses.txt'), 'w') as poses:
            poses.writelines(f'{1311866000 + i} 0 0 0 0 0 0 1\n' for i in range(2000))
        return [path, '--root', self.root, '--threads', '2', '--poses', os.path.join(self.folder, 'poses.txt'), '--input', 'clouds',
                '--cloud-topic', '/cloud']

    def test_bags(self):
        """rosbag unpacks a chunk whole, whatever it holds: twice the message's size is what it takes, or nothing."""
        self.explode('bag, 80 MB of zeros by bz2', 'no scan became a cloud', 'tum_to_pcd', *self.bag(5000000))
        self.explode('bag, 160 MB of zeros by bz2', r'yard.bag: found a chunk that takes 32\d MB of memory .*expected at most 268 MB',
                     'tum_to_pcd', *self.bag(10000000))
        self.explode('bag, claims a cloud of 4 GB', 'yard.bag: damaged: Buffer Overrun', 'tum_to_pcd', *self.bag(1000, 2**32 - 1))

    def test_texts(self):
        with open(os.path.join(self.folder, 'yard_overlap.txt'), 'w') as matrix:
            matrix.write('overlap ' + ' '.join(f'{i}.pcd' for i in range(200000)) + '\n')
        maths.write_cloud(os.path.join(self.folder, '0.pcd'), maths.np.zeros((1, 3)))
        self.explode('matrix of 200000 clouds, no row', 'yard_overlap.txt:', 'sample_problems', self.folder, '--overlap',
                     os.path.join(self.folder, 'yard_overlap.txt'))
        self.clear()
        with open(os.path.join(self.folder, 'mine_yard_local.csv'), 'w') as table:
            table.write('id,error\n"' + '\n' * 50000000)
        self.explode('CSV, a quote of 50 MB', 'no end of the quote', 'report', '--import',
                     os.path.join(self.folder, 'mine_yard_local.csv'), '--output', self.path('report'))

    def test_a_store_with_a_reason_of_half_a_gigabyte(self):
        with sqlite3.connect(os.path.join(self.folder, 'results.sqlite')) as store:
            store.executescript(
                'CREATE TABLE run(key, value); CREATE TABLE session(started, ended, host, pid);'
                'CREATE TABLE result(data_set, sequence, kind, problem_id, source, target, overlap, outcome, reason, error,'
                ' initial_misalignment, rotation_error_rad, translation_error_m, runtime_s, solver_time_s, scans_used,'
                ' target_changed, replies_rejected, x, y, z, qx, qy, qz, qw, covariance, finished); PRAGMA user_version = 1;'
                "INSERT INTO result VALUES ('rooms', 'hall', 'local', '1', 'a.pcd', 'b.pcd', 0.5, 'failed', zeroblob(500000000),"
                ' 1, 1, 0, 0, NULL, NULL, NULL, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 1)')
        self.explode('store with 500 MB of a text', r'results\.sqlite: cannot .*too big', 'report', self.folder, '--output',
                     self.path('report'))

    def test_limits_of_a_process_are_one_line(self):
        for i in range(3):
            maths.write_cloud(os.path.join(self.folder, f'{i}.pcd'), maths.np.random.default_rng(i).uniform(0, 9, (20000, 3)))
        status, errors, _ = self.run_limited('pcrb_tools', 'build_map', self.folder, '-o', self.path('map.pcd'), file_size=4096)
        self.assertEqual(status, 1, errors)
        self.assertRegex(errors.splitlines()[-1], r'^build_map: .*map\.pcd.*(too large|File too large)')
        self.assertFalse(os.path.exists(self.path('map.pcd')))
        for space in range(100, 700, 100):  # MB; where even the libraries do not fit, the loader says so
            status, errors, _ = self.run_limited('pcrb_tools', 'build_map', self.folder, '-o', self.path('map.pcd'),
                                                 '--force', address_space=space << 20)
            self.assertGreaterEqual(status, 0, f'{space} MB: a signal: {errors}')
            if status:
                self.assertRegex(errors, r'(build_map: .*(memory|Resource temporarily unavailable)|error while loading shared)')


if __name__ == '__main__':
    rospy.init_node('bombs_test')
    rostest.rosrun('pcrb_launch', 'bombs', BombsTest)
