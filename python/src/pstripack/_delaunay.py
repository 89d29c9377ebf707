"""Delaunay triangulations on the sphere."""
import hashlib
import os
import pickle
from typing import Any, Dict, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import (Floats, Ints, are_degrees, fit_each_other, mesh_of, node_array, read_only, real,
                      refuse_map_coordinates, thread_count, to_xyz)
from ._errors import BadCoordinateError, CoincidentNodesError
from ._globe import Globe, globe, notebook_html
from ._measures import Measures, once
from ._places import Places
from ._presentation import Presentation
from ._tables import coordinate_columns, nodes_of_dataset
from ._values import Rows, in_order_of, is_field


def _labels_of(table: Any) -> Any:
    """The labels of the rows of a table, a Series or a DataArray; None: it has none."""
    if is_field(table):
        return table.indexes.get(table.dims[0]) if table.ndim == 1 else None
    return table.index if hasattr(table, "iloc") else None


class Delaunay(Places, Measures, Presentation):
    """The Delaunay triangulation of nodes on the sphere. It covers the sphere, or the convex hull of nodes that lie in a
    hemisphere.

    Parameters
    ----------
    points : array_like, shape (n, 3)
        Vectors from the centre of the sphere to the nodes; only their directions matter. They are copied.
    threshold : float, optional
        Nodes this near to each other, in radians, are refused as if they coincided: 1.6e-10 is a millimetre on the
        Earth.
    duplicates : {"error", "first", "mean"}
        What becomes of nodes in exactly the same direction. "error": they are refused. Otherwise they become one node, in
        the place of the first of them. It has the value of the first, or the mean of their values that are not NaN. Values
        may then have a row for each given row, or for each node.
    threads : int, optional
        Number of threads for the triangulation and for all that is computed from it.

    Raises
    ------
    BadCoordinateError, CoincidentNodesError, CollinearNodesError, TriangulationError
        All are ValueError; their attribute ``nodes`` has the indices of the nodes in question, counted from 0.

    Notes
    -----
    Names and conventions are those of scipy.spatial.Delaunay. Arrays are computed on first access and read only: pass
    ``mesh.simplices + 1`` or a copy to what changes them.

    Examples
    --------
    >>> from pstripack import Delaunay
    >>> mesh = Delaunay([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    >>> mesh.simplices[:2]
    array([[0, 1, 4],
           [0, 4, 3]], dtype=int32)
    >>> mesh.neighbors[0]
    array([5, 1, 3], dtype=int32)
    """

    def __init__(self, points: ArrayLike, *, threshold: float = 0, duplicates: str = "error",
                 threads: Optional[int] = None) -> None:
        if duplicates not in ("error", "first", "mean"):
            raise ValueError(f"duplicates must be 'error', 'first' or 'mean', not {duplicates!r}")
        self._threads = thread_count(threads)
        array = node_array(points)
        try:
            self._mesh = mesh_of(array, threshold, self._threads)
        except CoincidentNodesError as error:
            if duplicates == "error" or not error.coincide:
                raise
            later = np.array(error.nodes).reshape(-1, 2)
            is_node = np.ones(len(array), bool)
            is_node[later[:, 1]] = False
            node = np.cumsum(is_node, dtype=np.int32) - np.int32(1)
            node[later[:, 1]] = node[later[:, 0]]
            self._rows = Rows(None, node, duplicates == "mean")
            self._mesh = mesh_of(array[is_node], threshold, self._threads)
        #: The nodes as given, read only.
        self.points: Floats = read_only(self._mesh.points)
        self._known: Dict[str, Any] = {}

    @classmethod
    def from_lonlat(cls, lon: ArrayLike, lat: ArrayLike, *, degrees: bool = True, units: Optional[str] = None,
                    threshold: float = 0, duplicates: str = "error", threads: Optional[int] = None) -> "Delaunay":
        """The triangulation of nodes given by longitudes and latitudes.

        Parameters
        ----------
        lon, lat : array_like
            As in :func:`to_xyz`. The labels of a Series or DataArray of longitudes become the attribute ``labels``.
        degrees : bool
            False: the angles are radians, unless ``units`` is given.
        units : {"degrees", "radians"}, optional
            The units. Default: degrees, and a ValueError if all longitudes are within 2 pi and all latitudes within pi/2,
            since these may be radians.
        threshold, duplicates, threads
            As in :class:`Delaunay`.

        Returns
        -------
        Delaunay
            The mesh.

        Raises
        ------
        ValueError
            Those of :class:`Delaunay` and :func:`to_xyz`, and if the units are not certain.

        Examples
        --------
        >>> from pstripack import Delaunay
        >>> Delaunay.from_lonlat([0, 90, 180, 270, 0, 0], [0, 0, 0, 0, 90, -90])
        <pstripack.Delaunay: 6 nodes, 8 triangles, whole sphere>
        """
        labels = _labels_of(lon)
        if labels is not None and np.ndim(lat) == 1:
            lat = in_order_of(labels, lat, len(labels))
        fit_each_other(lon, lat)
        lon, lat = np.ravel(real(lon, "longitude of node")), np.ravel(real(lat, "latitude of node"))
        in_degrees = are_degrees(lon, lat, degrees, units)
        points = to_xyz(lon, lat, in_degrees)
        wrong = np.isnan(points[:, 0])
        if np.any(wrong):
            node = int(np.argmax(wrong))
            where = [float(np.broadcast_to(angle, len(points))[node]) for angle in (lon, lat)]
            raise BadCoordinateError(f"node {node} (counted from 0) is at longitude {where[0]:g}, latitude {where[1]:g}: "
                                     "both must be finite", (node,))
        mesh = cls(points, threshold=threshold, duplicates=duplicates, threads=threads)
        mesh._units = "degrees" if in_degrees else "radians"
        mesh._label(labels)
        return mesh

    @classmethod
    def from_dataframe(cls, table: Any, *, columns: Optional[Sequence[Any]] = None, units: Optional[str] = None,
                       threshold: float = 0, duplicates: str = "error", threads: Optional[int] = None) -> "Delaunay":
        """The triangulation of nodes in a table. The index of the table becomes the attribute ``labels``.

        Parameters
        ----------
        table : DataFrame of pandas or polars
            It has columns lon and lat, or x, y and z. Other names of longitudes and latitudes are found, too: long, lng,
            longitude, clon, nav_lon and the like, also with an end _deg, _degrees, _rad or _radians, or with a unit as in
            "lon [deg]".
        columns : (longitude, latitude) or (x, y, z), optional
            The names of the columns, if they are others.
        units : {"degrees", "radians"}, optional
            As in :meth:`from_lonlat`. Default: what the names of the columns tell.
        threshold, duplicates, threads
            As in :class:`Delaunay`.

        Returns
        -------
        Delaunay
            The mesh.

        Raises
        ------
        ValueError
            Those of :meth:`from_lonlat`, and if columns are missing, or several may be meant.

        Examples
        --------
        >>> import pandas as pd
        >>> from pstripack import Delaunay
        >>> table = pd.DataFrame({"lon": [0, 10, 0, 30], "lat": [40, 45, 50, 50]}, index=list("abcd"))
        >>> Delaunay.from_dataframe(table).labels
        Index(['a', 'b', 'c', 'd'], dtype='object')
        """
        names, unit = coordinate_columns(table, columns)
        if len(names) == 2:
            return cls.from_lonlat(table[names[0]], table[names[1]], units=units or unit, threshold=threshold,
                                   duplicates=duplicates, threads=threads)
        points = np.stack([real(table[name], f"{name} of node") for name in names], axis=1)
        if columns is None:
            refuse_map_coordinates(points)
        mesh = cls(points, threshold=threshold, duplicates=duplicates, threads=threads)
        mesh._label(_labels_of(table))
        return mesh

    @classmethod
    def from_xarray(cls, dataset: Any, *, threads: Optional[int] = None) -> "Delaunay":
        """The triangulation from which :meth:`to_xarray` made a Dataset, with the same bits and ``labels``.

        Parameters
        ----------
        dataset : xarray.Dataset
            The Dataset.
        threads : int, optional
            As in :class:`Delaunay`.

        Returns
        -------
        Delaunay
            The mesh.

        Raises
        ------
        ValueError
            If the Dataset has no nodes, or is not one of :meth:`to_xarray`.

        Examples
        --------
        >>> import xarray as xr
        >>> from pstripack import Delaunay
        >>> mesh = Delaunay.from_lonlat([0, 10, 0, 30], [40, 45, 50, 50])
        >>> bool((Delaunay.from_xarray(mesh.to_xarray()).points == mesh.points).all())
        True
        """
        points, labels = nodes_of_dataset(dataset)
        mesh = cls(points, threads=threads)
        mesh.labels = labels
        return mesh

    def _label(self, labels: Any) -> None:
        """``labels``: of all given rows."""
        if self._rows is None or labels is None:
            self.labels = labels
            return
        self._rows = self._rows._replace(labels=labels)
        self.labels = labels[np.unique(self._rows.node, return_index=True)[1]]

    @property
    def node_of_row(self) -> Ints:
        """The node of each row that the mesh was made of: 0, 1, 2, ... unless ``duplicates`` has joined nodes."""
        return np.arange(self.npoints, dtype=np.int32) if self._rows is None else self._rows.node

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_mesh": None, "_known": {}}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        """For pickles and copies: triangulates again, which gives the same mesh."""
        self.__dict__.update(state)
        self._mesh = _core.Mesh(self.points, self._threads)
        self.points = read_only(self._mesh.points)

    def __dask_tokenize__(self) -> Tuple[Any, ...]:
        """For dask: equal for meshes with the same nodes, labels and units, whatever was computed of them."""
        labels = None if self.labels is None else tuple(self.labels)
        return type(self).__name__, hashlib.sha256(pickle.dumps((self.points.tobytes(), labels, self._units))).hexdigest()

    @property
    def npoints(self) -> int:
        """Number of nodes."""
        return len(self.points)

    @property
    @once
    def simplices(self) -> Ints:
        """Corners of the triangles, shape (t, 3): counterclockwise seen from outside, the smallest first."""
        return self._mesh.triangles(self._threads)

    @property
    def nsimplex(self) -> int:
        """Number of triangles."""
        return len(self.simplices)

    @property
    @once
    def neighbors(self) -> Ints:
        """The triangle opposite each corner, shape (t, 3). -1: none."""
        return self._mesh.opposite_triangles(self._threads)

    @property
    @once
    def vertex_neighbor_vertices(self) -> Tuple[Ints, Ints]:
        """(indptr, indices): the neighbours of node k are indices[indptr[k]:indptr[k+1]], counterclockwise. Those of a
        boundary node begin and end with its neighbours on the boundary."""
        return self._mesh.neighbours(self._threads)

    @property
    def vertex_to_simplex(self) -> Ints:
        """One triangle of each node, shape (n,)."""
        result = np.empty(self.npoints, np.int32)
        result[self.simplices] = np.arange(self.nsimplex, dtype=np.int32)[:, np.newaxis]
        return result

    @property
    def convex_hull(self) -> Ints:
        """Boundary arcs, shape (b, 2), counterclockwise round the triangles. Each begins where the previous one ends. There
        are none if the triangles cover the sphere."""
        nodes = self._mesh.boundary()
        return np.stack([nodes, np.roll(nodes, -1)], axis=1)

    @property
    def lists(self) -> Tuple[Ints, Ints, Ints, int]:
        """LIST, LPTR, LEND and LNEW as STRIPACK's TRMESH returns them: nodes and slots count from 1."""
        return self._mesh.lists()

    def globe(self, values: Optional[ArrayLike] = None, file: "Optional[Union[str, os.PathLike[str]]]" = None, *,
              title: Optional[str] = None, name: str = "value", unit: str = "",
              coasts: "Union[bool, str, os.PathLike[str]]" = False) -> Globe:
        """A globe of Voronoi cells, to be turned: a page for any browser. Notebooks show it.

        Parameters
        ----------
        values : array_like, shape (n,), optional
            The numbers that give the cells their colours; NaN is grey. Default: the areas of the cells on a sphere of
            radius 6371 km.
        file : path, optional
            The page is also written to this file.
        title : str, optional
            Title of the page. Default: the number of nodes.
        name, unit : str
            What the values are, and their unit.
        coasts : bool or path
            True: coast lines of Natural Earth, from Debian's libmagics++-data. A path: those of a shapefile in degrees.

        Returns
        -------
        Globe
            The page.

        Raises
        ------
        RuntimeError
            If there are no coast lines.

        Examples
        --------
        >>> from pstripack import Delaunay
        >>> Delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]]).globe([1, 2, 3, 4], name="height", unit="m")
        <pstripack globe of 4 nodes, ... MB>
        """
        colours = None if values is None else self._enter(values, self.npoints)
        return globe(self, colours, file, title, name, unit, coasts)

    def _repr_html_(self) -> str:
        return notebook_html(self)

    def _number(self, threads: Optional[int]) -> int:
        return self._threads if threads is None else thread_count(threads)
