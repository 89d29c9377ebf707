"""Exact Delaunay triangulations and Voronoi diagrams on the sphere, on threads.

Nodes, triangles and vertices count from 0, also in messages. Functions release Python's lock, and several threads may
call them at the same time. ``threads`` is the number of threads that one call uses; None: OMP_NUM_THREADS, or the
free processors. Any number of threads gives the same bytes.

Examples
--------
>>> import numpy as np
>>> from pstripack import Delaunay, SphericalVoronoi
>>> octahedron = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]])
>>> Delaunay(octahedron).simplices.shape
(8, 3)
>>> round(SphericalVoronoi(octahedron).calculate_areas().sum() / np.pi, 12)
4.0
"""
from ._arrays import to_lonlat, to_xyz
from ._core import version as __version__
from ._delaunay import Delaunay
from ._errors import BadCoordinateError, CoincidentNodesError, CollinearNodesError, TriangulationError
from ._scvt import Progress, Tessellation, scvt
from ._voronoi import SphericalVoronoi

__all__ = ["BadCoordinateError", "CoincidentNodesError", "CollinearNodesError", "Delaunay", "Progress",
           "SphericalVoronoi", "Tessellation", "TriangulationError", "__version__", "scvt", "to_lonlat", "to_xyz"]
