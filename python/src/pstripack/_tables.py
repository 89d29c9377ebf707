"""DataFrames of pandas, GeoDataFrames and Datasets of xarray."""
import importlib
from collections.abc import Mapping
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arrays import to_lonlat
from ._values import Column

EARTH_RADIUS = 6371.0  #: km

_SUFFIXES = {"_degrees": "degrees", "_degree": "degrees", "_deg": "degrees", "_radians": "radians", "_rad": "radians"}
_AXES = {**dict.fromkeys(("lon", "long", "lng", "longitude", "decimallongitude", "loncell", "grid_center_lon", "nav_lon",
                          "glamt", "clon", "xlong", "xlong_m", "tlong"), "lon"),
         **dict.fromkeys(("lat", "latitude", "decimallatitude", "latcell", "grid_center_lat", "nav_lat", "gphit", "clat",
                          "xlat", "xlat_m", "tlat"), "lat"), "x": "x", "y": "y", "z": "z"}


def needed(module: str, use: str) -> Any:
    """The module; an ImportError says how to install it."""
    package = module.partition(".")[0]
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        raise ImportError(f"{use} needs {package}: pip install {package} (Debian: apt-get install python3-{package})",
                          name=package) from None


def _axis(column: Any) -> "Tuple[Optional[str], Optional[str]]":
    """The coordinate that the name of a column stands for, and its unit, as for the command `pstripack`."""
    name, _, unit_of_header = str(column).lower().partition(" [")
    for suffix, unit in _SUFFIXES.items():
        if name.endswith(suffix):
            return _AXES.get(name[:-len(suffix)]), unit
    return _AXES.get(name), _SUFFIXES.get("_" + unit_of_header.rstrip("] "))


def coordinate_columns(table: Any, columns: Optional[Sequence[Any]]) -> "Tuple[List[Any], Optional[str]]":
    """The names of the columns lon and lat, or x, y and z, and the unit of the angles, if the names tell it."""
    if not hasattr(table, "columns"):
        raise TypeError(f"a table with columns is needed, not {type(table).__name__}: pass longitudes and latitudes to "
                        "Delaunay.from_lonlat(lon, lat)")
    names = list(table.columns)
    if columns is not None:
        wanted = list(columns)
        missing = [str(c) for c in wanted if c not in names]
        if isinstance(columns, str) or len(wanted) not in (2, 3) or missing:
            raise ValueError(f"columns must be two names (longitude, latitude) or three (x, y, z) of "
                             f"{', '.join(map(str, names))}; not {columns!r}")
    else:
        found: Dict[str, List[Any]] = {axis: [c for c in names if _axis(c)[0] == axis] for axis in _AXES.values()}
        choices = [axes for axes in (("lon", "lat"), ("x", "y", "z")) if all(found[axis] for axis in axes)]
        if not choices:
            raise ValueError(f"none of the columns {', '.join(map(str, names))} are called lon and lat, or x, y and z: "
                             + ("use Delaunay.from_lonlat(table.geometry.x, table.geometry.y)" if "geometry" in names
                                else "they are in the index: pass table.reset_index()"
                                if any(_axis(name)[0] for name in getattr(getattr(table, "index", None), "names", []))
                                else "name them by columns=(longitude, latitude)"))
        candidates = [c for axes in choices for axis in axes for c in found[axis]]
        if len(choices) > 1 or len(candidates) > len(choices[0]):
            raise ValueError(f"the nodes may be in several of the columns {', '.join(map(str, candidates))}: name two or "
                             "three by columns=(longitude, latitude) or columns=(x, y, z)")
        wanted = candidates
    units = {_axis(c)[1] for c in wanted}
    return wanted, units.pop() if len(wanted) == 2 and len(units) == 1 else None


