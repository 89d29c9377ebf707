"""Nodes for the tests, and calls of the C library."""
import ctypes
import os

import numpy as np

LIBRARY = ctypes.CDLL(os.environ["PSTRIPACK_LIBRARY"])


def random_nodes(n, seed=1):
    points = np.random.default_rng(seed).normal(size=(n, 3))
    return points / np.linalg.norm(points, axis=1)[:, np.newaxis]


def in_cap(n, seed=1, height=0.3):
    """Random nodes with z above `height`, in a hemisphere."""
    points = random_nodes(8 * n, seed)
    return np.ascontiguousarray(points[points[:, 2] > height][:n])


def address(array):
    return ctypes.c_void_p(array.ctypes.data)


def trmesh(points):
    """LIST, LPTR, LEND, LNEW of the C library."""
    n = len(points)
    columns = np.array(np.asarray(points, np.float64).T, order="C")
    list_, lptr, lend = (np.zeros(size, np.int32) for size in (6 * n - 12, 6 * n - 12, n))
    lnew = ctypes.c_int32()
    assert LIBRARY.pstripack_trmesh(n, *map(address, columns), *map(address, (list_, lptr, lend)),
                                    ctypes.byref(lnew)) == 0
    used = lnew.value - 1
    return list_[:used], lptr[:used], lend, lnew.value


def defect(points, lists):
    """The message of pstripack_validate about lists; empty: they are correct."""
    n = len(points)
    columns = np.array(np.asarray(points, np.float64).T, order="C")
    slots = [np.zeros(6 * n - 12, np.int32) for _ in range(2)]
    for room, part in zip(slots, lists):
        room[:len(part)] = part
    message = ctypes.create_string_buffer(200)
    code = LIBRARY.pstripack_validate(n, *map(address, columns), *map(address, (*slots, lists[2])), lists[3], message, 200)
    return message.value.decode() if code != 0 else ""


def as_sets(triangles):
    return {frozenset(t) for t in np.asarray(triangles).tolist()}
