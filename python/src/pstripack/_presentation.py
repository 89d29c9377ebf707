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
        """The triangles or the Voronoi cells as an xarray.Dataset by the UGRID conventions, version 1.0. Needs xarray.

        ``values``: one value of each node, or of each triangle or vertex of cells: an array, a Series, or several as a
        dict, DataFrame or Dataset. Those of nodes enter by their ``labels``. They become variables with the attributes
        ``mesh`` and ``location`` beside their own; DataArrays keep further dimensions, such as time. Indices count from 0
        (``start_index``); -1 (``_FillValue``) fills the rows of cells with fewer corners. The vectors to the nodes and
        their labels are coordinates: :meth:`Delaunay.from_xarray` makes the same mesh of them.

        ``what``: "triangles" or "cells". The mesh's nodes are those of the triangulation, or the vertices of the cells.
        """
        cells = _tables.kind(what, values)
        nodes = len(self._mesh.points)
        others = [2 * nodes - 4] if cells else [len(self.simplices)]
        columns = _tables.named(values, lambda each: self._column(each, nodes, others))
        return _tables.dataset(self._mesh, cells, columns, self.labels, self._number(threads))

    def to_geodataframe(self, what: str = "cells", values: Any = None, *, clip: Any = None,
                        threads: Optional[int] = None) -> Any:
        """The Voronoi cells or the triangles as a geopandas.GeoDataFrame. Needs geopandas.

        Polygons are counterclockwise, cut at the dateline, closed along a pole inside them, and within 0.001 degrees of
        the arcs: 110 m on the Earth. The column ``area_km2`` is the exact area of the cell or triangle on a sphere of
        radius 6371 km, or of its part inside ``clip``, to a millionth of the area of ``clip``.

        ``what``: "cells" or "triangles". ``values``: one value of each cell or triangle: an array, a Series, or several
        as a dict or DataFrame; those of cells enter by ``labels``. ``clip``: cuts the cells, before their sides are made
        straight on the map, at a polygon or multipolygon of shapely, or at the union of those of a GeoSeries or
        GeoDataFrame, in degrees, with sides straight on the map; a cell outside has the area 0 and no geometry. Columns called ``area_km2`` and ``geometry`` get
        ``_given`` appended. The index of cells is ``labels``. If the nodes lie in a hemisphere, the cells of boundary nodes
        share the rest of the sphere.
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
            One value of each node, in their order or with their ``labels``, or of each triangle, which gives the colours;
            NaN is not drawn. A triangle has the mean of its three nodes. Default: draws lines.
        what : {"triangles", "cells"}
        projection : {"map", "orthographic"}
            Longitude and latitude in degrees, cut opposite the centre; or the view from infinitely far away, without the
            hidden side.
        center : (longitude, latitude), optional
            In degrees. Default: the middle of the nodes, if they lie in a hemisphere.
        radius : float, optional
            Draws only what is so near to the centre, in degrees; at 90 a hemisphere or the whole map.
        ax : matplotlib Axes, optional
            Default: a new figure. Axes of cartopy draw in their own projection. Limits set before are kept.
        edgecolor : color, optional
            Colour of lines; with values they are drawn only if it is given. ``linewidth``: their width in points.
        vmin, vmax : float, optional
            Values at the ends of the colour map.
        **style
            For the artist: cmap, norm, alpha, ...

        Returns
        -------
        matplotlib.collections.PolyCollection with values, for ``plt.colorbar``; else a LineCollection.
        """
        cells = _tables.kind(what, values)
        others = [] if cells else [len(self.simplices)]
        given = None if values is None else self._column(values, len(self._mesh.points), others).numbers
        if given is not None and given.ndim > 1:
            raise ValueError(f"values must have one dimension, not the shape {given.shape}: choose one of each node")
        return _plot.plot(self._mesh, given, cells, projection, center, radius, ax, edgecolor, linewidth, vmin, vmax,
                          self._number(threads), **style)
