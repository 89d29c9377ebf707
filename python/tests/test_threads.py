import concurrent.futures
import multiprocessing
import os
import re
import subprocess
import sys
import threading

import numpy as np
import pytest
from nodes import in_cap, random_nodes
from pstripack import Delaunay, SphericalVoronoi

POINTS, CAP = random_nodes(30000), in_cap(25000)
PLACES = np.random.default_rng(4).normal(size=(5000, 3))


def everything(points, threads):
    mesh = Delaunay(points, threads=threads)
    diagram = SphericalVoronoi(points, threads=threads, threshold=1e-12)
    return [*mesh.lists[:3], mesh.simplices, mesh.neighbors, *mesh.vertex_neighbor_vertices, mesh.circumcenters,
            mesh.areas, mesh.cell_areas, diagram.vertices, *diagram.region_vertices, diagram.calculate_areas(),
            mesh.find_simplex(PLACES), mesh.nearest(PLACES),
            *(mesh.interpolate(points[:, 0], PLACES, method) for method in ("linear", "natural", "cubic"))]


def same(one, other):
    return all(np.array_equal(a, b, equal_nan=a.dtype.kind == "f") for a, b in zip(one, other))


@pytest.mark.parametrize("points", [POINTS, CAP], ids=["sphere", "cap"])
def test_any_number_of_threads_gives_the_same_bytes(points):
    alone = everything(points, 1)
    for threads in 2, 3, None:
        assert same(alone, everything(points, threads))


def test_calls_from_several_threads_at_a_time():
    sets = [random_nodes(21000, seed) for seed in range(4)]
    expected = [everything(points, 1) for points in sets]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for alone, result in zip(expected, pool.map(everything, sets, [1, 2, None, 1])):
            assert same(alone, result)


def test_one_triangulation_is_asked_by_several_threads():
    mesh = Delaunay(POINTS)
    expected = mesh.nearest(PLACES)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        assert all(np.array_equal(expected, result) for result in pool.map(mesh.nearest, [PLACES] * 8))


def test_python_goes_on_during_a_call():
    points = random_nodes(200000)
    before = sys.getswitchinterval()
    sys.setswitchinterval(1000)  # from now on another thread runs only while this one has released Python's lock
    try:
        for _ in range(20):  # this thread may have to wait for a processor
            done = []
            worker = threading.Thread(target=lambda: done.append(Delaunay(points, threads=1)))
            worker.start()  # returns when the worker releases the lock
            was_running = not done
            worker.join()
            if was_running:
                return
        pytest.fail("Delaunay keeps Python's lock")
    finally:
        sys.setswitchinterval(before)


def in_child():
    return Delaunay(POINTS, threads=2).nsimplex, int(Delaunay(POINTS, threads=2).nearest(PLACES).sum())


def test_a_forked_child_may_triangulate():
    expected = in_child()  # OpenMP's threads run in this process, not in the child
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.apply_async(in_child).get(60) == expected


def test_threads_is_the_number_of_one_call_only():
    script = ("import numpy, pstripack; points = numpy.random.default_rng(1).normal(size=(60000, 3));"
              "pstripack.Delaunay(points, threads=3); pstripack.Delaunay(points[:50000])")
    report = subprocess.run([sys.executable, "-c", script], check=True, stderr=subprocess.PIPE, text=True,
                            env={**os.environ, "PSTRIPACK_REPORT": "1", "OMP_NUM_THREADS": "2"}).stderr
    assert re.findall(r"n=(\d+) .*?threads=(\d+)", report) == [("60000", "3"), ("50000", "2")]