def named(values: Any, column: "Callable[[Any], Column]") -> "Dict[str, Column]":
    """Columns by their names. A table has columns, a Series may have a name."""
    if values is None:
        return {}
    if isinstance(values, Mapping) or hasattr(values, "columns"):
        names = list(values.columns if hasattr(values, "columns") else values)
        texts = [str(name) for name in names]
        twice = [text for text in texts if texts.count(text) > 1]
        if twice:
            raise ValueError(f"several columns of the values are called {twice[0]}: rename them")
        return {text: column(values[name]) for text, name in zip(texts, names)}
    return {str(getattr(values, "name", None) or "values"): column(values)}


def kind(what: Any, values: Any) -> bool:
    """True for cells."""
    if not isinstance(what, str) or what not in ("triangles", "cells"):
        given = repr(what) if isinstance(what, str) else f"a {type(what).__name__}: pass values as values="
        raise ValueError(f"what must be 'triangles' or 'cells', not {given}")
    if isinstance(values, str):
        raise ValueError(f"values must be numbers, not {values!r}: the kind of faces is passed as what={values!r}")
    return what == "cells"


def _polygons(clip: Any) -> "List[List[List[Tuple[float, float]]]]":
    """The union of polygons of shapely or geopandas: for each polygon the outline and the holes, in degrees."""
    crs = getattr(clip, "crs", None)
    if crs is not None and not crs.is_geographic:
        clip = clip.to_crs("EPSG:4326")
    union = needed("shapely.ops", "to_geodataframe()").unary_union(getattr(clip, "geometry", clip))
    parts = [part for part in getattr(union, "geoms", [union]) if getattr(part, "geom_type", None) == "Polygon"]
    if not parts or union.is_empty:
        raise ValueError(f"clip must be a polygon, not {getattr(union, 'geom_type', type(clip).__name__)}")
    west, south, east, north = union.bounds
    if not (-180 <= west <= east <= 540 and -90 <= south <= north <= 90):
        raise ValueError(f"clip reaches from {west:g},{south:g} to {east:g},{north:g}, which are no longitudes and latitudes "
                         'in degrees: pass clip.to_crs("EPSG:4326")')
    return [[[(place[0], place[1]) for place in ring.coords] for ring in (part.exterior, *part.interiors)] for part in parts]


def geodataframe(mesh: _core.Mesh, cells: bool, values: "Dict[str, Column]", areas: "NDArray[np.float64]", clip: Any,
                 labels: Any, threads: int) -> Any:
    geopandas = needed("geopandas", "to_geodataframe()")
    shapes = needed("shapely.geometry", "to_geodataframe()")
    if clip is None:
        corners, begin, face = mesh.map_polygons(cells, threads)
    elif cells:
        corners, begin, face, areas = mesh.cut_cells(_polygons(clip), threads)
    else:
        raise ValueError("clip cuts cells: leave out what='triangles'")
    polygons = [shapes.Polygon(ring) for ring in np.split(corners, begin[1:-1])] if len(face) > 0 else []
    polygons = [polygons[i] for i in np.argsort(face, kind="stable")]
    first = np.searchsorted(np.sort(face), np.arange(len(areas) + 1)).tolist()
    geometry = [polygons[i] if j - i == 1 else shapes.MultiPolygon(polygons[i:j]) if j > i else None
                for i, j in zip(first, first[1:])]
    own = {name + "_given" if name in ("area_km2", "geometry") else name: column for name, column in values.items()}
    for name, column in own.items():
        if column.dims or len(column.numbers) != len(areas):
            raise ValueError(f"values must be one for each of {len(areas)} {'cells' if cells else 'triangles'}, not "
                             f"{len(column.numbers)} ({name})" + (f" by {', '.join(map(str, column.dims))}" if column.dims else ""))
    return geopandas.GeoDataFrame({**{name: column.numbers for name, column in own.items()}, "area_km2": areas * EARTH_RADIUS**2},
                                  geometry=geometry, crs="EPSG:4326", index=labels if cells else None)


