"""Centroidal Voronoi tessellations of the sphere."""
import operator
from typing import Callable, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import Floats, mesh_of, node_array, thread_count
from ._errors import TriangulationError

_REASONS = ("converged", "evaluations", "stopped", "stalled", "not well centred")
_OUT_OF_MEMORY = -6


class Progress(NamedTuple):
    """The state of a run of :func:`scvt` after a step."""

    generators: int  #: Number of generators of the level.
    evaluations: int  #: Number of evaluations on this level; each triangulates and integrates.
    gradient: float  #: Root mean square of the distances to the centroids, in units of sqrt(4 pi / generators).
    energy: float  #: As in Tessellation.


class Tessellation(NamedTuple):
    """The result of :func:`scvt`."""

    points: Floats  #: The generators, unit vectors, shape (n, 3).
    energy: float  #: Sum over the cells of the integral of density times the squared distance to the generator.
    gradient: float  #: As in Progress.
    evaluations: float  #: Evaluations of all levels, each weighted by its generators / n.
    #: "converged", "evaluations" (max_evaluations are reached), "stopped" (by progress), "stalled" (the energy falls no
    #: further), or "not well centred" (triangles are left that do not hold their circumcentre).
    reason: str

    def __repr__(self) -> str:
        return (f"<pstripack.Tessellation: {len(self.points)} generators, energy {self.energy:.6g}, "
                f"gradient {self.gradient:.3g}, {self.evaluations:g} evaluations, {self.reason}>")


def _cells_of(width: Callable[[Floats], ArrayLike], radius: float) -> int:
    code, message, cells = _core.scvt_cells(width, radius)
    if code == _OUT_OF_MEMORY:
        raise MemoryError(message)
    if code != 0:
        raise TriangulationError(message)
    if not 3.5 <= cells <= 2**31 // 6:
        raise TriangulationError(f"the widths give {cells:.3g} cells, not 4 to {2**31 // 6}: are width and radius in one unit?")
    return round(cells)


def scvt(generators: Union[int, ArrayLike, None] = None, density: Optional[Callable[[Floats], ArrayLike]] = None, *,
         width: Optional[Callable[[Floats], ArrayLike]] = None, radius: float = 6371.22, well_centred: bool = False,
         tolerance: float = 1e-5, method: str = "newton", seed: int = 1, max_evaluations: Optional[int] = None,
         progress: Optional[Callable[[Progress], object]] = None, threshold: float = 0,
         threads: Optional[int] = None) -> Tessellation:
    """Generators at the centroids of their Voronoi cells with respect to a density.

    Parameters
    ----------
    generators : int or array_like, shape (n, 3), optional with ``width``
        Number of generators, or vectors to start from. A number of 3000 or more starts from an advancing front, a smaller
        one from random generators, level by level.
    density : callable, optional
        Function of unit vectors, shape (m, 3), that returns values of shape (m,). They must be positive and finite, and
        depend only on the place. The widths of cells are about proportional to ``density**(-1/4)``. Default: 1 everywhere;
        only then integrals use threads.
    width : callable, optional
        In place of a density: function of unit vectors that returns widths of cells, the distances of neighbours in a
        mesh of regular hexagons. Without ``generators`` their number is the integral of ``1/(sqrt(3)/2 width**2)``.
    radius : float
        Radius of the sphere in the unit of ``width``; by default the Earth's in km.
    well_centred : bool
        Move a few generators in the end, so that each triangle holds its circumcentre strictly.
    tolerance : float
        The run ends when the gradient is at most this.
    method : {"newton", "lloyd"}
        Quasi-Newton method or Lloyd's method.
    seed : int
        Seed of random generators; at least 1.
    max_evaluations : int, optional
        Largest number of evaluations on each level.
    progress : callable, optional
        Called after each step; the run ends if it returns something true.
    threshold : float, optional
        Generators to start from that are this near to each other, in radians, are refused.
    threads : int, optional
        Number of threads.

    Returns
    -------
    Tessellation
        The generators, and why the run ended.

    Raises
    ------
    ValueError
        If an argument or a density is wrong. Exceptions of ``density`` and ``progress`` are passed on.

    Examples
    --------
    >>> import numpy as np
    >>> from pstripack import scvt
    >>> len(scvt(width=lambda xyz: 1400 - 500 * xyz[:, 2], tolerance=1e-3).points)
    344
    >>> mesh = scvt(200, lambda xyz: 1 + 10 * np.exp(xyz[:, 2]), tolerance=1e-3)
    >>> mesh.reason, mesh.points.shape
    ('converged', (200, 3))
    """
    if method not in ("newton", "lloyd"):
        raise ValueError(f"method must be 'newton' or 'lloyd', not {method!r}")
    if not (np.isfinite(tolerance) and tolerance > 0):
        raise ValueError(f"tolerance must be positive, not {tolerance}")
    if seed < 1:
        raise ValueError(f"seed must be at least 1, not {seed}")
    if max_evaluations is not None and max_evaluations < 1:
        raise ValueError(f"max_evaluations must be at least 1, not {max_evaluations}")
    if width is not None and density is not None:
        raise ValueError("give either a density or a width")
    if generators is None:
        if width is None:
            raise ValueError("give the number of generators, or a width")
        if not (np.isfinite(radius) and radius > 0):
            raise ValueError(f"radius must be positive, not {radius}")
        generators = _cells_of(width, float(radius))
    number = thread_count(threads)
    start: Union[int, Floats]
    if np.ndim(generators) == 0:
        start = operator.index(generators)  # type: ignore[arg-type]
        count = start
    else:
        start = np.array(node_array(generators), order="C")
        count = len(start)
        if count >= 4:
            mesh_of(start, threshold, number)  # raises errors of the nodes with their indices
    if count < 4 or count > 2**31 // 6:
        raise TriangulationError(f"a tessellation needs at least 4 generators, and {2**31 // 6} at most; not {count}")

    def told(n: int, evaluations: int, gradient: float, energy: float) -> bool:
        return progress is not None and bool(progress(Progress(n, evaluations, gradient, energy)))

    code, message, points, energy, gradient, evaluations, reason = _core.scvt(
        start, density if width is None else width, float(tolerance), method == "lloyd", max_evaluations or 0, seed,
        None if progress is None else told, width is not None, bool(well_centred), number)
    if code == _OUT_OF_MEMORY:
        raise MemoryError(message)
    if code != 0:
        raise TriangulationError(message)
    return Tessellation(points, energy, gradient, evaluations, _REASONS[reason])
