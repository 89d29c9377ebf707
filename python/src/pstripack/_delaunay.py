"""Delaunay triangulations on the sphere."""
import os
from typing import Any, Dict, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import (Floats, Ints, mesh_of, node_array, place_array, read_only, real, refuse_what_may_be_radians,
                      thread_count, to_xyz, unmasked)
from ._errors import BadCoordinateError
from ._globe import Globe, globe, notebook_html


class Delaunay:
    """The Delaunay triangulation of nodes on the sphere. It covers the sphere, or the convex hull of nodes that lie in a
    hemisphere.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        Vectors from the centre of the sphere to the nodes; only their directions matter. They are copied.
    threshold : float, optional
        Nodes this near to each other, in radians, are refused as if they coincided: 1.6e-10 is a millimetre on the
        Earth.
    threads : int, optional
        Number of threads for the triangulation and for all that is computed from it.

    Raises
    ------
    BadCoordinateError, CoincidentNodesError, CollinearNodesError, TriangulationError
        All are ValueError; their attribute ``nodes`` has the indices of the nodes in question, counted from 0.

    Names and conventions are those of scipy.spatial.Delaunay. Arrays are computed on first access.

    >>> mesh = Delaunay.from_lonlat([0, 90, 180, 270, 0, 0], [0, 0, 0, 0, 90, -90])
    >>> mesh.simplices[:2]
    array([[0, 1, 4],
           [0, 4, 3]], dtype=int32)
    >>> mesh.neighbors[0]
    array([5, 1, 3], dtype=int32)
    >>> mesh.find_simplex([1, 1, 1]).item(), mesh.nearest([1, 2, 1]).item()
    (0, 1)
    >>> mesh.interpolate([0, 1, 2, 3, 4, 5], [[1, 1, 0], [0, 0, 2]])
    array([0.5, 4. ])
    """

    def __init__(self, points: ArrayLike, *, threshold: float = 0, threads: Optional[int] = None) -> None:
        self._threads = thread_count(threads)
        self._mesh = mesh_of(node_array(points), threshold, self._threads)
        #: The nodes as given, read only.
        self.points: Floats = read_only(self._mesh.points)
        self._simplices: Optional[Ints] = None
        self._neighbors: Optional[Ints] = None
        self._vertex_neighbors: Optional[Tuple[Ints, Ints]] = None

    @classmethod
    def from_lonlat(cls, lon: ArrayLike, lat: ArrayLike, *, degrees: bool = True, units: Optional[str] = None,
                    threshold: float = 0, threads: Optional[int] = None) -> "Delaunay":
        """The triangulation of nodes given by longitudes and latitudes; see :func:`to_xyz`.

        ``units``: "degrees" or "radians". Without it: radians if ``degrees`` is false; else degrees, and a ValueError if
        no longitude is beyond 2 pi and no latitude beyond pi/2, since these may be radians.
        """
        if units not in (None, "degrees", "radians"):
            raise ValueError(f"units must be 'degrees' or 'radians', not {units!r}")
        lon, lat = np.ravel(real(lon)), np.ravel(real(lat))
        if units is None and degrees:
            refuse_what_may_be_radians(lon, lat)
        points = to_xyz(lon, lat, degrees if units is None else units == "degrees")
        wrong = np.isnan(points[:, 0])
        if np.any(wrong):
            node = int(np.argmax(wrong))
            where = [float(np.broadcast_to(angle, len(points))[node]) for angle in (lon, lat)]
            raise BadCoordinateError(f"node {node} (counted from 0) is at longitude {where[0]:g}, latitude {where[1]:g}: "
                                     "both must be finite", (node,))
        return cls(points, threshold=threshold, threads=threads)

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_mesh": None}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        """For pickles and copies: triangulates again, which gives the same mesh."""
        self.__dict__.update(state)
        self._mesh = _core.Mesh(self.points, self._threads)
        self.points = read_only(self._mesh.points)

    def __repr__(self) -> str:
        return f"<pstripack.Delaunay of {self.npoints} nodes>"

    @property
    def npoints(self) -> int:
        """Number of nodes."""
        return len(self.points)

    @property
    def simplices(self) -> Ints:
        """Corners of the triangles, shape (t, 3): counterclockwise seen from outside, the smallest first."""
        if self._simplices is None:
            self._simplices = self._mesh.triangles(self._threads)
        return self._simplices

    @property
    def nsimplex(self) -> int:
        """Number of triangles."""
        return len(self.simplices)

    @property
    def neighbors(self) -> Ints:
        """The triangle opposite each corner, shape (t, 3); -1: none."""
        if self._neighbors is None:
            self._neighbors = self._mesh.opposite_triangles(self._threads)
        return self._neighbors

    @property
    def vertex_neighbor_vertices(self) -> Tuple[Ints, Ints]:
        """(indptr, indices): the neighbours of node k are indices[indptr[k]:indptr[k+1]], counterclockwise. For a boundary
        node the first and the last one are its neighbours on the boundary."""
        if self._vertex_neighbors is None:
            self._vertex_neighbors = self._mesh.neighbours(self._threads)
        return self._vertex_neighbors

    @property
    def vertex_to_simplex(self) -> Ints:
        """One triangle of each node."""
        result = np.empty(self.npoints, np.int32)
        result[self.simplices] = np.arange(self.nsimplex, dtype=np.int32)[:, np.newaxis]
        return result

    @property
    def convex_hull(self) -> Ints:
        """Boundary arcs, shape (b, 2), counterclockwise around the triangles; each begins where the previous one ends.
        b = 0 if the triangles cover the sphere."""
        nodes = self._mesh.boundary()
        return np.stack([nodes, np.roll(nodes, -1)], axis=1)

    @property
    def circumcenters(self) -> Floats:
        """Centres of the triangles' circumscribed circles, on the unit sphere, shape (t, 3)."""
        return self._mesh.circumcentres(self._threads)

    @property
    def areas(self) -> Floats:
        """Areas of the triangles in steradians."""
        return self._mesh.triangle_areas(self._threads)

    @property
    def cell_areas(self) -> Floats:
        """Areas of the nodes' Voronoi cells in steradians; their sum is 4 pi. If the nodes lie in a hemisphere, the cells
        of boundary nodes share the rest of the sphere."""
        return self._mesh.cell_areas(self._threads)

    @property
    def lists(self) -> Tuple[Ints, Ints, Ints, int]:
        """LIST, LPTR, LEND and LNEW as STRIPACK's TRMESH returns them: nodes and slots count from 1."""
        return self._mesh.lists()

    def find_simplex(self, xi: ArrayLike, *, threads: Optional[int] = None) -> Ints:
        """The triangle that contains each place; -1: none. ``xi``: vectors, shape (..., 3). Places up to 1e-12
        outside the triangles count as on their border."""
        places = place_array(xi)
        found = self._mesh.find(places.reshape(-1, 3), self.simplices, self._number(threads))
        return found.reshape(places.shape[:-1])

    def nearest(self, xi: ArrayLike, *, threads: Optional[int] = None) -> Ints:
        """The node nearest to each place; -1 for vectors that are zero or not finite. ``xi``: shape (..., 3)."""
        places = place_array(xi)
        return self._mesh.nearest(places.reshape(-1, 3), self._number(threads)).reshape(places.shape[:-1])

    def interpolate(self, values: ArrayLike, xi: ArrayLike, method: str = "linear", *, outside: str = "nan",
                    threads: Optional[int] = None) -> NDArray[Any]:
        """Values at places, interpolated between the nodes.

        Parameters
        ----------
        values : array_like, shape (n,) or (n, ...)
            One or several values of each node.
        xi : array_like, shape (..., 3)
            Vectors to the places.
        method : {"linear", "natural", "cubic", "nearest"}
            "linear": linear on triangles; continuous. "natural": natural neighbours (Sibson), weighted by the area that
            their Voronoi cells would lose to a node at the place; smooth except at the nodes. "cubic": natural
            neighbours and gradients estimated from neighbours and their neighbours; smooth; results can exceed the
            range of the values, and a value that is not finite spoils results around it. "nearest": the value of the
            nearest node.
        outside : {"nan", "nearest"}
            Result of the other methods at places outside the triangles.
        """
        if method not in ("linear", "natural", "cubic", "nearest"):
            raise ValueError(f"method must be 'linear', 'natural', 'cubic' or 'nearest', not {method!r}")
        if outside not in ("nan", "nearest"):
            raise ValueError(f"outside must be 'nan' or 'nearest', not {outside!r}")
        given = unmasked(values)
        if given.ndim < 1 or len(given) != self.npoints:
            raise ValueError(f"values must be one for each of {self.npoints} nodes; their shape is {given.shape}")
        places = place_array(xi)
        if method == "nearest":
            near = self.nearest(places, threads=threads)
            if np.any(near < 0):
                raise ValueError(f"place {int(np.argmax(near.ravel() < 0))} (counted from 0) has no direction")
            return np.asarray(given[near])
        table = np.require(real(given).reshape(self.npoints, -1), np.float64, ["A", "C"])
        result = self._mesh.interpolate(method, places.reshape(-1, 3), table, self._number(threads))
        if outside == "nearest":
            missing = np.flatnonzero(self.find_simplex(places, threads=threads).ravel() < 0)
            near = self.nearest(places.reshape(-1, 3)[missing], threads=threads)
            result[missing[near >= 0]] = table[near[near >= 0]]
        return result.reshape(places.shape[:-1] + given.shape[1:])

    def globe(self, values: Optional[ArrayLike] = None, file: "Optional[Union[str, os.PathLike[str]]]" = None, *,
              title: Optional[str] = None, name: str = "value", unit: str = "",
              coasts: "Union[bool, str, os.PathLike[str]]" = False,
              three_file: "Optional[Union[str, os.PathLike[str]]]" = None) -> Globe:
        """A globe to turn, of Voronoi cells: a page for any browser, which notebooks show.

        Parameters
        ----------
        values : array_like, shape (n,), optional
            The cells have the colours of these numbers, called ``name``, in ``unit``; NaN: grey. Without them: of the
            areas, on a sphere of radius 6371 km.
        file : path, optional
            The page is also written to this file.
        coasts : bool or path
            Coast lines: True: Natural Earth's, of Debian's libmagics++-data; or those of a shapefile in degrees.
        three_file : path, optional
            The file three.min.js, of release 111 to 160. None: what the environment variable PSTRIPACK_THREE names, or
            the wheel's, or that of Debian's libjs-three. RuntimeError if there is none.
        """
        return globe(self, values, file, title, name, unit, coasts, three_file)

    def _repr_html_(self) -> str:
        return notebook_html(self)

    def _number(self, threads: Optional[int]) -> int:
        return self._threads if threads is None else thread_count(threads)