def dataset(mesh: _core.Mesh, cells: bool, values: "Dict[str, Column]", labels: Any, threads: int) -> Any:
    xarray = needed("xarray", "to_xarray()")
    corners, begin, indices = mesh.faces(cells, threads)
    counts = np.diff(begin).astype(np.intp)
    table = np.full((len(counts), int(counts.max())), -1, np.int32)
    table[np.arange(table.shape[1]) < counts[:, np.newaxis]] = indices

    topology = {"cf_role": "mesh_topology", "topology_dimension": np.int32(2),
                "node_coordinates": "mesh_node_lon mesh_node_lat", "face_node_connectivity": "mesh_face_nodes",
                "face_dimension": "mesh_faces"}
    places = {"node": corners}
    if cells:
        topology["face_coordinates"] = "mesh_face_lon mesh_face_lat"
        places["face"] = mesh.points
    coordinates: Dict[Any, Any] = {}
    for of, vectors in places.items():
        for name, unit, angles in zip(("longitude", "latitude"), ("degrees_east", "degrees_north"), to_lonlat(vectors)):
            coordinates[f"mesh_{of}_{name[:3]}"] = (f"mesh_{of}s", angles, {"standard_name": name, "units": unit})
    # The nodes of the triangulation, for from_xarray: longitudes and latitudes are rounded.
    of = "face" if cells else "node"
    for axis, numbers in zip("xyz", mesh.points.T):
        coordinates[f"mesh_{of}_{axis}"] = (f"mesh_{of}s", numbers, {"long_name": f"{axis} of the vector to the node"})
    is_count = labels is None or (labels.dtype.kind in "iu" and np.array_equal(labels, np.arange(len(mesh.points))))
    if not is_count and labels.nlevels == 1:
        coordinates[f"mesh_{of}s"] = (f"mesh_{of}s", labels, {"long_name": str(labels.name)} if labels.name else {})
    connectivity = {"cf_role": "face_node_connectivity", "start_index": np.int32(0)}
    if np.any(counts != table.shape[1]):
        connectivity["_FillValue"] = np.int32(-1)
    variables: Dict[str, Any] = {"mesh": ((), np.int32(0), topology),
                                 "mesh_face_nodes": (("mesh_faces", "mesh_face_corners"), table, connectivity)}
    lengths = {"node": len(corners), "face": len(table)}
    # Values of the nodes of the triangulation, if there are as many triangles or vertices.
    for name, (array, dims, more, attributes) in values.items():
        fitting = [of for of in (("face", "node") if cells else ("node", "face")) if lengths[of] == len(array)]
        if not fitting:
            raise ValueError(f"values must be one for each of {lengths['node']} nodes or {lengths['face']} faces of the "
                             f"mesh, not {len(array)} ({name})")
        if name in variables or name in coordinates:
            raise ValueError(f"values must not be called {name}: the mesh has a variable of this name")
        variables[name] = ((f"mesh_{fitting[0]}s", *dims), array, {**attributes, "mesh": "mesh", "location": fitting[0]})
        coordinates.update(more)
    return xarray.Dataset(variables, coordinates, {"Conventions": "CF-1.8 UGRID-1.0"})


def nodes_of_dataset(dataset: Any) -> "Tuple[NDArray[np.float64], Any]":
    """The nodes of the triangulation, and their labels, of a Dataset that dataset() has made."""
    for of in "node", "face":
        names = [f"mesh_{of}_{axis}" for axis in "xyz"]
        if all(name in dataset for name in names):
            labels = dataset.indexes.get(f"mesh_{of}s")
            if labels is not None:
                labels = labels.rename(dataset[f"mesh_{of}s"].attrs.get("long_name"))
            return np.stack([np.asarray(dataset[name], np.float64) for name in names], axis=1), labels
    raise ValueError("the Dataset has no mesh_node_x, mesh_node_y, mesh_node_z of to_xarray(): pass longitudes and latitudes "
                     "to Delaunay.from_lonlat()")
