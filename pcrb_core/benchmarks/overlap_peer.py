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
    """Counts by target; seconds and processor seconds, brought up to all targets."""
    clouds = [np.fromfile(f"{folder}/{i}.f64").reshape(-1, 3) for i in range(args.clouds)]
    targets = np.linspace(0, args.clouds - 1, args.peer_targets or args.clouds).astype(int)
    counts = {}
    start, processor_start = time.perf_counter(), time.process_time()
    for target in targets:
        tree = cKDTree(clouds[target])
        counts[target] = np.zeros(args.clouds, dtype=np.int64)
        for source, cloud in enumerate(clouds):
            if source != target:
                found, _ = tree.query(cloud, distance_upper_bound=distance, workers=args.threads)
                counts[target][source] = np.isfinite(found).sum()
    scale = args.clouds / len(targets)
    return (time.perf_counter() - start) * scale, (time.process_time() - processor_start) * scale, counts


def measure(program, scene, args):
    with tempfile.TemporaryDirectory() as folder:
        ours, our_counts = run_pcrb(program, scene, args, folder)
        seconds, processor, counts = run_scipy(args, folder, ours["distance"])
    pairs = args.clouds * (args.clouds - 1)
    equal = all(np.array_equal(row, our_counts[target]) for target, row in counts.items())
    print(f"{scene}: {args.clouds} clouds of {args.points} points, {pairs} ordered pairs, "
          f"{args.threads} threads, mean overlap {our_counts.sum() / (pairs * args.points):.2f}")
    print(f"  scipy cKDTree  {seconds:8.2f} s, {processor:8.2f} s processor time, "
          f"{1e3 * seconds / pairs:7.2f} ms a pair; {len(counts)} of {args.clouds} targets measured")
    print(f"  pcrb           {ours['seconds']:8.2f} s, {ours['processor_seconds']:8.2f} s processor time, "
          f"{1e3 * ours['seconds'] / pairs:7.2f} ms a pair; grids {ours['grid_megabytes']:.0f} MB, "
          f"peak {ours['peak_growth_megabytes']:.0f} MB")
    print(f"  ratio {seconds / ours['seconds']:.1f}, in processor time "
          f"{processor / ours['processor_seconds']:.1f}; counts {'equal' if equal else 'DIFFER'}", flush=True)
    return equal


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="path of overlap_benchmark")
    parser.add_argument("--clouds", type=int, default=40)
    parser.add_argument("--points", type=int, default=365000)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--peer-targets", type=int, default=0,
                        help="targets that the peer computes, its time brought up to all [0 = all]")
    parser.add_argument("--scenes", nargs="+", default=["room", "terrain"])
    args = parser.parse_args()
    equal = [measure(args.program, scene, args) for scene in args.scenes]
    sys.exit(0 if all(equal) else 1)


if __name__ == "__main__":
    main()
