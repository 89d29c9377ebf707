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
    """Part of :class:`Delaunay`. Arrays are computed on first access, once, and are read only. Lengths and areas are those
    of the unit sphere: radians and steradians, to be multiplied by the radius and its square. All is of the directions
    of the nodes."""

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
        """The two nodes of each edge, shape (e, 2): each edge once, the smaller node first, in the order of these; those
        with the same first node are counterclockwise round it."""
        indptr, indices = self.vertex_neighbor_vertices
        first = np.repeat(np.arange(self.npoints, dtype=np.int32), np.diff(indptr))
        once = first < indices
        return np.stack([first[once], indices[once]], axis=1)

    @property
    @once
    def edge_lengths(self) -> Floats:
        """Lengths of the edges in radians, right up to 1e-15 of themselves."""
        first, second = self.edges.T
        return self._mesh.distances(np.ascontiguousarray(self.points[first]), np.ascontiguousarray(second)[:, np.newaxis],
                                    self._threads)[:, 0]

    @property
    @once
    def edge_midpoints(self) -> Floats:
        """The middle of each edge, unit vectors, shape (e, 3)."""
        return self._mesh.midpoints(self.edges, self._threads)

    @property
    def hull_polygon(self) -> Ints:
        """The boundary nodes, shape (b,), counterclockwise round the triangles; empty if these cover the sphere."""
        return self._mesh.boundary()

    @property
    @once
    def circumcenters(self) -> Floats:
        """Centres of the triangles' circumscribed circles, on the unit sphere, shape (t, 3)."""
        return self._mesh.circumcentres(self._threads)

    @property
    @once
    def circumradii(self) -> Floats:
        """Radii of these circles in radians, shape (t,): less than pi/2, and right up to 1e-15 of themselves, beyond 60
        degrees up to 7e-15 radians."""
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
        """Centroids of the Voronoi cells, shape (n, 3): the unit vectors in the directions of the integrals of the position
        over the cells. Right up to 1e-15 radians for each unit of the cell's length over its width."""
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

        The gradient is that of the quadratic function in the tangent plane that passes through the value of the node and
        fits best those of its neighbours and their neighbours, weighted by one over the squared distance (Renka, ACM
        TOMS 10, 1984, section 3); that of a linear function where these nodes do not determine a quadratic one. Where they
        lie on a curve, to 3e-5 of their distances, such as a section or a track, it is the slope along the curve; the part
        across it, which they do not tell, is 0. The method "cubic" of :meth:`interpolate` uses the same. The error is of
        the second order in the distances between nodes, of the first order on the boundary.
        """
        given = real(self._enter(values, self.npoints))
        table = np.require(given.reshape(self.npoints, -1), np.float64, ["A", "C"])
        return self._mesh.gradients(table, self._threads).reshape(given.shape + (3,))

    def gradient_lonlat(self, values: ArrayLike) -> Tuple[Floats, Floats]:
        """The parts (east, north) of :meth:`gradient`, each of the shape of the values. At a pole they are along the
        meridians of 90 and of 0 degrees, as if the pole had the longitude 0."""
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
