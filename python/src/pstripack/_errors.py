"""Exceptions for nodes without a triangulation."""
from typing import Tuple


class TriangulationError(ValueError):
    """The nodes have no triangulation. A ValueError. ``nodes`` has the indices of the nodes in question, counted from 0; it
    may be empty.

    Examples
    --------
    >>> from pstripack import Delaunay, TriangulationError
    >>> try:
    ...     Delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [2, 0, 0]])
    ... except TriangulationError as error:
    ...     print(error.nodes)
    (0, 3)
    """

    def __init__(self, message: str, nodes: Tuple[int, ...] = ()) -> None:
        super().__init__(message, nodes)
        self.nodes = nodes

    def __str__(self) -> str:
        return str(self.args[0])


class BadCoordinateError(TriangulationError):
    """A :class:`TriangulationError`: ``nodes[0]`` is the first node with a coordinate that is not finite, or whose
    coordinates are all zero."""


class CoincidentNodesError(TriangulationError):
    """A :class:`TriangulationError`: nodes ``nodes[0]`` and ``nodes[1]`` point in the same direction, and so do ``nodes[2]``
    and ``nodes[3]``, and so on. Each pair is the first node of a direction, and a later one."""

    coincide = True  #: False: the directions differ, by at most the threshold


class CollinearNodesError(TriangulationError):
    """A :class:`TriangulationError`: all nodes lie on one great circle."""
