#!/usr/bin/env python3
"""Compares the time of the package with that of the library's own call and of SciPy, on random nodes: the least processor
time of several runs in turn. With --program: the time of the command from a text file to UGRID beside that call.

  benchmark.py [--nodes N] [--places M] [--repeats K] [--threads T] [--library libpstripack.so.1] [--program pstripack]
"""
import argparse
import ctypes
import os
import subprocess
import sys
import tempfile
import time

import numpy as np


class OwnCall:
    """pstripack_trmesh with columns and lists that are already allocated."""

    def __init__(self, library, points):
        self.call = ctypes.CDLL(library).pstripack_trmesh
        n = len(points)
        self.columns = np.array(points.T, order="C")
        self.lists = [np.zeros(size, np.int32) for size in (6 * n - 12, 6 * n - 12, n, 1)]

    def __call__(self):
        arrays = [*self.columns, *self.lists]
        if self.call(self.columns.shape[1], *(ctypes.c_void_p(a.ctypes.data) for a in arrays)) != 0:
            sys.exit("benchmark: pstripack_trmesh failed")


def least(calls, repeats):
    seconds = dict.fromkeys(calls, float("inf"))
    for _ in range(repeats):
        for name, call in calls.items():
            start = processor_time()
            call()
            seconds[name] = min(seconds[name], processor_time() - start)
    return seconds


def processor_time():
    """Seconds of this process and of the processes that it has waited for."""
    times = os.times()
    return time.process_time() + times.children_user + times.children_system


def time_program(given, points):
    """Times `pstripack triangulate nodes.txt -o mesh.nc` beside the library's call."""
    with tempfile.TemporaryDirectory() as folder:
        source, mesh = os.path.join(folder, "nodes.txt"), os.path.join(folder, "mesh.nc")
        np.savetxt(source, points, fmt="%.17g")
        command = [given.program, "--quiet", "--threads", str(given.threads), "triangulate", source, "-o", mesh]
        own, program = least({"call": OwnCall(given.library, points),
                              "program": lambda: subprocess.run(command, check=True)}, given.repeats).values()
    print(f"{len(points)} random nodes, {given.threads} thread(s)")
    print(f"{own:10.4f} s  pstripack_trmesh, the library's call")
    print(f"{program:10.4f} s  {given.program} triangulate nodes.txt -o mesh.nc")
    print(f"{(program - own) / own:10.2f}    times the library's call for reading, writing and everything else")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--nodes", type=int, default=200_000)
    options.add_argument("--places", type=int, help="of searches and weights; as many as nodes by default")
    options.add_argument("--repeats", type=int, default=9)
    options.add_argument("--threads", type=int, default=1)
    options.add_argument("--library", default=os.environ.get("PSTRIPACK_LIBRARY", "libpstripack.so.1"))
    options.add_argument("--program", metavar="PSTRIPACK", help="times this command, from text to UGRID")
    options.add_argument("--no-scipy", action="store_true", help="skips SciPy's diagrams, which take long")
    given = options.parse_args()
    os.environ["OMP_NUM_THREADS"] = str(given.threads)
    os.environ["PSTRIPACK_WARM_START"] = "0"  # repeated calls must not reuse the last mesh
    points = np.random.default_rng(1).normal(size=(given.nodes, 3))
    points /= np.linalg.norm(points, axis=1)[:, np.newaxis]
    if given.program:
        time_program(given, points)
        return
    import pstripack  # reads the environment

    places = np.random.default_rng(2).normal(size=(given.places or given.nodes, 3))
    mesh = pstripack.Delaunay(points, threads=given.threads)
    diagram = pstripack.SphericalVoronoi(points, threads=given.threads)
    seconds = least({
        "pstripack_trmesh, the library's call": OwnCall(given.library, points),
        "Delaunay(points).simplices": lambda: pstripack.Delaunay(points, threads=given.threads).simplices,
        "SphericalVoronoi(points)": lambda: pstripack.SphericalVoronoi(points, threads=given.threads),
        "SphericalVoronoi(points).regions": lambda: pstripack.SphericalVoronoi(points, threads=given.threads).regions,
        "calculate_areas() alone": diagram.calculate_areas,
        f"find_simplex, {len(places)} places": lambda: mesh.find_simplex(places),
        "nearest": lambda: mesh.nearest(places),
        "nearest, k=8, with distances": lambda: mesh.nearest(places, 8, distance=True),
        "interpolate, linear": lambda: mesh.interpolate(points[:, 0], places),
        "weights, linear": lambda: mesh.weights(places),
        "weights, natural": lambda: mesh.weights(places, "natural"),
        "gradient": lambda: mesh.gradient(points[:, 0]),
    }, given.repeats)
    if not given.no_scipy:
        import scipy.spatial
        theirs = scipy.spatial.SphericalVoronoi
        seconds |= least({"scipy's SphericalVoronoi(points).regions": lambda: theirs(points).regions,
                          "scipy's, sorted, and calculate_areas()": lambda: theirs(points).calculate_areas()}, 1)

    print(f"{given.nodes} random nodes, {given.threads} thread(s), pstripack {pstripack.__version__}")
    for name, time_taken in seconds.items():
        print(f"{time_taken:10.4f} s  {name}")
    own, simplices = list(seconds.values())[:2]
    print(f"{simplices / own:10.2f}    times the library's call from array to triangles")


if __name__ == "__main__":
    main()
