"""What a triangulation tells of places: the triangle, the nearest nodes, weights, interpolated values."""
import abc
import operator
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import (Floats, Ints, are_degrees, fit_each_other, in_radians, place_array, real, scalar, thread_count,
                      vectors_of)
from ._values import Values


class Places(Values):
    """Part of :class:`Delaunay`. Places are ``xi``, vectors of any length, shape (..., 3), or ``lon`` and ``lat``, which
    are broadcast: ``lon=lon, lat=lat[:, np.newaxis]`` is a grid. Results have the shape of the places. Angles have names
    in each call, so that they are not taken for vectors, nor for each other. Their units are those of
    :meth:`Delaunay.from_lonlat`, if that made the mesh; otherwise degrees, refused where they may be radians.
    ``units="degrees"`` or ``"radians"`` decides."""

    _mesh: _core.Mesh
    _threads: int
    _units: Optional[str] = None  #: of from_lonlat

    @property
    @abc.abstractmethod
    def npoints(self) -> int: ...

    @property
    @abc.abstractmethod
    def simplices(self) -> Ints: ...

    def find_simplex(self, xi: Optional[ArrayLike] = None, *, lon: Optional[ArrayLike] = None,
                     lat: Optional[ArrayLike] = None, units: Optional[str] = None,
                     threads: Optional[int] = None) -> Ints:
        """The triangle that contains each place; -1: none. A place outside the triangles counts as on their border if it is
        inside when moved by 1e-12 of the way to the middle of the nodes and 4e-16 radians. Of two triangles with the place
        on their common side it is that with the smaller third corner.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
            Vectors of any length to the places.
        lon, lat : array_like
            In place of them, longitudes and latitudes in the units of from_lonlat, by default degrees; or in ``units``.
        """
        places = self._vectors(xi, lon, lat, units)
        found, _ = self._mesh.find(places.reshape(-1, 3), self.simplices, False, self._number(threads))
        simplex: Ints = scalar(found.reshape(places.shape[:-1]))
        return simplex

    def barycentric(self, xi: Optional[ArrayLike] = None, *, lon: Optional[ArrayLike] = None,
                    lat: Optional[ArrayLike] = None, units: Optional[str] = None,
                    threads: Optional[int] = None) -> Tuple[Ints, Floats]:
        """The triangle that contains each place, and the place's barycentric coordinates in it.

        Returns
        -------
        simplex : array of int, shape (...)
            As of :meth:`find_simplex`.
        coordinates : array, shape (..., 3)
            The weights of the corners ``simplices[simplex]``: det(p, b, c), det(a, p, c), det(a, b, p) over their sum,
            which are those of the point where the ray to p meets the plane of the triangle (Renka, SSRFPACK, ACM TOMS
            23, 1997). None is below 0, their sum is 1. On a side the opposite corner has 0; at a node it has 1.
            NaN outside the triangles.

        Raises
        ------
        ValueError
            If a place has no direction; tells which.
        """
        places = _with_directions(self._vectors(xi, lon, lat, units), lon, lat)
        found, table = self._mesh.find(places.reshape(-1, 3), self.simplices, True, self._number(threads))
        return scalar(found.reshape(places.shape[:-1])), np.asarray(table).reshape(places.shape)

    def nearest(self, xi: Optional[ArrayLike] = None, k: int = 1, *, lon: Optional[ArrayLike] = None,
                lat: Optional[ArrayLike] = None, units: Optional[str] = None, distance: bool = False,
                radius: Optional[float] = None, threads: Optional[int] = None) -> Any:
        """The nodes nearest to each place. Their order is exact; of equally near nodes the smallest number is first.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
            Vectors of any length to the places.
        k : int
            Number of nodes for each place.
        lon, lat : array_like
            In place of ``xi``, longitudes and latitudes in the units of from_lonlat, by default degrees; or in ``units``.
        distance : bool
            Also return the distances, along great circles, in radians; right up to 1e-15 of themselves.
        radius : float, optional
            Return all nodes up to this distance in radians instead of k nodes; at most pi.

        Returns
        -------
        nodes : array of int, shape (...); (..., k) if k > 1; a number for one place
        distances, nodes : as scipy.spatial.cKDTree.query returns them, with ``distance``
        indptr, indices : with ``radius``; the nodes of place i, counted in C order, are
            indices[indptr[i]:indptr[i+1]], the nearest first
        distances, indptr, indices : with both

        Raises
        ------
        ValueError
            If a place has no direction; tells which.

        The nearest node: steps to nearer neighbours. Another node that is among the k nearest is a neighbour of a nearer
        one.
        """
        places = self._vectors(xi, lon, lat, units)
        flat, number = places.reshape(-1, 3), self._number(threads)
        if radius is not None:
            if k != 1:
                raise ValueError("give k or radius, not both")
            in_radians("radius", radius)
            _with_directions(places, lon, lat)
            indptr, indices, distances = self._mesh.within(flat, float(radius), number)
            return (distances, indptr, indices) if distance else (indptr, indices)
        try:
            k = operator.index(k)
        except TypeError:
            raise ValueError(f"k must be a whole number, not {k!r}") from None
        if not 1 <= k <= self.npoints:
            raise ValueError(f"k must be from 1 to {self.npoints}, the number of nodes; not {k}")
        nodes = self._mesh.nearest(flat, number) if k == 1 else self._mesh.k_nearest(flat, k, number)
        if np.any(nodes < 0):
            _with_directions(places, lon, lat)
        shape = places.shape[:-1] + ((k,) if k > 1 else ())
        if not distance:
            return scalar(nodes.reshape(shape))
        distances = self._mesh.distances(flat, nodes.reshape(-1, k), number)
        return scalar(distances.reshape(shape)), scalar(nodes.reshape(shape))

    def weights(self, xi: Optional[ArrayLike] = None, method: str = "linear", *, lon: Optional[ArrayLike] = None,
                lat: Optional[ArrayLike] = None, units: Optional[str] = None, outside: str = "empty",
                threads: Optional[int] = None) -> Any:
        """The weights of the nodes in an interpolated value at each place, to be used again and again:
        ``mesh.weights(places) @ values`` is ``mesh.interpolate(values, places)`` up to rounding. The matrix takes values in
        the order of the nodes: of a Series, ``values[mesh.labels]``. Outside the triangles the product is 0, unless
        ``outside`` says otherwise.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
            Vectors of any length to the places.
        method : {"linear", "natural", "cubic"}
            As of :meth:`interpolate`.
        lon, lat : array_like
            In place of ``xi``, longitudes and latitudes in the units of from_lonlat, by default degrees; or in ``units``.
        outside : {"empty", "nearest", "nan"}
            The row of a place outside the triangles: no weight, or 1 for the nearest node, or NaN for it, so that products
            are NaN.

        Returns
        -------
        scipy.sparse.csr_matrix, shape (number of places, n)
            Places are counted in C order. The sum of a row is 1; the weights of "linear" and "natural" are positive.

        Raises
        ------
        ValueError
            If a place has no direction; tells which.
        """
        import scipy.sparse  # type: ignore[import]
        if method not in ("linear", "natural", "cubic"):
            raise ValueError(f"method must be 'linear', 'natural' or 'cubic', not {method!r}")
        if outside not in ("empty", "nearest", "nan"):
            raise ValueError(f"outside must be 'empty', 'nearest' or 'nan', not {outside!r}")
        places = _with_directions(self._vectors(xi, lon, lat, units), lon, lat).reshape(-1, 3)
        indptr, indices, data = self._mesh.weights(method, places, self._number(threads))
        shape = (len(places), self.npoints)
        if outside != "empty":
            empty = np.flatnonzero(indptr[1:] == indptr[:-1])
            indices = np.insert(indices, indptr[empty], self.nearest(places[empty], threads=threads))
            data = np.insert(data, indptr[empty], 1.0 if outside == "nearest" else np.nan)
            indptr = indptr + np.searchsorted(empty, np.arange(len(places) + 1)).astype(np.int32)
        return scipy.sparse.csr_matrix((data, indices, indptr), shape=shape)

    def interpolate(self, values: ArrayLike, xi: Optional[ArrayLike] = None, method: str = "linear", *,
                    lon: Optional[ArrayLike] = None, lat: Optional[ArrayLike] = None, units: Optional[str] = None,
                    outside: str = "nan", threads: Optional[int] = None) -> Any:
        """Values at places, interpolated between the nodes.

        Parameters
        ----------
        values : array_like, shape (n,) or (n, ...)
            One or several values of each node, in the order of the nodes or with their ``labels``.
        xi : array_like, shape (..., 3)
            Vectors to the places.
        method : {"linear", "natural", "cubic", "nearest"}
            "linear": linear on triangles; continuous. "natural": natural neighbours (Sibson), weighted by the area that
            their Voronoi cells would lose to a node at the place; smooth except at the nodes. "cubic": natural
            neighbours and gradients estimated from neighbours and their neighbours; smooth; results can exceed the
            range of the values, and a value that is not finite spoils results around it. "nearest": the value of the
            nearest node.
        lon, lat : array_like
            In place of ``xi``, longitudes and latitudes in the units of from_lonlat, by default degrees; or in ``units``.
        outside : {"nan", "nearest"}
            Result of the other methods at places outside the triangles.

        At a place that is not finite, or zero, the result is NaN.
        """
        if method not in ("linear", "natural", "cubic", "nearest"):
            raise ValueError(f"method must be 'linear', 'natural', 'cubic' or 'nearest', not {method!r}")
        if outside not in ("nan", "nearest"):
            raise ValueError(f"outside must be 'nan' or 'nearest', not {outside!r}")
        given = self._enter(values, self.npoints)
        places = self._vectors(xi, lon, lat, units)
        if method == "nearest":
            nodes = self._mesh.nearest(places.reshape(-1, 3), self._number(threads)).reshape(places.shape[:-1])
            if np.any(nodes < 0) and given.dtype.kind in "iub":
                given = given.astype(np.float64)
            found = given[nodes]
            if np.any(nodes < 0):
                found[nodes < 0] = np.nan
            return scalar(np.asarray(found))
        table = np.require(real(given).reshape(self.npoints, -1), np.float64, ["A", "C"])
        result = self._mesh.interpolate(method, places.reshape(-1, 3), table, self._number(threads))
        if outside == "nearest":
            missing = np.flatnonzero(self.find_simplex(places, threads=threads).ravel() < 0)
            near = self._mesh.nearest(places.reshape(-1, 3)[missing], self._number(threads))
            result[missing[near >= 0]] = table[near[near >= 0]]
        return scalar(result.reshape(places.shape[:-1] + given.shape[1:]))

    def _vectors(self, xi: Optional[ArrayLike], lon: Optional[ArrayLike], lat: Optional[ArrayLike],
                 units: Optional[str]) -> Floats:
        """The vectors to the places, of shape (..., 3)."""
        if xi is not None:
            if not (lon is lat is units is None):
                raise TypeError("give vectors, or lon and lat, not both")
            return place_array(xi)
        if lon is None or lat is None:
            raise TypeError("give vectors, or lon and lat")
        fit_each_other(lon, lat)
        lon, lat = real(lon, "longitude of place"), real(lat, "latitude of place")
        return vectors_of(lon, lat, are_degrees(lon, lat, True, self._units if units is None else units), "place")

    def _number(self, threads: Optional[int]) -> int:
        return self._threads if threads is None else thread_count(threads)


def _with_directions(places: Floats, lon: Optional[ArrayLike], lat: Optional[ArrayLike]) -> Floats:
    """The places; a ValueError if one is not finite or zero, as it was given."""
    wrong = ~(np.isfinite(places).all(axis=-1) & places.any(axis=-1))
    if np.any(wrong):
        index = np.unravel_index(int(np.argmax(wrong)), wrong.shape)
        if lon is None or lat is None:
            where = "({:g}, {:g}, {:g})".format(*places[index])
        else:
            where = "at longitude {:g}, latitude {:g}".format(*(np.broadcast_to(angle, wrong.shape)[index] for angle in (lon, lat)))
        name = {0: "the place", 1: f"place {index[0]}" if index else ""}.get(len(index), f"place {tuple(map(int, index))}")
        raise ValueError(f"{name} (counted from 0) is {where}: it has no direction")
    return places
