"""Globes to turn: pages of HTML."""
import html
import os
from pathlib import Path
from typing import TYPE_CHECKING, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import real, to_lonlat

if TYPE_CHECKING:
    from ._delaunay import Delaunay

#: A notebook shows globes of at most this number of nodes by itself: it keeps up to 1 MB of each.
MOST_NODES_IN_NOTEBOOKS = 20000
_EARTH_RADIUS = 6371.0


class Globe:
    """A page of HTML that needs no other file and no network, as :meth:`Delaunay.globe` returns it. Notebooks show it.

    Attributes
    ----------
    html : str
        The page.

    Examples
    --------
    >>> from pstripack import Delaunay
    >>> globe = Delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]]).globe()
    >>> globe
    <pstripack globe of 4 nodes, ... MB>
    >>> globe.save("globe.html")
    """

    def __init__(self, page: str, nodes: int) -> None:
        self.html = page
        self._nodes = nodes

    def save(self, file: "Union[str, os.PathLike[str]]") -> None:
        """Writes the page, as UTF-8.

        Parameters
        ----------
        file : path
            The file.
        """
        Path(file).write_bytes(self.html.encode())

    def __repr__(self) -> str:
        return f"<pstripack globe of {self._nodes} nodes, {len(self.html) / 1e6:.1f} MB>"

    def _repr_html_(self) -> str:
        return (f'<iframe srcdoc="{html.escape(self.html)}" title="globe" style="width: 100%; height: 700px; border: 0">'
                "</iframe>")


def globe(mesh: "Delaunay", values: Optional[ArrayLike], file: "Optional[Union[str, os.PathLike[str]]]", title: Optional[str],
          name: str, unit: str, coasts: "Union[bool, str, os.PathLike[str]]") -> Globe:
    """See :meth:`Delaunay.globe`."""
    if values is None:
        colours, name, unit = mesh.cell_areas * _EARTH_RADIUS * _EARTH_RADIUS, "area of a cell", "km²"
        colours[mesh.convex_hull[:, 0]] = np.nan
    else:
        colours = np.require(real(values), np.float64, ["A", "C"])
        if colours.ndim != 1:
            raise ValueError(f"values must be one for each of {mesh.npoints} nodes; their shape is {colours.shape}")
    lon, lat = to_lonlat(mesh.points)
    page = _core.globe(f"{mesh.npoints:,} nodes" if title is None else title, np.ascontiguousarray(lon), np.ascontiguousarray(lat),
                       mesh.simplices, colours, name, unit, values is not None,
                       "yes" if coasts is True else os.fspath(coasts) if coasts else "")
    result = Globe(page, mesh.npoints)
    if file is not None:
        result.save(file)
    return result


def notebook_html(mesh: "Delaunay") -> str:
    """The globe of a mesh that is the result of a notebook's cell; or its repr and a line that says why there is none."""
    if mesh.npoints <= MOST_NODES_IN_NOTEBOOKS:
        return mesh.globe()._repr_html_()
    reason = f"more than {MOST_NODES_IN_NOTEBOOKS} nodes: a globe would make the notebook large; globe() shows it"
    return f"<pre>{html.escape(repr(mesh))}</pre><p>{html.escape(reason)}</p>"
