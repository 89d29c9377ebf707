"""What a triangulation measures: lengths, areas, centres, gradients."""
import abc
import functools
from typing import Any, Callable, Dict, Tuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import Floats, Ints, read_only, real, unit_vectors
from ._values import Values

Result = TypeVar("Result", Floats, Ints, Tuple[Ints, Ints])


def once(compute: "Callable[[Any], Result]") -> "Callable[[Any], Result]":
    """Computes an array, or a tuple of arrays, on the first call only; they are read only. Threads that call at a time may
    compute it each."""
    name = compute.__name__

    @functools.wraps(compute)
    def known(self: Any) -> Result:
        if name not in self._known:
            result: Any = compute(self)
            self._known[name] = tuple(map(read_only, result)) if isinstance(result, tuple) else read_only(result)
        kept: Result = self._known[name]
        return kept

    return known


class Measures(Values):
    """Part of :class:`Delaunay`. Arrays are computed on first access, once, and are read only. Lengths are radians and areas
    steradians: multiply them by the radius and by its square. Lengths of the vectors to the nodes do not count."""

    _mesh: _core.Mesh
    _threads: int
    _known: Dict[str, Any]
    points: Floats

    @property
    @abc.abstractmethod
    def npoints(self) -> int: ...

    @property
    @abc.abstractmethod
    def vertex_neighbor_vertices(self) -> Tuple[Ints, Ints]: ...

    @property
    @once
    def edges(self) -> Ints:
        """The two nodes of each edge, shape (e, 2). Each edge occurs once, the smaller node first. Edges are sorted by their
        first node; those with the same first node are counterclockwise round it."""
        indptr, indices = self.vertex_neighbor_vertices
        first = np.repeat(np.arange(self.npoints, dtype=np.int32), np.diff(indptr))
        once = first < indices
        return np.stack([first[once], indices[once]], axis=1)

    @property
    @once
    def edge_lengths(self) -> Floats:
        """Lengths of the edges in radians, shape (e,). The relative error is at most 1e-15."""
        first, second = self.edges.T
        return self._mesh.distances(np.ascontiguousarray(self.points[first]), np.ascontiguousarray(second)[:, np.newaxis],
                                    self._threads)[:, 0]

    @property
    @once
    def edge_midpoints(self) -> Floats:
        """Unit vectors to the middle of each edge, shape (e, 3)."""
        return self._mesh.midpoints(self.edges, self._threads)

    @property
    def hull_polygon(self) -> Ints:
        """The boundary nodes, shape (b,), counterclockwise round the triangles. Empty if the triangles cover the sphere."""
        return self._mesh.boundary()

    @property
    @once
    def circumcenters(self) -> Floats:
        """Centres of the triangles' circumscribed circles, on the unit sphere, shape (t, 3)."""
        return self._mesh.circumcentres(self._threads)

    @property
    @once
    def circumradii(self) -> Floats:
        """Radii of the triangles' circumscribed circles in radians, shape (t,), less than pi/2. The relative error is at most
        1e-15; for radii beyond 60 degrees the error is at most 7e-15 radians."""
        return self._mesh.circumradii(self._threads)

    @property
    @once
    def areas(self) -> Floats:
        """Areas of the triangles in steradians, shape (t,)."""
        return self._mesh.triangle_areas(self._threads)

    @property
    @once
    def cell_areas(self) -> Floats:
        """Areas of the nodes' Voronoi cells in steradians, shape (n,); their sum is 4 pi. If the nodes lie in a hemisphere,
        the cells of boundary nodes share the rest of the sphere."""
        return self._mesh.cell_areas(self._threads)

    @property
    @once
    def cell_centroids(self) -> Floats:
        """Centroids of the Voronoi cells, shape (n, 3): unit vectors in the directions of the integrals of the position over
        the cells. The error is at most 1e-15 radians times the cell's length over its width."""
        return self._mesh.cell_centroids(self._threads)

    def gradient(self, values: ArrayLike) -> Floats:
        """Gradients of values at the nodes.

        Parameters
        ----------
        values : array_like, shape (n,) or (n, ...)
            One or several values of each node, in the order of the nodes or with their ``labels``. A value that is not
            finite spoils the gradients around it.

        Returns
        -------
        array, shape (n, 3) or (n, ..., 3)
            Vectors, each tangential at its node, in units of the values for each radian: divide them by the radius.

        Notes
        -----
        A quadratic function in the tangent plane passes through the value of the node. It fits best the values of its
        neighbours and of their neighbours, weighted by one over the squared distance (Renka, ACM TOMS 10, 1984,
        section 3). The result is the gradient of this function, or of a linear one where the nodes do not determine a
        quadratic one. Where the nodes lie on a curve, such as a section or a track, to 3e-5 of their distances, the result
        is the slope along the curve. The part across the curve is 0. The method "cubic" of :meth:`interpolate` uses these
        gradients. The error is of the second order in the distances between nodes, on the boundary of the first order.

        Examples
        --------
        >>> from pstripack import Delaunay
        >>> mesh = Delaunay.from_lonlat([0, 90, 180, 270, 0, 0], [0, 0, 0, 0, 90, -90])
        >>> mesh.gradient([1, 1, 1, 1, 1, 1]).shape
        (6, 3)
        """
        given = real(self._enter(values, self.npoints))
        table = np.require(given.reshape(self.npoints, -1), np.float64, ["A", "C"])
        return self._mesh.gradients(table, self._threads).reshape(given.shape + (3,))

    def gradient_lonlat(self, values: ArrayLike) -> Tuple[Floats, Floats]:
        """Gradients of values at the nodes, to the east and to the north.

        Parameters
        ----------
        values : array_like, shape (n,) or (n, ...)
            As in :meth:`gradient`.

        Returns
        -------
        east, north : arrays of the shape of the values
            The parts of :meth:`gradient`. At a pole they are along the meridians of 90 and of 0 degrees, as if the pole had
            the longitude 0.

        Examples
        --------
        >>> from pstripack import Delaunay
        >>> mesh = Delaunay.from_lonlat([0, 90, 180, 270, 0, 0], [0, 0, 0, 0, 90, -90])
        >>> east, north = mesh.gradient_lonlat(mesh.points[:, 2])
        >>> bool(abs(east).max() < 1e-12), bool(north[0] > 0)
        (True, True)
        """
        slopes = self.gradient(values)
        x, y, z = unit_vectors(self.points).T
        level = np.hypot(x, y)
        at_pole = level == 0
        level[at_pole] = 1
        cosine, sine = np.where(at_pole, 1.0, x / level), y / level
        axes: Tuple[NDArray[Any], ...] = (np.stack([-sine, cosine, 0 * x], 1),
                                          np.stack([-z * cosine, -z * sine, np.hypot(x, y)], 1))
        east, north = (np.einsum("i...k,ik->i...", slopes, axis) for axis in axes)
        return east, north
