"""Conversion of arguments: nodes, places and numbers of threads."""
import operator
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._errors import CoincidentNodesError

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


def unmasked(numbers: Any) -> NDArray[Any]:
    """The numbers as an array; refused if elements are masked, which NumPy would uncover."""
    masked = np.count_nonzero(numbers.mask) if isinstance(numbers, np.ma.MaskedArray) else 0
    if masked > 0:
        raise ValueError(f"{masked} numbers are masked: remove them, or replace them by filled()")
    return np.asarray(numbers)


def real(numbers: Any, what: str = "value") -> NDArray[Any]:
    """The numbers as an array; refused if they are masked, or complex: float64 has no imaginary parts. ``what`` names one
    of them in messages."""
    array = unmasked(numbers)
    if np.iscomplexobj(array):
        raise TypeError("the numbers are complex: real numbers are needed")
    if array.dtype.kind in "mM":
        raise TypeError(f"each {what} is a date or a duration: numbers are needed")
    return _parsed(array, what) if array.dtype.kind in "OSU" else array


def _parsed(items: NDArray[Any], what: str) -> NDArray[Any]:
    """Objects and texts as numbers; NaN for pandas' NA."""
    try:
        return items.astype(np.float64)
    except (TypeError, ValueError):
        numbers = np.empty(items.shape)
    for index, item in np.ndenumerate(items):
        try:
            numbers[index] = np.nan if str(item) == "<NA>" else float(item)
        except (TypeError, ValueError):
            at = ", ".join(map(str, index))
            remedy = ("read_csv(..., decimal=',') reads decimal commas" if isinstance(item, str) and "," in item else
                      "pandas.to_numeric(column, errors='coerce') makes NaN of texts")
            raise ValueError(f"{what} {at} (counted from 0) is {item!r}, not a number: {remedy}") from None
    return numbers


def _coordinates(vectors: Any) -> Any:
    """The columns x, y, z of a table, which has names of columns (pandas, polars); anything else as it is."""
    names = getattr(vectors, "columns", None)
    if names is None:
        return vectors
    if not {"x", "y", "z"} <= set(names):
        raise ValueError(f"a table needs the columns x, y and z, not {', '.join(map(str, names))}: for longitudes and "
                         "latitudes use Delaunay.from_dataframe(table), or to_xyz(table['lon'], table['lat'])")
    return vectors[["x", "y", "z"]]


def node_array(points: ArrayLike) -> Floats:
    """The nodes as an array of shape (n, 3); an array of float64 is not copied."""
    array = np.require(real(_coordinates(points)), np.float64, ["A"])
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"nodes must be an array of shape (n, 3): x, y, z of each; not {array.shape}")
    return array


def place_array(places: ArrayLike) -> Floats:
    """The places as a C-contiguous array of shape (..., 3)."""
    array = np.require(real(_coordinates(places)), np.float64, ["A", "C"])
    if array.ndim < 1 or array.shape[-1] != 3:
        raise ValueError(f"places must be an array of shape (..., 3): x, y, z of each; not {array.shape}; longitudes and "
                         "latitudes are passed as lon=, lat=")
    return array


def mesh_of(points: Floats, threshold: float, threads: int) -> _core.Mesh:
    """The mesh of nodes that are further than the threshold, in radians, from each other."""
    in_radians("threshold", threshold)
    mesh = _core.Mesh(points, threads)
    if threshold > 0:
        distance, first, second = mesh.closest_pair(threads)
        angle = 2 * np.arcsin(min(distance / 2, 1))
        if angle <= threshold:
            error = CoincidentNodesError(
                f"nodes {first} and {second} (counted from 0) are {angle:g} radians apart, within the threshold of "
                f"{threshold:g}: remove one of them", (first, second))
            error.coincide = False
            raise error
    return mesh


def in_radians(name: str, angle: float) -> None:
    """Refuses an angle that cannot be one between two directions."""
    if not angle >= 0:
        raise ValueError(f"{name} must be at least 0, in radians, not {angle}")
    if angle > np.pi * (1 + 1e-6):
        raise ValueError(f"{name} is {angle:g}, more than pi: it is in radians; kilometres on the Earth are {angle:g} / 6371")


def thread_count(threads: Optional[int]) -> int:
    """The number of threads; 0 for None, OpenMP's default."""
    if threads is None:
        return 0
    try:
        number = operator.index(threads)
    except TypeError:
        raise TypeError(f"threads must be a whole number, not {threads!r}") from None
    if number < 1:
        raise ValueError(f"threads must be at least 1, not {number}")
    return number


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    view = array.view()
    view.flags.writeable = False
    return view


def scalar(array: NDArray[Any]) -> Any:
    """The array; its number if it has no dimension, as NumPy's functions return it."""
    return array[()]


def unit_vectors(points: Floats) -> Floats:
    """Of vectors of any length: hypot neither overflows nor underflows."""
    length = np.hypot(np.hypot(points[:, 0], points[:, 1]), points[:, 2])
    vectors: Floats = points / length[:, np.newaxis]
    return vectors


