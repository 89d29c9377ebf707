"""What a triangulation shows: tables for other packages, pictures."""
import abc
from typing import Any, Optional, Tuple

from . import _core, _plot, _tables
from ._arrays import Floats, Ints
from ._values import Values


class Presentation(Values):
    """Part of :class:`Delaunay`. Methods import the packages that they need."""

    _mesh: _core.Mesh

    @property
    @abc.abstractmethod
    def areas(self) -> Floats: ...

    @property
    @abc.abstractmethod
    def cell_areas(self) -> Floats: ...

    @property
    @abc.abstractmethod
    def simplices(self) -> Ints: ...

    @abc.abstractmethod
    def _number(self, threads: Optional[int]) -> int: ...

    def __repr__(self) -> str:
        nodes, arcs = len(self._mesh.points), len(self._mesh.boundary())
        triangles = 2 * nodes - (2 + arcs if arcs > 0 else 4)
        return (f"<pstripack.Delaunay: {nodes} nodes, {triangles} triangles, "
                + (f"boundary of {arcs} arcs>" if arcs > 0 else "whole sphere>"))

    def to_xarray(self, values: Any = None, what: str = "triangles", *, threads: Optional[int] = None) -> Any:
        """The triangles or the Voronoi cells as a Dataset by the UGRID conventions, version 1.0. Needs xarray.

        Parameters
        ----------
        values : array_like, Series, dict, DataFrame or Dataset, optional
            One value of each node, or of each triangle or vertex of cells; a dict, DataFrame or Dataset has several. Values
            of nodes enter by their ``labels``. They become variables, with the attributes ``mesh`` and ``location`` beside
            their own. DataArrays keep further dimensions, such as time.
        what : {"triangles", "cells"}
            The faces. The mesh's nodes are those of the triangulation, or the vertices of the cells.
        threads : int, optional
            Number of threads of this call. Default: that of the mesh.

        Returns
        -------
        xarray.Dataset
            Indices count from 0 (``start_index``); -1 (``_FillValue``) fills the rows of cells with fewer corners. The
            vectors to the nodes and their labels are coordinates, from which :meth:`Delaunay.from_xarray` makes the same
            mesh.

        Raises
        ------
        ValueError
            If values fit neither the nodes nor the faces, or two have one name.

        Examples
        --------
        >>> import xarray as xr
        >>> from pstripack import Delaunay
        >>> mesh = Delaunay.from_lonlat([0, 10, 0, 30], [40, 45, 50, 50])
        >>> mesh.to_xarray({"height": [1, 2, 3, 4]})["height"].dims
        ('mesh_nodes',)
        """
        cells = _tables.kind(what, values)
        nodes = len(self._mesh.points)
        others = [2 * nodes - 4] if cells else [len(self.simplices)]
        columns = _tables.named(values, lambda each: self._column(each, nodes, others))
        return _tables.dataset(self._mesh, cells, columns, self.labels, self._number(threads))

    def to_geodataframe(self, what: str = "cells", values: Any = None, *, clip: Any = None,
                        threads: Optional[int] = None) -> Any:
        """The Voronoi cells or the triangles as polygons. Needs geopandas.

        Parameters
        ----------
        what : {"cells", "triangles"}
            The polygons.
        values : array_like, Series, dict or DataFrame, optional
            One value of each cell or triangle; a dict or DataFrame has several. Those of cells enter by ``labels``. Given
            columns ``area_km2`` and ``geometry`` get ``_given`` appended to their names.
        clip : Polygon or MultiPolygon of shapely, GeoSeries or GeoDataFrame, optional
            The cells are cut at this polygon, or at the union of these polygons. Its unit is the degree, and its sides are
            straight on the map. The sides of cells are cut as arcs, before they are made straight.
        threads : int, optional
            Number of threads of this call. Default: that of the mesh.

        Returns
        -------
        geopandas.GeoDataFrame
            Polygons are counterclockwise, cut at the dateline, extended to a pole inside them, and within 0.001 degrees of
            the arcs: 110 m on the Earth. The column ``area_km2`` is the exact area of the cell or triangle on a sphere of
            radius 6371 km, or of its part inside ``clip``. This part is right to 0.01 % of the area of ``clip``. A
            cell outside ``clip`` has the area 0 and no geometry. The index of cells is ``labels``. If the nodes lie in a
            hemisphere, the cells of boundary nodes share the rest of the sphere.

        Raises
        ------
        ValueError
            If values do not fit the cells or triangles, or two have one name.

        Examples
        --------
        >>> import geopandas
        >>> from pstripack import Delaunay
        >>> mesh = Delaunay.from_lonlat([0, 10, 0, 30], [40, 45, 50, 50], units="degrees")
        >>> list(mesh.to_geodataframe("triangles").columns)
        ['area_km2', 'geometry']
        """
        cells = _tables.kind(what, values)
        areas = self.cell_areas if cells else self.areas
        others = [] if cells else [len(areas)]
        columns = _tables.named(values, lambda each: self._column(each, len(self._mesh.points), others))
        return _tables.geodataframe(self._mesh, cells, columns, areas, clip, self.labels, self._number(threads))

    def plot(self, values: Any = None, what: str = "triangles", *, projection: str = "map",
             center: Optional[Tuple[float, float]] = None, radius: Optional[float] = None, ax: Any = None,
             edgecolor: Any = None, linewidth: float = 0.5, vmin: Optional[float] = None, vmax: Optional[float] = None,
             threads: Optional[int] = None, **style: Any) -> Any:
        """Draws the triangles or the Voronoi cells. Needs matplotlib.

        Parameters
        ----------
        values : array_like, optional
            One value of each node, in their order or with their ``labels``, or of each triangle. Values give the colours;
            NaN is not drawn. A triangle has the mean of its three nodes. Default: lines are drawn.
        what : {"triangles", "cells"}
            What is drawn.
        projection : {"map", "orthographic"}
            "map": longitude and latitude in degrees, cut opposite the centre. "orthographic": the view from infinitely far
            away, without the hidden side.
        center : (longitude, latitude), optional
            In degrees. Default: the middle of the nodes, if they lie in a hemisphere.
        radius : float, optional
            Only what is at most this far from the centre is drawn, in degrees. 90: a hemisphere, or the whole map.
        ax : matplotlib Axes, optional
            Default: a new figure. Axes of cartopy draw in their own projection. Limits set before are kept.
        edgecolor : color, optional
            Colour of lines. With values, lines are drawn only if it is given.
        linewidth : float
            Width of lines in points.
        vmin, vmax : float, optional
            Values at the ends of the colour map.
        threads : int, optional
            Number of threads of this call. Default: that of the mesh.
        **style
            Keywords for the artist: cmap, norm, alpha, ...

        Returns
        -------
        matplotlib.collections.PolyCollection or LineCollection
            With values the polygons, for ``plt.colorbar``; otherwise the lines.

        Raises
        ------
        ValueError
            If an argument is wrong, or values fit neither the nodes nor the triangles.

        Examples
        --------
        >>> import matplotlib
        >>> from pstripack import Delaunay
        >>> mesh = Delaunay.from_lonlat([0, 10, 0, 30], [40, 45, 50, 50])
        >>> type(mesh.plot([1, 2, 3, 4], "cells")).__name__
        'PolyCollection'
        """
        cells = _tables.kind(what, values)
        others = [] if cells else [len(self.simplices)]
        given = None if values is None else self._column(values, len(self._mesh.points), others).numbers
        if given is not None and given.ndim > 1:
            raise ValueError(f"values must have one dimension, not the shape {given.shape}: choose one of each node")
        return _plot.plot(self._mesh, given, cells, projection, center, radius, ax, edgecolor, linewidth, vmin, vmax,
                          self._number(threads), **style)
