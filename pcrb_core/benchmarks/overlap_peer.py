#!/usr/bin/python3
"""Overlap matrix of synthetic scans: pcrb against scipy's cKDTree, same scans, same cores, one run.

The peer builds one tree per cloud and asks it with distance_upper_bound for every ordered pair.
Counts must be equal. Needs python3-scipy and the program overlap_benchmark (`make benchmarks`).
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.spatial import cKDTree


def run_pcrb(program, scene, args, folder):
    command = [program, scene, args.clouds, args.points, args.threads, folder]
    text = subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout
    figures = {key: float(value) for key, value in (line.split() for line in text.splitlines())}
    return figures, np.loadtxt(os.path.join(folder, "counts.txt"), dtype=np.int64, ndmin=2)


def run_scipy(args, folder, distance):
    clouds = [np.fromfile(f"{folder}/{i}.f64").reshape(-1, 3) for i in range(args.clouds)]
    counts = np.zeros((args.clouds, args.clouds), dtype=np.int64)
    start, processor_start = time.perf_counter(), time.process_time()
    trees = [cKDTree(cloud) for cloud in clouds]
    build = time.perf_counter() - start
    for target, tree in enumerate(trees):
        for source, cloud in enumerate(clouds):
            if source != target:
                found, _ = tree.query(cloud, distance_upper_bound=distance, workers=args.threads)
                counts[target, source] = np.isfinite(found).sum()
    return build, time.perf_counter() - start, time.process_time() - processor_start, counts


def measure(program, scene, args):
    with tempfile.TemporaryDirectory() as folder:
        ours, our_counts = run_pcrb(program, scene, args, folder)
        build, seconds, processor, counts = run_scipy(args, folder, ours["distance"])
    pairs = args.clouds * (args.clouds - 1)
    equal = np.array_equal(counts, our_counts)
    share = counts.sum() / (pairs * args.points)
    print(f"{scene}: {args.clouds} clouds of {args.points} points, {pairs} ordered pairs, "
          f"{args.threads} threads, mean overlap {share:.2f}")
    print(f"  scipy cKDTree  {seconds:8.2f} s, of that {build:.2f} s trees; "
          f"{1e3 * seconds / pairs:.2f} ms a pair")
    print(f"  pcrb           {ours['seconds']:8.2f} s, of that {ours['grid_seconds']:.2f} s grids; "
          f"{1e3 * ours['seconds'] / pairs:.2f} ms a pair; grids {ours['grid_megabytes']:.0f} MB")
    print(f"  ratio {seconds / ours['seconds']:.1f} ({processor / ours['processor_seconds']:.1f} in processor time, "
          f"{processor:.1f} s / {ours['processor_seconds']:.2f} s), counts {'equal' if equal else 'DIFFER'}", flush=True)
    return equal


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="path of overlap_benchmark")
    parser.add_argument("--clouds", type=int, default=40)
    parser.add_argument("--points", type=int, default=365000)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--scenes", nargs="+", default=["room", "terrain"])
    args = parser.parse_args()
    equal = [measure(args.program, scene, args) for scene in args.scenes]
    sys.exit(0 if all(equal) else 1)


if __name__ == "__main__":
    main()
