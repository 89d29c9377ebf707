"""How values of nodes enter: by their labels, where there are any."""
from typing import Any, Dict, NamedTuple, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from ._arrays import Ints, unmasked


class Rows(NamedTuple):
    """The rows that a mesh was made of, if some of them are one node."""

    labels: Any  #: of the rows; None: they have none
    node: Ints  #: of each row
    means: bool  #: a node has the mean of the values of its rows, not that of the first one


class Column(NamedTuple):
    """Values by rows. Those of a DataArray may have more dimensions, with coordinates."""

    numbers: NDArray[Any]
    dims: Tuple[Any, ...] = ()  #: after the first
    coordinates: Dict[Any, Any] = {}
    attributes: Dict[Any, Any] = {}


class Values:
    """Part of :class:`Delaunay`. Values of nodes are an array with a row for each node, or have labels: a Series or
    DataFrame of pandas, or a DataArray of xarray. If the mesh has ``labels`` too, the rows are found by them, in any order
    and among others. A DataArray has the nodes in the dimension that is called like the labels, else in the first one."""

    #: Labels of the nodes: the index of the table or of the longitudes that the mesh was made of. None: there are none.
    labels: Any = None
    _rows: Optional[Rows] = None

    def _ordered(self, values: Any, nodes: int, others: Sequence[int] = ()) -> Any:
        """The values with their rows in the order of the nodes, or of the rows that the mesh was made of. As they are, if
        their number is one of ``others`` instead."""
        if getattr(values, "ndim", 0) > 0 and len(values) in others and len(values) != nodes:
            return values
        return in_order_of(self.labels if self._rows is None else self._rows.labels, values, nodes)

    def _array(self, values: Any, nodes: int, others: Sequence[int] = (), masked_is_nan: bool = False) -> NDArray[Any]:
        """The same as an array, with a row for each node."""
        values = self._ordered(values, nodes, others)
        if masked_is_nan and isinstance(values, np.ma.MaskedArray) and np.any(values.mask):
            values = np.where(values.mask, np.nan, values.data)
        array = plain(values)
        if self._rows is not None and array.ndim > 0 and len(array) == len(self._rows.node):
            array = _joined(array, self._rows, nodes)
        return array

    def _enter(self, values: Any, nodes: int) -> NDArray[Any]:
        """One or several values of each node, in their order."""
        array = self._array(values, nodes)
        if array.ndim < 1 or len(array) != nodes:
            raise ValueError(f"values must be one for each of {nodes} nodes; their shape is {array.shape}")
        return array

    def _column(self, values: Any, nodes: int, others: Sequence[int]) -> Column:
        """Values of nodes, or of ``others``, to be shown."""
        array = self._array(values, nodes, others, masked_is_nan=True)
        attributes = dict(getattr(values, "attrs", {}))
        if array.ndim == 1:
            return Column(array, attributes=attributes)
        if array.ndim < 2 or not is_field(values):
            raise ValueError(f"values must have one dimension, not the shape {array.shape}: pass them one by one, or as an "
                             "xarray.DataArray, whose dimensions have names")
        dims = self._ordered(values, nodes, others).dims[1:]
        return Column(array, dims, {d: values.coords[d] for d in dims if d in values.coords}, attributes)


def is_field(values: Any) -> bool:
    """True for a DataArray of xarray."""
    return hasattr(values, "dims") and hasattr(values, "isel") and not hasattr(values, "data_vars")


def in_order_of(labels: Any, values: Any, nodes: int) -> Any:
    """The rows of the values that have these labels; the values as they are if either has none."""
    if hasattr(values, "data_vars"):
        raise ValueError(f"values are a Dataset: pass one of its variables: {', '.join(map(repr, values.data_vars))}")
    if is_field(values):
        if labels is not None and labels.name in values.dims:
            values = values.transpose(labels.name, ...)
        elif values.ndim > 0 and len(values) != nodes and values.shape.count(nodes) == 1:
            values = values.transpose(values.dims[values.shape.index(nodes)], ...)
        index = values.indexes.get(values.dims[0]) if values.ndim > 0 else None
    else:
        index = values.index if hasattr(values, "iloc") else None
    if labels is None or index is None or labels.equals(index):
        return values
    if not index.is_unique:
        raise ValueError(f"the label {index[index.duplicated()][0]!r} of the values is there twice, and their labels are not "
                         "those of the nodes in their order")
    where = index.get_indexer(labels)
    if np.any(where < 0):
        advice = ("pass values.T: the labels of the nodes are those of its columns"
                  if hasattr(values, "columns") and labels.isin(values.columns).all() else
                  "if they are in the order of the nodes, pass them without labels: values.to_numpy()")
        raise ValueError(f"the values have no label {labels[where < 0][0]!r}, which is that of a node: {advice}")
    return values.isel({values.dims[0]: where}) if is_field(values) else values.iloc[where]


def plain(values: Any) -> NDArray[Any]:
    """The values as an array; NaN for pandas' NA."""
    array = unmasked(values)
    if array.dtype == object and hasattr(values, "iloc"):
        try:
            return np.asarray(values.to_numpy(np.float64, na_value=np.nan))
        except (TypeError, ValueError):  # texts, which the method "nearest" takes
            pass
    return array


def _joined(array: NDArray[Any], rows: Rows, nodes: int) -> NDArray[Any]:
    first = np.full(nodes, len(array))
    np.minimum.at(first, rows.node, np.arange(len(array)))
    if not rows.means or array.dtype.kind not in "fiub":
        of_first: NDArray[Any] = array[first]
        return of_first
    numbers = array.astype(np.float64)
    is_there = ~np.isnan(numbers)
    sums, counts = np.zeros((2, nodes, *array.shape[1:]))
    np.add.at(sums, rows.node, np.where(is_there, numbers, 0))
    np.add.at(counts, rows.node, is_there)
    with np.errstate(invalid="ignore"):
        means: NDArray[Any] = sums / counts
    return means
