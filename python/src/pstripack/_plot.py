"""Pictures by matplotlib."""
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arrays import Floats, to_lonlat, unit_vectors
from ._tables import needed


def _window(points: Floats, whole: bool, orthographic: bool, center: "Optional[Tuple[float, float]]",
            radius: Optional[float]) -> "Tuple[float, float, float]":
    """Longitude, latitude and radius of the part of the sphere that is drawn, in degrees; 90: a hemisphere, or the whole
    map. The same as that of the command `pstripack plot`."""
    vectors = unit_vectors(points)
    if center is None:
        mean = vectors.mean(axis=0)
        lon, lat = (0.0, 30.0 if orthographic else 0.0) if whole else map(float, to_lonlat(mean))
    else:
        lon, lat = map(float, center)
    if not (np.isfinite(lon) and abs(lat) <= 90):
        raise ValueError(f"center must be a longitude and a latitude in degrees, not {center}")
    if radius is None:
        radius = 90.0
        if not whole:
            a, b = np.radians([lon, lat])
            eye = np.array([np.cos(b) * np.cos(a), np.cos(b) * np.sin(a), np.sin(b)])
            chord = np.linalg.norm(vectors - eye, axis=1).max()
            to_farthest = 1.06 * np.degrees(2 * np.arcsin(min(1.0, chord / 2)))
            radius = to_farthest if to_farthest < 70 else 90.0
    if not 0 < radius <= 180:
        raise ValueError(f"radius must be above 0 and at most 180 degrees, not {radius}")
    return lon, lat, min(float(radius), 90.0)


def _of_faces(mesh: _core.Mesh, cells: bool, values: "NDArray[Any]", threads: int) -> Floats:
    """One value for each face; a triangle has the mean of its corners."""
    count = len(mesh.points)
    numbers: Floats = np.asarray(values, np.float64)
    if cells and len(numbers) == count:
        return numbers
    corners = mesh.triangles(threads)
    if len(numbers) == count:
        return np.asarray(numbers[corners].mean(axis=1))
    if cells or len(numbers) != len(corners):
        raise ValueError(f"values must be one for each of {count} nodes"
                         + ("" if cells else f" or {len(corners)} triangles") + f", not {len(values)}")
    return numbers


def plot(mesh: _core.Mesh, values: "Optional[NDArray[Any]]", cells: bool, projection: str,
         center: "Optional[Tuple[float, float]]", radius: Optional[float], ax: Any, edgecolor: Any, linewidth: float,
         vmin: Optional[float], vmax: Optional[float], threads: int, **style: Any) -> Any:
    if projection not in ("map", "orthographic"):
        raise ValueError(f"projection must be 'map' or 'orthographic', not {projection!r}")
    collections = needed("matplotlib.collections", "plot()")
    if ax is None:
        _, ax = needed("matplotlib.pyplot", "plot()").subplots(layout="constrained")
    in_cartopy = hasattr(ax, "projection")
    orthographic = projection == "orthographic" and not in_cartopy
    lon, lat, radius = _window(mesh.points, len(mesh.boundary()) == 0, orthographic, center, radius)
    window = (lon, lat, radius)
    if in_cartopy:
        # More than the rectangle of the axes shows. Polygons are cut where the projection is: cartopy may fill the outside
        # of large ones that it has to cut.
        middle = float(ax.projection.proj4_params.get("lon_0", 0))
        window = (lon, lat, min(2 * radius, 90.0))
        if abs((middle + 180 - lon + 180) % 360 - 180) < _box(*window[1:])[0] or window[2] == 90:
            window = (middle, 0.0, 90.0)
        style["transform"] = _plate_carree(window[0])

    def outlines(which: Any) -> "Tuple[Any, NDArray[np.int32]]":
        corners, begin, face = which(cells, orthographic, *window, threads)
        if in_cartopy:
            corners = corners - (window[0], 0)
        return np.split(corners, begin[1:-1]) if len(face) > 0 else [], face

    artist = None
    if values is not None:
        of_faces = _of_faces(mesh, cells, values, threads)
        polygons, face = outlines(mesh.polygons_in)
        # Lines in the colour of the polygons hide the gaps that smoothing leaves between them.
        artist = collections.PolyCollection(polygons, edgecolors="face", linewidths=0.7, **style)
        artist.set_array(of_faces[face])
        artist.set_clim(vmin, vmax)
        ax.add_collection(artist, autolim=False)
    if values is None or edgecolor is not None:
        lines, _ = outlines(mesh.lines_in)
        own = style if artist is None else {key: style[key] for key in ("transform", "zorder") if key in style}
        line_artist = collections.LineCollection(lines, colors="0.25" if edgecolor is None else edgecolor,
                                                 linewidths=linewidth, **own)
        ax.add_collection(line_artist, autolim=False)
        artist = artist or line_artist
    if ax.get_autoscale_on():  # nobody has set limits
        _set_limits(ax, in_cartopy, orthographic, lon, lat, radius)
    return artist


def _set_limits(ax: Any, in_cartopy: bool, orthographic: bool, lon: float, lat: float, radius: float) -> None:
    if orthographic:
        half = np.sin(np.radians(radius))
        ax.set(xlim=(-1.01 * half, 1.01 * half), ylim=(-1.01 * half, 1.01 * half), aspect="equal", xticks=[], yticks=[])
        if radius == 90:
            ax.add_patch(needed("matplotlib.patches", "plot()").Circle((0, 0), 1, fill=False, color="0.25", linewidth=0.8))
            ax.set_axis_off()
        return
    half, south, north = _box(lat, radius)
    if in_cartopy:
        if radius == 90:
            ax.set_global()
        else:
            ax.set_extent((-half, half, south, north), crs=_plate_carree(lon))
        return
    squeezed = 1.0 if radius == 90 else max(0.05, np.cos(np.radians(lat)))
    ax.set(xlim=(lon - half, lon + half), ylim=(south, north), aspect=1 / squeezed)
    if half == 180:
        step = 60 if squeezed > 0.5 else 120
        ax.set_xticks(np.arange(np.ceil((lon - 180) / step) * step, lon + 181, step))
    if north - south == 180:
        ax.set_yticks(np.arange(-90, 91, 30))
    ax.xaxis.set_major_formatter(lambda x, _: _degrees((x + 180) % 360 - 180, "W", "E"))
    ax.yaxis.set_major_formatter(lambda y, _: _degrees(y, "S", "N"))


def _plate_carree(middle: float) -> Any:
    return needed("cartopy.crs", "plot() on axes with a projection").PlateCarree(central_longitude=middle)


def _box(lat: float, radius: float) -> "Tuple[float, float, float]":
    """Half the width, south and north of the map."""
    if radius == 90:
        return 180.0, -90.0, 90.0
    pole = abs(lat) + radius >= 90
    half = 180.0 if pole else float(np.degrees(np.arcsin(np.sin(np.radians(radius)) / np.cos(np.radians(lat)))))
    return half, max(-90.0, lat - radius), min(90.0, lat + radius)


def _degrees(angle: float, below: str, above: str) -> str:
    size = round(abs(angle), 6)
    return f"{size:g}°" + ("" if size in (0, 180) else below if angle < 0 else above)
