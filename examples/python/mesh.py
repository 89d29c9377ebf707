"""Triangulates 1000 nodes on the unit sphere and adds up the areas of the triangles.

$ python3 mesh.py
"""
import numpy as np
from pstripack import Delaunay


def spiral(n):
    """A spiral of n nodes from pole to pole, a golden angle from node to node."""
    k = np.arange(n)
    z, longitude = 1 - (2 * k + 1) / n, k * np.pi * (3 - np.sqrt(5))
    radius = np.sqrt(1 - z**2)
    return np.stack([radius * np.cos(longitude), radius * np.sin(longitude), z], axis=1)


mesh = Delaunay(spiral(1000))
print(f"{len(mesh.points)} nodes, {len(mesh.simplices)} triangles, area {mesh.areas.sum():.6f}")
