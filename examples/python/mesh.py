"""Triangulates 1000 nodes on the unit sphere and adds up the areas of the triangles, by NumPy and ctypes.

$ python3 mesh.py
"""
import ctypes

import numpy as np

LIBRARY = ctypes.CDLL("libpstripack.so.0")  # in the path of the loader, or LD_LIBRARY_PATH
LIBRARY.pstripack_strerror.restype = ctypes.c_char_p


def triangulate(xyz):
    """The triangles, an array (n, 3) of node numbers from 0: counterclockwise, the smallest first."""
    def pointer(array, kind):
        return array.ctypes.data_as(ctypes.POINTER(kind))

    x, y, z = np.ascontiguousarray(np.asarray(xyz, dtype=np.float64).T)
    n = len(x)
    slots = max(6 * n - 12, 0)
    list_, lptr, lend = (np.zeros(size, dtype=np.int32) for size in (slots, slots, n))
    lnew = ctypes.c_int32()
    ier = LIBRARY.pstripack_trmesh(n, *(pointer(a, ctypes.c_double) for a in (x, y, z)),
                                   *(pointer(a, ctypes.c_int32) for a in (list_, lptr, lend)),
                                   ctypes.byref(lnew))
    if ier != 0:
        raise ValueError(LIBRARY.pstripack_strerror(ier).decode())

    # The neighbours of a node fill consecutive slots up to lend. A node and two consecutive neighbours form a
    # triangle. A negative neighbour is the last one of a boundary node and forms no triangle with the first.
    used = lnew.value - 1
    node = np.repeat(np.arange(1, n + 1), np.diff(lend, prepend=0))
    neighbour, following = list_[:used], np.abs(list_[lptr[:used] - 1])
    triangles = np.stack([node, neighbour, following], axis=1)
    return triangles[(neighbour > node) & (following > node)] - 1


def areas(a, b, c):
    """Areas of triangles of unit vectors (Van Oosterom and Strackee)."""
    def dot(u, v):
        return np.sum(u * v, axis=-1)

    return 2 * np.arctan2(dot(a, np.cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a))


def spiral(n):
    """A spiral of n nodes from pole to pole, a golden angle from node to node."""
    k = np.arange(n)
    z, longitude = 1 - (2 * k + 1) / n, k * np.pi * (3 - np.sqrt(5))
    radius = np.sqrt(1 - z**2)
    return np.stack([radius * np.cos(longitude), radius * np.sin(longitude), z], axis=1)


if __name__ == "__main__":
    nodes = spiral(1000)
    corners = triangulate(nodes)
    area = areas(*(nodes[corners[:, i]] for i in range(3))).sum()
    print(f"{len(nodes)} nodes, {len(corners)} triangles, area {area:.6f}")
