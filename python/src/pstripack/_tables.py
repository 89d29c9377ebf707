"""DataFrames of pandas, GeoDataFrames and Datasets of xarray."""
import importlib
from collections.abc import Mapping
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arrays import to_lonlat

EARTH_RADIUS = 6371.0  #: km

_SUFFIXES = {"_degrees": "degrees", "_degree": "degrees", "_deg": "degrees", "_radians": "radians", "_rad": "radians"}
_AXES = {**dict.fromkeys(("lon", "long", "lng", "longitude", "decimallongitude"), "lon"),
         **dict.fromkeys(("lat", "latitude", "decimallatitude"), "lat"), "x": "x", "y": "y", "z": "z"}


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
    name = str(column).lower()
    for suffix, unit in _SUFFIXES.items():
        if name.endswith(suffix):
            return _AXES.get(name[:-len(suffix)]), unit
    return _AXES.get(name), None


def coordinate_columns(table: Any, columns: Optional[Sequence[Any]]) -> "Tuple[List[Any], Optional[str]]":
    """The names of the columns lon and lat, or x, y and z, and the unit of the angles, if the names tell it."""
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
                                else "name them by columns=(longitude, latitude)"))
        candidates = [c for axes in choices for axis in axes for c in found[axis]]
        if len(choices) > 1 or len(candidates) > len(choices[0]):
            raise ValueError(f"the nodes may be in several of the columns {', '.join(map(str, candidates))}: name two or "
                             "three by columns=(longitude, latitude) or columns=(x, y, z)")
        wanted = candidates
    units = {_axis(c)[1] for c in wanted}
    return wanted, units.pop() if len(wanted) == 2 and len(units) == 1 else None


def named(values: Any, labels: Any) -> "Dict[str, NDArray[Any]]":
    """Arrays by their names. A table has columns, a Series may have a name."""
    if values is None:
        return {}
    if isinstance(values, Mapping) or hasattr(values, "columns"):
        return {str(name): numbers(values[name], labels) for name in values}
    return {str(getattr(values, "name", None) or "values"): numbers(values, labels)}


def numbers(values: Any, labels: Any) -> "NDArray[Any]":
    """The values as an array with NaN for masked ones. The index of a Series must be that of the nodes."""
    if labels is not None and hasattr(values, "iloc") and len(values) == len(labels) and not labels.equals(values.index):
        raise ValueError("the index of the values differs from that of the nodes: pass values.loc[mesh.labels]")
    mask = np.any(values.mask) if isinstance(values, np.ma.MaskedArray) else False
    array = np.where(values.mask, np.nan, values.data) if mask else np.asarray(values)
    if array.ndim != 1:
        raise ValueError(f"values must have one dimension, not the shape {array.shape}: pass them one by one")
    return array


def kind(what: str) -> bool:
    """True for cells."""
    if what not in ("triangles", "cells"):
        raise ValueError(f"what must be 'triangles' or 'cells', not {what!r}")
    return what == "cells"


def geodataframe(mesh: _core.Mesh, cells: bool, values: "Dict[str, NDArray[Any]]", areas: "NDArray[np.float64]",
                 labels: Any, threads: int) -> Any:
    geopandas = needed("geopandas", "to_geodataframe()")
    shapes = needed("shapely.geometry", "to_geodataframe()")
    corners, begin, face = mesh.map_polygons(cells, threads)
    polygons = [shapes.Polygon(ring) for ring in np.split(corners, begin[1:-1])] if len(face) > 0 else []
    first = np.searchsorted(face, np.arange(len(areas) + 1)).tolist()
    geometry = [polygons[i] if j - i == 1 else shapes.MultiPolygon(polygons[i:j]) if j > i else None
                for i, j in zip(first, first[1:])]
    wrong = [name for name, of_faces in values.items() if len(of_faces) != len(areas)]
    if wrong:
        raise ValueError(f"values must be one for each of {len(areas)} {'cells' if cells else 'triangles'}, "
                         f"not {len(values[wrong[0]])} ({wrong[0]})")
    return geopandas.GeoDataFrame({**values, "area_km2": areas * EARTH_RADIUS**2}, geometry=geometry, crs="EPSG:4326",
                                  index=labels if cells else None)


def dataset(mesh: _core.Mesh, cells: bool, values: "Dict[str, NDArray[Any]]", threads: int) -> Any:
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
    coordinates = {}
    for of, vectors in places.items():
        for name, unit, angles in zip(("longitude", "latitude"), ("degrees_east", "degrees_north"), to_lonlat(vectors)):
            coordinates[f"mesh_{of}_{name[:3]}"] = (f"mesh_{of}s", angles, {"standard_name": name, "units": unit})
    variables: Dict[str, Any] = {
        "mesh": ((), np.int32(0), topology),
        "mesh_face_nodes": (("mesh_faces", "mesh_face_corners"), table,
                            {"cf_role": "face_node_connectivity", "start_index": np.int32(0), "_FillValue": np.int32(-1)})}
    lengths = {"node": len(corners), "face": len(table)}
    # Values of the nodes of the triangulation, if there are as many triangles or vertices.
    for name, of_items in values.items():
        fitting = [of for of in (("face", "node") if cells else ("node", "face")) if lengths[of] == len(of_items)]
        if not fitting:
            raise ValueError(f"values must be one for each of {lengths['node']} nodes or {lengths['face']} faces of the "
                             f"mesh, not {len(of_items)} ({name})")
        if name in variables or name in coordinates:
            raise ValueError(f"values must not be called {name}: the mesh has a variable of this name")
        variables[name] = (f"mesh_{fitting[0]}s", of_items, {"mesh": "mesh", "location": fitting[0]})
    return xarray.Dataset(variables, coordinates, {"Conventions": "CF-1.8 UGRID-1.0"})
