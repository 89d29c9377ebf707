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
    """Part of :class:`Delaunay`. Places are vectors, or longitudes and latitudes, which are broadcast:
    ``lon=lon, lat=lat[:, np.newaxis]`` is a grid. Results have the shape of the places."""

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
        """The triangle that contains each place.

        Parameters
        ----------
        xi : array_like, shape (..., 3)
            Vectors of any length to the places.
        lon, lat : array_like
            In place of ``xi``: longitudes and latitudes.
        units : {"degrees", "radians"}, optional
            The units of ``lon`` and ``lat``. Default: those of the nodes, if :meth:`from_lonlat` or a table of angles made
            the mesh; otherwise degrees, and a ValueError if the angles may be radians.
        threads : int, optional
            Number of threads of this call. Default: that of the mesh.

        Returns
        -------
        array of int, shape (...)
            Numbers of triangles; -1: none contains the place. A place on the common side of two triangles is in the one
            with the smaller third corner.

        Notes
        -----
        A place outside the triangles counts as on their border if a small step brings it inside: 1e-12 of the way to the
        middle of the nodes, plus 4e-16 radians.

        Examples
        --------
        >>> from pstripack import Delaunay
        >>> mesh = Delaunay.from_lonlat([0, 90, 180, 270, 0, 0], [0, 0, 0, 0, 90, -90])
        >>> mesh.find_simplex([[1, 1, 1], [1, -1, -1]])
        array([0, 2], dtype=int32)
        """
        places = self._vectors(xi, lon, lat, units)
        found, _ = self._mesh.find(places.reshape(-1, 3), self.simplices, False, self._number(threads))
        simplex: Ints = scalar(found.reshape(places.shape[:-1]))
        return simplex

    def barycentric(self, xi: Optional[ArrayLike] = None, *, lon: Optional[ArrayLike] = None,
                    lat: Optional[ArrayLike] = None, units: Optional[str] = None,
                    threads: Optional[int] = None) -> Tuple[Ints, Floats]:
        """The triangle that contains each place, and the place's barycentric coordinates in it.

        Parameters
        ----------
        xi, lon, lat, units, threads
            As in :meth:`find_simplex`.

        Returns
        -------
        simplex : array of int, shape (...)
            As :meth:`find_simplex` returns them.
        coordinates : array, shape (..., 3)
            The weights of the corners ``simplices[simplex]``: det(p, b, c), det(a, p, c), det(a, b, p) over their sum.
            They belong to the point where the ray to p meets the plane of the triangle (Renka, SSRFPACK, ACM TOMS 23,
            1997). Each is at least 0, and their sum is 1. On a side the opposite corner has 0; a node has 1 at itself.
            NaN outside the triangles.

        Raises
        ------
        ValueError
            If a place is not finite, or zero; the message says which.

        Examples
        --------
        >>> from pstripack import Delaunay
        >>> mesh = Delaunay.from_lonlat([0, 90, 180, 270, 0, 0], [0, 0, 0, 0, 90, -90])
        >>> simplex, coordinates = mesh.barycentric([1, 1, 2])
        >>> simplex.item(), coordinates
        (0, array([0.25, 0.25, 0.5 ]))
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
        k : int
            Number of nodes for each place.
        xi, lon, lat, units, threads
            As in :meth:`find_simplex`.
        distance : bool
            Also return the distances, along great circles, in radians. Their relative error is at most 1e-15.
        radius : float, optional
            Instead of k nodes return all nodes up to this distance, in radians, at most pi.

        Returns
        -------
        nodes : array of int, shape (...), or (..., k) if k > 1
            The nearest nodes, the nearest first.
        distances, nodes : arrays
            With ``distance``, as scipy.spatial.cKDTree.query returns them.
        indptr, indices : arrays of int
            With ``radius``: the nodes of place i, counted in C order, are indices[indptr[i]:indptr[i+1]], the nearest first.
        distances, indptr, indices : arrays
            With both.

        Raises
        ------
        ValueError
            If a place is not finite, or zero; the message says which.

        Examples
        --------
        >>> from pstripack import Delaunay
        >>> mesh = Delaunay.from_lonlat([0, 90, 180, 270, 0, 0], [0, 0, 0, 0, 90, -90])
        >>> mesh.nearest([1, 2, 3], k=2)
        array([4, 1], dtype=int32)
        >>> mesh.nearest(lon=10, lat=20, radius=1)
        (array([0, 1], dtype=int32), array([0], dtype=int32))
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
        """The weights of the nodes in the interpolated value at each place, for many fields on the same nodes. Needs SciPy.

        ``mesh.weights(places) @ values`` is ``mesh.interpolate(values, places)`` up to rounding. The values must be in the
        order of the nodes: ``values[mesh.labels]`` of a Series.

        Parameters
        ----------
        method : {"linear", "natural", "cubic"}
            As in :meth:`interpolate`.
        xi, lon, lat, units, threads
            As in :meth:`find_simplex`.
        outside : {"empty", "nearest", "nan"}
            The row of a place outside the triangles: empty, so that products are 0; or 1 for the nearest node; or NaN for
            it, so that products are NaN.

        Returns
        -------
        scipy.sparse.csr_matrix, shape (number of places, n)
            Places are counted in C order. The sum of a row is 1, except of places outside the
            triangles; the weights of "linear" and "natural" are positive.

        Raises
        ------
        ValueError
            If a place is not finite, or zero; the message says which.

        Examples
        --------
        >>> from pstripack import Delaunay
        >>> mesh = Delaunay.from_lonlat([0, 90, 180, 270, 0, 0], [0, 0, 0, 0, 90, -90])
        >>> matrix = mesh.weights([[1, 1, 2], [0, 0, 1]])
        >>> matrix.shape, matrix @ [0, 0, 0, 0, 1, 0]
        ((2, 6), array([0.5, 1. ]))
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
        method : {"linear", "natural", "cubic", "nearest"}
            "linear": linear on triangles; continuous. "natural": natural neighbours (Sibson), weighted by the area that
            their Voronoi cells would lose to a node at the place; smooth except at the nodes. "cubic": natural
            neighbours and :meth:`gradient`; smooth. Its results can exceed the range of the values, and a value that is
            not finite spoils results around it. "nearest": the value of the nearest node.
        xi, lon, lat, units, threads
            As in :meth:`find_simplex`.
        outside : {"nan", "nearest"}
            Result at places outside the triangles: NaN, or the value of the nearest node, as "nearest" has it everywhere.

        Returns
        -------
        array, shape (...) or (..., ...)
            The values; NaN at a place that is not finite, or zero. One place and one value: a number.

        Raises
        ------
        ValueError
            If the values do not fit the nodes, by number or by labels.

        Examples
        --------
        >>> from pstripack import Delaunay
        >>> mesh = Delaunay.from_lonlat([0, 90, 180, 270, 0, 0], [0, 0, 0, 0, 90, -90])
        >>> mesh.interpolate([0, 1, 2, 3, 4, 5], lon=[45, 0], lat=[0, 90])
        array([0.5, 4. ])
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
