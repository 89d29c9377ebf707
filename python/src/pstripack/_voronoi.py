"""Voronoi diagrams on the sphere with the interface of SciPy."""
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import Floats, Ints, node_array, read_only, thread_count
from ._errors import BadCoordinateError, CoincidentNodesError, TriangulationError


class SphericalVoronoi:
    """The Voronoi diagram of points on a sphere in three dimensions. Attributes, arguments and exceptions are those of
    scipy.spatial.SphericalVoronoi.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        Generators.
    radius : float, optional
        Radius of the sphere.
    center : array_like, shape (3,), optional
        Centre of the sphere; default: the origin.
    threshold : float, optional
        Points closer to each other than threshold * radius are refused, and points whose distance from the sphere is more
        than threshold * radius.
    threads : int, optional
        Number of threads.

    Attributes
    ----------
    points, radius, center
        As given; ``points`` is a copy.
    vertices : array, shape (2n - 4, 3)
        Corners of the regions. Where more than three regions meet, several vertices coincide up to rounding.
    regions : list of lists of int
        The vertices of each region, always in counterclockwise order, seen from outside; SciPy's are not. Computed on
        first access.
    region_vertices : tuple of arrays (indptr, indices)
        The vertices of region k are indices[indptr[k]:indptr[k+1]]: faster than ``regions``.

    Raises
    ------
    ValueError
        If there are fewer than four points, all lie in one plane, two coincide, or one is not on the sphere. Messages
        count points from 0; a TriangulationError has their indices in the attribute ``nodes``.

    Examples
    --------
    >>> import numpy as np
    >>> from pstripack import SphericalVoronoi
    >>> corners = np.array([[1, 1, 1], [-1, -1, 1], [-1, 1, -1], [1, -1, -1]]) / np.sqrt(3)
    >>> diagram = SphericalVoronoi(corners)
    >>> diagram.regions
    [[1, 2, 0], [0, 3, 1], [2, 3, 0], [1, 3, 2]]
    >>> diagram.calculate_areas() / np.pi
    array([1., 1., 1., 1.])
    """

    def __init__(self, points: ArrayLike, radius: float = 1, center: Optional[ArrayLike] = None,
                 threshold: float = 1e-06, *, threads: Optional[int] = None) -> None:
        if radius is None:
            raise ValueError("radius is None: a number is needed")
        self.radius = float(radius)
        if not (np.isfinite(self.radius) and self.radius > 0):
            raise ValueError(f"radius is {radius}: a positive number is needed")
        self.points: Floats = np.array(node_array(points), order="C")
        self.center: Floats = np.zeros(3) if center is None else np.array(center, dtype=np.float64)
        if self.center.shape != (3,):
            raise ValueError(f"center must have three coordinates; its shape is {self.center.shape}")
        number = thread_count(threads)

        vectors = self._vectors()
        self._check_on_sphere(vectors, threshold)
        if _rank(vectors, threshold) < 3:
            raise ValueError("Rank of input points must be at least 3: they lie in one plane")
        try:
            mesh = _core.Mesh(vectors, number)
        except CoincidentNodesError as error:
            raise _duplicates(error.nodes) from None
        distance, first, second = mesh.closest_pair(number)
        if distance <= threshold:
            raise _duplicates((first, second))
        self._mesh, self._threads = mesh, number
        vertices, begin, indices = mesh.cells(number)
        if self.radius != 1 or self.center.any():
            vertices = self.radius * vertices + self.center
        self.vertices: Floats = vertices
        self.region_vertices: Tuple[Ints, Ints] = (read_only(begin), read_only(indices))
        self._regions: Optional[List[List[int]]] = None

    def __repr__(self) -> str:
        arcs = len(self._mesh.boundary())
        return (f"<pstripack.SphericalVoronoi: {len(self.points)} regions, {len(self.vertices)} vertices, "
                f"radius {self.radius:g}, "
                + (f"points in a hemisphere, boundary of {arcs} arcs>" if arcs > 0 else "whole sphere>"))

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_mesh": None}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        """For pickles and copies: triangulates again, which gives the same mesh."""
        self.__dict__.update(state)
        self._mesh = _core.Mesh(self._vectors(), self._threads)

    def _vectors(self) -> Floats:
        """The points on the unit sphere."""
        if self.radius == 1 and not self.center.any():
            return self.points
        vectors: Floats = (self.points - self.center) / self.radius
        return vectors

    @property
    def regions(self) -> List[List[int]]:
        """The vertices of each region."""
        if self._regions is None:
            self._regions = _core.lists_of(*self.region_vertices, 2 * len(self.points) - 4)
        return self._regions

    @property
    def _simplices(self) -> Ints:
        """As scipy's: the three points, in increasing order, of whose regions each vertex is a corner."""
        indptr, indices = self.region_vertices
        region = np.repeat(np.arange(len(self.points), dtype=np.int32), np.diff(indptr))
        return region[np.argsort(indices, kind="stable")].reshape(-1, 3)

    def sort_vertices_of_regions(self) -> None:
        """Does nothing: the vertices of each region are always in order."""

    def calculate_areas(self) -> Floats:
        """Areas of the regions.

        Returns
        -------
        array, shape (n,)
            Their sum is ``4 pi radius**2``.

        Examples
        --------
        >>> from pstripack import SphericalVoronoi
        >>> SphericalVoronoi([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]]).calculate_areas()[0]
        2.09...
        """
        return self._mesh.cell_areas(self._threads) * self.radius**2

    def _check_on_sphere(self, vectors: Floats, threshold: float) -> None:
        with np.errstate(over="ignore", invalid="ignore"):
            off = np.abs(np.sqrt(np.einsum("ij,ij->i", vectors, vectors)) - 1)
            wrong = np.flatnonzero(~(off < threshold))
        if len(wrong) == 0:
            return
        first = int(wrong[0])
        if not np.isfinite(self.points[first]).all():
            x, y, z = self.points[first]
            raise BadCoordinateError(
                f"point {first} (counted from 0) is ({x:g}, {y:g}, {z:g}): coordinates must be finite", (first,))
        raise TriangulationError(
            f"Radius inconsistent with generators: point {first} (counted from 0) of {len(wrong)} is "
            f"{off[first] * self.radius:g} off the sphere; give radius and center, or a larger threshold", (first,))


def _duplicates(nodes: Tuple[int, ...]) -> CoincidentNodesError:
    first, second = sorted(nodes[:2])
    return CoincidentNodesError(
        f"Duplicate generators present: points {first} and {second} (counted from 0)", (first, second))


def _rank(points: Floats, threshold: float) -> int:
    """The rank of the differences of the points."""
    if len(points) < 4:
        return len(points) - 1
    differences = points - points[0]
    squares = np.linalg.eigvalsh(differences.T @ differences)
    if squares[0] > max(1e-6 * squares[2], 4 * threshold**2):  # certain despite rounding
        return 3
    return int(np.linalg.matrix_rank(differences, tol=threshold))