def to_xyz(lon: ArrayLike, lat: ArrayLike, degrees: bool = True) -> Floats:
    """Unit vectors of longitudes and latitudes.

    Parameters
    ----------
    lon, lat : array_like
        Longitudes and latitudes, which are broadcast.
    degrees : bool
        False: the angles are radians.

    Returns
    -------
    array, shape (..., 3)
        Each pole has one vector for all longitudes. In degrees, longitudes that differ by 360 have equal vectors. In
        radians the number nearest to a multiple of pi/2, in the precision of the arrays, means the multiple.

    Raises
    ------
    ValueError
        If a latitude is beyond a pole, or the shapes do not fit each other.

    Examples
    --------
    >>> from pstripack import to_xyz
    >>> to_xyz([0, 90, 12], [0, 0, 90])
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
    return vectors_of(lon, lat, degrees, "node")


def vectors_of(lon: ArrayLike, lat: ArrayLike, degrees: bool, what: str) -> Floats:
    """to_xyz; ``what`` names a place in messages."""
    fit_each_other(lon, lat)
    lon, lat = (angle if degrees or angle.dtype != np.float32 else _core.radians_of_single(angle)
                for angle in (real(lon, f"longitude of {what}"), real(lat, f"latitude of {what}")))
    lon, lat = np.broadcast_arrays(np.asarray(lon, np.float64), np.asarray(lat, np.float64))
    limit = 90.0 if degrees else np.pi / 2 * (1 + 1e-15)
    beyond = np.abs(lat) > limit
    if np.any(beyond):
        index = int(np.argmax(beyond))
        raise ValueError(f"latitude {lat.flat[index]:g} of {what} {index} (counted from 0) is beyond the pole: "
                         + ("are these metres of a map projection? to_crs(4326) of geopandas makes degrees of them"
                            if np.nanmax(np.abs(lat)) > 1000 else "the arguments are longitudes, then latitudes"
                            + ("" if degrees else ", in radians unless degrees=True")))
    vectors = _core.vectors(np.ascontiguousarray(lon.ravel()), np.ascontiguousarray(lat.ravel()), degrees)
    return vectors.reshape(lon.shape + (3,)) + 0.0  # no -0.0


def refuse_map_coordinates(points: Floats) -> None:
    """Columns x, y, z that are no vectors to nodes of one sphere: the rule of the command `pstripack`."""
    lengths = np.sqrt((points * points).sum(axis=1))
    low, high = lengths.min(initial=np.inf), lengths.max(initial=0)
    if high > 1.01 * low or (high > (1 + 1e-6) * low and np.all(np.abs(points[:, 2]) < 0.02 * low)):
        raise ValueError(f"x, y, z of lengths {low:.4g} to {high:.4g} are not on one sphere: are these metres of a map "
                         "projection? to_crs(4326) of geopandas makes degrees of them; pass columns=(x, y, z) if the vectors "
                         "are directions")


def fit_each_other(lon: Any, lat: Any) -> None:
    """Refuses axes of a grid in place of longitudes and latitudes of places."""
    shapes, dims = [np.shape(angle) for angle in (lon, lat)], [getattr(angle, "dims", None) for angle in (lon, lat)]
    try:
        np.broadcast_shapes(*shapes)
        if None in dims or () in dims or dims[0] == dims[1]:
            return
    except ValueError:
        pass
    lons, lats = (f"{given} {shape}" if given else str(shape) for given, shape in zip(dims, shapes))
    raise ValueError(f"longitudes {lons} and latitudes {lats} do not fit each other; of the axes of a grid, "
                     "lon, lat = numpy.meshgrid(lon, lat) makes places")


def are_degrees(lon: NDArray[Any], lat: NDArray[Any], degrees: bool, units: Optional[str]) -> bool:
    """Whether angles are degrees, rather than radians; units=None: what ``degrees`` says, if that is certain."""
    if units not in (None, "degrees", "radians"):
        raise ValueError(f"units must be 'degrees' or 'radians', not {units!r}")
    if units is None and degrees:
        refuse_what_may_be_radians(lon, lat)
    return degrees if units is None else units == "degrees"


def refuse_what_may_be_radians(lon: NDArray[Any], lat: NDArray[Any]) -> None:
    """Raises an error unless an angle is too large for radians; the limits are those of the command `pstripack`."""
    if np.size(lon) == 0 or np.size(lat) == 0:
        return
    most_lon, most_lat = np.max(np.abs(lon)), np.max(np.abs(lat))
    slack = 1 + 1e-6  # single precision rounds a pole up
    if most_lon <= 2 * np.pi * slack and most_lat <= np.pi / 2 * slack:
        raise ValueError(f"the angles may be degrees or radians: say units='degrees' or units='radians' (longitudes reach "
                         f"{most_lon:.4g}, latitudes {most_lat:.4g})")


def to_lonlat(xyz: ArrayLike, degrees: bool = True) -> "tuple[Floats, Floats]":
    """Longitudes and latitudes of vectors of any length.

    Parameters
    ----------
    xyz : array_like, shape (..., 3)
        The vectors.
    degrees : bool
        False: the results are radians.

    Returns
    -------
    lon, lat : arrays, shape (...)
        Longitudes from -180 to 180 degrees, and latitudes.

    Examples
    --------
    >>> from pstripack import to_lonlat
    >>> to_lonlat([[0, 2, 0], [0, 0, -1]])
    (array([90.,  0.]), array([  0., -90.]))
    """
    array = place_array(xyz)
    x, y, z = array[..., 0], array[..., 1], array[..., 2]
    lon, lat = np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))
    return (np.degrees(lon), np.degrees(lat)) if degrees else (lon, lat)
